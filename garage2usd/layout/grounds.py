"""Outlines as polygons, made all at once: one by one they take most of the time of what asks for them."""

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

__all__ = ["Grounds", "grounds_of", "grounds_of_corners", "hulls_around", "hulls_of"]

Grounds = NDArray[np.object_]
"""Polygons (x, z) in metres; shape (n,)."""


def grounds_of(outlines: Sequence[ArrayLike] | NDArray[np.float64]) -> Grounds:
    """The polygons of outlines, each of shape (corners, 2) with at least three corners."""
    if not len(outlines):
        return np.empty(0, dtype=object)
    corners = [np.asarray(outline, dtype=np.float64) for outline in outlines]
    owner = np.repeat(np.arange(len(corners)), [len(outline) for outline in corners])
    return grounds_of_corners(np.concatenate(corners), owner)


def grounds_of_corners(corners: NDArray[np.float64], owner: NDArray[np.int64]) -> Grounds:
    """The polygons of corners, shape (n, 2), each of the polygon with a number, which ascend from 0 on without gaps."""
    if not len(corners):
        return np.empty(0, dtype=object)
    grounds: Grounds = shapely.polygons(shapely.linearrings(corners, indices=owner))
    return grounds


def hulls_of(outlines: Sequence[ArrayLike]) -> Grounds:
    """The convex hulls of some points each, of shape (points, 2) with at least one point: polygons, lines or points."""
    if not len(outlines):
        return np.empty(0, dtype=object)
    points = [np.asarray(outline, dtype=np.float64) for outline in outlines]
    return hulls_around(np.concatenate(points), np.array([len(own) for own in points]))


def hulls_around(points: NDArray[np.float64], counts: NDArray[np.int64]) -> Grounds:
    """The same for points one after the other, shape (n, 2); `counts` says how many, one or more, each hull holds."""
    if not len(counts):
        return np.empty(0, dtype=object)
    # as lines, which have at least two: several times as fast as to make each point a shape of its own
    starts = np.cumsum(counts) - counts
    line = np.repeat(np.arange(len(counts)), counts + 1)
    hulls: Grounds = shapely.convex_hull(
        shapely.linestrings(np.insert(points, starts, points[starts], axis=0), indices=line)
    )
    return hulls
