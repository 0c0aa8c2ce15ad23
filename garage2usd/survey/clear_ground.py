"""Lanes from the clear ground of a survey: their medial axis where it has none, and their widths."""

import math
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

import networkx as nx
import numpy as np
import shapely

from garage2usd.common.errors import ConfigError
from garage2usd.garage import LaneGraph, Point
from garage2usd.survey.survey import Survey, SurveyedLane

_LEAST_CLEAR_M, _MOST_CLEAR_M = 2.0, 12.0
_APART_M, _AXIS_M = 0.02, 0.08
_COLUMN_M = 1.0
_WIDTH_DIGITS, _LEAST_SHARE = 4, 0.4
_SPACING_M = 0.5
"""Distance in metres between the points of the ground's boundary whose Voronoi diagram approximates the axis."""
_HALF_LANE_M = 1.3
"""Least distance in metres of a lane's middle from stalls, columns and the boundary: half a lane."""
_CLOSED_M = 10.0
"""Half the width in metres of gaps between stalls that are ground of a survey without an outline."""
_STALL_MARGIN_M = 0.05
_FRONT_M, _TURN_M, _AHEAD_M = 6.0, 3.0, 0.1
"""Depth in metres of the lane before stalls that open onto no gap, and how far it goes on beyond their sides."""
_JOINED_M = 2.0
"""Distance in metres from a lane at which a way to stalls without one begins."""
_OPEN = 0.9
"""Share of the ground of the narrowest lane before a stall from which on it is open."""
_SPUR = 2.0
"""Greatest length of a branch that is left out, as a multiple of the clearance where it begins."""
_STRAIGHT_M = 0.4
_DIGITS = 3
_JUNCTION = 3


def with_clear_widths(network: LaneGraph, standing: shapely.Geometry) -> LaneGraph:
    """Return a lane graph whose lanes are as wide as the clear ground between walls, columns and stalls.

    Parameters
    ----------
    network
        The lane graph.
    standing
        Stalls, columns and walls, (x, z).

    Notes
    -----
    The width of a stretch is twice its distance from the nearest stall, column or wall. The given width is kept if that
    exceeds twelve metres, on open ground, or is less than two, since centre lines of maps may cross stalls.
    """
    portals = {number for number, node in enumerate(network.nodes) if node.is_portal}
    width_m: defaultdict[int, float] = defaultdict(float)
    edges = []
    for edge in network.edges:
        if not portals & {edge.start, edge.end}:
            start, end = (network.nodes[number].position for number in (edge.start, edge.end))
            # columns beside its ends count, unless something stands ahead of one
            for beyond_m in (_COLUMN_M, -_COLUMN_M / 2):
                line = _longer(start, end, beyond_m)
                beside = standing.intersection(line.buffer(_MOST_CLEAR_M, cap_style="flat"))
                clear_m = math.inf if beside.is_empty else round(2 * beside.distance(line), _WIDTH_DIGITS)
                if _LEAST_CLEAR_M <= clear_m <= _MOST_CLEAR_M:
                    edge = edge._replace(width_m=clear_m)  # noqa: PLW2901 - the same edge with its width
                    break
            for number in (edge.start, edge.end):
                width_m[number] = max(width_m[number], edge.width_m)
        edges.append(edge)
    # the road through a door is as wide as the lane that it joins
    edges = [
        edge._replace(width_m=max(width_m[edge.start], width_m[edge.end]) or edge.width_m)
        if portals & {edge.start, edge.end}
        else edge
        for edge in edges
    ]
    nodes = []
    for number, node in enumerate(network.nodes):
        side_m = width_m[number] or node.widths_m[0]
        widths_m = _along_its_lane(network, number, side_m) if number not in portals else (side_m, side_m)
        nodes.append(replace(node, widths_m=widths_m, sides_m=widths_m))
    return LaneGraph(tuple(nodes), tuple(edges))


def _longer(start: Point, end: Point, beyond_m: float) -> shapely.LineString:
    """Lengthen a stretch at both ends; shorten it by less than half for a negative length."""
    share = max(beyond_m / (math.dist(start, end) or 1.0), -_LEAST_SHARE)
    off_x, off_z = share * (end[0] - start[0]), share * (end[1] - start[1])
    return shapely.LineString([(start[0] - off_x, start[1] - off_z), (end[0] + off_x, end[1] + off_z)])


