"""The lane graph of a garage: nodes in metres, and edges with their width and direction."""
# Over 300 lines: the lane graph with its routes, dead ends and reachable arcs is one value.

import math
from collections import deque
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property
from itertools import pairwise
from statistics import median
from typing import NamedTuple

import networkx as nx
import numpy as np
from numpy.typing import NDArray

Point = tuple[float, float]
"""(x, z) in metres."""
Arc = tuple[int, int]
"""Numbers of two lane nodes, in the direction of driving."""
DEAD_END_LIMIT_M = 26.0
"""Greatest length of a dead-end aisle that cars back out of; a longer one needs a turning bay."""
_DIGITS = 4
"""Decimals of lengths compared with a limit, so that the single precision of a stage makes no difference."""
_STRAIGHT_M = 1e-3


class LaneKind(StrEnum):
    """Kinds of lane node: the paper's three kinds of lane square, entrances and exits."""

    CROSSROADS = "crossroads"
    T_JUNCTION = "t_junction"
    STRAIGHT = "straight"
    ENTRANCE = "entrance"
    EXIT = "exit"


@dataclass(frozen=True)
class LaneNode:
    """A node of the lane graph: a place on the lanes, or a portal.

    Attributes
    ----------
    kind
        A `LaneKind`, or any other word from an edited file.
    position
        (x, z) of the middle of the node.
    widths_m
        Metres between the columns across X and Z.
    name
        Square of the node, as ``[row, col]``.
    height_m
        Height of the floor there.
    level
        Number of its level, from 0.
    sides_m
        Extent of the node's ground along X and Z; the default is the clear width between the columns.
    """

    kind: str
    position: Point
    widths_m: tuple[float, float]
    name: str
    height_m: float = 0.0
    level: int = 0
    sides_m: tuple[float, float] | None = None

    @property
    def is_portal(self) -> bool:
        """True if the node is an entrance or exit of the garage."""
        return self.kind in {LaneKind.ENTRANCE, LaneKind.EXIT}

    def reach_m(self, along: Point) -> float:
        """Return the distance from the node's middle to the end of its ground along a unit vector."""
        across_x, across_z = self.sides_m or self.widths_m
        return (abs(along[0]) * across_x + abs(along[1]) * across_z) / 2


class LaneEdge(NamedTuple):
    """A stretch of lane between two nodes.

    Attributes
    ----------
    start, end
        Numbers of the nodes.
    width_m
        Width of the carriageway between the columns.
    one_way
        True if cars drive from `start` to `end` only.
    """

    start: int
    end: int
    width_m: float
    one_way: bool

    @property
    def arcs(self) -> tuple[Arc, ...]:
        """Arcs of the edge, one for each direction of driving."""
        there, back = (self.start, self.end), (self.end, self.start)
        return (there,) if self.one_way else (there, back)


class DeadEnd(NamedTuple):
    """A dead-end aisle of the lane graph.

    Attributes
    ----------
    nodes
        Nodes of the aisle from its tip back to the next junction or portal, without that one.
    length_m
        Length from border to border.
    mouth
        The junction or portal where the aisle begins; None without one.
    """

    nodes: list[int]
    length_m: float
    mouth: int | None


