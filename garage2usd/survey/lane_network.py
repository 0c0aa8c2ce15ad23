"""The lane graph of a survey: centre lines lengthened to their junctions and joined, with nodes a few metres apart."""
# Over 300 lines: lines are lengthened by the rules by which they are joined.

import math
from collections import defaultdict
from collections.abc import Iterable, Sequence
from itertools import combinations, pairwise
from typing import NamedTuple

import networkx as nx
import shapely
import shapely.ops

from garage2usd.garage import LaneEdge, LaneGraph, LaneKind, LaneNode, Point
from garage2usd.survey.survey import SurveyedLane

SAME_M = 0.75
"""Distance in metres up to which ends and crossings of centre lines are one node."""
_GAP_M = 1.0
"""Gap in metres beyond half a lane's width up to which the end of a centre line joins the next one."""
_AHEAD_M = 8.0
"""Gap in metres straight ahead of its end up to which a centre line joins the next one, where no stall lies between."""
USUAL_LANE_M = 6.0
"""Width in metres of a lane whose width is unknown."""
_GATE_HALF_M, _LEAST_GATE_M = 2.5, 1.0
"""Half the side in metres of the ground of a portal's node, which ends at the wall."""
_LANDING_M = 1.5
"""Depth in metres of the ground of a landing's node, before a ramp."""
_AHEAD_COS = 0.7
"""Cosine of the angle up to which a lane leads towards a door."""
_PITCH_M = 6.0
"""Greatest distance in metres between nodes."""
_STRAIGHT_M = 0.15
"""Deviation in metres up to which a centre line is straight."""
_TWO_ENDS, _CROSSROADS = 2, 4
_TOUCH_M = 0.05
_DIGITS = 4


class CentreLine(NamedTuple):
    """A centre line, the width of its lane in metres, and True if cars drive along it only."""

    line: shapely.LineString
    width_m: float
    one_way: bool


def joined_lines(
    lines: Sequence[CentreLine],
    grounds: shapely.STRtree,
    walls: shapely.Geometry | None = None,
    inside: shapely.Geometry | None = None,
    landings: Sequence["Gate"] = (),
) -> list[CentreLine]:
    """Extend the ends of centre lines that stop short of another one, over no stall, through no wall, and inside.

    An end before a landing remains: the lane continues on the ramp.
    """
    walls = shapely.MultiLineString() if walls is None else walls
    joined = []
    for number, each in enumerate(lines):
        points = list(each.line.coords)
        others = [other for index, other in enumerate(lines) if index != number]
        for place in () if each.line.is_ring else (0, -1):
            end = shapely.Point(points[place])
            if any(other.line.distance(end) <= SAME_M for other in others):
                continue
            if any(gate.is_before(_ends(each.line)[place]) for gate in landings):
                continue
            near = [other for other in others if other.line.distance(end) <= other.width_m / 2 + _GAP_M]
            if near:
                other = min(near, key=lambda found: found.line.distance(end))
                foot = other.line.interpolate(other.line.project(end)).coords[0]
            else:
                foot = _ahead(_ends(each.line)[place], others, grounds)
            if foot is None or (inside is not None and not inside.dwithin(shapely.Point(foot), _GAP_M)):
                continue
            if not walls.crosses(shapely.LineString([end, foot])):
                points.insert(0 if place == 0 else len(points), foot)
        joined.append(each._replace(line=shapely.LineString(points)))
    return joined


def _ahead(points: Sequence[Point], others: Iterable[CentreLine], grounds: shapely.STRtree) -> Point | None:
    """Return the nearest place on another centre line straight ahead of the end of one; None without one."""
    end, ray = shapely.Point(points[-1]), _ray(points)
    met = [other.line.intersection(ray) for other in others if other.line.intersects(ray)]
    # two lines that both stop short of their corner meet in it
    corners = [ray.intersection(_ray(points)) for other in others for points in _ends(other.line)]
    met += [corner for corner in corners if corner.geom_type == "Point" and not corner.is_empty]
    if not met:
        return None
    way = shapely.shortest_line(end, min(met, key=end.distance))
    foot = shapely.Point(way.coords[-1])
    if len(grounds) and len(grounds.query(way, predicate="intersects")):
        return None
    return float(foot.x), float(foot.y)


def _ends(line: shapely.LineString) -> tuple[Sequence[Point], Sequence[Point]]:
    """Return the points of a line in the order towards each end."""
    points = list(line.coords)
    return points[::-1], points


def _ray(points: Sequence[Point]) -> shapely.LineString:
    """Return the straight line ahead of the last of some points."""
    (x, z), (end_x, end_z) = points[-2:]
    scale = _AHEAD_M / math.dist((x, z), (end_x, end_z))
    return shapely.LineString([(end_x, end_z), (end_x + (end_x - x) * scale, end_z + (end_z - z) * scale)])


