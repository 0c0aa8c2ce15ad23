"""Where cars drive in which direction: the lane poses that a way to a stall begins at, and a way out of it ends at."""

import math
from collections import deque
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import networkx as nx

from garage2usd.dead_ends import dead_ends
from garage2usd.driving.car import DesignCar
from garage2usd.driving.proof import LanePose
from garage2usd.grid import Cell, Structure
from garage2usd.lanes import LaneGraph, Square

__all__ = ["DirectedEdge", "LaneDirections"]

DirectedEdge = tuple[Square, Square]
"""From the middle of one square to the middle of the next."""
_NEAR_EDGES = 2


@dataclass(frozen=True, eq=False)
class LaneDirections:
    """The edges of a lane graph by direction, and which of them lie on a way from an entrance or to an exit.

    All ways are driven forward, and no car turns round on a lane.

    Attributes
    ----------
    structure, graph
        The plan and its lanes.
    setback_m
        How far the carriageway stays from squares that are no lane.
    """

    structure: Structure
    graph: LaneGraph
    setback_m: float

    @cached_property
    def arriving(self) -> frozenset[DirectedEdge]:
        """Edges that cars come to from an entrance."""
        entrances = self.structure.where(Cell.ENTRANCE)
        return self._spread((entrance, lane) for entrance in entrances for lane in self.graph.graph[entrance])

    @cached_property
    def leaving(self) -> frozenset[DirectedEdge]:
        """Edges that lead on to an exit."""
        exits = self.structure.where(Cell.EXIT)
        back = self._spread((exit_, lane) for exit_ in exits for lane in self.graph.graph[exit_])
        return frozenset((one, other) for other, one in back)

    @cached_property
    def backing(self) -> frozenset[DirectedEdge]:
        """Edges that lead into a dead end that cars may back out of: one of at most 26 m."""
        backed: set[DirectedEdge] = set()
        for end in dead_ends(self.structure):
            if not end.needs_turning_stall:
                towards = [*reversed(end.squares)]
                outside = [square for square in self.graph.graph[towards[0]] if square not in end.squares]
                backed.update((square, towards[0]) for square in outside)
                backed.update(pairwise(towards))
        return frozenset(backed)

    def near(self, square: Square) -> list[DirectedEdge]:
        """The edges in both directions that are at most two squares from one, the nearest first."""
        steps: Mapping[Square, int] = nx.single_source_shortest_path_length(
            self.graph.graph, square, cutoff=_NEAR_EDGES
        )
        edges = [(one, other) for one in steps for other in self.graph.graph[one] if other in steps]
        return sorted(edges, key=lambda edge: (steps[edge[0]] + steps[edge[1]], edge))

    def poses(self, edges: Iterable[DirectedEdge], car: DesignCar) -> list[LanePose]:
        """Where a car may be in line with some edges, its middle on the edge and its body within the carriageway."""
        poses = (self._pose(edge, car) for edge in edges)
        return [pose for pose in poses if min(pose.length_m, pose.width_m) >= 0]

    def _spread(self, edges: Iterable[DirectedEdge]) -> frozenset[DirectedEdge]:
        """Some edges, and those that follow them without turning round or driving through a portal."""
        reached = set(edges)
        waiting = deque(sorted(reached))
        while waiting:
            one, other = waiting.popleft()
            if self.structure.cells[other] != Cell.LANE:
                continue
            for beyond in self.graph.graph[other]:
                if beyond != one and (other, beyond) not in reached:
                    reached.add((other, beyond))
                    waiting.append((other, beyond))
        return frozenset(reached)

    def _pose(self, edge: DirectedEdge, car: DesignCar) -> LanePose:
        (row, col), (to_row, to_col) = edge
        z_edges, x_edges = self.structure.row_edges_m, self.structure.column_edges_m
        along_x = row == to_row
        (near_low, near_high), (far_low, far_high) = (
            (float(lines[at]), float(lines[at + 1]))
            for lines, at in (((x_edges, col), (x_edges, to_col)) if along_x else ((z_edges, row), (z_edges, to_row)))
        )
        low = max(min((near_low + near_high) / 2, (far_low + far_high) / 2), min(near_low, far_low) + car.length_m / 2)
        high = min(
            max((near_low + near_high) / 2, (far_low + far_high) / 2), max(near_high, far_high) - car.length_m / 2
        )
        across = (z_edges, row) if along_x else (x_edges, col)
        side_low, side_high = float(across[0][across[1]]), float(across[0][across[1] + 1])
        width = side_high - side_low - 2 * self.setback_m - car.width_m
        middle = (low + high) / 2, (side_low + side_high) / 2
        step_x, step_z = to_col - col, to_row - row
        return LanePose(middle if along_x else middle[::-1], math.atan2(-step_x, -step_z), high - low, width)
