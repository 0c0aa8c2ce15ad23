"""Meshes and simple shapes of a stage as triangles with one normal and one texture coordinate per vertex."""

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pxr import Usd, UsdGeom

from garage2usd.scenes.textures import USUAL_COORDINATES, Coordinates
from garage2usd.scenes.triangles import solid_faces, triangulated
from garage2usd.scenes.values import READ_AT, numbers_of

DRAWN_TYPES = frozenset({"Mesh", "Cube", "Sphere", "Cylinder", "Cone", "Capsule", "Plane"})
"""Types of prims with triangles."""

_SMALLEST_M2 = 1e-12


@dataclass(frozen=True, eq=False)
class Triangles:
    """Triangles of one mesh in its own space.

    Attributes
    ----------
    positions_m, normals
        float32, shape (vertices, 3) each; normals are of unit length.
    coordinates
        Texture coordinates; float32, shape (vertices, sets, 2).
    colours
        Linear; float32, shape (vertices, 3), or None if all vertices have the colour of the surface.
    indices
        uint32, shape (triangles, 3), counter-clockwise seen from outside.
    face_of
        int32, shape (triangles,): number of each triangle's face.
    double_sided
        True if the back is visible.
    has_normals
        True if the normals are those of the file; False if they follow from the faces.
    """

    positions_m: NDArray[np.float32]
    normals: NDArray[np.float32]
    coordinates: NDArray[np.float32]
    indices: NDArray[np.uint32]
    face_of: NDArray[np.int32]
    double_sided: bool
    colours: NDArray[np.float32] | None = None
    has_normals: bool = True

    def key(self) -> bytes:
        """Return a key that is equal for identical triangles."""
        digest = hashlib.blake2b(bytes([self.double_sided]), digest_size=16)
        colours = () if self.colours is None else (self.colours,)
        for values in (self.positions_m, self.normals, self.coordinates, self.indices, *colours):
            digest.update(np.array(values.shape).tobytes())
            digest.update(np.ascontiguousarray(values).tobytes())
        return digest.digest()

    def of_faces(self, faces: NDArray[np.intp]) -> "Triangles":
        """Return the triangles of some faces only."""
        is_wanted = np.zeros(max(int(self.face_of.max(initial=0)), int(faces.max(initial=0))) + 1, dtype=bool)
        is_wanted[faces] = True
        kept = is_wanted[self.face_of]
        is_used = np.zeros(len(self.positions_m), dtype=bool)
        is_used[self.indices[kept]] = True
        used, indices = np.flatnonzero(is_used), (np.cumsum(is_used) - 1)[self.indices[kept]]
        return replace(
            self,
            positions_m=self.positions_m[used],
            normals=self.normals[used],
            coordinates=self.coordinates[used],
            indices=indices.astype(np.uint32),
            face_of=self.face_of[kept],
            colours=None if self.colours is None else self.colours[used],
        )

    def moved(self, matrix: NDArray[np.float64]) -> "Triangles":
        """Transform triangles to another space, by a matrix for row vectors that need not be rigid, shape (4, 4)."""
        turn = matrix[:3, :3]
        return replace(
            self,
            positions_m=(self.positions_m @ turn + matrix[3, :3]).astype(np.float32),
            normals=unit(self.normals @ np.linalg.pinv(turn).T),
            indices=self.indices[:, [0, 2, 1]] if np.linalg.det(turn) < 0 else self.indices,
        )


