"""Daylight over the open ends of ramps."""

from dataclasses import dataclass

import numpy as np

from garage2usd.assets.faces import box_faces
from garage2usd.assets.mesh import Asset, make_part
from garage2usd.objects.kind import Kind, Spec

KIND = Kind("sky", number=18, label="sky", cityscapes="sky", is_solid=False, group="Ramps")


@dataclass(frozen=True)
class SkySpec(Spec, kind=KIND):
    """Daylight over a ramp's open end, on its side walls from `low_m` to `high_m`; origin as `RampSpec`."""

    width_m: float
    start_m: float
    end_m: float
    ground_m: float
    low_m: float
    high_m: float

    def asset(self) -> Asset:
        """Make the daylight mesh seen from below: a shell on the side walls, its far end closed from `ground_m` up."""
        x, near, far = self.width_m / 2, -self.start_m, -self.end_m
        shell = box_faces((-x, self.low_m, far), (x, self.high_m, near), without="bn")
        faces = [face[::-1] for face in shell]
        faces.append(
            np.array([(-x, self.ground_m, far), (x, self.ground_m, far), (x, self.high_m, far), (-x, self.high_m, far)])
        )
        return Asset((make_part("Daylight", faces, "daylight"),))
