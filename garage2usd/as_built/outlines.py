"""Outlines seen from above with two heights, of many pieces at once."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Outlines", "outlines_of"]

Array = NDArray[np.float64]


class Outlines(NamedTuple):
    """Pieces in columns.

    Attributes
    ----------
    corners
        Of the outlines of all pieces, one after the other; float64, shape (n, 2).
    counts
        How many corners each piece has; int64, shape (pieces,).
    low_m, high_m
        Its least and greatest height; float64, shape (pieces,).
    """

    corners: Array
    counts: NDArray[np.int64]
    low_m: Array
    high_m: Array


def outlines_of(pieces: Sequence[tuple[Array, float, float]]) -> Outlines:
    """Pieces in columns, each given by its outline and its least and greatest height."""
    return Outlines(
        np.concatenate([outline for outline, _, _ in pieces]) if pieces else np.zeros((0, 2)),
        np.array([len(outline) for outline, _, _ in pieces], dtype=np.int64),
        np.array([low for _, low, _ in pieces], dtype=np.float64),
        np.array([high for _, _, high in pieces], dtype=np.float64),
    )
