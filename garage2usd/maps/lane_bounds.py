"""Lane bounds as polylines, shared by adjacent lanes, in the points of a Lanelet2 map."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import chain

import numpy as np

from garage2usd.maps.network import LEFT, RIGHT, Network, Road
from garage2usd.maps.osm_file import APART_M, OsmFile, Place

_SAG_M = 1e-3
"""Greatest deviation of a polyline from its lane bound, where its points are `APART_M` from one another."""
_LEAST_M = 1e-6
SAME_M = 1e-3
"""Distance between the middles of two bounds of the same ends up to which they are one."""
_CHORD = 1.02
"""Ratio of arc to chord that is allowed for in the least distance between points."""
_LEAST_TURN, _CORNER_M, _CORNERS = 0.3, 0.075, 5
"""Sine of the least turn of a bend tighter than its lane is wide; its ends lie one to four steps from their corner."""
_ASIDE_M = 0.01
"""Step along a bound in which points are moved away from others."""
_MOST_STEPS = 2.0
"""Greatest distance between two points in steps of `_SAG_M`, where other points are in the way."""
_MOST_EASED_BEND, _MOST_EASED_SLOPE = 6.0, 1.5
"""Greatest second and first derivative of the easing curve for lane widths, from 0 to 1 along a road of length 1."""


@dataclass(eq=False)
class Bound:
    """A bound of a lane.

    Attributes
    ----------
    road, side
        The road, and the bound's number from left to right: 0, 1 between the lanes, 2.
    points
        Ids of the points of the polyline along the road.
    places
        Positions of the points.
    """

    road: Road
    side: int
    points: list[int] = field(default_factory=list)
    places: list[Place] = field(default_factory=list)

    @property
    def is_middle(self) -> bool:
        """True for the line between the two lanes of a straight road, where the middle line is painted."""
        road = self.road
        return self.side == 1 and road.lanes == (LEFT, RIGHT) and road.line.is_straight and road.junction is None

    def offset_m(self, run_m: float) -> float:
        """Return the distance from the road's reference line to the bound, to the left."""
        lanes = self.road.lanes_at(run_m)
        return (lanes.middle_m + lanes.left_m, lanes.middle_m, lanes.middle_m - lanes.right_m)[self.side]

    def at(self, run_m: float) -> Place:
        """Return the point of the bound at a distance along the road."""
        return (*self.road.line.beside(run_m, self.offset_m(run_m)), self.road.height_m(run_m))


@dataclass(frozen=True, eq=False)
class LaneBounds:
    """A lane with its left and right bound.

    Attributes
    ----------
    road, lane
        The road, and the number of the lane in it.
    left, right
        Bounds to the driver's left and right; their points are in the road's order.
    """

    road: Road
    lane: int
    left: Bound
    right: Bound

    @property
    def outer(self) -> tuple[Bound, ...]:
        """The bounds on the edge of the road."""
        if self.road.lanes == (LEFT, RIGHT):
            return (self.left if self.road.keeps_left else self.right,)
        return (self.left, self.right)

    @property
    def is_against(self) -> bool:
        """True if traffic runs against the road's direction."""
        return self.road.is_against(self.lane)

    def driven(self, points: Mapping[Bound, Sequence[int]]) -> tuple[list[int], list[int]]:
        """Return the points of both bounds, left and right, in the direction of traffic."""
        step = -1 if self.is_against else 1
        left, right = (list(points[bound])[::step] for bound in (self.left, self.right))
        return left, right

    @property
    def is_level(self) -> bool:
        """True for a lane that lies on the floor of its level."""
        return all(abs(height) < APART_M for _, _, height in self.left.places)

    @property
    def ground(self) -> list[tuple[float, float]]:
        """Corners (x, y) of the lane's polygon."""
        return [place[:2] for place in (*self.left.places, *reversed(self.right.places))]

    @property
    def turned_rad(self) -> float:
        """Angle by which the lane turns to the left in its driving direction."""
        turned = sum(arc.length_m * arc.curvature_per_m for arc in self.road.line.arcs)
        return -turned if self.is_against else turned


def lane_bounds(network: Network, osm: OsmFile, *, same_m: float = SAME_M) -> tuple[LaneBounds, ...]:
    """Compute all lanes of a garage with their bounds, ordered by road and from left to right.

    The points of bounds are added to the map: all ends, then those between, which keep clear of all other points.
    Bounds of the same ends are one if their middles are less than `same_m` apart.
    """
    lanes = tuple(lane for road in network.roads for lane in _lanes(road))
    bounds = list(dict.fromkeys(chain.from_iterable((lane.left, lane.right) for lane in lanes)))
    for bound in bounds:
        start = osm.point(bound.at(0.0))
        bound.points = [start, osm.point(bound.at(bound.road.line.length_m), other_than=start)]
    for bound in bounds:
        _turn_forwards(bound, osm)
    drawn: dict[frozenset[int], list[Bound]] = {}
    for bound in bounds:
        alike = drawn.setdefault(frozenset(bound.points), [])
        same = next((other for other in alike if math.dist(_middle(bound), _middle(other)) < same_m), None)
        if same is None:
            alike.append(bound)
            bound.points[1:1] = _inner_points(bound, osm)
        else:
            bound.points = same.points if same.points[0] == bound.points[0] else same.points[::-1]
        bound.places = [osm.place(point) for point in bound.points]
    return lanes