def _along_its_lane(network: LaneGraph, number: int, side_m: float) -> tuple[float, float]:
    """Return the extent of a node's ground along X and Z, which ends where that of the nodes beside it begins."""
    node, halves_m = network.nodes[number], []
    axes = set()
    for other in network.beside[number]:
        beyond = network.nodes[other]
        away = [abs(one - two) for one, two in zip(beyond.position, node.position, strict=True)]
        axes.add(0 if away[1] < _AXIS_M else 1 if away[0] < _AXIS_M else None)
        halves_m.append(max(away) - beyond.widths_m[0] / 2 if beyond.is_portal else max(away) / 2)
    if len(axes) != 1 or None in axes:
        return side_m, side_m
    along_m = round(min(side_m, 2 * min(halves_m) - _APART_M), _WIDTH_DIGITS)
    return (along_m, side_m) if axes == {0} else (side_m, along_m)


def with_medial_lanes(survey: Survey) -> Survey:
    """Return a survey whose lanes are the medial axis of its ground, if it has none.

    Raises
    ------
    ConfigError
        If there is no ground that is wide enough between the stalls.

    Notes
    -----
    The medial axis (Blum, 1967) is the set of places that are equally far from two parts of the boundary. It is
    approximated by the edges of the Voronoi diagram of points on the boundary (Brandt and Algazi, 1992) that keep half
    a lane from it; branches into corners are pruned. The ground is that inside the outline, else that of gaps between
    stalls of up to 20 m, and a lane's width before the mouths of stalls that open onto no such gap.
    """
    if survey.lanes:
        return survey
    for is_open in (_OPEN, math.inf) if survey.outline is None else (_OPEN,):
        ground = _ground(survey, is_open)
        axis = _axis(ground)
        _prune(axis, ground)
        lanes = tuple(SurveyedLane(points) for points in _branches(axis))
        if lanes:
            return replace(survey, lanes=lanes)
    raise ConfigError("lanes", "none", f"lanes, or {2 * _HALF_LANE_M:g} m of ground between stalls")


def with_lanes_to(survey: Survey, laneless: Sequence[int]) -> Survey:
    """Return a survey with an outline and lanes whose stalls of some numbers have lanes too, where there is ground.

    The lanes are the shortest ways on the medial axis of its ground from its lanes to these stalls.
    """
    ground = _ground(survey)
    axis = _axis(ground)
    nodes = sorted(axis)
    if not nodes:
        return survey
    lines = shapely.union_all([shapely.LineString(lane.points) for lane in survey.lanes])
    places = shapely.points(nodes)
    is_joint = shapely.dwithin(places, lines, _JOINED_M)
    joints = {node for node, is_near in zip(nodes, is_joint.tolist(), strict=True) if is_near}
    _, ways = nx.multi_source_dijkstra(axis, joints, weight="length_m") if joints else ({}, {})
    stalls = survey.stall_polygons()
    tree = shapely.STRtree(stalls)
    kept: nx.Graph[Point] = nx.Graph()
    for number in laneless:
        away_m = shapely.distance(places, stalls[number])
        for index in np.argsort(away_m, kind="stable").tolist():
            if away_m[index] > _FRONT_M:
                break
            line = shapely.shortest_line(stalls[number], places[index])
            over = [other for other in tree.query(line, predicate="intersects").tolist() if other != number]
            if nodes[index] in ways and not any(stalls[other].intersection(line).length > _AHEAD_M for other in over):
                nx.add_path(kept, ways[nodes[index]])
                break
    added = tuple(SurveyedLane(points) for points in _branches(kept))
    return replace(survey, lanes=(*survey.lanes, *added))


def _ground(survey: Survey, is_open: float = _OPEN) -> shapely.Geometry:
    """Return the ground between stalls, columns and blocks."""
    stalls = shapely.union_all([ground.buffer(_STALL_MARGIN_M) for ground in survey.stall_polygons()])
    if survey.outline is not None:
        inside = survey.ground
    else:
        inside = stalls.buffer(_CLOSED_M, join_style="mitre").buffer(-_CLOSED_M, join_style="mitre")
        inside = shapely.union_all([inside, *fronts(survey, inside, stalls, is_open)])
    return shapely.difference(inside, shapely.union_all([stalls, *survey.column_polygons(), *survey.solid_polygons()]))


