"""Outer walls, and the posts between them."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets.faces import box_faces
from garage2usd.assets.mesh import Asset, Collider, Face, Part, along_main_axis, make_part
from garage2usd.objects.kind import Kind, Polygon, Spec, rectangle, square

KIND = Kind("wall", number=4, label="wall", cityscapes="wall", group="Walls")

DADO_M = 1.1
"""Usual height of the painted band at the foot of walls, and period of its texture."""
DADO_STRIPE_M = 0.12
"""Height of the stripe over a wall's painted band."""


@dataclass(frozen=True)
class WallSpec(Spec, kind=KIND):
    """A straight outer wall; origin at the foot of its inner face, in the middle; that face looks to +Z.

    Attributes
    ----------
    length_m, height_m, thickness_m
        Extent of the wall.
    dado_m
        Height of the painted band at the wall's foot; 0 for none.
    has_stripe
        True if a stripe runs over the band.
    """

    length_m: float
    height_m: float
    thickness_m: float
    dado_m: float = DADO_M
    has_stripe: bool = True

    def asset(self) -> Asset:
        """Make the meshes of a wall with its painted band and stripe."""
        half, top = self.length_m / 2, self.dado_m

        def front(low: float, high: float) -> list[Face]:
            return box_faces((-half, low, -self.thickness_m), (half, high, 0), without="lrbtn")

        parts = [dado_part("Band", front(0.0, top), top)] if top else []
        if self.has_stripe:
            parts.append(make_part("Stripe", front(top, top + DADO_STRIPE_M), "band_stripe"))
            top += DADO_STRIPE_M
        faces = box_faces((-half, top, -self.thickness_m), (half, self.height_m, 0), without="lrbtn")
        faces += box_faces((-half, 0, -self.thickness_m), (half, self.height_m, 0), without="f")

        def from_top(corners: NDArray[np.float64], normals: NDArray[np.float64]) -> NDArray[np.float64]:
            # continue the texture of the inner face around its edges, and align the formwork with the top
            is_upright = np.abs(normals[:, 1]) < 1 / 2
            shift = np.stack([half * normals[:, 0], -self.height_m * is_upright], axis=1)
            laid: NDArray[np.float64] = along_main_axis(corners, normals) + shift
            return laid

        parts.append(make_part("Concrete", faces, "wall_concrete", collider=Collider.BOX, project=from_top))
        return Asset(tuple(parts))

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outline of the wall on the floor."""
        return (rectangle(-self.length_m / 2, -self.thickness_m, self.length_m / 2, 0.0),)


def dado_part(name: str, faces: Sequence[Face], top_m: float, *, collider: Collider | None = None) -> Part:
    """Make the painted band of a wall from the floor up, as high as one period of its texture."""

    def stretched(face: NDArray[np.float64], normal: NDArray[np.float64]) -> NDArray[np.float64]:
        x, y, z = face.T
        across = np.where(np.abs(normal[:, 2]) > np.abs(normal[:, 0]), x * np.sign(normal[:, 2]), -z * normal[:, 0])
        return np.stack([across, y * (DADO_M / top_m)], axis=1)

    return make_part(name, faces, "wall_band", collider=collider, project=None if top_m == DADO_M else stretched)


@dataclass(frozen=True)
class WallPostSpec(Spec, kind=KIND):
    """The square post at a convex corner of two walls; origin in the middle of its foot."""

    side_m: float
    height_m: float

    def asset(self) -> Asset:
        """Make the mesh of a concrete wall post."""
        half = self.side_m / 2
        faces = box_faces((-half, 0, -half), (half, self.height_m, half))
        return Asset((make_part("Concrete", faces, "wall_concrete", collider=Collider.BOX),))

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outline of the wall post on the floor."""
        return (square(self.side_m),)
