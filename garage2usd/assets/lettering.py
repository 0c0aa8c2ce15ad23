"""Stall numbers as they are written: in this package's lettering, completed by a font, or in the user's font."""

import unicodedata
from functools import lru_cache
from itertools import accumulate
from pathlib import Path
from typing import NamedTuple

import shapely
from shapely import affinity

from garage2usd.assets.glyphs import GLYPH_PITCH, HAN_PITCH, glyph_of, is_drawn, is_han
from garage2usd.config.font_file import FontFile, opened_font

OWN_FONT = FontFile(file=str(Path(__file__).parent / "fonts" / "DejaVuSansCondensed.ttf"))
"""DejaVu Sans Condensed, which has most letters of Europe."""
_THICKENED = 0.02
"""Growth of the outlines of this font in all directions, to strokes as wide as those of the own lettering."""
_LEAST_CELLS = 0.4
_FLAT, _GRID = 0.004, 1e-4
"""Distance up to which outlines differ from a font's, and the grid of their corners, as shares of the height."""
_UNSHAPED = ("L", "EN", "ES", "ET", "CS", "ON")
"""Directions of characters that are written one after the other from the left, each in a shape of its own."""


class Letter(NamedTuple):
    """A character of height 1 with the middle of its cell at the origin, y downwards; and the width of this cell.

    The width is in cells of the own lettering, `GLYPH_PITCH` each.
    """

    outline: shapely.Geometry
    cells: float


def written_form(text: str) -> str:
    """Return a number with each mark joined to its letter, without blanks at its ends."""
    return unicodedata.normalize("NFC", text.strip())


def unpainted(text: str, font: FontFile | None) -> str:
    """Return the characters of a number that neither the lettering nor a font has, each once."""
    return "".join(sign for sign in dict.fromkeys(written_form(text)) if letter_of(sign, font) is None)


def lacks(text: str, font: FontFile) -> str:
    """Return the characters of a number that a font lacks, each once; blanks are not among them."""
    return "".join(sign for sign in dict.fromkeys("".join(written_form(text).split())) if not font_letter(sign, font))


def font_with(text: str, font: FontFile | None) -> str:
    """Return the file of the font that has all characters of a number: the one that is given, or else the own one."""
    return font.file if font is not None and not lacks(text, font) else OWN_FONT.file


def letter_of(character: str, font: FontFile | None) -> Letter | None:
    """Return a character: of the font that is given, else of the lettering, else of the own font; None without it."""
    found = None if font is None else font_letter(character, font)
    if found is not None:
        return found
    if is_drawn(character):
        return Letter(glyph_of(character), 1)
    if is_han(character):
        return Letter(glyph_of(character), HAN_PITCH / GLYPH_PITCH)
    return font_letter(character, OWN_FONT)


def cells_of(text: str, font: FontFile | None) -> float:
    """Width of a number in cells of the own lettering."""
    return sum(letter.cells for letter in _letters(text, font))


def overhang_of(text: str, font: FontFile | None) -> float:
    """Greatest reach of a number over or below the height of its capital letters, as a share of this height."""
    bounds = [letter.outline.bounds for letter in _letters(text, font) if not letter.outline.is_empty]
    return max([0.0, *(float(max(-low, high)) - 0.5 for _, low, _, high in bounds)])


def number_shape(text: str, height_m: float, font: FontFile | None) -> shapely.Geometry:
    """Outline of a number, centred at the origin, with its second coordinate downwards.

    Parameters
    ----------
    text
        Characters without those of `unpainted`.
    height_m
        Height of capital letters and digits.
    font
        Font that comes first; None for the own lettering.
    """
    letters = _letters(text, font)
    ends = list(accumulate((letter.cells for letter in letters), initial=0))
    shapes = [
        affinity.translate(letter.outline, ((start + end - 1) / 2 - (ends[-1] - 1) / 2) * GLYPH_PITCH)
        for letter, start, end in zip(letters, ends, ends[1:], strict=False)
    ]
    return affinity.scale(shapely.union_all(shapes), height_m, height_m, origin=(0, 0))


def _letters(text: str, font: FontFile | None) -> list[Letter]:
    return [letter for sign in text if (letter := letter_of(sign, font)) is not None]


@lru_cache(maxsize=2048)
def font_letter(character: str, font: FontFile) -> Letter | None:
    """Return a character of a font; None if the font lacks it, or if its shape depends on its neighbours.

    Characters are as high as the font's capital letters, or as its em where they fill a square, as Chinese ones do.
    """
    if unicodedata.bidirectional(character) not in _UNSHAPED or unicodedata.category(character)[0] in "MCZ":
        return None
    is_square = unicodedata.east_asian_width(character) in "WF"
    drawn = _outline(font, character)
    if drawn is None:
        return None
    outline, advance = drawn
    low, high = _heights(font, is_square=is_square)
    scale = 1 / (high - low)
    placed = affinity.translate(outline, -advance / 2, -(low + high) / 2)
    glyph = affinity.scale(placed, scale, -scale, origin=(0, 0)).simplify(_FLAT)
    if font == OWN_FONT:
        glyph = glyph.buffer(_THICKENED, join_style="mitre", mitre_limit=2.0)
    glyph = shapely.make_valid(shapely.set_precision(glyph, _GRID))
    return Letter(glyph, max(advance * scale / GLYPH_PITCH, _LEAST_CELLS))


@lru_cache(maxsize=16)
def _heights(font: FontFile, *, is_square: bool) -> tuple[float, float]:
    """Height of the lower and the upper edge of a font's capital letters, or of its em, in units of the font."""
    units = float(opened_font(font)["head"].unitsPerEm)
    capital = _outline(font, "H") or _outline(font, "0")
    top = float(capital[0].bounds[3]) if capital else 0.0
    if not 0.3 * units < top < units:  # for fonts without these letters
        top = 0.72 * units
    middle = top / 2
    return (middle - units / 2, middle + units / 2) if is_square else (0.0, top)


def _outline(font: FontFile, character: str) -> tuple[shapely.Geometry, float] | None:
    from garage2usd.assets.font_outlines import outline_of  # noqa: PLC0415 - few garages need it

    return outline_of(opened_font(font), character)
