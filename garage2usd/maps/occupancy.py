"""Occupancy grids for robots: a map of nav2's map server, and masks for its keep-out and speed filters."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.checks import Subject
from garage2usd.config.maps import GridConfig
from garage2usd.errors import ConfigError
from garage2usd.layout import StallUse
from garage2usd.maps.frame import map_points
from garage2usd.maps.occupied_ground import floor_of, occupied_ground, ramp_floors

__all__ = ["write_grid"]

_OCCUPIED, _UNKNOWN, _FREE = 0, 205, 254
"""Greys of the map server's own maps."""
_OCCUPIED_THRESHOLD, _FREE_THRESHOLD = 0.65, 0.196
"""Of a cell's darkness: 205 is as dark as 0.19608, which counts as unknown only while no more than that is free."""
_MOST_CELLS = 400_000_000
_AROUND_M = 1.0
"""Of the map around the floors: walls stand there."""
_NEAR_CELLS = 0.25
_KEPT_FREE = frozenset({StallUse.ACCESS_AISLE, StallUse.UNREACHABLE})
_KEEP_OUT = 100
_RAMP_PERCENT, _BUMP_PERCENT, _BUMP_REACH_M = 50, 30, 2.0
"""Most speed on ramps, and over a speed bump and as near to it as a car that slows down for it is."""


def write_grid(
    subject: Subject, path: Path, grid: GridConfig, *, keepout: bool = False, speed: bool = False
) -> tuple[Path, ...]:
    """Write the map of a garage for robots: a YAML file and the picture (PGM) that it names.

    Parameters
    ----------
    subject
        The garage.
    path
        The YAML file; its folder is there. The picture is beside it, ``<stem>.pgm``.
    grid
        Size of a cell, and the heights between which things count.
    keepout, speed
        Whether a mask for nav2's keep-out filter, ``<stem>_keepout``, and one for its speed filter, ``<stem>_speed``,
        are written as well.

    Returns
    -------
    tuple of Path
        The files.

    Raises
    ------
    ConfigError
        If there would be more than 400 million cells.
    StageError
        If nothing in the garage has the class floor.

    Notes
    -----
    The frame is that of `garage2usd.maps.frame`; the origin is the lower left corner of the lower left cell, a multiple
    of the cell's side. A cell is occupied where the ground of something solid holds its middle or comes nearer to it
    than a quarter of a cell; what is thinner than a cell counts as one cell thick, so that no wall has gaps. What lies
    wholly in something is thus occupied. Where a car goes that keeps 5 cm away from all that is at least half a cell
    thick, cells of up to 5 cm are free: their middles are 0.71 cells from the car at most, and 0.25 from what occupies
    them. Other cells are free on the floor of garage and ramps, and unknown elsewhere.

    The masks have the mode raw, in which a grey is the value itself: 100 keeps out, and a speed is a percentage of the
    robot's own, 0 without a limit (filter type 1 with a base of 0 and a multiplier of 1).
    """
    floor = floor_of(subject)
    raster = _Raster.around(floor, grid.resolution_m)
    cells = np.full(raster.shape, _UNKNOWN, dtype=np.uint8)
    raster.fill(cells, shapely.get_parts(floor), _FREE)
    thin = _thickened(occupied_ground(subject, grid.low_m, grid.high_m), grid.resolution_m)
    raster.fill(cells, thin, _OCCUPIED)
    files = _write(path, cells, raster, "trinary")
    if keepout:
        mask = np.zeros(raster.shape, dtype=np.uint8)
        raster.fill(mask, (stall.polygon for stall in subject.stalls if stall.use in _KEPT_FREE), _KEEP_OUT)
        files += _write(path.with_stem(f"{path.stem}_keepout"), mask, raster, "raw")
    if speed:
        mask = np.zeros(raster.shape, dtype=np.uint8)
        raster.fill(mask, ramp_floors(subject), _RAMP_PERCENT)
        bumps = [solid.footprint.buffer(_BUMP_REACH_M) for solid in subject.solids.standing("speed_bump")]
        raster.fill(mask, bumps, _BUMP_PERCENT)
        files += _write(path.with_stem(f"{path.stem}_speed"), mask, raster, "raw")
    return files


