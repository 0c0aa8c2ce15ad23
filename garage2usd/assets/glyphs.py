"""Outlines of text, drawn with a broad pen: capital letters, digits, signs and Chinese characters."""
# Over 300 lines: two tables have the strokes of each letter and each Chinese character.

import unicodedata
from functools import lru_cache

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
# strokes (x, y) with y downwards, in a cell of 1 x 1; a loop ends at its start
_HAN_STROKES: dict[str, tuple[Stroke, ...]] = {
    "入": (
        ((0.32, 0.12), (0.52, 0.12), (0.50, 0.32), (0.32, 0.68), (0.05, 0.95)),
        ((0.50, 0.32), (0.68, 0.68), (0.95, 0.95)),
    ),
    "口": (((0.14, 0.17), (0.86, 0.17), (0.86, 0.87), (0.14, 0.87), (0.14, 0.17)),),
    "出": (
        ((0.5, 0.03), (0.5, 0.92)),
        ((0.18, 0.14), (0.18, 0.46), (0.82, 0.46), (0.82, 0.14)),
        ((0.1, 0.57), (0.1, 0.92), (0.9, 0.92), (0.9, 0.57)),
    ),
    "禁": (
        ((0.06, 0.17), (0.46, 0.17)),
        ((0.26, 0.02), (0.26, 0.5)),
        ((0.26, 0.18), (0.05, 0.45)),
        ((0.26, 0.2), (0.44, 0.38)),
        ((0.54, 0.17), (0.94, 0.17)),
        ((0.74, 0.02), (0.74, 0.5)),
        ((0.74, 0.18), (0.56, 0.38)),
        ((0.74, 0.18), (0.95, 0.45)),
        ((0.22, 0.58), (0.78, 0.58)),
        ((0.08, 0.73), (0.92, 0.73)),
        ((0.5, 0.73), (0.5, 0.99)),
        ((0.32, 0.79), (0.12, 0.96)),
        ((0.68, 0.79), (0.88, 0.96)),
    ),
    "止": (
        ((0.52, 0.05), (0.52, 0.9)),
        ((0.52, 0.42), (0.88, 0.42)),
        ((0.22, 0.36), (0.22, 0.9)),
        ((0.04, 0.9), (0.96, 0.9)),
    ),
    "驶": (
        ((0.07, 0.1), (0.37, 0.1), (0.34, 0.5)),
        ((0.14, 0.24), (0.11, 0.5), (0.44, 0.5), (0.4, 0.93), (0.29, 0.88)),
        ((0.02, 0.72), (0.3, 0.72)),
        ((0.54, 0.2), (0.94, 0.2), (0.94, 0.5), (0.54, 0.5), (0.54, 0.2)),
        ((0.74, 0.03), (0.74, 0.5), (0.66, 0.75), (0.48, 0.95)),
        ((0.53, 0.6), (0.7, 0.8), (0.97, 0.95)),
    ),
    "消": (
        ((0.08, 0.06), (0.22, 0.18)),
        ((0.03, 0.34), (0.17, 0.45)),
        ((0.05, 0.95), (0.22, 0.62)),
        ((0.64, 0.03), (0.64, 0.34)),
        ((0.38, 0.08), (0.48, 0.26)),
        ((0.9, 0.08), (0.8, 0.26)),
        ((0.4, 0.97), (0.4, 0.36), (0.9, 0.36), (0.9, 0.92), (0.78, 0.92)),
        ((0.4, 0.54), (0.9, 0.54)),
        ((0.4, 0.72), (0.9, 0.72)),
    ),
    "火": (
        ((0.18, 0.26), (0.28, 0.5)),
        ((0.85, 0.24), (0.7, 0.48)),
        ((0.5, 0.04), (0.5, 0.42), (0.36, 0.72), (0.06, 0.95)),
        ((0.5, 0.44), (0.66, 0.74), (0.95, 0.95)),
    ),
    "栓": (
        ((0.03, 0.27), (0.43, 0.27)),
        ((0.24, 0.03), (0.24, 0.97)),
        ((0.24, 0.3), (0.03, 0.66)),
        ((0.24, 0.36), (0.4, 0.54)),
        ((0.42, 0.44), (0.7, 0.06), (0.98, 0.42)),
        ((0.53, 0.5), (0.88, 0.5)),
        ((0.55, 0.7), (0.86, 0.7)),
        ((0.45, 0.92), (0.96, 0.92)),
        ((0.7, 0.5), (0.7, 0.92)),
    ),
    "层": (
        ((0.17, 0.08), (0.88, 0.08), (0.88, 0.32), (0.17, 0.32)),
        ((0.17, 0.08), (0.17, 0.55), (0.04, 0.95)),
        ((0.34, 0.48), (0.84, 0.48)),
        ((0.24, 0.67), (0.95, 0.67)),
        ((0.54, 0.67), (0.33, 0.92), (0.84, 0.92)),
        ((0.72, 0.77), (0.9, 0.96)),
    ),
    "京": (
        ((0.5, 0.02), (0.5, 0.2)),
        ((0.06, 0.2), (0.94, 0.2)),
        ((0.24, 0.34), (0.76, 0.34), (0.76, 0.58), (0.24, 0.58), (0.24, 0.34)),
        ((0.5, 0.58), (0.5, 0.95), (0.38, 0.9)),
        ((0.3, 0.68), (0.1, 0.92)),
        ((0.7, 0.68), (0.9, 0.92)),
    ),
    "沪": (
        ((0.08, 0.06), (0.22, 0.18)),
        ((0.03, 0.34), (0.17, 0.45)),
        ((0.05, 0.95), (0.22, 0.62)),
        ((0.6, 0.03), (0.68, 0.16)),
        ((0.42, 0.24), (0.9, 0.24), (0.9, 0.54), (0.42, 0.54)),
        ((0.42, 0.2), (0.42, 0.66), (0.28, 0.96)),
    ),
    "川": (
        ((0.16, 0.08), (0.16, 0.6), (0.05, 0.94)),
        ((0.5, 0.12), (0.5, 0.86)),
        ((0.86, 0.06), (0.86, 0.96)),
    ),
    "湘": (
        ((0.06, 0.06), (0.18, 0.18)),
        ((0.02, 0.34), (0.13, 0.45)),
        ((0.03, 0.95), (0.18, 0.62)),
        ((0.22, 0.28), (0.56, 0.28)),
        ((0.39, 0.03), (0.39, 0.97)),
        ((0.39, 0.32), (0.22, 0.66)),
        ((0.39, 0.36), (0.53, 0.54)),
        ((0.62, 0.1), (0.94, 0.1), (0.94, 0.94), (0.62, 0.94), (0.62, 0.1)),
        ((0.62, 0.38), (0.94, 0.38)),
        ((0.62, 0.66), (0.94, 0.66)),
    ),
    "冀": (
        ((0.4, 0.02), (0.4, 0.24), (0.12, 0.27)),
        ((0.14, 0.12), (0.4, 0.12)),
        ((0.6, 0.02), (0.6, 0.26), (0.92, 0.26)),
        ((0.88, 0.06), (0.6, 0.14)),
        ((0.24, 0.34), (0.76, 0.34), (0.76, 0.58), (0.24, 0.58), (0.24, 0.34)),
        ((0.24, 0.46), (0.76, 0.46)),
        ((0.5, 0.34), (0.5, 0.58)),
        ((0.14, 0.69), (0.86, 0.69)),
        ((0.04, 0.83), (0.96, 0.83)),
        ((0.35, 0.6), (0.35, 0.83)),
        ((0.65, 0.6), (0.65, 0.83)),
        ((0.34, 0.86), (0.14, 0.98)),
        ((0.66, 0.86), (0.86, 0.98)),
    ),
}
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


