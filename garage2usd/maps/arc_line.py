"""A reference line of straights and arcs through the places of a lane that bends anyhow."""

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.maps.road_nodes import Arc, Point, ReferenceLine
from garage2usd.native import elementary

_WITHIN_M = 0.01
"""Greatest distance of the places from the line."""
_LONGER, _LONG_M = 3.0, 1.5
"""A piece this many times as long as its neighbour, and longer than that, is a straight; others are chords of arcs."""
_STRAIGHT_PER_M, _ALIKE_PER_M = 1e-6, 1e-4
"""Greatest curvature of a straight, and difference between the curvatures of two arcs that are one."""
_MOST_RAD = math.pi / 2


def line_of_arcs(places: Sequence[Point]) -> tuple[ReferenceLine, list[float]]:
    """Return a smooth line through some places, and the distance along it of each.

    Between two places it is a biarc: two arcs that touch each other and the line's headings at both, which at a place
    are those of the circle through it and its neighbours. Places between are left out while they lie within a
    centimetre of the biarc.

    Parameters
    ----------
    places
        Two points or more, in metres, none of them equal to the one before.
    """
    headings = _headings(np.array(places))
    arcs: list[Arc] = []
    runs, alongs, first = [0.0], [0.0], 0
    for one, other in pairwise(places):
        alongs.append(alongs[-1] + math.dist(one, other))
    while first < len(places) - 1:
        heading = arcs[-1].heading_rad + arcs[-1].length_m * arcs[-1].curvature_per_m if arcs else headings[0]
        start = arcs[-1].at(arcs[-1].length_m)[:2] if arcs else places[0]
        last, found = first + 1, _biarc(start, heading, places[first + 1], headings[first + 1])
        for beyond in range(first + 2, len(places)):
            if abs(headings[beyond] - headings[first]) > _MOST_RAD:
                break
            longer = _biarc(start, heading, places[beyond], headings[beyond])
            if _apart_m(longer, places[first + 1 : beyond]) > _WITHIN_M:
                break
            last, found = beyond, longer
        length_m = sum(arc.length_m for arc in found)
        share = length_m / (alongs[last] - alongs[first])
        begin_m = runs[-1]
        runs += [begin_m + share * (along - alongs[first]) for along in alongs[first + 1 : last + 1]]
        arcs += found
        first = last
    return ReferenceLine(tuple(arcs)), runs


def _headings(places: NDArray[np.float64]) -> list[float]:
    """Return the heading of the line at each place, continuous along it."""
    steps = np.diff(places, axis=0)
    lengths = np.hypot(steps[:, 0], steps[:, 1]).tolist()
    ways = [elementary.arctan2(float(y), float(x)) for x, y in steps]
    for number in range(1, len(ways)):
        ways[number] = ways[number - 1] + math.remainder(ways[number] - ways[number - 1], math.tau)
    found = [ways[0]]
    for before, after, length, next_length in zip(ways[:-1], ways[1:], lengths[:-1], lengths[1:], strict=True):
        if length > max(_LONGER * next_length, _LONG_M):
            found.append(before)
        elif next_length > max(_LONGER * length, _LONG_M):
            found.append(after)
        else:
            found.append((before * next_length + after * length) / (length + next_length))
    return [*found, ways[-1]]


def _biarc(start: Point, heading_rad: float, end: Point, end_heading_rad: float) -> list[Arc]:
    """Return two arcs from a place and heading to another, whose tangents at the ends are equally long."""
    way, end_way = _way(heading_rad), _way(end_heading_rad)
    apart = end[0] - start[0], end[1] - start[1]
    both = way[0] + end_way[0], way[1] + end_way[1]
    square, linear = 2 * (1 - _dot(way, end_way)), 2 * _dot(apart, both)
    constant = _dot(apart, apart)
    # of d in square d^2 + linear d = constant, in the form that holds for a square of nearly 0
    tangent_m = 2 * constant / (linear + math.sqrt(max(linear**2 + 4 * square * constant, 0.0)))
    middle = (
        (start[0] + end[0] + tangent_m * (way[0] - end_way[0])) / 2,
        (start[1] + end[1] + tangent_m * (way[1] - end_way[1])) / 2,
    )
    first = _arc(start, heading_rad, middle)
    second = _arc(middle, heading_rad + first.length_m * first.curvature_per_m, end)
    is_one = abs(first.curvature_per_m - second.curvature_per_m) < _ALIKE_PER_M
    return [_arc(start, heading_rad, end)] if is_one else [first, second]


def _arc(start: Point, heading_rad: float, end: Point) -> Arc:
    """Return the arc from a place and heading to another place."""
    (x, y), apart = _way(heading_rad), (end[0] - start[0], end[1] - start[1])
    chord_m = math.hypot(*apart)
    across, along = x * apart[1] - y * apart[0], x * apart[0] + y * apart[1]
    curvature = 2 * across / chord_m**2
    if abs(curvature) < _STRAIGHT_PER_M:
        return Arc(start, heading_rad, chord_m)
    return Arc(start, heading_rad, 2 * elementary.arctan2(across, along) / curvature, curvature)


def _apart_m(arcs: Sequence[Arc], places: Sequence[Point]) -> float:
    """Return the greatest distance of places from arcs."""
    line = ReferenceLine(tuple(arcs))
    runs = np.linspace(0.0, line.length_m, 4 * len(places) + 8)
    drawn = shapely.LineString([line.at(run)[:2] for run in runs.tolist()])
    return float(shapely.distance(drawn, shapely.points(places)).max())


def _way(heading_rad: float) -> Point:
    return elementary.cos(heading_rad), elementary.sin(heading_rad)


def _dot(one: Point, other: Point) -> float:
    return one[0] * other[0] + one[1] * other[1]
