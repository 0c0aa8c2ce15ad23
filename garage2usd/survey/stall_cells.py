"""Stalls of drawn lines: the cells between parallel lines, a line behind them and walls, closed at their mouths."""

from collections.abc import Iterable, Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.garage import Point
from garage2usd.survey.parts import corners_of

Floats = NDArray[np.float64]

_LEAST_WIDTH_M, _MOST_WIDTH_M = 1.7, 4.3
_LEAST_LENGTH_M, _MOST_LENGTH_M = 3.4, 9.0
_LEAST_AREA_M2, _MOST_AREA_M2 = 7.5, 32.0
_LEAST_SINE = 0.4
"""Sine of the sharpest angle between the sides of a stall."""
_COMB_M = 2.5
"""Least length of a line beside a stall."""
_ODD_WIDTH_M, _ODD_LENGTH_M = (0.9, 5.0), (1.8, 16.0)
_GAP_M = 0.05
"""Gap up to which lines meet."""
_MOST_MOUTH_M = 6.0
_PARALLEL = 0.996
_SAME_WIDTH = 0.25
_FILLED = 0.85
"""Share of a rectangle from which on a cell with notches, as of columns, is the rectangle."""
_GRID_M = 1e-4
_CORNERS = 4


def stall_corners(ring: Iterable[Sequence[float]]) -> tuple[Point, ...] | None:
    """Return the corners (x, z) of a ring that has the size of a stall, or None.

    A stall is a rectangle or parallelogram 1.7 to 4.3 m wide and 3.4 to 9 m long; one with notches of up to 15 % of its
    area, as of columns, counts as its rectangle.
    """
    points = np.array([place[:2] for place in ring])
    if not _LEAST_AREA_M2 <= _area_m2(points) <= _MOST_AREA_M2 or np.ptp(points, axis=0).max() > _MOST_LENGTH_M:
        return None
    corners = corners_of(points.tolist())
    if len(corners) > _CORNERS:
        polygon = shapely.Polygon(corners)
        around = shapely.oriented_envelope(polygon)
        if not polygon.is_valid or around.geom_type != "Polygon" or polygon.area < _FILLED * around.area:
            return None
        corners = corners_of(around.exterior.coords)
    if len(corners) != _CORNERS:
        return None
    first, second, area_m2, skew_m = _measures(corners)
    length_m = max(first, second)
    is_stall = (
        _LEAST_LENGTH_M <= length_m <= _MOST_LENGTH_M
        and _LEAST_WIDTH_M <= area_m2 / length_m <= _MOST_WIDTH_M
        and _LEAST_AREA_M2 <= area_m2 <= _MOST_AREA_M2
        and area_m2 >= _LEAST_SINE * first * second
        and skew_m < _SAME_WIDTH * (first + second)
    )
    return corners if is_stall else None


def quad_corners(ring: Iterable[Sequence[float]]) -> tuple[Point, ...] | None:
    """Return the corners (x, z) of a ring of four that may be the stall of a motorcycle or a coach, or None."""
    corners = corners_of(ring)
    if len(corners) != _CORNERS:
        return None
    first, second, area_m2, _ = _measures(corners)
    short, long = _ODD_WIDTH_M, _ODD_LENGTH_M
    is_odd = (
        min(first, second) >= short[0] and long[0] <= max(first, second) <= long[1] and min(first, second) <= short[1]
    )
    return corners if is_odd and area_m2 >= _LEAST_SINE * first * second else None


def _area_m2(points: Floats) -> float:
    """Return the area of a ring by the shoelace formula."""
    x, z = (points - points.mean(axis=0)).T
    return float(abs(x @ np.roll(z, -1) - z @ np.roll(x, -1)) / 2)


def _measures(corners: tuple[Point, ...]) -> tuple[float, float, float, float]:
    """Return the mean lengths in metres of both pairs of sides, the area, and the differences within the pairs."""
    lengths_m = np.hypot(*(np.roll(corners, -1, axis=0) - np.array(corners)).T)
    first, second = (lengths_m[0] + lengths_m[2]) / 2, (lengths_m[1] + lengths_m[3]) / 2
    skew_m = abs(lengths_m[0] - lengths_m[2]) + abs(lengths_m[1] - lengths_m[3])
    return float(first), float(second), float(shapely.Polygon(corners).area), float(skew_m)


