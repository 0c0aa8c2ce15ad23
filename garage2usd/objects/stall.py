"""The coated floor of stalls."""

from dataclasses import dataclass

from garage2usd.objects.kind import Kind, TilePart
from garage2usd.objects.outline import Polygon
from garage2usd.objects.panel import PanelSpec

__all__ = ["KIND", "StallSpec"]

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

    def corners(self) -> Polygon:
        """Return the corners of the panel, a parallelogram for an angled stall."""
        rise = self.slope * self.width_m / 2
        return tuple((x, z + (rise if x > 0 else -rise)) for x, z in super().corners())
