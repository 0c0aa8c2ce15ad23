"""Colliders of a stage as line drawings."""

from contextlib import suppress

import numpy as np
from numpy.typing import NDArray
from pxr import Usd

from garage2usd.scenes.meshes import Triangles
from garage2usd.scenes.values import READ_AT
from garage2usd.view.viewer.scene import Piece, box_corners, moved

__all__ = ["collider_lines", "collider_of"]

_BOXES = frozenset({"boundingCube"})
_HULLS = frozenset({"convexHull", "convexDecomposition", "boundingSphere"})
_CREASE_COS = 0.99999
_BOX_EDGES = [(a, b) for a in range(8) for b in range(a + 1, 8) if (a ^ b).bit_count() == 1]


def collider_of(prim: Usd.Prim) -> str:
    """Collision shape of a prim, as UsdPhysics' token of approximation; empty for a prim without collision."""
    if "PhysicsCollisionAPI" not in prim.GetAppliedSchemas():
        return ""
    enabled = prim.GetAttribute("physics:collisionEnabled").Get(READ_AT)
    if enabled is False:
        return ""
    return str(prim.GetAttribute("physics:approximation").Get() or "none")


def collider_lines(piece: Piece) -> NDArray[np.float32]:
    """Line segments of a collider in its object's space: edges of the box or hull, or creases of the mesh.

    Returns
    -------
    numpy.ndarray
        float32, shape (lines, 2, 3), in units of the stage.
    """
    return moved(_lines(piece.mesh, piece.collider), piece.matrix)


def _lines(mesh: Triangles, approximation: str) -> NDArray[np.float32]:
    points = mesh.positions_m
    if approximation in _BOXES:
        edges: NDArray[np.float32] = box_corners(points)[_BOX_EDGES].astype(np.float32)
        return edges
    triangles = mesh.indices.astype(np.int64)
    if approximation in _HULLS:
        from scipy.spatial import ConvexHull, QhullError  # noqa: PLC0415 - few ask for colliders, all wait for imports

        with suppress(QhullError):  # flat points have no hull; their triangles are drawn instead
            triangles = ConvexHull(points).simplices
    return _creases(points, triangles)


def _creases(points: NDArray[np.float32], triangles: NDArray[np.int64]) -> NDArray[np.float32]:
    """Edges of a triangle mesh, without those between coplanar triangles."""
    _, same = np.unique(np.round(points, 5), axis=0, return_inverse=True)
    places = points[triangles]
    normals = np.cross(places[:, 1] - places[:, 0], places[:, 2] - places[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    edges = np.sort(same.ravel()[triangles][:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    ends = triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    _, first, inverse, counts = np.unique(edges, axis=0, return_index=True, return_inverse=True, return_counts=True)
    normal_of = np.repeat(normals, 3, axis=0)
    # an edge is flat if the normals of all its triangles are parallel, regardless of sign
    along = np.abs((normal_of * normal_of[first][inverse.ravel()]).sum(axis=1)) > _CREASE_COS
    flat = np.bincount(inverse.ravel(), weights=along) == counts
    lines: NDArray[np.float32] = points[ends[first[~(flat & (counts > 1))]]]
    return lines
