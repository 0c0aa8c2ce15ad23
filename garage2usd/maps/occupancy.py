"""Occupancy grids for robots, from footprints of obstacles: maps of nav2's map server, and masks for its filters."""
# Over 300 lines: footprints, cells and the files of three grids follow one another.

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.as_built import BuiltLevel
from garage2usd.as_built.driven_road import floors_of_ramps
from garage2usd.as_built.openings import section_of
from garage2usd.as_built.placed_pieces import placed_pieces
from garage2usd.as_built.shapes import Body, Thing
from garage2usd.common.errors import ConfigError, StageError
from garage2usd.config.outputs import GridConfig
from garage2usd.garage import StallUse
from garage2usd.layout.grounds import Grounds, hulls_of
from garage2usd.maps.frame import map_points

_DOOR, _RAMP, _FLOOR, _DRIVEN_OVER = "vehicle_door", "ramp", "floor", "speed_bump"
_TOUCH_M = 1e-4
"""Distance below which section lines belong to one body."""
_CARRIED_M = 1e-3
"""Greatest height above a ramp's floor of a body that carries it."""
_LEAST_UP = 0.1
"""Least upward component of a floor face's normal, which allows ramps with grooves."""
Floats = NDArray[np.float64]
_OCCUPIED, _UNKNOWN, _FREE = 0, 205, 254
"""Grey values of nav2's map server."""
_OCCUPIED_THRESHOLD, _FREE_THRESHOLD = 0.65, 0.196
"""Thresholds of a cell's darkness: 205 is as dark as 0.19608, so it is unknown only with a free threshold up to
that."""
_MOST_CELLS = 400_000_000
_AROUND_M = 1.0
"""Margin of the occupancy grid around the floors, for walls."""
_HAIR_M = 1e-5
_NEAR_CELLS = 0.25
_ARC_SIDES = 4
"""Segments of a quarter circle around a corner; they cut off a fiftieth of the radius."""
_BAND_ROWS = 256
"""Rows filled at a time, which limits the memory for large grids."""
_KEPT_FREE = frozenset({StallUse.ACCESS_AISLE, StallUse.UNREACHABLE})
_KEEP_OUT = 100
_KEEP_OUT_MASK, _SPEED_MASK = "keepout", "speed"
_RAMP_PERCENT, _BUMP_PERCENT, _BUMP_REACH_M = 50, 30, 2.0
"""Speed limit in percent on ramps and speed bumps, and the distance around a bump in which cars slow down."""


def floor_of(level: BuiltLevel) -> Grounds:
    """Return the polygons of the garage's floors, stalls and ramps, (x, z) in metres; a square may be all stalls.

    Raises
    ------
    StageError
        If no object is labelled as a floor, so that the garage's extent is unknown.
    """
    bodies = list(_bodies(level, _FLOOR))
    if not bodies:
        raise StageError(level.source, "nothing in it has the class floor, so that nothing says where it ends")
    tiles = placed_pieces(bodies, np.array([not body.shape.is_dented for body in bodies])).hulls
    # a hair smaller, so that rounding does not enlarge the grid
    stalls = shapely.buffer(level.stall_grounds.polygons, -_HAIR_M, join_style="mitre")
    return np.array([*tiles, *stalls, *ramp_floors(level)], dtype=object)


def ramp_floors(level: BuiltLevel) -> Grounds:
    """Return the floor polygon of each ramp."""
    sheets = (body for body in _bodies(level, _RAMP) if _is_sheet(body))
    return hulls_of([body.world_points()[:, [0, 2]] for body in sheets])


