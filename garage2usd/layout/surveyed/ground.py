"""The floor of a surveyed garage: its outline, and the tiles into which lines of columns and walls divide it."""

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.common.errors import ConfigError
from garage2usd.layout.placement import Placement
from garage2usd.objects.kind import Point, Polygon
from garage2usd.structure.grid import Cell, Structure
from garage2usd.structure.lane_graph import Square
from garage2usd.survey.survey import Ground, SurveyedColumn

PIECE_M = 8.1
"""Usual side of a piece of floor."""
OFF_LINE_M = 0.15
"""Greatest distance of a column from the line of its row."""
_MOST_PIECES = 1.5
"""Length of a stretch in usual pieces from which it is cut although no line crosses it."""
_LEAST_SIDE_M = 1.5
"""Least distance between two lines."""
_LEAST_WALL_M = 3.0
"""Least length of a wall that makes a line."""
_AXIS_M = 1e-3
_MOST_SPAN_M = 25.0
"""Greatest distance between two lines that beams span."""
_FIELD = 0.9
"""Share of a field between lines from which it lies inside the outline."""
_MOST_SIDE_M = 2000.0
_LEAST_M2 = 1e-3
_DIGITS = 6
_FILLED = 0.85
"""Least share of its rectangle that a ground fills to be taken for it."""
_TOUCH_M = 0.05
_MOST_LINES = 16
"""Greatest number of corners along an axis between which rectangles are tried."""


class StructuralLines(NamedTuple):
    """Places of the lines across X and across Z, in metres from the origin, ascending; the first and last are walls."""

    x_m: tuple[float, ...]
    z_m: tuple[float, ...]

    def cuts_m(self, start: Point, end: Point) -> list[float]:
        """Return the distances at which to cut a stretch: at the lines across it, and between lines far apart.

        Parameters
        ----------
        start, end
            (x, z) of its ends.

        Returns
        -------
        list of float
            Ascending from 0 to its length, which are included.
        """
        length_m = math.dist(start, end)
        found = [0.0]
        for axis, lines in enumerate(self):
            if abs(end[1 - axis] - start[1 - axis]) > _AXIS_M:
                continue
            way = 1 if end[axis] > start[axis] else -1
            found += sorted(run for line in lines if _LEAST_SIDE_M <= (run := way * (line - start[axis])) < length_m)
        found = [run for run in found if length_m - run >= _LEAST_SIDE_M or not run]
        cuts: list[float] = []
        for low, high in pairwise([*found, length_m]):
            parts = math.ceil((high - low) / PIECE_M - 1e-9) if high - low > _MOST_PIECES * PIECE_M else 1
            cuts += [low + (high - low) * part / parts for part in range(parts)]
        return [*cuts, length_m]


def structural_lines(outline: Ground, columns: Sequence[SurveyedColumn]) -> StructuralLines:
    """Find the lines of walls along the axes, and of rows of two columns or more.

    Parameters
    ----------
    outline
        Inner faces of the outer walls; its least x and z are 0.
    columns
        The columns.
    """
    rings = [shapely.get_coordinates(part.exterior) for part in shapely.get_parts(outline)]
    sides = np.concatenate([np.stack([ring[:-1], ring[1:]]) for ring in rings], axis=1)
    feet = np.array([column.centre for column in columns]).reshape(-1, 2)
    return StructuralLines(*(_lines_m(feet[:, axis], sides, axis) for axis in (0, 1)))


def _lines_m(feet_m: NDArray[np.float64], sides: NDArray[np.float64], axis: int) -> tuple[float, ...]:
    starts, ends = sides
    is_across = np.abs(ends[:, axis] - starts[:, axis]) < _AXIS_M
    is_long = np.linalg.norm(ends - starts, axis=1) >= _LEAST_WALL_M
    last = math.ceil(round(float(starts[:, axis].max()) * 1000, 3)) / 1000
    walls = sorted(starts[is_across & is_long, axis].round(3).tolist())
    ordered = np.sort(feet_m)
    rows = np.split(ordered, np.flatnonzero(np.diff(ordered) > OFF_LINE_M) + 1) if len(ordered) else []
    columns = [round(float(row.mean()), 3) for row in rows if len(row) > 1]
    found = [0.0, last]
    for line in (*walls, *columns):
        if all(abs(line - other) >= _LEAST_SIDE_M for other in found):
            found.append(line)
    return tuple(sorted(found))


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
        """Return the part of a shape that lies on the tile, as polygons in the coordinates of the tile."""
        parts = shapely.get_parts(shapely.intersection(shape, self.box, grid_size=10**-_DIGITS))
        x, z = self.middle_m
        return [
            tuple((round(px - x, _DIGITS), round(pz - z, _DIGITS)) for px, pz in part.exterior.coords[:-1])
            for part in parts
            if part.geom_type == "Polygon" and part.area > _LEAST_M2
        ]


