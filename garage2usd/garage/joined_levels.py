"""One lane graph over all levels of a building: the lanes of each level, and the ramps that link them."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.garage.driven_nodes import driven_nodes
from garage2usd.garage.lanes import LaneEdge, LaneGraph, LaneKind, LaneNode
from garage2usd.garage.stalls import Stall

__all__ = ["JoinedLevels", "LevelLanes", "RampLane", "join_levels", "unreached_stalls"]


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
        True if cars may turn back at once into the next aisle (`garage2usd.garage.driven_nodes`).
    """
    lanes = joined.lane_graph
    reached = lanes.driven
    if not may_turn_back:
        reached = driven_nodes(lanes, LaneKind.ENTRANCE) & driven_nodes(lanes, LaneKind.EXIT)
    return [stall.name for stall in joined.quads if stall.access not in reached]


def _on_level(stall: Stall, name: str, level: int, first: int) -> Stall:
    """Return a stall of a level as one of the building."""
    prefixed = ("number", "blocked_by")
    facts = tuple((fact, f"{name}/{value}" if fact in prefixed else value) for fact, value in stall.facts)
    return replace(stall, name=f"{name}/{stall.name}", access=stall.access + first, facts=facts, level=level)
