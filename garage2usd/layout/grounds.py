"""Vectorized conversion of floor outlines to shapely polygons and convex hulls."""

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

__all__ = ["Grounds", "grounds_of", "grounds_of_corners", "hulls_around", "hulls_of"]

Grounds = NDArray[np.object_]
"""Polygons (x, z) in metres; shape (n,)."""


def grounds_of(outlines: Sequence[ArrayLike] | NDArray[np.float64]) -> Grounds:
    """Convert outlines, each of shape (corners, 2) with at least three corners, to polygons."""
    if not len(outlines):
        return np.empty(0, dtype=object)
    corners = [np.asarray(outline, dtype=np.float64) for outline in outlines]
    owner = np.repeat(np.arange(len(corners)), [len(outline) for outline in corners])
    return grounds_of_corners(np.concatenate(corners), owner)


def grounds_of_corners(corners: NDArray[np.float64], owner: NDArray[np.int64]) -> Grounds:
    """Convert corners, shape (n, 2), to polygons.

    `owner` is the index of each corner's polygon: ascending from 0, without gaps, shape (n,).
    """
    if not len(corners):
        return np.empty(0, dtype=object)
    grounds: Grounds = shapely.polygons(shapely.linearrings(corners, indices=owner))
    return grounds


def hulls_of(outlines: Sequence[ArrayLike]) -> Grounds:
    """Compute the convex hulls of point sets, each of shape (points, 2) with at least one point.

    Hulls are polygons, lines or points.
    """
    if not len(outlines):
        return np.empty(0, dtype=object)
    points = [np.asarray(outline, dtype=np.float64) for outline in outlines]
    return hulls_around(np.concatenate(points), np.array([len(own) for own in points]))


def hulls_around(points: NDArray[np.float64], counts: NDArray[np.int64]) -> Grounds:
    """Compute the convex hulls of concatenated point sets, shape (n, 2).

    `counts` is the number of points of each set, at least 1, shape (hulls,).
    """
    if not len(counts):
        return np.empty(0, dtype=object)
    # lines, with at least two points each, are several times as fast as multipoints
    starts = np.cumsum(counts) - counts
    line = np.repeat(np.arange(len(counts)), counts + 1)
    hulls: Grounds = shapely.convex_hull(
        shapely.linestrings(np.insert(points, starts, points[starts], axis=0), indices=line)
    )
    return hulls
