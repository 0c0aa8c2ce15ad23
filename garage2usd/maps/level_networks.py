"""Road networks of a garage: those of its levels, joined over the ramps between them."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple

from garage2usd.as_built import BuiltGarage, BuiltLevel
from garage2usd.as_built.ramp_line import Bend, RampLine
from garage2usd.common.errors import StageError
from garage2usd.garage import Stall
from garage2usd.maps.arc_line import line_of_arcs
from garage2usd.maps.frame import map_point
from garage2usd.maps.network import Lanes, Neighbour, Network, Road
from garage2usd.maps.road_builder import MOST_PORTAL_LANE_M, elevation, network_of
from garage2usd.maps.road_nodes import Arc, Point, ReferenceLine

_GAP_M = 2.0
"""Greatest gap between the profile of a ramp and the road of the landing at its head."""
_LEVEL_M = 0.01


class LevelNetwork(NamedTuple):
    """The roads of one level.

    Attributes
    ----------
    level
        The level; ids and numbers of its stalls are those in the whole garage.
    network
        Its roads, with numbers that no other level has.
    """

    level: BuiltLevel
    network: Network


class _End(NamedTuple):
    """An end of a road that no other road meets yet."""

    road: Road
    at_start: bool

    @property
    def place(self) -> Point:
        return self.road.line.at(0.0 if self.at_start else self.road.line.length_m)[:2]

    @property
    def height_m(self) -> float:
        return self.road.height_m(0.0 if self.at_start else self.road.line.length_m)


def level_networks(garage: BuiltGarage, *, on_its_side: bool = False) -> tuple[LevelNetwork, ...]:
    """Build the road networks of all levels and join them over the ramps; `on_its_side` as for `network_of`.

    Raises
    ------
    StageError
        If a level has no complete lane graph, or a ramp leads to no landing.
    """
    found: list[LevelNetwork] = []
    first = 0
    for number, level in enumerate(garage.levels):
        here = _with_names_in_whole(level, [stall for stall in garage.stalls if stall.level == number])
        network = _numbered(network_of(here, on_its_side=on_its_side), first, level.place.floor_m)
        first += len(network.roads) + len(network.junctions)
        found.append(LevelNetwork(here, network))
    nodes = garage.lanes.nodes
    linked = [{nodes[number].level for number in (line.nodes[0], line.nodes[-1])} for line in garage.ramp_lines]
    for number, (upper, lower) in enumerate(pairwise(found)):
        if {number, number + 1} not in linked:
            continue
        rise_m = upper.level.place.floor_m - lower.level.place.floor_m
        tops = [end for end in _open_ends(lower.network) if abs(end.height_m - rise_m) < _LEVEL_M]
        landings = [end for end in _open_ends(upper.network) if abs(end.height_m) < _LEVEL_M]
        for top in tops:
            near = min(landings, key=lambda end: math.dist(end.place, top.place), default=None)
            if near is None or math.dist(near.place, top.place) > _GAP_M:
                raise StageError(garage.source, f"the ramp at {top.place} leads to no landing of the level above")
            _join(top, near, rise_m)
    for line in garage.ramp_lines:
        if not line.is_straight:
            first += 1
            _add_bent(garage, found, line, first)
    return tuple(found)


def _with_names_in_whole(level: BuiltLevel, stalls: Sequence[Stall]) -> BuiltLevel:
    """Return a level whose stalls have their ids and numbers in the whole garage."""
    if level.place.is_only:
        return level
    access = {stall.name: stall.access for stall in level.stalls}
    own = (replace(stall, access=access[level.place.own_name(stall.name)]) for stall in stalls)
    return replace(level, stalls=tuple(own))


def _add_bent(garage: BuiltGarage, found: list[LevelNetwork], line: RampLine, number: int) -> None:
    """Add the road of a ramp that bends to the network of the level at its foot, from landing to landing."""
    start, end = (garage.lanes.nodes[node] for node in (line.nodes[0], line.nodes[-1]))
    lower = max(start.level, end.level)
    floor_m = found[lower].level.place.floor_m
    width_m = min(line.width_m, MOST_PORTAL_LANE_M)
    lanes = Lanes(width_m / 2, 0.0, width_m)
    ends = []
    for node, border in ((start, 1), (end, -2)):
        place = map_point((float(line.places[border, 0]), float(line.places[border, 2])))
        landings = [each for each in _open_ends(found[node.level].network) if abs(each.height_m) < _LEVEL_M]
        near = min(landings, key=lambda each: math.dist(each.place, place), default=None)
        if near is None or math.dist(near.place, place) > _GAP_M:
            raise StageError(garage.source, f"the ramp at {node.name} leads to no landing")
        ends.append(near)
        # the lane of the landing is as wide there as that of the ramp
        if near.at_start:
            near.road.start = lanes
        else:
            near.road.end = lanes
    if line.bend is not None:
        reference = _round(line.bend, ends[0].place, ends[1].place)
        profile = _heights(line, line.bend, reference, floor_m)
    else:
        inner = line.places[2:-2]
        between = [map_point((float(x), float(z))) for x, _, z in inner]
        reference, runs = line_of_arcs([ends[0].place, *between, ends[1].place])
        heights = [height - floor_m for height in (inner[0, 1], *inner[:, 1], inner[-1, 1])]
        profile = elevation([*zip(runs, map(float, heights), strict=True)])
    road = Road(number, reference, lanes, lanes, (), profile, floor_m=floor_m)
    for own, other in ((_End(road, at_start=True), ends[0]), (_End(road, at_start=False), ends[1])):
        _meet(own, other)
    network = found[lower].network
    found[lower] = found[lower]._replace(network=replace(network, roads=(*network.roads, road)))


def _round(bend: Bend, start: Point, end: Point) -> ReferenceLine:
    """Return the line of a helix from one point on its straights to another, in the frame of the map."""
    crossing, way_in, way_out = (map_point(each) for each in (bend.crossing, bend.way_in, bend.way_out))
    heading = math.atan2(way_in[1], way_in[0])
    curvature = (1.0 if bend.is_left else -1.0) / bend.radius_m
    lead = Arc(start, heading, math.dist(start, crossing) + bend.radius_m)
    circle = Arc(lead.at(lead.length_m)[:2], heading, 1.5 * math.pi * bend.radius_m, curvature)
    out = math.atan2(way_out[1], way_out[0])
    tail = Arc(circle.at(circle.length_m)[:2], out, math.dist(crossing, end) + bend.radius_m)
    return ReferenceLine((lead, circle, tail))


def _heights(line: RampLine, bend: Bend, reference: ReferenceLine, floor_m: float) -> tuple[tuple[float, float], ...]:
    """Return the elevation profile of a helix along its road, from the heights of its lane nodes."""
    inner = line.places[1:-1]
    apart = [math.dist(one[[0, 2]], other[[0, 2]]) for one, other in pairwise(inner)]
    begin, finish = reference.arcs[0].length_m, reference.arcs[0].length_m + reference.arcs[1].length_m
    runs = [math.dist(reference.arcs[0].start, map_point((float(inner[0, 0]), float(inner[0, 2]))))]
    for far in apart:
        is_on_circle = begin - _LEVEL_M < runs[-1] < finish - _LEVEL_M
        runs.append(runs[-1] + (2 * bend.radius_m * math.asin(far / (2 * bend.radius_m)) if is_on_circle else far))
    heights = (inner[:, 1] - floor_m).tolist()
    return elevation([(0.0, heights[0]), *zip(runs, heights, strict=True), (reference.length_m, heights[-1])])


def _numbered(network: Network, first: int, floor_m: float) -> Network:
    """Return a network with all numbers of roads and junctions raised, and its floor set."""
    for road in network.roads:
        road.number += first
        road.floor_m = floor_m
        road.junction = None if road.junction is None else road.junction + first
        road.predecessor, road.successor = (
            None if end is None else end._replace(number=end.number + first)
            for end in (road.predecessor, road.successor)
        )
    junctions = tuple(
        replace(
            junction,
            number=junction.number + first,
            links=tuple(
                link._replace(incoming=link.incoming + first, connecting=link.connecting + first)
                for link in junction.links
            ),
        )
        for junction in network.junctions
    )
    return Network(network.roads, junctions, network.nodes)


def _open_ends(network: Network) -> Iterator[_End]:
    for road in network.roads:
        if road.predecessor is None:
            yield _End(road, at_start=True)
        if road.successor is None:
            yield _End(road, at_start=False)


def _join(top: _End, landing: _End, rise_m: float) -> None:
    """Lead a ramp's road on to the end of the landing's road, and make the two neighbours."""
    road, gap_m = top.road, math.dist(top.place, landing.place)
    (arc,) = road.line.arcs
    longer_m = arc.length_m + gap_m
    shift_m = gap_m if top.at_start else 0.0
    heights = [(run + shift_m, rise_m if abs(height - rise_m) < _LEVEL_M else height) for run, height in road.profile_m]
    ends = [(0.0, rise_m)] if top.at_start else [(longer_m, rise_m)]
    profile = [*ends, *heights] if top.at_start else [*heights, *ends]
    if gap_m:
        start = landing.place if top.at_start else arc.start
        road.line = ReferenceLine((arc._replace(start=start, length_m=longer_m),))
        road.profile_m = tuple(profile)
    _meet(top, landing)


def _meet(top: _End, landing: _End) -> None:
    """Make the roads of two ends each other's neighbours."""
    for one, other in ((top, landing), (landing, top)):
        sign = 1 if one.at_start != other.at_start else -1
        lanes = {lane: sign * lane for lane in one.road.lanes if sign * lane in other.road.lanes}
        neighbour = Neighbour(other.road.number, at_start=other.at_start)
        if one.at_start:
            one.road.predecessor, one.road.lane_before = neighbour, lanes
        else:
            one.road.successor, one.road.lane_after = neighbour, lanes
