"""Typed lane squares, typed stalls, and the proof that every stall is reached."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property

import networkx as nx
import numpy as np

from garage2usd.common.errors import UnreachableStallError
from garage2usd.config import BayConfig
from garage2usd.garage import LaneEdge, LaneGraph, LaneKind, LaneNode
from garage2usd.structure.grid import NEIGHBOUR_STEPS, Cell, Structure
from garage2usd.structure.lanes import BOTH_WAYS, LaneDirections
from garage2usd.structure.squares import bordered
from garage2usd.structure.stall_runs import StallRun, rows_of_runs
from garage2usd.structure.stalls import StallRow, stall_rows

Square = tuple[int, int]


class StallType(StrEnum):
    """The paper's four types of free square, by the lanes around it."""

    TYPE_1 = "type_1"
    TYPE_2 = "type_2"
    TYPE_3 = "type_3"
    TYPE_4 = "type_4"


@dataclass(frozen=True, eq=False)
class LaneSquares:
    """The squares of lanes and portals as a frozen graph, and the stalls beside them; numbered in reading order.

    Attributes
    ----------
    structure
        Matrices of the garage.
    setback_m
        Distance between the carriageway and squares that are not lanes.
    graph
        `networkx.Graph`; a node is a (row, col) with ``kind`` (`LaneKind`), ``x_m`` and ``z_m`` of its centre; an edge
        joins squares that share a side, with ``length_m`` between their centres.
    stall_types
        `StallType` of every free square.
    stall_rows
        Stall rows, each with a lane beyond its edge that is reached from an entrance and leads to an exit.
    directions
        One-way steps between lane squares.
    """

    structure: Structure
    setback_m: float
    graph: "nx.Graph[Square]"
    stall_types: dict[Square, StallType]
    stall_rows: tuple[StallRow, ...]
    directions: LaneDirections = BOTH_WAYS

    @cached_property
    def number_of(self) -> dict[Square, int]:
        """Number of the node on each lane or portal square."""
        return {square: number for number, square in enumerate(sorted(self.graph.nodes))}

    @cached_property
    def lanes(self) -> LaneGraph:
        """The lane graph in metres; one-way from an entrance and into an exit, else two-way."""
        kinds = list(map(self.kind, self.number_of))
        structure, margin_m = self.structure, 2 * self.setback_m
        widths_m = (structure.column_widths_mm / 1000).tolist()
        depths_m = (structure.row_depths_mm / 1000).tolist()
        nodes = tuple(
            LaneNode(
                kind.value,
                (self.graph.nodes[row, col]["x_m"], self.graph.nodes[row, col]["z_m"]),
                (widths_m[col] - margin_m, depths_m[row] - margin_m),
                f"[{row}, {col}]",
                sides_m=(widths_m[col], depths_m[row]),
            )
            for (row, col), kind in zip(self.number_of, kinds, strict=True)
        )
        edges = []
        for first, second in sorted((min(pair), max(pair)) for pair in self.graph.edges):
            start, end = self.number_of[first], self.number_of[second]
            one_way = nodes[start].is_portal or nodes[end].is_portal or self.directions.is_one_way(first, second)
            is_against = not self.directions.allows(first, second)
            if kinds[start] is LaneKind.EXIT or kinds[end] is LaneKind.ENTRANCE or is_against:
                start, end = end, start
            # squares that join in a line have the same side across it: R and C are constant along lines
            edges.append(LaneEdge(start, end, nodes[start].widths_m[first[1] != second[1]], one_way))
        return LaneGraph(nodes, tuple(edges))

    def shortest_way(self, start: Square, end: Square) -> list[Square] | None:
        """Return the shortest route between two lanes or portals, through no other portal; None without one."""
        portals = {square for square in self.graph if self.kind(square) in {LaneKind.ENTRANCE, LaneKind.EXIT}}
        roads = self.graph.subgraph(self.graph.nodes - (portals - {start, end}))
        if not nx.has_path(roads, start, end):
            return None
        return list(nx.shortest_path(roads, start, end, weight="length_m"))

    def length_m(self, way: Sequence[Square]) -> float:
        """Return the length of a route of squares in metres, from middle to middle."""
        return float(nx.path_weight(self.graph, way, "length_m"))

    def kind(self, square: Square) -> LaneKind:
        """Return the kind of a lane or portal square."""
        kind: LaneKind = self.graph.nodes[square]["kind"]
        return kind

    def label_of(self, square: Square) -> str:
        """Return the semantic label of a square's tile: the kind of its lane, or the type of its stalls."""
        return self.kind(square).value if square in self.graph else f"stall_{self.stall_types[square].value}"

    def kind_counts(self) -> dict[str, int]:
        """Count the squares of each kind of lane and portal, and of each stall type."""
        counts = Counter(str(kind) for _, kind in self.graph.nodes(data="kind"))
        counts.update(str(kind) for kind in self.stall_types.values())
        return {str(kind): counts[str(kind)] for kind in (*LaneKind, *StallType)}


