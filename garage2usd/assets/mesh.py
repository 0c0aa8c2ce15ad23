"""Meshes as arrays: parts with one material each, made of polygon faces in metres, Y up, and their poses."""
# Over 300 lines: the values of assets, and the making of parts from faces, which all objects share.

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets.light import USUAL_LAMP_RGB
from garage2usd.assets.materials import MATERIALS, Finish, Rgb
from garage2usd.native import elementary

_DIGITS = 12
"""Digits of sines, so that a quarter and half a turn are exact."""
Face = NDArray[np.float64]
"""float64, shape (corners, 3): a planar polygon, counter-clockwise seen from outside."""
WELD_DECIMALS = 5
"""Decimals of metres to which corners are rounded."""
MIN_AREA_M2 = 1e-9
"""Length of the area vector up to which a face is dropped."""
_MIN_CORNERS = 3
_NORMAL_STEPS = 10_000
"""Steps per unit to which normals are rounded; one step is 0.006 degrees."""


class Pose(NamedTuple):
    """A pose in an asset: position in metres, and rotation about +Y in degrees."""

    x_m: float
    y_m: float
    z_m: float
    yaw_deg: float = 0.0

    @property
    def turn(self) -> NDArray[np.float64]:
        """Rotation for row vectors; float64, shape (3, 3). The nose of a car faces -Z."""
        angle = np.radians(self.yaw_deg)
        cos, sin = round(elementary.cos(float(angle)), _DIGITS), round(elementary.sin(float(angle)), _DIGITS)
        return np.array([(cos, 0.0, -sin), (0.0, 1.0, 0.0), (sin, 0.0, cos)])

    @property
    def single(self) -> "Pose":
        """The pose in single precision, as stored in a layer."""
        return Pose(*np.array(self, np.float32).tolist())

    def placed(self, points: NDArray[np.floating[Any]]) -> NDArray[np.float64]:
        """Move points of the pose's axes to those of the asset; shapes (n, 3)."""
        return points.astype(np.float64) @ self.turn + self[:3]

    def taken_back(self, points: NDArray[np.floating[Any]]) -> NDArray[np.float64]:
        """Move points of the asset's axes to those of the pose; shapes (n, 3)."""
        return (points.astype(np.float64) - self[:3]) @ self.turn.T


