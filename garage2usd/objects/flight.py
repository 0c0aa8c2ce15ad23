"""Ramps between two levels: one-way slabs from wall to wall."""

from dataclasses import dataclass

import numpy as np

from garage2usd.assets.faces import moved
from garage2usd.assets.mesh import Asset, Collider, Face, make_part
from garage2usd.objects.kind import Point, Polygon, Spec, rectangle
from garage2usd.objects.ramp import RampSpec, grooved, kerb, strip


@dataclass(frozen=True)
class FlightSpec(Spec, kind=RampSpec.kind):
    """A straight ramp from a level to the next one above.

    Its origin is on the lower floor, in the middle of its foot; it rises towards -Z.

    Attributes
    ----------
    width_m
        Width between the walls.
    profile
        (run, height) pairs along the floor, from the foot to the head.
    slab_m
        Thickness of the slab, upright.
    """

    width_m: float
    profile: tuple[Point, ...]
    slab_m: float

    def asset(self) -> Asset:
        """Make the meshes of a ramp between levels: grooved floor, slab with its ends, and kerbs along the walls."""
        half = self.width_m / 2
        underside = [face[::-1] for face in moved(strip(half, self.profile), (0.0, -self.slab_m, 0.0))]
        ends = [self._end(0, -1.0), self._end(-1, 1.0)]
        return Asset(
            (
                make_part("Floor", strip(half, grooved(self.profile)), "floor_concrete", collider=Collider.MESH),
                make_part("Slab", [*underside, *ends], "ceiling_concrete", collider=Collider.MESH),
                kerb("LeftKerb", half, -1.0, self.profile, is_open_at_top=True),
                kerb("RightKerb", half, 1.0, self.profile, is_open_at_top=True),
            )
        )

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outline of the ramp, below which no car drives."""
        half, run = self.width_m / 2, self.profile[-1][0]
        return (rectangle(-half, -run, half, 0.0),)

    def _end(self, index: int, side: float) -> Face:
        """Return the upright face at one end of the slab; `side` is 1 at the head."""
        (run, top), half = self.profile[index], side * self.width_m / 2
        low = top - self.slab_m
        return np.array([(half, low, -run), (-half, low, -run), (-half, top, -run), (half, top, -run)])
