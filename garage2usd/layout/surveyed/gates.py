"""Doors of surveyed garages on the sides of the outline: those of the survey, and those that its lanes lack."""

import math
from collections.abc import Collection, Iterable, Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

import networkx as nx
import numpy as np
import shapely

from garage2usd.common.errors import ConfigError
from garage2usd.config.site import DOOR_JAMB_M
from garage2usd.garage import LaneGraph, LaneKind
from garage2usd.objects.kind import Point
from garage2usd.survey.lane_network import Gate
from garage2usd.survey.survey import Ground, PortalKind, SurveyedPortal

LEAST_WALL_M = 0.02
_LEAST_DOOR_WALL_M = 2.3
"""Least length of the piece of wall around a door: as wide as a stall for cars."""
_DOOR_M, _LEAST_JAMB_M, _TWO_WAY_M = 2.8, 0.1, 5.8
"""Width of a door for one way from which on its jambs are thinner where there is little room, and their least width;
and the greatest width of a door for both ways."""
_DOOR_WALL_M = 3.0
"""Length of the piece of wall around a door that is wide enough for comfort."""
_DOOR_DEPTHS_M = (5.0, 1.0)
"""Depths of the ground inside a door that stalls, columns and blocks leave free: the usual one, else the least."""
_APPROACH_HALF_M = 1.2
"""Half the width in metres of the free way between a door that the survey lacks and its lane."""
_REACH_M = 60.0
_OTHERWISE_M = 1e-3
_KINDS = {
    PortalKind.ENTRANCE: (LaneKind.ENTRANCE,),
    PortalKind.EXIT: (LaneKind.EXIT,),
    PortalKind.BOTH: (LaneKind.ENTRANCE, LaneKind.EXIT),
}
_SAME_M = 1.0
"""Distance between two doors of one kind up to which they are one."""
_DIGITS = 6


class Side(NamedTuple):
    """A side of the outline from start to end, with the inside on its right, seen from above with z downwards."""

    start: Point
    end: Point

    @property
    def length_m(self) -> float:
        """Its length."""
        return math.dist(self.start, self.end)

    @property
    def along(self) -> Point:
        """Unit vector (x, z) from its start to its end."""
        length_m = self.length_m
        return (self.end[0] - self.start[0]) / length_m, (self.end[1] - self.start[1]) / length_m

    @property
    def outwards(self) -> Point:
        """Unit vector (x, z) out of the garage."""
        x, z = self.along
        return z, -x

    def at(self, run_m: float, inwards_m: float = 0.0) -> Point:
        """Return the point (x, z) at a distance from the start, and at one inwards."""
        (x, z), (out_x, out_z) = self.along, self.outwards
        return self.start[0] + run_m * x - inwards_m * out_x, self.start[1] + run_m * z - inwards_m * out_z

    def run_m(self, point: Point) -> float:
        """Return the distance along the side, from its start, of a point (x, z) beside it."""
        x, z = self.along
        return (point[0] - self.start[0]) * x + (point[1] - self.start[1]) * z

    def distance_m(self, point: Point) -> float:
        """Return the distance of a point (x, z) from the side."""
        return float(shapely.LineString([self.start, self.end]).distance(shapely.Point(point)))


def sides_of(outline: Ground) -> list[Side]:
    """Return the sides of all outlines, each as `sides_of_lot` does."""
    return [side for lot in shapely.get_parts(outline) for side in sides_of_lot(lot)]


def sides_of_lot(outline: shapely.Polygon) -> list[Side]:
    """Return the sides of an outline in order, the inside on the right of each, seen from above with z downwards."""
    corners = np.array(outline.exterior.coords)[:, :2]
    # seen with z downwards, a positive area in x and z runs clockwise
    clockwise = float(np.sum(corners[:-1, 0] * corners[1:, 1] - corners[1:, 0] * corners[:-1, 1])) > 0
    points = corners if clockwise else corners[::-1]
    rounded = [(round(float(x), _DIGITS), round(float(z), _DIGITS)) for x, z in points]
    return [Side(start, end) for start, end in pairwise(rounded) if math.dist(start, end) > LEAST_WALL_M]