class SurveyedGround:
    """The ground inside the outlines of a surveyed garage.

    Parameters
    ----------
    outlines
        Inner faces of the outer walls of each lot, (x, z) in metres; their least x and z are 0.
    columns
        The columns, by whose rows the floor is cut into tiles.

    Raises
    ------
    ConfigError
        If an outline crosses itself, or all together are too large.
    """

    def __init__(self, outlines: Sequence[tuple[Point, ...]], columns: Sequence[SurveyedColumn] = ()) -> None:
        lots = [shapely.Polygon(outline) for outline in outlines]
        for outline, lot in zip(outlines, lots, strict=True):
            if len(outline) < 3 or not lot.is_valid or lot.area < 1.0:  # noqa: PLR2004 - a triangle
                raise ConfigError("outline", list(outline), "three corners or more around an area, without crossings")
        polygon = shapely.MultiPolygon(lots) if len(lots) > 1 else lots[0]
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
        """Return the rectangles between lines as a structure; those mostly outside the outline are obstacles."""
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
        """Return groups of objects, each object of a floor piece assigned to the tile that it stands on.

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


def rectangles(ground: shapely.Polygon, least_m: float) -> Iterator[shapely.Polygon]:
    """Fill a ground with rectangles of a least side: the largest one first, then those that fill the rest."""
    rest = [ground]
    while rest:
        part = rest.pop()
        box = shapely.box(*part.bounds)
        if part.area < least_m**2:
            continue
        if part.area < _FILLED * box.area:
            inner = _largest_rectangle(part, least_m)
            if inner is None:
                continue
            rest += [piece for piece in shapely.get_parts(part.difference(inner)) if piece.geom_type == "Polygon"]
            box = inner
        left, top, right, bottom = box.bounds
        if min(right - left, bottom - top) >= least_m:
            yield box


def _largest_rectangle(ground: shapely.Polygon, least_m: float) -> shapely.Polygon | None:
    """Return the largest axis-aligned rectangle inside a ground with its sides at coordinates of the corners.

    For a ground with many corners, only some of them are considered.
    """
    corners = shapely.get_coordinates(ground).round(2)
    (left, right), (top, bottom) = (_spans(corners[:, axis], least_m) for axis in (0, 1))
    boxes = shapely.box(left, top[:, None], right, bottom[:, None]).ravel()
    areas = shapely.area(boxes).round(3)
    wide = ground.buffer(_TOUCH_M, join_style="mitre")
    shapely.prepare(wide)
    # testing the corners rejects most boxes, and is much faster than testing the whole box
    x0, z0, x1, z1 = shapely.bounds(boxes).T
    is_possible = np.all([shapely.contains_xy(wide, x, z) for x, z in ((x0, z0), (x1, z0), (x1, z1), (x0, z1))], axis=0)
    order = np.argsort(-areas, kind="stable")
    return next((boxes[index] for index in order[is_possible[order]].tolist() if wide.covers(boxes[index])), None)


def _spans(places_m: NDArray[np.float64], least_m: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the starts and ends of all spans of a least length between places, of at most `_MOST_LINES` places."""
    lines = np.unique(places_m)
    if len(lines) > _MOST_LINES:
        lines = lines[np.linspace(0, len(lines) - 1, _MOST_LINES).round().astype(int)]
    start, end = np.triu_indices(len(lines), k=1)
    is_long = lines[end] - lines[start] >= least_m
    return lines[start[is_long]], lines[end[is_long]]
