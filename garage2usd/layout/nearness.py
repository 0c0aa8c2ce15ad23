"""Spatial index of points on the floor: range and nearest-neighbour queries."""

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

__all__ = ["Points", "distances_m"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

_ROUNDING_M = 1e-6
"""Margin of the candidate query around a place; pairs beyond the reach are removed afterwards."""


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
