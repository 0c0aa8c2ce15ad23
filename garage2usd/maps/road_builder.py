"""Builder of a garage's road network from its lane nodes."""
# Over 300 lines: roads of aisles, portals and junctions share which nodes are taken and which ends meet.

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import shapely

from garage2usd.as_built import BuiltLevel
from garage2usd.common.errors import StageError
from garage2usd.driving import RampFloor
from garage2usd.maps.network import LEFT, RIGHT, Junction, LaneLink, Lanes, Neighbour, Network, Road
from garage2usd.maps.road_nodes import OUTSIDE, Opening, Point, RoadNode, road_nodes, straight, turn

MOST_PORTAL_LANE_M = 3.75
"""Greatest width of a portal's lane; wider doors and ramps keep a margin on both sides."""
_PROFILE_M = 5e-4
"""Greatest deviation of a simplified ramp profile."""
_LEAST_M = 1e-6


def network_of(level: BuiltLevel, *, on_its_side: bool = False) -> Network:
    """Build the road network of a garage's lane graph.

    A straight run of squares is one road, from one bend, junction, portal or dead end to the next. A bend is a road,
    and so is the section from a portal's door to the top of its ramp. A node in which three or more roads meet is a
    junction. Roads reach slightly into junction nodes, so that adjacent junctions have a road between them. Traffic
    keeps to the right, or with `on_its_side` to the left in a garage where it does: its roads are then those of the
    mirrored garage, mirrored again. The single lane of a portal is centred in its door.

    Raises
    ------
    StageError
        If the garage has no complete lane graph.
    """
    if not level.has_whole_graph or not level.lanes.edges:
        raise StageError(level.source, "it has no whole lane graph, so that nothing says where its roads are")
    nodes = road_nodes(level)
    if not (on_its_side and level.keeps_left):
        return _Builder(nodes).network()
    network = _Builder(tuple(node.mirrored for node in nodes)).network()
    for road in network.roads:
        road.mirror()
    links = (
        replace(
            junction,
            links=tuple(link._replace(from_lane=-link.from_lane, to_lane=-link.to_lane) for link in junction.links),
        )
        for junction in network.junctions
    )
    return Network(network.roads, tuple(links), nodes)


class _Meeting(NamedTuple):
    """A meeting of road ends: at the side between two nodes, or at an opening of a junction."""

    node: int
    other: int
    is_in_junction: bool = False


class _Reach(NamedTuple):
    """The extent of a straight road from a side."""

    end: Point
    meeting: _Meeting | None
    nodes: tuple[int, ...]
    left_by: tuple[Opening, ...]


class _Path(NamedTuple):
    """A planned road: its ends, corner, lanes and meetings."""

    ends: tuple[Point, Point]
    lanes: tuple[Lanes, Lanes]
    meetings: tuple[_Meeting | None, _Meeting | None]
    nodes: tuple[int, ...] = ()
    corner: Point | None = None
    profile_m: tuple[tuple[float, float], ...] = ()


