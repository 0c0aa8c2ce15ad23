"""Parking zones named by letter and number (``B2``), for wayfinding, and the stall numbers in them."""

import string
from collections import Counter
from collections.abc import Iterable
from dataclasses import replace
from typing import NamedTuple

from garage2usd.layout.placement import PlacedStall
from garage2usd.structure.grid import Structure
from garage2usd.structure.lane_graph import Square

__all__ = ["Zone", "Zones", "with_numbers", "zone_of"]

_LETTERS = "".join(letter for letter in string.ascii_uppercase if letter not in "IO")
_MAX_NUMBER = 99
_MIN_SIDE = 4


class Zone(NamedTuple):
    """Parking zone, a block of squares: letter of its columns, number of its rows from 1."""

    letter: str
    number: int

    def __str__(self) -> str:
        """Return the name of the zone: ``B2``."""
        return f"{self.letter}{self.number}"


class Zones:
    """Zones of a garage: blocks of 4 x 4 squares, larger if letters or numbers run out."""

    def __init__(self, structure: Structure) -> None:
        rows, columns = structure.shape
        self._side = max(_MIN_SIDE, -(-columns // len(_LETTERS)), -(-rows // _MAX_NUMBER))

    def of(self, square: Square) -> Zone:
        """Return the zone of a square (row, col)."""
        row, col = square
        return Zone(_LETTERS[col // self._side], row // self._side + 1)


def zone_of(number: str) -> str:
    """Return the name of the zone in a stall's number, ``B2`` of ``B2-07``; empty without one."""
    zone = number.rpartition("-")[0]
    return zone if len(zone) > 1 and zone[0] in string.ascii_uppercase and zone[1:].isdecimal() else ""


def with_numbers(stalls: Iterable[PlacedStall], zones: Zones | None) -> tuple[PlacedStall, ...]:
    """Number the stalls, for example ``B2-07`` by zone, or ``007`` in a garage without zones.

    Stalls in which nobody parks have no number.
    """
    counts: Counter[Zone | None] = Counter()
    numbered = []
    for stall in stalls:
        if not stall.use.is_parked_in:
            numbered.append(stall)
            continue
        zone = zones.of(stall.square) if zones else None
        counts[zone] += 1
        number = f"{zone}-{counts[zone]:02d}" if zone else f"{counts[zone]:03d}"
        numbered.append(replace(stall, number=number))
    return tuple(numbered)
