"""The catalogue of parked cars: the measures that layout and meshes share."""

import math
from dataclasses import dataclass
from enum import StrEnum

from garage2usd.common.documents import shipped_toml

SEGMENTS = ("city", "hatchback", "saloon", "estate", "suv", "mpv", "van", "pickup", "sports")
"""Body classes, whose shares differ between markets."""


class VehicleClass(StrEnum):
    """Semantic class of a parked vehicle; every body of the catalogue is a car."""

    CAR = "car"
    VAN = "van"
    TRUCK = "truck"


@dataclass(frozen=True)
class CarBody:
    """Outer measures of a car body in metres.

    Attributes
    ----------
    name
        Key of the body.
    length_m, width_m, height_m
        Overall length and height; width without mirrors.
    overall_width_m
        Width with mirrors.
    wheelbase_m, front_overhang_m
        Distance between the axles, and from the nose to the front axle.
    wheel_radius_m
        Radius of the tyres.
    mirrors_m
        Distance from the nose to the centre of the mirrors.
    segment
        Body class, one of `SEGMENTS`; empty for the user's models.
    plates
        Front and rear plate, if given: direction along Z, -1 or 1, and Y and Z of the centre in metres. If empty, they
        follow from the shape.
    semantic_class
        Class in labels.
    """

    name: str
    length_m: float
    width_m: float
    height_m: float
    overall_width_m: float
    wheelbase_m: float
    front_overhang_m: float
    wheel_radius_m: float
    mirrors_m: float
    segment: str
    plates: tuple[tuple[float, float, float], ...] = ()
    semantic_class: VehicleClass = VehicleClass.CAR

    @property
    def ahead_m(self) -> float:
        """Distance from the rear axle to the nose, in metres."""
        return self.front_overhang_m + self.wheelbase_m

    @property
    def rear_axle_m(self) -> float:
        """Distance from the centre of the body back to the rear axle, in metres."""
        return self.ahead_m - self.length_m / 2

    def fits(self, width_m: float, length_m: float, height_m: float = math.inf) -> bool:
        """True if the car with its mirrors fits a box of these measures in metres."""
        return self.overall_width_m <= width_m and self.length_m <= length_m and self.height_m <= height_m

    def half_extents_m(self, yaw_rad: float, *, width_m: float | None = None) -> tuple[float, float]:
        """Half the width and length in metres of the turned car's bounding box, with mirrors or for another width."""
        cos, sin = abs(math.cos(yaw_rad)), abs(math.sin(yaw_rad))
        wide_m = self.overall_width_m if width_m is None else width_m
        return (wide_m * cos + self.length_m * sin) / 2, (self.length_m * cos + wide_m * sin) / 2


CAR_BODIES: tuple[CarBody, ...] = tuple(
    CarBody(name, **measures) for name, measures in shipped_toml("garage2usd.config", "car_bodies").items()
)

DRIVEN_BODIES = CAR_BODIES[:6]
"""Bodies that drive: a garage's driven car is the longest of them that lies within its design car."""

PAINTS: tuple[str, ...] = (
    "white",
    "silver",
    "black",
    "grey",
    "blue",
    "red",
    "green",
    "champagne",
    "orange",
)

DRIVEN_PAINT = "blue"
"""Paint of the driven car."""
DRIVEN_PLATE = "G47 B16"
"""Text on the driven car's number plates; no other car has it."""


_BY_NAME = {body.name: body for body in CAR_BODIES}


def body_named(name: str) -> CarBody:
    """Return a body of the catalogue by its name."""
    return _BY_NAME[name]
