"""A draft of lanes under annealing: labels, and one move that is judged before it is made. In C, `trial_move.c`."""

from typing import NamedTuple

import numpy as np

from garage2usd.native import Int8s, Int32s, Int64s
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

    label: Int8s
    stamp: Int64s
    marks: Int64s
    moved: Int64s
    around: Int64s
    queue: Int64s
    faulty: Int64s
    fresh: Int8s
    old: Int8s
    old_hops: Int32s
    cells: Int8s
    hops: Int32s
    lines: Int64s
    size: Int64s
    lengths: Int64s
    tally: Int64s
    change: Int64s


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
