"""What is near what on the ground."""

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

__all__ = ["Points", "distances_m"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

_ROUNDING_M = 1e-6
"""How much wider than its reach a place is looked around at; what is too far by that is left out afterwards."""


class Points:
    """Points (x, z) that are found by place."""

    def __init__(self, at_m: ArrayLike) -> None:
        """Of shape (n, 2)."""
        self.at_m = np.asarray(at_m, dtype=np.float64).reshape(-1, 2)
        self._tree = shapely.STRtree(shapely.points(self.at_m))

    def within(self, reach_m: float, places_m: Array, *, norm: int = 2) -> tuple[Indices, Indices, Array]:
        """The points within reach of places.

        Parameters
        ----------
        reach_m
            How far they are at most.
        places_m
            (x, z) of each place; float64, shape (m, 2).
        norm
            As for `distances_m`.

        Returns
        -------
        tuple
            For each pair the number of the place, in ascending order, that of the point, and their distance; shape
            (pairs,).
        """
        wide_m = reach_m + _ROUNDING_M
        place, point = self._tree.query(shapely.box(*(places_m - wide_m).T, *(places_m + wide_m).T))
        far_m = distances_m(places_m[place], self.at_m[point], norm=norm)
        near = far_m <= reach_m
        return place[near], point[near], far_m[near]

    def nearest_m(self, places_m: Array) -> Array:
        """How far the nearest point is from each place, shapes (m, 2) to (m,); there is at least one point."""
        _, point = self._tree.query_nearest(shapely.points(places_m), all_matches=False)
        return distances_m(places_m, self.at_m[point])


def distances_m(first_m: Array, second_m: Array, *, norm: int = 2) -> Array:
    """Distances between points (x, z); shapes (..., 2) to (...).

    Parameters
    ----------
    norm
        The Minkowski norm: 1 for the distance along X and then along Z, 2 for the straight one.
    """
    apart = np.abs(first_m - second_m)
    distances: Array = apart.sum(axis=-1) if norm == 1 else np.sqrt((apart**2).sum(axis=-1))
    return distances
