"""Details of parked cars: number plates with a unique text each, and open boots clear of the ways of others."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import astuple

import shapely

from garage2usd.assets.car_boot import has_boot
from garage2usd.assets.countries import Country
from garage2usd.assets.number_plates import CHARACTERS, DOT, PROVINCES
from garage2usd.common.randomness import Step, named_generator
from garage2usd.config.vehicles import DRIVEN_PLATE
from garage2usd.layout.draws import SquareDraws
from garage2usd.layout.grounds import grounds_of
from garage2usd.layout.placement import PlacedStall, Placement, of_spec, placed
from garage2usd.objects.car import CarSpec, OpenCarSpec
from garage2usd.objects.number_plate import plates_on

_DIGITS = "0123456789"
_LETTERS = "".join(character for character in CHARACTERS if character not in _DIGITS)
_Pattern = tuple[str, ...]
_PATTERNS: dict[Country, _Pattern] = {
    Country.NONE: (_LETTERS, _DIGITS, _DIGITS, " ", _LETTERS, _DIGITS, _DIGITS),
    Country.CN: (PROVINCES, "UVWXYZ", DOT, _LETTERS, _LETTERS, _LETTERS, _DIGITS, _DIGITS),
    Country.DE: ("JTU", " ", _LETTERS, _LETTERS, " ", _DIGITS, _DIGITS),
    Country.GB: (_LETTERS, _LETTERS, "0", "0", " ", _LETTERS, _LETTERS, _LETTERS),
    Country.US: (_LETTERS, _LETTERS, _DIGITS, " ", _DIGITS, _LETTERS, _LETTERS),
}
"""Allowed characters at each position of a plate's text.

The pattern without a country resembles many countries and matches none at the time of writing. The patterns of
countries look real and are never issued, so that no plate belongs to a real car: three letters in a Chinese number,
letters of no German district, year 00 in Britain, letters around the digits in the United States.
"""
_COLLISION_STEP = 1_299_709
"""Step to the next text if one is taken: a prime, so that all texts are tried."""
_CLEARANCE_M = 0.05
"""Clearance around an open boot."""


def number_plates(
    stalls: Iterable[PlacedStall], cars: Iterable[Placement], draws: SquareDraws, country: Country = Country.NONE
) -> list[Placement]:
    """Place the number plates of each parked car.

    Parameters
    ----------
    stalls
        All stalls in reading order. Occupied and empty stalls draw a text, so that a car's text is independent of other
        cars.
    cars
        The parked cars.
    draws
        Random numbers of each square. Cars in equal places of squares with equal numbers have equal plates; all other
        plates differ.
    country
        Country of the plates.
    """
    text_of = _plate_texts(list(stalls), draws, _PATTERNS[country])
    return [
        placed(
            f"NumberPlate_{car.ordinal}",
            plates_on(spec, text_of[car.stall], country),
            (car.position_m[0], car.position_m[2]),
            yaw_rad=car.yaw_rad,
            square=car.square,
            ordinal=car.ordinal,
        )
        for car, spec in of_spec(cars, CarSpec)
        if car.stall is not None
    ]


def _plate_texts(stalls: list[PlacedStall], draws: SquareDraws, pattern: _Pattern) -> dict[str, str]:
    """Return the plate text of every stall, occupied or empty, by stall name."""
    shares = draws.of_step(Step.NUMBER_PLATES, max((stall.ordinal for stall in stalls), default=0))
    count = math.prod(map(len, pattern))
    text_of: dict[float, str] = {}
    taken = {DRIVEN_PLATE}
    texts = {}
    for stall in stalls:
        share = float(shares[stall.square][stall.ordinal - 1])
        if share not in text_of:
            number = int(share * count)
            while (text := _plate_text(number, pattern)) in taken:
                number = (number + _COLLISION_STEP) % count
            taken.add(text)
            text_of[share] = text
        texts[stall.name] = text_of[share]
    return texts


def _plate_text(number: int, pattern: _Pattern) -> str:
    """Return the text of a number, as digits in the pattern's mixed radix."""
    characters = []
    for choices in reversed(pattern):
        number, place = divmod(number, len(choices))
        characters.append(choices[place])
    return "".join(reversed(characters))


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
