"""Fire shutters: steel curtains that close an opening from wall to wall, rolled up under the ceiling."""

from dataclasses import dataclass

from garage2usd.assets.faces import box_faces
from garage2usd.assets.mesh import Asset, Collider, make_part
from garage2usd.objects.kind import Kind, Polygon, Spec, VariantSet, rectangle

KIND = Kind(
    "fire_shutter",
    number=49,
    label="fire_shutter",
    cityscapes="building",
    follows=VariantSet.CEILING,
    group="FireProtection",
)

_RAIL_WIDTH_M, _RAIL_DEPTH_M = 0.1, 0.06
"""Across the wall beside the opening, and out of it."""
_BAR_DROP_M, _BAR_DEPTH_M = 0.04, 0.05
"""The bottom of the curtain below its housing."""
_MOTOR_M = (0.3, 0.22)
"""Width and height of the motor at the end of the housing."""


@dataclass(frozen=True)
class FireShutterSpec(Spec, kind=KIND):
    """An open fire shutter before a wall, front to +Z; origin on the floor in the middle of the opening.

    Attributes
    ----------
    width_m
        Width of the opening; the rails stand beside it.
    ceiling_m
        Height of the ceiling, which the housing touches.
    clear_m
        Height of the opening below the curtain.
    depth_m
        Depth of the housing, out of the wall.
    """

    width_m: float
    ceiling_m: float
    clear_m: float
    depth_m: float

    def asset(self) -> Asset:
        """Make the meshes of a housing with its motor, the end of the curtain below it, and two guide rails."""
        half, low = self.width_m / 2, self.clear_m + _BAR_DROP_M
        out = half + _RAIL_WIDTH_M
        middle = self.depth_m / 2
        housing = box_faces((-out, low, 0.0), (out, self.ceiling_m, self.depth_m), without="t")
        width, height = _MOTOR_M
        above = (low + self.ceiling_m) / 2
        motor = box_faces(
            (half - width, above - height / 2, self.depth_m), (half, above + height / 2, self.depth_m + 0.08)
        )
        bar = box_faces(
            (-half, self.clear_m, middle - _BAR_DEPTH_M / 2), (half, low, middle + _BAR_DEPTH_M / 2), without="t"
        )
        rails = [
            make_part(
                name,
                box_faces((left, 0.0, 0.0), (left + _RAIL_WIDTH_M, low, _RAIL_DEPTH_M), without="tbn"),
                "service_steel",
                collider=Collider.BOX,
            )
            for name, left in (("RailLeft", -out), ("RailRight", half))
        ]
        return Asset(
            (
                make_part("Housing", housing, "service_steel", collider=Collider.BOX),
                make_part("Motor", motor, "steel_dark"),
                make_part("Curtain", bar, "steel_dark"),
                *rails,
            )
        )

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outlines of the rails."""
        half, out = self.width_m / 2, self.width_m / 2 + _RAIL_WIDTH_M
        return tuple(rectangle(left, 0.0, right, _RAIL_DEPTH_M) for left, right in ((-out, -half), (half, out)))
