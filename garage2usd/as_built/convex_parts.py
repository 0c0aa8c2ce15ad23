"""Convex decomposition of non-convex outlines."""

import numpy as np
import shapely
from numpy.typing import NDArray

_TRIANGLE = 3
_FLAT = 1e-6
"""Tolerance for reflex corners, as a share of the squared normal (twice the area): rounding of positions."""
_SAME = 1e-6
"""Greatest missing share of a convex outline's area."""


def are_dented(
    begin: NDArray[np.float64], end: NDArray[np.float64], after: NDArray[np.int64], counts: NDArray[np.int64]
) -> bool:
    """Return True if any of several polygons is non-convex: a corner turns against the polygon's normal.

    Parameters
    ----------
    begin, end
        Ends of the polygons' sides in order; shape (sides, 3).
    after
        Index of the side after each.
    counts
        Number of sides of each polygon.
    """
    if not (counts > _TRIANGLE).any():
        return False
    sides, starts = end - begin, np.cumsum(counts) - counts
    normals = np.repeat(np.add.reduceat(np.cross(begin, end), starts), counts, axis=0)
    turns = (np.cross(sides, sides[after]) * normals).sum(axis=1)
    return bool((turns < -_FLAT * (normals**2).sum(axis=1)).any())


def convex_outlines(triangles: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    """Decompose the area covered by triangles into convex outlines.

    Parameters
    ----------
    triangles
        Triangles on the ground; shape (n, 3, 2).

    Returns
    -------
    list
        Corners of each outline, shape (k, 2): a single one if the area is convex or empty, else triangles by GEOS.
    """
    sheets = shapely.polygons(triangles)
    ground = shapely.union_all(sheets[shapely.area(sheets) > 0])
    hull = shapely.convex_hull(shapely.multipoints(triangles.reshape(-1, 2)))
    if ground.area <= 0 or ground.area >= (1 - _SAME) * hull.area:
        return [shapely.get_coordinates(hull)]
    parts = shapely.get_parts(shapely.constrained_delaunay_triangles(ground))
    return [shapely.get_coordinates(part)[:-1] for part in parts]
