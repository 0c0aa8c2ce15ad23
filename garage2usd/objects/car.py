"""Parked cars."""

from dataclasses import dataclass, replace
from typing import Self

from garage2usd.assets.car_wheels import steered, steered_box
from garage2usd.assets.cars import car, dusty
from garage2usd.assets.mesh import Asset
from garage2usd.config.vehicles import CAR_BODIES, PAINTS
from garage2usd.objects.kind import Kind, Look, Spec, TilePart, VariantSet
from garage2usd.objects.outline import Polygon, rectangle

__all__ = ["KIND", "PAINT_SET", "CarSpec"]

KIND = Kind("car", number=16, label="car", cityscapes="car", follows=VariantSet.OCCUPANCY, part=TilePart.PARKING)

PAINT_SET = "paint"
"""Variant set of every car's asset."""
_BODIES = {body.name: body for body in CAR_BODIES}
_ARCHES_M = 0.01
"""How far the wheel arches stand out of a car's body."""
_HALF_MIRROR_M = 0.1
"""Of a car's mirrors, along it."""


@dataclass(frozen=True)
class CarSpec(Spec, kind=KIND):
    """A parked car; origin in the middle of its footprint, nose to -Z.

    Attributes
    ----------
    body, paint
        Keys of the catalogue.
    steer_deg
        How far its front wheels are turned to the left, at most `garage2usd.assets.car_wheels.MOST_STEER_DEG` either
        way.
    is_dusty
        Whether its flanks are covered with dust.
    """

    body: str
    paint: str
    steer_deg: float = 0.0
    is_dusty: bool = False

    @property
    def shape(self) -> Self:
        """The same body in the first paint, as the paints are variants of one asset."""
        return replace(self, paint=PAINTS[0])

    @property
    def look(self) -> Look:
        """Its paint."""
        return ((PAINT_SET, self.paint),)

    def asset(self) -> Asset:
        """The body with its wheels and dust, in every paint."""
        body = _BODIES[self.body]
        asset = steered(car(body), body, self.steer_deg)
        return dusty(asset, body) if self.is_dusty else asset

    def outlines(self) -> tuple[Polygon, ...]:
        """Its body with the wheel arches, its mirrors, and its front wheels where they are turned."""
        body = _BODIES[self.body]
        side, end, mirrors = body.width_m / 2 + _ARCHES_M, body.length_m / 2, body.overall_width_m / 2
        first, last = body.mirrors_m - _HALF_MIRROR_M, body.mirrors_m + _HALF_MIRROR_M
        outlines = rectangle(-side, -end, side, end), rectangle(-mirrors, first - end, mirrors, last - end)
        if not self.steer_deg:
            return outlines
        wheels, front, rear = steered_box(body, self.steer_deg)
        return *outlines, rectangle(-wheels, front, wheels, rear)
