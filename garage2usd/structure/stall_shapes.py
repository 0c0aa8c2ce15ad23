"""Shapes of parking stalls: size and angle to the aisle, and the floor that they need along it and across it."""

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache

from garage2usd.garage.kinds import StallKind

__all__ = ["PARALLEL_DEG", "PERPENDICULAR_DEG", "StallShape", "kind_of_angle", "slope_of_angle"]

PERPENDICULAR_DEG, PARALLEL_DEG = 90.0, 0.0
_MM_PER_M = 1000


@dataclass(frozen=True)
class StallShape:
    """The size of a stall and its angle to the aisle.

    Attributes
    ----------
    width_m, length_m
        Sides of the rectangle for the car.
    angle_deg
        Angle between the stall's long sides and the aisle: 90 for perpendicular stalls, 0 for parallel ones.
    size
        Name of the size class.

    Notes
    -----
    With width w, length l and angle a, angled stalls are parallelograms of pitch w / sin a and depth
    l sin a + w cos a. Both are rounded up to the millimetre.
    """

    width_m: float
    length_m: float
    angle_deg: float = PERPENDICULAR_DEG
    size: str = "standard"

    @cached_property
    def kind(self) -> StallKind:
        """Orientation of the stall relative to its lane."""
        return kind_of_angle(self.angle_deg)

    @cached_property
    def pitch_m(self) -> float:
        """Length of the mouth, along the aisle."""
        if self.kind is StallKind.PARALLEL:
            return self.length_m
        return self.width_m if self.kind is StallKind.PERPENDICULAR else _rounded_up(self.width_m / self._sin)

    @cached_property
    def depth_m(self) -> float:
        """Extent across the aisle, from the mouth to the rear."""
        if self.kind is StallKind.PARALLEL:
            return self.width_m
        if self.kind is StallKind.PERPENDICULAR:
            return self.length_m
        return _rounded_up(self.length_m * self._sin + self.width_m * self._cos)

    @cached_property
    def slope(self) -> float:
        """Offset of the sides along the aisle per metre of depth: cot a for angled stalls, else 0."""
        return slope_of_angle(self.angle_deg)

    @property
    def _sin(self) -> float:
        return math.sin(math.radians(self.angle_deg))

    @property
    def _cos(self) -> float:
        return math.cos(math.radians(self.angle_deg))


def kind_of_angle(angle_deg: float) -> StallKind:
    """Return the kind of stall with an angle to the lane."""
    if angle_deg == PARALLEL_DEG:
        return StallKind.PARALLEL
    return StallKind.PERPENDICULAR if angle_deg == PERPENDICULAR_DEG else StallKind.ANGLED


@lru_cache(maxsize=64)
def slope_of_angle(angle_deg: float) -> float:
    """Return the cotangent of the angle of angled stalls, and 0 for others."""
    if kind_of_angle(angle_deg) is not StallKind.ANGLED:
        return 0.0
    return round(1 / math.tan(math.radians(angle_deg)), 9)


def _rounded_up(length_m: float) -> float:
    return math.ceil(round(length_m * _MM_PER_M, 6)) / _MM_PER_M