class Collider(StrEnum):
    """Approximations of a mesh by physics engines: tokens of ``physics:approximation``."""

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
    normals, normal_indices
        float32, shape (N, 3), and int32, shape (I,): unit normals to four decimals, and the index of each corner's
        normal.
    st, st_indices
        float32, shape (T, 2), and int32, shape (I,): texture coordinates in repeats of the texture; both empty for a
        material without textures.
    material
        Key of `garage2usd.assets.materials.MATERIALS`.
    collider
        Approximation for physics; None for a part without collision.
    piece
        Semantic class of its piece; empty if it is that of the asset.
    pose
        Pose in which a layer places the mesh, with points relative to it, so that equal parts such as wheels share one
        array; None for a mesh in the axes of the asset. The points here are always in the axes of the asset.
    double_sided
        True if the back is visible where viewers hide backs.
    """

    name: str
    points: NDArray[np.float32]
    face_counts: NDArray[np.int32]
    face_indices: NDArray[np.int32]
    normals: NDArray[np.float32]
    normal_indices: NDArray[np.int32]
    st: NDArray[np.float32]
    st_indices: NDArray[np.int32]
    material: str
    collider: Collider | None = None
    piece: str = ""
    pose: Pose | None = None
    double_sided: bool = False

    @property
    def own_points(self) -> NDArray[np.float32]:
        """Points in the axes of the pose, welded, so that equal parts have equal arrays; shape (P, 3)."""
        if self.pose is None:
            return self.points
        return (np.round(self.pose.taken_back(self.points), WELD_DECIMALS) + 0.0).astype(np.float32)


@dataclass(frozen=True)
class AreaLight:
    """A light that shines down from a rectangle or a disc.

    Attributes
    ----------
    width_m, depth_m
        Extent along X and Z; both are the diameter of a disc.
    height_m
        Height of the lit face in the asset.
    luminance_nit
        Luminance of the lit face, cd/m2.
    colour_rgb
        Linear colour of the light and of the glowing parts of the asset.
    is_round
        True if the light is a disc.
    """

    width_m: float
    depth_m: float
    height_m: float
    luminance_nit: float
    colour_rgb: Rgb = USUAL_LAMP_RGB
    is_round: bool = False


@dataclass(frozen=True, eq=False)
class Asset:
    """Meshes and light of a prototype.

    Attributes
    ----------
    parts
        Its meshes.
    light
        Its light, if it has one.
    paints
        Materials that can replace ``car_paint``, by the names of the variants.
    finishes
        Materials used only by this asset, by their keys.
    """

    parts: tuple[Part, ...]
    light: AreaLight | None = None
    paints: Mapping[str, str] = field(default_factory=dict)
    finishes: Mapping[str, Finish] = field(default_factory=dict)

    @property
    def materials(self) -> frozenset[str]:
        """Keys of the materials of its meshes."""
        return frozenset(part.material for part in self.parts)


def pascal_case(key: str) -> str:
    """Convert a key to the name of a prim: ``WheelStop`` for ``wheel_stop``."""
    return "".join(word.capitalize() for word in key.split("_"))


def make_part(
    name: str,
    faces: Sequence[Face] | NDArray[np.float64],
    material: str,
    *,
    collider: Collider | None = None,
    piece: str = "",
    crease_deg: float = 30.0,
    project: Callable[[NDArray[np.float64], NDArray[np.float64]], NDArray[np.float64]] | None = None,
) -> Part:
    """Weld faces into a part, with smooth normals between faces that meet at less than `crease_deg`.

    Parameters
    ----------
    name, material, collider, piece
        Fields of the part.
    faces
        Planar polygons; coincident corners are welded, faces without area are dropped.
    crease_deg
        Largest angle between the normals of two faces that share a smooth edge.
    project
        Function from corners and the normals of their faces to texture coordinates in metres; a projection along the
        main axis if left out.
    """
    corners = np.round(np.concatenate(faces), WELD_DECIMALS) + 0.0
    points, indices = unique_rows(corners)
    flat, counts = _clean_loops(points, indices, np.array([len(face) for face in faces]))
    used, flat = np.unique(flat, return_inverse=True)
    points, flat = points[used], flat.ravel()

    area = area_vectors(points[flat], counts)
    unit = area / np.linalg.norm(area, axis=1, keepdims=True)
    normals, normal_indices = distinct_normals(_corner_normals(flat, counts, area, unit, crease_deg))
    look = MATERIALS[material]
    st, st_indices = np.empty((0, 2)), np.empty(0, dtype=np.int64)
    if look.textures():
        along = project or along_main_axis
        repeats_m = look.repeat_m, look.repeat_up_m or look.repeat_m
        coordinates = along(points[flat], np.repeat(unit, counts, axis=0)) / repeats_m
        st, st_indices = unique_rows(np.round(coordinates, WELD_DECIMALS) + 0.0)
    return Part(
        name=name,
        points=points.astype(np.float32),
        face_counts=counts.astype(np.int32),
        face_indices=flat.astype(np.int32),
        normals=normals,
        normal_indices=normal_indices.astype(np.int32),
        st=st.astype(np.float32),
        st_indices=st_indices.astype(np.int32),
        material=material,
        collider=collider,
        piece=piece,
    )


def unique_rows(rows: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Distinct rows in order of first occurrence, and the index of each row's distinct row."""
    order = np.lexsort(rows.T[::-1])
    is_new = np.concatenate(([True], (np.diff(rows[order], axis=0) != 0).any(axis=1)))
    which = np.empty(len(rows), dtype=np.int64)
    which[order] = np.cumsum(is_new) - 1
    return rows[order][is_new], which