def fronts(
    survey: Survey, inside: shapely.Geometry, stalls: shapely.Geometry, is_open: float = _OPEN
) -> Iterator[shapely.Geometry]:
    """Yield the ground of a lane before each stall that opens onto no ground between stalls, of a share that is open.

    Of its sides that no other stall adjoins, that counts before which there is most ground; the short ones first.
    """
    free = shapely.difference(inside, stalls)
    for stall in survey.stalls:
        corners = np.array(stall.corners)
        found = []
        for side in range(len(corners)) if stall.mouth is None else (stall.mouth,):
            start, end = corners[side], corners[(side + 1) % len(corners)]
            away = (start + end) / 2 - corners.mean(axis=0)
            width_m = float(np.linalg.norm(end - start))
            out = np.array([end[1] - start[1], start[0] - end[0]]) / (width_m or 1.0)
            out = out if out @ away > 0 else -out
            aside = (end - start) / (width_m or 1.0) * _TURN_M
            near, far = start + _AHEAD_M * out, end + _AHEAD_M * out
            before = shapely.Polygon([near, far, far + _FRONT_M * out, near + _FRONT_M * out])
            open_m2 = before.intersection(free).area
            if open_m2 > is_open * min(2 * _HALF_LANE_M, _FRONT_M) / _FRONT_M * before.area:
                break
            is_long = width_m > 2 * float(np.linalg.norm(away))
            taken_m2 = before.intersection(stalls).area
            strip = [near - aside, far + aside, far + aside + _FRONT_M * out, near - aside + _FRONT_M * out]
            found.append((round(taken_m2, 1), is_long, -round(open_m2, 1), side, strip))
        else:
            yield shapely.Polygon(min(found, key=lambda each: each[:4])[-1])


def _axis(ground: shapely.Geometry) -> "nx.Graph[Point]":
    """Return the edges of the Voronoi diagram of the ground's boundary that keep half a lane from it."""
    boundary = shapely.segmentize(ground.boundary, _SPACING_M)
    points = np.unique(shapely.get_coordinates(boundary).round(_DIGITS), axis=0)
    axis: nx.Graph[Point] = nx.Graph()
    if len(points) < _JUNCTION:
        return axis
    edges = shapely.get_parts(shapely.voronoi_polygons(shapely.multipoints(points), only_edges=True))
    segments = [pair for line in edges for pair in pairwise(shapely.get_coordinates(line).round(_DIGITS).tolist())]
    lines = shapely.linestrings(np.array(segments).reshape(-1, 2, 2))
    shapely.prepare(ground)
    is_inside = shapely.covered_by(lines, ground) & (shapely.distance(lines, ground.boundary) >= _HALF_LANE_M)
    for (x, z), (end_x, end_z) in (segments[number] for number in np.flatnonzero(is_inside).tolist()):
        if (x, z) != (end_x, end_z):
            axis.add_edge((x, z), (end_x, end_z), length_m=math.dist((x, z), (end_x, end_z)))
    return axis


def _prune(axis: "nx.Graph[Point]", ground: shapely.Geometry) -> None:
    """Remove branches into corners of the ground: those not much longer than the clearance at their beginning."""
    while True:
        spurs = []
        for tip in [node for node in axis if axis.degree(node) == 1]:
            branch, length_m = [tip], 0.0
            while (
                following := [node for node in axis[branch[-1]] if len(branch) < 2 or node != branch[-2]]  # noqa: PLR2004
            ) and (len(branch) == 1 or axis.degree(branch[-1]) < _JUNCTION):
                length_m += axis.edges[branch[-1], following[0]]["length_m"]
                branch.append(following[0])
            if axis.degree(branch[-1]) < _JUNCTION:
                continue
            clear_m = ground.boundary.distance(shapely.Point(branch[-1]))
            if length_m < _SPUR * clear_m:
                spurs.append((length_m, branch[:-1]))
        if not spurs:
            return
        # one at a time, the shortest first: the rest of a junction may then be one long branch
        axis.remove_nodes_from(min(spurs)[1])


def _branches(axis: "nx.Graph[Point]") -> Iterator[tuple[Point, ...]]:
    """Yield the axis from junction to junction or end, with few points."""
    ends = {node for node in axis if axis.degree(node) != 2}  # noqa: PLR2004 - in the middle of a branch
    seen: set[frozenset[Point]] = set()
    for start in [*sorted(ends), *sorted(axis)]:
        for following in sorted(axis[start]):
            if frozenset((start, following)) in seen:
                continue
            branch = [start, following]
            seen.add(frozenset((start, following)))
            while branch[-1] not in ends and branch[-1] != start:
                ahead = next((node for node in sorted(axis[branch[-1]]) if node != branch[-2]), None)
                if ahead is None:
                    break
                seen.add(frozenset((branch[-1], ahead)))
                branch.append(ahead)
            line = shapely.LineString(branch).simplify(_STRAIGHT_M)
            if line.length > _HALF_LANE_M:
                yield tuple((float(x), float(z)) for x, z in line.coords)
