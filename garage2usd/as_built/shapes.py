"""Meshes of objects, and their convex pieces as outlines seen from above with two heights."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from garage2usd.as_built.outlines import Outlines, are_dented, convex_outlines, outlines_of
from garage2usd.layout.grounds import hulls_around
from garage2usd.scenes.triangles import triangulated
from garage2usd.structure.squares import joined

Array = NDArray[np.float64]

_LEVEL = 1e-6
_ALL_IN_ONE = np.zeros(1, dtype=np.int64)
"""Start indices of a mesh's pieces if the mesh is a single piece."""


class Piece(NamedTuple):
    """A connected piece of a mesh.

    Attributes
    ----------
    points
        float64, shape (n, 3).
    outline
        Corners (x, z) of its convex outline seen from above; float64, shape (k, 2).
    low_m, high_m
        Least and greatest height.
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
        Number of corners of each face, and their point indices; int64, shapes (F,) and (I,).
    """

    points: Array
    counts: NDArray[np.int64]
    indices: NDArray[np.int64]

    @cached_property
    def _after(self) -> NDArray[np.int64]:
        """Index of the next corner in its face, for each corner; shape (I,)."""
        after = np.arange(len(self.indices)) + 1
        ends = np.cumsum(self.counts)
        after[ends - 1] = ends - self.counts
        return after

    @cached_property
    def edges(self) -> NDArray[np.int64]:
        """Point indices of the sides of each face; shape (I, 2)."""
        return np.stack([self.indices, self.indices[self._after]], axis=1)

    @cached_property
    def lowest(self) -> float:
        """Least height of the mesh's points."""
        return float(self.points[:, 1].min())

    @cached_property
    def reach(self) -> float:
        """Greatest absolute coordinate of the mesh's points."""
        return float(np.abs(self.points).max())

    @cached_property
    def whole(self) -> Piece:
        """The whole mesh as one piece."""
        return _pieces(self.points, _ALL_IN_ONE)[0]

    @cached_property
    def is_dented(self) -> bool:
        """True if a face of the mesh is not a convex polygon."""
        begin, end = (self.points[self.edges[:, side]] for side in (0, 1))
        return are_dented(begin, end, self._after, self.counts)

    @cached_property
    def pieces(self) -> tuple[Piece, ...]:
        """Connected pieces of the mesh; those with non-convex faces are split into parts convex from above."""
        if not len(self.indices):
            return ()
        used, first = np.unique(self.indices), joined(len(self.points), *self.edges.T)
        order = np.argsort(first[used], kind="stable")
        starts = np.unique(first[used][order], return_index=True)[1]
        pieces = _pieces(self.points[used[order]], starts)
        if not self.is_dented:
            return pieces
        corners = self.indices[triangulated(self.points, self.indices, self.counts)[0]]
        return tuple(
            part
            for piece, whole in zip(np.unique(first[used]).tolist(), pieces, strict=True)
            for part in _parts(whole, self.points[corners[first[corners[:, 0]] == piece]])
        )

    def outlines(self, *, whole: bool) -> Outlines:
        """Return the mesh's connected pieces in columns, or the whole mesh as one."""
        return self._whole_outline if whole else self._outlines

    @cached_property
    def _outlines(self) -> Outlines:
        return outlines_of([piece[1:] for piece in self.pieces])

    @cached_property
    def _whole_outline(self) -> Outlines:
        return outlines_of([self.whole[1:]])


def _pieces(points: Array, starts: NDArray[np.int64]) -> tuple[Piece, ...]:
    """Split points into pieces by start indices; a piece without area has a line or a point as outline."""
    hulls = hulls_around(points[:, [0, 2]], np.diff(starts, append=len(points)))
    corners, hull = shapely.get_coordinates(hulls, return_index=True)
    outlines = np.split(corners, np.searchsorted(hull, np.arange(1, len(starts))))
    are_flat = shapely.get_type_id(hulls) != shapely.GeometryType.POLYGON
    return tuple(
        Piece(own, own[:, [0, 2]] if is_flat else outline[:-1], float(own[:, 1].min()), float(own[:, 1].max()))
        for own, outline, is_flat in zip(np.split(points, starts[1:]), outlines, are_flat.tolist(), strict=True)
    )


def _parts(whole: Piece, triangles: Array) -> Iterator[Piece]:
    """Split a piece of triangles into convex parts, each with the height of the whole."""
    for outline in convex_outlines(triangles[:, :, [0, 2]]):
        points = [np.insert(outline, 1, height, axis=1) for height in (whole.low_m, whole.high_m)]
        yield Piece(np.concatenate(points), outline, whole.low_m, whole.high_m)