class _Builder:
    """Builder of roads, node by node, whose ends are joined afterwards."""

    def __init__(self, nodes: tuple[RoadNode, ...]) -> None:
        self._nodes = nodes
        self._roads: list[Road] = []
        self._meetings: dict[Road, tuple[_Meeting | None, _Meeting | None]] = {}
        self._ends: dict[_Meeting, list[tuple[Road, bool]]] = {}
        self._taken: set[int] = set()
        self._crossed: set[_Meeting] = set()

    def network(self) -> Network:
        for node in self._nodes:
            if node.is_portal:
                self._portal(node)
        inner = [node for node in self._nodes if not node.is_portal]
        sides = ((opening.is_one_way, node, opening) for node in inner for opening in node.openings)
        # two-way aisles first: they own a node between a two-way and a one-way aisle
        for _, node, opening in sorted(sides, key=lambda side: side[0]):
            self._aisle(node, opening)
        for node in inner:
            if node.openings and not node.is_junction and node.number not in self._taken:
                self._lone_square(node)
        junctions = self._junctions()
        numbers = {junction.node: junction.number for junction in junctions}
        for road in self._meetings:
            self._join(road, numbers)
        return Network(tuple(self._roads), junctions, self._nodes)

    # Aisles

    def _aisle(self, node: RoadNode, opening: Opening) -> None:
        """Add the straight road across the side between two nodes that are not portals."""
        if self._nodes[opening.towards].is_portal or _side(node.number, opening.towards) in self._crossed:
            return
        beyond = self._nodes[opening.towards]
        behind, ahead = self._reach(node, opening), self._reach(beyond, beyond.opening(node.number))
        self._crossed.add(_side(node.number, opening.towards))
        along = opening.lets_out or any(side.lets_in for side in behind.left_by)
        along = along or any(side.lets_out for side in ahead.left_by)
        against = opening.lets_in or any(side.lets_out for side in behind.left_by)
        against = against or any(side.lets_in for side in ahead.left_by)
        lanes = _halves(opening.width_m, along=along, against=against)
        nodes = (*reversed(behind.nodes), *ahead.nodes)
        self._add(_Path((behind.end, ahead.end), (lanes, lanes), (behind.meeting, ahead.meeting), nodes))

    def _reach(self, node: RoadNode, entered: Opening) -> _Reach:
        """Find the extent of the straight road that enters a node through an opening."""
        numbers: list[int] = []
        left_by: list[Opening] = []
        while True:
            if node.is_junction:
                end, meeting = entered.inside(entered.inset_m), _inside(node.number, entered.towards)
                break
            onward = node.far_from(entered)
            is_dead_end = len(node.openings) == 1
            if node.number in self._taken or (onward is None and not is_dead_end):
                end, meeting = entered.place, _side(node.number, entered.towards)
                break
            numbers.append(node.number)
            if onward is None:
                return _Reach(node.end_opposite(entered), None, tuple(numbers), tuple(left_by))
            left_by.append(onward)
            following = self._nodes[onward.towards]
            is_alike = (onward.lets_out, onward.lets_in) == (entered.lets_in, entered.lets_out)
            if following.is_portal or not is_alike:
                end, meeting = onward.place, _side(node.number, onward.towards)
                break
            self._crossed.add(_side(node.number, onward.towards))
            node, entered = following, following.opening(node.number)
        return _Reach(end, meeting, tuple(numbers), tuple(left_by))

    def _lone_square(self, node: RoadNode) -> None:
        """Add the road of a bend, or of a node with portals as its only neighbours."""
        first, last = node.openings[0], node.openings[-1]
        is_dead_end = first is last
        along = first.lets_in or (last.lets_out and not is_dead_end)
        against = first.lets_out or (last.lets_in and not is_dead_end)
        lanes = (
            _halves(first.width_m, along=along, against=against),
            _halves(last.width_m, along=along, against=against),
        )
        ends = first.place, node.end_opposite(first) if is_dead_end else last.place
        meetings = _side(node.number, first.towards), None if is_dead_end else _side(node.number, last.towards)
        self._add(_Path(ends, lanes, meetings, (node.number,), None if is_dead_end else node.middle))

    # Portals

    def _portal(self, node: RoadNode) -> None:
        """Add the roads from outside to a portal's node, and from there to its neighbours."""
        door, inner = node.opening(OUTSIDE), [side for side in node.openings if side.towards != OUTSIDE]
        reach_m = door.inset_m if node.is_junction else 0.0
        ramp, away_m = node.ramp, node.outside_m
        lane = _passing(door)
        meeting = (_inside if node.is_junction else _side)(node.number, OUTSIDE)
        if ramp is not None or node.is_junction:
            profile = () if ramp is None else _profile(ramp, away_m + reach_m)
            path = _Path((door.inside(-away_m), door.inside(reach_m)), (lane, lane), (None, meeting), (), None, profile)
            self._add(path, is_turned=door.lets_out)
        for opening in inner:
            beyond = self._nodes[opening.towards]
            is_led_here = beyond.is_portal and door.lets_out
            if is_led_here and node.is_junction:
                continue  # the road of the entrance beside this exit leads into it
            is_led_on = beyond.is_junction and not is_led_here
            outer_m = beyond.opening(node.number).inset_m if is_led_on else 0.0
            outer = _inside(beyond.number, node.number) if is_led_on else _side(node.number, beyond.number)
            end, last = opening.inside(-outer_m), _passing(opening)
            if node.is_junction:
                start, before = opening.inside(opening.inset_m), _inside(node.number, beyond.number)
                path = _Path((start, end), (last, last), (before, outer))
            else:
                path = _Path((door.place, end), (lane, last), (meeting, outer), (node.number,), node.middle)
            self._add(path, is_turned=door.lets_out)
        if not inner:
            path = _Path((door.place, node.end_opposite(door)), (lane, lane), (meeting, None), (node.number,))
            self._add(path, is_turned=door.lets_out)

    # Junctions

    def _junctions(self) -> tuple[Junction, ...]:
        """Add the connecting roads of junctions, and number the junctions after all roads."""
        ways = [(node, list(self._connections(node))) for node in self._nodes if node.is_junction]
        junctions = []
        for number, (node, connections) in enumerate(ways, len(self._roads) + 1):
            for road, _ in connections:
                road.junction = number
            junctions.append(Junction(number, node.number, tuple(link for _, link in connections)))
        return tuple(junctions)

    def _connections(self, node: RoadNode) -> Iterator[tuple[Road, LaneLink]]:
        for entered in node.openings:
            for left in node.openings:
                if entered is not left and entered.lets_in and left.lets_out:
                    yield self._connection(node, entered, left)

    def _connection(self, node: RoadNode, entered: Opening, left: Opening) -> tuple[Road, LaneLink]:
        first, last = _passing(entered), _passing(left)
        start, end = entered.inside(entered.inset_m), left.inside(left.inset_m)
        corner = None
        if node.far_from(entered) is not left:
            # along the middle of the lane, whose bend is tighter or wider than that of the road's middle line
            inwards = -entered.outwards[0], -entered.outwards[1]
            start = _beside(start, inwards, first.centre_m(RIGHT))
            end = _beside(end, left.outwards, last.centre_m(RIGHT))
            corner = _crossing(start, inwards, end, left.outwards)
            first, last = (Lanes(lanes.right_m / 2, 0.0, lanes.right_m) for lanes in (first, last))
        road = Road(
            len(self._roads) + 1,
            straight(start, end) if corner is None else turn(start, corner, end),
            first,
            last,
            (node.number,),
        )
        self._roads.append(road)
        ((incoming, comes_at_start),) = self._ends[_inside(node.number, entered.towards)]
        ((outgoing, goes_at_start),) = self._ends[_inside(node.number, left.towards)]
        from_lane, to_lane = (LEFT if comes_at_start else RIGHT), (RIGHT if goes_at_start else LEFT)
        road.predecessor = Neighbour(incoming.number, at_start=comes_at_start)
        road.successor = Neighbour(outgoing.number, at_start=goes_at_start)
        road.lane_before, road.lane_after = {RIGHT: from_lane}, {RIGHT: to_lane}
        return road, LaneLink(incoming.number, road.number, from_lane, RIGHT)

    # All roads

    def _add(self, path: _Path, *, is_turned: bool = False) -> None:
        """Add a planned road, reversed if traffic runs from its end; roads without length are omitted."""
        if is_turned or path.lanes[0].right_m == 0:
            path = _from_end(path)
        start, end = path.ends
        line = straight(start, end) if path.corner is None else turn(start, path.corner, end)
        self._taken.update(path.nodes)
        if line.length_m < _LEAST_M:
            return
        road = Road(len(self._roads) + 1, line, *path.lanes, path.nodes, path.profile_m)
        self._roads.append(road)
        self._meetings[road] = path.meetings
        for meeting, at_start in zip(path.meetings, (True, False), strict=True):
            if meeting is not None:
                self._ends.setdefault(meeting, []).append((road, at_start))

    def _join(self, road: Road, junction_of: dict[int, int]) -> None:
        before, after = self._meetings[road]
        road.predecessor, road.lane_before = self._beyond(road, before, junction_of, at_start=True)
        road.successor, road.lane_after = self._beyond(road, after, junction_of, at_start=False)

    def _beyond(
        self, road: Road, meeting: _Meeting | None, junction_of: dict[int, int], *, at_start: bool
    ) -> tuple[Neighbour | None, dict[int, int]]:
        """Map a road's end to its successor road and lanes."""
        if meeting is None:
            return None, {}
        if meeting.is_in_junction:
            return Neighbour(junction_of[meeting.node], is_junction=True), {}
        for other, other_at_start in self._ends[meeting]:
            if other is not road:
                # lane numbers keep their sign between roads of the same direction, and change it between opposite ones
                sign = 1 if at_start != other_at_start else -1
                lanes = {lane: sign * lane for lane in road.lanes if sign * lane in other.lanes}
                return Neighbour(other.number, at_start=other_at_start), lanes
        return None, {}


