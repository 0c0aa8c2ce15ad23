"""Roads, lanes and junctions of a garage in metres: what OpenDRIVE and Lanelet2 are written from."""

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.maps.reference_line import ReferenceLine
from garage2usd.maps.road_nodes import RoadNode

__all__ = ["LEFT", "RIGHT", "Junction", "LaneLink", "Lanes", "Neighbour", "Network", "Road"]

LEFT, RIGHT = 1, -1
"""Numbers of the lanes of a road, that against its direction and that along it: cars keep to the right."""


class Lanes(NamedTuple):
    """The lanes across a road, to the left of its reference line.

    Attributes
    ----------
    middle_m
        Where the left lane meets the right one.
    left_m, right_m
        Their widths; 0 for a lane that is not there.
    """

    middle_m: float
    left_m: float
    right_m: float

    def width_m(self, lane: int) -> float:
        """Of a lane."""
        return self.left_m if lane == LEFT else self.right_m

    def centre_m(self, lane: int) -> float:
        """Of a lane's middle line."""
        return self.middle_m + (self.left_m / 2 if lane == LEFT else -self.right_m / 2)


class Neighbour(NamedTuple):
    """What a road goes on as.

    Attributes
    ----------
    number
        Of the road or junction.
    is_junction
        Which of the two it is.
    at_start
        Whether it is joined where the other road starts.
    """

    number: int
    is_junction: bool = False
    at_start: bool = False


class LaneLink(NamedTuple):
    """A way through a junction.

    Attributes
    ----------
    incoming, connecting
        Numbers of the roads.
    from_lane, to_lane
        The lane of the road that comes in, and that of the road that goes out.
    """

    incoming: int
    connecting: int
    from_lane: int
    to_lane: int


@dataclass(eq=False)
class Road:
    """A road.

    Attributes
    ----------
    number
        From 1 on.
    line
        Its reference line.
    start, end
        Its lanes there; widths run smoothly from one to the other.
    nodes
        Numbers of the lane nodes that it crosses.
    profile_m
        (s, height) where its slope changes, in straight stretches; empty where it lies level at 0.
    junction
        Number of the junction that it connects two roads in.
    predecessor, successor
        What comes before and after it.
    lane_before, lane_after
        For each of its lanes, the lane of the predecessor and of the successor; those without are left out.
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

    @property
    def lanes(self) -> tuple[int, ...]:
        """Numbers of its lanes, from left to right."""
        return tuple(lane for lane in (LEFT, RIGHT) if self.start.width_m(lane) > 0)

    def lanes_at(self, s_m: float) -> Lanes:
        """Its lanes at a length along it."""
        share = min(max(s_m / self.line.length_m, 0.0), 1.0)
        eased = share * share * (3 - 2 * share)
        return Lanes(*(a + (b - a) * eased for a, b in zip(self.start, self.end, strict=True)))

    def middle_points(self, lane: int, s_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """(x, y) on the middle line of a lane at lengths along the road; shape (n, 2)."""
        share = np.clip(s_m / self.line.length_m, 0.0, 1.0)
        start_m, end_m = self.start.centre_m(lane), self.end.centre_m(lane)
        return self.line.beside_each(s_m, start_m + (end_m - start_m) * share * share * (3 - 2 * share))

    def height_m(self, s_m: float) -> float:
        """Of its surface at a length along it."""
        if not self.profile_m:
            return 0.0
        runs, heights = zip(*self.profile_m, strict=True)
        return float(np.interp(s_m, runs, heights))


@dataclass(frozen=True, eq=False)
class Junction:
    """A node in which three or more roads meet.

    Attributes
    ----------
    number
        Differs from those of all roads.
    node
        Number of its node.
    links
        The ways through it.
    """

    number: int
    node: int
    links: tuple[LaneLink, ...]


@dataclass(frozen=True, eq=False)
class Network:
    """All roads and junctions, and the nodes that they were made from, each at its number."""

    roads: tuple[Road, ...]
    junctions: tuple[Junction, ...]
    nodes: tuple[RoadNode, ...]
