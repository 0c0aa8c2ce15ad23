"""Obstacles to a car as convex polygons, and the collision test of a car that moves; in C, `sweep.c`."""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.driving.car import DesignCar
from garage2usd.native import Bools, Float64Cube, Float64s, Float64Table, Int64s, elementary, in_c

Floats = Float64s
_CORNERS = 4
_ROUNDING_M2, _AREA = 1e-9, 2


class Scene(NamedTuple):
    """A car and its obstacles.

    Attributes
    ----------
    shapes
        Corners of convex polygons in order, the last possibly repeated; shape (m, k, 2).
    boxes
        Left, top, right and bottom of each; shape (m, 4).
    body
        Distances from the rear axle to nose and tail, and half the width.
    """

    shapes: Float64Cube
    boxes: Float64Table
    body: Floats


@in_c
def bulge(radius: float, turn: float, body: Floats) -> float:
    """Bound the deviation of any point of the car's body from its chord, on an arc of the rear axle's middle."""
    raise NotImplementedError


def touched_shapes(scene: Scene, pose: Floats, margin: float) -> Int64s:
    """Return the numbers of the shapes closer than a margin to a car at a pose (x, z, yaw)."""
    is_touched = np.zeros(len(scene.shapes), np.bool_)
    _mark_touched(scene, pose, margin, is_touched)
    return np.flatnonzero(is_touched)


@in_c
def _mark_touched(scene: Scene, pose: Floats, margin: float, is_touched: Bools) -> None:
    raise NotImplementedError


def least_clearance(scene: Scene, poses: Floats, bulges: Floats, most: float) -> float:
    """Return a lower bound of the distance to shapes along poses (x, z, yaw) with a bulge per step, at most `most`."""
    return _least_along(scene, poses, len(poses) - 1, bulges, most)


@in_c
def _least_along(scene: Scene, poses: Floats, steps: int, bulges: Floats, most: float) -> float:
    raise NotImplementedError


@dataclass(frozen=True, eq=False)
class Obstacles:
    """Named obstacles on the floor, cut into convex pieces of at most four corners.

    Attributes
    ----------
    names
        One name per obstacle, all different.
    owner
        Index of the name of each piece; shape (pieces,).
    pieces
        Corners (x, z) of each piece in order, the last repeated if there are fewer than four; shape (pieces, 4, 2).
    """

    names: tuple[str, ...]
    owner: NDArray[np.int64]
    pieces: Floats

    @classmethod
    def of(cls, shapes: Iterable[tuple[str, shapely.Geometry]]) -> "Obstacles":
        """Cut shapes in (x, z), metres, into convex pieces: polygons, lines as their segments, and points.

        Notes
        -----
        Holes of polygons are kept. An empty shape keeps its name and has no piece.
        """
        named = list(shapes)
        parts, owner = shapely.get_parts(np.array([shape for _, shape in named], dtype=object), return_index=True)
        number, pieces = _convex(parts)
        return cls(tuple(name for name, _ in named), owner[number].astype(np.int64), pieces)

    @cached_property
    def boxes(self) -> Floats:
        """Left, top, right and bottom of each obstacle piece; shape (pieces, 4)."""
        return np.concatenate([self.pieces.min(axis=1), self.pieces.max(axis=1)], axis=1)

    def met_by(self, car: DesignCar) -> Scene:
        """Return the obstacles as the scene of a car's sweep test."""
        return Scene(self.pieces, self.boxes, np.array([car.ahead_m, car.rear_overhang_m, car.width_m / 2]))

    def named(self, pieces: Iterable[int]) -> tuple[str, ...]:
        """Return the distinct names of the obstacles of some pieces, in order."""
        return tuple(dict.fromkeys(self.names[self.owner[piece]] for piece in pieces))

    def near(self, point: tuple[float, float], reach_m: float) -> "Obstacles":
        """Return the obstacle pieces that overlap a square around a point."""
        x, z = point
        left, top, right, bottom = self.boxes.T
        is_near = (left < x + reach_m) & (right > x - reach_m) & (top < z + reach_m) & (bottom > z - reach_m)
        return self.kept(is_near)

    def without(self, names: Iterable[str]) -> "Obstacles":
        """Return the obstacles except those of some names."""
        return self.kept(~self._is_of(names))

    def only(self, *names: str) -> "Obstacles":
        """Return the obstacles of some names."""
        return self.kept(self._is_of(names))

    def _is_of(self, names: Iterable[str]) -> NDArray[np.bool_]:
        wanted = set(names)
        return np.isin(
            self.owner, [number for number in np.unique(self.owner).tolist() if self.names[number] in wanted]
        )

    def kept(self, is_kept: NDArray[np.bool_]) -> "Obstacles":
        """Return some of the obstacle pieces, with all names."""
        return Obstacles(self.names, self.owner[is_kept], self.pieces[is_kept])

    def joined(self, others: "Obstacles") -> "Obstacles":
        """Return the union of these and other obstacles."""
        owner = np.concatenate([self.owner, others.owner + len(self.names)])
        return Obstacles(self.names + others.names, owner, np.concatenate([self.pieces, others.pieces]))

    def seen_from(self, x_m: float, z_m: float, yaw_rad: float) -> "Obstacles":
        """Transform the obstacles into a frame with its origin at a point and its axes turned by a yaw about +Y."""
        cos, sin = elementary.cos(yaw_rad), elementary.sin(yaw_rad)
        x, z = self.pieces[..., 0] - x_m, self.pieces[..., 1] - z_m
        return Obstacles(self.names, self.owner, np.stack([x * cos - z * sin, x * sin + z * cos], axis=-1))


