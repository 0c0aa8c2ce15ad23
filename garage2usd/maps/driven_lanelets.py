"""Lanelets in the direction of traffic, 1 to 50 m long, with a way round at dead ends."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import networkx as nx
import numpy as np
from numpy.typing import NDArray

from garage2usd.as_built import BuiltLevel
from garage2usd.maps.lane_bounds import LaneBounds
from garage2usd.maps.lanelet2 import turn_direction
from garage2usd.maps.network import Network, Road
from garage2usd.maps.osm_file import OsmFile

_LEAST_M, _MOST_M = 1.1, 45.0
"""Range of the lengths of roads; shorter ones are joined to others, longer ones divided. Autoware wants 1 to 50 m."""
_DEAD_END_M, _DEPTH, _APART_M = 4.5, 2 / 3, 0.25
"""Length of the lanelets at a dead end, the share that turns round, and half the distance between its left ends."""
_TURN_STEPS = 12
_Edge = tuple[int, int]
"""The left and right point of an end of a lanelet."""


@dataclass(eq=False)
class DrivenLanelet:
    """A lanelet in the direction of its traffic.

    Attributes
    ----------
    lanes
        The lane that it is made of, and short ones before or after it.
    left, right
        Points of its bounds.
    """

    lanes: list[LaneBounds]
    left: list[int]
    right: list[int]

    @classmethod
    def of_sides(cls, lane: LaneBounds, inner: list[int], outer: list[int]) -> "DrivenLanelet":
        """Return a lanelet by its bound towards the oncoming traffic and the other one."""
        return cls([lane], *((outer, inner) if lane.road.keeps_left else (inner, outer)))

    @property
    def inner(self) -> list[int]:
        """The bound towards the oncoming traffic."""
        return self.right if self.main.road.keeps_left else self.left

    @property
    def outer(self) -> list[int]:
        """The bound away from the oncoming traffic."""
        return self.left if self.main.road.keeps_left else self.right

    @property
    def start(self) -> _Edge:
        """The edge at which traffic enters."""
        return self.left[0], self.right[0]

    @property
    def end(self) -> _Edge:
        """The edge at which traffic leaves."""
        return self.left[-1], self.right[-1]

    @cached_property
    def main(self) -> LaneBounds:
        """The lane in a junction, or else the longest one."""
        return max(self.lanes, key=lambda lane: (lane.road.junction is not None, lane.road.line.length_m))

    @property
    def turn(self) -> str | None:
        """Autoware's word for the direction of its turn; None outside of junctions."""
        return None if self.main.road.junction is None else turn_direction(sum(lane.turned_rad for lane in self.lanes))

    def extend(self, other: "DrivenLanelet", *, is_before: bool) -> None:
        """Take over the lanes of another lanelet, which follows this one or precedes it, without the points between."""
        first, last = (other, self) if is_before else (self, other)
        self.lanes = [*first.lanes, *last.lanes]
        self.left, self.right = [*first.left[:-1], *last.left[1:]], [*first.right[:-1], *last.right[1:]]


def divided(network: Network) -> Network:
    """Return the network with roads of at most 45 m, whose parts keep their number, and the ends of dead ends apart."""
    return replace(network, roads=tuple(part for road in network.roads for part in _parts(road)))


def _parts(road: Road) -> Iterator[Road]:
    if road.junction is not None:
        yield road
        return
    length_m = road.line.length_m
    is_turned = [
        road.line.is_straight and len(road.lanes) > 1 and end is None for end in (road.predecessor, road.successor)
    ]
    turn_m = min(_DEAD_END_M, length_m / max(1, sum(is_turned)))
    first_m, last_m = turn_m * is_turned[0], length_m - turn_m * is_turned[1]
    count = math.ceil((last_m - first_m) / _MOST_M)
    cuts = [first_m + (last_m - first_m) * number / count for number in range(1, count)]
    if last_m - first_m > _LEAST_M:
        cuts += [first_m, last_m]
    for start_m, end_m in pairwise(sorted({0.0, *cuts, length_m})):
        inner = [(run - start_m, height) for run, height in road.profile_m if start_m < run < end_m]
        heights = [(0.0, road.height_m(start_m)), *inner, (end_m - start_m, road.height_m(end_m))]
        yield replace(
            road,
            line=road.line.part(start_m, end_m),
            start=road.lanes_at(start_m),
            end=road.lanes_at(end_m),
            profile_m=tuple(heights) if road.profile_m else (),
        )


def with_turns(osm: OsmFile, lanelets: Sequence[DrivenLanelet]) -> list[DrivenLanelet]:
    """Return the lanelets with one that turns round at each dead end, between narrower ones."""
    following, before = {each.start for each in lanelets}, {each.end for each in lanelets}
    starts = {each.inner[0]: each for each in lanelets if each.start not in before}
    found = []
    turned: set[DrivenLanelet] = set()
    for there in lanelets:
        back = starts.get(there.inner[-1])
        road = there.main.road
        if there.end in following or back is None or back.main.road is not road or road.junction is not None:
            continue
        if road.line.is_straight and road.line.length_m < _DEAD_END_M + _LEAST_M:
            found += _turn(osm, there, back)
            turned |= {there, back}
    return [*(each for each in lanelets if each not in turned), *found]


