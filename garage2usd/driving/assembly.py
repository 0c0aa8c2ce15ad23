"""Assembly of a garage for driving from its stalls, its lanes and its obstacles."""

from collections.abc import Iterable
from typing import NamedTuple

import shapely

from garage2usd.driving.garage import DrivenGarage
from garage2usd.driving.obstacles import Obstacles
from garage2usd.garage import LaneGraph, Stall, StallUse
from garage2usd.objects import CAR_LABELS

__all__ = ["BELONGINGS", "StandingThing", "assembled"]

BELONGINGS = frozenset({*CAR_LABELS, "wheel_stop", "traffic_cone"})
"""Semantic classes of objects that do not obstruct a car parking in the stall around them."""


class StandingThing(NamedTuple):
    """An object on the floor that a car could touch.

    Attributes
    ----------
    name
        Unique name in the garage.
    label
        Semantic class.
    ground
        Footprint on the floor, (x, z) in metres.
    home
        Name of the stall that contains the object, if any; used for `BELONGINGS` only.
    """

    name: str
    label: str
    ground: shapely.Geometry
    home: str | None = None


def assembled(stalls: Iterable[Stall], lanes: LaneGraph, standing: Iterable[StandingThing]) -> DrivenGarage:
    """Assemble the garage for driving.

    Parameters
    ----------
    stalls
        All stalls. Those for motorcycles are obstacles: the car's proof is none for them.
    lanes
        The lanes.
    standing
        Obstacles, including the parked cars.
    """
    stalls = tuple(stalls)
    # cars keep off stalls for motorcycles, taken or not
    kept_off = [StandingThing(at.name, at.use, at.polygon) for at in stalls if at.use is StallUse.MOTORCYCLE]
    # the proof names what is in the way in the order of the obstacles, and cars last
    things = sorted([*standing, *kept_off], key=lambda thing: thing.label in CAR_LABELS)
    own: dict[str, tuple[str, ...]] = {}
    for thing in things:
        if thing.label in BELONGINGS and thing.home is not None:
            own[thing.home] = (*own.get(thing.home, ()), thing.name)
    return DrivenGarage(
        tuple(stall for stall in stalls if stall.takes_cars),
        lanes,
        Obstacles.of((thing.name, thing.ground) for thing in things),
        frozenset(thing.home for thing in things if thing.label in CAR_LABELS and thing.home is not None),
        own,
    )
