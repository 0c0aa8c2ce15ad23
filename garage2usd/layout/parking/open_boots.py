"""Open boots of parked cars: inside their stalls, clear of the swept paths of other cars."""

from collections.abc import Iterable, Mapping
from dataclasses import astuple

import shapely

from garage2usd.assets.car_boot import has_boot
from garage2usd.common.randomness import Step, named_generator
from garage2usd.layout.grounds import grounds_of
from garage2usd.layout.placement import PlacedStall, Placement
from garage2usd.objects.car import CarSpec, OpenCarSpec

__all__ = ["opened", "stalls_of_open_boots"]

_CLEARANCE_M = 0.05
"""Clearance around an open boot."""


def opened(car: Placement) -> Placement:
    """Return a car with its boot open.

    Raises
    ------
    TypeError
        If the car is not from the catalogue.
    """
    if type(car.spec) is not CarSpec:
        raise TypeError(f"no car of the catalogue: {car.name}")
    spec = OpenCarSpec(*astuple(car.spec))
    return Placement(car.name, spec, car.position_m, car.yaw_rad, car.square, car.ordinal)


def stalls_of_open_boots(
    placements: Iterable[Placement],
    stalls: Iterable[PlacedStall],
    *,
    swept: Mapping[str, shapely.Geometry],
    per_hundred: float,
    seed: int,
) -> list[str]:
    """Choose the parked cars with open boots, and return their stalls.

    Parameters
    ----------
    placements, stalls
        All objects and stalls of the garage.
    swept
        Swept area of cars on their ways into each stall and out, by stall name. An open boot may overlap the swept area
        of its own stall.
    per_hundred
        Greatest number of open boots for every hundred stalls.
    seed
        Seed of the garage.

    Returns
    -------
    list of str
        Names of the stalls of these cars.
    """
    placements, stalls = list(placements), list(stalls)
    rng = named_generator(seed, Step.CLUTTER, "open_boots")
    wanted = int(per_hundred * len(stalls) / 100 + rng.random())
    cars = [place for place in placements if type(place.spec) is CarSpec and has_boot(place.spec.measures)]
    taken = [
        *swept.items(),
        *((place.stall or "", ground) for place in placements for ground in grounds_of(place.outlines())),
    ]
    grounds = {stall.name: shapely.Polygon(stall.corners_m()) for stall in stalls}
    tree = shapely.STRtree([ground for _, ground in taken])
    chosen: list[str] = []
    for number in rng.permutation(len(cars)).tolist():
        if len(chosen) >= wanted:
            break
        car = cars[number]
        boot = shapely.Polygon(opened(car).outlines()[-1])
        touched = {taken[found][0] for found in tree.query(boot.buffer(_CLEARANCE_M), predicate="intersects").tolist()}
        if car.stall is not None and touched <= {car.stall} and grounds[car.stall].contains(boot):
            chosen.append(car.stall)
    return sorted(chosen)
