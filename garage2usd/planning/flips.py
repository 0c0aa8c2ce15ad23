"""Flips of one square or two, judged by what is around them before the whole plan is measured. Compiled."""
# ruff: noqa: C901, PLR2004 - walks over squares; an entrance among the cells

import numpy as np
from numpy.typing import NDArray

from garage2usd.compiled import Whole, compiled_inlined, compiled_inner
from garage2usd.planning.board import FAR, Board, flip
from garage2usd.planning.ground import Ground

__all__ = ["FLIPPED", "REFUSED", "TALLIED", "flip_within"]

REFUSED, FLIPPED, TALLIED = 0, 1, 2

_TAKEN_OFF, _PUT_ON = np.int64(-1), np.int64(1)
_STALLS, _TIME, _UNUSED = 0, 1, 2
_ROUNDING = 1e-9


@compiled_inlined
def flip_within(
    ground: Ground,
    board: Board,
    known: NDArray[np.int64],
    hops: NDArray[np.int32],
    q: int,
    p: int,
    least: float,
) -> int:
    """Flip one square, or two side by side, unless the lanes cannot be worth `least` with that.

    Parameters
    ----------
    ground, board
        The site and feasible lanes on it.
    known, hops
        Stalls, time and unused squares of these lanes, as in `Board.tally`, and their hops, of which those of the
        flipped squares are changed.
    q, p
        The squares; the same for one.
    least
        In stalls.

    Returns
    -------
    int
        `REFUSED`, `FLIPPED`, or `TALLIED` where the lanes are feasible, `hops` hold for them, and the board's tally has
        their stalls, time and unused squares.

    Notes
    -----
    Stalls and unused squares change on and beside the flipped squares only. Cars drive no shorter way than before
    where a lane is taken off, and where one is put on at most as much shorter as it brings those beside it nearer to
    the entrances. So what is found around the flip is never less than what the whole is worth.
    """
    stalls, time, unused = known[_STALLS], known[_TIME], known[_UNUSED]
    stalls, time, unused = _count(ground, board, hops, q, p, _TAKEN_OFF, stalls, time, unused)
    flip(board.cells, q, p)
    for square in (q, p):
        if board.cells[square] == 1:
            hops[square] = FAR
    shortcut = max(_reach(ground, board, hops, q), _reach(ground, board, hops, p))
    if p != q:
        shortcut = max(shortcut, _reach(ground, board, hops, q))
    stalls, time, unused = _count(ground, board, hops, q, p, _PUT_ON, stalls, time, unused)
    if stalls <= 0:
        return FLIPPED
    weights = ground.weights
    most = weights[0] * stalls + weights[1] * (time / stalls - max(0, shortcut)) + weights[2] * unused
    if ground.rules.is_asked:
        most -= ground.rules.block_cost * _blocks(ground, board, q, p)
    fate = TALLIED if shortcut <= 0 else FLIPPED
    if most < least - _ROUNDING:
        fate = REFUSED
    else:
        fate = min(fate, _ways(ground, board, hops, q))
        if p != q:
            fate = min(fate, _ways(ground, board, hops, p))
        if fate == TALLIED and not _is_joined(ground, board, q, p):
            fate = FLIPPED
        if fate == TALLIED and not (board.cells[q] == 1 and board.cells[p] == 1) and _starts(ground, board) > 1:
            fate = FLIPPED  # each entrance might have lanes of its own
    if fate == REFUSED:
        flip(board.cells, q, p)
    elif fate == TALLIED:
        tally = board.tally
        tally[_STALLS], tally[_TIME], tally[_UNUSED] = stalls, time, unused
    return fate


@compiled_inner
def _ways(ground: Ground, board: Board, hops: NDArray[np.int32], q: int) -> int:
    """`TALLIED` if all ways to the entrances stay as long, `REFUSED` if lanes fall apart, else `FLIPPED`: unknown."""
    cells, stride = board.cells, ground.stride
    if cells[q] == 1:
        return TALLIED
    fate, beside, alone = TALLIED, 0, False
    for step in (-stride, stride, -1, 1):
        x = q + step
        if cells[x] > 1:
            fate = min(fate, FLIPPED)  # a portal may touch no lane any more
        if cells[x] != 1:
            continue
        beside += 1
        lanes, has_parent = 0, hops[x] <= hops[q]
        for onward in (-stride, stride, -1, 1):
            y = x + onward
            if cells[y] == 1:
                lanes += 1
                has_parent |= hops[y] == hops[x] - 1
        alone |= lanes == 0
        if not has_parent:
            fate = min(fate, FLIPPED)
    if alone and beside > 1:
        return REFUSED
    return fate


@compiled_inner
def _is_joined(ground: Ground, board: Board, q: int, p: int) -> bool:
    """Whether new lanes on two squares, if any, have a lane beside them that was there before."""
    if board.cells[q] != 1 and board.cells[p] != 1:
        return True
    for square in (q, p):
        if board.cells[square] == 1:
            for step in (-ground.stride, ground.stride, -1, 1):
                beside = square + step
                if board.cells[beside] == 1 and beside not in (q, p):
                    return True
    return False


@compiled_inner
def _starts(ground: Ground, board: Board) -> int:
    """Lanes beside an entrance."""
    count = 0
    for entrance in ground.entrances:
        for step in (-ground.stride, ground.stride, -1, 1):
            count += board.cells[entrance + step] == 1
    return count


@compiled_inner
def _count(
    ground: Ground,
    board: Board,
    hops: NDArray[np.int32],
    q: int,
    p: int,
    sign: Whole,
    stalls: Whole,
    time: Whole,
    unused: Whole,
) -> tuple[Whole, Whole, Whole]:
    """Add what two squares and those beside them hold, or take it off."""
    cells, stride = board.cells, ground.stride
    for turn in range(1 if p == q else 2):
        middle, other = (q, p) if turn == 0 else (p, q)
        for step in (0, -stride, stride, -1, 1):
            x = middle + step
            if cells[x] != 0 or (step != 0 and x == other):
                continue
            edges, near = 0, FAR
            for way in range(4):
                beside = x + (-stride, stride, -1, 1)[way]
                if cells[beside] == 1:
                    edges |= 1 << way
                    near = min(near, hops[beside])
            held = ground.capacity[x, edges]
            stalls += sign * held
            unused += sign * (held == 0)
            if held > 0:
                time += sign * held * (1 + near)
    return stalls, time, unused


@compiled_inner
def _reach(ground: Ground, board: Board, hops: NDArray[np.int32], q: int) -> int:
    """Set the hops of a new lane from those beside it; by how many squares it brings one of them nearer, at most."""
    if board.cells[q] != 1:
        return 0
    least, most = FAR, 0
    for step in (-ground.stride, ground.stride, -1, 1):
        kind = board.cells[q + step]
        if kind == 1:
            least = min(least, hops[q + step] + 1)
            if hops[q + step] < FAR:
                most = max(most, hops[q + step])
        elif kind == 2:
            least = 1
    hops[q] = least
    return most - least - 1


@compiled_inner
def _blocks(ground: Ground, board: Board, q: int, p: int) -> int:
    """Blocks of two by two lanes on one of two squares, at least."""
    cells, stride, most = board.cells, ground.stride, 0
    for square in (q, p):
        count = 0
        for corner in (square, square - 1, square - stride, square - stride - 1):
            count += (
                cells[corner] == 1
                and cells[corner + 1] == 1
                and cells[corner + stride] == 1
                and cells[corner + stride + 1] == 1
            )
        most = max(most, count)
    return most