def triangles_of(
    prim: Usd.Prim, *, sets: Sequence[Coordinates] = (USUAL_COORDINATES,), colour_name: str = ""
) -> Triangles | None:
    """Triangulate a prim of one of `DRAWN_TYPES`; None if it has no triangles.

    Parameters
    ----------
    prim
        The mesh or shape.
    sets
        Sets of texture coordinates to read.
    colour_name
        Name of the primvar with the colours; empty for none.

    Notes
    -----
    Faces that are holes are omitted, and polygons are cut by `garage2usd.scenes.triangles.triangulated`. Without
    authored normals, a mesh is faceted, or smooth if it has a subdivision scheme; it is not subdivided. Faces that
    refer to missing points are omitted, as in a renderer.
    """
    if prim.GetTypeName() != "Mesh":
        return _of_solid(prim, sets)
    mesh = UsdGeom.Mesh(prim)
    points = numbers_of(mesh.GetPointsAttr(), np.float32, width=3)
    counts = numbers_of(mesh.GetFaceVertexCountsAttr(), np.int64)
    corners = numbers_of(mesh.GetFaceVertexIndicesAttr(), np.int64)
    if not len(counts) or (counts < 0).any() or counts.sum() != len(corners) or not len(corners) or not len(points):
        return None
    fans, face_of = triangulated(points, corners, counts)
    holes = numbers_of(mesh.GetHoleIndicesAttr(), np.int64)
    if len(holes):
        is_drawn = ~np.isin(face_of, holes)
        fans, face_of = fans[is_drawn], face_of[is_drawn]
    points_of = corners[fans]
    if not (corners.min() >= 0 and corners.max() < len(points) and np.isfinite(points).all()):
        sound = ((points_of >= 0) & (points_of < len(points))).all(axis=1)
        sound &= np.isfinite(points[np.clip(points_of, 0, len(points) - 1)]).all(axis=(1, 2))
        fans, face_of = fans[sound], face_of[sound]
    if not len(fans):
        return None
    if mesh.GetOrientationAttr().Get(READ_AT) == UsdGeom.Tokens.leftHanded:
        fans = fans[:, [0, 2, 1]]
    drawn = _Corners(len(points), len(corners), fans, corners[fans], face_of)
    normals, has_normals = _normals(mesh, points, drawn)
    coordinates = [_coordinates(prim, own, drawn) for own in sets]
    return _welded(
        points[drawn.points].reshape(-1, 3),
        normals.reshape(-1, 3),
        np.stack(coordinates, axis=2).reshape(-1, len(sets), 2),
        _colours(prim, colour_name, drawn) if colour_name else None,
        face_of,
        double_sided=bool(mesh.GetDoubleSidedAttr().Get(READ_AT)),
        has_normals=has_normals,
    )


