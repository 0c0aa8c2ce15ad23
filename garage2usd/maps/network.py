"""Road network of a garage in metres: roads, lanes and junctions, the source of OpenDRIVE and Lanelet2 maps."""

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.maps.reference_line import ReferenceLine
from garage2usd.maps.road_nodes import RoadNode

__all__ = ["LEFT", "RIGHT", "Junction", "LaneLink", "Lanes", "Neighbour", "Network", "Road"]

LEFT, RIGHT = 1, -1
"""Numbers of a road's lanes against and along its direction, for right-hand traffic."""


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
