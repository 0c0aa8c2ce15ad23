"""A draft of lanes under annealing: labels, and one move that is judged before it is made. Compiled."""
# ruff: noqa: PLR2004 - an entrance among the cells

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.compiled import Whole, compiled_inlined, compiled_inner
from garage2usd.planning.board import FAR, Board
from garage2usd.planning.ground import Ground

__all__ = ["Draft", "add_square", "apply", "gather", "new_draft", "revert"]

_MOVED = 400
"""Room for the squares of one move; what needs more is not a move."""


class Draft(NamedTuple):
    """Labels of the lanes on a board, and room to judge moves.

    Attributes
    ----------
    label
        int8, by square: 0 no lane, 1 a lane that cars drive on through, d + 1 a lane d squares deep in a dead end.
    stamp
        int64, shape (3, padded): marks of squares met, of blocks met, and of searches.
    marks
        int64, shape (3,): the marks last used.
    moved, around, queue
        int64: squares of a move, squares that it may touch, room for searches.
    faulty
        int64: the squares around which rules were broken at the last measurement.
    fresh, old
        int8: labels after and before the move.
    old_hops
        int32: hops of the moved squares before it.
    cells, hops
        int8 and int32, by square: cells before the dead ends are trimmed, and hops of the lanes before a move.
    lines
        int64, shape (K, 2): axis and number of the lines that get another side by a move.
    size
        int64, shape (4,): how many squares are moved, how many are around, how many lines get another side, and how
        many squares are faulty.
    lengths
        int64, shape (2,): squares of a path on either side of where it is met.
    tally
        int64, shape (6,): stalls, time, unused squares, faults of labels, blocks, squares too long.
    change
        int64, shape (6,): what a move adds to them.
    """

    label: NDArray[np.int8]
    stamp: NDArray[np.int64]
    marks: NDArray[np.int64]
    moved: NDArray[np.int64]
    around: NDArray[np.int64]
    queue: NDArray[np.int64]
    faulty: NDArray[np.int64]
    fresh: NDArray[np.int8]
    old: NDArray[np.int8]
    old_hops: NDArray[np.int32]
    cells: NDArray[np.int8]
    hops: NDArray[np.int32]
    lines: NDArray[np.int64]
    size: NDArray[np.int64]
    lengths: NDArray[np.int64]
    tally: NDArray[np.int64]
    change: NDArray[np.int64]


def new_draft(ground: Ground) -> Draft:
    """Room for labels on a ground."""
    size = len(ground.cells)
    return Draft(
        np.zeros(size, np.int8),
        np.zeros((3, size), np.int64),
        np.zeros(3, np.int64),
        np.zeros(_MOVED, np.int64),
        np.zeros(5 * _MOVED, np.int64),
        np.zeros(size, np.int64),
        np.zeros(size, np.int64),
        np.zeros(_MOVED, np.int8),
        np.zeros(_MOVED, np.int8),
        np.zeros(_MOVED, np.int32),
        np.zeros(size, np.int8),
        np.zeros(size, np.int32),
        np.zeros((10 * _MOVED, 2), np.int64),
        np.zeros(4, np.int64),
        np.zeros(2, np.int64),
        np.zeros(6, np.int64),
        np.zeros(6, np.int64),
    )


@compiled_inner
def add_square(draft: Draft, q: int, label: Whole) -> bool:
    """Have a square in the move; False if there is no room for it."""
    if draft.size[0] >= _MOVED:
        return False
    draft.moved[draft.size[0]] = q
    draft.fresh[draft.size[0]] = label
    draft.size[0] += 1
    return True


@compiled_inlined
def gather(draft: Draft, stride: int) -> None:
    """Find the squares that a move may touch."""
    draft.marks[0] += 1
    mark, stamp, size = draft.marks[0], draft.stamp, 0
    for index in range(draft.size[0]):
        q = draft.moved[index]
        for step in (0, -stride, stride, -1, 1):
            if stamp[0, q + step] != mark:
                stamp[0, q + step] = mark
                draft.around[size] = q + step
                size += 1
    draft.size[1] = size


@compiled_inlined
def apply(ground: Ground, board: Board, draft: Draft) -> None:
    """Make the move; new lanes get their hops from what is around."""
    cells, hops, label, stride = board.cells, board.hops, draft.label, ground.stride
    for index in range(draft.size[0]):
        q = draft.moved[index]
        draft.old[index], draft.old_hops[index] = label[q], hops[q]
        label[q] = draft.fresh[index]
        was_lane = cells[q] == 1
        cells[q] = 1 if draft.fresh[index] > 0 else 0
        if not was_lane or cells[q] == 0:
            hops[q] = FAR
    for turn in range(2):
        for place in range(draft.size[0]):
            index = place if turn == 0 else draft.size[0] - 1 - place
            q = draft.moved[index]
            if cells[q] == 1 and draft.old[index] == 0:
                for step in (-stride, stride, -1, 1):
                    p = q + step
                    if cells[p] == 1:
                        hops[q] = min(hops[q], hops[p] + 1)
                    elif cells[p] == 2:
                        hops[q] = 1


@compiled_inlined
def revert(board: Board, draft: Draft) -> None:
    """Take the move back."""
    for index in range(draft.size[0] - 1, -1, -1):
        q = draft.moved[index]
        draft.label[q], board.hops[q] = draft.old[index], draft.old_hops[index]
        board.cells[q] = 1 if draft.old[index] > 0 else 0
