"""Wheel stops at the end of stalls."""

from dataclasses import dataclass, replace

from garage2usd.assets.mesh import Asset
from garage2usd.objects.kind import Kind, Polygon, Spec, TilePart, rectangle
from garage2usd.objects.speed_bump import striped

KIND = Kind("wheel_stop", number=13, label="wheel_stop", cityscapes="static", part=TilePart.PARKING)

WHEEL_STOP_WIDTH_M, WHEEL_STOP_HEIGHT_M = 0.15, 0.10
_SEGMENT_M = 0.33
"""Approximate length of a wheel stop's black and yellow segments, at least three."""


@dataclass(frozen=True)
class WheelStopSpec(Spec, kind=KIND):
    """A wheel stop, long along X; origin in the middle of its foot."""

    length_m: float
    height_m: float = WHEEL_STOP_HEIGHT_M
    gap_m: float = 0.0
    """Gap in the middle of a wheel stop that is a pair of blocks, in metres."""

    def asset(self) -> Asset:
        """Make the mesh of a wheel stop: a rubber bar 0.15 m wide, or two in line."""
        z, y = WHEEL_STOP_WIDTH_M / 2, self.height_m
        profile = [(-z, 0.0), (-z, 0.03), (-z * 0.62, y - 0.01), (-z * 0.45, y), (z * 0.45, y), (z * 0.62, y - 0.01)]
        profile += [(z, 0.03), (z, 0.0)]
        bars = [
            striped(profile, start, (end - start) / count, count)
            for start, end in self._spans()
            for count in [max(3, round((end - start) / _SEGMENT_M))]
        ]
        if len(bars) == 1:
            return bars[0]
        named = zip(("Left", "Right"), bars, strict=True)
        return Asset(tuple(replace(part, name=f"{side}{part.name}") for side, bar in named for part in bar.parts))

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outline of each block of the wheel stop."""
        z = WHEEL_STOP_WIDTH_M / 2
        return tuple(rectangle(start, -z, end, z) for start, end in self._spans())

    def _spans(self) -> tuple[tuple[float, float], ...]:
        """Return the start and end of each bar of the wheel stop along X."""
        end, inner = self.length_m / 2, self.gap_m / 2
        return ((-end, -inner), (inner, end)) if self.gap_m else ((-end, end),)