def build_lane_graph(
    structure: Structure, bay: BayConfig, runs: Sequence[StallRun] = (), directions: LaneDirections = BOTH_WAYS
) -> LaneSquares:
    """Build the lane graph of a complete structure and prove that every stall is reached.

    Parameters
    ----------
    structure, bay
        The structure, and the size of its stalls.
    runs
        Kinds of the stalls; without any, all are perpendicular.
    directions
        One-way lanes.

    Raises
    ------
    UnreachableStallError
        If a stall's lane has no route over lanes from an entrance and to an exit.
    """
    lanes = unproven_lane_graph(structure, bay, runs, directions)
    _check_reachability(structure, lanes.graph, lanes.stall_rows)
    return lanes


def unproven_lane_graph(
    structure: Structure, bay: BayConfig, runs: Sequence[StallRun] = (), directions: LaneDirections = BOTH_WAYS
) -> LaneSquares:
    """Build the lane graph of any structure with lanes, without a proof that stalls are reached.

    Notes
    -----
    ``n = sum S(theta)`` types a lane: 4 crossroads, 3 T-junction, at most 2 straight. A free square with n lane
    neighbours is Type 1 (n >= 3, or 2 across), Type 2 (2 adjacent), Type 3 (1), Type 4 (0). Deviation: raw S counts an
    entrance as two lanes, so lane and portal neighbours are counted instead.
    """
    graph = _typed_graph(structure)
    rows = rows_of_runs(structure, bay, runs) if runs else stall_rows(structure, bay)
    setback_m = bay.carriageway_setback_m
    return LaneSquares(structure, setback_m, nx.freeze(graph), _stall_types(structure), rows, directions)


def _typed_graph(structure: Structure) -> "nx.Graph[Square]":
    x_m = (structure.column_edges_m[:-1] + structure.column_edges_m[1:]) / 2
    z_m = (structure.row_edges_m[:-1] + structure.row_edges_m[1:]) / 2
    cells = structure.cells
    graph: nx.Graph[Square] = nx.Graph()
    drivable = [(row, col) for row, col in np.argwhere(cells >= Cell.LANE).tolist()]
    for row, col in drivable:
        graph.add_node((row, col), x_m=float(x_m[col]), z_m=float(z_m[row]))
    for row, col in drivable:
        for other in ((row + 1, col), (row, col + 1)):
            joins_lane = other in graph and Cell.LANE in {cells[row, col], cells[other]}
            if joins_lane:
                length = abs(z_m[other[0]] - z_m[row]) + abs(x_m[other[1]] - x_m[col])
                graph.add_edge((row, col), other, length_m=float(length))
    for square in graph:
        graph.nodes[square]["kind"] = _lane_kind(Cell(cells[square]), graph.degree(square))
    return graph


def _lane_kind(cell: Cell, degree: int) -> LaneKind:
    if cell is Cell.ENTRANCE:
        return LaneKind.ENTRANCE
    if cell is Cell.EXIT:
        return LaneKind.EXIT
    return {4: LaneKind.CROSSROADS, 3: LaneKind.T_JUNCTION}.get(degree, LaneKind.STRAIGHT)


def _stall_types(structure: Structure) -> dict[Square, StallType]:
    lane = bordered(structure.cells == Cell.LANE)
    types: dict[Square, StallType] = {}
    for row, col in structure.where(Cell.FREE):
        up, down, left, right = (lane[row + 1 + dr, col + 1 + dc] for dr, dc in NEIGHBOUR_STEPS)
        count = int(up) + int(down) + int(left) + int(right)
        across = (up and down) or (left and right)
        if count >= 3 or (count == 2 and across):  # noqa: PLR2004
            types[row, col] = StallType.TYPE_1
        else:
            types[row, col] = (StallType.TYPE_4, StallType.TYPE_3, StallType.TYPE_2)[count]
    return types


def _check_reachability(structure: Structure, graph: "nx.Graph[Square]", rows: tuple[StallRow, ...]) -> None:
    """Raise an error unless every stall's lane is in a connected piece of lanes with an entrance and an exit."""
    cells = structure.cells
    lanes = graph.subgraph(square for square in graph if cells[square] == Cell.LANE)
    served: set[Square] = set()
    for piece in nx.connected_components(lanes):
        touched = {int(cells[portal]) for lane in piece for portal in graph[lane]}
        if {Cell.ENTRANCE, Cell.EXIT} <= touched:
            served |= piece
    unreached = {stalls.square for stalls in rows if stalls.edge.beyond(stalls.square) not in served}
    if unreached:
        lines = [list(line) for line in str(structure).splitlines()]
        for row, col in unreached:
            lines[row][col] = "?"
        raise UnreachableStallError(sorted(unreached), "\n".join("".join(line) for line in lines))
