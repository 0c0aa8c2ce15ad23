"""The numbers of stalls: painted on the floor or on the wall behind, in pieces that many numbers share."""

from collections.abc import Iterable, Iterator

from garage2usd.assets.glyphs import GLYPH_PITCH, GLYPH_WIDTH
from garage2usd.config import FittingsConfig
from garage2usd.config.look import BandForm, LookConfig, NumberForm, NumberPlace
from garage2usd.layout.placement import Placement, Stall
from garage2usd.layout.tiles import TileGrid
from garage2usd.objects.stall_number import NumberFrameSpec, NumberSpec, WallNumberSpec

__all__ = ["stall_numbers"]

_PIECE_CHARACTERS = 2
_FROM_LINE_M = 0.225
"""From the mouth to a number at it, and from what is painted on the lane to one before it."""
_FROM_REAR_M = 1.2
"""Behind which there are wheel stops."""
_ON_WALL_M = 1.55
_MARGIN_M = 0.3
"""On both sides of a number together, within its stall."""
_STEP_M = 0.01


def stall_numbers(
    stalls: Iterable[Stall], grid: TileGrid, fittings: FittingsConfig, look: LookConfig
) -> Iterator[Placement]:
    """The number of each stall, in pieces of two characters at most."""
    numbers = look.numbers
    if not fittings.stall_numbers or numbers.place is NumberPlace.NONE:
        return
    for stall in stalls:
        text = stall.number if numbers.form is NumberForm.FULL else stall.number.rpartition("-")[2]
        if not text or (numbers.place is NumberPlace.WALL and not _has_wall(stall, grid)):
            continue
        width = (len(text) - 1) * GLYPH_PITCH + GLYPH_WIDTH
        most_m = (stall.width_m - _MARGIN_M) / width // _STEP_M * _STEP_M
        height_m = round(min(numbers.height_m, most_m), 2)
        along = _along_m(stall, height_m, grid, look)
        is_upright = numbers.place is NumberPlace.WALL
        for number, (piece, middle) in enumerate(_pieces(text), start=1):
            across = middle * GLYPH_PITCH * height_m
            if is_upright:
                # seen from the mouth its left is where -X is, as on the floor
                spec = WallNumberSpec(piece, height_m, _ON_WALL_M)
                yield stall.placement("StallNumber", spec, (across, along), piece=number)
            else:
                yield stall.placement("StallNumber", NumberSpec(piece, height_m), (across, along), piece=number)
        if numbers.form is NumberForm.BOXED and not is_upright:
            frame = NumberFrameSpec(round(width * height_m + height_m, 2), round(2 * height_m, 2), height_m)
            yield stall.placement("NumberFrame", frame, (0.0, along))


def _pieces(text: str) -> Iterator[tuple[str, float]]:
    """Pieces of a number and their middles, in characters from its own; ends of the same numbers are the same."""
    zone, dash, own = text.rpartition("-")
    end = len(text)
    for word in (own, dash, zone):
        start = end - len(word)
        while end > start:
            first = max(end - _PIECE_CHARACTERS, start)
            yield text[first:end], (first + end - len(text)) / 2
            end = first


def _along_m(stall: Stall, height_m: float, grid: TileGrid, look: LookConfig) -> float:
    """Where along a stall the middle of its number lies, its mouth at +Z."""
    mouth, half_m = stall.length_m / 2, height_m / 2
    match look.numbers.place:
        case NumberPlace.MOUTH:
            return round(mouth - _FROM_LINE_M - half_m, 6)
        case NumberPlace.LANE:
            return round(mouth + _painted_m(look) + _FROM_LINE_M + half_m, 6)
        case NumberPlace.REAR:
            return round(-mouth + _FROM_REAR_M + half_m, 6)
        case NumberPlace.WALL:
            tile = grid.tiles[stall.square]
            return round(mouth - (tile.depth_m if stall.edge.along_x else tile.width_m), 6)
        case _:
            return 0.0


def _painted_m(look: LookConfig) -> float:
    """How far before the stalls' entries the lane is painted."""
    markings = look.markings
    if markings.band is BandForm.NONE:
        return 0.0
    line_m = markings.band_gap_m + markings.line_width_m
    return line_m if markings.band is BandForm.LINE else line_m + markings.band_width_m + markings.line_width_m


def _has_wall(stall: Stall, grid: TileGrid) -> bool:
    """Whether a wall stands behind a stall."""
    return grid.neighbour(grid.tiles[stall.square], stall.edge.opposite) is None
