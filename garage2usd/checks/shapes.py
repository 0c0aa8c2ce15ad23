"""Meshes as what stands or hangs in a garage: convex pieces with an outline seen from above and two heights."""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.structure.pieces import joined

__all__ = ["Body", "MeshShape", "Piece", "Thing", "box_shape", "turned_about_y"]

Array = NDArray[np.float64]

_LEVEL = 1e-6
_ALL_IN_ONE = np.zeros(1, dtype=np.int64)
"""Where pieces start if there is one."""


class Piece(NamedTuple):
    """A connected piece of a mesh.

    Attributes
    ----------
    points
        float64, shape (n, 3).
    outline
        Corners (x, z) of its convex outline seen from above; float64, shape (k, 2).
    low_m, high_m
        Its least and greatest height.
    """

    points: Array
    outline: Array
    low_m: float
    high_m: float


@dataclass(frozen=True, eq=False)
class MeshShape:
    """A mesh in its own coordinates.

    Attributes
    ----------
    points
        float64, shape (n, 3), metres.
    counts, indices
        Corners of each face and their points; int64, shapes (F,) and (I,).
    """

    points: Array
    counts: NDArray[np.int64]
    indices: NDArray[np.int64]

    @cached_property
    def edges(self) -> NDArray[np.int64]:
        """Points of each side of each face; shape (I, 2)."""
        after = np.arange(len(self.indices)) + 1
        ends = np.cumsum(self.counts)
        after[ends - 1] = ends - self.counts
        return np.stack([self.indices, self.indices[after]], axis=1)

    @cached_property
    def lowest(self) -> float:
        """Least height of its points."""
        return float(self.points[:, 1].min())

    @cached_property
    def reach(self) -> float:
        """Greatest coordinate of its points, without sign."""
        return float(np.abs(self.points).max())

    @cached_property
    def whole(self) -> Piece:
        """All of it as one piece."""
        return _pieces(self.points, _ALL_IN_ONE)[0]

    @cached_property
    def pieces(self) -> tuple[Piece, ...]:
        """The connected pieces."""
        if not len(self.indices):
            return ()
        used = np.unique(self.indices)
        first = joined(len(self.points), *self.edges.T)[used]
        order = np.argsort(first, kind="stable")
        starts = np.unique(first[order], return_index=True)[1]
        return _pieces(self.points[used[order]], starts)


def _pieces(points: Array, starts: NDArray[np.int64]) -> tuple[Piece, ...]:
    """Pieces of points, each from its start on; the outline of what has none, as a line or a point, is all of it."""
    owner = np.repeat(np.arange(len(starts)), np.diff(starts, append=len(points)))
    hulls = shapely.convex_hull(shapely.multipoints(points[:, [0, 2]], indices=owner))
    corners, hull = shapely.get_coordinates(hulls, return_index=True)
    outlines = np.split(corners, np.searchsorted(hull, np.arange(1, len(starts))))
    are_flat = shapely.get_type_id(hulls) != shapely.GeometryType.POLYGON
    return tuple(
        Piece(own, own[:, [0, 2]] if is_flat else outline[:-1], float(own[:, 1].min()), float(own[:, 1].max()))
        for own, outline, is_flat in zip(np.split(points, starts[1:]), outlines, are_flat.tolist(), strict=True)
    )


def box_shape(low: Array, high: Array) -> MeshShape:
    """A box by its corners."""
    corners = np.array([(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])
    faces = np.array([0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3])
    return MeshShape(corners.astype(np.float64), np.full(6, 4), faces)


def turned_about_y(yaw_rad: float, position_m: tuple[float, float, float]) -> Array:
    """The matrix for row vectors of a turn about +Y and a move; float64, shape (4, 4)."""
    cos, sin = np.cos(yaw_rad), np.sin(yaw_rad)
    matrix = np.eye(4)
    matrix[0, [0, 2]] = cos, -sin
    matrix[2, [0, 2]] = sin, cos
    matrix[3, :3] = position_m
    return matrix


class Body(NamedTuple):
    """A placed mesh.

    Attributes
    ----------
    shape
        The mesh.
    matrix
        From its coordinates to the world's, for row vectors; float64, shape (4, 4).
    touches
        Whether it has a collider.
    """

    shape: MeshShape
    matrix: Array
    touches: bool

    def world_points(self) -> Array:
        """Its points in the world; float64, shape (n, 3)."""
        world: Array = self.shape.points @ self.matrix[:3, :3] + self.matrix[3, :3]
        return world

    def low_m(self) -> float:
        """Its least height in the world."""
        if self._is_upright:
            return float(self.shape.lowest * self.matrix[1, 1] + self.matrix[3, 1])
        return float(self.world_points()[:, 1].min())

    def pieces(self, *, whole: bool = False) -> list[tuple[Array, float, float]]:
        """Outline (x, z), least and greatest height in the world of each connected piece, or of all in one."""
        pieces = (self.shape.whole,) if whole else self.shape.pieces
        turn, move = self.matrix[:3, :3], self.matrix[3, :3]
        if not self._is_upright:
            return [_pieces(piece.points @ turn + move, _ALL_IN_ONE)[0][1:] for piece in pieces]
        flat, shift, rise, lift = turn[::2, ::2], move[::2], float(turn[1, 1]), float(move[1])
        return [
            (piece.outline @ flat + shift, piece.low_m * rise + lift, piece.high_m * rise + lift) for piece in pieces
        ]

    @property
    def _is_upright(self) -> bool:
        """Whether it is turned about the vertical only."""
        turn = self.matrix
        tilt = max(abs(turn[1, 0]), abs(turn[1, 2]), abs(turn[0, 1]), abs(turn[2, 1]))
        return bool(tilt < _LEVEL and turn[1, 1] > 0)


@dataclass(frozen=True, eq=False)
class Thing:
    """One object of a garage.

    Attributes
    ----------
    name
        Prim path.
    label
        Semantic class; empty where it has none.
    bodies
        Its meshes.
    """

    name: str
    label: str
    bodies: tuple[Body, ...]
