"""The score of a structure: y' = N_S - 5 T_S - U_S."""

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from garage2usd.config import BayConfig, PlanConfig
from garage2usd.structure.grid import Cell, Structure, squares_beside
from garage2usd.structure.stall_runs import StallRun, capacity_of_runs
from garage2usd.structure.stalls import square_capacity

__all__ = ["Score", "evaluate", "is_feasible"]

Square = tuple[int, int]


@dataclass(frozen=True)
class Score:
    """Figures of the paper for one structure.

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

    def parking_time_s(self, *, square_side_m: float, speed_m_s: float) -> float:
        """Convert T_S to seconds for squares of one side and a steady speed."""
        return self.parking_time_squares * square_side_m / speed_m_s


def evaluate(
    structure: Structure, *, bay: BayConfig, plan: PlanConfig | None = None, runs: Sequence[StallRun] = ()
) -> Score:
    """Score a complete structure, independently of the compiled planner.

    Parameters
    ----------
    structure
        With lanes.
    bay
        Size of the stalls.
    plan
        Its three weights; the paper's if left out.
    runs
        Kinds of the stalls; without any, all are perpendicular.

    Notes
    -----
    ``y' = k_1 N_S + k_2 T_S + k_3 U_S``. N_S counts stalls, U_S free squares that hold none. T_S is the mean over the
    stalls of one and the squares driven from the nearest entrance to the nearest lane beside the stall's square.
    Lanes that no entrance reaches count the longest route there is; a structure without stalls has T_S = 0.

    Deviation: the paper sums raw S over the neighbours, where obstacles and portals corrupt the count of lanes; lanes
    are counted instead.
    """
    plan = plan or PlanConfig()
    capacity = capacity_of_runs(structure, bay, runs) if runs else square_capacity(structure, bay)
    hops = _lane_hops(structure)
    farthest = max(hops.values(), default=0)
    total = 0
    for row, col in np.argwhere(capacity > 0).tolist():
        nearest = min((hops[lane] for lane in squares_beside((row, col)) if lane in hops), default=farthest)
        total += int(capacity[row, col]) * (1 + nearest)
    stalls = int(capacity.sum())
    time = total / stalls if stalls else 0.0
    unused = int(((structure.cells == Cell.FREE) & (capacity == 0)).sum())
    value = plan.stall_weight * stalls + plan.parking_time_weight * time + plan.unused_weight * unused
    return Score(value, stalls, time, unused)


def is_feasible(structure: Structure) -> bool:
    """Test whether the lanes form one network that does not pass through portals, and every portal touches it."""
    lanes = set(structure.where(Cell.LANE))
    portals = structure.where(Cell.ENTRANCE) + structure.where(Cell.EXIT)
    touched = all(any(lane in lanes for lane in squares_beside(portal)) for portal in portals)
    return bool(lanes) and touched and len(_flood([min(lanes)], lanes)) == len(lanes)


def _lane_hops(structure: Structure) -> dict[Square, int]:
    """Squares driven from the nearest entrance to each lane that it reaches over lanes."""
    lanes = set(structure.where(Cell.LANE))
    entrances = structure.where(Cell.ENTRANCE)
    return _flood([lane for entrance in entrances for lane in squares_beside(entrance) if lane in lanes], lanes)


def _flood(starts: list[Square], lanes: set[Square]) -> dict[Square, int]:
    """Breadth-first distances over lanes, 1 at the starts."""
    hops = dict.fromkeys(starts, 1)
    queue = deque(hops)
    while queue:
        square = queue.popleft()
        for other in squares_beside(square):
            if other in lanes and other not in hops:
                hops[other] = hops[square] + 1
                queue.append(other)
    return hops
