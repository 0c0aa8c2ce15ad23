"""Circulation on the lanes of a garage as built, by the names of its lane nodes."""

from collections.abc import Iterable
from typing import NamedTuple

from garage2usd.planning import measured_circulation
from garage2usd.structure.grid import Structure


class LaneRun(NamedTuple):
    """A dead end with its branches, or a stretch of lanes without a junction.

    Attributes
    ----------
    lanes
        Names of its lane nodes, of a dead end from the deepest one on.
    length_m
        Its length from border to border.
    """

    lanes: tuple[str, ...]
    length_m: float


class LaneCirculation(NamedTuple):
    """Circulation on the lanes of a garage.

    Attributes
    ----------
    loops
        Number of independent circuits.
    dead_ends, stretches
        The dead ends, and the stretches without a junction.
    blocks
        Names of the four lane nodes of each block of two by two, from its upper left to its lower right.
    """

    loops: int
    dead_ends: tuple[LaneRun, ...]
    stretches: tuple[LaneRun, ...]
    blocks: tuple[tuple[str, ...], ...]


def lane_circulation(structure: Structure) -> LaneCirculation:
    """Measure the circulation on the lanes of a structure."""
    found = measured_circulation(structure)
    return LaneCirculation(
        found.circulation.loops,
        tuple(LaneRun(_names(run.squares), run.length_m) for run in found.dead_ends),
        tuple(LaneRun(_names(run.squares), run.length_m) for run in found.stretches),
        tuple(
            _names([(row, col), (row, col + 1), (row + 1, col), (row + 1, col + 1)])
            for row, col in found.circulation.blocks
        ),
    )


def _names(squares: Iterable[tuple[int, int]]) -> tuple[str, ...]:
    """Name the lane nodes on squares as `garage2usd.garage.LaneNode` does."""
    return tuple(f"[{row}, {col}]" for row, col in squares)
