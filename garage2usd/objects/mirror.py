"""Convex mirrors at blind corners."""

from dataclasses import dataclass

import numpy as np

from garage2usd.assets.faces import box_faces, level_lathe_faces
from garage2usd.assets.mesh import Asset, Collider, make_part
from garage2usd.objects.kind import Kind, Spec

KIND = Kind("mirror", number=25, label="mirror", cityscapes="static")


@dataclass(frozen=True)
class MirrorSpec(Spec, kind=KIND):
    """A convex traffic mirror facing +Z; origin in the middle of its rim, which an arm holds from behind."""

    radius_m: float
    arm_m: float

    def asset(self) -> Asset:
        """Make the meshes of a convex mirror: glass in an orange rim, on an arm to -Z."""
        rim = [
            (-0.03, 0.0),
            (-0.03, self.radius_m),
            (0.02, self.radius_m),
            (0.02, self.radius_m * 0.94),
            (0.0, self.radius_m * 0.94),
            (0.0, 0.0),
        ]
        angles = np.linspace(np.pi / 2, 0.0, 7)
        glass = [(float(0.004 + 0.09 * np.cos(a)), float(self.radius_m * 0.93 * np.sin(a))) for a in angles]
        arm = box_faces((-0.02, -0.02, -self.arm_m), (0.02, 0.02, -0.032))
        return Asset(
            (
                make_part("Rim", level_lathe_faces(rim, segments=32), "sign_orange", collider=Collider.CONVEX_HULL),
                make_part("Glass", level_lathe_faces(glass, segments=32), "mirror"),
                make_part("Arm", arm, "steel_dark"),
            ),
        )
