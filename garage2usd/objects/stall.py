"""The coated floor of stalls."""

from dataclasses import dataclass

import shapely
import shapely.affinity

from garage2usd.objects.kind import Kind, TilePart
from garage2usd.objects.panel import PanelSpec

KIND = Kind("stall", number=2, label="parking_stall", cityscapes="parking", is_solid=False, part=TilePart.PARKING)


@dataclass(frozen=True)
class StallSpec(PanelSpec, kind=KIND):
    """The floor panel of a stall.

    Attributes
    ----------
    slope
        Rise of the mouth and the rear of an angled stall along Z, per metre along X; its sides run along Z.
    """

    slope: float = 0.0

    __hash__ = PanelSpec.__hash__

    @property
    def ground(self) -> shapely.Polygon:
        """The whole panel, a parallelogram for an angled stall."""
        ground = super().ground
        return shapely.affinity.affine_transform(ground, [1, 0, self.slope, 1, 0, 0]) if self.slope else ground