def box_shape(low: Array, high: Array) -> MeshShape:
    """Return the mesh of a box from its corners."""
    corners = np.array([(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])
    faces = np.array([0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3])
    return MeshShape(corners.astype(np.float64), np.full(6, 4), faces)


def turned_about_y(yaw_rad: ArrayLike, position_m: ArrayLike) -> Array:
    """Return matrices of rotations about +Y and moves, shape (..., 3), for row vectors; float64, shape (..., 4, 4)."""
    yaw = np.asarray(yaw_rad, dtype=np.float64)
    cos, sin = np.cos(yaw), np.sin(yaw)
    matrices = np.zeros((*yaw.shape, 4, 4))
    matrices[..., 0, 0] = matrices[..., 2, 2] = cos
    matrices[..., 0, 2], matrices[..., 2, 0] = -sin, sin
    matrices[..., 1, 1] = matrices[..., 3, 3] = 1.0
    matrices[..., 3, :3] = position_m
    return matrices


class Face(NamedTuple):
    """A face of a placed mesh.

    Attributes
    ----------
    normal
        Unit vector, outwards if its corners are counter-clockwise seen from outside; float64, shape (3,).
    corners
        float64, shape (n, 3), in the world.
    """

    normal: Array
    corners: Array


class Facets(NamedTuple):
    """Faces of placed meshes in columns.

    Attributes
    ----------
    normals
        As of `Face`; float64, shape (F, 3).
    counts
        Number of corners of each face; int64, shape (F,).
    corners
        Corners of all faces in order, in the world; float64, shape (n, 3).
    """

    normals: Array
    counts: NDArray[np.int64]
    corners: Array


class Body(NamedTuple):
    """A placed mesh.

    Attributes
    ----------
    shape
        The mesh.
    matrix
        From its coordinates to the world's, for row vectors; float64, shape (4, 4).
    touches
        True if the mesh has a collider.
    """

    shape: MeshShape
    matrix: Array
    touches: bool

    def world_points(self) -> Array:
        """Points of the placed mesh in the world; float64, shape (n, 3)."""
        world: Array = self.shape.points @ self.matrix[:3, :3] + self.matrix[3, :3]
        return world

    def low_m(self) -> float:
        """Least height of the placed mesh in the world."""
        if self._is_upright:
            return float(self.shape.lowest * self.matrix[1, 1] + self.matrix[3, 1])
        return float(self.world_points()[:, 1].min())

    def pieces(self, *, whole: bool = False) -> list[tuple[Array, float, float]]:
        """Return outline (x, z), least and greatest world height of each connected piece, or of the whole mesh."""
        pieces = (self.shape.whole,) if whole else self.shape.pieces
        turn, move = self.matrix[:3, :3], self.matrix[3, :3]
        if not self._is_upright:
            return [_pieces(piece.points @ turn + move, _ALL_IN_ONE)[0][1:] for piece in pieces]
        flat, shift, rise, lift = turn[::2, ::2], move[::2], float(turn[1, 1]), float(move[1])
        return [
            (piece.outline @ flat + shift, piece.low_m * rise + lift, piece.high_m * rise + lift) for piece in pieces
        ]

    def faces(self) -> Iterator[Face]:
        """Return the placed mesh's faces with an area, their normals by Newell's method."""
        found = self.facets()
        starts = np.cumsum(found.counts) - found.counts
        for normal, start, count in zip(found.normals, starts.tolist(), found.counts.tolist(), strict=True):
            yield Face(normal, found.corners[start : start + count])

    def facets(self) -> "Facets":
        """All faces of the placed mesh with an area, in columns."""
        counts = self.shape.counts
        points, starts = self.world_points(), np.cumsum(counts) - counts
        begin, end = (points[self.shape.edges[:, side]] for side in (0, 1))
        normals = np.add.reduceat(np.cross(begin, end), starts) if len(counts) else np.zeros((0, 3))
        lengths = np.linalg.norm(normals, axis=1)
        has_area = lengths > 0
        return Facets(normals[has_area] / lengths[has_area, None], counts[has_area], begin[np.repeat(has_area, counts)])

    @property
    def _is_upright(self) -> bool:
        """True if the placed mesh is rotated about the vertical only."""
        return bool(are_upright(self.matrix))


def are_upright(matrices: Array) -> NDArray[np.bool_]:
    """Test matrices for row vectors, float64, shape (..., 4, 4), for rotation about the vertical only; shape (...)."""
    tilts = np.abs(matrices[..., (1, 1, 0, 2), (0, 2, 1, 1)]).max(axis=-1)
    upright: NDArray[np.bool_] = (tilts < _LEVEL) & (matrices[..., 1, 1] > 0)
    return upright


@dataclass(frozen=True, eq=False)
class Thing:
    """An object of a garage.

    Attributes
    ----------
    name
        Prim path.
    label
        Semantic class; empty without one.
    bodies
        Placed meshes.
    """

    name: str
    label: str
    bodies: tuple[Body, ...]

    def faces(self) -> Iterator[Face]:
        """Return all faces of the object's meshes that have an area."""
        return (face for body in self.bodies for face in body.faces())
