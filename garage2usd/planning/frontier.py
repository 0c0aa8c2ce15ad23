"""Frontier-based search over layouts: lane or free is decided square by square in reading order.

The frontier between decided squares and squares to come is a broken profile. In C, `frontier.c` and `broken_profile.c`.
"""

from typing import NamedTuple

import numpy as np

from garage2usd.native import Bools, Float64s, Float64Table, Int8s, Int64s, Int64Table, in_c
from garage2usd.planning.board import Board, Ground

FORBIDDEN = -1.0e18

# codes of lanes begin at `_LANE`; the columns share 60 bits of a frontier, and the bit above is set if there is a loop,
# or none is required
_LANE, _ALL_BITS, _LOOPED = 10, 60, 1 << 61


class SquareTable(NamedTuple):
    """Kind and value of each square, as the search reads them.

    Attributes
    ----------
    cols
        Columns; square ``i`` is in row ``i // cols``.
    bits
        Bits of a column in a frontier.
    depth
        R1: deepest stub; -1 without this rule.
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
    worth: Float64Table
    asks_loop: bool


def column_bits(cols: int, depth: int) -> int:
    """Bits of a column of a frontier; 0 if these are too few for its codes."""
    types = 1 if depth < 0 else 3 + 2 * depth
    bits = min(_ALL_BITS // max(cols, 1), 16)
    return bits if _LANE + types * ((cols + 1) // 2) <= 1 << bits else 0


def choices_of(table: SquareTable) -> int:
    """Number of choices for a square: no lane, a lane of the core, a stub of each depth."""
    return table.depth + 2 if table.depth >= 0 else 2


def first_frontier(table: SquareTable) -> int:
    """Return the frontier before the first square."""
    return 0 if table.asks_loop else _LOOPED


def new_room(table: SquareTable) -> Int64s:
    """Room for a step: for codes, pieces and names of pieces."""
    return np.zeros((3, table.cols + 2), np.int64)


def are_complete(table: SquareTable, keys: Int64s) -> Bools:
    """Mark the frontiers below the last square that belong to feasible layouts."""
    complete = np.zeros(len(keys), np.bool_)
    _mark_complete(table, keys, len(keys), complete)
    return complete


@in_c
def _mark_complete(table: SquareTable, keys: Int64s, count: int, complete: Bools) -> None:
    raise NotImplementedError


def advance(table: SquareTable, index: int, keys: Int64s, values: Float64s) -> tuple[Int64s, Float64s]:
    """Advance all frontiers by one square, each with its best value so far; keys ascend."""
    most = choices_of(table) * len(keys)
    next_keys, next_values = np.empty(most, np.int64), np.empty(most)
    count = _step_frontiers(table, index, keys, values, len(keys), new_room(table), next_keys, next_values)
    order = np.argsort(next_keys[:count])
    unique_keys, unique_values = np.empty(count, np.int64), np.empty(count)
    size = _merge_frontiers(order, count, next_keys, next_values, unique_keys, unique_values)
    return unique_keys[:size].copy(), unique_values[:size].copy()


@in_c
def _step_frontiers(
    table: SquareTable,
    index: int,
    keys: Int64s,
    values: Float64s,
    count: int,
    room: Int64s,
    next_keys: Int64s,
    next_values: Float64s,
) -> int:
    raise NotImplementedError


@in_c
def _merge_frontiers(
    order: Int64s,
    count: int,
    keys: Int64s,
    values: Float64s,
    unique_keys: Int64s,
    unique_values: Float64s,
) -> int:
    raise NotImplementedError


def suffix_values(
    table: SquareTable,
    index: int,
    keys: Int64s,
    next_keys: Int64s,
    next_suffix: Float64s,
) -> Float64s:
    """Bound the value that square `index` and all after it add to each frontier before it."""
    suffix = np.empty(len(keys))
    _follow_frontiers(table, index, keys, len(keys), next_keys, next_suffix, len(next_keys), new_room(table), suffix)
    return suffix


@in_c
def _follow_frontiers(
    table: SquareTable,
    index: int,
    keys: Int64s,
    count: int,
    next_keys: Int64s,
    next_suffix: Float64s,
    next_count: int,
    room: Int64s,
    suffix: Float64s,
) -> None:
    raise NotImplementedError


class Enumeration(NamedTuple):
    """State of an enumeration between calls of `enumerate_layouts`.

    Attributes
    ----------
    ways, next_keys, next_values, bounds
        Children of the layouts begun so far, square by square, the greatest bound first: their choices and frontiers,
        int64; their values and upper bounds of them, float64; shape (squares, choices).
    children, tried
        Number of children of each square, and of tried ones, -1 for a square not begun; int64, shape (squares,).
    keys, values
        Frontier and value before each square; int64 and float64, shape (squares + 1,).
    room
        int64, shape (3, columns + 2), for a step.
    best_cells
        The cells of the best layout, as in `Board.cells`.
    best
        float64, shape (1,): its value, or the value to beat.
    counts
        int64, shape (2,): number of decided squares of the current layout, -1 at the end; number of scored layouts.
    """

    ways: Int64Table
    next_keys: Int64Table
    next_values: Float64Table
    bounds: Float64Table
    children: Int64s
    tried: Int64s
    keys: Int64s
    values: Float64s
    room: Int64Table
    best_cells: Int8s
    best: Float64s
    counts: Int64s


def new_enumeration(table: SquareTable, ground: Ground, floor: float) -> Enumeration:
    """Begin an enumeration of the layouts above a value."""
    total, choices = len(table.kinds), choices_of(table)
    keys = np.zeros(total + 1, np.int64)
    keys[0] = first_frontier(table)
    return Enumeration(
        ways=np.zeros((total, choices), np.int64),
        next_keys=np.zeros((total, choices), np.int64),
        next_values=np.zeros((total, choices)),
        bounds=np.zeros((total, choices)),
        children=np.zeros(total, np.int64),
        tried=np.full(total, -1),
        keys=keys,
        values=np.zeros(total + 1),
        room=new_room(table),
        best_cells=ground.cells.copy(),
        best=np.array([floor]),
        counts=np.zeros(2, np.int64),
    )


@in_c
def enumerate_layouts(
    state: Enumeration,
    steps: int,
    table: SquareTable,
    ground: Ground,
    board: Board,
    offsets: Int64s,
    keys: Int64s,
    suffixes: Float64s,
    relaxed: Int64s,
    price: float,
) -> bool:
    """Score the layouts whose relaxed value is above the best so far; True once all are scored.

    Parameters
    ----------
    state
        State of the enumeration; `board` holds its layout between calls, at first that of `ground`.
    steps
        Number of steps after which to return; a step decides a square or takes it back.
    table, ground, board
        The site; `ground` and `table` hold the same squares.
    offsets
        int64, shape (squares + 2,): where the frontiers before each square start in `keys`.
    keys, suffixes
        The frontiers of all squares, and the greatest value that the rest of the squares can add to each.
    relaxed, price
        Hops of the squares over free squares, and the cost of a hop of a stall in the relaxed value.
    """
    raise NotImplementedError
