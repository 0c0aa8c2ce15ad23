"""The frame of a surveyed garage: axes along most of its stalls, and the origin at a corner of its outline."""

import math
from collections import defaultdict
from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple

import shapely

from garage2usd.garage import Point
from garage2usd.survey.survey import Survey

__all__ = ["Alignment", "aligned"]

_QUARTER = math.pi / 2
_BIN_RAD = math.radians(0.5)
_MARGIN_M = 0.1
"""Distance in metres between the parts of a survey without an outline and its walls."""
_CLOSED_M = 10.0
"""Half the width in metres of gaps between parts that belong to the garage."""
_FILLED = 0.7
"""Share of a rectangle around all parts from which on it is the outline."""
_SMOOTHED_M = 1.0
_USUAL_LANE_M = 6.0
_DIGITS = 6


class Alignment(NamedTuple):
    """How a survey was turned about its (0, 0), from x towards z, and then shifted."""

    turn_rad: float
    shift_m: Point


def aligned(survey: Survey) -> tuple[Survey, Alignment]:
    """Turn a survey so that most sides of its stalls lie along the axes, and shift its outline to (0, 0).

    Returns
    -------
    tuple
        The survey, which has an outline, and how it was moved.
    """
    turn_rad = -_main_direction_rad(survey)
    turned = survey.moved(turn_rad, (0.0, 0.0)) if turn_rad else survey
    if turned.outline is None:
        turned = replace(turned, outline=_outline_around(turned))
    assert turned.outline is not None
    left, top, _, _ = shapely.Polygon(turned.outline).bounds
    shift_m = round(-left, _DIGITS), round(-top, _DIGITS)
    return turned.moved(0.0, shift_m), Alignment(turn_rad, shift_m)


def _main_direction_rad(survey: Survey) -> float:
    """Return the direction of most metres of the sides of stalls, within an eighth of a turn either way of an axis."""
    lengths_m: defaultdict[int, float] = defaultdict(float)
    moments: defaultdict[int, float] = defaultdict(float)
    for stall in survey.stalls:
        for (x, z), (next_x, next_z) in pairwise((*stall.corners, stall.corners[0])):
            length_m = math.hypot(next_x - x, next_z - z)
            angle = math.remainder(math.atan2(next_z - z, next_x - x), _QUARTER)
            number = round(angle / _BIN_RAD)
            lengths_m[number] += length_m
            moments[number] += length_m * angle
    if not lengths_m:
        return 0.0
    main = max(lengths_m, key=lambda number: (round(lengths_m[number], 3), -abs(number)))
    near = [number for number in (main - 1, main, main + 1) if number in lengths_m]
    return round(sum(moments[number] for number in near) / sum(lengths_m[number] for number in near), 9)


def _outline_around(survey: Survey) -> tuple[Point, ...]:
    """Return an outline around all parts of a survey: a rectangle, unless the parts leave much of it empty."""
    parts: list[shapely.Geometry] = list(survey.stall_polygons())
    parts += [
        shapely.LineString(lane.points).buffer(width_m / 2, cap_style="flat", join_style="mitre")
        for lane in survey.lanes
        for width_m in [lane.width_m or _USUAL_LANE_M]
    ]
    parts += survey.column_polygons()
    rectangle = shapely.box(*shapely.total_bounds(parts)).buffer(_MARGIN_M, join_style="mitre")
    around = shapely.union_all(parts).buffer(_CLOSED_M, join_style="mitre").buffer(-_CLOSED_M, join_style="mitre")
    if around.geom_type == "Polygon" and around.area < _FILLED * rectangle.area:
        wider = shapely.Polygon(around.exterior).buffer(_SMOOTHED_M, join_style="mitre")
        outline = wider.simplify(_SMOOTHED_M - _MARGIN_M)
    else:
        outline = rectangle
    corners = shapely.get_coordinates(shapely.normalize(outline))[:-1]
    return tuple((round(float(x), 3), round(float(z), 3)) for x, z in corners)
