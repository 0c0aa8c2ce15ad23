"""Meshes as plain arrays: parts with one material each, made of faces in metres, Y up."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import ArrayLike, NDArray

from garage2usd.assets.materials import MATERIALS

__all__ = ["Asset", "Collider", "Face", "Part", "RectLight", "box_faces", "lathe_faces", "make_part", "moved"]

Face = NDArray[np.float64]
"""float64, shape (corners, 3): a planar polygon, counter-clockwise seen from outside."""

_WELD_DECIMALS = 5
_MIN_CORNERS = 3


class Collider(StrEnum):
    """How physics approximates a mesh: the tokens of ``physics:approximation``."""

    MESH = "none"
    BOX = "boundingCube"
    CONVEX_HULL = "convexHull"


@dataclass(frozen=True, eq=False)
class Part:
    """One mesh with one material.

    Attributes
    ----------
    name
        Prim name, PascalCase, unique in its asset.
    points
        float32, shape (P, 3), metres, welded.
    face_counts, face_indices
        int32, shapes (F,) and (I,): corners of each face and their points, counter-clockwise from outside.
    normals
        float32, shape (I, 3), a unit normal for each corner.
    st, st_indices
        float32, shape (T, 2), and int32, shape (I,): texture coordinates in repeats of the texture.
    material
        Key of `garage2usd.assets.materials.MATERIALS`.
    collider
        Approximation for physics; None for what nothing can touch.
    """

    name: str
    points: NDArray[np.float32]
    face_counts: NDArray[np.int32]
    face_indices: NDArray[np.int32]
    normals: NDArray[np.float32]
    st: NDArray[np.float32]
    st_indices: NDArray[np.int32]
    material: str
    collider: Collider | None = None


@dataclass(frozen=True)
class RectLight:
    """A light that shines down from a rectangle.

    Attributes
    ----------
    width_m, depth_m
        Extent along X and Z.
    height_m
        Height of the rectangle in the asset.
    intensity_nit
        UsdLux intensity.
    """

    width_m: float
    depth_m: float
    height_m: float
    intensity_nit: float


@dataclass(frozen=True, eq=False)
class Asset:
    """What one prototype consists of.

    Attributes
    ----------
    label
        Semantic class.
    parts
        Its meshes.
    light
        Its light, if it gives any.
    """

    label: str
    parts: tuple[Part, ...]
    light: RectLight | None = None


def make_part(
    name: str,
    faces: Sequence[Face],
    material: str,
    *,
    collider: Collider | None = None,
    crease_deg: float = 30.0,
    project: Callable[[Face, NDArray[np.float64]], NDArray[np.float64]] | None = None,
) -> Part:
    """Weld faces into a part, with normals that are smooth where faces meet at less than `crease_deg`.

    Parameters
    ----------
    name, material, collider
        Of the part.
    faces
        Planar polygons; corners that coincide are welded, faces without area dropped.
    crease_deg
        Largest angle between the normals of two faces that share a smooth edge.
    project
        Texture coordinates in metres of a face's corners, given its normal; along the main axis if left out.
    """
    corners = np.round(np.concatenate(faces), _WELD_DECIMALS) + 0.0
    counts = np.array([len(face) for face in faces])
    points, indices = np.unique(corners, axis=0, return_inverse=True)
    kept, split = [], np.split(indices.ravel(), np.cumsum(counts)[:-1])
    for loop in split:
        clean = loop[loop != np.roll(loop, 1)]
        if len(clean) >= _MIN_CORNERS and np.linalg.norm(_area_vector(points[clean])) > 1e-9:  # noqa: PLR2004
            kept.append(clean)
    counts = np.array([len(loop) for loop in kept], dtype=np.int32)
    used, flat = np.unique(np.concatenate(kept), return_inverse=True)
    points = points[used]
    loops = np.split(flat.ravel(), np.cumsum(counts)[:-1])

    area = np.array([_area_vector(points[loop]) for loop in loops])
    unit = area / np.linalg.norm(area, axis=1, keepdims=True)
    normals = _corner_normals(loops, area, unit, crease_deg)
    along = project or _along_main_axis
    repeat_m = MATERIALS[material].repeat_m
    coordinates = [along(points[loop], normal) / repeat_m for loop, normal in zip(loops, unit, strict=True)]
    st, st_indices = np.unique(np.round(np.concatenate(coordinates), _WELD_DECIMALS) + 0.0, axis=0, return_inverse=True)
    return Part(
        name=name,
        points=points.astype(np.float32),
        face_counts=counts,
        face_indices=flat.ravel().astype(np.int32),
        normals=normals.astype(np.float32),
        st=st.astype(np.float32),
        st_indices=st_indices.ravel().astype(np.int32),
        material=material,
        collider=collider,
    )


def box_faces(low: ArrayLike, high: ArrayLike, *, without: str = "") -> list[Face]:
    """The faces of an axis-aligned box.

    Parameters
    ----------
    low, high
        Opposite corners (x, y, z).
    without
        Faces to leave out, of the letters ``l`` -X, ``r`` +X, ``b`` -Y, ``t`` +Y, ``n`` -Z, ``f`` +Z.
    """
    (x0, y0, z0), (x1, y1, z1) = np.asarray(low, dtype=float), np.asarray(high, dtype=float)
    faces = {
        "l": [(x0, y0, z0), (x0, y0, z1), (x0, y1, z1), (x0, y1, z0)],
        "r": [(x1, y0, z1), (x1, y0, z0), (x1, y1, z0), (x1, y1, z1)],
        "b": [(x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)],
        "t": [(x0, y1, z1), (x1, y1, z1), (x1, y1, z0), (x0, y1, z0)],
        "n": [(x1, y0, z0), (x0, y0, z0), (x0, y1, z0), (x1, y1, z0)],
        "f": [(x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)],
    }
    return [np.array(face) for side, face in faces.items() if side not in without]


def lathe_faces(profile: Sequence[tuple[float, float]], *, segments: int) -> list[Face]:
    """Turn a profile of (x, radius) about the X axis; from left to right its outside is away from the axis."""
    angles = np.arange(segments + 1) * (2 * np.pi / segments)
    angles[-1] = 0.0
    rings = [np.stack([np.full(segments + 1, x), r * np.cos(angles), r * np.sin(angles)], axis=1) for x, r in profile]
    return [
        np.array([first[i], second[i], second[i + 1], first[i + 1]])[::-1]
        for first, second in zip(rings, rings[1:], strict=False)
        for i in range(segments)
    ]


def moved(faces: Iterable[Face], offset: ArrayLike, *, mirror_x: bool = False) -> list[Face]:
    """Faces moved by (x, y, z); mirrored in X before, if asked, with their winding kept outwards."""
    step = np.asarray(offset, dtype=float)
    if mirror_x:
        return [(face * (-1.0, 1.0, 1.0))[::-1] + step for face in faces]
    return [face + step for face in faces]


def _area_vector(polygon: NDArray[np.float64]) -> NDArray[np.float64]:
    """Newell's normal, as long as twice the area."""
    relative = polygon - polygon[0]
    vector: NDArray[np.float64] = np.cross(relative, np.roll(relative, -1, axis=0)).sum(axis=0)
    return vector