def _side(node: int, other: int) -> _Meeting:
    return _Meeting(max(node, other), min(node, other))


def _inside(node: int, other: int) -> _Meeting:
    return _Meeting(node, other, is_in_junction=True)


def _halves(width_m: float, *, along: bool, against: bool) -> Lanes:
    """Return one lane on each half of a carriageway that is open to traffic."""
    return Lanes(0.0, width_m / 2 * against, width_m / 2 * along)


def _passing(opening: Opening) -> Lanes:
    """Return the lanes through an opening: on the right half, or in the middle of a door."""
    if opening.towards != OUTSIDE:
        return _halves(opening.width_m, along=True, against=False)
    width_m = min(opening.width_m, MOST_PORTAL_LANE_M)
    return Lanes(width_m / 2, 0.0, width_m)


def _from_end(path: _Path) -> _Path:
    """Reverse a planned road and its lanes; a single lane keeps its offset."""
    length_m = max((run for run, _ in path.profile_m), default=0.0)
    one_way = path.lanes[0].left_m == 0
    lanes = path.lanes if one_way else tuple(Lanes(-lane.middle_m, lane.right_m, lane.left_m) for lane in path.lanes)
    return path._replace(
        ends=(path.ends[1], path.ends[0]),
        lanes=(lanes[1], lanes[0]),
        meetings=(path.meetings[1], path.meetings[0]),
        nodes=tuple(reversed(path.nodes)),
        profile_m=tuple((length_m - run, height) for run, height in reversed(path.profile_m)),
    )