@dataclass(frozen=True, eq=False)
class LaneGraph:
    """The lane graph of a garage.

    Attributes
    ----------
    nodes
        Lanes and portals; the number of a node is its index.
    edges
        Stretches of lane between the nodes.
    """

    nodes: tuple[LaneNode, ...]
    edges: tuple[LaneEdge, ...]

    @cached_property
    def positions_m(self) -> NDArray[np.float64]:
        """(x, z) of each node; float64, shape (nodes, 2)."""
        return np.array([node.position for node in self.nodes], dtype=np.float64).reshape(-1, 2)

    @cached_property
    def arcs(self) -> dict[Arc, LaneEdge]:
        """The edge of each directed arc, in the order of the edges."""
        return {arc: edge for edge in self.edges for arc in edge.arcs}

    @cached_property
    def graph(self) -> "nx.DiGraph[int]":
        """The lane graph as a frozen `networkx.DiGraph`.

        A node has ``kind``, ``x_m``, ``z_m``, ``height_m`` and ``level``; an arc has ``width_m``, ``length_m``,
        ``climb_m`` and the ``levels`` of its two ends.
        """
        graph: nx.DiGraph[int] = nx.DiGraph()
        for number, node in enumerate(self.nodes):
            (x, z), height = node.position, node.height_m
            graph.add_node(number, kind=node.kind, x_m=x, z_m=z, height_m=height, level=node.level)
        # among equal routes the first arc wins: down before right at each node
        for (start, end), edge in sorted(self.arcs.items(), key=lambda arc: (min(arc[0]), -max(arc[0]))):
            one, other = self.nodes[start], self.nodes[end]
            graph.add_edge(
                start,
                end,
                width_m=edge.width_m,
                length_m=math.dist(one.position, other.position),
                climb_m=other.height_m - one.height_m,
                levels=(one.level, other.level),
            )
        return nx.freeze(graph)

    @cached_property
    def onward(self) -> tuple[tuple[int, ...], ...]:
        """Successors of each lane node."""
        return self._following(arc for edge in self.edges for arc in edge.arcs)

    @cached_property
    def backward(self) -> tuple[tuple[int, ...], ...]:
        """Predecessors of each lane node."""
        return self._following((other, node) for node, others in enumerate(self.onward) for other in others)

    @cached_property
    def beside(self) -> tuple[tuple[int, ...], ...]:
        """Neighbours of each lane node in either direction of driving."""
        ends = ((edge.start, edge.end) for edge in self.edges)
        return self._following(arc for one, other in ends for arc in ((one, other), (other, one)))

    def floor_m(self, level: int = 0) -> float:
        """Return the floor height of a level, the median of its lane nodes; 0 for a level without nodes."""
        heights = [node.height_m for node in self.nodes if node.level == level]
        return median(heights) if heights else 0.0

    def portals(self, *kinds: str) -> list[int]:
        """Return the numbers of the lane nodes of some kinds."""
        return [number for number, node in enumerate(self.nodes) if node.kind in kinds]

    def joined_portals(self, *kinds: str) -> list[int]:
        """Return the numbers of the portals of some kinds that join a lane."""
        return [number for number in self.portals(*kinds) if self.beside[number]]

    @cached_property
    def arriving(self) -> frozenset[Arc]:
        """Arcs reachable from an entrance by driving forward without a U-turn."""
        return self._spread(self.onward, LaneKind.ENTRANCE)

    @cached_property
    def leaving(self) -> frozenset[Arc]:
        """Arcs from which an exit is reachable by driving forward without a U-turn."""
        return frozenset((one, other) for other, one in self._spread(self.backward, LaneKind.EXIT))

    @cached_property
    def driven(self) -> frozenset[int]:
        """Nodes that are reached from an entrance and from which an exit is reached, as by `arriving` and `leaving`."""
        arriving, leaving = (frozenset(node for arc in arcs for node in arc) for arcs in (self.arriving, self.leaving))
        return arriving & leaving

    def near(self, node: int, most_edges: int) -> list[Arc]:
        """Return the arcs between nodes within some number of edges of a lane node, the nearest first."""
        steps = nx.single_source_shortest_path_length(self._undirected, node, cutoff=most_edges)
        arcs = [(one, other) for one in steps for other in self.graph[one] if other in steps]
        return sorted(arcs, key=lambda arc: (steps[arc[0]] + steps[arc[1]], arc))

    @cached_property
    def dead_ends(self) -> tuple[DeadEnd, ...]:
        """The dead-end aisles of the lane graph, in the order of their tips."""
        return tuple(self._dead_ends())

    def into_dead_ends(self, most_m: float) -> frozenset[Arc]:
        """Return the arcs that lead into a dead-end aisle of at most some length, up to its tip."""
        arcs: list[Arc] = []
        for dead_end in self.dead_ends:
            if round(dead_end.length_m, _DIGITS) <= most_m:
                inwards = dead_end.nodes[::-1]
                arcs += [(outside, inwards[0]) for outside in {*self.beside[inwards[0]]}.difference(inwards)]
                arcs += pairwise(inwards)
        return frozenset(arcs)

    def clear_aisle_m(self, access: int, outwards: Point) -> float:
        """Return the width between the columns on both sides of an aisle, for stalls that open onto a lane node.

        Parameters
        ----------
        access
            Number of the node.
        outwards
            Unit vector (x, z) out of the stalls.
        """
        return self.nodes[access].widths_m[int(abs(outwards[1]) > abs(outwards[0]))]

    def shortest_way(self, start: int, end: int) -> list[int] | None:
        """Return the nodes of the shortest route between two lane nodes, through no other portal; None without one."""
        between = [number for number, node in enumerate(self.nodes) if not node.is_portal or number in {start, end}]
        try:
            return list(nx.shortest_path(self.graph.subgraph(between), start, end, weight="length_m"))
        except nx.NetworkXNoPath:
            return None

    def way_m(self, way: Sequence[int]) -> float:
        """Return the length of a route in metres, from middle to middle."""
        return float(nx.path_weight(self.graph, way, "length_m"))

    def length_m(self, start: int, end: int) -> float:
        """Return the distance in metres between the middles of two lane nodes."""
        return math.dist(self.nodes[start].position, self.nodes[end].position)

    def edge_name(self, edge: LaneEdge) -> str:
        """Name a lane edge after its two end nodes."""
        return f"{self.nodes[edge.start].name}-{self.nodes[edge.end].name}"

    @cached_property
    def _undirected(self) -> "nx.Graph[int]":
        return self.graph.to_undirected()

    def _following(self, arcs: Iterable[Arc]) -> tuple[tuple[int, ...], ...]:
        """List for each lane node the distinct end nodes of its outgoing arcs."""
        following: list[dict[int, None]] = [{} for _ in self.nodes]
        for start, end in arcs:
            following[start][end] = None
        return tuple(map(tuple, following))

    def _spread(self, ways: Sequence[Sequence[int]], kind: LaneKind) -> frozenset[Arc]:
        """Return the arcs out of portals of a kind and all arcs that follow them without a U-turn or another portal."""
        reached = {(start, other) for start in self.portals(kind) for other in ways[start]}
        waiting = deque(reached)
        while waiting:
            one, other = waiting.popleft()
            if self.nodes[other].is_portal:
                continue
            for beyond in ways[other]:
                if beyond != one and (other, beyond) not in reached:
                    reached.add((other, beyond))
                    waiting.append((other, beyond))
        return frozenset(reached)

    def _dead_ends(self) -> Iterator[DeadEnd]:
        nodes, beside = self.nodes, self.beside
        for tip in range(len(nodes)):
            if nodes[tip].is_portal or len(beside[tip]) > 1:
                continue
            lanes, ahead = [tip], beside[tip]
            while ahead and not nodes[ahead[0]].is_portal and len(beside[ahead[0]]) == 2:  # noqa: PLR2004 - no junction
                lanes.append(ahead[0])
                ahead = tuple(other for other in beside[lanes[-1]] if other != lanes[-2])
            mouth = ahead[0] if ahead else None
            way = lanes if mouth is None else [*lanes, mouth]
            length_m = sum(self.length_m(one, other) for one, other in pairwise(way))
            tip_m = self._clear_m(tip, beside[tip][0]) if beside[tip] else max(nodes[tip].widths_m)
            length_m += tip_m if mouth is None else (tip_m - self._clear_m(mouth, lanes[-1])) / 2
            yield DeadEnd(lanes, length_m, mouth)

    def _clear_m(self, node: int, other: int) -> float:
        """Return the width between the columns at a lane node along the aisle to another."""
        is_along_z = abs(self.nodes[node].position[0] - self.nodes[other].position[0]) < _STRAIGHT_M
        return self.nodes[node].widths_m[int(is_along_z)]