def _convex(parts: NDArray[np.object_]) -> tuple[NDArray[np.int64], Floats]:
    """Decompose single-part shapes; return the shape number of each convex piece, shape (pieces,), and its corners."""
    kinds, counts = shapely.get_type_id(parts), shapely.get_num_coordinates(parts)
    are_areas = (kinds == shapely.GeometryType.POLYGON) & (counts > 0)
    are_convex = are_areas & (shapely.area(shapely.convex_hull(parts)) - shapely.area(parts) <= _ROUNDING_M2)
    own: list[NDArray[np.int64]] = [np.zeros(0, dtype=np.int64)]
    cut: list[Floats] = [np.zeros((0, _CORNERS, 2))]
    for count in np.unique(counts[counts > 0]).tolist():
        alike = np.flatnonzero((counts == count) & are_convex)
        corners = shapely.get_coordinates(parts[alike]).reshape(-1, count, 2)[:, :-1]
        for start in range(1, count - 2, _CORNERS - 2):
            own.append(alike)
            cut.append(_padded(np.concatenate([corners[:, :1], corners[:, start : start + _CORNERS - 1]], axis=1)))
        alike = np.flatnonzero((counts == count) & ~are_areas)
        corners = shapely.get_coordinates(parts[alike]).reshape(-1, count, 2)
        for start in range(max(count - 1, 1)):
            own.append(alike)
            cut.append(_padded(corners[:, start : start + 2]))
    for index in np.flatnonzero(are_areas & ~are_convex).tolist():
        triangles = _triangles(parts[index])
        own.append(np.full(len(triangles), index))
        cut.append(_padded(shapely.get_coordinates(triangles).reshape(-1, _CORNERS, 2)[:, :-1]))
    number = np.concatenate(own)
    order = np.argsort(number, kind="stable")
    return number[order], np.concatenate(cut)[order]


def _triangles(part: shapely.Polygon) -> NDArray[np.object_]:
    """Cut a polygon into triangles."""
    try:
        found = shapely.constrained_delaunay_triangles(part)
    except shapely.GEOSException:  # its border crosses itself within rounding
        sound = shapely.get_parts(shapely.make_valid(part))
        found = shapely.constrained_delaunay_triangles(sound[shapely.get_dimensions(sound) == _AREA])
    triangles: NDArray[np.object_] = shapely.get_parts(found)
    return triangles


def _padded(corners: Floats) -> Floats:
    """Pad the corners of pieces, shape (n, up to 4, 2), to four by repeating the last."""
    return np.concatenate([corners, np.repeat(corners[:, -1:], _CORNERS - corners.shape[1], axis=1)], axis=1)
