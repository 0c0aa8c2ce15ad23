"""One-way lanes beside each other in opposite directions as one two-way lane, as maps split them at junctions."""

import math
from collections.abc import Sequence

import numpy as np
import shapely

from garage2usd.survey.lanelets import line_between
from garage2usd.survey.survey import SurveyedLane

_GAP_M = 0.5
"""Gap between the sides of two lanes up to which they are one."""


def paired_lanes(lanes: Sequence[SurveyedLane]) -> list[SurveyedLane]:
    """Return lanes, of which each two one-way ones that touch from end to end in opposite directions are one.

    The centre line lies in the middle between both, and the lane is as wide as both with the gap between them.
    """
    lines = [shapely.LineString(lane.points) for lane in lanes]
    starts = shapely.STRtree([shapely.Point(lane.points[0]) for lane in lanes])
    taken: set[int] = set()
    found = []
    for number, lane in enumerate(lanes):
        if number in taken:
            continue
        other = _partner(number, lanes, lines, starts, taken) if lane.one_way and lane.width_m else None
        if other is None:
            found.append(lane)
            continue
        taken.add(other)
        back = lanes[other]
        line, apart_m = line_between(np.array(lane.points), np.array(back.points)[::-1])
        width_m = apart_m + _half_m(lane) + _half_m(back)
        found.append(SurveyedLane(tuple((round(x, 6), round(z, 6)) for x, z in line), round(width_m, 6)))
    return found


def _half_m(lane: SurveyedLane) -> float:
    return (lane.width_m or 0.0) / 2


def _partner(
    number: int,
    lanes: Sequence[SurveyedLane],
    lines: Sequence[shapely.LineString],
    starts: shapely.STRtree,
    taken: set[int],
) -> int | None:
    """Return the nearest lane that leads back beside a one-way lane; None without one."""
    lane, end = lanes[number], shapely.Point(lanes[number].points[-1])
    best: tuple[float, int] | None = None
    for other in sorted(starts.query(end, predicate="dwithin", distance=2 * (lane.width_m or 0.0) + _GAP_M).tolist()):
        back = lanes[other]
        if other <= number or other in taken or not back.one_way or not back.width_m:
            continue
        most_m = _half_m(lane) + _half_m(back) + _GAP_M
        ends_m = math.dist(lane.points[0], back.points[-1]), math.dist(lane.points[-1], back.points[0])
        if max(ends_m) <= most_m:
            apart_m = round(float(lines[number].hausdorff_distance(lines[other])), 6)
            if apart_m <= most_m and (best is None or (apart_m, other) < best):
                best = apart_m, other
    return None if best is None else best[1]
