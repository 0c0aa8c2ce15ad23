"""Ramps from a portal to the ground outside."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets.faces import box_faces, moved
from garage2usd.assets.mesh import Asset, Collider, Face, Part, make_part
from garage2usd.objects.kind import Kind, Point, Polygon, Spec, rectangle
from garage2usd.objects.wall import DADO_M, DADO_STRIPE_M

KIND = Kind("ramp", number=17, label="ramp", cityscapes="road", group="Ramps")

Profile = Sequence[tuple[float, float]]
_GROOVE_PITCH_M = 0.25
_GROOVE_WIDTH_M = 0.05
_GROOVE_DEPTH_M = 0.008
_KERB_WIDTH_M = 0.18
_KERB_HEIGHT_M = 0.15
_PROUD_M = 0.004
_HEADER_M = 0.3
_DRAIN_M = 0.2
_SLAT_M = 0.04
_FLAT = 1e-6


@dataclass(frozen=True)
class RampSpec(Spec, kind=KIND):
    """A straight ramp up to the ground outside; origin and direction as `PortalSpec`, rising towards -Z.

    Attributes
    ----------
    width_m
        Width between the side walls.
    wall_m
        Thickness of the side walls.
    threshold_width_m
        Width of the floor in the door's opening.
    profile
        (run, height) pairs along the floor, from the back of the door's wall to the far end.
    cover_end_m, cover_height_m
        Run where the slab over the ramp's foot ends, and height of that slab's underside.
    wall_top_m
        Height of the side walls' tops.
    dado_m, has_stripe
        Painted band and stripe of the side walls, as in `WallSpec`.
    """

    width_m: float
    wall_m: float
    threshold_width_m: float
    profile: tuple[Point, ...]
    cover_end_m: float
    cover_height_m: float
    wall_top_m: float
    dado_m: float = DADO_M
    has_stripe: bool = True

    def asset(self) -> Asset:
        """Make the meshes of a ramp: grooved floor, kerbs, side walls, a slab over its foot and a drain."""
        half, (start, _), (end, _) = self.width_m / 2, self.profile[0], self.profile[-1]
        cover_end, cover_low, cover_high = self.cover_end_m, self.cover_height_m, self.profile[-1][1]
        threshold = strip(self.threshold_width_m / 2, [(0.0, 0.0), (start, 0.0)])
        slab = box_faces((-half, cover_low, -cover_end + _HEADER_M), (half, cover_high, -start))
        header = box_faces((-half, cover_low, -cover_end), (half, self.wall_top_m, -cover_end + _HEADER_M))
        parts = [
            make_part("Threshold", threshold, "floor_concrete", collider=Collider.MESH),
            make_part("Floor", strip(half, grooved(self.profile)), "floor_concrete", collider=Collider.MESH),
            make_part("Cover", slab, "ceiling_concrete", collider=Collider.BOX),
            make_part("Header", header, "wall_concrete", collider=Collider.BOX),
            make_part("Drain", _drain(half - _KERB_WIDTH_M, start), "steel_dark"),
        ]
        for name, side in (("Left", -1.0), ("Right", 1.0)):
            inner, outer = sorted((side * half, side * (half + self.wall_m)))
            wall = box_faces((inner, 0.0, -end), (outer, self.wall_top_m, -start))
            face = side * (half - _PROUD_M)
            parts += [
                make_part(f"{name}Wall", wall, "wall_concrete", collider=Collider.BOX),
                *self._dado(name, face),
                kerb(f"{name}Kerb", half, side, self.profile),
            ]
        return Asset(tuple(parts))

    def _dado(self, name: str, face_m: float) -> list[Part]:
        """Make the painted band and the stripe at the foot of a ramp's side wall."""
        top, parts = self.dado_m, []
        if top:
            runs, heights = zip(*self.profile, strict=True)

            def from_floor(corners: NDArray[np.float64], _normals: NDArray[np.float64]) -> NDArray[np.float64]:
                x, y, z = corners.T
                return np.stack([np.sign(x) * z, (y - np.interp(-z, runs, heights)) * (DADO_M / top)], axis=1)

            ribbon = _ribbon(face_m, self.profile, 0.0, top)
            parts.append(make_part(f"{name}Band", ribbon, "wall_band", project=from_floor))
        if self.has_stripe:
            stripe = _ribbon(face_m, self.profile, top, top + DADO_STRIPE_M)
            parts.append(make_part(f"{name}Stripe", stripe, "band_stripe"))
        return parts

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outlines of the ramp's side walls."""
        inner, outer = self.width_m / 2, self.width_m / 2 + self.wall_m
        near, far = -self.profile[0][0], -self.profile[-1][0]
        return rectangle(-outer, far, -inner, near), rectangle(inner, far, outer, near)


