"""Steps of a dynamic programme that decides lane or free square by square in reading order. Compiled.

What the squares decided so far mean for the rest is kept for the last square of each column only, the frontier: four
bits each, in one number.
"""
# ruff: noqa: C901, PLR0912, PLR0915, PLR2004 - bit fields and loops that numba flattens

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.compiled import compiled
from garage2usd.planning.board import FAR, NO_VALUE, Board, measure
from garage2usd.planning.ground import PADDING, Ground

__all__ = ["FORBIDDEN", "Sheet", "advance", "complete", "enumerate_layouts", "suffix_values"]

FORBIDDEN = -1.0e18

# codes of a column: 0 nothing to come, 1 to 5 a lane by its piece, 6 a portal that touches no lane yet,
# 7 + edges a free square, edges being the sum of 1 up, 2 left, 4 right that are open; 15 a new piece within a step
_PORTAL, _FREE, _NEW_PIECE, _FINISHED = 6, 7, 15, 1 << 60


class Sheet(NamedTuple):
    """What a square is and what it brings.

    Attributes
    ----------
    cols
        Columns, at most 12; square ``i`` is in row ``i // cols``.
    kinds
        int8, shape (rows * cols,): values of `garage2usd.grid.Cell`.
    worth
        float64, shape (rows * cols, 16): relaxed contribution of a free square by its open edges (`Ground.capacity`).
    """

    cols: int
    kinds: NDArray[np.int8]
    worth: NDArray[np.float64]


@compiled
def _mask(edges: int) -> int:
    """Edges of a code as in `Ground.capacity`."""
    return (edges & 1) | ((edges & 2) << 1) | ((edges & 4) << 1)


@compiled
def _settled(sheet: Sheet, index: int, edges: int) -> int:
    """Code of a free square of which only the lower edge is still to come; one for all that gain the same."""
    below = index + sheet.cols
    if below >= len(sheet.kinds) or sheet.kinds[below] != 0:
        return 0
    gain = sheet.worth[index, _mask(edges) | 2] - sheet.worth[index, _mask(edges)]
    if abs(gain) < 1e-12:
        return 0
    for other in range(edges):
        if abs(sheet.worth[index, _mask(other) | 2] - sheet.worth[index, _mask(other)] - gain) < 1e-12:
            return _FREE + other
    return _FREE + edges


@compiled
def _step(sheet: Sheet, index: int, key: int, lane: bool, codes: NDArray[np.int64]) -> tuple[int, float]:  # noqa: FBT001
    """The frontier after one more square, and what it adds; `FORBIDDEN` if no feasible layout goes that way."""
    cols, kind = sheet.cols, sheet.kinds[index]
    col = index % cols
    finished = key & _FINISHED
    if lane and (kind != 0 or finished != 0):
        return 0, FORBIDDEN
    for c in range(cols):
        codes[c] = (key >> (4 * c)) & 15
    up, left = codes[col], 0
    if col > 0:
        left = codes[col - 1]
    gain = 0.0
    # the square above is complete
    if up == _PORTAL and not lane:
        return 0, FORBIDDEN
    if up >= _FREE and lane:
        mask = _mask(up - _FREE)
        gain += sheet.worth[index - cols, mask | 2] - sheet.worth[index - cols, mask]
    up_lane = 1 <= up <= 5
    left_lane = 1 <= left <= 5
    if up_lane and not lane:
        codes[col] = 0
        alone, others = True, False
        for c in range(cols):
            alone &= codes[c] != up
            others |= 1 <= codes[c] <= 5 and codes[c] != up
        if alone:
            if others:
                return 0, FORBIDDEN
            finished = _FINISHED
    # the right edge of the square to the left is decided
    if left == _PORTAL and lane:
        codes[col - 1] = 0
    elif left >= _FREE:
        edges = left - _FREE
        if lane:
            gain += sheet.worth[index - 1, _mask(edges | 4)] - sheet.worth[index - 1, _mask(edges)]
            edges |= 4
        codes[col - 1] = _settled(sheet, index - 1, edges)
    # this square
    if lane:
        if up_lane:
            label = up
            if left_lane and left != up:
                for c in range(cols):
                    if codes[c] == left:
                        codes[c] = up
        elif left_lane:
            label = left
        else:
            label = _NEW_PIECE  # numbered below
        codes[col] = label
    elif kind >= 2:
        codes[col] = 0 if up_lane or left_lane else _PORTAL
    elif kind == 0:
        edges = int(up_lane) + 2 * int(left_lane)
        gain += sheet.worth[index, _mask(edges)]
        ends = col == cols - 1 or sheet.kinds[index + 1] != 0
        codes[col] = _settled(sheet, index, edges) if ends else _FREE + edges
    else:
        codes[col] = 0
    # number the pieces by their first column
    result, used = finished, 0
    names = np.zeros(16, np.int64)
    for c in range(cols):
        code = codes[c]
        if 1 <= code <= 5 or code == _NEW_PIECE:
            if names[code] == 0:
                used += 1
                names[code] = used
            code = names[code]
        result |= code << (4 * c)
    return result, gain


@compiled
def complete(sheet: Sheet, key: int) -> bool:
    """Whether a frontier below the last square is that of a feasible layout."""
    pieces = 0
    for c in range(sheet.cols):
        code = (key >> (4 * c)) & 15
        if code == _PORTAL:
            return False
        if 1 <= code <= 5:
            pieces = max(pieces, code)
    return (pieces == 1) if key & _FINISHED == 0 else pieces == 0