class Gate(NamedTuple):
    """A way of cars through a door in the outer wall; a door for both directions has two.

    Attributes
    ----------
    kind
        Entrance or exit.
    foot
        (x, z) where the middle of the way crosses the wall.
    outwards
        Unit vector (x, z) out of the garage.
    wall_m
        Length of the piece of wall around the door.
    door
        (x, z) of the middle of the door, if it is for both directions; else it is the foot.
    lane
        (x, z) on the centre line that the way leads to; None for any.
    is_landing
        True where a ramp to another level begins instead.
    """

    kind: LaneKind
    foot: Point
    outwards: Point
    wall_m: float
    door: Point | None = None
    lane: Point | None = None
    is_landing: bool = False

    def is_ahead(self, points: Sequence[Point]) -> bool:
        """Return True if the last two of some points lead towards the door rather than past it."""
        (x, z), (end_x, end_z) = points[-2:]
        along = (end_x - x) * self.outwards[0] + (end_z - z) * self.outwards[1]
        return along > _AHEAD_COS * math.dist((x, z), (end_x, end_z))

    def is_before(self, points: Sequence[Point]) -> bool:
        """Return True if the last of some points lies before the door, and they lead towards it."""
        (x, z), (foot_x, foot_z) = points[-1], self.foot
        along = (foot_x - x) * self.outwards[0] + (foot_z - z) * self.outwards[1]
        aside = abs((foot_x - x) * self.outwards[1] - (foot_z - z) * self.outwards[0])
        return 0.0 <= along <= _AHEAD_M and aside <= self.wall_m / 2 and self.is_ahead(points)


class _Approach(NamedTuple):
    """The lane graph's node of a door, the half side of its ground, and the line between it and the lane ahead."""

    gate: Gate
    node: Point
    half_m: float
    line: CentreLine


def lane_network(
    lanes: Iterable[SurveyedLane],
    gates: Sequence[Gate],
    grounds: Sequence[shapely.Polygon] = (),
    walls: shapely.Geometry | None = None,
    inside: shapely.Geometry | None = None,
) -> LaneGraph:
    """Build the lane graph of centre lines and doors.

    Parameters
    ----------
    lanes
        Centre lines of lanes.
    gates
        Doors; each joins the centre line ahead of it, else the nearest one.
    grounds
        Grounds of stalls, which no lane leads over.
    walls
        Lines of walls and of blocks, through which no lane is joined to another one or to a door.
    inside
        The ground inside the outlines, beyond which no lanes are joined; None for all ground.

    Notes
    -----
    Ends of centre lines that stop short of another one are extended to it. Stretches that no junction joins to the
    others remain in the graph: no stall is reached there.
    """
    stalls = shapely.STRtree(list(grounds))
    landings = [gate for gate in gates if gate.is_landing]
    lines = joined_lines([_line(lane) for lane in lanes], stalls, walls, inside, landings)
    free_m = [_free_m(gate, stalls) for gate in gates]
    ends = shapely.STRtree([line.line for line in lines])
    lines = [_short_of(line, gates, free_m, ends) for line in lines]
    shortened = shapely.STRtree([line.line for line in lines])
    approaches = [_approach(gate, lines, shortened, stalls, walls) for gate in gates]
    lines += [approach.line for approach in approaches]
    cuts = _cuts(lines)
    nodes, number_of = _merged([point for points in cuts for _, point in points])
    arcs: dict[tuple[int, int], tuple[float, bool]] = {}
    count = 0
    for line, points in zip(lines, cuts, strict=True):
        numbers = [number_of[count + index] for index in range(len(points))]
        count += len(points)
        for start, end in pairwise(numbers):
            if start != end and (start, end) not in arcs and ((end, start) not in arcs or line.one_way):
                arcs[start, end] = line.width_m, line.one_way
    both = {arc for arc in arcs if arc[::-1] in arcs}
    edges = [
        (start, end, width_m, one_way and (start, end) not in both)
        for (start, end), (width_m, one_way) in arcs.items()
        if (start, end) not in both or start < end
    ]
    return _graph(nodes, edges, approaches)


def _line(lane: SurveyedLane) -> CentreLine:
    line = shapely.LineString(lane.points).simplify(_STRAIGHT_M)
    return CentreLine(line, lane.width_m or USUAL_LANE_M, lane.one_way)


def _free_m(gate: Gate, stalls: shapely.STRtree) -> float:
    """Return how deep the ground inside a door is before the first stall beside it begins."""
    (x, z), (out_x, out_z) = gate.foot, gate.outwards
    deep_m = 2 * _GATE_HALF_M
    way = shapely.LineString([gate.foot, (x - out_x * deep_m, z - out_z * deep_m)])
    ground = way.buffer((gate.wall_m + USUAL_LANE_M) / 2 + _GAP_M, cap_style="flat")
    near = stalls.geometries[stalls.query(ground, predicate="intersects")]
    places = shapely.get_coordinates(shapely.intersection(near, ground))
    return float(min([deep_m, *((x - places[:, 0]) * out_x + (z - places[:, 1]) * out_z)]))


