"""Figures of a plan for the four design principles of the paper."""

from dataclasses import dataclass

from garage2usd.config import BayConfig
from garage2usd.structure.border import bordered
from garage2usd.structure.dead_ends import DeadEnd, dead_ends
from garage2usd.structure.grid import NEIGHBOUR_STEPS, Cell, Mask, Structure, edge_neighbour_count
from garage2usd.structure.stalls import square_capacity

__all__ = ["Principles", "principles"]


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
