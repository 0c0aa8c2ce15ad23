"""The number plates of parked cars, each car's with a text of its own."""

import math
from collections.abc import Iterable

from garage2usd.assets.countries import Country
from garage2usd.assets.plate_texture import CHARACTERS, DOT, PROVINCES
from garage2usd.common.randomness import Step
from garage2usd.config.vehicles import DRIVEN_PLATE
from garage2usd.layout.draws import SquareDraws
from garage2usd.layout.placement import PlacedStall, Placement, of_spec, placed
from garage2usd.objects.car import CarSpec
from garage2usd.objects.number_plate import plates_on

__all__ = ["number_plates"]

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
"""What stands at each place.

That of no country is like those of many, and at the time of writing that of none. Those of countries look like theirs,
and none of their offices issues them, so that nobody's own plate is meant: three letters among a Chinese number,
letters for no German town, Britain's year 00, letters around the digits of the United States.
"""
_NEXT = 1_299_709
"""By how much the number of a text grows where it is taken already: a prime, so that all are gone through."""


def number_plates(
    stalls: Iterable[PlacedStall], cars: Iterable[Placement], draws: SquareDraws, country: Country = Country.NONE
) -> list[Placement]:
    """The plates of each car.

    Parameters
    ----------
    stalls
        All stalls in reading order. Each draws a text, whether a car stands in it or not, so that a car's text depends
        on no other car.
    cars
        The parked cars.
    draws
        Where squares share them, cars in equal places of equal squares have equal plates; all others differ.
    country
        Whose plates they are.
    """
    text_of = _texts(list(stalls), draws, _PATTERNS[country])
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


def _texts(stalls: list[PlacedStall], draws: SquareDraws, pattern: _Pattern) -> dict[str, str]:
    """The text that the car in each stall has or would have, by the stall's name."""
    shares = draws.of_step(Step.NUMBER_PLATES, max((stall.ordinal for stall in stalls), default=0))
    count = math.prod(map(len, pattern))
    text_of: dict[float, str] = {}
    taken = {DRIVEN_PLATE}
    texts = {}
    for stall in stalls:
        share = float(shares[stall.square][stall.ordinal - 1])
        if share not in text_of:
            number = int(share * count)
            while (text := _text(number, pattern)) in taken:
                number = (number + _NEXT) % count
            taken.add(text)
            text_of[share] = text
        texts[stall.name] = text_of[share]
    return texts


def _text(number: int, pattern: _Pattern) -> str:
    """The text of a number below how many the pattern has."""
    characters = []
    for choices in reversed(pattern):
        number, place = divmod(number, len(choices))
        characters.append(choices[place])
    return "".join(reversed(characters))