def _short_of(line: CentreLine, gates: Sequence[Gate], free_m: Sequence[float], lines: shapely.STRtree) -> CentreLine:
    """Return a centre line without an end before a door that joins no other, where the ground of the door's node is.

    The line ends nearer to a door with stalls beside it, so that they open onto it.
    """
    for gate, free in zip(gates, free_m, strict=True):
        (x, z), (out_x, out_z) = gate.foot, gate.outwards
        for place in () if line.line.is_ring else (0, -1):
            end_x, end_z = line.line.coords[place]
            if _is_joined(shapely.Point(end_x, end_z), lines):
                continue
            aside_m = abs((end_x - x) * out_z - (end_z - z) * out_x)
            if gate.is_landing and not gate.is_ahead(_ends(line.line)[place]):
                continue
            deep_m = _LANDING_M if gate.is_landing else 2 * _GATE_HALF_M + line.width_m / 2
            if not gate.is_landing and free < 2 * _GATE_HALF_M:
                deep_m = min(deep_m, free + max(aside_m, _LEAST_GATE_M / 2) + 2 * _LEAST_GATE_M)
            across = [(x - out_x * deep, z - out_z * deep) for deep in (-deep_m, deep_m)]
            ground = shapely.LineString(across).buffer(gate.wall_m / 2 + _TOUCH_M, cap_style="flat")
            if not ground.covers(shapely.Point(end_x, end_z)):
                continue
            way = line.line if place == 0 else line.line.reverse()
            crossed = shapely.get_coordinates(way.intersection(ground.exterior))
            run_m = min((way.project(shapely.Point(at)) for at in crossed), default=way.length)
            if way.length - run_m > SAME_M:
                rest = shapely.ops.substring(way, run_m, way.length)
                line = line._replace(line=rest if place == 0 else rest.reverse())
    return line


def _is_joined(end: shapely.Point, lines: shapely.STRtree) -> bool:
    """Return True if the end of a line lies on another one."""
    return len(lines.query(end, predicate="dwithin", distance=SAME_M)) > 1


def _approach(
    gate: Gate,
    lines: Sequence[CentreLine],
    tree: shapely.STRtree,
    stalls: shapely.STRtree,
    walls: shapely.Geometry | None,
) -> _Approach:
    """Find the line from a door's node to the lane ahead, else the nearest one; reversed for an exit.

    A lane that ends before the door is ahead of it, though it bends and ends beside the middle of the door.
    A way over stalls or through walls is taken only where there is no other.
    """
    foot, (out_x, out_z) = shapely.Point(gate.foot), gate.outwards
    reach_m = 2 * min(each.line.distance(foot) for each in lines) + SAME_M
    ray = shapely.LineString([gate.foot, (foot.x - out_x * reach_m, foot.y - out_z * reach_m)])
    ways = []
    asked = lines if gate.lane is None else [min(lines, key=lambda each: each.line.distance(shapely.Point(gate.lane)))]
    for number, each in enumerate(asked):
        ends = [shapely.Point(each.line.coords[place]) for place in (0, -1)]
        if each.line.intersects(ray):
            ends.append(shapely.Point(shapely.shortest_line(foot, each.line.intersection(ray)).coords[-1]))
        ends.append(each.line.interpolate(each.line.project(foot)))
        for place, end in enumerate(ends):
            is_loose = place < _TWO_ENDS and not _is_joined(end, tree)
            aside_m = each.width_m / 2 if is_loose else _TOUCH_M
            is_ahead = ray.distance(end) < aside_m and (is_loose or each.line.intersects(ray))
            way = shapely.LineString([foot, end]).difference(foot.buffer(_TOUCH_M))
            shut = 0 if walls is None else int(walls.intersects(way))
            shut += len(stalls.query(way, predicate="crosses"))
            ways.append((shut, not is_ahead, round(foot.distance(end), _DIGITS), number, end))
    *_, number, end = min(ways, key=lambda way: way[:4])
    ahead = asked[number]
    # the ground of the node ends where that of the lane begins
    free_m = max(foot.distance(end) - ahead.width_m / 2, _LEAST_GATE_M)
    half_m = round(min(_GATE_HALF_M, free_m / 2), _DIGITS)
    node = round(foot.x - out_x * half_m, _DIGITS), round(foot.y - out_z * half_m, _DIGITS)
    line = [node, end.coords[0]]
    if gate.kind is LaneKind.EXIT:
        line.reverse()
    return _Approach(gate, node, half_m, CentreLine(shapely.LineString(line), 2 * half_m, one_way=True))


