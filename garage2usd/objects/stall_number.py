"""Numbers painted at the mouths of stalls."""

from dataclasses import dataclass

import shapely

from garage2usd.assets.flat import flat_part, upright_triangles
from garage2usd.assets.glyphs import text_shape
from garage2usd.assets.mesh import Asset, make_part
from garage2usd.objects.kind import Kind, Spec

__all__ = ["KIND", "PAINT_LIFT_M", "NumberFrameSpec", "NumberSpec", "WallNumberSpec"]

KIND = Kind(
    "stall_number", number=20, label="stall_number", cityscapes="parking", is_solid=False, scattered="StallNumbers"
)

PAINT_LIFT_M = 0.003
_STROKE = 0.16
"""Width of a frame's line as a share of the height of the characters in it."""


@dataclass(frozen=True)
class NumberSpec(Spec, kind=KIND):
    """Characters painted on the floor, their tops to -Z; origin in their middle on the floor."""

    digits: str
    height_m: float

    def asset(self) -> Asset:
        """Paint a few millimetres over the floor."""
        shape = text_shape(self.digits, self.height_m)
        return Asset((flat_part("Paint", shape, "paint_number", height_m=PAINT_LIFT_M, collider=None),))


@dataclass(frozen=True)
class NumberFrameSpec(Spec, kind=KIND):
    """A frame painted on the floor around a number; origin in its middle on the floor.

    Attributes
    ----------
    width_m, depth_m
        Its outer extent along X and Z.
    height_m
        Of the characters in it.
    """

    width_m: float
    depth_m: float
    height_m: float

    def asset(self) -> Asset:
        """Four lines as wide as those of the characters."""
        x, z, line_m = self.width_m / 2, self.depth_m / 2, _STROKE * self.height_m
        inner = shapely.box(line_m - x, line_m - z, x - line_m, z - line_m)
        ring = shapely.difference(shapely.box(-x, -z, x, z), inner)
        return Asset((flat_part("Paint", ring, "paint_number", height_m=PAINT_LIFT_M, collider=None),))


@dataclass(frozen=True)
class WallNumberSpec(Spec, kind=KIND):
    """Characters painted on a wall that looks to +Z; origin on the floor below their middle, on the wall's face.

    Attributes
    ----------
    height_m
        Of the characters.
    middle_m
        Of their middle over the floor.
    """

    digits: str
    height_m: float
    middle_m: float

    def asset(self) -> Asset:
        """Paint a few millimetres before the wall."""
        triangles = upright_triangles(
            text_shape(self.digits, self.height_m), middle_m=self.middle_m, front_m=PAINT_LIFT_M
        )
        return Asset((make_part("Paint", triangles, "paint_number"),))
