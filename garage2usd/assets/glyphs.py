"""Outlines of text, drawn with a broad pen: capital letters, digits, signs and Chinese characters."""

import unicodedata
from collections.abc import Sequence
from functools import lru_cache
from typing import Literal

import shapely
from shapely import affinity

from garage2usd.common.documents import shipped_toml

HAN_WIDTH = 1.0
"""Width of each character as a share of its height."""
HAN_PITCH = 1.12
"""Distance between the centres of adjacent characters, as a share of their height."""
_PEN = 0.1
_FINE_PEN = 0.075
_FEW_STROKES = 5
"""Number of strokes above which a character is drawn with the finer pen."""
_GRID = 1e-4
Stroke = tuple[tuple[float, float], ...]
_TABLES: dict[str, dict[str, Sequence[Stroke]]] = shipped_toml("garage2usd.assets", "strokes")
_HAN_STROKES, _STROKES, _ABOVE = (_TABLES[name] for name in ("han", "latin", "marks"))
GLYPH_WIDTH = 0.56
"""Width of each character as a share of its height."""
GLYPH_PITCH = 0.71
"""Distance between the centres of adjacent characters, as a share of their height."""
_STROKE = 0.16


def is_han(text: str) -> bool:
    """True if a text consists only of the Chinese characters of this module."""
    return bool(text) and all(character in _HAN_STROKES for character in text)


_UNDER_MARK, _FINE_STROKE = 0.76, 0.1
"""Height of a letter with a mark, as a share of those without; and the pen of marks."""


def is_drawn(character: str) -> bool:
    """True for a letter, digit or sign of this module, also with a mark; False for Chinese characters."""
    apart = unicodedata.normalize("NFD", character)
    return apart[0] in _STROKES and (len(apart) == 1 or apart[1:] in _ABOVE)


def text_shape(text: str, height_m: float) -> shapely.Geometry:
    """Outline of a text, centred at the origin, with its second coordinate downwards.

    Parameters
    ----------
    text
        Characters of this module, Chinese ones only among themselves.
    height_m
        Height of the characters.
    """
    pitch = HAN_PITCH if is_han(text) else GLYPH_PITCH
    shapes = []
    for index, character in enumerate(text):
        across = (index - (len(text) - 1) / 2) * pitch
        shapes.append(affinity.translate(glyph_of(character), across))
    return affinity.scale(shapely.union_all(shapes), height_m, height_m, origin=(0, 0))


def text_length(text: str) -> float:
    """Length of a text as a share of the height of its characters."""
    width, pitch = (HAN_WIDTH, HAN_PITCH) if is_han(text) else (GLYPH_WIDTH, GLYPH_PITCH)
    return width + pitch * (len(text) - 1)


@lru_cache(maxsize=128)
def glyph_of(character: str) -> shapely.Geometry:
    """Outline of a character of height 1, centred at the origin."""
    if is_han(character):
        strokes = _HAN_STROKES[character]
        pen = _PEN if len(strokes) <= _FEW_STROKES else _FINE_PEN
        return affinity.translate(_drawn(strokes, pen, HAN_WIDTH, cap="square", mitre_limit=2.0), -HAN_WIDTH / 2, -0.5)
    apart = unicodedata.normalize("NFD", character)
    glyph = _drawn(_STROKES[apart[0]], _STROKE)
    for mark in apart[1:]:
        lowered = affinity.scale(glyph, 1, _UNDER_MARK, origin=(0, 1))
        glyph = shapely.union(lowered, _drawn(_ABOVE[mark], _FINE_STROKE), grid_size=_GRID)
    return affinity.translate(glyph, -GLYPH_WIDTH / 2, -0.5)


def _drawn(
    strokes: Sequence[Stroke],
    pen: float,
    width: float = GLYPH_WIDTH,
    cap: Literal["flat", "square"] = "flat",
    mitre_limit: float = 5.0,
) -> shapely.Geometry:
    """Outline of strokes in a cell."""
    lines = [
        shapely.LineString(stroke).buffer(pen / 2, cap_style=cap, join_style="mitre", mitre_limit=mitre_limit)
        if stroke[0] != stroke[-1]
        else shapely.LinearRing(stroke).buffer(pen / 2, join_style="mitre")
        for stroke in strokes
    ]
    return shapely.intersection(shapely.union_all(lines), shapely.box(0, 0, width, 1), grid_size=_GRID)
