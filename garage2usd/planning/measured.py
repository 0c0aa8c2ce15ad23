"""Circulation in metres: how deep dead ends reach, how long stretches run, how much floor serves neither."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from garage2usd.config import BayConfig
from garage2usd.planning.circulation import Circulation, circulation
from garage2usd.structure.border import bordered
from garage2usd.structure.grid import NEIGHBOUR_STEPS, Cell, Structure
from garage2usd.structure.lane_graph import Square
from garage2usd.structure.pieces import pieces_of
from garage2usd.structure.stalls import square_capacity

__all__ = ["MeasuredCirculation", "Run", "measured_circulation", "neither_share"]

_MM_PER_M = 1000
_MM2_PER_M2 = 1_000_000


@dataclass(frozen=True)
class Run:
    """Lanes that belong together: a dead end with all its branches, or a stretch between two junctions.

    Attributes
    ----------
    squares
        (row, col) of its lanes: of a dead end from the deepest one on, of a stretch in reading order.
    length_m
        Of a dead end from its deepest tip to the lane or portal where it begins, of a stretch from end to end.
    length_squares
        The same in squares.
    """

    squares: tuple[Square, ...]
    length_m: float
    length_squares: int


@dataclass(frozen=True, eq=False)
class MeasuredCirculation:
    """How traffic circulates on a structure's lanes, in squares and in metres.

    Attributes
    ----------
    circulation
        The survey in squares.
    dead_ends
        Every dead end with its branches, by the square where it begins.
    stretches
        Every stretch of lanes without a junction.
    """

    circulation: Circulation
    dead_ends: tuple[Run, ...]
    stretches: tuple[Run, ...]

    @cached_property
    def dead_end_m(self) -> float:
        """Depth of the deepest dead end; 0 without any."""
        return max((run.length_m for run in self.dead_ends), default=0.0)

    @cached_property
    def stretch_m(self) -> float:
        """Length of the longest stretch without a junction; 0 without any."""
        return max((run.length_m for run in self.stretches), default=0.0)


def measured_circulation(structure: Structure) -> MeasuredCirculation:
    """Measure how traffic circulates on a complete structure.

    Notes
    -----
    The lanes that pruning takes off form trees: each hangs on the one neighbour that outlasts it. The depth of a tree
    is the length of its longest branch, measured from border to border. A stretch is measured along the middle of its
    lanes, from the border of one junction to that of the next.
    """
    found = circulation(structure)
    return MeasuredCirculation(found, tuple(_dead_ends(structure, found)), tuple(_stretches(structure, found)))


def neither_share(structure: Structure, bay: BayConfig) -> float:
    """Share of the floor inside the contour, obstacles apart, that is neither a lane or portal nor a stall."""
    areas = np.outer(structure.row_depths_mm, structure.column_widths_mm) / _MM2_PER_M2
    floor = float(areas[structure.cells != Cell.OBSTACLE].sum())
    stalls = int(square_capacity(structure, bay).sum()) * bay.stall_width_m * bay.stall_length_m
    used = float(areas[structure.cells >= Cell.LANE].sum()) + stalls
    return max(0.0, 1.0 - used / floor) if floor else 0.0


def _dead_ends(structure: Structure, found: Circulation) -> Iterator[Run]:
    """A tree of pruned lanes at a time."""
    rounds = np.pad(found.rounds, 1)
    drivable = bordered(structure.cells >= Cell.LANE)
    root_of: dict[Square, Square] = {}
    depth: dict[Square, tuple[int, int]] = {}
    trees: dict[Square, list[Square]] = {}
    pruned: list[Square] = [(row, col) for row, col in np.argwhere(found.rounds > 0).tolist()]
    # a lane is pruned after all that hang on it, so that whatever it hangs on itself is measured before
    for square in sorted(pruned, key=lambda square: -int(found.rounds[square])):
        onward, side_mm = _onward(structure, rounds, drivable, square)
        root_of[square] = square if onward is None else root_of[onward]
        before_mm, before = (0, 0) if onward is None else depth[onward]
        depth[square] = before_mm + side_mm, before + 1
        trees.setdefault(root_of[square], []).append(square)
    for root in sorted(trees):
        squares = sorted(trees[root], key=lambda square: (-depth[square][0], square))
        yield Run(tuple(squares), depth[squares[0]][0] / _MM_PER_M, max(depth[square][1] for square in squares))


def _onward(
    structure: Structure, rounds: NDArray[np.int32], drivable: NDArray[np.bool_], square: Square
) -> tuple[Square | None, int]:
    """The pruned lane that a pruned lane hangs on, None where it hangs on one that stays, and its length that way."""
    row, col = square
    sides = int(structure.row_depths_mm[row]), int(structure.column_widths_mm[col])
    for dr, dc in NEIGHBOUR_STEPS:
        at = row + 1 + dr, col + 1 + dc
        if drivable[at] and rounds[at] == 0:
            return None, sides[0] if dr else sides[1]
    for dr, dc in NEIGHBOUR_STEPS:
        at = row + 1 + dr, col + 1 + dc
        if rounds[at] > rounds[row + 1, col + 1]:
            return (row + dr, col + dc), sides[0] if dr else sides[1]
    return None, max(sides)


def _stretches(structure: Structure, found: Circulation) -> Iterator[Run]:
    """A piece of lanes with two neighbours that stay at a time."""
    stays = np.pad((structure.cells >= Cell.LANE) & (found.rounds == 0), 1)
    up, down, left, right = stays[:-2, 1:-1], stays[2:, 1:-1], stays[1:-1, :-2], stays[1:-1, 2:]
    along_mm = (
        (up.astype(np.int64) + down) * structure.row_depths_mm[:, None]
        + (left.astype(np.int64) + right) * structure.column_widths_mm
    ) // 2
    numbers, count = pieces_of(found.stretches > 0)
    squares: list[list[Square]] = [[] for _ in range(count)]
    for row, col in np.argwhere(numbers).tolist():
        squares[numbers[row, col] - 1].append((row, col))
    for run in squares:
        length_mm = sum(int(along_mm[square]) for square in run)
        yield Run(tuple(run), length_mm / _MM_PER_M, len(run))
