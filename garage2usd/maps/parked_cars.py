"""Parked cars of a garage as boxes, for scenarios."""

import math
from collections.abc import Collection
from dataclasses import dataclass, replace

import numpy as np
import shapely

from garage2usd.as_built.garage import BuiltGarage
from garage2usd.as_built.level import BuiltLevel
from garage2usd.as_built.placed_pieces import placed_pieces
from garage2usd.native import elementary
from garage2usd.objects import CAR_LABELS


@dataclass(frozen=True, slots=True)
class ParkedCar:
    """A parked car as a box.

    Attributes
    ----------
    name
        Unique name of the car.
    middle_m
        (x, z) of the middle of its footprint.
    yaw_rad
        Right-handed about +Y; at 0 its nose looks to -Z.
    length_m, width_m, height_m
        Size of the body.
    floor_m
        Height of the floor that it stands on.
    prim
        Path of its prim in the whole stage.
    stall
        Name of its stall in the whole garage; empty for a car outside of stalls.
    level
        Number of its level, from 0.
    label
        Semantic class.
    """

    name: str
    middle_m: tuple[float, float]
    yaw_rad: float
    length_m: float
    width_m: float
    height_m: float
    floor_m: float = 0.0
    prim: str = ""
    stall: str = ""
    level: int = 0
    label: str = "car"


def parked_cars(garage: BuiltGarage, *, free: Collection[str] = (), left_out: Collection[str] = ()) -> list[ParkedCar]:
    """Return the parked cars of a garage as boxes around their bodies, level by level in prim order.

    Parameters
    ----------
    garage
        The garage.
    free
        Names of stalls in the whole garage whose cars are ignored.
    left_out
        Paths of cars in the whole stage that are ignored.

    Notes
    -----
    A car looks to its own -Z, as those of garage2usd's catalogue do; its name in a scenario is ``Car_1`` and so on. The
    box excludes the mirrors, whose width would block passing cars. ASAM OSI also defines vehicle boxes without mirrors.
    """
    cars = [
        replace(car, level=number)
        for number, level in enumerate(garage.levels)
        for car in _on_level(level, free, left_out)
    ]
    return [replace(car, name=f"Car_{number}") for number, car in enumerate(cars, 1)]


def _on_level(level: BuiltLevel, free: Collection[str], left_out: Collection[str]) -> list[ParkedCar]:
    cars: list[ParkedCar] = []
    cars_of_level = (thing for thing in level.things if thing.label in CAR_LABELS and thing.bodies)
    things = [thing for thing in cars_of_level if level.place.path_in_whole(thing.name) not in left_out]
    bodies = [body for thing in things for body in thing.bodies]
    pieces = placed_pieces(bodies, np.ones(len(bodies), dtype=bool))
    first = np.cumsum([0, *(len(thing.bodies) for thing in things)])
    corners = np.cumsum([0, *pieces.counts.tolist()])
    for number, thing in enumerate(things):
        ground, home = level.cars.get(thing.name, (None, None))
        if home is not None and level.place.in_whole(home.name) in free:
            continue
        back = thing.bodies[0].matrix[2, [0, 2]]
        yaw = math.atan2(back[0], back[1])
        own_pieces = slice(first[number], first[number + 1])
        height_m = pieces.high_m[own_pieces].max() - pieces.low_m[own_pieces].min()
        outline = pieces.corners[corners[first[number]] : corners[first[number + 1]]]
        if ground is not None:
            outline = shapely.get_coordinates(ground)
        turn = np.array([[elementary.cos(yaw), -elementary.sin(yaw)], [elementary.sin(yaw), elementary.cos(yaw)]])
        # in the car's own frame: (x, z) by rows times the inverse turn
        own = outline @ turn.T
        low, high = own.min(axis=0), own.max(axis=0)
        middle = (low + high) / 2 @ turn
        width, length = (high - low).tolist()
        cars.append(
            ParkedCar(
                "",
                (float(middle[0]), float(middle[1])),
                yaw,
                length,
                width,
                float(height_m),
                level.place.floor_m,
                level.place.path_in_whole(thing.name),
                "" if home is None else level.place.in_whole(home.name),
                label=thing.label,
            )
        )
    return cars
