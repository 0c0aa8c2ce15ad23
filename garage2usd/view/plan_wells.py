"""The ramps between levels on the plan of a level: treads, an arrow in the direction of driving, and where it leads."""

import math
from collections.abc import Iterator

from garage2usd.layout import Layout
from garage2usd.view.drawing import Line, Point, Region, Text
from garage2usd.view.plan_access import RAMP
from garage2usd.view.plan_lanes import LINE_M
from garage2usd.view.plan_sheet import INK, PAPER, Sheet

__all__ = ["level_title", "wells"]

_TREAD_M = 0.8
_ARROW_M, _WING_M = 6.0, 0.9
_STROKE_M = 0.25
_WORD_ASIDE_M = 1.6


def level_title(layout: Layout) -> str:
    """Return the level of a layout as the beginning of its title; empty in a garage of one level."""
    return f"{layout.well.name}: " if layout.well else ""


def wells(layout: Layout, sheet: Sheet) -> Iterator[Region | Line | Text]:
    """Draw the ramps that begin or end on a level."""
    if layout.well is None:
        return
    down, up = layout.well.lanes(layout.structure)
    for lane, is_down in ((down, True), (up, False)):
        (x, _, z), (end_x, _, end_z) = lane.points[0], lane.points[-1]
        run = math.dist((x, z), (end_x, end_z))
        along = (end_x - x) / run, (end_z - z) / run
        half = lane.width_m / 2

        def at(forward: float, aside: float, start: Point = (x, z), along: Point = along) -> Point:
            return start[0] + forward * along[0] - aside * along[1], start[1] + forward * along[1] + aside * along[0]

        yield Region([at(0, -half), at(0, half), at(run, half), at(run, -half)], RAMP, "ramp")
        for number in range(1, math.ceil(run / _TREAD_M)):
            yield Line([at(number * _TREAD_M, -half), at(number * _TREAD_M, half)], PAPER, LINE_M / 2, "ramp")
        tail, tip = (run - _ARROW_M) / 2, (run + _ARROW_M) / 2
        yield Line([at(tail, 0), at(tip, 0)], INK, _STROKE_M, "direction")
        yield Line([at(tip - _WING_M, -_WING_M), at(tip, 0), at(tip - _WING_M, _WING_M)], INK, _STROKE_M, "direction")
        word = ("down" if is_down else "up") + layout.well.way_in_words(is_down=is_down)
        yield Text(at(run / 2, _WORD_ASIDE_M), word, sheet.letters_m, INK, kind="ramp")