def _cuts(lines: Sequence[CentreLine]) -> list[list[tuple[float, Point]]]:
    """Return the nodes of each line by their distance along it: ends, bends, crossings, and more in between."""
    at: list[set[float]] = [
        {0.0, each.line.length, *(each.line.project(shapely.Point(point)) for point in each.line.coords)}
        for each in lines
    ]
    for (one, first), (other, second) in combinations(enumerate(lines), 2):
        if first.line.distance(second.line) > SAME_M:
            continue
        for point in _meetings(first.line, second.line):
            at[one].add(first.line.project(point))
            at[other].add(second.line.project(point))
    return [_pitched(each.line, _apart(found)) for each, found in zip(lines, at, strict=True)]


def _meetings(first: shapely.LineString, second: shapely.LineString) -> list[shapely.Point]:
    """Return the points where two lines cross, and the ends of each that touch the other."""
    crossed = [part for part in shapely.get_parts(first.intersection(second)) if part.geom_type == "Point"]
    ends = [
        shapely.Point(line.coords[place])
        for line, other in ((first, second), (second, first))
        for place in (0, -1)
        if other.distance(shapely.Point(line.coords[place])) <= SAME_M
    ]
    return crossed + ends


def _apart(at: Iterable[float]) -> list[float]:
    """Return distances along a line, without those close to the one before; the first and the last remain."""
    ordered = sorted(at)
    kept = [ordered[0]]
    kept += [run for run in ordered[1:-1] if run - kept[-1] > SAME_M and ordered[-1] - run > SAME_M]
    return [*kept, ordered[-1]]


def _pitched(line: shapely.LineString, runs: Sequence[float]) -> list[tuple[float, Point]]:
    """Return the points at distances along a line, with further ones so that no two are far apart."""
    points = []
    for start, end in pairwise(runs):
        parts = max(1, math.ceil((end - start) / _PITCH_M - 1e-9))
        points += [start + (end - start) * part / parts for part in range(parts)]
    points.append(runs[-1])
    return [
        (run, (round(point.x, _DIGITS), round(point.y, _DIGITS))) for run in points for point in [line.interpolate(run)]
    ]


def _merged(points: Sequence[Point]) -> tuple[list[Point], list[int]]:
    """Return distinct points and the number of each given point among them; close ones are the first of them."""
    tree = shapely.STRtree(shapely.points(points))
    one, other = tree.query(shapely.points(points), predicate="dwithin", distance=SAME_M)
    near: defaultdict[int, list[int]] = defaultdict(list)
    for index, neighbour in zip(one.tolist(), other.tolist(), strict=True):
        near[index].append(neighbour)
    number_of: dict[int, int] = {}
    kept: list[Point] = []
    for index, point in enumerate(points):
        if index in number_of:
            continue
        for neighbour in near[index]:
            number_of.setdefault(neighbour, len(kept))
        kept.append(point)
    return kept, [number_of[index] for index in range(len(points))]


def _graph(
    nodes: Sequence[Point], edges: Sequence[tuple[int, int, float, bool]], approaches: Sequence[_Approach]
) -> LaneGraph:
    """Return the lane graph with the kind and width of each node; portals first, the others as they were found."""
    approach_of = {
        min(range(len(nodes)), key=lambda number: math.dist(nodes[number], each.node)): each for each in approaches
    }
    beside: nx.Graph[int] = nx.Graph((start, end) for start, end, _, _ in edges)
    width_m: defaultdict[int, float] = defaultdict(float)
    for start, end, width, _ in edges:
        if start not in approach_of and end not in approach_of:
            width_m[start], width_m[end] = max(width_m[start], width), max(width_m[end], width)
    order = sorted(beside, key=lambda number: (number not in approach_of, number))
    new = {number: index for index, number in enumerate(order)}
    found = []
    for index, number in enumerate(order):
        approach = approach_of.get(number)
        if approach is not None:
            kind, place, side_m = approach.gate.kind, approach.node, 2 * approach.half_m
        else:
            kind, place = _kind(beside.degree(number)), nodes[number]
            side_m = round(width_m[number] or USUAL_LANE_M, _DIGITS)
        found.append(LaneNode(kind.value, place, (side_m, side_m), f"[0, {index}]", sides_m=(side_m, side_m)))
    return LaneGraph(
        tuple(found),
        tuple(LaneEdge(new[start], new[end], round(width, _DIGITS), one_way) for start, end, width, one_way in edges),
    )


def _kind(degree: int) -> LaneKind:
    if degree >= _CROSSROADS:
        return LaneKind.CROSSROADS
    return LaneKind.T_JUNCTION if degree > _TWO_ENDS else LaneKind.STRAIGHT
