"""Annealing of large plans: a flip is judged by the squares around it, the whole only now and then. Compiled."""
# ruff: noqa: C901, PLR0912, PLR0915 - a flip is judged in one loop over shared counters

import numpy as np
from numpy.typing import NDArray

from garage2usd.compiled import compiled, compiled_inner, copy_row
from garage2usd.planning.archive import next_random, uniform
from garage2usd.planning.board import FAR, NO_VALUE, Board, flip, measure, stalls_at
from garage2usd.planning.ground import Ground

__all__ = ["drift"]

_RING = 8
"""Neighbours of a square by edge and corner."""
_ENTRANCE = 2
"""`Cell.ENTRANCE`, as numba reads it."""
_WHOLE_SHARE = 30
"""Squares measured for flips that may part the lanes, for each trial: it bounds their part of the time."""


@compiled_inner
def _joined_around(cells: NDArray[np.int8], stride: int, square: int) -> bool:
    """Whether the lanes beside a square are joined among its eight neighbours: without it they still are."""
    ring = (
        square - stride,
        square - stride + 1,
        square + 1,
        square + stride + 1,
        square + stride,
        square + stride - 1,
        square - 1,
        square - stride - 1,
    )
    pieces = 0
    for index in range(0, _RING, 2):
        if cells[ring[index]] != 1:
            continue
        # a lane beside begins a piece unless the lane before it on the ring leads to it
        before, corner = (index - 2) % _RING, (index - 1) % _RING
        pieces += not (cells[ring[before]] == 1 and cells[ring[corner]] == 1)
    if pieces == 0:
        return True  # all four are joined in a circle, or there is none
    return pieces == 1


@compiled_inner
def _portals_hold(ground: Ground, cells: NDArray[np.int8], square: int) -> bool:
    """Whether the portals beside a square touch a lane."""
    stride = ground.stride
    for step in (-stride, stride, -1, 1):
        portal = square + step
        if cells[portal] > 1:
            touched = False
            for other in (-stride, stride, -1, 1):
                touched |= cells[portal + other] == 1
            if not touched:
                return False
    return True


@compiled_inner
def _reach(board: Board, stride: int, q: int, p: int) -> bool:
    """Set `hops` of two squares beside each other, or of one, from the lanes around; whether new lanes join others."""
    cells, hops = board.cells, board.hops
    hops[q] = FAR
    hops[p] = FAR
    joined = cells[q] != 1 and cells[p] != 1
    for x in (q, p, q):
        if cells[x] == 1:
            for step in (-stride, stride, -1, 1):
                y = x + step
                if cells[y] == 1:
                    hops[x] = min(hops[x], hops[y] + 1)
                    joined |= y != q and y != p  # noqa: PLR1714 - numba
                elif cells[y] == _ENTRANCE:
                    hops[x] = 1
    return bool(joined)


@compiled
def drift(
    ground: Ground,
    board: Board,
    best_cells: NDArray[np.int8],
    random: NDArray[np.uint64],
    flips: int,
    hottest: float,
    coldest: float,
    refresh: int,
) -> float:
    """Anneal the feasible lanes in `board.cells`; leaves the best measured there and returns its value.

    `best_cells` is room for as many.

    Notes
    -----
    N_S and U_S change exactly; T_S is followed by the distances as of the last measurement, one every `refresh`
    flips, by which alone the best is chosen. A flip that may part the lanes is measured whole, as long as such
    measurements take no more than a share of the time.
    """
    cells, stride, weights = board.cells, ground.stride, ground.weights
    measured = measure(ground, board, -np.inf)
    best = measured
    copy_row(best_cells, cells)
    stalls, time, unused = board.tally[0], board.tally[1], board.tally[2]
    around = board.queue  # measuring needs it no longer than a call
    cooling = (coldest / hottest) ** (1.0 / max(1, flips))
    heat, changed, wholes = hottest, 0, 0
    for trial in range(flips):
        heat *= cooling
        if trial % refresh == refresh - 1 and changed > 0:
            measured = measure(ground, board, -np.inf)
            stalls, time, unused, changed = board.tally[0], board.tally[1], board.tally[2], 0
            if measured > best:
                best = measured
                copy_row(best_cells, cells)
        draw = next_random(random)
        q = ground.squares[np.int64((draw >> np.uint64(8)) % np.uint64(len(ground.squares)))]
        step = (0, 0, 1, stride)[np.int64(draw & np.uint64(3))]
        p = q + step
        if cells[p] != 0 and cells[p] != 1:
            continue
        # the squares whose stalls may change
        around[0], around[1], around[2], around[3], around[4] = q, q - stride, q + stride, q - 1, q + 1
        size = 5
        if step != 0:
            for other in (-stride, stride, -1, 1):
                if p + other != q:
                    around[size] = p + other
                    size += 1
        d_stalls, d_time, d_unused = 0, 0, 0
        possible = True
        for sign in (-1, 1):
            for index in range(size):
                x = around[index]
                if cells[x] == 0:
                    count, near = stalls_at(ground, board, x)
                    d_stalls += sign * count
                    d_unused += sign * (count == 0)
                    if count > 0:
                        d_time += sign * count * (1 + near)
            if sign < 0:
                flip(cells, q, p)
                # the way to new lanes
                possible = _reach(board, stride, q, p)
        accepted, whole = False, False
        if possible and stalls + d_stalls > 0:
            before = weights[1] * time / stalls
            after = weights[1] * (time + d_time) / (stalls + d_stalls)
            change = weights[0] * d_stalls + weights[2] * d_unused + after - before
            threshold = heat * np.log(max(uniform(random), 1e-300))
            if change >= threshold:
                # joined still?
                sure, held = True, True
                if step != 0 and cells[q] == 0 and cells[p] == 0:
                    sure = False
                for turn in range(1 if step == 0 else 2):
                    x = q if turn == 0 else p
                    if cells[x] == 0:
                        sure &= _joined_around(cells, stride, x)
                        held &= _portals_hold(ground, cells, x)
                if held and sure:
                    accepted = True
                    stalls, time, unused = stalls + d_stalls, time + d_time, unused + d_unused
                    changed += 1
                elif held and change > 0 and wholes * len(ground.squares) <= _WHOLE_SHARE * trial:
                    wholes += 1
                    exact = measure(ground, board, -np.inf)
                    now = weights[0] * stalls + before + weights[2] * unused
                    if exact > NO_VALUE and exact >= now + threshold:
                        accepted = True
                        stalls, time, unused, changed = board.tally[0], board.tally[1], board.tally[2], 0
                        if exact > best:
                            best = exact
                            copy_row(best_cells, cells)
                    else:
                        whole = True
        if not accepted:
            flip(cells, q, p)
            if whole:  # the measurement took all distances with it
                measure(ground, board, -np.inf)
            else:
                _reach(board, stride, q, p)
    if measure(ground, board, -np.inf) > best:
        copy_row(best_cells, cells)
    copy_row(cells, best_cells)
    return measure(ground, board, -np.inf)
