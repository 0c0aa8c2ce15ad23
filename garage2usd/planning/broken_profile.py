"""The broken profile between squares that are decided and squares to come, and its step by one square.

In C, `broken_profile.c`.
"""

from typing import NamedTuple

import numpy as np

from garage2usd.native import Bools, Float64s, Int8s, Int64s, in_c

__all__ = ["FORBIDDEN", "SquareTable", "are_complete", "choices_of", "column_bits", "first_frontier", "new_room"]

FORBIDDEN = -1.0e18

# where the codes of lanes begin, columns share 60 bits of a frontier, and one above them tells that there is a loop, or
# need be none
_LANE, _ALL_BITS, _LOOPED = 10, 60, 1 << 61


class SquareTable(NamedTuple):
    """What a square is and what it brings.

    Attributes
    ----------
    cols
        Columns; square ``i`` is in row ``i // cols``.
    bits
        Bits of a column in a frontier.
    depth
        R1: deepest stub; -1 where no rule is asked for.
    kinds
        int8, shape (rows * cols,): values of `garage2usd.structure.grid.Cell`.
    portals
        int64, shape (rows * cols,): portals beside the square.
    worth
        float64, shape (rows * cols, 16): relaxed contribution of a free square by its open edges (`Ground.capacity`).
    asks_loop
        R2: whether there is to be a loop.
    """

    cols: int
    bits: int
    depth: int
    kinds: Int8s
    portals: Int64s
    worth: Float64s
    asks_loop: bool


def column_bits(cols: int, depth: int) -> int:
    """Bits that a column of a frontier has; 0 if these are too few for its codes."""
    types = 1 if depth < 0 else 3 + 2 * depth
    bits = min(_ALL_BITS // max(cols, 1), 16)
    return bits if _LANE + types * ((cols + 1) // 2) <= 1 << bits else 0


def choices_of(table: SquareTable) -> int:
    """How many choices there are for a square: no lane, a lane of the core, a stub of each depth."""
    return table.depth + 2 if table.depth >= 0 else 2


def first_frontier(table: SquareTable) -> int:
    """The frontier before the first square."""
    return 0 if table.asks_loop else _LOOPED


def new_room(table: SquareTable) -> Int64s:
    """Room for a step: for codes, pieces and names of pieces."""
    return np.zeros((3, table.cols + 2), np.int64)


def are_complete(table: SquareTable, keys: Int64s) -> Bools:
    """Which frontiers below the last square are those of feasible layouts."""
    complete = np.zeros(len(keys), np.bool_)
    _mark_complete(table, keys, len(keys), complete)
    return complete


@in_c
def _mark_complete(table: SquareTable, keys: Int64s, count: int, complete: Bools) -> None:
    raise NotImplementedError