@compiled
def _optimistic(sheet: Sheet, key: int, left_over: int, best_square: float) -> float:
    """What a frontier and the squares that follow can bring at most.

    Notes
    -----
    ``F <= 2 L + W`` for L lanes more that serve F squares more, W lanes on the frontier: joined lanes spend edges on
    each other. With ``F + L <= squares left + squares waiting`` that bounds F.
    """
    lanes, waiting = 0, 0
    for c in range(sheet.cols):
        code = (key >> (4 * c)) & 15
        lanes += 1 <= code <= 5
        waiting += code >= _FREE
    if key & _FINISHED != 0:
        return 0.0
    served = (2 * (left_over + waiting) + max(2, lanes)) / 3
    return served * best_square + 2.0 * waiting * best_square


@compiled
def advance(
    sheet: Sheet, index: int, keys: NDArray[np.int64], values: NDArray[np.float64], floor: float, left_over: int
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """All frontiers after a square, each with its best value so far, that may still reach `floor`; keys ascend."""
    codes = np.zeros(sheet.cols, np.int64)
    next_keys = np.empty(2 * len(keys), np.int64)
    next_values = np.empty(2 * len(keys))
    best_square = sheet.worth.max() - sheet.worth.min()
    count = 0
    for row in range(len(keys)):
        for lane in (False, True):
            key, gain = _step(sheet, index, keys[row], lane, codes)
            if gain == FORBIDDEN:
                continue
            value = values[row] + gain
            if value + _optimistic(sheet, key, left_over, best_square) < floor:
                continue
            next_keys[count], next_values[count] = key, value
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


@compiled
def suffix_values(
    sheet: Sheet, index: int, keys: NDArray[np.int64], next_keys: NDArray[np.int64], next_suffix: NDArray[np.float64]
) -> NDArray[np.float64]:
    """The most that square `index` and all after it add to each frontier before it."""
    codes = np.zeros(sheet.cols, np.int64)
    suffix = np.full(len(keys), FORBIDDEN)
    for row in range(len(keys)):
        for lane in (False, True):
            key, gain = _step(sheet, index, keys[row], lane, codes)
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
        for step in (-stride, stride, -1, 1):
            p = entrance + step
            if hops[p] == FAR and (cells[p] == 1 or (cells[p] == 0 and p >= first_open)):
                hops[p] = 1
                queue[tail] = p
                tail += 1
    head = 0
    while head < tail:
        q = queue[head]
        head += 1
        for step in (-stride, stride, -1, 1):
            p = q + step
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
        for way in range(4):
            p = q + (-stride, stride, -1, 1)[way]
            if cells[p] == 1:
                edges |= 1 << way
                free = min(free, relaxed[p])
            if cells[p] == 1 or (cells[p] == 0 and p >= first_open):
                near = min(near, hops[p])
        stalls = ground.capacity[q, edges]
        if stalls > 0 and near > free:
            more += stalls * (near - free)
    return more


@compiled
def enumerate_layouts(
    sheet: Sheet,
    ground: Ground,
    board: Board,
    offsets: NDArray[np.int64],
    keys: NDArray[np.int64],
    suffixes: NDArray[np.float64],
    relaxed: NDArray[np.int64],
    price: float,
    floor: float,
    limit: int,
) -> tuple[float, int]:
    """Score every layout whose relaxed value is above the best met so far; leaves the best in `board.cells`.

    Parameters
    ----------
    sheet, ground, board
        The site; `ground` and `sheet` hold the same squares.
    offsets
        int64, shape (squares + 2,): where the frontiers before each square start in `keys`.
    keys, suffixes
        The frontiers of all squares, and what can follow each.
    relaxed, price
        Hops of the squares over free squares, and what a hop of a stall costs in the relaxed value.
    floor
        Value to beat.
    limit
        Most layouts to score.

    Returns
    -------
    tuple[float, int]
        The best value, or `floor` if nothing beats it, and how many layouts were scored.
    """
    total = len(sheet.kinds)
    codes = np.zeros(sheet.cols, np.int64)
    stack_keys, stack_values = np.zeros(total + 1, np.int64), np.zeros(total + 1)
    tried = np.zeros(total + 1, np.int64)
    stride = ground.stride
    border = PADDING * (stride + 1)
    best, best_cells, scored, depth = floor, ground.cells.copy(), 0, 0
    board.cells[:] = ground.cells
    while depth >= 0:
        if depth == total:
            value = measure(ground, board)
            scored += 1
            if value > best + 1e-9:
                best = value
                best_cells[:] = board.cells
            if scored >= limit:
                break
            depth -= 1
            continue
        square = border + (depth // sheet.cols) * stride + depth % sheet.cols
        if tried[depth] == 2:
            board.cells[square] = ground.cells[square]
            tried[depth] = 0
            depth -= 1
            continue
        lane = tried[depth] == 0
        tried[depth] += 1
        key, gain = _step(sheet, depth, stack_keys[depth], lane, codes)
        if gain == FORBIDDEN:
            continue
        first, last = offsets[depth + 1], offsets[depth + 2]
        place = first + np.searchsorted(keys[first:last], key)
        value = stack_values[depth] + gain
        if place >= last or keys[place] != key or value + suffixes[place] <= best + 1e-9:
            continue
        board.cells[square] = 1 if lane else ground.cells[square]
        if (depth + 1) % sheet.cols == 0 or depth + 1 == total:
            detour = price * _detour(ground, board, sheet.cols, depth + 1, relaxed)
            if value + suffixes[place] - detour <= best + 1e-9:
                board.cells[square] = ground.cells[square]
                continue
        depth += 1
        stack_keys[depth], stack_values[depth], tried[depth] = key, value, 0
    board.cells[:] = best_cells
    return (best if best > floor else NO_VALUE), scored