def occupied_ground(level: BuiltLevel, low_m: float, high_m: float) -> Iterator[shapely.Geometry]:
    """Yield convex footprints of all solids between two heights, (x, z) in metres.

    Notes
    -----
    Solids are those of `garage2usd.as_built.solids.Solids`, without speed bumps, which cars drive over. A vehicle door
    is represented by its sections at every height where its shape changes, since its convex hull would close it. Ramps
    are included without their floors and the slabs that carry these.
    """
    for solid in level.solids.between(low_m, high_m):
        if solid.label not in {_DOOR, _RAMP, _DRIVEN_OVER}:
            yield solid.footprint
    for thing in level.things:
        if thing.label == _DOOR:
            yield from _sections(thing, low_m, high_m)
    for thing in level.things:
        if thing.label == _RAMP:
            for body in _beside_floor(thing):
                pieces = body.pieces()
                yield from hulls_of([outline for outline, low, high in pieces if low <= high_m and high >= low_m])


def _bodies(level: BuiltLevel, label: str) -> Iterator[Body]:
    return (body for thing in level.things if thing.label == label for body in thing.bodies)


def _is_sheet(body: Body) -> bool:
    """Test if all faces of a body look up, as those of a floor."""
    return all(face.normal[1] >= _LEAST_UP for face in body.faces())


def _beside_floor(ramp: Thing) -> Iterator[Body]:
    """Yield the bodies of a ramp that rise above its floor."""
    floors = floors_of_ramps([ramp])
    for body in ramp.bodies:
        points = body.world_points()
        lifts = [
            points[:, 1] - np.interp((points[:, [0, 2]] - floor.foot_m) @ floor.uphill, floor.runs_m, floor.heights_m)
            for floor in floors
        ]
        if not (_is_sheet(body) or any(lift.max() <= _CARRIED_M for lift in lifts)):
            yield body


def _sections(thing: Thing, low_m: float, high_m: float) -> Iterator[shapely.Geometry]:
    """Yield the convex outlines of an object's horizontal sections, one between each two heights of its points."""
    heights = np.unique(np.concatenate([body.world_points()[:, 1].clip(low_m, high_m) for body in thing.bodies]))
    for level in ((heights[1:] + heights[:-1]) / 2).tolist():
        lines = [shapely.LineString(cut) for cut in section_of(thing, level) if len(cut) > 1]
        joined = shapely.union_all(shapely.buffer(lines, _TOUCH_M)) if lines else shapely.GeometryCollection()
        yield from (part.convex_hull for part in shapely.get_parts(joined))


def occupancy(level: BuiltLevel, grid: GridConfig) -> tuple[NDArray[np.int8], tuple[float, float]]:
    """Return the cells of `write_grid` as ROS has them, and the lower left corner (x, y) of the grid.

    Cells are int8, shape (rows, columns), the lowest row first: 0 if free, 100 if occupied, -1 if unknown. Raises as
    `write_grid`.
    """
    cells, raster = _occupancy(level, grid)
    values = np.full(256, -1, dtype=np.int8)
    values[_FREE], values[_OCCUPIED] = 0, 100
    return values[cells[::-1]], raster.origin_m


def _occupancy(level: BuiltLevel, grid: GridConfig) -> tuple[NDArray[np.uint8], "_Raster"]:
    floor = floor_of(level)
    raster = _Raster.around(floor, grid.resolution_m)
    cells = np.full(raster.shape, _UNKNOWN, dtype=np.uint8)
    raster.fill(cells, floor, _FREE)
    raster.fill(cells, _thickened(occupied_ground(level, grid.low_m, grid.high_m), grid.resolution_m), _OCCUPIED)
    return cells, raster


def grid_files(path: Path, grid: GridConfig, *, joint: str = "_") -> tuple[Path, ...]:
    """Return the files of `write_grid`, each YAML file before its picture."""
    masks = [name for name, is_asked in ((_KEEP_OUT_MASK, grid.keepout), (_SPEED_MASK, grid.speed)) if is_asked]
    maps = [path, *(_mask_file(path, joint, name) for name in masks)]
    return tuple(file for yaml in maps for file in (yaml, yaml.with_suffix(".pgm")))


