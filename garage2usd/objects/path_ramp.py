"""Ramps between two levels along any line: a carriageway between walls that stand on the lower floor."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets.mesh import Asset, Collider, Face, Part, along_main_axis, make_part
from garage2usd.garage.path_line import PathLine
from garage2usd.objects.coil import CoilSpec
from garage2usd.objects.ramp import RampSpec

_UP, _DOWN = (0.0, 1.0, 0.0), (0.0, -1.0, 0.0)
_STEP_M = 1e-3
_UPRIGHT = 0.5
Floats = NDArray[np.float64]


@dataclass(frozen=True)
class PathRampSpec(CoilSpec, kind=RampSpec.kind):
    """A ramp from its foot along a line; u of the line runs along +Z and v along +X.

    Attributes
    ----------
    line
        Its middle line, from the foot to the head.
    open_m
        Distance from the foot from which on there is no slab over the ramp.
    ceiling_m
        Height of the ceiling over the foot.
    walls
        True for a wall on the left and on the right; none stands between two carriageways of one ramp.
    has_head_wall
        True for a wall under the head, on the lower floor.
    """

    line: PathLine  # type: ignore[assignment]
    open_m: float
    ceiling_m: float
    walls: tuple[bool, bool]
    has_head_wall: bool

    def asset(self) -> Asset:
        """Make the meshes of a ramp: floor, underside with its ends, kerbs, and walls up to the ceilings."""
        left, right = (self.line.width_m / 2 + self.wall_m * has_wall for has_wall in self.walls)
        under = self._band(-right, left, (-self.slab_m, -self.slab_m), _DOWN)
        parts = [
            make_part("Floor", self._floor(), "floor_concrete", collider=Collider.MESH),
            make_part("Slab", [*under, *self._ends()], "ceiling_concrete", collider=Collider.MESH, project=_unrolled),
        ]
        for name, side, has_wall in (("Left", 1.0, self.walls[0]), ("Right", -1.0, self.walls[1])):
            if has_wall:
                parts += [self._kerb(f"{name}Kerb", side), self._wall(f"{name}Wall", side)]
        return Asset((*parts, *self._end_walls()))

    @property
    def _slab_sides(self) -> tuple[float, float]:
        return -self.line.width_m / 2, self.line.width_m / 2  # the walls beside it stand on the lower floor

    @cached_property
    def _runs(self) -> Floats:
        runs = self.line.stations_m(self.profile)
        step = [self.open_m, self.open_m + _STEP_M] if 0 < self.open_m < self.line.length_m else []
        apart = runs[np.all(np.abs(runs[:, None] - np.array([self.open_m])) > 2 * _STEP_M, axis=1)]
        found: Floats = np.unique(np.concatenate([apart, step, runs[[0, -1]]]))
        return found

    def _floor(self) -> list[Face]:
        """Return the faces of the floor: whole ones of a straight ramp, else triangles on both sides of the middle."""
        half = self.line.width_m / 2
        if not self.line.is_straight:
            return [*self._band(-half, 0.0, (0.0, 0.0), _UP), *self._band(0.0, half, (0.0, 0.0), _UP)]
        right, left = self._points(-half, 0.0), self._points(half, 0.0)
        return [np.array([right[at], right[at + 1], left[at + 1], left[at]]) for at in range(len(right) - 1)]

    def _foot(self, corners: Floats) -> tuple[Floats, Floats]:
        """Return the distances of corners, which lie across a station each: the nearest point of a bend is another."""
        places = self._places
        away_u, away_v = corners[:, 2, None] - places.u_m, self.turn * corners[:, 0, None] - places.v_m
        inwards = away_v * places.along_u - away_u * places.along_v
        off = np.abs(away_u * places.along_u + away_v * places.along_v)
        beyond = np.maximum(np.abs(inwards) - self.line.width_m / 2 - self.wall_m, 0.0)
        station = (off + beyond).argmin(axis=1)
        return self._runs[station], np.take_along_axis(inwards, station[:, None], axis=1)[:, 0]

    def _tops(self) -> Floats:
        """Height of the walls over the floor at each station: up to the ceiling there."""
        return np.where(self._runs > self.open_m, self.top_m, self.ceiling_m) - self._heights

    def _bottoms(self) -> Floats:
        """Height over the floor at which the outer faces of walls begin, on the lower floor."""
        return -self._heights

    def _end_walls(self) -> list[Part]:
        """Make the wall under the head, and the wall on the edge of the slab over the ramp, between those beside it."""
        parts, left_m = [], self.line.width_m / 2 - _STEP_M
        right_m = -left_m
        head_m = float(self._heights[-1]) - self.slab_m
        if self.has_head_wall and head_m > self.wall_m:
            end = self.line.length_m
            faces = self._box(end - self.wall_m, end, right_m, left_m, 0.0, head_m)
            parts.append(make_part("HeadWall", faces, "wall_concrete", collider=Collider.MESH, project=_unrolled))
        if self.top_m - self.ceiling_m > self.wall_m:
            faces = self._box(self.open_m, self.open_m + self.wall_m, right_m, left_m, self.ceiling_m, self.top_m)
            parts.append(make_part("FootWall", faces, "wall_concrete", collider=Collider.MESH, project=_unrolled))
        return parts

    def _box(
        self, start_m: float, end_m: float, right_m: float, left_m: float, low_m: float, high_m: float
    ) -> list[Face]:
        """Return the faces of a wall across the ramp."""
        places = self.line.at([start_m, end_m])
        right, left = places.beside(right_m), places.beside(left_m)
        ring = [right[0], right[1], left[1], left[0]]
        low, high = (np.array([(self.turn * v, height, u) for u, v in ring]) for height in (low_m, high_m))
        sides = [np.array([low[at], low[at - 1], high[at - 1], high[at]]) for at in range(4)]
        faces = [*sides, low, high[::-1]]
        middle = np.concatenate([low, high]).mean(axis=0)
        return [face if _faces_away(face, middle) else face[::-1] for face in faces]


def _unrolled(corners: Floats, normals: Floats) -> Floats:
    """Return texture coordinates of upright faces by their own horizontal axis, of any direction, and the height."""
    found = along_main_axis(corners, normals)
    is_upright = np.abs(normals[:, 1]) < _UPRIGHT
    size = np.hypot(normals[is_upright, 0], normals[is_upright, 2])
    across_x, across_z = normals[is_upright, 2] / size, -normals[is_upright, 0] / size
    lengths = corners[is_upright, 0] * across_x + corners[is_upright, 2] * across_z
    found[is_upright] = np.stack([lengths, corners[is_upright, 1]], axis=1)
    return found


def _faces_away(face: Face, middle: Floats) -> bool:
    normal = np.cross(face[1] - face[0], face[2] - face[0])
    return bool(normal @ (face.mean(axis=0) - middle) > 0)
