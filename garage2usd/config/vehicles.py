"""The catalogue of parked cars: measures that layout and meshes share."""

from dataclasses import dataclass

__all__ = ["CAR_BODIES", "DRIVEN_PAINT", "DRIVEN_PLATE", "PAINTS", "CarBody", "body_named"]


@dataclass(frozen=True)
class CarBody:
    """Outer measures of a car body in metres.

    Attributes
    ----------
    name
        Key of the body.
    length_m, width_m, height_m
        Length and height over all; width without mirrors.
    overall_width_m
        Width over the mirrors.
    wheelbase_m, front_overhang_m
        Between the axles, and from the nose to the front axle.
    wheel_radius_m
        Radius of the tyres.
    """

    name: str
    length_m: float
    width_m: float
    height_m: float
    overall_width_m: float
    wheelbase_m: float
    front_overhang_m: float
    wheel_radius_m: float

    @property
    def ahead_m(self) -> float:
        """From the rear axle to the nose."""
        return self.front_overhang_m + self.wheelbase_m

    @property
    def rear_axle_m(self) -> float:
        """From the middle of the body back to the rear axle."""
        return self.ahead_m - self.length_m / 2


CAR_BODIES: tuple[CarBody, ...] = (
    CarBody("hatchback", 4.05, 1.74, 1.47, 1.96, 2.55, 0.80, 0.31),
    CarBody("saloon", 4.70, 1.82, 1.44, 2.04, 2.80, 0.86, 0.33),
    CarBody("suv", 4.55, 1.86, 1.68, 2.08, 2.68, 0.88, 0.36),
    CarBody("van", 4.75, 1.85, 1.83, 2.10, 2.98, 0.88, 0.33),
    CarBody("pickup", 5.00, 1.87, 1.80, 2.14, 3.05, 0.88, 0.37),
    CarBody("compact_ev", 3.85, 1.75, 1.54, 1.95, 2.53, 0.72, 0.32),
)

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
"""Of the car that drives."""
DRIVEN_PLATE = "G47 B16"
"""What is to be read on its number plates, and on no other car's."""


def body_named(name: str) -> CarBody:
    """A body of the catalogue."""
    return next(body for body in CAR_BODIES if body.name == name)
