"""Triangles as glTF has them: tangents where a normal map asks for them, and places as translation, turn and scale."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from garage2usd.reading.meshes import Triangles
from garage2usd.reading.objects import Matrix

__all__ = ["is_rigid", "moved_triangles", "place_of", "tangents_of"]

_SQUARE = 1e-6
"""By how much the cosine between two axes may differ from that of a right angle: single precision."""
_SMALLEST = 1e-12
_DIGITS = 7


def is_rigid(matrix: Matrix) -> bool:
    """Whether a matrix is a scale along the axes, then a turn and a move: all that a node of glTF can say."""
    lengths = np.linalg.norm(matrix[:3, :3], axis=1)
    if lengths.min() <= _SMALLEST:
        return False
    axes = matrix[:3, :3] / lengths[:, None]
    return bool(np.abs(axes @ axes.T - np.eye(3)).max() < _SQUARE)


def place_of(matrix: Matrix) -> dict[str, list[float]]:
    """A rigid matrix for points as rows as the properties of a node; what is as it is by default is left out.

    Notes
    -----
    A mirrored matrix gets a negative scale along X.
    """
    from scipy.spatial.transform import Rotation  # noqa: PLC0415 - all who import this module would wait for it

    place: dict[str, list[float]] = {}
    if matrix[3, :3].any():
        place["translation"] = _numbers(matrix[3, :3])
    scale = np.linalg.norm(matrix[:3, :3], axis=1)
    axes = matrix[:3, :3] / scale[:, None]
    if np.linalg.det(axes) < 0:
        scale, axes = scale * (-1, 1, 1), axes * [[-1], [1], [1]]
    if np.abs(axes - np.eye(3)).max() > 10.0**-_DIGITS:
        place["rotation"] = _numbers(Rotation.from_matrix(axes.T).as_quat(canonical=True))
    if np.abs(scale - 1).max() > 10.0**-_DIGITS:
        place["scale"] = _numbers(scale)
    return place


def moved_triangles(mesh: Triangles, matrix: Matrix) -> Triangles:
    """The same triangles in another space, also through a matrix that is not rigid."""
    turn = matrix[:3, :3]
    is_mirrored = np.linalg.det(turn) < 0
    return Triangles(
        (mesh.positions_m @ turn + matrix[3, :3]).astype(np.float32),
        _unit(mesh.normals @ np.linalg.pinv(turn).T, (0.0, 1.0, 0.0)),
        mesh.coordinates,
        mesh.indices[:, [0, 2, 1]] if is_mirrored else mesh.indices,
        mesh.face_of,
        mesh.double_sided,
    )


def tangents_of(mesh: Triangles) -> NDArray[np.float32]:
    """Tangent of each vertex, along which the first texture coordinate grows, and the side of the bitangent.

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
    points, uv = mesh.positions_m[corners].astype(np.float64), mesh.coordinates[corners].astype(np.float64)
    (side_1, side_2), (uv_1, uv_2) = ((at[:, 1] - at[:, 0], at[:, 2] - at[:, 0]) for at in (points, uv))
    winding = np.sign(uv_1[:, 0] * uv_2[:, 1] - uv_2[:, 0] * uv_1[:, 1])[:, None]
    along_u = winding * (side_1 * uv_2[:, 1:] - side_2 * uv_1[:, 1:])
    along_v = winding * (side_2 * uv_1[:, :1] - side_1 * uv_2[:, :1])
    area = np.linalg.norm(np.cross(side_1, side_2), axis=1, keepdims=True)
    sums = np.zeros((2, len(mesh.positions_m), 3))
    for total, along in zip(sums, (along_u, along_v), strict=True):
        np.add.at(total, corners.ravel(), np.repeat(_unit(along, (0.0, 0.0, 0.0)) * area, 3, axis=0))
    normals = mesh.normals.astype(np.float64)
    # what has no direction gets that of the axis which the normal is farthest from
    spare = np.eye(3)[np.abs(normals).argmin(axis=1)]
    given = np.linalg.norm(_across(sums[0], normals), axis=1, keepdims=True) > _SMALLEST
    tangents = _unit(_across(np.where(given, sums[0], spare), normals), (1.0, 0.0, 0.0))
    side = (np.cross(normals, tangents) * sums[1]).sum(axis=1)
    return np.column_stack([tangents, np.where(side < 0, -1.0, 1.0)]).astype(np.float32)


def _across(vectors: NDArray[Any], normals: NDArray[Any]) -> NDArray[Any]:
    """The part of vectors that is square to normals."""
    square: NDArray[Any] = vectors - normals * (vectors * normals).sum(axis=1, keepdims=True)
    return square


def _unit(vectors: NDArray[Any], otherwise: tuple[float, float, float]) -> NDArray[np.float32]:
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    unit: NDArray[np.float32] = np.where(
        lengths > _SMALLEST, vectors / np.maximum(lengths, _SMALLEST), otherwise
    ).astype(np.float32)
    return unit


def _numbers(values: NDArray[np.float64]) -> list[float]:
    numbers: list[float] = (np.round(values, _DIGITS) + 0.0).tolist()
    return [int(number) if number.is_integer() else number for number in numbers]
