"""The floor of a surveyed garage: its outline, divided into tiles that group the objects over them."""

import math
from collections.abc import Iterator
from functools import cached_property
from typing import NamedTuple

import numpy as np
import shapely

from garage2usd.common.errors import ConfigError
from garage2usd.objects.outline import Point, Polygon
from garage2usd.structure.grid import Cell, Structure
from garage2usd.structure.lane_graph import Square

__all__ = ["GroundTile", "SurveyedGround"]

_TILE_M = 8.1
"""Greatest side of a tile in metres."""
_MOST_SIDE_M = 2000.0
_LEAST_M2 = 1e-3
_DIGITS = 6


class GroundTile(NamedTuple):
    """A rectangular tile of the floor: its (row, col), its middle (x, z), and its extent along X and Z in metres."""

    square: Square
    middle_m: Point
    width_m: float
    depth_m: float

    @property
    def box(self) -> shapely.Polygon:
        """The tile's ground."""
        (x, z), half_x, half_z = self.middle_m, self.width_m / 2, self.depth_m / 2
        return shapely.box(x - half_x, z - half_z, x + half_x, z + half_z)

    def local(self, shape: shapely.Geometry) -> list[Polygon]:
        """Return the polygons of a shape as far as they lie on the tile, in its coordinates."""
        parts = shapely.get_parts(shapely.intersection(shape, self.box, grid_size=10**-_DIGITS))
        x, z = self.middle_m
        return [
            tuple((round(px - x, _DIGITS), round(pz - z, _DIGITS)) for px, pz in part.exterior.coords[:-1])
            for part in parts
            if part.geom_type == "Polygon" and part.area > _LEAST_M2
        ]


class SurveyedGround:
    """The ground inside the outline of a surveyed garage.

    Parameters
    ----------
    outline
        Inner faces of the outer walls, (x, z) in metres; its least x and z are 0.

    Raises
    ------
    ConfigError
        If the outline crosses itself or is too large.
    """

    def __init__(self, outline: tuple[Point, ...]) -> None:
        polygon = shapely.Polygon(outline)
        if len(outline) < 3 or not polygon.is_valid or polygon.area < 1.0:  # noqa: PLR2004 - a triangle
            raise ConfigError("outline", list(outline), "three corners or more around an area, without crossings")
        _, _, width_m, depth_m = polygon.bounds
        if max(width_m, depth_m) > _MOST_SIDE_M:
            raise ConfigError("outline", f"{width_m:.1f} by {depth_m:.1f} m", f"at most {_MOST_SIDE_M:g} m a side")
        self.polygon = shapely.orient_polygons(polygon)
        columns, rows = _sides_mm(width_m), _sides_mm(depth_m)
        cells = np.full((len(rows), len(columns)), Cell.FREE, np.int8)
        self.structure = Structure.from_arrays(cells, np.array(columns) / 1000, np.array(rows) / 1000)
        outside = [square for square, tile in self._all.items() if tile.box.intersection(polygon).area < _LEAST_M2]
        for square in outside:
            cells[square] = Cell.OBSTACLE
        self.structure = Structure.from_arrays(cells, np.array(columns) / 1000, np.array(rows) / 1000)
        self.tiles = {square: tile for square, tile in self._all.items() if square not in set(outside)}

    @cached_property
    def _all(self) -> dict[Square, GroundTile]:
        x, z = self.structure.column_edges_m, self.structure.row_edges_m
        return {
            (row, col): GroundTile(
                (row, col),
                (float(x[col] + x[col + 1]) / 2, float(z[row] + z[row + 1]) / 2),
                float(x[col + 1] - x[col]),
                float(z[row + 1] - z[row]),
            )
            for row in range(len(z) - 1)
            for col in range(len(x) - 1)
        }

    def __iter__(self) -> Iterator[GroundTile]:
        """Iterate over the tiles in reading order."""
        return iter(self.tiles.values())

    def square_at(self, point: Point) -> Square:
        """Return the (row, col) of the tile at a point, or of the nearest one with ground inside the outline."""
        x, z = self.structure.column_edges_m, self.structure.row_edges_m
        row, col = (
            int(np.clip(np.searchsorted(edges, at, side="right") - 1, 0, len(edges) - 2))
            for edges, at in ((z, point[1]), (x, point[0]))
        )
        if (row, col) in self.tiles:
            return row, col
        return min(self.tiles, key=lambda square: (round(math.dist(self.tiles[square].middle_m, point), 6), square))


def _sides_mm(side_m: float) -> list[int]:
    """Divide a side into equal tiles, in whole millimetres; the last one is as much longer as is left."""
    side_mm = math.ceil(round(side_m * 1000, 3))
    count = max(1, math.ceil(side_mm / (_TILE_M * 1000)))
    each = side_mm // count
    return [each] * (count - 1) + [side_mm - each * (count - 1)]