def stall_cells(lines: Sequence[Floats], bounds: Sequence[Floats]) -> list[tuple[Point, ...]]:
    """Return the corners (x, z) of all cells of the size of stalls between lines.

    Parameters
    ----------
    lines
        Markings of stalls, (x, z) in metres; float64, shape (n, 2) each.
    bounds
        Walls and outlines, which may bound stalls too.

    Notes
    -----
    Lines with free ends, the teeth of a comb, are joined at these to the next ones beside them, and the last of a row
    to a wall as far away as the lines before it. The cells are the faces of the arrangement of all lines.
    """
    marked, walls = _segments(lines), _segments(bounds)
    if len(marked) == 0:
        return []
    segments = np.concatenate([marked, walls, _closers(marked, walls)])
    along = segments[:, 1] - segments[:, 0]
    off = along / np.hypot(*along.T)[:, None] * _GAP_M
    longer = shapely.linestrings(np.stack([segments[:, 0] - off, segments[:, 1] + off], axis=1))
    faces = shapely.get_parts(shapely.polygonize([shapely.union_all(longer, grid_size=_GRID_M)]))
    areas_m2 = shapely.area(faces)
    usual = faces[(areas_m2 > _LEAST_AREA_M2) & (areas_m2 < _MOST_AREA_M2)]
    found = (stall_corners(face.exterior.coords) for face in shapely.normalize(usual))
    return [corners for corners in found if corners is not None]


def _segments(lines: Sequence[Floats]) -> Floats:
    """Return the segments of lines without those shorter than a gap; shape (n, 2, 2)."""
    pairs = [np.stack([line[:-1], line[1:]], axis=1) for line in lines if len(line) > 1]
    segments = np.concatenate(pairs) if pairs else np.empty((0, 2, 2))
    lengths_m = np.hypot(*(segments[:, 1] - segments[:, 0]).T)
    kept = segments[lengths_m > _GAP_M].round(6)
    unique: Floats = np.unique(kept, axis=0)
    return unique


def _closers(marked: Floats, walls: Floats) -> Floats:
    """Return segments that close the mouths between lines with free ends; shape (n, 2, 2)."""
    along = marked[:, 1] - marked[:, 0]
    lengths_m = np.hypot(*along.T)
    teeth = np.flatnonzero(lengths_m > _COMB_M)
    lines = shapely.linestrings(np.concatenate([marked, walls]))
    tree, around = shapely.STRtree(lines), shapely.buffer(lines[teeth], _GAP_M)
    ends, outwards = [], []
    for end in (0, 1):
        points = marked[teeth, end]
        beside = tree.query(shapely.points(points), predicate="dwithin", distance=_GAP_M)
        # its own line is always there, and so may be copies of it or of parts of it
        lies = ~shapely.within(lines[beside[1]], around[beside[0]])
        touched = np.bincount(beside[0][lies], minlength=len(teeth)) > 0
        ends.append(points[~touched])
        outwards.append((along[teeth] / lengths_m[teeth, None])[~touched] * (1 if end else -1))
    free, out = np.concatenate(ends), np.concatenate(outwards)
    if len(free) == 0:
        return np.empty((0, 2, 2))
    near = shapely.STRtree(shapely.points(free))
    wall_tree = shapely.STRtree(shapely.linestrings(walls))
    closers = []
    for number, point in enumerate(free):
        others = near.query(shapely.Point(point), predicate="dwithin", distance=_MOST_MOUTH_M)
        others = others[(out[others] @ out[number]) > _PARALLEL]
        ways = free[others] - point
        across_m = out[number][0] * ways[:, 1] - out[number][1] * ways[:, 0]
        sides: dict[int, Floats] = {}
        for side in (1, -1):
            there = np.flatnonzero((side * across_m >= _LEAST_WIDTH_M) & (side * across_m <= _MOST_WIDTH_M))
            if len(there):
                nearest = min(there, key=lambda index: (round(float(np.hypot(*ways[index])), 3), index))
                sides[side] = ways[nearest]
                closers.append([point, point + ways[nearest]])
        if len(sides) == 1:  # the last of its row
            ((_, way),) = sides.items()
            ray = shapely.LineString([point, point - way * (1 + _SAME_WIDTH)])
            hits = [
                hit
                for wall in wall_tree.query(ray, predicate="intersects").tolist()
                for hit in shapely.get_coordinates(shapely.LineString(walls[wall]).intersection(ray))
            ]
            if hits:
                hit = min(hits, key=lambda place: float(np.hypot(*(place - point))))
                if np.hypot(*(hit - point)) >= (1 - _SAME_WIDTH) * np.hypot(*way):
                    closers.append([point, hit])
    return np.array(closers).reshape(-1, 2, 2)
