"""Pieces: what hangs together by its neighbours."""

import numpy as np
from numpy.typing import NDArray

__all__ = ["joined", "pieces_of"]

Whole = NDArray[np.int64]


def joined(count: int, first: Whole, second: Whole) -> Whole:
    """The lowest number that each of 0 to `count` - 1 is joined to, itself where to none lower.

    Parameters
    ----------
    count
        How many there are.
    first, second
        The two of each pair that is joined; int64, shape (pairs,).

    Notes
    -----
    Shiloach and Vishkin, Journal of Algorithms 3 (1982): trees hang themselves on lower ones beside them and are
    flattened, until none has a lower one beside it.
    """
    lowest = np.arange(count)
    while len(first):
        np.minimum.at(lowest, np.maximum(first, second), np.minimum(first, second))
        while not np.array_equal(lowest, flat := lowest[lowest]):
            lowest = flat
        first, second = lowest[first], lowest[second]
        apart = first != second
        first, second = first[apart], second[apart]
    return lowest


def pieces_of(mask: NDArray[np.bool_]) -> tuple[Whole, int]:
    """The number of each square's 4-connected piece, from 1 in reading order, and how many there are.

    Parameters
    ----------
    mask
        bool, shape (rows, cols): the squares that are set.

    Returns
    -------
    tuple
        int64, shape (rows, cols), 0 on squares that are not set; and the greatest number.
    """
    starts = mask.copy()
    starts[:, 1:] &= ~mask[:, :-1]
    run: Whole = np.where(mask, starts.cumsum().reshape(mask.shape), 0)
    # runs along two rows meet first where one of them starts
    meets = mask[:-1] & mask[1:] & (starts[:-1] | starts[1:])
    lowest = joined(int(run.max(initial=0)) + 1, run[:-1][meets], run[1:][meets])
    number = np.unique(lowest, return_inverse=True)[1]
    return number[run], int(number.max())
