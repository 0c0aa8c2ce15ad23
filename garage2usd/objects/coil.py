"""Helices between two levels: one turn of a one-way ramp between walls, and the level floor where it crosses itself."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets.faces import box_faces
from garage2usd.assets.mesh import Asset, Collider, Face, Part, make_part
from garage2usd.garage.ramp_lines import CoilLine, CoilPlaces, heights_along
from garage2usd.objects.kind import Point, Polygon, Spec
from garage2usd.objects.ramp import RampSpec

_KERB_WIDTH_M, _KERB_HEIGHT_M = 0.18, 0.15
_FLAT = 1e-4
_UP, _DOWN = (0.0, 1.0, 0.0), (0.0, -1.0, 0.0)
Floats = NDArray[np.float64]


@dataclass(frozen=True)
class CoilSpec(Spec, kind=RampSpec.kind):
    """One turn of a helix, without the level part where its ends cross.

    Its origin is on the lower floor, in the outer corner of its block. Along +Z and `turn` times +X run u and v of the
    line.

    Attributes
    ----------
    line
        Its middle line.
    profile
        (distance, height) pairs along the line.
    turn
        1 or -1.
    slab_m
        Thickness of the slab, upright.
    wall_m
        Thickness of the walls along both sides.
    clear_m
        Height of the walls over the floor beside them.
    top_m
        Height at which walls end that would be higher.
    """

    line: CoilLine
    profile: tuple[Point, ...]
    turn: int
    slab_m: float
    wall_m: float
    clear_m: float
    top_m: float

    def asset(self) -> Asset:
        """Make the meshes of a helix: floor, underside with its ends, kerbs, and walls on both sides."""
        half = self.line.width_m / 2
        floor = [*self._band(-half, 0.0, (0.0, 0.0), _UP), *self._band(0.0, half, (0.0, 0.0), _UP)]
        low = -self.slab_m
        under = self._band(-half - self.wall_m, half + self.wall_m, (low, low), _DOWN)
        return Asset(
            (
                make_part("Floor", floor, "floor_concrete", collider=Collider.MESH),
                make_part("Slab", [*under, *self._ends()], "ceiling_concrete", collider=Collider.MESH),
                self._kerb("OuterKerb", -1.0),
                self._kerb("InnerKerb", 1.0),
                self._wall("OuterWall", -1.0),
                self._wall("InnerWall", 1.0),
            )
        )

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the ground of each piece of the helix, within which no car of the lower level drives."""
        half = self.line.width_m / 2 + self.wall_m
        left, right = (self._points(side, 0.0)[:, [0, 2]].round(6).tolist() for side in (-half, half))
        return tuple(
            tuple((x, z) for x, z in (one, other, far, near))
            for (one, other), (near, far) in zip(pairwise(left), pairwise(right), strict=True)
        )

    @cached_property
    def _runs(self) -> Floats:
        return self.line.stations_m(self.profile)

    @cached_property
    def _places(self) -> CoilPlaces:
        return self.line.at(self._runs)

    @cached_property
    def _heights(self) -> Floats:
        return heights_along(self.profile, self._runs)

    def _points(self, inwards_m: float, over_m: float | Floats) -> Floats:
        """Return the points of the stations at a distance inwards and a height over the floor; shape (n, 3)."""
        u, v = self._places.beside(inwards_m).T
        return np.stack([self.turn * v, self._heights + over_m, u], axis=1)

    def _foot(self, corners: Floats) -> tuple[Floats, Floats]:
        """Return the distances along the line of corners of faces, and their distances inwards."""
        return self.line.foot(corners[:, 2], self.turn * corners[:, 0])

    def _lengths_m(self, inwards_m: float, runs_m: Floats) -> Floats:
        """Return the lengths along a parallel of the middle line, up to the stations of the middle line."""
        steps = np.diff(self._places.beside(inwards_m), axis=0)
        lengths = np.concatenate([[0.0], np.cumsum(np.sqrt((steps * steps).sum(axis=1)))])
        return np.interp(runs_m, self._runs, lengths)

    def _band(
        self,
        inwards_m: float,
        other_m: float,
        over_m: tuple[float | Floats, float | Floats],
        towards: Sequence[float],
    ) -> list[Face]:
        """Return the triangles between two lines along the helix; `towards` decides the side that they face."""
        one, other = self._points(inwards_m, over_m[0]), self._points(other_m, over_m[1])
        faces = [
            np.array(face)
            for (a, b), (c, d) in zip(pairwise(one), pairwise(other), strict=True)
            for face in ((a, b, d), (a, d, c))
        ]
        normal = np.cross(faces[0][1] - faces[0][0], faces[0][2] - faces[0][0])
        return faces if normal @ np.asarray(towards) > 0 else [face[::-1] for face in faces]

    def _inwards(self, side: float) -> tuple[float, float, float]:
        """Return the horizontal direction at the first station towards the inside, or the outside for a side of -1."""
        places = self._places
        return side * self.turn * float(places.along_u[0]), 0.0, -side * float(places.along_v[0])

    def _tops(self) -> Floats:
        """Height of the walls over the floor at each station."""
        return np.minimum(self._heights + self.clear_m, self.top_m) - self._heights

    def _bottoms(self) -> float | Floats:
        """Height over the floor at which the outer faces of walls begin."""
        return -self.slab_m

    def _wall(self, name: str, side: float) -> Part:
        face, back = (side * (self.line.width_m / 2 + depth) for depth in (0.0, self.wall_m))
        tops = self._tops()
        faces = self._band(face, face, (0.0, tops), self._inwards(-side))
        faces += self._band(back, back, (self._bottoms(), tops), self._inwards(side))
        faces += self._band(face, back, (tops, tops), _UP)

        def along(corners: Floats, normals: Floats) -> Floats:
            runs, inwards = self._foot(corners)
            is_back = (np.abs(inwards) > np.abs(face + back) / 2) & (np.abs(normals[:, 1]) < 1 / 2)
            right = side * self.turn * np.where(is_back, -1.0, 1.0)
            lengths = np.where(is_back, self._lengths_m(back, runs), self._lengths_m(face, runs))
            is_top, places = np.abs(normals[:, 1]) > 1 / 2, self.line.at(runs)
            # of a step in the height of the wall
            is_across = np.abs(self.turn * normals[:, 0] * places.along_v + normals[:, 2] * places.along_u) > 1 / 2
            lengths = np.where(is_across, np.abs(inwards), right * lengths)
            return np.stack([lengths, corners[:, 1] + is_top * (np.abs(inwards) - abs(face))], axis=1)

        return make_part(name, faces, "wall_concrete", collider=Collider.MESH, project=along)

    def _kerb(self, name: str, side: float) -> Part:
        """Make the kerb at the foot of a wall, with chevrons along its edge."""
        outer = side * self.line.width_m / 2
        inner = outer - side * _KERB_WIDTH_M
        faces = self._band(inner, inner, (0.0, _KERB_HEIGHT_M), self._inwards(-side))
        faces += self._band(inner, outer, (_KERB_HEIGHT_M, _KERB_HEIGHT_M), _UP)
        for end in (0, -1):
            corners = [
                self._points(place, over)[end]
                for place, over in ((inner, 0.0), (outer, 0.0), (outer, _KERB_HEIGHT_M), (inner, _KERB_HEIGHT_M))
            ]
            faces.append(self._facing_out(np.array(corners), end))

        def from_edge(corners: Floats, normals: Floats) -> Floats:
            runs, inwards = self._foot(corners)
            outwards = side * (inwards - inner)
            down = heights_along(self.profile, runs) + _KERB_HEIGHT_M - corners[:, 1]
            is_end = np.zeros(len(corners), dtype=bool)
            for end in (0, -1):
                is_end |= (normals @ self._away(end) > 1 - _FLAT) & (np.abs(runs - self._runs[end]) < _FLAT)
            lengths = np.where(is_end, outwards, self._lengths_m(inner, runs))
            return np.stack([lengths, np.where(is_end, -down, np.maximum(outwards, down))], axis=1)

        return make_part(name, faces, "hazard", collider=Collider.MESH, project=from_edge)

    @property
    def _slab_sides(self) -> tuple[float, float]:
        """Distances inwards of both sides of the slab."""
        half = self.line.width_m / 2 + self.wall_m
        return -half, half

    def _ends(self) -> list[Face]:
        """Return the upright faces at both ends of the slab."""
        right, left = self._slab_sides
        return [
            self._facing_out(
                np.array(
                    [
                        self._points(place, over)[end]
                        for place, over in ((right, 0.0), (left, 0.0), (left, -self.slab_m), (right, -self.slab_m))
                    ]
                ),
                end,
            )
            for end in (0, -1)
        ]

    def _facing_out(self, face: Face, end: int) -> Face:
        """Return a face across one end of the helix, turned to look away from it."""
        normal = np.cross(face[1] - face[0], face[2] - face[0])
        return face if normal @ self._away(end) > 0 else face[::-1]

    def _away(self, end: int) -> Floats:
        """Return the direction out of the helix at one of its ends."""
        places, sign = self._places, -1.0 if end == 0 else 1.0
        return sign * np.array([self.turn * float(places.along_v[end]), 0.0, float(places.along_u[end])])


@dataclass(frozen=True)
class CrossingSpec(Spec, kind=RampSpec.kind):
    """The level floor where the ends of a helix cross; origin in the middle of its surface.

    Attributes
    ----------
    width_m, depth_m
        Extents along X and Z.
    slab_m
        Thickness.
    """

    width_m: float
    depth_m: float
    slab_m: float

    def asset(self) -> Asset:
        """Make the meshes of a crossing: its floor, and the slab below."""
        x, z = self.width_m / 2, self.depth_m / 2
        low, high = (-x, -self.slab_m, -z), (x, 0.0, z)
        return Asset(
            (
                make_part("Floor", box_faces(low, high, without="lrbfn"), "floor_concrete", collider=Collider.MESH),
                make_part("Slab", box_faces(low, high, without="t"), "ceiling_concrete", collider=Collider.BOX),
            )
        )
