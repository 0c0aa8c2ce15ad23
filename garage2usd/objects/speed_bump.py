"""Speed bumps, and the black and yellow rubber bars of which wheel stops are made too."""

from dataclasses import dataclass

import numpy as np

from garage2usd.assets.mesh import Asset, Collider, Face, make_part
from garage2usd.objects.kind import Kind, Spec

KIND = Kind("speed_bump", number=12, label="speed_bump", cityscapes="road")
SPEED_BUMP_WIDTH_M, SPEED_BUMP_HEIGHT_M = 0.35, 0.05
_SEGMENT_M = 0.5


def striped(profile: list[tuple[float, float]], start: float, step: float, count: int) -> Asset:
    """Make a black and yellow bar by extruding a profile (z, y) along X, from its -Z foot over the top."""
    black: list[Face] = []
    yellow: list[Face] = []
    for index in range(count):
        low, high = start + index * step, start + (index + 1) * step
        faces = yellow if index % 2 else black
        for (z0, y0), (z1, y1) in zip(profile, [*profile[1:], profile[0]], strict=True):
            faces.append(np.array([(low, y0, z0), (low, y1, z1), (high, y1, z1), (high, y0, z0)]))
        faces.append(np.array([(low, y, z) for z, y in reversed(profile)]))
        faces.append(np.array([(high, y, z) for z, y in profile]))
    parts = [
        make_part("Black", black, "rubber_black", collider=Collider.CONVEX_HULL),
        make_part("Yellow", yellow, "rubber_yellow", collider=Collider.CONVEX_HULL),
    ]
    return Asset(tuple(parts))


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
