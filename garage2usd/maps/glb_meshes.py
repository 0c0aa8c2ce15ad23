"""Triangle meshes as glTF primitives, and matrices as translation, rotation and scale."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.scenes.meshes import Triangles, cross

Matrices = NDArray[np.float64]
"""Transforms for points as rows; float64, shape (n, 4, 4)."""

_SQUARE = 1e-6
"""Tolerance of the cosine between two axes for a right angle, in single precision."""
_SMALLEST = 1e-12
_FACET_RAD, _MOST_RAD = 1.4e-3, math.radians(10)
"""Greatest tilt of a faceted triangle's vertex normals from its face normal: for any triangle, and for narrow matte
ones."""
_NARROW_M, _OFF_M = 0.03, 1e-3
"""Height below which triangles are narrow, and greatest deviation of the surface that their normals imply."""
_WELDED = 0.95
"""Greatest share of vertices left after welding for a mesh to be welded. Number plates that differ only in their
texture coordinates share the other arrays."""
_PLACE_DIGITS, _DIGITS = 4, 6
"""Decimals of lengths in metres, and of unitless values."""


class Primitive(NamedTuple):
    """Arrays of a glTF primitive, one row per vertex.

    Attributes
    ----------
    positions, normals, tangents, colours
        float32, shapes (vertices, 3), (vertices, 3), (vertices, 4) and (vertices, 3), or None where it has none: a
        primitive without normals is faceted, as glTF 2.0 says in 3.7.2.1.
    coordinates
        Texture coordinates of each set; float32, shape (vertices, 2) each.
    indices
        uint32, shape (triangles, 3).
    """

    positions: NDArray[np.float32]
    normals: NDArray[np.float32] | None
    tangents: NDArray[np.float32] | None
    colours: NDArray[np.float32] | None
    coordinates: tuple[NDArray[np.float32], ...]
    indices: NDArray[np.uint32]

    def named(self) -> dict[str, NDArray[np.float32]]:
        """Return the primitive's arrays by glTF attribute name."""
        arrays = {"POSITION": self.positions, "NORMAL": self.normals, "TANGENT": self.tangents}
        arrays |= {f"TEXCOORD_{number}": array for number, array in enumerate(self.coordinates)}
        arrays["COLOR_0"] = self.colours
        return {name: array for name, array in arrays.items() if array is not None}


def primitive_of(mesh: Triangles, *, sets: Sequence[int], normals_set: int | None, is_faceted: bool) -> Primitive:
    """Convert triangles to a glTF primitive.

    Parameters
    ----------
    mesh
        The triangles.
    sets
        Indices of the texture coordinates that the material reads.
    normals_set
        Index in `sets` of the normal map, which requires normals and tangents; None without one.
    is_faceted
        True if all triangles have flat normals, so that the primitive needs none.
    """
    # the first row of pixels is v = 0 there and v = 1 in USD
    coordinates = tuple((mesh.coordinates[:, number] * (1, -1) + (0, 1)).astype(np.float32) for number in sets)
    if normals_set is not None:
        tangents = _tangents_of(mesh, mesh.coordinates[:, sets[normals_set]])
        return Primitive(mesh.positions_m, mesh.normals, tangents, mesh.colours, coordinates, mesh.indices)
    if not is_faceted:
        return Primitive(mesh.positions_m, mesh.normals, None, mesh.colours, coordinates, mesh.indices)
    bare = Primitive(mesh.positions_m, None, None, mesh.colours, coordinates, mesh.indices)
    first, inverse = _distinct(_rows(bare))
    if len(first) > _WELDED * len(inverse):
        return bare
    indices = inverse[mesh.indices].astype(np.uint32)
    colours = None if mesh.colours is None else mesh.colours[first]
    return Primitive(mesh.positions_m[first], None, None, colours, tuple(own[first] for own in coordinates), indices)


def beside(smooth: Primitive, faceted: Primitive) -> Primitive:
    """Merge a faceted primitive's vertices with those of a smooth one; vertices that the latter lacks follow.

    Both have the same kinds of arrays, except for the normals.
    """
    here, there = _rows(smooth), _rows(faceted)
    first, inverse = _distinct(np.vstack([here, there]))
    home = first[inverse[len(here) :]]
    own, place = np.unique(home[home >= len(here)], return_inverse=True)
    home[home >= len(here)] = len(here) + place
    own -= len(here)
    return Primitive(
        np.vstack([smooth.positions, faceted.positions[own]]),
        None,
        None,
        _stacked(smooth.colours, faceted.colours, own),
        tuple(
            np.vstack([front, back[own]]) for front, back in zip(smooth.coordinates, faceted.coordinates, strict=True)
        ),
        home[faceted.indices].astype(np.uint32),
    )


