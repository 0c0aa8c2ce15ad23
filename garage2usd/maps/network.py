"""Road network of a garage in metres, source of OpenDRIVE and Lanelet2 maps: roads, junctions, places beside roads."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.garage import Stall
from garage2usd.maps.frame import map_point
from garage2usd.maps.road_nodes import Point, ReferenceLine, RoadNode, straight

LEFT, RIGHT = 1, -1
"""Numbers of a road's lanes against and along its direction, for right-hand traffic."""
_BEYOND_M = 0.5
"""Length by which auxiliary lines extend beyond their objects."""
_NEAR_M = 25.0
"""Distance beyond which an object is placed beside the auxiliary line along the whole garage."""


class Lanes(NamedTuple):
    """Cross section of a road's lanes, to the left of its reference line.

    Attributes
    ----------
    middle_m
        Offset of the line between the left and the right lane.
    left_m, right_m
        Widths of the lanes; 0 for a missing lane.
    """

    middle_m: float
    left_m: float
    right_m: float

    def width_m(self, lane: int) -> float:
        """Return the width of a lane."""
        return self.left_m if lane == LEFT else self.right_m

    def centre_m(self, lane: int) -> float:
        """Return the offset of a lane's middle line."""
        return self.middle_m + (self.left_m / 2 if lane == LEFT else -self.right_m / 2)


class Neighbour(NamedTuple):
    """The predecessor or successor of a road.

    Attributes
    ----------
    number
        Number of the road or junction.
    is_junction
        True for a junction.
    at_start
        True if the start of the other road is joined.
    """

    number: int
    is_junction: bool = False
    at_start: bool = False


class LaneLink(NamedTuple):
    """A lane link through a junction.

    Attributes
    ----------
    incoming, connecting
        Numbers of the roads.
    from_lane, to_lane
        Lane of the incoming and of the connecting road.
    """

    incoming: int
    connecting: int
    from_lane: int
    to_lane: int


