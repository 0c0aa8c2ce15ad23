"""Outlines of text, drawn with a broad pen: capital letters, digits, signs and Chinese characters."""

import tomllib
import unicodedata
from collections.abc import Sequence
from functools import lru_cache
from importlib import resources
from typing import Literal

import shapely
from shapely import affinity

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
_HAN_STROKES: dict[str, Sequence[Stroke]] = tomllib.loads(
    resources.files(__package__).joinpath("han_strokes.toml").read_text(encoding="utf-8")
)
GLYPH_WIDTH = 0.56
"""Width of each character as a share of its height."""
GLYPH_PITCH = 0.71
"""Distance between the centres of adjacent characters, as a share of their height."""
_STROKE = 0.16
_CUT = 0.14
# strokes (x, y) with y downwards, in a cell of height 1 and width `GLYPH_WIDTH`; a loop ends at its start
_LEFT, _RIGHT, _TOP, _BOTTOM = _STROKE / 2, GLYPH_WIDTH - _STROKE / 2, _STROKE / 2, 1 - _STROKE / 2
_MIDDLE = 0.5


def is_han(text: str) -> bool:
    """True if a text consists only of the Chinese characters of this module."""
    return bool(text) and all(character in _HAN_STROKES for character in text)


def _loop(top: float, bottom: float) -> Stroke:
    """A closed octagon from `top` to `bottom`."""
    left, right, cut = _LEFT, _RIGHT, _CUT
    return (
        (left + cut, top),
        (right - cut, top),
        (right, top + cut),
        (right, bottom - cut),
        (right - cut, bottom),
        (left + cut, bottom),
        (left, bottom - cut),
        (left, top + cut),
        (left + cut, top),
    )


_HOOK_TOP = ((_LEFT, 0.26), (_LEFT, _TOP + _CUT), (_LEFT + _CUT, _TOP), (_RIGHT - _CUT, _TOP), (_RIGHT, _TOP + _CUT))

_HOOK_BOTTOM = ((_RIGHT - _CUT, _BOTTOM), (_LEFT + _CUT, _BOTTOM), (_LEFT, _BOTTOM - _CUT), (_LEFT, 0.74))

_BELLY = ((_RIGHT - _CUT, _MIDDLE), (_RIGHT, _MIDDLE + _CUT), (_RIGHT, _BOTTOM - _CUT))

_STROKES: dict[str, Sequence[Stroke]] = {
    "0": (_loop(_TOP, _BOTTOM),),
    "1": (((0.12, 0.2), (0.3, _TOP), (0.3, 1.0)),),
    "2": ((*_HOOK_TOP, (_RIGHT, 0.38), (_LEFT, _BOTTOM), (GLYPH_WIDTH, _BOTTOM)),),
    "3": (
        (*_HOOK_TOP, (_RIGHT, _MIDDLE - _CUT), (_RIGHT - _CUT, _MIDDLE), (0.2, _MIDDLE)),
        ((0.2, _MIDDLE), *_BELLY, *_HOOK_BOTTOM),
    ),
    "4": (((0.36, 1.0), (0.36, _TOP), (_LEFT, 0.68), (GLYPH_WIDTH, 0.68)),),
    "5": (((GLYPH_WIDTH, _TOP), (_LEFT, _TOP), (_LEFT, _MIDDLE), *_BELLY, *_HOOK_BOTTOM),),
    "6": (_loop(0.42, _BOTTOM), ((_LEFT, 0.6), (_LEFT, _TOP + _CUT), (_LEFT + _CUT, _TOP), (_RIGHT, _TOP))),
    "7": (((0.0, _TOP), (_RIGHT, _TOP), (0.2, 1.0)),),
    "8": (_loop(_TOP, _MIDDLE), _loop(_MIDDLE, _BOTTOM)),
    "9": (_loop(_TOP, 0.58), ((_RIGHT, 0.4), (_RIGHT, _BOTTOM - _CUT), (_RIGHT - _CUT, _BOTTOM), (_LEFT, _BOTTOM))),
}

_POST = ((_LEFT, 0.0), (_LEFT, 1.0))

_TOP_ARC = ((_RIGHT - _CUT, _TOP), (_RIGHT, _TOP + _CUT))

_BOTTOM_ARC = ((_RIGHT, _BOTTOM - _CUT), (_RIGHT - _CUT, _BOTTOM))

_OPEN_RING = (
    (_RIGHT, 0.3),
    *reversed(_TOP_ARC),
    (_LEFT + _CUT, _TOP),
    (_LEFT, _TOP + _CUT),
    (_LEFT, _BOTTOM - _CUT),
    (_LEFT + _CUT, _BOTTOM),
    *reversed(_BOTTOM_ARC),
)

_BOW = ((0.0, _TOP), *_TOP_ARC, (_RIGHT, 0.56 - _CUT), (_RIGHT - _CUT, 0.56), (_LEFT, 0.56))

