"""The catalogue of parked cars: the measures that layout and meshes share."""

import math
from dataclasses import dataclass
from enum import StrEnum

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


CAR_BODIES: tuple[CarBody, ...] = (
    CarBody("hatchback", 4.05, 1.74, 1.47, 1.96, 2.55, 0.80, 0.31, 1.45, "hatchback"),
    CarBody("saloon", 4.70, 1.82, 1.44, 2.04, 2.80, 0.86, 0.33, 1.69, "saloon"),
    CarBody("suv", 4.55, 1.86, 1.68, 2.08, 2.68, 0.88, 0.36, 1.51, "suv"),
    CarBody("van", 4.75, 1.85, 1.83, 2.10, 2.98, 0.88, 0.33, 1.21, "mpv"),
    CarBody("pickup", 5.00, 1.87, 1.80, 2.14, 3.05, 0.88, 0.37, 1.65, "pickup"),
    CarBody("compact_ev", 3.85, 1.75, 1.54, 1.95, 2.53, 0.72, 0.32, 1.13, "hatchback"),
    CarBody("microcar", 2.70, 1.66, 1.55, 1.88, 1.82, 0.50, 0.27, 0.88, "city"),
    CarBody("city_car", 3.57, 1.64, 1.49, 1.90, 2.42, 0.64, 0.285, 1.13, "city"),
    CarBody("tall_city_car", 3.40, 1.475, 1.78, 1.74, 2.40, 0.58, 0.265, 0.86, "city"),
    CarBody("supermini", 3.97, 1.73, 1.43, 1.97, 2.52, 0.80, 0.31, 1.38, "hatchback"),
    CarBody("compact_hatch", 4.29, 1.79, 1.46, 2.05, 2.64, 0.86, 0.32, 1.54, "hatchback"),
    CarBody("electric_hatch", 4.27, 1.81, 1.56, 2.06, 2.77, 0.78, 0.35, 1.13, "hatchback"),
    CarBody("small_saloon", 4.34, 1.74, 1.51, 1.99, 2.63, 0.80, 0.31, 1.45, "saloon"),
    CarBody("executive_saloon", 4.94, 1.87, 1.46, 2.11, 2.96, 0.86, 0.35, 1.84, "saloon"),
    CarBody("luxury_saloon", 5.20, 1.92, 1.50, 2.14, 3.17, 0.88, 0.36, 1.94, "saloon"),
    CarBody("fastback", 4.85, 1.88, 1.44, 2.12, 2.92, 0.86, 0.35, 1.52, "saloon"),
    CarBody("small_estate", 4.58, 1.79, 1.49, 2.04, 2.69, 0.88, 0.32, 1.60, "estate"),
    CarBody("estate", 4.79, 1.84, 1.48, 2.08, 2.85, 0.88, 0.33, 1.70, "estate"),
    CarBody("large_estate", 4.97, 1.89, 1.50, 2.13, 2.95, 0.88, 0.35, 1.85, "estate"),
    CarBody("small_suv", 4.16, 1.79, 1.59, 2.04, 2.57, 0.84, 0.34, 1.36, "suv"),
    CarBody("electric_suv", 4.64, 1.90, 1.60, 2.15, 2.92, 0.85, 0.37, 1.29, "suv"),
    CarBody("coupe_suv", 4.68, 1.92, 1.61, 2.17, 2.86, 0.88, 0.37, 1.58, "suv"),
    CarBody("large_suv", 4.94, 1.98, 1.76, 2.21, 2.96, 0.90, 0.38, 1.64, "suv"),
    CarBody("full_size_suv", 5.36, 2.06, 1.92, 2.38, 3.07, 1.00, 0.40, 1.83, "suv"),
    CarBody("off_roader", 4.32, 1.87, 1.86, 2.12, 2.75, 0.78, 0.39, 1.70, "suv"),
    CarBody("compact_mpv", 4.36, 1.81, 1.65, 2.08, 2.72, 0.86, 0.32, 1.19, "mpv"),
    CarBody("large_mpv", 5.16, 1.99, 1.77, 2.26, 3.06, 0.96, 0.35, 1.34, "mpv"),
    CarBody("tall_mpv", 4.98, 1.85, 1.93, 2.12, 3.00, 0.88, 0.35, 1.20, "mpv"),
    CarBody("small_van", 4.42, 1.83, 1.82, 2.09, 2.72, 0.88, 0.32, 1.29, "van"),
    CarBody("panel_van", 4.96, 1.92, 1.98, 2.27, 3.02, 0.93, 0.34, 1.15, "van"),
    CarBody("crew_van", 5.34, 1.93, 1.96, 2.28, 3.40, 0.92, 0.34, 1.18, "van"),
    CarBody("small_pickup", 4.47, 1.73, 1.59, 1.97, 2.74, 0.81, 0.32, 1.40, "pickup"),
    CarBody("crew_pickup", 5.33, 1.87, 1.82, 2.15, 3.13, 0.98, 0.39, 1.74, "pickup"),
    CarBody("full_size_pickup", 5.60, 2.03, 1.94, 2.42, 3.50, 0.96, 0.41, 1.91, "pickup"),
    CarBody("roadster", 3.92, 1.74, 1.23, 1.93, 2.31, 0.82, 0.31, 1.77, "sports"),
    CarBody("coupe", 4.45, 1.79, 1.35, 2.02, 2.60, 0.86, 0.33, 1.76, "sports"),
    CarBody("sports_car", 4.52, 1.86, 1.29, 2.06, 2.45, 1.02, 0.34, 1.57, "sports"),
    CarBody("muscle_coupe", 4.80, 1.92, 1.39, 2.12, 2.72, 0.93, 0.35, 1.99, "sports"),
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
