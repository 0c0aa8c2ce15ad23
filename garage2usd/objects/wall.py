"""Outer walls, and the posts between them."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets.faces import box_faces
from garage2usd.assets.mesh import Asset, Collider, Face, make_part
from garage2usd.objects.kind import Kind, Spec
from garage2usd.objects.outline import Polygon, rectangle, square

__all__ = ["KIND", "WallPostSpec", "WallSpec"]

KIND = Kind("wall", number=4, label="wall", cityscapes="wall", group="Walls")

_BAND_TOP_M = 1.1
_STRIPE_M = 0.12


@dataclass(frozen=True)
class WallSpec(Spec, kind=KIND):
    """A straight wall; origin at the middle of its inner face's foot, which looks to +Z."""

    length_m: float
    height_m: float
    thickness_m: float

    def asset(self) -> Asset:
        """A wall with a painted band and a stripe over it."""
        half = self.length_m / 2
        levels = (
            ("Band", "wall_band", 0.0, _BAND_TOP_M),
            ("Stripe", "band_stripe", _BAND_TOP_M, _BAND_TOP_M + _STRIPE_M),
        )
        faces: list[Face] = []
        parts = []
        for name, material, low, high in levels:
            face = box_faces((-half, low, -self.thickness_m), (half, high, 0), without="lrbtn")
            parts.append(make_part(name, face, material))
        top = _BAND_TOP_M + _STRIPE_M
        faces += box_faces((-half, top, -self.thickness_m), (half, self.height_m, 0), without="lrbtn")
        faces += box_faces((-half, 0, -self.thickness_m), (half, self.height_m, 0), without="f")

        def from_top(face: NDArray[np.float64], _normal: NDArray[np.float64]) -> NDArray[np.float64]:
            return np.stack([face[:, 0] + face[:, 2], face[:, 1] - self.height_m - face[:, 2]], axis=1)

        parts.append(make_part("Concrete", faces, "wall_concrete", collider=Collider.BOX, project=from_top))
        return Asset(tuple(parts))

    def outlines(self) -> tuple[Polygon, ...]:
        """Its section."""
        return (rectangle(-self.length_m / 2, -self.thickness_m, self.length_m / 2, 0.0),)


@dataclass(frozen=True)
class WallPostSpec(Spec, kind=KIND):
    """The square piece that closes a convex corner of two walls; origin in the middle of its foot."""

    side_m: float
    height_m: float

    def asset(self) -> Asset:
        """The post."""
        half = self.side_m / 2
        faces = box_faces((-half, 0, -half), (half, self.height_m, half))
        return Asset((make_part("Concrete", faces, "wall_concrete", collider=Collider.BOX),))

    def outlines(self) -> tuple[Polygon, ...]:
        """Its section."""
        return (square(self.side_m),)