def distinct_normals(normals: NDArray[np.float64]) -> tuple[NDArray[np.float32], NDArray[np.int64]]:
    """Distinct unit normals rounded to four decimals, and the index of each corner's normal."""
    steps = np.rint(normals.astype(np.float32) * np.float32(_NORMAL_STEPS)).astype(np.int64)
    # encoded as integers, which sort much faster than rows
    codes = (steps + _NORMAL_STEPS) @ (2 * _NORMAL_STEPS + 1) ** np.arange(2, -1, -1)
    _, first, which = np.unique(codes, return_index=True, return_inverse=True)
    return steps[first].astype(np.float32) / np.float32(_NORMAL_STEPS), which


def _clean_loops(
    points: NDArray[np.float64], flat: NDArray[np.int64], counts: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Drop corners equal to the previous one, and faces without area; return indices and counts."""
    face_of = np.repeat(np.arange(len(counts)), counts)
    keep = flat != flat[previous_corners(counts)]
    flat, face_of = flat[keep], face_of[keep]
    counts = np.bincount(face_of, minlength=len(counts))
    solid = counts >= _MIN_CORNERS
    solid[solid] = np.linalg.norm(area_vectors(points[flat[solid[face_of]]], counts[solid]), axis=1) > MIN_AREA_M2
    return flat[solid[face_of]], counts[solid]


def previous_corners(counts: NDArray[np.int64]) -> NDArray[np.int64]:
    """Index of the previous corner in the face, for each corner."""
    before = np.arange(counts.sum()) - 1
    starts = np.cumsum(counts) - counts
    before[starts] += counts
    return before


def next_corners(counts: NDArray[np.int64]) -> NDArray[np.int64]:
    """Index of the next corner in the face, for each corner."""
    ends = np.cumsum(counts)
    after = np.arange(counts.sum()) + 1
    after[ends - 1] = ends - counts
    return after


def area_vectors(corners: NDArray[np.float64], counts: NDArray[np.int64]) -> NDArray[np.float64]:
    """Newell's normal of each face, with twice the area as its length; float64, shape (F, 3)."""
    starts = np.cumsum(counts) - counts
    relative = corners - np.repeat(corners[starts], counts, axis=0)
    return np.add.reduceat(np.cross(relative[previous_corners(counts)], relative), starts)


def _corner_normals(
    flat: NDArray[np.int64],
    counts: NDArray[np.int64],
    area: NDArray[np.float64],
    unit: NDArray[np.float64],
    crease_deg: float,
) -> NDArray[np.float64]:
    """For each corner, the mean normal of the faces at its point that meet its face at less than the crease angle."""
    face_of = np.repeat(np.arange(len(counts)), counts)
    order = np.argsort(flat, kind="stable")
    around = np.bincount(flat)
    # all pairs of corners of the same point, ordered by point
    each = np.repeat(around, around)
    pair_starts = np.cumsum(each) - each
    group_starts = np.repeat(np.cumsum(around) - around, around)
    partners = np.arange(each.sum()) + np.repeat(group_starts - pair_starts, each)
    own, other = face_of[order][np.repeat(np.arange(len(order)), each)], face_of[order][partners]
    cosine = (unit[own] * unit[other]).sum(axis=1)
    shares = area[other] * (cosine > np.cos(np.radians(crease_deg)))[:, None]
    normals = np.empty((len(flat), 3))
    normals[order] = np.add.reduceat(shares, pair_starts)
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    return np.where(lengths > 0, normals / np.where(lengths > 0, lengths, 1.0), unit[face_of])


def along_main_axis(corners: NDArray[np.float64], normals: NDArray[np.float64]) -> NDArray[np.float64]:
    """Project each face along the axis nearest to its normal, in metres; V is up on upright faces."""
    x, y, z = corners.T
    axis = np.argmax(np.abs(normals) - np.array([0.0, 1e-6, 2e-6]), axis=1)
    positive = np.take_along_axis(normals, axis[:, None], axis=1)[:, 0] > 0
    u = np.choose(axis, [np.where(positive, -z, z), x, np.where(positive, x, -x)])
    v = np.choose(axis, [y, np.where(positive, -z, z), y])
    return np.stack([u, v], axis=1)
