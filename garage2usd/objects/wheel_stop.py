"""Wheel stops."""

from dataclasses import dataclass

from garage2usd.assets.mesh import Asset
from garage2usd.objects.kind import Kind, Spec, TilePart
from garage2usd.objects.outline import Polygon, rectangle
from garage2usd.objects.striped import striped

__all__ = ["KIND", "WHEEL_STOP_HEIGHT_M", "WHEEL_STOP_WIDTH_M", "WheelStopSpec"]

KIND = Kind("wheel_stop", number=13, label="wheel_stop", cityscapes="static", part=TilePart.PARKING)

WHEEL_STOP_WIDTH_M, WHEEL_STOP_HEIGHT_M = 0.15, 0.10


@dataclass(frozen=True)
class WheelStopSpec(Spec, kind=KIND):
    """A wheel stop, long along X; origin in the middle of its foot."""

    length_m: float
    height_m: float = WHEEL_STOP_HEIGHT_M

    def asset(self) -> Asset:
        """A rubber bar 0.15 m wide."""
        z, y = WHEEL_STOP_WIDTH_M / 2, self.height_m
        profile = [(-z, 0.0), (-z, 0.03), (-z * 0.62, y - 0.01), (-z * 0.45, y), (z * 0.45, y), (z * 0.62, y - 0.01)]
        profile += [(z, 0.03), (z, 0.0)]
        count = max(3, round(self.length_m / 0.33))
        return striped(profile, -self.length_m / 2, self.length_m / count, count)

    def outlines(self) -> tuple[Polygon, ...]:
        """Its foot."""
        x, z = self.length_m / 2, WHEEL_STOP_WIDTH_M / 2
        return (rectangle(-x, -z, x, z),)