def gates_of(
    outline: Ground,
    portals: Iterable[SurveyedPortal],
    taken: shapely.Geometry,
    *,
    door_wall_m: float,
    keeps_left: bool,
    others: Sequence[Gate] = (),
) -> list[Gate]:
    """Place doors on outlines.

    Parameters
    ----------
    outline
        The ground inside the outlines.
    portals
        Places of the doors; each door is on the nearest side that is long enough.
    taken
        Ground of stalls, columns and blocks, in front of which no door opens if there is room beside it.
    door_wall_m
        Length of the piece of wall around a door; less where the side of the outline or the free ground is shorter.
    keeps_left
        True if traffic keeps to the left: the side of the entrance beside the exit of the same portal.
    others
        Doors that are there.

    Raises
    ------
    ConfigError
        If the outline has no side that is long enough for a door.
    """
    sides = sides_of(outline)
    gates: list[Gate] = []
    for portal in portals:
        kinds = _KINDS[portal.kind]
        needed_m = len(kinds) * _LEAST_DOOR_WALL_M + 2 * LEAST_WALL_M
        most_m = door_wall_m if len(kinds) == 1 else _TWO_WAY_M + 2 * DOOR_JAMB_M
        able = [side for side in sides if side.length_m >= needed_m]
        if not able:
            longest_m = max(side.length_m for side in sides)
            raise ConfigError("outline", f"sides of at most {longest_m:.2f} m", f"a side of {needed_m} m for a portal")
        side = min(able, key=lambda each: round(each.distance_m(portal.position), _DIGITS))
        doors = [gate for gate in (*others, *gates) if side.distance_m(gate.foot) < LEAST_WALL_M]
        at_m = side.run_m(portal.position)
        here = {each.kind for each in doors if math.dist(each.door or each.foot, side.at(at_m)) < _SAME_M}
        if here.issuperset(kinds):
            continue  # a door and the end of its road outside, say
        low, high = _free_run_m(side, at_m, taken, doors, needed_m)
        # doors are rather narrower than beside the place of their portal
        centred_m = max(2 * min(at_m - low, high - at_m), len(kinds) * _DOOR_WALL_M)
        wall_m = round(min(most_m, min(centred_m, high - low) - 2 * LEAST_WALL_M), _DIGITS)
        room_m = wall_m / 2 + LEAST_WALL_M
        middle = min(max(at_m, low + room_m), high - room_m)
        door = None if len(kinds) == 1 else _point(side.at(middle))
        # along the side the inside is on the right, so the start of the side is on the right of cars that come in
        ordered = kinds[::-1] if keeps_left else kinds
        for number, kind in enumerate(ordered):
            aside_m = (number - (len(kinds) - 1) / 2) * door_width_m(wall_m, len(kinds)) / 2
            gates.append(Gate(kind, _point(side.at(middle + aside_m)), side.outwards, wall_m, door))
    return gates


def door_width_m(wall_m: float, ways: int) -> float:
    """Return the width of a door for one way or two in a piece of wall, whose jambs are thinner where it is short."""
    return round(wall_m - 2 * min(DOOR_JAMB_M, max((wall_m - ways * _DOOR_M) / 2, _LEAST_JAMB_M)), _DIGITS)


def _free_run_m(
    side: Side, at_m: float, taken: shapely.Geometry, doors: Iterable[Gate], needed_m: float
) -> tuple[float, float]:
    """Return the ends of the free piece of a side around or near a place on it; the whole side if none has room."""
    runs_m = [(side.run_m(gate.door or gate.foot), gate.wall_m / 2) for gate in doors]
    shut = [(run - half_m, run + half_m) for run, half_m in runs_m]
    for depth_m in _DOOR_DEPTHS_M:
        corners = ((0.0, LEAST_WALL_M), (side.length_m, LEAST_WALL_M), (side.length_m, depth_m), (0.0, depth_m))
        before = shapely.intersection(taken, shapely.Polygon([side.at(*corner) for corner in corners]))
        parts = [part for part in shapely.get_parts(before) if part.area > LEAST_WALL_M**2]
        spans = [[side.run_m((x, z)) for x, z in shapely.get_coordinates(part).tolist()] for part in parts]
        bounds = [0.0]
        for low, high in sorted([*shut, *((min(runs), max(runs)) for runs in spans)]):
            if low > bounds[-1]:
                bounds += [low, high]
            else:
                bounds[-1] = max(bounds[-1], high)
        bounds.append(max(side.length_m, bounds[-1]))
        free = [(low, high) for low, high in zip(bounds[::2], bounds[1::2], strict=True) if high - low >= needed_m]
        if free:
            low, high = min(free, key=lambda run: (round(max(run[0] - at_m, at_m - run[1], 0.0), _DIGITS), run))
            if low - at_m < needed_m and at_m - high < needed_m:
                return low, high
    return 0.0, side.length_m


