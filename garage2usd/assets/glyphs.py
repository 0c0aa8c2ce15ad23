"""Painted digits as thin decals over the floor."""

import shapely

from garage2usd.assets.floor import flat_part
from garage2usd.assets.mesh import Asset

__all__ = ["DIGIT_LIFT_M", "floor_digit"]

DIGIT_LIFT_M = 0.003
_STROKE = 0.16
_WIDTH = 0.56
_CUT = 0.14

Stroke = tuple[tuple[float, float], ...]

# strokes (x, y) with y down, in a cell that is 1 high and 0.56 wide; a loop ends where it starts
_LEFT, _RIGHT, _TOP, _BOTTOM = _STROKE / 2, _WIDTH - _STROKE / 2, _STROKE / 2, 1 - _STROKE / 2
_MIDDLE = 0.5


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

_STROKES: dict[int, tuple[Stroke, ...]] = {
    0: (_loop(_TOP, _BOTTOM),),
    1: (((0.12, 0.2), (0.3, _TOP), (0.3, 1.0)),),
    2: ((*_HOOK_TOP, (_RIGHT, 0.38), (_LEFT, _BOTTOM), (_WIDTH, _BOTTOM)),),
    3: (
        (*_HOOK_TOP, (_RIGHT, _MIDDLE - _CUT), (_RIGHT - _CUT, _MIDDLE), (0.2, _MIDDLE)),
        ((0.2, _MIDDLE), *_BELLY, *_HOOK_BOTTOM),
    ),
    4: (((0.36, 1.0), (0.36, _TOP), (_LEFT, 0.68), (_WIDTH, 0.68)),),
    5: (((_WIDTH, _TOP), (_LEFT, _TOP), (_LEFT, _MIDDLE), *_BELLY, *_HOOK_BOTTOM),),
    6: (_loop(0.42, _BOTTOM), ((_LEFT, 0.6), (_LEFT, _TOP + _CUT), (_LEFT + _CUT, _TOP), (_RIGHT, _TOP))),
    7: (((0.0, _TOP), (_RIGHT, _TOP), (0.2, 1.0)),),
    8: (_loop(_TOP, _MIDDLE), _loop(_MIDDLE, _BOTTOM)),
    9: (_loop(_TOP, 0.58), ((_RIGHT, 0.4), (_RIGHT, _BOTTOM - _CUT), (_RIGHT - _CUT, _BOTTOM), (_LEFT, _BOTTOM))),
}


def floor_digit(digit: int, height_m: float) -> Asset:
    """A white digit whose top points to -Z, a few millimetres over the floor; origin in its middle."""
    strokes = [
        shapely.LineString(stroke).buffer(_STROKE / 2, cap_style="flat", join_style="mitre")
        if stroke[0] != stroke[-1]
        else shapely.LinearRing(stroke).buffer(_STROKE / 2, join_style="mitre")
        for stroke in _STROKES[digit]
    ]
    glyph = shapely.intersection(shapely.union_all(strokes), shapely.box(0, 0, _WIDTH, 1), grid_size=1e-4)
    placed = shapely.transform(glyph, lambda points: (points - (_WIDTH / 2, 0.5)) * height_m)
    part = flat_part("Paint", placed, "paint_white", height_m=DIGIT_LIFT_M, collider=None)
    return Asset("stall_number", (part,))
