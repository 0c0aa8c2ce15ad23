"""Portals on a plan: vehicle doors, and the ramps behind them as far as the sheet has space."""

import math
from collections.abc import Iterator, Sequence

from garage2usd.garage import LaneKind
from garage2usd.layout import Layout, Placement
from garage2usd.layout.placement import of_spec
from garage2usd.objects.outline import rectangle
from garage2usd.objects.portal import PortalSpec
from garage2usd.objects.ramp import RampSpec
from garage2usd.view.drawing import Colour, Line, Point, Region, Text, text_width
from garage2usd.view.plan_lanes import LANE_COLOUR, LINE_M
from garage2usd.view.plan_sheet import ARROW_END_M, GREY, INK, PAPER, Sheet

__all__ = ["RAMP", "portals", "ramps", "turned"]

RAMP: Colour = (214, 216, 214)
_TREAD_M = 0.8
_BREAK_M = 0.35


def ramps(layout: Layout, sheet: Sheet) -> Iterator[Region | Line]:
    """Draw each ramp from its door to its end, or to a break line where the sheet cuts it off."""
    for place, spec in of_spec(layout.of_kind("ramp"), RampSpec):
        half, near = spec.width_m / 2, spec.profile[0][0]
        far = min(spec.profile[-1][0], sheet.ramp_m)
        yield turned(place, rectangle(-half, -far, half, -near), RAMP, "ramp")
        treads = range(1, math.ceil((far - near) / _TREAD_M))
        for run in (near + number * _TREAD_M for number in treads):
            yield _line(place, [(-half, -run), (half, -run)], PAPER, LINE_M / 2)
        for side in (-1, 1):
            outer = side * (half + spec.wall_m)
            yield turned(place, rectangle(min(side * half, outer), -far, max(side * half, outer), -near), INK, "ramp")
        if far < spec.profile[-1][0]:
            out = half + spec.wall_m
            zigzag = [(-out, -far), (-_BREAK_M, -far), (0.0, _BREAK_M - far), (0.0, -_BREAK_M - far)]
            yield _line(place, [*zigzag, (_BREAK_M, -far), (out, -far)], GREY, LINE_M)


def portals(layout: Layout, sheet: Sheet) -> Iterator[Region | Line | Text]:
    """Draw the jambs of each door, and outside of it an arrow with a word."""
    for place, spec in of_spec(layout.of_kind("portal"), PortalSpec):
        half, door, back = spec.length_m / 2, spec.door_width_m / 2, -spec.thickness_m
        for sides in ((-half, -door), (door, half)):
            yield turned(place, rectangle(sides[0], back, sides[1], 0.0), INK, "wall")
        kind = LaneKind.ENTRANCE if spec.is_entrance else LaneKind.EXIT
        yield turned(place, rectangle(-door, back, door, 0.0), LANE_COLOUR[kind], f"portal {kind}")
        tail, tip = (-3.0, -0.8) if spec.is_entrance else (-0.8, -3.0)
        wing = tip + math.copysign(0.9, tail - tip)
        strokes = [[(0.0, tail), (0.0, tip)], [(-0.8, wing), (0.0, tip), (0.8, wing)]]
        for stroke in strokes:
            yield Line([place.to_world(point) for point in stroke], LANE_COLOUR[kind], 0.35, "direction")
        word = "IN" if spec.is_entrance else "OUT"
        is_beside = abs(math.sin(place.yaw_rad)) > 0.5  # noqa: PLR2004 - a quarter turn
        half = (text_width(word, sheet.letters_m) if is_beside else sheet.letters_m) / 2
        yield Text(place.to_world((0.0, -ARROW_END_M - half)), word, sheet.letters_m, LANE_COLOUR[kind], kind="portal")


def turned(place: Placement, shape: Sequence[Point], colour: Colour, kind: str) -> Region:
    """Transform a shape to a placement."""
    return Region([place.to_world(point) for point in shape], colour, kind)


def _line(place: Placement, shape: Sequence[Point], colour: Colour, width_m: float) -> Line:
    return Line([place.to_world(point) for point in shape], colour, width_m, "ramp")
