"""The cars that stand in a garage, as boxes."""

import math
from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from garage2usd.checks.subject import Subject

__all__ = ["ParkedCar", "parked_cars"]

_CAR = "car"


@dataclass(frozen=True, slots=True)
class ParkedCar:
    """A car that stands.

    Attributes
    ----------
    name
        A name that no other one has.
    middle_m
        (x, z) of the middle of its footprint.
    yaw_rad
        Right-handed about +Y; at 0 its nose looks to -Z.
    length_m, width_m, height_m
        Of its body.
    """

    name: str
    middle_m: tuple[float, float]
    yaw_rad: float
    length_m: float
    width_m: float
    height_m: float


def parked_cars(subject: Subject, *, free: Collection[str] = ()) -> list[ParkedCar]:
    """The cars of a garage, in the order of their prims, as boxes around their meshes.

    Parameters
    ----------
    subject
        The garage.
    free
        Names of stalls whose cars are left out.

    Notes
    -----
    A car looks to its own -Z, as those of garage2usd's catalogue do; its name in a scenario is ``Car_1`` and so on.
    """
    cars: list[ParkedCar] = []
    for thing in subject.things:
        if thing.label != _CAR or not thing.bodies:
            continue
        _, home = subject.cars.get(thing.name, (None, None))
        if home is not None and home.name in free:
            continue
        back = thing.bodies[0].matrix[2, [0, 2]]
        yaw = math.atan2(back[0], back[1])
        points = np.concatenate([body.world_points() for body in thing.bodies])
        turn = np.array([[math.cos(yaw), -math.sin(yaw)], [math.sin(yaw), math.cos(yaw)]])
        # in the car's own frame: (x, z) by rows times the inverse turn
        own = points[:, [0, 2]] @ turn.T
        low, high = own.min(axis=0), own.max(axis=0)
        middle = (low + high) / 2 @ turn
        width, length = (high - low).tolist()
        cars.append(
            ParkedCar(
                f"Car_{len(cars) + 1}",
                (float(middle[0]), float(middle[1])),
                yaw,
                length,
                width,
                float(np.ptp(points[:, 1])),
            )
        )
    return cars
