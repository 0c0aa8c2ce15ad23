"""Frontier-based search over layouts: lane or free is decided square by square in reading order. Compiled.

A dynamic programme over the broken profile (transfer matrices, one square at a time) keeps the best value of each
frontier and what can follow it; an enumeration by these suffixes then meets only layouts that may win.
"""
# ruff: noqa: C901, PLR0912, PLR0915 - loops that numba flattens

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.compiled import compiled, compiled_allocating, copy_row
from garage2usd.planning.board import FAR, Board, measure
from garage2usd.planning.broken_profile import FORBIDDEN, SquareTable, first_frontier, step
from garage2usd.planning.ground import PADDING, Ground

__all__ = ["Enumeration", "advance", "enumerate_layouts", "new_enumeration", "suffix_values"]


@compiled_allocating
def advance(
    table: SquareTable, index: int, keys: NDArray[np.int64], values: NDArray[np.float64]
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """All frontiers after a square, each with its best value so far; keys ascend."""
    room = np.zeros((3, table.cols + 2), np.int64)
    choices = table.depth + 2 if table.depth >= 0 else 2
    next_keys = np.empty(choices * len(keys), np.int64)
    next_values = np.empty(choices * len(keys))
    count = 0
    for row in range(len(keys)):
        for choice in range(choices):
            key, gain = step(table, index, keys[row], choice, room)
            if gain == FORBIDDEN:
                continue
            next_keys[count], next_values[count] = key, values[row] + gain
            count += 1
    order = np.argsort(next_keys[:count])
    unique_keys, unique_values = np.empty(count, np.int64), np.empty(count)
    size = 0
    for row in order:
        if size > 0 and unique_keys[size - 1] == next_keys[row]:
            unique_values[size - 1] = max(unique_values[size - 1], next_values[row])
        else:
            unique_keys[size], unique_values[size] = next_keys[row], next_values[row]
            size += 1
    return unique_keys[:size].copy(), unique_values[:size].copy()


@compiled_allocating
def suffix_values(
    table: SquareTable,
    index: int,
    keys: NDArray[np.int64],
    next_keys: NDArray[np.int64],
    next_suffix: NDArray[np.float64],
) -> NDArray[np.float64]:
    """The most that square `index` and all after it add to each frontier before it."""
    room = np.zeros((3, table.cols + 2), np.int64)
    suffix = np.full(len(keys), FORBIDDEN)
    choices = table.depth + 2 if table.depth >= 0 else 2
    for row in range(len(keys)):
        for choice in range(choices):
            key, gain = step(table, index, keys[row], choice, room)
            if gain == FORBIDDEN:
                continue
            place = np.searchsorted(next_keys, key)
            if place < len(next_keys) and next_keys[place] == key and next_suffix[place] > FORBIDDEN:
                suffix[row] = max(suffix[row], gain + next_suffix[place])
    return suffix


@compiled
def _detour(ground: Ground, board: Board, cols: int, depth: int, relaxed: NDArray[np.int64]) -> float:
    """How much more time than over free squares the stalls so far take at least, given what is decided no lane.

    Squares from `depth` on may all still be lanes.
    """
    cells, hops, queue, stride = board.cells, board.hops, board.queue, ground.stride
    border = PADDING * (stride + 1)
    first_open = border + (depth // cols) * stride + depth % cols
    for q in ground.squares:
        hops[q] = FAR
    tail = 0
    for entrance in ground.entrances:
        for way in (-stride, stride, -1, 1):
            p = entrance + way
            if hops[p] == FAR and (cells[p] == 1 or (cells[p] == 0 and p >= first_open)):
                hops[p] = 1
                queue[tail] = p
                tail += 1
    head = 0
    while head < tail:
        q = queue[head]
        head += 1
        for way in (-stride, stride, -1, 1):
            p = q + way
            if (cells[p] == 1 or (cells[p] == 0 and p >= first_open)) and hops[p] == FAR:
                hops[p] = hops[q] + 1
                queue[tail] = p
                tail += 1
    more = 0.0
    for q in ground.squares:
        if q >= first_open:
            break
        if cells[q] != 0:
            continue
        edges, near, free = 0, FAR, FAR
        for side in range(4):
            p = q + (-stride, stride, -1, 1)[side]
            if cells[p] == 1:
                edges |= 1 << side
                free = min(free, relaxed[p])
            if cells[p] == 1 or (cells[p] == 0 and p >= first_open):
                near = min(near, hops[p])
        stalls = ground.capacity[q, edges]
        if stalls > 0 and near > free:
            more += stalls * (near - free)
    return more


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
        int64, shape (3, columns + 2), as `step` asks for.
    best_cells
        The cells of the best layout, as in `Board.cells`.
    best
        float64, shape (1,): its value, or the value to beat.
    counts
        int64, shape (2,): how many squares of the layout begun are decided, -1 at the end; layouts scored.
    """

    ways: NDArray[np.int64]
    next_keys: NDArray[np.int64]
    next_values: NDArray[np.float64]
    bounds: NDArray[np.float64]
    children: NDArray[np.int64]
    tried: NDArray[np.int64]
    keys: NDArray[np.int64]
    values: NDArray[np.float64]
    room: NDArray[np.int64]
    best_cells: NDArray[np.int8]
    best: NDArray[np.float64]
    counts: NDArray[np.int64]


def new_enumeration(table: SquareTable, ground: Ground, floor: float) -> Enumeration:
    """An enumeration of the layouts that beat a value."""
    total, choices = len(table.kinds), table.depth + 2 if table.depth >= 0 else 2
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
        room=np.zeros((3, table.cols + 2), np.int64),
        best_cells=ground.cells.copy(),
        best=np.array([floor]),
        counts=np.zeros(2, np.int64),
    )


@compiled
def enumerate_layouts(
    state: Enumeration,
    steps: int,
    table: SquareTable,
    ground: Ground,
    board: Board,
    offsets: NDArray[np.int64],
    keys: NDArray[np.int64],
    suffixes: NDArray[np.float64],
    relaxed: NDArray[np.int64],
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
    total, choices = state.ways.shape
    room = state.room
    ways, bounds, children, tried = state.ways, state.bounds, state.children, state.tried
    next_keys, next_values = state.next_keys, state.next_values
    stride = ground.stride
    border = PADDING * (stride + 1)
    best, depth = state.best[0], state.counts[0]
    for _ in range(steps):
        if depth < 0:
            break
        if depth == total:
            value = measure(ground, board, -np.inf)
            state.counts[1] += 1
            if value > best + 1e-9:
                best = value
                copy_row(state.best_cells, board.cells)
            depth -= 1
            continue
        if tried[depth] < 0:
            children[depth] = tried[depth] = 0
            first, last = offsets[depth + 1], offsets[depth + 2]
            for choice in range(choices):
                key, gain = step(table, depth, state.keys[depth], choice, room)
                if gain == FORBIDDEN:
                    continue
                place = first + np.searchsorted(keys[first:last], key)
                value = state.values[depth] + gain
                bound = value + suffixes[place]
                if bound <= best + 1e-9:
                    continue
                slot = children[depth]
                while slot > 0 and bounds[depth, slot - 1] < bound:
                    ways[depth, slot], bounds[depth, slot] = ways[depth, slot - 1], bounds[depth, slot - 1]
                    next_keys[depth, slot] = next_keys[depth, slot - 1]
                    next_values[depth, slot] = next_values[depth, slot - 1]
                    slot -= 1
                ways[depth, slot], bounds[depth, slot] = choice, bound
                next_keys[depth, slot], next_values[depth, slot] = key, value
                children[depth] += 1
        square = border + (depth // table.cols) * stride + depth % table.cols
        slot = tried[depth]
        if slot == children[depth] or bounds[depth, slot] <= best + 1e-9:
            board.cells[square] = ground.cells[square]
            tried[depth] = -1
            depth -= 1
            continue
        tried[depth] += 1
        board.cells[square] = 1 if ways[depth, slot] > 0 else ground.cells[square]
        if (depth + 1) % table.cols == 0:
            detour = price * _detour(ground, board, table.cols, depth + 1, relaxed)
            if bounds[depth, slot] - detour <= best + 1e-9:
                continue
        state.keys[depth + 1], state.values[depth + 1] = next_keys[depth, slot], next_values[depth, slot]
        depth += 1
    state.best[0], state.counts[0] = best, depth
    return bool(depth < 0)