@dataclass(frozen=True, slots=True)
class _Raster:
    """Where cells lie.

    Attributes
    ----------
    side_m
        Of a cell.
    column, row
        Cells from the map's origin to the lower left cell, to the right and upwards.
    shape
        Rows and columns; row 0 is the highest.
    """

    side_m: float
    column: int
    row: int
    shape: tuple[int, int]

    @classmethod
    def around(cls, floor: shapely.Geometry, side_m: float) -> "_Raster":
        """The cells on and around a ground (x, z)."""
        (left, high), (right, low) = map_points(np.reshape(floor.bounds, (2, 2)))
        first_column, first_row = (math.floor((value - _AROUND_M) / side_m) for value in (left, low))
        columns, rows = (
            math.ceil((value + _AROUND_M) / side_m) - first
            for value, first in ((right, first_column), (high, first_row))
        )
        if rows * columns > _MOST_CELLS:
            least_m = side_m * math.sqrt(rows * columns / _MOST_CELLS)
            allowed = f"at least {least_m:.3f} for this garage, so that there are at most {_MOST_CELLS} cells"
            raise ConfigError("maps.grid.resolution_m", side_m, allowed)
        return cls(side_m, first_column, first_row, (rows, columns))

    @property
    def origin_m(self) -> tuple[float, float]:
        """(x, y) of the lower left corner in the map's frame."""
        return round(self.column * self.side_m, 6) + 0.0, round(self.row * self.side_m, 6) + 0.0

    def fill(self, cells: NDArray[np.uint8], grounds: Iterable[shapely.Geometry], value: int) -> None:
        """Set the cells whose middles lie in any of some grounds (x, z), borders included."""
        rows, _ = self.shape
        for ground in grounds:
            area = shapely.transform(ground, map_points)
            if area.is_empty:
                continue
            left, low, right, high = (bound / self.side_m - 0.5 for bound in area.bounds)
            first, last = max(math.ceil(left) - self.column, 0), min(math.floor(right) - self.column + 1, self.shape[1])
            lowest, highest = max(math.ceil(low) - self.row, 0), min(math.floor(high) - self.row + 1, rows)
            if first >= last or lowest >= highest:
                continue
            x = (np.arange(first, last) + self.column + 0.5) * self.side_m
            y = (np.arange(highest - 1, lowest - 1, -1) + self.row + 0.5) * self.side_m
            shapely.prepare(area)
            inside = shapely.intersects_xy(area, *np.meshgrid(x, y))
            cells[rows - highest : rows - lowest, first:last][inside] = value


def _thickened(grounds: Iterable[shapely.Geometry], side_m: float) -> Iterable[shapely.Geometry]:
    """Convex grounds and what is nearer to them than a quarter of a cell, all of it at least a cell thick."""
    for ground in grounds:
        thickness_m = _thickness_m(ground)
        yield ground.buffer(max(_NEAR_CELLS * side_m, (side_m - thickness_m) / 2))


def _thickness_m(ground: shapely.Geometry) -> float:
    """The shorter side of the tightest rectangle around a convex ground; 0 for a line or a point."""
    box = shapely.oriented_envelope(ground)
    if not isinstance(box, shapely.Polygon) or box.is_empty:
        return 0.0
    corners = np.asarray(box.exterior.coords)
    return float(np.linalg.norm(np.diff(corners[:3], axis=0), axis=1).min())


def _write(path: Path, cells: NDArray[np.uint8], raster: _Raster, mode: str) -> tuple[Path, ...]:
    picture = path.with_suffix(".pgm")
    rows, columns = raster.shape
    picture.write_bytes(b"P5\n%d %d\n255\n" % (columns, rows) + cells.tobytes())
    x, y = raster.origin_m
    path.write_text(
        f"image: {picture.name}\nmode: {mode}\nresolution: {raster.side_m}\norigin: [{x}, {y}, 0.0]\nnegate: 0\n"
        f"occupied_thresh: {_OCCUPIED_THRESHOLD}\nfree_thresh: {_FREE_THRESHOLD}\n",
        encoding="utf-8",
    )
    return path, picture
