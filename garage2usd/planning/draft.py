"""A draft of lanes under annealing: labels, and one move that is judged before it is made. In C, `draft.c`."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.planning.ground import Ground

__all__ = ["Draft", "new_draft"]

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
