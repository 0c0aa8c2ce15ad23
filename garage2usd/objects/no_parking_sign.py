"""Free-standing no-parking signs."""

from dataclasses import dataclass

import numpy as np

from garage2usd.assets.faces import disc_faces, upright_lathe_faces
from garage2usd.assets.mesh import Asset, Collider, make_part
from garage2usd.objects.kind import Kind, Polygon, Spec, TilePart, rectangle

KIND = Kind("no_parking_sign", number=14, label="traffic_sign", cityscapes="traffic sign", part=TilePart.PARKING)

_DISC_RADIUS_M = 0.3
SIGN_FOOT_M = 0.2
"""Radius of the foot."""


@dataclass(frozen=True)
class NoParkingSignSpec(Spec, kind=KIND):
    """A free-standing no-parking sign facing +Z; origin in the middle of its foot."""

    def asset(self) -> Asset:
        """Make the meshes of a no-parking sign: a disc on a post with a heavy foot."""
        foot = upright_lathe_faces([(0.0, SIGN_FOOT_M), (0.05, SIGN_FOOT_M), (0.09, 0.06)], segments=20)
        post = upright_lathe_faces([(0.09, 0.025), (1.45, 0.025)], segments=10)
        centre = 1.7
        back = disc_faces(_DISC_RADIUS_M, 0.0, 0.012, centre)
        blue = disc_faces(0.245, 0.012, 0.016, centre)
        slash = np.array([(-0.2, -0.14, 0), (-0.14, -0.2, 0), (0.2, 0.14, 0), (0.14, 0.2, 0)]) + np.array(
            (0, centre, 0.0185)
        )
        return Asset(
            (
                make_part("Foot", foot, "rubber_black", collider=Collider.CONVEX_HULL),
                make_part("Post", post, "steel_galvanised", collider=Collider.CONVEX_HULL),
                make_part("Ring", back, "sign_ring", collider=Collider.CONVEX_HULL),
                make_part("Face", blue, "sign_blue"),
                make_part("Slash", [slash], "sign_ring"),
            ),
        )

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outline of the no-parking sign: as wide as its disc, as deep as its foot."""
        return (rectangle(-_DISC_RADIUS_M, -SIGN_FOOT_M, _DISC_RADIUS_M, SIGN_FOOT_M),)