def _turn(osm: OsmFile, there: DrivenLanelet, back: DrivenLanelet) -> list[DrivenLanelet]:
    """Return the lanelets into a dead end, round in it, and out of it."""
    middle, near_side, far_side = (
        np.array(osm.place(points[end])) for points, end in ((there.inner, -1), (there.outer, -1), (back.outer, 0))
    )
    along = _DEPTH * (middle - osm.place(there.inner[0]))

    def near(place: NDArray[np.float64]) -> int:
        x, y, z = place.tolist()
        return osm.point((x, y, z))

    corners = [
        near(middle - along + _APART_M * (side - middle) / np.linalg.norm(side - middle))
        for side in (near_side, far_side)
    ]
    angles = np.linspace(0.0, math.pi, _TURN_STEPS + 1)[:, None]
    across = np.where(angles < math.pi / 2, near_side - middle, far_side - middle) * np.abs(np.cos(angles))
    ring = list(dict.fromkeys(near(place) for place in middle - along + across + along * np.sin(angles)))
    return [
        DrivenLanelet.of_sides(there.main, [there.inner[0], corners[0]], [there.outer[0], ring[0]]),
        DrivenLanelet.of_sides(there.main, corners, ring),
        DrivenLanelet.of_sides(back.main, [corners[1], back.inner[-1]], [ring[-1], back.outer[-1]]),
    ]


def on_routes(lanelets: list[DrivenLanelet], level: BuiltLevel) -> list[DrivenLanelet]:
    """Return the lanelets on ways from an entrance or ramp to an exit or ramp, or all where there are no such ways."""
    ways = nx.DiGraph([(each.start, each.end, {"lanelet": each}) for each in lanelets])
    begins = {each.start for each in entered(lanelets, level)}
    leaves = {each.end for each in entered(lanelets, level, is_exit=True)}
    reached = begins.union(*(nx.descendants(ways, start) for start in begins))
    led = leaves.union(*(nx.ancestors(ways, end) for end in leaves))
    kept = [each for each in lanelets if each.start in reached and each.end in led] or lanelets
    starts, ends = {each.start for each in kept}, {each.end for each in kept}
    return [each for each in kept if each.end in starts or each.start in ends] or lanelets


def entered(lanelets: Sequence[DrivenLanelet], level: BuiltLevel, *, is_exit: bool = False) -> list[DrivenLanelet]:
    """Return the lanelets on which a car comes into a level, or leaves it, from or to the street or another level."""
    portals = {number for number, node in enumerate(level.lanes.nodes) if node.is_portal}
    others = {each.start if is_exit else each.end for each in lanelets}
    outer = [(each, each.lanes[-1 if is_exit else 0].road.nodes) for each in lanelets]
    return [
        each
        for each, nodes in outer
        if (each.end if is_exit else each.start) not in others and (not nodes or portals & {*nodes})
    ]


def joined(lanelets: list[DrivenLanelet]) -> list[DrivenLanelet]:
    """Join the lanelets of roads shorter than Autoware allows to those before or after them.

    Both lanes of a road are joined at the same end, so that lanelets side by side still end beside one another.
    """
    short = [each for each in lanelets if each.main.road.junction is None and each.main.road.line.length_m < _LEAST_M]
    for road in dict.fromkeys(each.main.road for each in short):
        own = [each for each in short if each.main.road is road]
        ends = [[(each, _beside(each, lanelets, is_before=is_before)) for each in own] for is_before in (True, False)]
        # of a road with both lanes the end behind one lane is that before the other
        sides = [[ends[0][0], *ends[1][1:]], [ends[1][0], *ends[0][1:]]]
        whole = next((side for side in sides if all(others for _, others in side)), None)
        for each, others in whole or [before if before[1] else after for before, after in zip(*ends, strict=True)]:
            for other in others:
                other.extend(each, is_before=each.end == other.start)
            if others:
                lanelets.remove(each)
    return lanelets


def _beside(lanelet: DrivenLanelet, lanelets: list[DrivenLanelet], *, is_before: bool) -> list[DrivenLanelet]:
    """Return the lanelets before or after one to which it can be joined, as they are joined to no others."""
    if is_before:
        others = [each for each in lanelets if each.end == lanelet.start]
        is_sole = sum(each.start == lanelet.start for each in lanelets) == 1
    else:
        others = [each for each in lanelets if each.start == lanelet.end]
        is_sole = sum(each.end == lanelet.end for each in lanelets) == 1
    return others if is_sole else []
