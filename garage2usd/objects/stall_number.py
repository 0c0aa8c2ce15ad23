"""Numbers painted at the mouths of stalls."""

from dataclasses import dataclass

from garage2usd.assets.flat import flat_part
from garage2usd.assets.glyphs import text_shape
from garage2usd.assets.mesh import Asset
from garage2usd.objects.kind import Kind, Spec

__all__ = ["KIND", "PAINT_LIFT_M", "NumberSpec"]

KIND = Kind(
    "stall_number", number=20, label="stall_number", cityscapes="parking", is_solid=False, scattered="StallNumbers"
)

PAINT_LIFT_M = 0.003


@dataclass(frozen=True)
class NumberSpec(Spec, kind=KIND):
    """Digits painted on the floor, their tops to -Z; origin in their middle on the floor."""

    digits: str
    height_m: float

    def asset(self) -> Asset:
        """White digits a few millimetres over the floor."""
        shape = text_shape(self.digits, self.height_m)
        return Asset((flat_part("Paint", shape, "paint_number", height_m=PAINT_LIFT_M, collider=None),))
