"""The score of a structure: y' = N_S - 5 T_S - U_S."""

from dataclasses import dataclass

import networkx as nx
import numpy as np

from garage2usd.config import BayConfig, PlanConfig
from garage2usd.grid import NEIGHBOUR_STEPS, Cell, Structure
from garage2usd.stalls import square_capacity

__all__ = ["Score", "evaluate"]


@dataclass(frozen=True)
class Score:
    """The paper's figures of one structure.

    Attributes
    ----------
    value
        y', higher is better.
    stalls
        N_S.
    parking_time_squares
        T_S in squares driven.
    unused_squares
        U_S.
    """

    value: float
    stalls: int
    parking_time_squares: float
    unused_squares: int


def evaluate(structure: Structure, *, bay: BayConfig, plan: PlanConfig | None = None) -> Score:
    """Score a complete structure, independently of the compiled planner.

    Parameters
    ----------
    structure
        With lanes.
    bay
        Size of the stalls.
    plan
        Its three weights; the paper's if left out.

    Notes
    -----
    ``y' = k_1 N_S + k_2 T_S + k_3 U_S``. N_S counts stalls, U_S free squares that hold none. T_S is the mean over the
    stalls of one and the squares driven from the nearest entrance to the nearest lane beside the stall's square.
    Lanes that no entrance reaches count the longest route there is; a structure without stalls has T_S = 0.
    """
    plan = plan or PlanConfig()
    capacity = square_capacity(structure, bay)
    distances = _lane_distances(structure)
    farthest = max(distances.values(), default=0)
    total = 0
    for row, col in np.argwhere(capacity > 0).tolist():
        lanes = ((row + dr, col + dc) for dr, dc in NEIGHBOUR_STEPS)
        nearest = min((distances[lane] for lane in lanes if lane in distances), default=farthest)
        total += int(capacity[row, col]) * (1 + nearest)
    stalls = int(capacity.sum())
    time = total / stalls if stalls else 0.0
    unused = int(((structure.cells == Cell.FREE) & (capacity == 0)).sum())
    value = plan.stall_weight * stalls + plan.parking_time_weight * time + plan.unused_weight * unused
    return Score(value, stalls, time, unused)


def _lane_distances(structure: Structure) -> dict[tuple[int, int], int]:
    """Squares driven from the nearest entrance to each lane that it reaches over lanes."""
    cells = structure.cells
    rows, cols = structure.shape
    grid = nx.grid_2d_graph(rows, cols)
    lanes = grid.subgraph(square for square in grid if cells[square] == Cell.LANE).copy()
    for entrance in structure.where(Cell.ENTRANCE):
        for dr, dc in NEIGHBOUR_STEPS:
            lane = (entrance[0] + dr, entrance[1] + dc)
            if lane in lanes:
                lanes.add_edge("entrances", lane)
    if "entrances" not in lanes:
        return {}
    distances = nx.single_source_shortest_path_length(lanes, "entrances")
    return {square: distance for square, distance in distances.items() if square != "entrances"}
