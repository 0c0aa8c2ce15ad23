"""Ground under objects: outlines as shapely polygons and convex hulls, and the points nearest to a place."""

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

Grounds = NDArray[np.object_]
"""Polygons (x, z) in metres; shape (n,)."""
Array = NDArray[np.float64]
Indices = NDArray[np.int64]
_ROUNDING_M = 1e-6
"""Margin of the candidate query around a place; pairs beyond the reach are removed afterwards."""


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


class Points:
    """Points (x, z) in an STR-tree, for queries by distance."""

    def __init__(self, at_m: ArrayLike) -> None:
        """Index points (x, z) in metres, shape (n, 2)."""
        self.at_m = np.asarray(at_m, dtype=np.float64).reshape(-1, 2)
        self._tree = shapely.STRtree(shapely.points(self.at_m))

    def within(self, reach_m: float, places_m: Array, *, norm: int = 2) -> tuple[Indices, Indices, Array]:
        """Find all pairs of places and points within reach.

        Parameters
        ----------
        reach_m
            Greatest distance, metres.
        places_m
            (x, z) of each place; float64, shape (m, 2).
        norm
            Minkowski norm, see `distances_m`.

        Returns
        -------
        tuple
            Index of the place (ascending), index of the point, and distance in metres; each of shape (pairs,).
        """
        wide_m = reach_m + _ROUNDING_M
        place, point = self._tree.query(shapely.box(*(places_m - wide_m).T, *(places_m + wide_m).T))
        far_m = distances_m(places_m[place], self.at_m[point], norm=norm)
        near = far_m <= reach_m
        return place[near], point[near], far_m[near]

    def nearest_m(self, places_m: Array) -> Array:
        """Return the distance of each place to the nearest point, shapes (m, 2) to (m,); needs at least one point."""
        _, point = self._tree.query_nearest(shapely.points(places_m), all_matches=False)
        return distances_m(places_m, self.at_m[point])


def distances_m(first_m: Array, second_m: Array, *, norm: int = 2) -> Array:
    """Compute the distances between points (x, z); shapes (..., 2) to (...).

    Parameters
    ----------
    norm
        Minkowski norm: 1 for the Manhattan distance, 2 for the Euclidean distance.
    """
    offsets = np.abs(first_m - second_m)
    distances: Array = offsets.sum(axis=-1) if norm == 1 else np.sqrt((offsets**2).sum(axis=-1))
    return distances