def write_grid(level: BuiltLevel, path: Path, grid: GridConfig, *, joint: str = "_") -> tuple[Path, ...]:
    """Write the occupancy grid of a garage: a YAML file and its picture (PGM).

    Parameters
    ----------
    level
        The level.
    path
        The YAML file, in an existing folder. The picture ``<stem>.pgm`` is written beside it, as are requested masks,
        ``<stem>_keepout`` and ``<stem>_speed``, each a YAML file and a picture.
    grid
        Cell size, range of heights of obstacles, and choice of masks for nav2's keep-out and speed filters.
    joint
        Separator between the stem and the name of a mask.

    Returns
    -------
    tuple of Path
        The files.

    Raises
    ------
    ConfigError
        If there would be more than 400 million cells.
    StageError
        If the garage has no object of the class floor.

    Notes
    -----
    The frame is that of `garage2usd.maps.frame`; the origin is the lower left corner of the lower left cell, a multiple
    of the cell's side. A cell is occupied if a solid's footprint contains its middle or comes within a quarter of a
    cell of it. Footprints thinner than a cell are widened to one cell, so walls have no gaps. Cells of up to 5 cm stay
    free along the path of a car that keeps 5 cm clear of everything at least half a cell thick: their middles are at
    most 0.71 cells from the car, and occupied cells reach 0.25 cells beyond a solid. Other cells are free on the floor
    of garage and ramps, and unknown elsewhere.

    The masks have the mode raw, in which a grey is the value itself: 100 keeps out, and a speed is a percentage of the
    robot's own, 0 without a limit (filter type 1 with a base of 0 and a multiplier of 1).
    """
    cells, raster = _occupancy(level, grid)
    _write(path, cells, raster, "trinary")
    if grid.keepout:
        mask = np.zeros(raster.shape, dtype=np.uint8)
        raster.fill(mask, (stall.polygon for stall in level.stalls if stall.use in _KEPT_FREE), _KEEP_OUT)
        _write(_mask_file(path, joint, _KEEP_OUT_MASK), mask, raster, "raw")
    if grid.speed:
        mask = np.zeros(raster.shape, dtype=np.uint8)
        raster.fill(mask, ramp_floors(level), _RAMP_PERCENT)
        bumps = [solid.footprint.buffer(_BUMP_REACH_M) for solid in level.solids.standing("speed_bump")]
        raster.fill(mask, bumps, _BUMP_PERCENT)
        _write(_mask_file(path, joint, _SPEED_MASK), mask, raster, "raw")
    return grid_files(path, grid, joint=joint)


def _mask_file(path: Path, joint: str, name: str) -> Path:
    return path.with_stem(f"{path.stem}{joint}{name}")