_STROKES |= {
    "A": (
        ((_LEFT, 1.0), (_LEFT, _TOP + _CUT), (_LEFT + _CUT, _TOP), *_TOP_ARC, (_RIGHT, 1.0)),
        ((_LEFT, 0.58), (_RIGHT, 0.58)),
    ),
    "B": (
        _POST,
        ((0.0, _TOP), *_TOP_ARC, (_RIGHT, _MIDDLE - _CUT), (_RIGHT - _CUT, _MIDDLE), (_LEFT, _MIDDLE)),
        ((_LEFT, _MIDDLE), *_BELLY, (_RIGHT - _CUT, _BOTTOM), (0.0, _BOTTOM)),
    ),
    "C": ((*_OPEN_RING, (_RIGHT, 0.7)),),
    "D": (_POST, ((0.0, _TOP), *_TOP_ARC, *_BOTTOM_ARC, (0.0, _BOTTOM))),
    "E": (
        ((GLYPH_WIDTH, _TOP), (_LEFT, _TOP), (_LEFT, _BOTTOM), (GLYPH_WIDTH, _BOTTOM)),
        ((_LEFT, _MIDDLE), (0.46, _MIDDLE)),
    ),
    "F": (((GLYPH_WIDTH, _TOP), (_LEFT, _TOP), (_LEFT, 1.0)), ((_LEFT, _MIDDLE), (0.46, _MIDDLE))),
    "G": ((*_OPEN_RING, (_RIGHT, 0.54), (0.28, 0.54)),),
    " ": (),
    "-": (((0.1, _MIDDLE), (GLYPH_WIDTH - 0.1, _MIDDLE)),),
    "H": (_POST, ((_RIGHT, 0.0), (_RIGHT, 1.0)), ((_LEFT, _MIDDLE), (_RIGHT, _MIDDLE))),
    "I": (((0.28, 0.0), (0.28, 1.0)),),
    "J": (((_RIGHT, 0.0), *_BOTTOM_ARC, (_LEFT + _CUT, _BOTTOM), (_LEFT, _BOTTOM - _CUT), (_LEFT, 0.66)),),
    "K": (_POST, ((0.50, -0.05), (_LEFT, 0.60)), ((0.20, 0.40), (0.50, 1.05))),
    "L": (((_LEFT, 0.0), (_LEFT, _BOTTOM), (GLYPH_WIDTH, _BOTTOM)),),
    "M": (((_LEFT, 1.0), (_LEFT, 0.12), (0.28, 0.52), (_RIGHT, 0.12), (_RIGHT, 1.0)),),
    "N": (((_LEFT, 1.0), (_LEFT, 0.12), (_RIGHT, 0.88), (_RIGHT, 0.0)),),
    "O": (_loop(_TOP, _BOTTOM),),
    "P": (_POST, _BOW),
    "Q": (_loop(_TOP, _BOTTOM), ((0.28, 0.66), (0.52, 1.05))),
    "R": (_POST, _BOW, ((0.26, 0.56), (0.48, 1.05))),
    "S": (
        (
            (_RIGHT, 0.28),
            *reversed(_TOP_ARC),
            (_LEFT + _CUT, _TOP),
            (_LEFT, _TOP + _CUT),
            (_LEFT, _MIDDLE - _CUT),
            (_LEFT + _CUT, _MIDDLE),
            *_BELLY,
            *_HOOK_BOTTOM,
        ),
    ),
    "T": (((0.0, _TOP), (GLYPH_WIDTH, _TOP)), ((0.28, _TOP), (0.28, 1.0))),
    "U": (((_LEFT, 0.0), (_LEFT, _BOTTOM - _CUT), (_LEFT + _CUT, _BOTTOM), *reversed(_BOTTOM_ARC), (_RIGHT, 0.0)),),
    "V": (((0.06, -0.05), (0.28, 0.94), (0.50, -0.05)),),
    "W": (((0.04, -0.05), (0.15, 0.94), (0.28, 0.36), (0.41, 0.94), (0.52, -0.05)),),
    "X": (((0.06, -0.05), (0.50, 1.05)), ((0.50, -0.05), (0.06, 1.05))),
    "Y": (((0.06, -0.05), (0.28, 0.52)), ((0.50, -0.05), (0.28, 0.52)), ((0.28, 0.46), (0.28, 1.0))),
    "Z": (((0.0, _TOP), (_RIGHT, _TOP), (_LEFT, _BOTTOM), (GLYPH_WIDTH, _BOTTOM)),),
    "/": (((0.06, 1.05), (0.50, -0.05)),),
    "\\": (((0.06, -0.05), (0.50, 1.05)),),
    ".": (((0.28, 0.84), (0.28, 1.0)),),
    ",": (((0.32, 0.80), (0.20, 1.05)),),
    ":": (((0.28, 0.26), (0.28, 0.42)), ((0.28, 0.70), (0.28, 0.86))),
    "+": (((0.04, _MIDDLE), (0.52, _MIDDLE)), ((0.28, 0.26), (0.28, 0.74))),
    "_": (((0.0, _BOTTOM), (GLYPH_WIDTH, _BOTTOM)),),
    "(": (((0.40, -0.02), (0.20, 0.25), (0.20, 0.75), (0.40, 1.02)),),
    ")": (((0.16, -0.02), (0.36, 0.25), (0.36, 0.75), (0.16, 1.02)),),
    "#": (
        ((0.20, 0.1), (0.16, 0.9)),
        ((0.40, 0.1), (0.36, 0.9)),
        ((0.0, 0.36), (GLYPH_WIDTH, 0.36)),
        ((0.0, 0.66), (GLYPH_WIDTH, 0.66)),
    ),
}

_ABOVE: dict[str, Sequence[Stroke]] = {
    "\u0300": (((0.14, -0.02), (0.34, 0.18)),),
    "\u0301": (((0.42, -0.02), (0.22, 0.18)),),
    "\u0302": (((0.12, 0.18), (0.28, 0.02), (0.44, 0.18)),),
    "\u0303": (((0.06, 0.14), (0.20, 0.04), (0.36, 0.12), (0.50, 0.02)),),
    "\u0308": (((0.16, 0.0), (0.16, 0.16)), ((0.40, 0.0), (0.40, 0.16))),
    "\u030a": (((0.20, 0.0), (0.36, 0.0), (0.36, 0.16), (0.20, 0.16), (0.20, 0.0)),),
    "\u030c": (((0.12, 0.0), (0.28, 0.16), (0.44, 0.0)),),
}
"""Strokes of Unicode's combining marks above a letter, which is lowered for them."""

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