@dataclass(eq=False)
class Road:
    """A road with its lanes and its neighbours.

    Attributes
    ----------
    number
        Number of the road, from 1.
    line
        Reference line of the road.
    start, end
        Lanes at both ends; widths are eased between them.
    nodes
        Numbers of the lane nodes along the road.
    profile_m
        Elevation profile as (s, height over the floor of the level) at changes of slope; empty for a level road.
    junction
        Number of the junction, for a connecting road.
    predecessor, successor
        Neighbours at the start and the end.
    lane_before, lane_after
        Lane of the predecessor and of the successor for each lane that has one.
    floor_m
        Height of the floor of its level in the map.
    keeps_left
        True if the left lane is the one along the road, and the right one against it.
    """

    number: int
    line: ReferenceLine
    start: Lanes
    end: Lanes
    nodes: tuple[int, ...]
    profile_m: tuple[tuple[float, float], ...] = ()
    junction: int | None = None
    predecessor: Neighbour | None = None
    successor: Neighbour | None = None
    lane_before: dict[int, int] = field(default_factory=dict)
    lane_after: dict[int, int] = field(default_factory=dict)
    floor_m: float = 0.0
    keeps_left: bool = False

    def is_against(self, lane: int) -> bool:
        """Return True if a lane's traffic runs against the road's direction."""
        return (lane == LEFT) is not self.keeps_left

    def mirror(self) -> None:
        """Reverse x: traffic then keeps to the other side."""
        self.line = ReferenceLine(tuple(arc.mirrored for arc in self.line.arcs))
        self.start, self.end = (Lanes(-lanes.middle_m, lanes.right_m, lanes.left_m) for lanes in (self.start, self.end))
        self.lane_before, self.lane_after = (
            {-lane: -other for lane, other in links.items()} for links in (self.lane_before, self.lane_after)
        )
        self.keeps_left = not self.keeps_left

    @property
    def lanes(self) -> tuple[int, ...]:
        """Numbers of the road's lanes, from left to right."""
        return tuple(lane for lane in (LEFT, RIGHT) if self.start.width_m(lane) > 0)

    def lanes_at(self, s_m: float) -> Lanes:
        """Return the road's lanes at a distance along it."""
        share = min(max(s_m / self.line.length_m, 0.0), 1.0)
        eased = share * share * (3 - 2 * share)
        return Lanes(*(a + (b - a) * eased for a, b in zip(self.start, self.end, strict=True)))

    def middle_points(self, lane: int, s_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """Compute points (x, y) of a lane's middle line at distances along the road; shape (n, 2)."""
        share = np.clip(s_m / self.line.length_m, 0.0, 1.0)
        start_m, end_m = self.start.centre_m(lane), self.end.centre_m(lane)
        return self.line.beside_each(s_m, start_m + (end_m - start_m) * share * share * (3 - 2 * share))

    def height_m(self, s_m: float) -> float:
        """Return the height of the road's surface over the floor of its level at a distance along it."""
        if not self.profile_m:
            return 0.0
        runs, heights = zip(*self.profile_m, strict=True)
        return float(np.interp(s_m, runs, heights))


@dataclass(frozen=True, eq=False)
class Junction:
    """A junction: a lane node in which three or more roads meet.

    Attributes
    ----------
    number
        Number of the junction, distinct from those of roads.
    node
        Number of the lane node.
    links
        Lane links through the junction.
    """

    number: int
    node: int
    links: tuple[LaneLink, ...]


@dataclass(frozen=True, eq=False)
class Network:
    """The road network of a garage: roads, junctions and lane nodes by number."""

    roads: tuple[Road, ...]
    junctions: tuple[Junction, ...]
    nodes: tuple[RoadNode, ...]


_WITHOUT_LANES = Lanes(0.0, 0.0, 0.0)


class RoadPlaces:
    """The straight roads of a garage for placing objects, and auxiliary lines without lanes.

    Parameters
    ----------
    network
        The roads.
    stalls
        All stalls.
    first_number
        First number of the auxiliary lines.

    Notes
    -----
    Objects are placed beside straight roads only, since programs that approximate arcs by polylines compute other
    positions. A stall is placed beside the straight road through its access node, or else beside an auxiliary line
    through that node's middle along its entry.
    """

    def __init__(self, network: Network, stalls: Iterable[Stall], *, first_number: int) -> None:
        self._roads = [road for road in network.roads if road.junction is None and road.line.is_straight]
        self._next = first_number
        self.lines: list[Road] = []
        """Auxiliary lines: roads without lanes."""
        self._of_stall: dict[Stall, Road] = {}
        self._add_stalls(stalls, network.nodes)
        self._straights = (*self._roads, *self.lines)
        arcs = [road.line.arcs[0] for road in self._straights]
        self._starts = np.array([arc.start for arc in arcs]).reshape(-1, 2)
        headings = np.array([arc.heading_rad for arc in arcs])
        self._along = np.stack([np.cos(headings), np.sin(headings)], axis=1).reshape(-1, 2)
        self._lengths = np.array([arc.length_m for arc in arcs])

    def of_stall(self, stall: Stall) -> tuple[Road, float, float]:
        """Return the road of a stall and (s, t) of the stall's middle."""
        road = self._of_stall[stall]
        return road, *road.line.foot(map_point(stall.centre))

    def of_point(self, point: Point) -> tuple[Road, float, float]:
        """Return the nearest straight road beside a point, with the point's (s, t)."""
        away = np.array(point) - self._starts
        s = (away * self._along).sum(axis=1)
        t = self._along[:, 0] * away[:, 1] - self._along[:, 1] * away[:, 0]
        distance = np.where((s >= 0) & (s <= self._lengths), np.abs(t), np.inf)
        nearest = int(distance.argmin()) if len(distance) else 0
        if len(distance) and distance[nearest] <= _NEAR_M:
            return self._straights[nearest], float(s[nearest]), float(t[nearest])
        road = self._line_along_all
        return road, *road.line.foot(point)

    def _add_stalls(self, stalls: Iterable[Stall], nodes: Sequence[RoadNode]) -> None:
        through = {number: road for road in self._roads for number in road.nodes}
        without: dict[tuple[int, Point], list[Stall]] = {}
        for stall in stalls:
            road = through.get(stall.access)
            if road is not None and 0.0 <= road.line.foot(map_point(stall.centre))[0] <= road.line.length_m:
                self._of_stall[stall] = road
            else:
                x, y = map_point(stall.outwards)
                # direction of the mouth, the same for stalls that face each other
                along = max((round(-y, 6) + 0.0, round(x, 6) + 0.0), (round(y, 6) + 0.0, round(-x, 6) + 0.0))
                without.setdefault((stall.access, along), []).append(stall)
        for (number, along), beside in without.items():
            line = _line(nodes[number].middle, along, [map_point(stall.centre) for stall in beside])
            road = self._new_line(line, number)
            self._of_stall.update(dict.fromkeys(beside, road))

    @cached_property
    def _line_along_all(self) -> Road:
        """An auxiliary line through the whole garage, extended by its length on both sides."""
        ends = self._starts + self._along * self._lengths[:, None]
        points = np.concatenate([self._starts, ends])
        low, high = points.min(axis=0), points.max(axis=0)
        reach = float((high - low).max()) + _NEAR_M
        start, end = (float(low[0]) - reach, float(low[1])), (float(high[0]) + reach, float(low[1]))
        return self._new_line(straight(start, end))

    def _new_line(self, line: ReferenceLine, *nodes: int) -> Road:
        road = Road(self._next, line, _WITHOUT_LANES, _WITHOUT_LANES, nodes)
        self._next += 1
        self.lines.append(road)
        return road


def _line(middle: Point, along: Point, points: Sequence[Point]) -> ReferenceLine:
    """Create an auxiliary line through a point that covers the projections of other points."""
    runs = [(x - middle[0]) * along[0] + (y - middle[1]) * along[1] for x, y in points]
    length = math.hypot(*along)
    low, high = min(0.0, *runs) - _BEYOND_M, max(0.0, *runs) + _BEYOND_M
    start, end = ((middle[0] + run * along[0] / length, middle[1] + run * along[1] / length) for run in (low, high))
    return straight(start, end)
