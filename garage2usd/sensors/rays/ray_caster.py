"""Ray casting: the first triangle that each ray hits, by Embree or by a bounding volume hierarchy in NumPy."""

from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.package import of_extra
from garage2usd.common.system import HAS_EMBREE

SLOWLY = None if HAS_EMBREE else "rays without embreex, which has no package for this machine: the same hits, slowly"
"""Warning that ray casting without Embree is slow; None if Embree is installed."""
_LEAF = 4
"""Number of triangles in each leaf of the hierarchy."""
_CHUNK = 1 << 17
"""Number of rays cast together, which limits memory to some tens of megabytes."""
_EDGE = 1e-9
"""Tolerance in barycentric coordinates, so that no ray passes between two triangles that share an edge."""


_FINEST = 65535
"""Number of steps of the grid by which triangles are sorted: a millimetre in a hall of 65 m."""


class RayCaster(Protocol):
    """A ray caster on a mesh of triangles."""

    def first(self, origins_m: NDArray[np.float64], directions: NDArray[np.float64]) -> NDArray[np.int64]:
        """Find the first triangle that each ray hits, -1 for none; origins and unit vectors of shape (n, 3)."""


def ray_caster(vertices_m: NDArray[np.float64], triangles: NDArray[np.int32]) -> RayCaster:
    """Create the fastest ray caster that is available on this machine.

    Parameters
    ----------
    vertices_m
        Vertices of the mesh; shape (v, 3).
    triangles
        Vertex indices of each triangle; shape (t, 3).

    Raises
    ------
    MissingExtraError
        If the packages for ray casting are not installed.
    """
    return _Embree(vertices_m, triangles) if HAS_EMBREE else BoxTree(vertices_m, triangles)


class _Embree:
    """Ray casting by Embree through trimesh, in single precision."""

    def __init__(self, vertices_m: NDArray[np.float64], triangles: NDArray[np.int32]) -> None:
        with of_extra("casting rays"):
            import embreex as _embreex  # noqa: F401, PLC0415 - without it trimesh casts rays itself, far more slowly
            import trimesh  # noqa: PLC0415
        self._mesh: Any = trimesh.Trimesh(vertices_m, triangles, process=False, validate=False)

    def first(self, origins_m: NDArray[np.float64], directions: NDArray[np.float64]) -> NDArray[np.int64]:
        """Find the first triangle that each ray hits, by Embree."""
        return np.asarray(self._mesh.ray.intersects_first(origins_m, directions), dtype=np.int64)