def han_glyph(character: str) -> shapely.Geometry:
    """Outline of a character of height 1, centred at the origin."""
    strokes = _HAN_STROKES[character]
    pen = _PEN if len(strokes) <= _FEW_STROKES else _FINE_PEN
    drawn = [
        shapely.LineString(stroke).buffer(pen / 2, cap_style="square", join_style="mitre", mitre_limit=2.0)
        if stroke[0] != stroke[-1]
        else shapely.LinearRing(stroke).buffer(pen / 2, join_style="mitre")
        for stroke in strokes
    ]
    glyph = shapely.intersection(shapely.union_all(drawn), shapely.box(0, 0, HAN_WIDTH, 1), grid_size=_GRID)
    return affinity.translate(glyph, -HAN_WIDTH / 2, -0.5)


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

_STROKES: dict[str, tuple[Stroke, ...]] = {
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

_ABOVE: dict[str, tuple[Stroke, ...]] = {
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
        return han_glyph(character)
    apart = unicodedata.normalize("NFD", character)
    glyph = _drawn(_STROKES[apart[0]], _STROKE)
    for mark in apart[1:]:
        lowered = affinity.scale(glyph, 1, _UNDER_MARK, origin=(0, 1))
        glyph = shapely.union(lowered, _drawn(_ABOVE[mark], _FINE_STROKE), grid_size=1e-4)
    return affinity.translate(glyph, -GLYPH_WIDTH / 2, -0.5)


def _drawn(strokes: tuple[Stroke, ...], pen: float) -> shapely.Geometry:
    """Outline of strokes in a cell."""
    lines = [
        shapely.LineString(stroke).buffer(pen / 2, cap_style="flat", join_style="mitre")
        if stroke[0] != stroke[-1]
        else shapely.LinearRing(stroke).buffer(pen / 2, join_style="mitre")
        for stroke in strokes
    ]
    return shapely.intersection(shapely.union_all(lines), shapely.box(0, 0, GLYPH_WIDTH, 1), grid_size=1e-4)
