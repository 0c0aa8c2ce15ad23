"""Lanelets of a level as Autoware's planners need them, with the areas, signals and rights of way of junctions."""

import math
from collections import deque
from collections.abc import Iterator, Sequence
from itertools import pairwise

import shapely

from garage2usd.as_built import BuiltLevel
from garage2usd.config.outputs import MapsConfig
from garage2usd.maps.driven_lanelets import DrivenLanelet, divided, joined, on_routes, with_turns
from garage2usd.maps.lane_bounds import Bound, LaneBounds, lane_bounds
from garage2usd.maps.lanelet2 import add_stops, bound_tags, crossed_things, lanelet_tags
from garage2usd.maps.lanelet2_parking import add_lots, add_stalls, stall_points
from garage2usd.maps.network import Network
from garage2usd.maps.osm_file import APART_M, Member, OsmFile
from garage2usd.maps.xml_text import number_text

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
    lanes = lane_bounds(divided(network), osm, same_m=APART_M)
    feet = add_stalls(osm, level, lanes, corners, only_spaces=True)
    rules = add_stops(osm, level, lanes, signs=_GATE, line=_STOP_LINE)
    for lane, rule in _bumps(osm, level, lanes):
        rules.setdefault(lane, []).append(rule)
    points = {bound: feet.along(bound) for lane in lanes for bound in (lane.left, lane.right)}
    lanelets = with_turns(osm, [DrivenLanelet([lane], *lane.driven(points)) for lane in lanes])
    lanelets = on_routes(joined(lanelets), level)
    _Writer(osm, lanelets, level, settings).write(rules)
    add_lots(osm, lanes, feet)
    return tuple(lanelets)


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
        # where no lanelet meets another, nobody has to yield: that is no intersection
        with_right = {number: held for number, each in junctions.items() if (held := self._with_right(each))}
        areas = {number: self._add_area(junctions[number]) for number in with_right}
        first = {each: self._add_right(each) for held in with_right.values() for each in held}
        for each in self._lanelets:
            members = [
                Member("way", self._osm.way(points, self._tags_of_bound(each, is_left=is_left)), side)
                for points, side, is_left in ((each.left, "left", True), (each.right, "right", False))
            ]
            own = dict.fromkeys(rule for lane in each.lanes for rule in rules.get(lane, ()))
            own |= {first[each]: None} if each in first else {}
            members += [Member("relation", rule, "regulatory_element") for rule in own]
            tags = {**lanelet_tags(each.main, self._settings), "location": "private"}
            tags.pop("turn_direction", None)
            if each.turn is not None and each.main.road.junction in areas:
                tags |= {"turn_direction": each.turn, "intersection_area": str(areas[each.main.road.junction])}
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
        crossed = {each: len(self._conflicting(each)) for each in lanelets}
        met = [each for each in lanelets if crossed[each]]
        return [each for each in met if each.turn == self._near_side] or sorted(met, key=lambda each: crossed[each])[:1]

    def _conflicting(self, lanelet: DrivenLanelet) -> list[DrivenLanelet]:
        """Return the lanelets from elsewhere on the ground of one; where lanes only part, those from the same lane."""
        ground = self._ground_of[lanelet]
        behind = {*self._before[lanelet]}
        crossing: list[DrivenLanelet] = []
        parting: list[DrivenLanelet] = []
        for index in sorted(self._tree.query(ground).tolist()):
            other = self._lanelets[index]
            is_joined = other is lanelet or lanelet in self._before[other] or other in behind
            if is_joined or self._are_side_by_side(lanelet, other):
                continue
            if shapely.intersection(ground, self._ground_of[other]).area >= _TOUCHING * ground.area:
                (parting if behind & {*self._before[other]} else crossing).append(other)
        return crossing or parting

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