def lacking_portals(
    outline: Ground, network: LaneGraph, taken: shapely.Geometry, asked: Collection[int], *, is_near: bool
) -> dict[Point, SurveyedPortal]:
    """Return portals for lanes that cars do not reach from an entrance, or from which they reach no exit.

    Each is given by the place on the lane that it is for.

    Parameters
    ----------
    outline
        The ground inside the outlines.
    network
        The lane graph, with the doors that are there.
    taken
        Ground of stalls, columns and blocks, over which the way from a door leads only where there is no other.
    asked
        Nodes from which cars turn into stalls.
    is_near
        True to place them at these nodes, as for those that farther ones reach by turns on the spot only.

    Notes
    -----
    One-way lanes are entered where they begin, and left where they end. Of all places of a lane, that is chosen from
    which a straight and free way leads to the outline: first ahead of its tips, then to the nearest side.
    """
    lanes = nx.DiGraph()
    lanes.add_nodes_from(node for node in range(len(network.nodes)) if not network.nodes[node].is_portal)
    for start, end in network.arcs:
        if start in lanes and end in lanes:
            lanes.add_edge(start, end)
    arriving, leaving = ({node for arc in arcs for node in arc} for arcs in (network.arriving, network.leaving))
    no_way_in, no_way_out = (lanes.subgraph(set(asked) - known) for known in (arriving, leaving))
    wanted: dict[tuple[Point, Point], set[PortalKind]] = {}
    for missing, ways, kind in (
        (no_way_in, lanes, PortalKind.ENTRANCE),
        (no_way_out, lanes.reverse(copy=False), PortalKind.EXIT),
    ):
        around = ways.subgraph({node for at in missing for node in (at, *(() if is_near else nx.ancestors(ways, at)))})
        first = [
            circuit
            for circuit in map(frozenset, nx.strongly_connected_components(around))
            if all(start in circuit for start, _ in around.in_edges(circuit))
        ]
        doors = {circuit: _best_door(outline, network, taken, sorted(circuit)) for circuit in first}
        left = set(missing)
        for circuit in sorted(first, key=doors.__getitem__):
            served = left.intersection(circuit) | left.intersection(nx.descendants(around, min(circuit)))
            if served:
                wanted.setdefault(doors[circuit][-2:], set()).add(kind)
                left -= served
    return {
        lane: SurveyedPortal(place, PortalKind.BOTH if len(kinds) > 1 else next(iter(kinds)))
        for (lane, place), kinds in wanted.items()
    }


def _best_door(
    outline: Ground, network: LaneGraph, taken: shapely.Geometry, nodes: Iterable[int]
) -> tuple[float, int, float, Point, Point]:
    """Return how good the best straight way from some nodes to the outline is, the least being best, and its ends."""
    found = []
    shapely.prepare(outline)
    parts = shapely.STRtree(shapely.get_parts(taken))
    for node in nodes:
        for order, foot in _feet(outline, network, node):
            here = network.nodes[node].position
            way = shapely.LineString([here, foot])
            strip = way.buffer(_APPROACH_HALF_M, cap_style="flat") if way.length else shapely.Polygon()
            near = parts.geometries[parts.query(strip, predicate="intersects")]
            over_m2 = shapely.area(shapely.intersection(near, strip)).sum()
            length_m = way.length + (_OTHERWISE_M if order else 0.0)
            found.append((round(float(over_m2), 1), order, round(float(length_m), 2), here, foot))
    return min(found)


def _feet(outline: Ground, network: LaneGraph, node: int) -> Iterator[tuple[int, Point]]:
    """Yield places on the outline with their order of preference: 0 ahead of the tip of a lane, 1 beside the lane."""
    (x, z), beside = network.nodes[node].position, network.beside[node]
    here = shapely.Point(x, z)
    if len(beside) == 1:
        before_x, before_z = network.nodes[beside[0]].position
        scale = _REACH_M / math.dist((x, z), (before_x, before_z))
        ray = shapely.LineString([(x, z), (x + (x - before_x) * scale, z + (z - before_z) * scale)])
        met = outline.boundary.intersection(ray)
        if not met.is_empty:
            yield 0, _point(shapely.shortest_line(here, met).coords[-1])
    yield 1, _point(shapely.shortest_line(here, outline.boundary).coords[-1])
    for side in sides_of(outline):
        run_m = side.run_m((x, z))
        if 0.0 < run_m < side.length_m and outline.covers(shapely.LineString([(x, z), side.at(run_m, LEAST_WALL_M)])):
            yield 1, _point(side.at(run_m))


def _point(place: Sequence[float]) -> Point:
    return round(float(place[0]), _DIGITS), round(float(place[1]), _DIGITS)