def _lanes(road: Road) -> Iterator[LaneBounds]:
    left, middle, right = (Bound(road, side) for side in range(3))
    for lane in road.lanes:
        outer = left if lane == LEFT else right
        yield LaneBounds(road, lane, *((outer, middle) if road.keeps_left else (middle, outer)))


def _middle(bound: Bound) -> Place:
    return bound.at(bound.road.line.length_m / 2)


def _turn_forwards(bound: Bound, osm: OsmFile) -> None:
    """Move the ends of a bound on the inner side of a tight bend, if it runs backwards, before and behind its corner.

    Lanelet2 would take it for a bound in the other direction. Both ends stay on the bounds of the neighbouring roads.
    """
    line = bound.road.line
    start, end = (np.array(osm.place(point)) for point in bound.points)
    headings = (line.at(run_m)[2] for run_m in (0.0, line.length_m))
    into, out = (np.array([math.cos(heading), math.sin(heading)]) for heading in headings)
    over = into[0] * out[1] - into[1] * out[0]
    if (end - start)[:2] @ (into + out) > 0 or abs(over) < _LEAST_TURN or not _is_too_tight(bound):
        return
    away = (end - start)[:2]
    corner = start[:2] + into * (away[0] * out[1] - away[1] * out[0]) / over
    for point, place, along in ((bound.points[0], start, -into), (bound.points[1], end, out)):
        for away_m in np.arange(1, _CORNERS) * _CORNER_M:
            x, y = corner + along * away_m
            moved = float(x), float(y), float(place[2])
            if osm.near(moved) in {None, point}:
                osm.move(point, moved)
                break


def _is_too_tight(bound: Bound) -> bool:
    return any(speed < -_LEAST_M for _, _, speed in _pieces(bound))


def _inner_points(bound: Bound, osm: OsmFile) -> list[int]:
    """Add the points between the ends of a bound, including changes of slope."""
    pieces = list(_pieces(bound))
    if _is_too_tight(bound):
        return []  # the inner bound of a bend tighter than its lane is wide
    found: list[int] = []
    at_m = 0.0
    for end_m, step_m, speed in pieces:
        least_m = _CHORD * APART_M / max(speed, _LEAST_M)
        while (steps := _steps(end_m - at_m, step_m, least_m)) > 1:
            run_m = at_m + (end_m - at_m) / steps
            free = (run for run in _runs_around(run_m, at_m, max(step_m, least_m), speed) if run < end_m)
            at_m = next((run for run in free if osm.near(bound.at(run)) is None), run_m)
            found.append(osm.point(bound.at(at_m)))
        if end_m < bound.road.line.length_m and osm.near(bound.at(end_m)) is None:
            at_m = end_m
            found.append(osm.point(bound.at(end_m)))
    taken = bound.points
    return [point for point in dict.fromkeys(found) if point not in taken]


def _steps(length_m: float, step_m: float, least_m: float) -> int:
    """Divide a length into steps of at most `step_m`, and at least `least_m` even if that is more."""
    return min(math.ceil(length_m / step_m - _LEAST_M), math.floor(length_m / least_m + _LEAST_M))


def _runs_around(run_m: float, before_m: float, step_m: float, speed: float) -> Iterator[float]:
    """Yield distances along a road near `run_m`: first those within a step of the previous point, then others."""
    yield run_m
    aside_m = _ASIDE_M / max(speed, _LEAST_M)
    runs = [run_m - aside_m * number for number in range(1, math.ceil((run_m - before_m) / aside_m))]
    most_m = before_m + _MOST_STEPS * step_m
    runs += [run_m + aside_m * number for number in range(1, math.ceil((most_m - run_m) / aside_m))]
    yield from sorted(runs, key=lambda run: (run > before_m + step_m, abs(run - run_m)))


def _pieces(bound: Bound) -> Iterator[tuple[float, float, float]]:
    """Divide a road at changes of curvature and slope.

    Each piece is its end, the step within which the bound is straight to `_SAG_M`, and the least ratio of the bound's
    length to the road's; below zero where the bound runs backwards.
    """
    road = bound.road
    length_m = road.line.length_m
    change_m = abs(bound.offset_m(length_m) - bound.offset_m(0.0))
    eased, slope = _MOST_EASED_BEND * change_m / length_m**2, _MOST_EASED_SLOPE * change_m / length_m
    start_m = 0.0
    for number, arc in enumerate(road.line.arcs, start=1):
        end_m = length_m if number == len(road.line.arcs) else start_m + arc.length_m
        bend = abs(arc.curvature_per_m)
        speeds = [1 - arc.curvature_per_m * bound.offset_m(run) for run in (start_m, end_m)]
        most = bend * max(speeds) + 2 * bend * slope + eased
        step_m = math.sqrt(8 * _SAG_M / most) if most > 0 else math.inf
        for run, _ in road.profile_m:
            if start_m + _LEAST_M < run < end_m - _LEAST_M:
                yield run, step_m, min(speeds)
        yield end_m, step_m, min(speeds)
        start_m = end_m
