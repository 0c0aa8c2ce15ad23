"""Outlines as polygons, made all at once: one by one they take most of the time of what asks for them."""

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

__all__ = ["Grounds", "grounds_of"]

Grounds = NDArray[np.object_]
"""Polygons (x, z) in metres; shape (n,)."""


def grounds_of(outlines: Sequence[ArrayLike] | NDArray[np.float64]) -> Grounds:
    """The polygons of outlines, each of shape (corners, 2) with at least three corners."""
    if not len(outlines):
        return np.empty(0, dtype=object)
    corners = [np.asarray(outline, dtype=np.float64) for outline in outlines]
    owner = np.repeat(np.arange(len(corners)), [len(outline) for outline in corners])
    grounds: Grounds = shapely.polygons(shapely.linearrings(np.concatenate(corners), indices=owner))
    return grounds
