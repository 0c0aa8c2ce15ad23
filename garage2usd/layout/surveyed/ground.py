"""The floor of a surveyed garage: its outline, divided into tiles that group the objects over them."""

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
import shapely

from garage2usd.common.errors import ConfigError
from garage2usd.layout.placement import Placement
from garage2usd.layout.surveyed.lines import structural_lines
from garage2usd.objects.outline import Point, Polygon
from garage2usd.structure.grid import Cell, Structure
from garage2usd.structure.lane_graph import Square
from garage2usd.survey.survey import SurveyedColumn

__all__ = ["GroundTile", "SurveyedGround"]

_MOST_SPAN_M = 25.0
"""Greatest distance between two lines that beams span."""
_FIELD = 0.9
"""Share of a field between lines from which it lies inside the outline."""
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
    columns
        The columns, by whose rows the floor is cut into tiles.

    Raises
    ------
    ConfigError
        If the outline crosses itself or is too large.
    """

    def __init__(self, outline: tuple[Point, ...], columns: Sequence[SurveyedColumn] = ()) -> None:
        polygon = shapely.Polygon(outline)
        if len(outline) < 3 or not polygon.is_valid or polygon.area < 1.0:  # noqa: PLR2004 - a triangle
            raise ConfigError("outline", list(outline), "three corners or more around an area, without crossings")
        _, _, width_m, depth_m = polygon.bounds
        if max(width_m, depth_m) > _MOST_SIDE_M:
            raise ConfigError("outline", f"{width_m:.1f} by {depth_m:.1f} m", f"at most {_MOST_SIDE_M:g} m a side")
        self.polygon = shapely.orient_polygons(polygon)
        self.lines = structural_lines(self.polygon, columns)
        spans_m = [float(np.diff(lines).max()) for lines in self.lines]
        self.fields = self._structure(self.lines.x_m, self.lines.z_m, _FIELD) if max(spans_m) < _MOST_SPAN_M else None
        """The fields between its lines, those outside being obstacles; None where lines are too far apart for beams."""
        x_m = self.lines.cuts_m((0.0, 0.0), (self.lines.x_m[-1], 0.0))
        self.structure = self._structure(x_m, self.lines.cuts_m((0.0, 0.0), (0.0, self.lines.z_m[-1])), 0.0)
        cells = self.structure.cells
        self.tiles = {square: tile for square, tile in self._all.items() if cells[square] != Cell.OBSTACLE}

    def _structure(self, x_m: Sequence[float], z_m: Sequence[float], least: float) -> Structure:
        """Return rectangles between lines, as obstacles where at most a share of them lies inside the outline."""
        x, z = (np.round(np.array(lines) * 1000) / 1000 for lines in (x_m, z_m))
        boxes = shapely.box(x[:-1], z[:-1, None], x[1:], z[1:, None])
        inside = shapely.area(shapely.intersection(boxes, self.polygon))
        cells = np.where(inside >= np.maximum(least * shapely.area(boxes), _LEAST_M2), Cell.FREE, Cell.OBSTACLE)
        return Structure.from_arrays(cells.astype(np.int8), np.diff(x), np.diff(z))

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

    def on_tiles(self, parts: Iterable[Iterable[Placement]]) -> Iterator[Iterable[Placement]]:
        """Return groups of objects with those of pieces of the floor on the tiles that they stand over.

        Names stay unique on each tile.
        """
        used: Counter[tuple[Square, str]] = Counter()
        return ([self._on_tile(place, used) for place in part] for part in parts)

    def _on_tile(self, place: Placement, used: "Counter[tuple[Square, str]]") -> Placement:
        if place.square is None or place.square in self.tiles:
            return place
        x, _, z = place.position_m
        square = self.square_at((x, z))
        used[square, place.name] += 1
        count = used[square, place.name]
        name = place.name if count == 1 else f"{place.name}_{count}x"
        return replace(place, square=square, name=name)
