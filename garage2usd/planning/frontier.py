"""Frontier-based search over layouts: lane or free is decided square by square in reading order.

In C, `frontier.c`.
"""

from typing import NamedTuple

import numpy as np

from garage2usd.native import Float64s, Int8s, Int64s, in_c
from garage2usd.planning.board import Board
from garage2usd.planning.broken_profile import SquareTable, choices_of, first_frontier, new_room
from garage2usd.planning.ground import Ground

__all__ = ["Enumeration", "advance", "enumerate_layouts", "new_enumeration", "suffix_values"]


def advance(table: SquareTable, index: int, keys: Int64s, values: Float64s) -> tuple[Int64s, Float64s]:
    """All frontiers after a square, each with its best value so far; keys ascend."""
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
    """The most that square `index` and all after it add to each frontier before it."""
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
    """An enumeration on its way, which `enumerate_layouts` carries on.

    Attributes
    ----------
    ways, next_keys, next_values, bounds
        Children of the layouts begun so far, square by square, those with the greatest bounds first: their choices
        and frontiers, int64; their values and what they may come to, float64; shape (squares, choices).
    children, tried
        How many children each square has, and how many were tried, -1 for a square that is not begun; int64, shape
        (squares,).
    keys, values
        Frontier and value before each square; int64 and float64, shape (squares + 1,).
    room
        int64, shape (3, columns + 2), for a step.
    best_cells
        The cells of the best layout, as in `Board.cells`.
    best
        float64, shape (1,): its value, or the value to beat.
    counts
        int64, shape (2,): how many squares of the layout begun are decided, -1 at the end; layouts scored.
    """

    ways: Int64s
    next_keys: Int64s
    next_values: Float64s
    bounds: Float64s
    children: Int64s
    tried: Int64s
    keys: Int64s
    values: Float64s
    room: Int64s
    best_cells: Int8s
    best: Float64s
    counts: Int64s


def new_enumeration(table: SquareTable, ground: Ground, floor: float) -> Enumeration:
    """An enumeration of the layouts that beat a value."""
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
    """Score the layouts whose relaxed value is above the best met so far; whether all of them are scored.

    Parameters
    ----------
    state
        What is enumerated; `board` holds its layout from call to call, at first that of `ground`.
    steps
        After how many steps, a square decided or taken back, to return.
    table, ground, board
        The site; `ground` and `table` hold the same squares.
    offsets
        int64, shape (squares + 2,): where the frontiers before each square start in `keys`.
    keys, suffixes
        The frontiers of all squares, and what can follow each.
    relaxed, price
        Hops of the squares over free squares, and what a hop of a stall costs in the relaxed value.
    """
    raise NotImplementedError
