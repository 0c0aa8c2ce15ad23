"""Lanelets as Autoware's planners need them: 1 to 50 m long, with the areas, signals and rights of way of junctions."""

import math
from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import networkx as nx
import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.as_built import BuiltLevel
from garage2usd.config.outputs import MapsConfig
from garage2usd.maps.lane_bounds import Bound, LaneBounds, lane_bounds
from garage2usd.maps.lanelet2 import add_stops, bound_tags, crossed_things, lanelet_tags, turn_direction
from garage2usd.maps.lanelet2_parking import add_lots, add_stalls, stall_points
from garage2usd.maps.network import Network, Road
from garage2usd.maps.osm_file import APART_M, Member, OsmFile
from garage2usd.maps.xml_text import number_text

_LEAST_M, _MOST_M = 1.1, 45.0
"""Range of the lengths of roads; shorter ones are joined to others, longer ones divided. Autoware wants 1 to 50 m."""
_DEAD_END_M, _DEPTH, _APART_M = 4.5, 2 / 3, 0.25
"""Length of the lanelets at a dead end, the share that turns round, and half the distance between its left ends."""
_TURN_STEPS = 12
_GATE = {"barrier": ("traffic_sign", "stop_sign")}
_STOP_LINE = {"type": "stop_line", "subtype": "stop_line"}
_BUMP = frozenset({"speed_bump"})
_TOUCHING = 0.01
"""Share of a lanelet's ground from which another lanelet on it has to yield, as in Autoware's validator."""
_BULGE = 0.005
"""Share of a turn's ground outside of the area of its junction from which on the area is widened."""
_SIGNAL_M, _SURELY = 30.0, 0.9
"""Distance at which Autoware begins to signal a turn, and the share of a way that is surely shorter than it."""
_OPPOSITE = {"left": "right", "right": "left"}
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


def add_autoware_level(
    osm: OsmFile, level: BuiltLevel, network: Network, settings: MapsConfig
) -> tuple[DrivenLanelet, ...]:
    """Write a level to Autoware's map: lanelets, parking spaces and lots, gates and speed bumps.

    Parameters
    ----------
    osm
        The map.
    level, network
        The level and its roads.
    settings
        The speed limit.

    Returns
    -------
    tuple of DrivenLanelet
        All lanelets.

    Notes
    -----
    The rules are those of Autoware's vector map requirements (vm-01 to vm-07) and of its validator. A junction is an
    area among the ends of its lanelets. Turns towards the near side, which cross no other lane, have the right of way.
    Autoware drives to the lanelet next to a goal: at dead ends a lanelet turns round, and lanes that no route from
    entrance to exit takes are left out, so that a route leads to each stall and away from it.
    """
    corners = stall_points(osm, level)
    lanes = lane_bounds(_divided(network), osm, same_m=APART_M)
    feet = add_stalls(osm, level, lanes, corners, only_spaces=True)
    rules = add_stops(osm, level, lanes, signs=_GATE, line=_STOP_LINE)
    for lane, rule in _bumps(osm, level, lanes):
        rules.setdefault(lane, []).append(rule)
    points = {bound: feet.along(bound) for lane in lanes for bound in (lane.left, lane.right)}
    lanelets = _with_turns(osm, [DrivenLanelet([lane], *lane.driven(points)) for lane in lanes])
    lanelets = _on_routes(_joined(lanelets), level)
    _Writer(osm, lanelets, level, settings).write(rules)
    add_lots(osm, lanes, feet)
    return tuple(lanelets)


def _divided(network: Network) -> Network:
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


def _with_turns(osm: OsmFile, lanelets: Sequence[DrivenLanelet]) -> list[DrivenLanelet]:
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


def _on_routes(lanelets: list[DrivenLanelet], level: BuiltLevel) -> list[DrivenLanelet]:
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


def _joined(lanelets: list[DrivenLanelet]) -> list[DrivenLanelet]:
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


def _bumps(osm: OsmFile, level: BuiltLevel, lanes: Sequence[LaneBounds]) -> Iterator[tuple[LaneBounds, int]]:
    """Write the speed bumps, and yield each lane over one with its rule."""
    tree = shapely.STRtree([shapely.Polygon(lane.ground) for lane in lanes])
    for thing in crossed_things(level, _BUMP):
        crossed = sorted(tree.query(thing.outline, predicate="intersects").tolist())
        if not crossed:
            continue
        ring = shapely.get_coordinates(shapely.oriented_envelope(thing.outline).normalize())[:-1].tolist()
        height = number_text(round(thing.height_m, 3))
        bump = osm.polygon(
            osm.points((x, y, 0.0) for x, y in ring), {"type": "speed_bump", "height": height, "name": thing.name}
        )
        rule = osm.relation([Member("way", bump, "refers")], {"type": "regulatory_element", "subtype": "speed_bump"})
        yield from ((lanes[index], rule) for index in crossed)