def strip(half_m: float, profile: Profile) -> list[Face]:
    """Return the faces of a ramp's floor along a profile, facing up."""
    return [
        np.array([(-half_m, y0, -r0), (half_m, y0, -r0), (half_m, y1, -r1), (-half_m, y1, -r1)])
        for (r0, y0), (r1, y1) in pairwise(profile)
    ]


def _ribbon(x: float, profile: Profile, low_m: float, high_m: float) -> list[Face]:
    """Return an upright ribbon at `x` that follows a ramp's profile and faces its middle."""
    faces = [
        np.array([(x, y0 + low_m, -r0), (x, y0 + high_m, -r0), (x, y1 + high_m, -r1), (x, y1 + low_m, -r1)])
        for (r0, y0), (r1, y1) in pairwise(profile)
    ]
    return faces if x > 0 else [face[::-1] for face in faces]


def kerb(name: str, half_m: float, side: float, profile: Profile, *, is_open_at_top: bool = False) -> Part:
    """Make the kerb at the foot of a ramp's side wall, with chevrons along its inner edge."""
    outer, inner = side * half_m, side * (half_m - _KERB_WIDTH_M)
    faces = _ribbon(inner, profile, 0.0, _KERB_HEIGHT_M)
    low, high = sorted((inner, outer))
    faces += moved(strip((high - low) / 2, profile), ((low + high) / 2, _KERB_HEIGHT_M, 0.0))
    start, y = profile[0]
    faces += box_faces((low, y, -start - 1), (high, y + _KERB_HEIGHT_M, -start), without="lrbtn")
    if is_open_at_top:
        end, y = profile[-1]
        faces += box_faces((low, y, -end), (high, y + _KERB_HEIGHT_M, -end + 1), without="lrbtf")

    runs, heights = zip(*profile, strict=True)

    def from_edge(corners: NDArray[np.float64], normals: NDArray[np.float64]) -> NDArray[np.float64]:
        x, y, z = corners.T
        outwards = side * (x - inner)
        down = np.interp(-z, runs, heights) + _KERB_HEIGHT_M - y
        is_end = np.abs(normals[:, 2]) > 1 - _FLAT
        return np.stack([np.where(is_end, outwards, -z), np.where(is_end, -down, np.maximum(outwards, down))], axis=1)

    return make_part(name, faces, "hazard", collider=Collider.MESH, project=from_edge)


def grooved(profile: Profile) -> list[tuple[float, float]]:
    """Return a ramp's profile with transverse grooves for grip in its slopes."""
    runs, heights = zip(*profile, strict=True)
    grooved = [profile[0]]
    half, edge = _GROOVE_WIDTH_M / 2, 0.004
    for (r0, y0), (r1, y1) in pairwise(profile):
        count = int((r1 - r0) / _GROOVE_PITCH_M) if y1 > y0 else 0
        for middle in (r0 + (np.arange(count) + 0.5) * (r1 - r0) / max(count, 1)).tolist():
            rim, floor = (half, 0.0), (half - edge, _GROOVE_DEPTH_M)
            for side, (away, depth) in ((-1, rim), (-1, floor), (1, floor), (1, rim)):
                offset = side * away
                grooved.append((middle + offset, float(np.interp(middle + offset, runs, heights)) - depth))
        grooved.append((r1, y1))
    return grooved


def _drain(half_m: float, start_m: float) -> list[Face]:
    """Return the slats of the channel drain across a ramp's foot."""
    faces: list[Face] = []
    for index in range(int(_DRAIN_M / _SLAT_M)):
        far = start_m + 0.1 + index * _SLAT_M
        faces += box_faces((-half_m, 0.0, -far - _SLAT_M * 0.6), (half_m, 0.004, -far), without="b")
    return faces
