"""The levels of a garage: names, prims and heights, and one lane graph over all of them and their ramps."""

import math
from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.garage.lanes import LaneEdge, LaneGraph, LaneKind, LaneNode
from garage2usd.garage.stalls import Stall

GARAGE_NAME, LEVELS_NAME = "Garage", "Levels"
"""Names of the prim of a garage, and of the prim below it that holds its levels where there are several."""
_DECIMALS = 6
LEAST_TURN_BACK_M = 7.3
"""Least distance in metres between the middle lines of two aisles for a car to turn from one straight into the other:
twice the radius of the design car's rear axle with steering, less its shifts to the sides of both aisles."""
_TURN_SIN = 0.5


class LevelPlace(NamedTuple):
    """The place of a level in its garage.

    Attributes
    ----------
    name
        Name of its prim, ``U1``; empty for the only level of a garage, whose prim is that of the garage.
    path
        Path of its prim.
    floor_m
        Height of its floor.
    """

    name: str
    path: str
    floor_m: float

    @property
    def is_only(self) -> bool:
        """True if the level is the whole garage."""
        return not self.name

    def in_whole(self, name: str, *, joint: str = "/") -> str:
        """Return the name in the whole garage of a stall or file of the level: ``U2/A1-08``, ``U2_plan``."""
        return name if self.is_only else f"{self.name}{joint}{name}"

    def after(self, name: str, *, joint: str) -> str:
        """Return the name of the garage, or of a file of it, with that of the level behind: ``two_U1``."""
        return name if self.is_only else f"{name}{joint}{self.name}"

    def own_name(self, name: str) -> str:
        """Return the name of a stall within its level, given its name in the whole garage; inverse of `in_whole`."""
        return name.removeprefix(self.in_whole(""))

    def path_in_whole(self, place: str) -> str:
        """Return the path in the whole stage of a prim of the level; other places get the level's name in front."""
        if self.is_only:
            return place
        root = f"/{self.path.split('/')[1]}"
        if place == root or place.startswith(f"{root}/"):
            return self.path + place[len(root) :]
        return self.in_whole(place) if place else self.name


ONLY_LEVEL = LevelPlace("", f"/{GARAGE_NAME}", 0.0)
"""The place of the only level of a garage."""


def level_places(count: int, storey_m: float) -> list[LevelPlace]:
    """Return the places of levels of one height, the top one first, whose floor lies at 0."""
    return places_at([round(-number * storey_m, _DECIMALS) + 0.0 for number in range(count)])


def places_at(floors_m: Sequence[float]) -> list[LevelPlace]:
    """Return the places of levels by the heights of their floors, the top one first."""
    if len(floors_m) == 1:
        return [ONLY_LEVEL]
    names = map(level_name, range(len(floors_m)))
    paths = [(name, f"/{GARAGE_NAME}/{LEVELS_NAME}/{name}") for name in names]
    return [LevelPlace(name, path, floor_m) for (name, path), floor_m in zip(paths, floors_m, strict=True)]


def level_name(level: int) -> str:
    """Name of a level by its number from 0: ``U1`` is the first one below the street."""
    return f"U{level + 1}"


def nearest_floor(floors_m: Sequence[float], height_m: float) -> int:
    """Return the index of the floor of the level at a height; on a ramp it changes half way."""
    return min(range(len(floors_m)), key=lambda index: abs(floors_m[index] - height_m))


class _Going(NamedTuple):
    """A car on an arc.

    Attributes
    ----------
    start, end
        Nodes of the arc.
    turned
        Side of its last turn, 1 or -1; 0 if it no longer limits the next turn.
    since_m
        Distance from that turn to the end of the arc.
    """

    start: int
    end: int
    turned: int = 0
    since_m: float = 0.0


def driven_nodes(lanes: LaneGraph, kind: LaneKind) -> frozenset[int]:
    """Return the nodes that a car reaches from the entrances, or those from which it reaches the exits.

    Parameters
    ----------
    lanes
        Lane graph, also of several levels.
    kind
        ``entrance`` or ``exit``.

    Notes
    -----
    A car drives forwards and through no other portal. Two turns to the same side are `LEAST_TURN_BACK_M` or more apart;
    where they are closer, it depends on the room around whether a car turns back, which a search for its path tells.
    """
    ways = lanes.onward if kind == LaneKind.ENTRANCE else lanes.backward
    portals = lanes.portals(kind)
    going = {_Going(portal, other) for portal in portals for other in ways[portal]}
    waiting = deque(sorted(going))
    while waiting:
        for following in _following(lanes, ways, waiting.popleft()):
            if following not in going:
                going.add(following)
                waiting.append(following)
    return frozenset(each.end for each in going).union(portals)


def _following(lanes: LaneGraph, ways: tuple[tuple[int, ...], ...], going: _Going) -> Iterator[_Going]:
    start, end, turned, since_m = going
    if lanes.nodes[end].is_portal:
        return
    (from_x, from_z), (x, z) = lanes.nodes[start].position, lanes.nodes[end].position
    for other in ways[end]:
        to_x, to_z = lanes.nodes[other].position
        length_m = math.hypot(to_x - x, to_z - z)
        cross = (x - from_x) * (to_z - z) - (z - from_z) * (to_x - x)
        sine = cross / (math.hypot(x - from_x, z - from_z) * length_m)
        side = 0 if abs(sine) < _TURN_SIN else int(math.copysign(1, sine))
        if other == start or (side and side == turned):
            continue
        run_m = length_m if side else since_m + length_m
        is_free = run_m >= LEAST_TURN_BACK_M
        yield _Going(end, other, 0 if is_free else side or turned, 0.0 if is_free else round(run_m, 3))


