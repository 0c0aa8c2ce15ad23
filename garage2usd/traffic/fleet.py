"""Bodies of the cars in traffic, and the cars that are parked when it begins."""

from dataclasses import dataclass

import numpy as np

from garage2usd.as_built.garage import BuiltGarage
from garage2usd.config.vehicles import CAR_BODIES, PAINTS, CarBody
from garage2usd.driving import DesignCar, Pose
from garage2usd.driving.tracks import Agent, AgentClass
from garage2usd.maps.parked_cars import ParkedCar, parked_cars
from garage2usd.native import elementary

_ALIKE_M = 0.06
HULLS = (
    DesignCar(length_m=5.0, width_m=1.92, wheelbase_m=2.9, rear_overhang_m=1.2, track_m=1.62),
    DesignCar(),
)
"""Outlines for which paths are proven; a garage is operated with the first that most of its stalls take."""


@dataclass(frozen=True, eq=False)
class Car:
    """A car in traffic.

    Attributes
    ----------
    number
        Its number, from 1.
    body, paint
        Its body and paint.
    stands
        The car in the stage, for one that is parked at the start.
    """

    number: int
    body: CarBody | None
    paint: str
    stands: ParkedCar | None = None

    @property
    def agent(self) -> Agent:
        """The car as an agent of tracks."""
        assert self.body is not None
        body = self.body
        return Agent(
            f"car_{self.number:04}",
            AgentClass(body.semantic_class.value),
            body.length_m,
            body.width_m,
            body.height_m,
            body.rear_axle_m,
            body.wheelbase_m,
            body.name,
            self.paint,
            self.stands.prim if self.stands else "",
        )

    @property
    def parked_pose(self) -> Pose | None:
        """Pose of the rear axle of a car that is parked at the start."""
        if self.stands is None or self.body is None:
            return None
        (x, z), yaw_rad = self.stands.middle_m, self.stands.yaw_rad
        back_m = self.body.rear_axle_m
        return Pose(x + elementary.sin(yaw_rad) * back_m, z + elementary.cos(yaw_rad) * back_m, yaw_rad)


def standing_cars(garage: BuiltGarage) -> list[Car]:
    """Return the cars that are parked in a garage, with the bodies of the catalogue that have their measures."""
    found = []
    for number, each in enumerate(parked_cars(garage), 1):
        body = min(
            CAR_BODIES,
            key=lambda known: (
                abs(known.length_m - each.length_m)
                + abs(known.width_m - each.width_m)
                + abs(known.height_m - each.height_m)
            ),
        )
        is_same = max(abs(body.length_m - each.length_m), abs(body.width_m - each.width_m)) <= _ALIKE_M
        found.append(Car(number, body if is_same else None, PAINTS[0], each))
    return found


def drawn_car(number: int, hull: DesignCar, draw: np.random.Generator) -> Car:
    """Draw a car that arrives, of a body within an outline."""
    bodies = [body for body in CAR_BODIES if hull.holds(body)]
    body = bodies[int(draw.integers(len(bodies)))]
    return Car(number, body, PAINTS[int(draw.integers(len(PAINTS)))])