class _Writer:
    """Writer of the lanelets of a level."""

    def __init__(
        self, osm: OsmFile, lanelets: Sequence[DrivenLanelet], level: BuiltLevel, settings: MapsConfig
    ) -> None:
        self._osm, self._lanelets, self._settings = osm, lanelets, settings
        self._near_side = "left" if level.keeps_left else "right"
        self._numbers = {each: osm.number() for each in lanelets}
        self._before = {each: [other for other in lanelets if other.end == each.start] for each in lanelets}
        grounds = [self._ground(each) for each in lanelets]
        self._ground_of = dict(zip(lanelets, grounds, strict=True))
        self._tree = shapely.STRtree(grounds)
        self._borders: set[tuple[DrivenLanelet, bool]] = set()
        """Lanelets whose left bound (True) or right bound is the border of its junction."""

    def write(self, rules: dict[LaneBounds, list[int]]) -> None:
        """Write all lanelets with the rules of their lanes and of their junctions."""
        junctions: dict[int, list[DrivenLanelet]] = {}
        for each in self._lanelets:
            if each.main.road.junction is not None:
                junctions.setdefault(each.main.road.junction, []).append(each)
        areas = {number: self._add_area(own) for number, own in junctions.items()}
        first = {each: self._add_right(each) for own in junctions.values() for each in self._with_right(own)}
        for each in self._lanelets:
            members = [
                Member("way", self._osm.way(points, self._tags_of_bound(each, is_left=is_left)), side)
                for points, side, is_left in ((each.left, "left", True), (each.right, "right", False))
            ]
            own = dict.fromkeys(rule for lane in each.lanes for rule in rules.get(lane, ()))
            own |= {first[each]: None} if each in first else {}
            members += [Member("relation", rule, "regulatory_element") for rule in own]
            tags = {**lanelet_tags(each.main, self._settings), "location": "private"}
            if each.turn is not None:
                tags |= {"turn_direction": each.turn, "intersection_area": str(areas[each.main.road.junction or 0])}
                tags |= self._signal(each)
            self._osm.relation(members, tags, number=self._numbers[each])

    def _ground(self, each: DrivenLanelet) -> shapely.Geometry:
        flat = [self._osm.place(point)[:2] for point in (*each.left, *reversed(each.right))]
        return shapely.make_valid(shapely.Polygon(flat))

    def _tags_of_bound(self, each: DrivenLanelet, *, is_left: bool) -> dict[str, str]:
        if (each, is_left) in self._borders:
            return {"type": "road_border"}
        bounds: list[Bound] = [lane.left if is_left else lane.right for lane in each.lanes]
        return bound_tags(next((bound for bound in bounds if not bound.is_middle), bounds[0]))

    def _add_area(self, lanelets: Sequence[DrivenLanelet]) -> int:
        """Write the area of a junction: the ground among the ends of its lanelets, with turns that bulge out of it.

        Its corners may be ends of lanelets and points of road borders; the outer bound of such a turn becomes one.
        """
        points = {self._osm.place(point)[:2]: point for each in lanelets for point in (*each.start, *each.end)}
        hull = shapely.convex_hull(shapely.MultiPoint(list(points)))
        for each in lanelets:
            ground = self._ground_of[each]
            if each.turn != "straight" and shapely.difference(ground, hull).area > _BULGE * ground.area:
                self._borders.add((each, each.turn == "right"))
                outer = each.left if each.turn == "right" else each.right
                points |= {self._osm.place(point)[:2]: point for point in outer}
        hull = shapely.convex_hull(shapely.MultiPoint(list(points))).normalize()
        ring = [points[x, y] for x, y in shapely.get_coordinates(hull)[:-1].tolist()]
        return self._osm.polygon(ring, {"type": "intersection_area"})

    def _with_right(self, lanelets: Sequence[DrivenLanelet]) -> list[DrivenLanelet]:
        """Return the lanelets of a junction that wait for no other: near-side turns, or else the one crossed least."""
        near = [each for each in lanelets if each.turn == self._near_side]
        return near or [min(lanelets, key=lambda each: len(self._conflicting(each)))]

    def _conflicting(self, lanelet: DrivenLanelet) -> list[DrivenLanelet]:
        """Return the lanelets from elsewhere on the ground of one."""
        ground = self._ground_of[lanelet]
        own = {*self._before[lanelet]}
        found = []
        for index in sorted(self._tree.query(ground).tolist()):
            other = self._lanelets[index]
            is_joined = other is lanelet or lanelet in self._before[other] or other in own
            if is_joined or own & {*self._before[other]} or self._are_side_by_side(lanelet, other):
                continue
            if shapely.intersection(ground, self._ground_of[other]).area >= _TOUCHING * ground.area:
                found.append(other)
        return found

    @staticmethod
    def _are_side_by_side(one: DrivenLanelet, other: DrivenLanelet) -> bool:
        return one.left == other.right or one.right == other.left

    def _add_right(self, lanelet: DrivenLanelet) -> int:
        members = [Member("relation", self._numbers[lanelet], "right_of_way")]
        members += [Member("relation", self._numbers[other], "yield") for other in self._conflicting(lanelet)]
        return self._osm.relation(members, {"type": "regulatory_element", "subtype": "right_of_way"})

    def _signal(self, lanelet: DrivenLanelet) -> dict[str, str]:
        """Return the distance of the turn signal, where an opposite turn lies within the usual one before the turn."""
        opposite = _OPPOSITE.get(lanelet.turn or "")
        queue = deque((other, self._length_m(other)) for other in self._before[lanelet])
        seen: set[DrivenLanelet] = set()
        while opposite and queue:
            other, length_m = queue.popleft()
            if other in seen or length_m > _SIGNAL_M:
                continue
            seen.add(other)
            if other.turn == opposite:
                return {"turn_signal_distance": f"{_SURELY * length_m:.1f}"}
            queue.extend((more, length_m + self._length_m(more)) for more in self._before[other])
            queue = deque(sorted(queue, key=lambda way: way[1]))
        return {}

    def _length_m(self, lanelet: DrivenLanelet) -> float:
        """Return the length of a lanelet's shorter bound."""
        bounds = ([self._osm.place(point)[:2] for point in points] for points in (lanelet.left, lanelet.right))
        return min(sum(math.dist(*step) for step in pairwise(bound)) for bound in bounds)
