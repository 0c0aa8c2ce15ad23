"""The score of a structure, y' = N_S - 5 T_S - U_S, and its figures for the four design principles of the paper."""

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from garage2usd.config import BayConfig, PlanConfig
from garage2usd.structure.grid import NEIGHBOUR_STEPS, Cell, Mask, Structure, edge_neighbour_count, squares_beside
from garage2usd.structure.lanes import DeadEnd, dead_ends
from garage2usd.structure.squares import bordered
from garage2usd.structure.stall_runs import StallRun, capacity_of_runs
from garage2usd.structure.stalls import square_capacity

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
        A structure with lanes.
    bay
        Size of the stalls.
    plan
        The three weights of the score; those of the paper if left out.
    runs
        Kinds of the stalls; without any, all are perpendicular.

    Notes
    -----
    ``y' = k_1 N_S + k_2 T_S + k_3 U_S``. N_S counts stalls, U_S free squares that hold none. T_S is the mean over all
    stalls of ``1 + h``, where h is the number of squares driven from the nearest entrance to the nearest lane beside
    the stall's square. For a lane that no entrance reaches, h is the longest route of the structure. Without stalls,
    T_S = 0.

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


@dataclass(frozen=True)
class Principles:
    """Figures of the four principles of parking lot design; shares are from 0 to 1.

    Attributes
    ----------
    rectangular_share
        Use rectangular areas where possible: share of the squares with stalls that stand in a row of two or more.
    parallel_share
        Make the long sides of the parking areas parallel: share of the lanes that run in the more frequent of the two
        directions, of those that run in one.
    perimeter_share
        Stalls along the perimeter: share of the squares on the contour, portals apart, that hold stalls.
    double_loaded_share
        Lanes that serve two rows of stalls: share of the lanes with stalls on two opposite sides, of those with any.
    loops
        Independent circuits of the lane network.
    dead_ends
        Aisles that end in nothing.
    """

    rectangular_share: float
    parallel_share: float
    perimeter_share: float
    double_loaded_share: float
    loops: int
    dead_ends: tuple[DeadEnd, ...]


def principles(structure: Structure, *, bay: BayConfig) -> Principles:
    """Measure a complete structure against the paper's four principles."""
    lane = structure.cells == Cell.LANE
    served = square_capacity(structure, bay) > 0
    up, down, left, right = _beside(lane)
    along_z, along_x = (up | down) & ~(left | right), (left | right) & ~(up | down)
    stalls = _beside(served)
    double = (stalls[0] & stalls[1]) | (stalls[2] & stalls[3])
    loaded = lane & (edge_neighbour_count(served) > 0)
    inside = structure.cells != Cell.OBSTACLE
    rim = ((structure.cells == Cell.FREE) | lane) & (edge_neighbour_count(inside) < len(NEIGHBOUR_STEPS))
    straight = (int((lane & along_x).sum()), int((lane & along_z).sum()))
    edges = int((lane[:, 1:] & lane[:, :-1]).sum() + (lane[1:] & lane[:-1]).sum())
    return Principles(
        rectangular_share=_share(served & (edge_neighbour_count(served) > 0), served),
        parallel_share=max(straight) / sum(straight) if sum(straight) else 0.0,
        perimeter_share=_share(rim & served, rim),
        double_loaded_share=_share(loaded & double, loaded),
        loops=max(0, edges - int(lane.sum()) + 1) if lane.any() else 0,
        dead_ends=dead_ends(structure),
    )


def _beside(mask: Mask) -> tuple[Mask, Mask, Mask, Mask]:
    """Shift a mask: squares with `mask` set above, below, to the left and to the right."""
    padded = bordered(mask)
    return padded[:-2, 1:-1], padded[2:, 1:-1], padded[1:-1, :-2], padded[1:-1, 2:]


def _share(part: Mask, whole: Mask) -> float:
    total = int(whole.sum())
    return int(part.sum()) / total if total else 0.0
