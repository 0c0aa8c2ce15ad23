"""Speed bumps."""

from dataclasses import dataclass

import numpy as np

from garage2usd.assets.mesh import Asset
from garage2usd.objects.kind import Kind, Spec
from garage2usd.objects.striped import striped

__all__ = ["KIND", "SPEED_BUMP_HEIGHT_M", "SpeedBumpSpec"]

KIND = Kind("speed_bump", number=12, label="speed_bump", cityscapes="road")

SPEED_BUMP_WIDTH_M, SPEED_BUMP_HEIGHT_M = 0.35, 0.05
_SEGMENT_M = 0.5


@dataclass(frozen=True)
class SpeedBumpSpec(Spec, kind=KIND):
    """A rubber speed bump, long along X; origin in the middle of its foot."""

    length_m: float
    height_m: float = SPEED_BUMP_HEIGHT_M

    def asset(self) -> Asset:
        """Make the mesh of a rubber speed bump 0.35 m wide."""
        count = max(2, round(self.length_m / _SEGMENT_M))
        step = self.length_m / count
        angles = np.linspace(0.0, np.pi, 9)
        profile = [
            (float(-SPEED_BUMP_WIDTH_M / 2 * np.cos(angle)), float(self.height_m * np.sin(angle))) for angle in angles
        ]
        profile[0], profile[-1] = (-SPEED_BUMP_WIDTH_M / 2, 0.0), (SPEED_BUMP_WIDTH_M / 2, 0.0)
        return striped(profile, -self.length_m / 2, step, count)
