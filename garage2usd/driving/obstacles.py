"""What a car must not touch, as named convex pieces in arrays."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.driving.sweep import Floats

__all__ = ["Obstacles"]

_CORNERS = 4
_ROUNDING_M2 = 1e-9


@dataclass(frozen=True, eq=False)
class Obstacles:
    """Named shapes on the floor, cut into convex pieces of at most four corners.

    Attributes
    ----------
    names
        One for each shape, all different.
    owner
        Number of the name that each piece belongs to; shape (pieces,).
    pieces
        Corners (x, z) of each piece in order, the last repeated where there are fewer than four; shape (pieces, 4, 2).
    """

    names: tuple[str, ...]
    owner: NDArray[np.int64]
    pieces: Floats

    @classmethod
    def of(cls, shapes: Iterable[tuple[str, shapely.Geometry]]) -> "Obstacles":
        """Cut shapes in (x, z), metres, into pieces: polygons, lines as their segments, points.

        Notes
        -----
        A hole in a polygon stays one. Empty shapes keep their name and have no piece.
        """
        names: list[str] = []
        owner: list[int] = []
        pieces: list[Floats] = []
        for number, (name, shape) in enumerate(shapes):
            names.append(name)
            for part in shapely.get_parts(shape, return_index=False):
                cut = _convex(part)
                pieces += cut
                owner += [number] * len(cut)
        stacked = np.array(pieces, dtype=np.float64).reshape(-1, _CORNERS, 2)
        return cls(tuple(names), np.array(owner, dtype=np.int64), stacked)

    @cached_property
    def boxes(self) -> Floats:
        """Left, top, right and bottom of each piece; shape (pieces, 4)."""
        return np.concatenate([self.pieces.min(axis=1), self.pieces.max(axis=1)], axis=1)

    def named(self, pieces: Iterable[int]) -> tuple[str, ...]:
        """Names of what some pieces belong to, each once, in order."""
        return tuple(dict.fromkeys(self.names[self.owner[piece]] for piece in pieces))

    def near(self, point: tuple[float, float], reach_m: float) -> "Obstacles":
        """Those of the pieces that come within a square around a point."""
        x, z = point
        left, top, right, bottom = self.boxes.T
        is_near = (left < x + reach_m) & (right > x - reach_m) & (top < z + reach_m) & (bottom > z - reach_m)
        return self.kept(is_near)

    def without(self, names: Iterable[str]) -> "Obstacles":
        """The same but for some names."""
        left_out = set(names)
        numbers = [number for number in np.unique(self.owner).tolist() if self.names[number] in left_out]
        return self.kept(~np.isin(self.owner, numbers))

    def kept(self, is_kept: NDArray[np.bool_]) -> "Obstacles":
        """Some of the pieces, with all names."""
        return Obstacles(self.names, self.owner[is_kept], self.pieces[is_kept])

    def joined(self, others: "Obstacles") -> "Obstacles":
        """These and others."""
        owner = np.concatenate([self.owner, others.owner + len(self.names)])
        return Obstacles(self.names + others.names, owner, np.concatenate([self.pieces, others.pieces]))

    def seen_from(self, x_m: float, z_m: float, yaw_rad: float) -> "Obstacles":
        """The same in the frame with its origin in a point and its axes turned by a yaw about +Y."""
        cos, sin = np.cos(yaw_rad), np.sin(yaw_rad)
        x, z = self.pieces[..., 0] - x_m, self.pieces[..., 1] - z_m
        return Obstacles(self.names, self.owner, np.stack([x * cos - z * sin, x * sin + z * cos], axis=-1))


def _convex(shape: shapely.Geometry) -> list[Floats]:
    """A shape of one part in convex pieces."""
    if shape.is_empty:
        return []
    if isinstance(shape, shapely.Polygon):
        corners = np.array(shape.exterior.coords)[:-1, :2]
        is_convex = shape.convex_hull.area - shape.area <= _ROUNDING_M2
        if len(corners) <= _CORNERS and is_convex:
            return [_padded(corners)]
        triangles = shapely.get_parts(shapely.constrained_delaunay_triangles(shape))
        return [_padded(np.array(triangle.exterior.coords)[:-1, :2]) for triangle in triangles]
    points = np.array(shape.coords)[:, :2]
    if len(points) == 1:
        return [_padded(points)]
    return [_padded(points[start : start + 2]) for start in range(len(points) - 1)]


def _padded(corners: Sequence[Sequence[float]] | Floats) -> Floats:
    points = np.asarray(corners, dtype=np.float64)
    return np.concatenate([points, np.repeat(points[-1:], _CORNERS - len(points), axis=0)])
