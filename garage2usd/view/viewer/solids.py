"""The simple shapes of UsdGeom as triangles."""

import math

import numpy as np
from numpy.typing import NDArray
from pxr import Usd, UsdGeom

__all__ = ["solid_faces"]

_SIDES = 24
_CAP_RINGS = 6
_Corners = tuple[NDArray[np.float32], NDArray[np.float32]]


def solid_faces(prim: Usd.Prim, time: Usd.TimeCode) -> _Corners | None:
    """Positions and normals of the corners of a shape's triangles.

    Parameters
    ----------
    prim
        A Cube, Sphere, Cylinder, Cone, Capsule or Plane.
    time
        When.

    Returns
    -------
    tuple or None
        Both float32, shape (3 x triangles, 3), in metres of the stage; None for any other type of prim.
    """
    kind = prim.GetTypeName()
    if kind == "Cube":
        return _cube(float(UsdGeom.Cube(prim).GetSizeAttr().Get(time)) / 2)
    if kind == "Plane":
        plane = UsdGeom.Plane(prim)
        return _plane(plane.GetWidthAttr().Get(time) / 2, plane.GetLengthAttr().Get(time) / 2, _axis(plane, time))
    if kind == "Sphere":
        return _revolved(_arc(float(UsdGeom.Sphere(prim).GetRadiusAttr().Get(time)), 0, math.pi), 2)
    if kind == "Cylinder":
        cylinder = UsdGeom.Cylinder(prim)
        radius, half = cylinder.GetRadiusAttr().Get(time), cylinder.GetHeightAttr().Get(time) / 2
        flat = [(0.0, half, 0.0, 1.0), (radius, half, 0.0, 1.0), (radius, half, 1.0, 0.0)]
        return _revolved(flat + [(r, -y, nr, -ny) for r, y, nr, ny in reversed(flat)], _axis(cylinder, time))
    if kind == "Cone":
        cone = UsdGeom.Cone(prim)
        radius, height = cone.GetRadiusAttr().Get(time), cone.GetHeightAttr().Get(time)
        slope = math.hypot(radius, height) or 1.0
        side, up = height / slope, radius / slope
        bottom = [(radius, -height / 2, 0.0, -1.0), (0.0, -height / 2, 0.0, -1.0)]
        return _revolved([(0.0, height / 2, side, up), (radius, -height / 2, side, up), *bottom], _axis(cone, time))
    if kind == "Capsule":
        capsule = UsdGeom.Capsule(prim)
        radius, half = float(capsule.GetRadiusAttr().Get(time)), capsule.GetHeightAttr().Get(time) / 2
        top = [(r, y + half, nr, ny) for r, y, nr, ny in _arc(radius, 0, math.pi / 2)]
        return _revolved(top + [(r, -y, nr, -ny) for r, y, nr, ny in reversed(top)], _axis(capsule, time))
    return None


def _axis(shape: UsdGeom.Gprim, time: Usd.TimeCode) -> int:
    return "XYZ".index(shape.GetAxisAttr().Get(time))


def _cube(half: float) -> _Corners:
    positions, normals = [], []
    for axis in range(3):
        for sign in (-1.0, 1.0):
            normal = np.zeros(3)
            normal[axis] = sign
            across, along = np.roll(np.eye(3), 1, axis=0)[axis], np.roll(np.eye(3), 2, axis=0)[axis]
            across, along = (across, along) if np.dot(np.cross(across, along), normal) > 0 else (along, across)
            square = [normal + a * across + b * along for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            positions += [square[corner] for corner in (0, 1, 2, 0, 2, 3)]
            normals += [normal] * 6
    return (np.array(positions) * half).astype(np.float32), np.array(normals, dtype=np.float32)


def _plane(half_width: float, half_length: float, axis: int) -> _Corners:
    # width runs along x, or y for the axis x; length along y, or z for the axes x and y
    spans = {0: (2, 1), 1: (0, 2), 2: (0, 1)}[axis]
    normal = np.eye(3)[axis]
    across, along = np.eye(3)[spans[0]] * half_width, np.eye(3)[spans[1]] * half_length
    if np.dot(np.cross(across, along), normal) < 0:
        across, along = along, across
    square = [a * across + b * along for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    positions = np.array([square[corner] for corner in (0, 1, 2, 0, 2, 3)], dtype=np.float32)
    return positions, np.tile(normal, (6, 1)).astype(np.float32)


def _arc(radius: float, start: float, end: float) -> list[tuple[float, float, float, float]]:
    rings = round(_CAP_RINGS * (end - start) / (math.pi / 2))
    angles = np.linspace(start, end, rings + 1).tolist()
    return [(radius * math.sin(a), radius * math.cos(a), math.sin(a), math.cos(a)) for a in angles]


def _revolved(profile: list[tuple[float, float, float, float]], axis: int) -> _Corners:
    """A profile of (radius, height, normal outwards, normal upwards), from the top down, turned about an axis."""
    radius, height, outwards, upwards = np.array(profile).T
    angles = np.arange(_SIDES + 1) * math.tau / _SIDES
    cos, sin = np.cos(angles)[:, None], np.sin(angles)[:, None]
    # turned about Z here: x, y across, z along
    places = np.stack([cos * radius, sin * radius, np.broadcast_to(height, (_SIDES + 1, len(height)))], axis=2)
    normals = np.stack([cos * outwards, sin * outwards, np.broadcast_to(upwards, (_SIDES + 1, len(height)))], axis=2)
    places, normals = (np.roll(values, axis - 2, axis=2) for values in (places, normals))

    def faces(values: NDArray[np.float64]) -> NDArray[np.float32]:
        here, right, below, across = values[:-1, :-1], values[1:, :-1], values[:-1, 1:], values[1:, 1:]
        corners = np.stack([here, below, across, here, across, right], axis=2)
        return corners.reshape(-1, 3).astype(np.float32)

    positions, directions = faces(places), faces(normals)
    corners = positions.reshape(-1, 3, 3)
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    kept = np.repeat(areas > 0, 3)
    return positions[kept], directions[kept]
