"""Triangulation of the polygons of a mesh."""

from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

__all__ = ["triangulated"]

_FLAT = 1e-9
"""Share of a polygon's area by which a triangle of its fan may be inverted: rounding of single precision."""
_SAME_AREA = 1e-6
_TRIANGLE = 3


def triangulated(
    points: NDArray[np.floating[Any]], corners: NDArray[np.int64], counts: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.int32]]:
    """Triangulate polygons, covering each of them once.

    Parameters
    ----------
    points
        Shape (points, 3).
    corners
        Number of the point at each corner of each polygon, one polygon after the other.
    counts
        Number of corners of each polygon.

    Returns
    -------
    tuple
        The corners of each triangle, shape (triangles, 3), as indices into `corners`, with the polygon's winding; and
        the number of each triangle's polygon, ascending.

    Notes
    -----
    A polygon becomes a fan around its first corner. If a triangle of the fan would be inverted, the polygon is
    projected to its plane, by Newell's method, and triangulated by GEOS. Polygons that intersect themselves, have no
    area or refer to missing points remain fans.
    """
    fans, polygon_of = _fans(counts)
    places, normals, dented = _measured(points, corners, counts)
    starts = np.cumsum(counts) - counts
    kept = np.ones(len(fans), dtype=bool)
    replaced: list[tuple[int, NDArray[np.int64]]] = []
    for polygon in dented.tolist():
        own = np.arange(starts[polygon], starts[polygon] + counts[polygon])
        is_sound = ((corners[own] >= 0) & (corners[own] < len(points))).all() and np.isfinite(places[own]).all()
        found = _cut(places[own], normals[polygon]) if is_sound else None
        if found is not None:
            kept[polygon_of == polygon] = False
            replaced.append((polygon, own[found]))
    if not replaced:
        return fans, polygon_of
    fans = np.concatenate([fans[kept], *(triangles for _, triangles in replaced)])
    numbers = [np.full(len(triangles), polygon, dtype=np.int32) for polygon, triangles in replaced]
    polygon_of = np.concatenate([polygon_of[kept], *numbers])
    order = np.argsort(polygon_of, kind="stable")
    return fans[order], polygon_of[order]


def _measured(
    points: NDArray[np.floating[Any]], corners: NDArray[np.int64], counts: NDArray[np.int64]
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.int64]]:
    """Return positions of the corners, Newell normals of the polygons, twice their areas, and the non-convex ones."""
    places = points[np.clip(corners, 0, len(points) - 1)].astype(np.float64)
    if not (counts > _TRIANGLE).any():
        return places, np.zeros((0, 3)), np.zeros(0, np.int64)
    fans, polygon_of = _fans(counts)
    with np.errstate(invalid="ignore", over="ignore"):
        origins = places[fans[:, 0]]
        areas = np.cross(places[fans[:, 1]] - origins, places[fans[:, 2]] - origins)
        normals = np.stack([np.bincount(polygon_of, part, len(counts)) for part in areas.T], axis=1, dtype=np.float64)
        along = (areas * normals[polygon_of]).sum(axis=1)
        dented = np.unique(polygon_of[along < -_FLAT * (normals**2).sum(axis=1)[polygon_of]])
    return places, normals, dented.astype(np.int64)


def _fans(counts: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int32]]:
    """Return the corners of the triangles of fans around each polygon's first corner, and each triangle's polygon."""
    triangles = np.maximum(counts - 2, 0)
    polygon_of = np.repeat(np.arange(len(counts)), triangles)
    first = (np.cumsum(counts) - counts)[polygon_of]
    step = np.arange(len(polygon_of)) - (np.cumsum(triangles) - triangles)[polygon_of]
    return np.stack([first, first + step + 1, first + step + 2], axis=1), polygon_of.astype(np.int32)


def _cut(places: NDArray[np.float64], normal: NDArray[np.float64]) -> NDArray[np.intp] | None:
    """Triangulate a polygon by GEOS; corner numbers of the triangles, or None if the polygon has no interior."""
    normal = normal / np.linalg.norm(normal)
    across = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
    across /= np.linalg.norm(across)
    flat = (places - places[0]) @ np.stack([across, np.cross(normal, across)]).T
    # where a hole is joined to the outline by a cut, two corners are at one place
    corner_of = {place: corner for corner, place in reversed([*enumerate(map(tuple, flat.tolist()))])}
    try:
        parts = shapely.get_parts(shapely.constrained_delaunay_triangles(shapely.Polygon(flat)))
    except shapely.errors.GEOSException:
        return None
    rings = shapely.get_coordinates(parts).reshape(-1, 4, 2)[:, :3]
    try:
        triangles = np.array([[corner_of[place] for place in map(tuple, ring)] for ring in rings.tolist()])
    except KeyError:
        return None
    if not len(triangles):
        return None
    (x0, y0), (x1, y1), (x2, y2) = (flat[triangles[:, corner]].T for corner in range(3))
    doubled = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
    triangles[doubled < 0] = triangles[doubled < 0][:, [0, 2, 1]]
    x, y = flat.T
    whole = float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum())
    return triangles if abs(np.abs(doubled).sum() - whole) <= _SAME_AREA * whole else None
