"""Outlines of many pieces seen from above, with their least and greatest heights, in columns."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Outlines(NamedTuple):
    """Outlines of pieces in columns.

    Attributes
    ----------
    corners
        Corners of all outlines in order; float64, shape (n, 2).
    counts
        Number of corners of each piece; int64, shape (pieces,).
    low_m, high_m
        Least and greatest height; float64, shape (pieces,).
    """

    corners: Array
    counts: NDArray[np.int64]
    low_m: Array
    high_m: Array


def outlines_of(pieces: Sequence[tuple[Array, float, float]]) -> Outlines:
    """Convert pieces, each with outline, least and greatest height, to columns."""
    return Outlines(
        np.concatenate([outline for outline, _, _ in pieces]) if pieces else np.zeros((0, 2)),
        np.array([len(outline) for outline, _, _ in pieces], dtype=np.int64),
        np.array([low for _, low, _ in pieces], dtype=np.float64),
        np.array([high for _, _, high in pieces], dtype=np.float64),
    )
