"""Shapes of the Chinese characters on signs, drawn with a broad pen."""

import shapely
from shapely import affinity

__all__ = ["HAN_PITCH", "HAN_WIDTH", "han_glyph", "is_han"]

HAN_WIDTH = 1.0
"""Width of each character as a share of its height."""
HAN_PITCH = 1.12
"""From one character's middle to the next one's, as a share of their height."""
_PEN = 0.1
_FINE_PEN = 0.075
_FEW_STROKES = 5
"""Characters with more of them are drawn with the finer pen."""
_GRID = 1e-4

Stroke = tuple[tuple[float, float], ...]

# strokes (x, y) with y down, in a cell of 1 x 1; a loop ends where it starts
_STROKES: dict[str, tuple[Stroke, ...]] = {
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
}


def is_han(text: str) -> bool:
    """Whether a text is of these characters alone."""
    return bool(text) and all(character in _STROKES for character in text)


def han_glyph(character: str) -> shapely.Geometry:
    """A character that is 1 high, around the origin."""
    strokes = _STROKES[character]
    pen = _PEN if len(strokes) <= _FEW_STROKES else _FINE_PEN
    drawn = [
        shapely.LineString(stroke).buffer(pen / 2, cap_style="square", join_style="mitre", mitre_limit=2.0)
        if stroke[0] != stroke[-1]
        else shapely.LinearRing(stroke).buffer(pen / 2, join_style="mitre")
        for stroke in strokes
    ]
    glyph = shapely.intersection(shapely.union_all(drawn), shapely.box(0, 0, HAN_WIDTH, 1), grid_size=_GRID)
    return affinity.translate(glyph, -HAN_WIDTH / 2, -0.5)
