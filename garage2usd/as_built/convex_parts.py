"""Convex parts of outlines that are not convex."""

import numpy as np
import shapely
from numpy.typing import NDArray

__all__ = ["are_dented", "convex_outlines"]

_TRIANGLE = 3
_FLAT = 1e-6
"""Share of the square of a normal, which is twice the area, by which sides may turn back: rounding of their places."""
_SAME = 1e-6
"""Share of a convex outline's area that may be missing."""


def are_dented(
    begin: NDArray[np.float64], end: NDArray[np.float64], after: NDArray[np.int64], counts: NDArray[np.int64]
) -> bool:
    """Whether one of several polygons somewhere turns against its normal.

    Parameters
    ----------
    begin, end
        The ends of their sides, one polygon after the other; shape (sides, 3).
    after
        The side after each.
    counts
        How many sides each polygon has.
    """
    if not (counts > _TRIANGLE).any():
        return False
    sides, starts = end - begin, np.cumsum(counts) - counts
    normals = np.repeat(np.add.reduceat(np.cross(begin, end), starts), counts, axis=0)
    turns = (np.cross(sides, sides[after]) * normals).sum(axis=1)
    return bool((turns < -_FLAT * (normals**2).sum(axis=1)).any())


def convex_outlines(triangles: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    """Corners of convex outlines that together are what triangles cover.

    Parameters
    ----------
    triangles
        On the ground; shape (n, 3, 2).

    Returns
    -------
    list
        Shape (k, 2) each; one where all is convex or has no area, else triangles by GEOS.
    """
    sheets = shapely.polygons(triangles)
    ground = shapely.union_all(sheets[shapely.area(sheets) > 0])
    hull = shapely.convex_hull(shapely.multipoints(triangles.reshape(-1, 2)))
    if ground.area <= 0 or ground.area >= (1 - _SAME) * hull.area:
        return [shapely.get_coordinates(hull)]
    parts = shapely.get_parts(shapely.constrained_delaunay_triangles(ground))
    return [shapely.get_coordinates(part)[:-1] for part in parts]
