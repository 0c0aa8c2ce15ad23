"""What is not convex seen from above, in convex parts."""

import numpy as np
import shapely
from numpy.typing import NDArray

__all__ = ["convex_outlines"]

_SAME = 1e-6
"""Share of a convex outline's area that may be missing."""


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