def cross(one: NDArray[np.float64], other: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compute cross products of vectors whose first axis is (x, y, z), without the checks of `numpy.cross`."""
    (x, y, z), (other_x, other_y, other_z) = one, other
    return np.stack([y * other_z - z * other_y, z * other_x - x * other_z, x * other_y - y * other_x])


class _Corners(NamedTuple):
    """Corners of the triangles of a mesh with some vertices and given corners: which of both each is, and its face."""

    vertices: int
    given: int
    fans: NDArray[np.int64]
    points: NDArray[np.int64]
    face_of: NDArray[np.int32]


def _of_solid(prim: Usd.Prim, sets: Sequence[Coordinates]) -> Triangles | None:
    solid = solid_faces(prim)
    if solid is None:
        return None
    positions, normals = solid
    face_of = np.arange(len(positions) // 3, dtype=np.int32)
    coordinates = np.broadcast_to([own.fallback for own in sets], (len(positions), len(sets), 2))
    double_sided = bool(UsdGeom.Gprim(prim).GetDoubleSidedAttr().Get(READ_AT))
    return _welded(positions, normals, coordinates, None, face_of, double_sided=double_sided)


def _normals(mesh: UsdGeom.Mesh, points: NDArray[np.float32], corners: _Corners) -> tuple[NDArray[np.float32], bool]:
    """Return the normal of each corner of each triangle, shape (triangles, 3, 3), and True if the mesh gives them."""
    primvar = UsdGeom.PrimvarsAPI(mesh).GetPrimvar("normals")
    if primvar.HasAuthoredValue():
        values, interpolation = primvar.ComputeFlattened(READ_AT), primvar.GetInterpolation()
    else:
        values, interpolation = mesh.GetNormalsAttr().Get(READ_AT), mesh.GetNormalsInterpolation()
    authored = _at_corners(values, interpolation, 3, corners)
    if authored is not None:
        return unit(authored), True
    places = points[corners.points].astype(np.float64)
    areas = cross((places[:, 1] - places[:, 0]).T, (places[:, 2] - places[:, 0]).T).T
    if mesh.GetSubdivisionSchemeAttr().Get(READ_AT) != UsdGeom.Tokens.none:
        sums = np.zeros((len(points), 3))
        np.add.at(sums, corners.points.ravel(), np.repeat(areas, 3, axis=0))
        return unit(sums)[corners.points], False
    return np.repeat(unit(areas)[:, None], 3, axis=1), False


def _coordinates(prim: Usd.Prim, wanted: Coordinates, corners: _Corners) -> NDArray[np.float32]:
    """Return texture coordinates of triangle corners, shape (triangles, 3, 2); the fallback without a primvar."""
    found = _primvar(prim, wanted.name, 2, corners) if wanted.name else None
    return np.broadcast_to(np.array(wanted.fallback, np.float32), (len(corners.fans), 3, 2)) if found is None else found


def _colours(prim: Usd.Prim, name: str, corners: _Corners) -> NDArray[np.float32] | None:
    """Return the colour of each triangle corner in order; None if the prim has none."""
    found = _primvar(prim, name, 3, corners)
    return None if found is None else np.clip(np.nan_to_num(found), 0, 1).reshape(-1, 3)


def _primvar(prim: Usd.Prim, name: str, width: int, corners: _Corners) -> NDArray[np.float32] | None:
    """Return the vectors of a primvar at each triangle corner; None without the primvar."""
    primvar = UsdGeom.PrimvarsAPI(prim).FindPrimvarWithInheritance(name)
    values = primvar.ComputeFlattened(READ_AT) if primvar and primvar.HasValue() else None
    if values is None or f"GfVec{width}" not in primvar.GetTypeName().type.typeName:
        return None
    return _at_corners(values, primvar.GetInterpolation(), width, corners)


def _at_corners(values: object, interpolation: str, width: int, corners: _Corners) -> NDArray[np.float32] | None:
    """Return the values of a primvar at each triangle corner; None if their type or number does not fit."""
    try:
        found = np.asarray(values, dtype=np.float32).reshape(-1, width)
    except (TypeError, ValueError):  # also without values
        return None
    tokens = UsdGeom.Tokens
    if interpolation == tokens.faceVarying and len(found) == corners.given:
        return np.asarray(found[corners.fans])
    if interpolation in {tokens.vertex, tokens.varying} and len(found) == corners.vertices:
        return np.asarray(found[corners.points])
    if interpolation == tokens.uniform and len(found) > corners.face_of.max():
        return np.repeat(found[corners.face_of][:, None], 3, axis=1)
    if interpolation == tokens.constant and len(found) == 1:
        return np.broadcast_to(found[0], (len(corners.fans), 3, width)).astype(np.float32)
    return None


def box_corners(points: NDArray[Any]) -> NDArray[Any]:
    """Return the eight corners of the bounding box of points, X changing fastest; shape (8, 3)."""
    pair = points.min(axis=0), points.max(axis=0)
    return np.array([[pair[corner >> axis & 1][axis] for axis in range(3)] for corner in range(8)])


def unit(vectors: NDArray[Any]) -> NDArray[np.float32]:
    """Scale vectors, shape (..., 3), to unit length; the Y axis for those without a length."""
    lengths = np.sqrt(np.einsum("...i,...i", vectors, vectors))[..., None]
    return np.where(lengths > _SMALLEST_M2, vectors / np.maximum(lengths, _SMALLEST_M2), [0, 1, 0]).astype(np.float32)


def _welded(
    positions: NDArray[np.float32],
    normals: NDArray[np.float32],
    coordinates: NDArray[np.floating[Any]],
    colours: NDArray[np.float32] | None,
    face_of: NDArray[np.int32],
    *,
    double_sided: bool,
    has_normals: bool = True,
) -> Triangles:
    """Merge identical triangle corners to vertices."""
    sets = coordinates.shape[1]
    columns = [positions, normals, coordinates.reshape(-1, 2 * sets), *(() if colours is None else (colours,))]
    rows = np.ascontiguousarray(np.hstack(columns).astype(np.float32) + np.float32(0))
    _, first, inverse = np.unique(
        rows.view(np.dtype((np.void, rows.itemsize * rows.shape[1]))).ravel(), return_index=True, return_inverse=True
    )
    order = np.argsort(first)  # vertices in the order of their first use
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    kept = rows[first[order]]
    return Triangles(
        kept[:, :3].copy(),
        kept[:, 3:6].copy(),
        kept[:, 6 : 6 + 2 * sets].reshape(-1, sets, 2).copy(),
        rank[inverse].reshape(-1, 3).astype(np.uint32),
        face_of,
        double_sided,
        None if colours is None else kept[:, 6 + 2 * sets :].copy(),
        has_normals,
    )
