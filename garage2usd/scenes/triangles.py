"""Polygons of a mesh, and simple shapes of UsdGeom, as triangles."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray
from pxr import Usd, UsdGeom

from garage2usd.scenes.values import READ_AT, number_of

_FLAT = 1e-9
"""Share of a polygon's area by which a triangle of its fan may be inverted: rounding of single precision."""
_SAME_AREA = 1e-6
_TRIANGLE = 3
_SIDES = 24
_CAP_RINGS = 6
_Ring = tuple[float, float, float, float]
_Corners = tuple[NDArray[np.float32], NDArray[np.float32]]


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


def solid_faces(prim: Usd.Prim) -> _Corners | None:
    """Return positions and normals of the corners of a shape's triangles.

    Parameters
    ----------
    prim
        A Cube, Sphere, Cylinder, Cone, Capsule or Plane.

    Returns
    -------
    tuple or None
        Both float32, shape (3 x triangles, 3), in the shape's own space; None for any other type of prim.
    """
    make = _MAKERS.get(prim.GetTypeName())
    return None if make is None else make(prim)


def _cube_of(prim: Usd.Prim) -> _Corners:
    return _cube(number_of(UsdGeom.Cube(prim).GetSizeAttr()) / 2)


def _plane_of(prim: Usd.Prim) -> _Corners:
    plane = UsdGeom.Plane(prim)
    return _plane(number_of(plane.GetWidthAttr()) / 2, number_of(plane.GetLengthAttr()) / 2, _axis(plane))


def _sphere_of(prim: Usd.Prim) -> _Corners:
    return _revolved(_arc(number_of(UsdGeom.Sphere(prim).GetRadiusAttr()), math.pi), 2)


def _cylinder_of(prim: Usd.Prim) -> _Corners:
    cylinder = UsdGeom.Cylinder(prim)
    radius, half = number_of(cylinder.GetRadiusAttr()), number_of(cylinder.GetHeightAttr()) / 2
    top = [(0.0, half, 0.0, 1.0), (radius, half, 0.0, 1.0), (radius, half, 1.0, 0.0)]
    return _revolved(top + _upside_down(top), _axis(cylinder))


def _cone_of(prim: Usd.Prim) -> _Corners:
    cone = UsdGeom.Cone(prim)
    radius, height = number_of(cone.GetRadiusAttr()), number_of(cone.GetHeightAttr())
    slope = math.hypot(radius, height) or 1.0
    side, up = height / slope, radius / slope
    bottom = [(radius, -height / 2, 0.0, -1.0), (0.0, -height / 2, 0.0, -1.0)]
    return _revolved([(0.0, height / 2, side, up), (radius, -height / 2, side, up), *bottom], _axis(cone))


def _capsule_of(prim: Usd.Prim) -> _Corners:
    capsule = UsdGeom.Capsule(prim)
    radius, half = number_of(capsule.GetRadiusAttr()), number_of(capsule.GetHeightAttr()) / 2
    top = [(r, y + half, nr, ny) for r, y, nr, ny in _arc(radius, math.pi / 2)]
    return _revolved(top + _upside_down(top), _axis(capsule))


_AXES = {"X": 0, "Y": 1, "Z": 2}

_MAKERS: dict[str, Callable[[Usd.Prim], _Corners]] = {
    "Cube": _cube_of,
    "Plane": _plane_of,
    "Sphere": _sphere_of,
    "Cylinder": _cylinder_of,
    "Cone": _cone_of,
    "Capsule": _capsule_of,
}


def _upside_down(profile: list[_Ring]) -> list[_Ring]:
    return [(radius, -y, outwards, -upwards) for radius, y, outwards, upwards in reversed(profile)]


def _axis(shape: UsdGeom.Gprim) -> int:
    return _AXES.get(str(shape.GetAxisAttr().Get(READ_AT)), 2)


def _cube(half: float) -> _Corners:
    axes = np.eye(3)
    sides = [
        _square(sign * half * axes[axis], sign * axes[axis], half * axes[axis - 1], half * axes[axis - 2])
        for axis in range(3)
        for sign in (-1.0, 1.0)
    ]
    positions, normals = (np.concatenate(values) for values in zip(*sides, strict=True))
    return positions, normals


def _plane(half_width: float, half_length: float, axis: int) -> _Corners:
    # width runs along x, or y for the axis x; length along y, or z for the axes x and y
    across, along = {0: (2, 1), 1: (0, 2), 2: (0, 1)}[axis]
    axes = np.eye(3)
    return _square(np.zeros(3), axes[axis], half_width * axes[across], half_length * axes[along])


def _square(
    middle: NDArray[np.float64], normal: NDArray[np.float64], across: NDArray[np.float64], along: NDArray[np.float64]
) -> _Corners:
    """Return the two triangles of a rectangle by its middle and the vectors from there to its sides."""
    if np.dot(np.cross(across, along), normal) < 0:
        across, along = along, across
    corners = [middle + a * across + b * along for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    positions = np.array([corners[corner] for corner in (0, 1, 2, 0, 2, 3)], dtype=np.float32)
    return positions, np.tile(normal, (6, 1)).astype(np.float32)


def _arc(radius: float, end: float) -> list[_Ring]:
    """Return the profile of a sphere from its top to an angle."""
    angles = np.linspace(0, end, round(_CAP_RINGS * end / (math.pi / 2)) + 1).tolist()
    return [(radius * math.sin(a), radius * math.cos(a), math.sin(a), math.cos(a)) for a in angles]


def _revolved(profile: list[_Ring], axis: int) -> _Corners:
    """Revolve a profile of (radius, height, normal outwards, normal upwards), from the top down, about an axis."""
    radius, height, outwards, upwards = np.array(profile).T
    angles = np.arange(_SIDES + 1) * math.tau / _SIDES
    cos, sin = np.cos(angles)[:, None], np.sin(angles)[:, None]
    # turned about Z here: x, y across, z along
    places = np.stack([cos * radius, sin * radius, np.broadcast_to(height, (_SIDES + 1, len(height)))], axis=2)
    normals = np.stack([cos * outwards, sin * outwards, np.broadcast_to(upwards, (_SIDES + 1, len(height)))], axis=2)
    places, normals = (np.roll(values, axis - 2, axis=2) for values in (places, normals))

    def faces(values: NDArray[np.float64]) -> NDArray[np.float32]:
        here, right, below, across = values[:-1, :-1], values[1:, :-1], values[:-1, 1:], values[1:, 1:]
        corners: NDArray[np.float32] = np.stack([here, below, across, here, across, right], axis=2).astype(np.float32)
        return corners.reshape(-1, 3)

    positions, directions = faces(places), faces(normals)
    corners = positions.reshape(-1, 3, 3)
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    kept = np.repeat(areas > 0, 3)
    return positions[kept], directions[kept]