def _stacked(
    front: NDArray[np.float32] | None, back: NDArray[np.float32] | None, chosen: NDArray[np.intp]
) -> NDArray[np.float32] | None:
    return None if front is None or back is None else np.vstack([front, back[chosen]])


def _rows(primitive: Primitive) -> NDArray[np.float32]:
    """Return the vertex rows of a primitive without normals."""
    colours = () if primitive.colours is None else (primitive.colours,)
    return np.hstack([primitive.positions, *primitive.coordinates, *colours])


def _distinct(rows: NDArray[np.float32]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the first index of each distinct row, ordered by value, and the distinct row of each row."""
    order = np.lexsort(rows.T[::-1])
    columns = rows.T[:, order]
    differs = np.ones(len(order), dtype=bool)
    differs[1:] = np.logical_or.reduce(columns[:, 1:] != columns[:, :-1])
    inverse = np.empty_like(order)
    inverse[order] = np.cumsum(differs) - 1
    return order[differs], inverse


def by_facets(mesh: Triangles, *, is_matte: bool = False) -> Iterator[tuple[bool, Triangles]]:
    """Split off the faceted triangles, whose vertex normals equal their face normals within tolerance.

    Parameters
    ----------
    mesh
        The triangles.
    is_matte
        True if the surface has no visible reflections, so that smoothing of narrow triangles is invisible.

    Yields
    ------
    tuple
        True for faceted triangles, and the triangles.
    """
    corners = mesh.positions_m.T.astype(np.float64)[:, mesh.indices]
    sides = corners - np.roll(corners, 1, axis=2)
    areas = cross(sides[..., 1], -sides[..., 0])
    doubled = np.sqrt((areas**2).sum(axis=0))
    height = doubled / np.maximum(np.sqrt((sides**2).sum(axis=0)).max(axis=1), _SMALLEST)
    narrow = np.clip(_OFF_M / np.maximum(height, _SMALLEST), _FACET_RAD, _MOST_RAD)
    tilt = np.where(is_matte & (height < _NARROW_M), narrow, _FACET_RAD)
    least = doubled * np.cos(tilt)
    are_faceted = np.ones(len(mesh.indices), dtype=bool)
    for normals in mesh.normals.T[:, mesh.indices.T].transpose(1, 0, 2):
        are_faceted &= (normals * areas).sum(axis=0) >= least
    numbered = replace(mesh, face_of=np.arange(len(mesh.indices), dtype=np.int32))
    for is_faceted in (True, False):
        own = np.flatnonzero(are_faceted == is_faceted)
        if len(own):
            yield is_faceted, mesh if len(own) == len(are_faceted) else numbered.of_faces(own)


def joined(meshes: Sequence[Triangles]) -> Triangles:
    """Join meshes of equal sidedness, all with vertex colours or none."""
    if len(meshes) == 1:
        return meshes[0]
    first = np.cumsum([0, *(len(mesh.positions_m) for mesh in meshes[:-1])])
    return Triangles(
        np.concatenate([mesh.positions_m for mesh in meshes]),
        np.concatenate([mesh.normals for mesh in meshes]),
        np.concatenate([mesh.coordinates for mesh in meshes]),
        np.concatenate([mesh.indices + np.uint32(start) for mesh, start in zip(meshes, first, strict=True)]),
        np.zeros(sum(len(mesh.indices) for mesh in meshes), np.int32),
        meshes[0].double_sided,
        None if meshes[0].colours is None else np.concatenate([mesh.colours for mesh in meshes]),
    )


def are_rigid(matrices: Matrices) -> NDArray[np.bool_]:
    """Test if each matrix is a scale along the axes, a rotation and a translation, as glTF nodes require."""
    lengths = np.linalg.norm(matrices[:, :3, :3], axis=2, keepdims=True)
    axes = matrices[:, :3, :3] / np.maximum(lengths, _SMALLEST)
    found: NDArray[np.bool_] = np.abs(axes @ axes.transpose(0, 2, 1) - np.eye(3)).max(axis=(1, 2)) < _SQUARE
    return found


def rigid_inverses(matrices: Matrices) -> Matrices:
    """Invert rigid matrices.

    Notes
    -----
    The inverse is computed by transposition. BLAS threads synchronize at each small matrix: twelve thousand matrices
    took seconds on a busy machine.
    """
    scaled = matrices[:, :3, :3]
    inverses = np.zeros_like(matrices)
    inverses[:, :3, :3] = (scaled / (scaled**2).sum(axis=2, keepdims=True)).transpose(0, 2, 1)
    inverses[:, 3:, :3] = -matrices[:, 3:, :3] @ inverses[:, :3, :3]
    inverses[:, 3, 3] = 1.0
    return inverses


def places_of(matrices: Matrices) -> list[dict[str, list[float]]]:
    """Convert rigid matrices for points as rows to node properties, without default values.

    Notes
    -----
    A mirrored matrix gets a negative scale along X.
    """
    from scipy.spatial.transform import Rotation  # noqa: PLC0415 - slow to import, and not always needed

    scales = np.linalg.norm(matrices[:, :3, :3], axis=2)
    axes = matrices[:, :3, :3] / scales[:, :, None]
    mirror = np.where(np.linalg.det(axes) < 0, -1.0, 1.0)
    scales[:, 0] *= mirror
    axes[:, 0] *= mirror[:, None]
    turns = Rotation.from_matrix(axes.transpose(0, 2, 1)).as_quat(canonical=True)
    properties = (
        ("translation", np.round(matrices[:, 3, :3], _PLACE_DIGITS), np.zeros(3)),
        ("rotation", np.round(turns, _DIGITS), np.array([0.0, 0.0, 0.0, 1.0])),
        ("scale", np.round(scales, _DIGITS), np.ones(3)),
    )
    places: list[dict[str, list[float]]] = [{} for _ in matrices]
    for name, values, usual in properties:
        for node in np.flatnonzero((values != usual).any(axis=1)).tolist():
            places[node][name] = (values[node] + 0.0).tolist()  # avoids -0
    return places


def _tangents_of(mesh: Triangles, coordinates: NDArray[np.float32]) -> NDArray[np.float32]:
    """Compute vertex tangents along the first texture coordinate, with the sign of the bitangent.

    Returns
    -------
    numpy.ndarray
        float32, shape (vertices, 4): unit vectors across the normals, and 1 where the second coordinate grows along
        the cross product of normal and tangent, -1 where it grows against it.

    Notes
    -----
    The directions of the triangles around a vertex are added by area, as E. Lengyel describes (Foundations of Game
    Engine Development 2, 7.5).
    """
    corners = mesh.indices.astype(np.int64)
    points, uv = mesh.positions_m[corners].astype(np.float64), coordinates[corners].astype(np.float64)
    (side_1, side_2), (uv_1, uv_2) = ((at[:, 1] - at[:, 0], at[:, 2] - at[:, 0]) for at in (points, uv))
    winding = np.sign(uv_1[:, 0] * uv_2[:, 1] - uv_2[:, 0] * uv_1[:, 1])[:, None]
    along_u = winding * (side_1 * uv_2[:, 1:] - side_2 * uv_1[:, 1:])
    along_v = winding * (side_2 * uv_1[:, :1] - side_1 * uv_2[:, :1])
    area = np.linalg.norm(np.cross(side_1, side_2), axis=1, keepdims=True)
    sums = np.zeros((2, len(mesh.positions_m), 3))
    for total, along in zip(sums, (along_u, along_v), strict=True):
        np.add.at(total, corners.ravel(), np.repeat(_unit(along, (0.0, 0.0, 0.0)) * area, 3, axis=0))
    normals = mesh.normals.astype(np.float64)
    # without a direction, take the axis that is farthest from the normal
    spare = np.eye(3)[np.abs(normals).argmin(axis=1)]
    given = np.linalg.norm(_across(sums[0], normals), axis=1, keepdims=True) > _SMALLEST
    tangents = _unit(_across(np.where(given, sums[0], spare), normals), (1.0, 0.0, 0.0))
    side = (np.cross(normals, tangents) * sums[1]).sum(axis=1)
    return np.column_stack([tangents, np.where(side < 0, -1.0, 1.0)]).astype(np.float32)


def _across(vectors: NDArray[Any], normals: NDArray[Any]) -> NDArray[Any]:
    """Return the components of vectors perpendicular to normals."""
    square: NDArray[Any] = vectors - normals * (vectors * normals).sum(axis=1, keepdims=True)
    return square


def _unit(vectors: NDArray[Any], otherwise: tuple[float, float, float]) -> NDArray[np.float32]:
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.where(lengths > _SMALLEST, vectors / np.maximum(lengths, _SMALLEST), otherwise).astype(np.float32)