class BoxTree:
    """A bounding volume hierarchy in NumPy: a full binary tree, split at medians along the longest side.

    Parameters
    ----------
    vertices_m, triangles
        As for `ray_caster`.
    """

    def __init__(self, vertices_m: NDArray[np.float64], triangles: NDArray[np.int32]) -> None:
        corners = np.asarray(vertices_m, dtype=np.float64)[triangles]
        leaves = 1 << max(0, int(np.ceil(np.log2(max(len(triangles), 1) / _LEAF))))
        # pad to a full tree with entries that sort last
        order = np.full(leaves * _LEAF, -1)
        order[: len(triangles)] = np.arange(len(triangles))
        places = np.full((len(order), 3), _FINEST, dtype=np.uint16)
        places[: len(triangles)] = _places(corners.mean(axis=1))
        groups = 1
        while groups < leaves:
            of_group = places[order].reshape(groups, -1, 3)
            axis = np.argmax(of_group.max(axis=1) - of_group.min(axis=1), axis=1)
            along = np.take_along_axis(of_group, axis[:, None, None], axis=2)[..., 0]
            ranked = np.argsort(along, axis=1, kind="stable")
            order = np.take_along_axis(order.reshape(groups, -1), ranked, axis=1).ravel()
            groups *= 2
        self._leaves, self._order = leaves, order.reshape(leaves, _LEAF)
        is_there = (self._order >= 0)[..., None]
        low = np.where(is_there, corners.min(axis=1)[self._order], np.inf).min(axis=1)
        high = np.where(is_there, corners.max(axis=1)[self._order], -np.inf).max(axis=1)
        levels = [(low, high)]
        while len(levels[0][0]) > 1:
            low, high = levels[0]
            levels.insert(0, (low.reshape(-1, 2, 3).min(axis=1), high.reshape(-1, 2, 3).max(axis=1)))
        # the children of node i are 2 i + 1 and 2 i + 2
        self._low, self._high = (np.concatenate(ends) for ends in zip(*levels, strict=True))
        first, second, third = corners.transpose(1, 0, 2)
        self._corner, self._sides = first, (second - first, third - first)

    def first(self, origins_m: NDArray[np.float64], directions: NDArray[np.float64]) -> NDArray[np.int64]:
        """Find the first triangle that each ray hits, by descending the tree."""
        parts = range(0, len(directions), _CHUNK)
        found = [self._first(origins_m[part : part + _CHUNK], directions[part : part + _CHUNK]) for part in parts]
        return np.concatenate([np.empty(0, dtype=np.int64), *found])

    def _first(self, origins_m: NDArray[np.float64], directions: NDArray[np.float64]) -> NDArray[np.int64]:
        """Traverse the tree for all rays at once, the nearer box first, with a stack of boxes for each ray."""
        count, depth = len(directions), self._leaves.bit_length() + 1
        with np.errstate(divide="ignore"):
            inverse = 1.0 / directions
        nearest, found = np.full(count, np.inf), np.full(count, -1, dtype=np.int64)
        boxes, entries = np.zeros((count, depth), dtype=np.int64), np.zeros((count, depth))
        tops = np.ones(count, dtype=np.int64)
        going = np.arange(count)
        while len(going):
            tops[going] -= 1
            box, entry = boxes[going, tops[going]], entries[going, tops[going]]
            is_near = entry < nearest[going]
            is_leaf = box >= self._leaves - 1
            rays = going[is_near & is_leaf]
            if len(rays):
                self._meet(rays, box[is_near & is_leaf], origins_m, directions, nearest, found)
            rays, inner = going[is_near & ~is_leaf], box[is_near & ~is_leaf]
            if len(rays):
                children = 2 * inner[:, None] + np.array([1, 2])
                enters = self._enters(children, origins_m[rays], inverse[rays])
                far_first = np.argsort(-enters, axis=1, kind="stable")
                for turn in range(2):
                    side = far_first[:, turn : turn + 1]
                    at = np.take_along_axis(enters, side, axis=1)[:, 0]
                    pushed = at < nearest[rays]
                    onto = rays[pushed]
                    boxes[onto, tops[onto]] = np.take_along_axis(children, side, axis=1)[pushed, 0]
                    entries[onto, tops[onto]] = at[pushed]
                    tops[onto] += 1
            going = going[tops[going] > 0]
        return found

    def _enters(
        self, boxes: NDArray[np.int64], origins_m: NDArray[np.float64], inverse: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Intersect rays with boxes: the distance of entry, infinite for a miss; shape (n, 2) as the boxes."""
        with np.errstate(invalid="ignore"):  # 0 times infinity for a ray in the plane of a side
            one = (self._low[boxes] - origins_m[:, None]) * inverse[:, None]
            other = (self._high[boxes] - origins_m[:, None]) * inverse[:, None]
        enter = np.nanmax(np.minimum(one, other), axis=2)
        leave = np.nanmin(np.maximum(one, other), axis=2)
        enter = np.maximum(enter, 0.0)
        is_empty = self._low[boxes, 0] > self._high[boxes, 0]
        return np.where((enter <= leave * (1 + _EDGE)) & ~is_empty, enter, np.inf)

    def _meet(
        self,
        rays: NDArray[np.int64],
        boxes: NDArray[np.int64],
        origins_m: NDArray[np.float64],
        directions: NDArray[np.float64],
        nearest: NDArray[np.float64],
        found: NDArray[np.int64],
    ) -> None:
        """Intersect rays with the triangles of leaf boxes, by the algorithm of Möller and Trumbore."""
        numbers = self._order[boxes - (self._leaves - 1)]
        direction = directions[rays][:, None]
        side, other = (each[numbers] for each in self._sides)
        across = np.cross(direction, other)
        size = (side * across).sum(axis=2)
        from_corner = origins_m[rays][:, None] - self._corner[numbers]
        with np.errstate(divide="ignore", invalid="ignore"):
            first = (from_corner * across).sum(axis=2) / size
            turned = np.cross(from_corner, side)
            second = (direction * turned).sum(axis=2) / size
            range_m = (other * turned).sum(axis=2) / size
        meets = (first >= -_EDGE) & (second >= -_EDGE) & (first + second <= 1 + _EDGE) & (range_m > 0) & (numbers >= 0)
        range_m = np.where(meets, range_m, np.inf)
        best = np.argmin(range_m, axis=1)
        row = np.arange(len(rays))
        is_nearer = range_m[row, best] < nearest[rays]
        nearest[rays[is_nearer]] = range_m[row, best][is_nearer]
        found[rays[is_nearer]] = numbers[row, best][is_nearer]


def _places(points_m: NDArray[np.float64]) -> NDArray[np.uint16]:
    """Quantize points to steps of their common bounding box."""
    low, high = points_m.min(axis=0), points_m.max(axis=0)
    sides = np.maximum(high - low, np.finfo(np.float64).tiny)
    return np.asarray((points_m - low) / sides * (_FINEST - 1), dtype=np.uint16)