@dataclass(frozen=True, slots=True)
class _Raster:
    """The raster of an occupancy grid.

    Attributes
    ----------
    side_m
        Side of a cell.
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
    def around(cls, floor: Grounds, side_m: float) -> "_Raster":
        """Create the raster that covers footprints (x, z) with a margin."""
        (left, high), (right, low) = map_points(shapely.total_bounds(floor).reshape(2, 2))
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
        """Lower left corner (x, y) of the grid in the map's frame."""
        return round(self.column * self.side_m, 6) + 0.0, round(self.row * self.side_m, 6) + 0.0

    def fill(self, cells: NDArray[np.uint8], grounds: Iterable[shapely.Geometry], value: int) -> None:
        """Fill the cells whose middles lie in polygons (x, z), or on their left or lower border.

        Notes
        -----
        Scan conversion by the nonzero winding rule (Foley et al., Computer Graphics: Principles and Practice, 3.5): in
        each row of cells the middles to the right of where a side crosses it count one winding more or less.
        """
        start, end = self._sides(grounds)
        start, end = (points[start[:, 1] != end[:, 1]] for points in (start, end))
        rises = end[:, 1] > start[:, 1]
        low, high = (np.where(rises[:, None], *pair) for pair in ((start, end), (end, start)))
        slope = (high[:, 0] - low[:, 0]) / (high[:, 1] - low[:, 1])
        rows, columns = self.shape
        for band in range(0, rows, _BAND_ROWS):
            above = min(band + _BAND_ROWS, rows)
            first, last = (np.ceil(points[:, 1]).clip(band, above).astype(np.int64) for points in (low, high))
            side = np.repeat(np.arange(len(first)), last - first)
            row = np.arange(len(side)) - np.repeat(np.cumsum(last - first) - last, last - first)
            column = np.ceil(low[side, 0] + (row - low[side, 1]) * slope[side]).clip(0, columns).astype(np.int64)
            windings = np.zeros((above - band, columns + 1), dtype=np.int32)
            steps = np.where(rises[side], -1, 1).astype(np.int32)
            np.add.at(windings.ravel(), (row - band) * (columns + 1) + column, steps)
            inside = np.cumsum(windings, axis=1, dtype=np.int32)[::-1, :-1] != 0
            np.putmask(cells[rows - above : rows - band], inside, value)

    def _sides(self, grounds: Iterable[shapely.Geometry]) -> tuple[Floats, Floats]:
        """Return both ends of each polygon edge in cells from the middle of the lower left cell, shape (sides, 2).

        Outlines run counter-clockwise, holes clockwise.
        """
        areas = shapely.transform(shapely.get_parts(np.array([*grounds], dtype=object)), map_points)
        rings = shapely.get_rings(shapely.orient_polygons(areas))
        corners, ring = shapely.get_coordinates(rings, return_index=True)
        places = corners / self.side_m - 0.5 - (self.column, self.row)
        goes_on = ring[1:] == ring[:-1]
        return places[:-1][goes_on], places[1:][goes_on]


def _thickened(grounds: Iterable[shapely.Geometry], side_m: float) -> Grounds:
    """Buffer convex footprints by a quarter of a cell, after widening them to at least one cell."""
    outlines = np.array([*grounds], dtype=object)
    thickened: Grounds = shapely.buffer(
        outlines, np.maximum(_NEAR_CELLS * side_m, (side_m - _thicknesses_m(outlines)) / 2), quad_segs=_ARC_SIDES
    )
    return thickened


def _thicknesses_m(grounds: Grounds) -> Floats:
    """Measure the shorter side of the minimum rectangle around each convex footprint; 0 for a line or a point."""
    boxes = shapely.oriented_envelope(grounds)
    thicknesses = np.zeros(len(boxes))
    are_areas = (shapely.get_type_id(boxes) == shapely.GeometryType.POLYGON) & ~shapely.is_empty(boxes)
    corners = shapely.get_coordinates(boxes[are_areas]).reshape(-1, 5, 2)
    thicknesses[are_areas] = np.linalg.norm(np.diff(corners[:, :3], axis=1), axis=2).min(axis=1)
    return thicknesses


def _write(path: Path, cells: NDArray[np.uint8], raster: _Raster, mode: str) -> None:
    picture = path.with_suffix(".pgm")
    rows, columns = raster.shape
    with picture.open("wb") as file:
        file.write(b"P5\n%d %d\n255\n" % (columns, rows))
        file.write(cells.data)
    x, y = raster.origin_m
    path.write_text(
        f"image: {_quoted(picture.name)}\nmode: {_quoted(mode)}\nresolution: {raster.side_m}\n"
        f"origin: [{x}, {y}, 0.0]\nnegate: 0\n"
        f"occupied_thresh: {_OCCUPIED_THRESHOLD}\nfree_thresh: {_FREE_THRESHOLD}\n",
        encoding="utf-8",
        newline="\n",
    )


def _quoted(text: str) -> str:
    """Quote a text in double quotes of YAML 1.1 and 1.2, with unprintable characters escaped."""
    signs = (f"\\{sign}" if sign in '"\\' else sign if sign.isprintable() else f"\\U{ord(sign):08x}" for sign in text)
    return f'"{"".join(signs)}"'
