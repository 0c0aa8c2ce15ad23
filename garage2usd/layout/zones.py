"""Zones by letter and number, by which people find their car again, and the numbers of stalls."""

import string
from collections import Counter
from collections.abc import Iterable
from dataclasses import replace
from typing import NamedTuple

from garage2usd.assets.glyphs import GLYPH_PITCH
from garage2usd.config import FittingsConfig
from garage2usd.layout.placement import Placement, Stall
from garage2usd.objects.stall_number import NumberSpec
from garage2usd.structure.grid import Structure
from garage2usd.structure.lane_graph import Square

__all__ = ["Zone", "Zones", "stall_numbers", "with_numbers"]

_LETTERS = "".join(letter for letter in string.ascii_uppercase if letter not in "IO")
_MAX_NUMBER = 99
_MIN_SIDE = 4
_DIGIT_HEIGHT_M = 0.45
_NUMBER_FROM_MOUTH_M = 0.45
_PIECE_DIGITS = 2


class Zone(NamedTuple):
    """A block of squares: a letter for its columns, a number from 1 for its rows."""

    letter: str
    number: int

    def __str__(self) -> str:
        """Name of the zone: ``B2``."""
        return f"{self.letter}{self.number}"


class Zones:
    """The zones of a garage: blocks of 4 x 4 squares, larger where letters or numbers would run out."""

    def __init__(self, structure: Structure) -> None:
        rows, columns = structure.shape
        self._side = max(_MIN_SIDE, -(-columns // len(_LETTERS)), -(-rows // _MAX_NUMBER))

    def of(self, square: Square) -> Zone:
        """The zone that a square (row, col) lies in."""
        row, col = square
        return Zone(_LETTERS[col // self._side], row // self._side + 1)


def with_numbers(stalls: Iterable[Stall], zones: Zones | None) -> tuple[Stall, ...]:
    """The same stalls with their numbers, counted through each zone, or through the garage if it has no zones.

    Stalls in which nobody parks get no number.
    """
    counts: Counter[Zone | None] = Counter()
    numbered = []
    for stall in stalls:
        if not stall.use.takes_cars:
            numbered.append(stall)
            continue
        zone = zones.of(stall.square) if zones else None
        counts[zone] += 1
        number = f"{zone}-{counts[zone]:02d}" if zone else f"{counts[zone]:03d}"
        numbered.append(replace(stall, number=number))
    return tuple(numbered)


def stall_numbers(stalls: Iterable[Stall], fittings: FittingsConfig) -> list[Placement]:
    """The number of each stall without its zone, painted at its mouth, in pieces of two digits at most."""
    if not fittings.stall_numbers:
        return []
    pitch_m = GLYPH_PITCH * _DIGIT_HEIGHT_M
    numbers: list[Placement] = []
    for stall in stalls:
        painted = stall.number.rpartition("-")[2]
        along = stall.length_m / 2 - _NUMBER_FROM_MOUTH_M
        for piece, end in enumerate(range(len(painted), 0, -_PIECE_DIGITS), start=1):
            start = max(end - _PIECE_DIGITS, 0)
            across = (start + end - len(painted)) / 2 * pitch_m
            spec = NumberSpec(painted[start:end], _DIGIT_HEIGHT_M)
            numbers.append(stall.placement("StallNumber", spec, (across, along), piece=piece))
    return numbers