class LevelLanes(NamedTuple):
    """The lanes and stalls of one level, whose landings are portals of it.

    Attributes
    ----------
    name
        Name of the level.
    floor_m
        Height of its floor.
    lanes, stalls
        Lane graph and stalls, as of a garage of this level alone.
    squares
        (row, col) of each lane node; int32, shape (nodes, 2).
    """

    name: str
    floor_m: float
    lanes: LaneGraph
    stalls: tuple[Stall, ...]
    squares: NDArray[np.int32]


class RampLane(NamedTuple):
    """A one-way ramp between two levels.

    Attributes
    ----------
    start, end
        (level, node) of the landing that cars leave and of the one that they reach.
    points
        (x, height, z) along the ramp in the direction of driving, without the landings.
    squares
        (row, col) that each of these points lies on.
    level
        Level that the ramp belongs to, the one at its foot.
    width_m
        Width of its carriageway.
    """

    start: tuple[int, int]
    end: tuple[int, int]
    points: tuple[tuple[float, float, float], ...]
    squares: tuple[tuple[int, int], ...]
    level: int
    width_m: float


@dataclass(frozen=True, eq=False)
class JoinedLevels:
    """The lanes and stalls of a whole building.

    Attributes
    ----------
    lane_graph
        Lane nodes with level and height, landings as lanes, and the ramps; portals are those to the street.
    quads
        Stalls with their level; their ids and numbers begin with its name, ``U2/B2-07``.
    squares
        (row, col) of each lane node; int32, shape (nodes, 2).
    """

    lane_graph: LaneGraph
    quads: tuple[Stall, ...]
    squares: NDArray[np.int32]

    @property
    def blocked(self) -> dict[str, str]:
        """Id of each stall that a misparked car blocks, and of the stall of that car."""
        return {stall.name: stall.blocked_by for stall in self.quads if stall.blocked_by is not None}

    def node_squares(self) -> NDArray[np.int32]:
        """Return the (row, col) of each lane node; int32, shape (nodes, 2)."""
        return self.squares


def join_levels(levels: Sequence[LevelLanes], ramps: Sequence[RampLane]) -> JoinedLevels:
    """Join the lanes of levels by ramps.

    Parameters
    ----------
    levels
        The levels, the top one first.
    ramps
        The ramps between them.
    """
    firsts = np.cumsum([0, *(len(level.lanes.nodes) for level in levels)]).tolist()
    landings = {firsts[level] + node for ramp in ramps for level, node in (ramp.start, ramp.end)}
    nodes: list[LaneNode] = []
    edges: list[LaneEdge] = []
    stalls: list[Stall] = []
    for number, level in enumerate(levels):
        first = firsts[number]
        for index, node in enumerate(level.lanes.nodes, start=first):
            kind = LaneKind.STRAIGHT.value if index in landings else node.kind
            name = f"{level.name}/{node.name}"
            nodes.append(replace(node, kind=kind, name=name, height_m=level.floor_m, level=number))
        edges += [edge._replace(start=edge.start + first, end=edge.end + first) for edge in level.lanes.edges]
        stalls += [_on_level(stall, level.name, number, first) for stall in level.stalls]
    squares = [*(level.squares for level in levels), *(np.array(ramp.squares, dtype=np.int32) for ramp in ramps)]
    for ramp in ramps:
        previous = firsts[ramp.start[0]] + ramp.start[1]
        for (x, height_m, z), square in zip(ramp.points, ramp.squares, strict=True):
            name = f"{levels[ramp.level].name}/[{square[0]}, {square[1]}]"
            widths_m = (ramp.width_m, ramp.width_m)
            nodes.append(LaneNode(LaneKind.STRAIGHT.value, (x, z), widths_m, name, height_m, ramp.level))
            edges.append(LaneEdge(previous, len(nodes) - 1, ramp.width_m, one_way=True))
            previous = len(nodes) - 1
        edges.append(LaneEdge(previous, firsts[ramp.end[0]] + ramp.end[1], ramp.width_m, one_way=True))
    return JoinedLevels(LaneGraph(tuple(nodes), tuple(edges)), tuple(stalls), np.concatenate(squares))


def unreached_stalls(joined: JoinedLevels, *, may_turn_back: bool) -> list[str]:
    """Return the ids of the stalls that no car reaches from the street, or from which none reaches the street.

    Parameters
    ----------
    joined
        Lanes and stalls of all levels.
    may_turn_back
        True if cars may turn back at once into the next aisle (`garage2usd.garage.levels`).
    """
    lanes = joined.lane_graph
    reached = lanes.driven
    if not may_turn_back:
        reached = driven_nodes(lanes, LaneKind.ENTRANCE) & driven_nodes(lanes, LaneKind.EXIT)
    return [stall.name for stall in joined.quads if stall.access not in reached]


def _on_level(stall: Stall, name: str, level: int, first: int) -> Stall:
    """Return a stall of a level with its id, number and access node in the whole building."""
    prefixed = ("number", "blocked_by")
    facts = tuple((fact, f"{name}/{value}" if fact in prefixed else value) for fact, value in stall.facts)
    return replace(stall, name=f"{name}/{stall.name}", access=stall.access + first, facts=facts, level=level)
