"""Repair of meshes to manifolds: split points shared by several fans of faces, and drop slivers."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets.mesh import Part, area_vectors, next_corners, previous_corners

__all__ = ["with_manifold_points"]

_APART_M = 1e-5
"""Distance by which points of different fans are moved apart."""
_LEAST_AREA_M2 = 1e-8
"""Twice the area of a face below which it is a sliver."""


def with_manifold_points(part: Part) -> Part:
    """Split the points of a mesh so that each belongs to one fan of faces.

    Two faces belong to a fan if they share an edge that no third face has. Slivers are dropped. Points of different
    fans are moved apart by 0.01 mm, so that no two points coincide.

    Parameters
    ----------
    part
        A mesh without texture coordinates.
    """
    part = _without_slivers(part)
    counts, points = part.face_counts.astype(np.int64), part.face_indices.astype(np.int64)
    after = next_corners(counts)
    start, end = points, points[after]
    forward, backward = start * len(part.points) + end, end * len(part.points) + start
    keys, first, times = np.unique(forward, return_index=True, return_counts=True)
    place = np.minimum(np.searchsorted(keys, backward), len(keys) - 1)
    own = times[np.searchsorted(keys, forward)]
    is_joined = (keys[place] == backward) & (times[place] == 1) & (own == 1)
    corner = np.flatnonzero(is_joined)
    facing = first[place[corner]]
    fans = _components(len(points), [(corner, after[facing]), (after[corner], facing)])
    _, firsts, number = np.unique(points * len(points) + fans, return_index=True, return_inverse=True)
    number = number.reshape(-1)
    split = points[firsts]
    moved = part.points[split].astype(float)
    inwards = np.zeros((len(split), 3))
    corners, before = part.points[points].astype(float), previous_corners(counts)
    np.add.at(inwards, number, corners[after] + corners[before] - 2 * corners)
    is_shared = np.bincount(split, minlength=len(part.points))[split] > 1
    length = np.linalg.norm(inwards, axis=1, keepdims=True)
    moved += np.where(is_shared[:, None], _APART_M * inwards / np.maximum(length, _APART_M), 0.0)
    return replace(part, points=moved.astype(np.float32), face_indices=number.astype(np.int32))


def _without_slivers(part: Part) -> Part:
    counts = part.face_counts.astype(np.int64)
    area = np.linalg.norm(area_vectors(part.points[part.face_indices].astype(float), counts), axis=1)
    is_kept = area > _LEAST_AREA_M2
    of_corner = np.repeat(is_kept, counts)
    normals, normal_indices = np.unique(part.normal_indices[of_corner], return_inverse=True)
    points, indices = np.unique(part.face_indices[of_corner], return_inverse=True)
    return replace(
        part,
        points=part.points[points],
        face_counts=part.face_counts[is_kept],
        face_indices=indices.reshape(-1).astype(np.int32),
        normals=part.normals[normals],
        normal_indices=normal_indices.reshape(-1).astype(np.int32),
    )


def _components(size: int, pairs: list[tuple[NDArray[np.intp], NDArray[np.intp]]]) -> NDArray[np.int64]:
    """Number of the connected component of each node of an undirected graph."""
    from scipy.sparse import coo_array  # noqa: PLC0415 - few garages have meshes that are cut
    from scipy.sparse.csgraph import connected_components  # noqa: PLC0415

    one, other = (np.concatenate(side) for side in zip(*pairs, strict=True))
    joined = coo_array((np.ones(len(one), dtype=np.int8), (one, other)), shape=(size, size))
    _, labels = connected_components(joined, directed=False)
    return np.asarray(labels, dtype=np.int64)
