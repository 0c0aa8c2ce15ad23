"""Outlines of many pieces seen from above, with their heights, in columns, and their convex parts."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

Array = NDArray[np.float64]
_TRIANGLE = 3
_FLAT = 1e-6
"""Tolerance for reflex corners, as a share of the squared normal (twice the area): rounding of positions."""
_SAME = 1e-6
"""Greatest missing share of a convex outline's area."""


class Outlines(NamedTuple):
    """Outlines of pieces in columns.

    Attributes
    ----------
    corners
        Corners of all outlines in order; float64, shape (n, 2).
    counts
        Number of corners of each piece; int64, shape (pieces,).
    low_m, high_m
        Least and greatest height; float64, shape (pieces,).
    """

    corners: Array
    counts: NDArray[np.int64]
    low_m: Array
    high_m: Array


def outlines_of(pieces: Sequence[tuple[Array, float, float]]) -> Outlines:
    """Convert pieces, each with outline, least and greatest height, to columns."""
    return Outlines(
        np.concatenate([outline for outline, _, _ in pieces]) if pieces else np.zeros((0, 2)),
        np.array([len(outline) for outline, _, _ in pieces], dtype=np.int64),
        np.array([low for _, low, _ in pieces], dtype=np.float64),
        np.array([high for _, _, high in pieces], dtype=np.float64),
    )


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