def _corner_normals(
    loops: Sequence[NDArray[np.int64]], area: NDArray[np.float64], unit: NDArray[np.float64], crease_deg: float
) -> NDArray[np.float64]:
    """For each corner the mean of the faces around its point that meet its own at less than the crease."""
    flat = np.concatenate(loops)
    face_of = np.repeat(np.arange(len(loops)), [len(loop) for loop in loops])
    order = np.argsort(flat, kind="stable")
    bounds = np.flatnonzero(np.diff(flat[order])) + 1
    limit = np.cos(np.radians(crease_deg))
    normals = np.empty((len(flat), 3))
    for corners in np.split(order, bounds):
        faces = face_of[corners]
        near = unit[faces] @ unit[faces].T > limit
        normals[corners] = near @ area[faces]
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    return np.where(lengths > 0, normals / np.where(lengths > 0, lengths, 1.0), unit[face_of])


def _along_main_axis(face: NDArray[np.float64], normal: NDArray[np.float64]) -> NDArray[np.float64]:
    """Metres across the face, seen along the axis that its normal is nearest to; V up on upright faces."""
    x, y, z = face.T
    axis = int(np.argmax(np.abs(normal) - np.array([0.0, 1e-6, 2e-6])))
    if axis == 0:
        return np.stack([-z if normal[0] > 0 else z, y], axis=1)
    if axis == 1:
        return np.stack([x, -z if normal[1] > 0 else z], axis=1)
    return np.stack([x if normal[2] > 0 else -x, y], axis=1)