def _beside(place: Point, along: Point, left_m: float) -> Point:
    return place[0] - along[1] * left_m, place[1] + along[0] * left_m


def _crossing(start: Point, along: Point, end: Point, onward: Point) -> Point:
    """Intersect two lines, each given by a point and a second point or direction."""
    over = along[0] * onward[1] - along[1] * onward[0]
    dx, dy = end[0] - start[0], end[1] - start[1]
    run = (dx * onward[1] - dy * onward[0]) / over
    return start[0] + run * along[0], start[1] + run * along[1]


def _profile(ramp: RampFloor, length_m: float) -> tuple[tuple[float, float], ...]:
    """Return the elevation profile from the top of a ramp into the garage, piecewise linear."""
    top_m = float(ramp.runs_m[-1])
    down = [(top_m - run, height) for run, height in zip(ramp.runs_m.tolist(), ramp.heights_m.tolist(), strict=True)]
    return elevation([*down[::-1], (length_m, down[0][1])])


def elevation(heights: Sequence[tuple[float, float]]) -> tuple[tuple[float, float], ...]:
    """Return (s, height) pairs without those that lie on the line between others."""
    line = shapely.LineString(heights).simplify(_PROFILE_M)
    return tuple((s, height) for s, height in shapely.get_coordinates(line).tolist())
