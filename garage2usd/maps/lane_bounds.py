"""Lane bounds as polylines, shared by adjacent lanes."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from garage2usd.maps.network import LEFT, RIGHT, Network, Road
from garage2usd.maps.osm_file import Place
from garage2usd.native import elementary

__all__ = ["Bound", "LaneBounds", "lane_bounds"]

_SAG_M = 1e-3
"""Greatest deviation of a polyline from its lane bound."""
_LEAST_M = 1e-6
_MOST_EASED_BEND, _MOST_EASED_SLOPE = 6.0, 1.5
"""Greatest second and first derivative of the easing curve for lane widths, from 0 to 1 along a road of length 1."""


@dataclass(eq=False)
class Bound:
    """A bound of a lane.

    Attributes
    ----------
    places
        Points of the polyline along the road.
    is_middle
        True for the line between the two lanes of a straight road, where the middle line is painted.
    """

    places: list[Place]
    is_middle: bool = False


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
        return (self.right,) if self.road.lanes == (LEFT, RIGHT) else (self.left, self.right)

    @property
    def ground(self) -> list[tuple[float, float]]:
        """Corners (x, y) of the lane's polygon."""
        return [place[:2] for place in (*self.left.places, *reversed(self.right.places))]

    @property
    def turned_rad(self) -> float:
        """Angle by which the lane turns to the left in its driving direction."""
        turned = sum(arc.length_m * arc.curvature_per_m for arc in self.road.line.arcs)
        return turned if self.lane == RIGHT else -turned


def lane_bounds(network: Network) -> tuple[LaneBounds, ...]:
    """Compute all lanes of a garage with their bounds, ordered by road and from left to right."""
    return tuple(lane for road in network.roads for lane in _lanes(road))


def _lanes(road: Road) -> Iterator[LaneBounds]:
    is_middle = road.lanes == (LEFT, RIGHT) and road.line.is_straight and road.junction is None
    lefts, middles, rights = Bound([]), Bound([], is_middle), Bound([])
    runs = _runs(road)
    for run in runs:
        lanes, height = road.lanes_at(run), road.height_m(run)
        sides = lanes.middle_m + lanes.left_m, lanes.middle_m, lanes.middle_m - lanes.right_m
        for bound, side in zip((lefts, middles, rights), sides, strict=True):
            bound.places.append((*road.line.beside(run, side), height))
    for bound in (lefts, middles, rights):
        if _turns_back(bound, road, runs):
            bound.places[1:-1] = []
    for lane in road.lanes:
        yield LaneBounds(road, lane, middles, lefts if lane == LEFT else rights)


def _turns_back(bound: Bound, road: Road, runs: Sequence[float]) -> bool:
    """Test if a bound runs backwards, as the inner bound of a bend tighter than its lane is wide."""
    for (before, start), (after, end) in pairwise(zip(runs, bound.places, strict=True)):
        heading = road.line.at((before + after) / 2)[2]
        if (end[0] - start[0]) * elementary.cos(heading) + (end[1] - start[1]) * elementary.sin(heading) < -_LEAST_M:
            return True
    return False


def _runs(road: Road) -> list[float]:
    """Divide a road into lengths whose bounds are straight within `_SAG_M`, including changes of slope."""
    length_m = road.line.length_m
    wide_m = max(abs(lanes.middle_m) + lanes.left_m + lanes.right_m for lanes in (road.start, road.end))
    change_m = 2 * sum(abs(start - end) for start, end in zip(road.start, road.end, strict=True))
    eased, slope = _MOST_EASED_BEND * change_m / length_m**2, _MOST_EASED_SLOPE * change_m / length_m
    runs, at_m = {0.0, length_m}, 0.0
    for arc in road.line.arcs:
        bend = abs(arc.curvature_per_m)
        # the second derivative of a line beside the road, whose distance to it changes, is no greater
        most = bend * (1 + bend * wide_m) + 2 * bend * slope + eased
        steps = max(1, math.ceil(arc.length_m * math.sqrt(most / (8 * _SAG_M))))
        runs.update(at_m + arc.length_m * step / steps for step in range(steps))
        at_m += arc.length_m
    runs.update(run for run, _ in road.profile_m if run < length_m)
    return sorted(runs)
