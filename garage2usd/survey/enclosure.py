"""The outline of a survey around its stalls, and its lanes within: one portal where a road crosses the outline."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

import shapely
import shapely.ops

from garage2usd.garage import Point
from garage2usd.survey.survey import PortalKind, Survey, SurveyedLane, SurveyedPortal

NEAR_M = 12.0
"""Greatest distance in metres from the outline of stalls that it is drawn around: those beyond a lane beside it."""
BEYOND_M = 0.05
"""Distance in metres up to which stalls and lanes lie on the outline."""
_SLOT_M = 0.5
"""Half the width in metres of slots between the outline and stalls beyond it that become ground."""
_LEAST_LANE_M = 1.0
"""Length in metres of the parts of lanes inside and outside the outline that count."""
_PORTAL_M = 6.0
"""Distance in metres up to which a portal is that of a road which crosses the outline."""
_LANE_M = 6.0
REACH_M = 9.0
"""Greatest distance in metres of a lane beyond the outline that serves a stall."""
_DIGITS = 6


def enclosed(survey: Survey) -> Survey:
    """Return a survey with an outline as one whose stalls and lanes lie inside it, with the portals where roads cross.

    Notes
    -----
    The outline is drawn around stalls that lie on it or near it, and around lanes if it has none inside. A road that
    crosses the outline ends there, at a portal; a portal of the survey near that place is the same one. A one-way road
    makes an entrance or an exit.
    """
    if survey.outline is None:
        return survey
    survey = _around_stalls(survey)
    assert survey.outline is not None
    ground = shapely.Polygon(survey.outline)
    wide = ground.buffer(BEYOND_M, join_style="mitre")
    lines = [shapely.LineString(lane.points) for lane in survey.lanes]
    if lines and all(line.intersection(wide).length < _LEAST_LANE_M for line in lines):
        return _around_lanes(survey)
    lanes: list[SurveyedLane] = []
    crossings: list[SurveyedPortal] = []
    outside_m = 0.0
    for lane, line in zip(survey.lanes, lines, strict=True):
        if line.difference(wide).length < _LEAST_LANE_M:
            lanes.append(lane)
            continue
        outside_m += line.difference(wide).length
        for points in parts_inside(line, ground):
            lanes.append(replace(lane, points=points))
            for at, end, kind in ((0, 0, PortalKind.ENTRANCE), (-1, -1, PortalKind.EXIT)):
                if math.dist(points[at], line.coords[end]) > BEYOND_M or line.is_ring:
                    crossings.append(SurveyedPortal(points[at], kind if lane.one_way else PortalKind.BOTH))
    if not outside_m:
        return survey
    told = f"{outside_m:.1f} m of lanes lie beyond the outline; they end where they cross it"
    portals = tuple(_merged(survey.portals, _single(crossings)))
    return replace(survey, lanes=tuple(lanes), portals=portals, remarks=(*survey.remarks, told))


def _around_stalls(survey: Survey) -> Survey:
    """Draw the outline around stalls that lie on it or near it."""
    ground = shapely.Polygon(survey.outline)
    shapes = survey.stall_polygons()
    held = ground.buffer(BEYOND_M, join_style="mitre")
    near = [number for number, shape in enumerate(shapes) if not held.covers(shape)]
    if near:
        wider = shapely.union_all([ground, *(shapes[number] for number in near)])
        slot_m = _SLOT_M if all(ground.dwithin(shapes[number], BEYOND_M) for number in near) else NEAR_M / 2
        closed = wider.buffer(slot_m, join_style="mitre").buffer(-slot_m, join_style="mitre")
        around = shapely.union_all([shapes[number] for number in near]).buffer(slot_m + NEAR_M / 2, join_style="mitre")
        named = survey.stalls[near[0]].name + (f" and {len(near) - 1} more stalls" if len(near) > 1 else "")
        outline = corners_around(shapely.union_all([wider, closed.intersection(around)]))
        told = f"the outline leaves out ground of {named}; it is drawn around it"
        survey = replace(survey, outline=outline, remarks=(*survey.remarks, told))
    return survey


def _around_lanes(survey: Survey) -> Survey:
    """Draw the outline around the lanes that serve its stalls, as it has none inside."""
    stalls = shapely.union_all(survey.stall_polygons())
    near = stalls.buffer(REACH_M)
    served = [
        replace(lane, points=points)
        for lane in survey.lanes
        for points in parts_inside(shapely.LineString(lane.points), near)
    ]
    if not served:
        told = f"its lanes are more than {REACH_M:g} m away from all stalls; others are laid on its free ground"
        return replace(survey, lanes=(), remarks=(*survey.remarks, told))
    strips = [
        shapely.LineString(lane.points).buffer((lane.width_m or _LANE_M) / 2, cap_style="flat", join_style="mitre")
        for lane in served
    ]
    wider = shapely.union_all([shapely.Polygon(survey.outline), stalls, *strips])
    wider = wider.buffer(_SLOT_M * 2, join_style="mitre").buffer(-_SLOT_M * 2, join_style="mitre")
    if wider.geom_type != "Polygon":
        return survey
    told = "the outline has no lanes inside; it is drawn around those beside it"
    return replace(survey, outline=corners_around(wider), lanes=tuple(served), remarks=(*survey.remarks, told))


def parts_inside(line: shapely.LineString, ground: shapely.Geometry) -> Iterator[tuple[Point, ...]]:
    """Yield the parts of a line inside a ground, in its direction; parts with a short gap between are one."""
    cuts = line.intersection(shapely.boundary(ground))
    runs = sorted({0.0, line.length, *(line.project(shapely.Point(place)) for place in shapely.get_coordinates(cuts))})
    spans: list[list[float]] = []
    for start, end in pairwise(runs):
        if not ground.covers(line.interpolate((start + end) / 2)):
            continue
        if spans and start - spans[-1][1] < _LEAST_LANE_M:
            spans[-1][1] = end
        else:
            spans.append([start, end])
    for start, end in spans:
        if end - start >= _LEAST_LANE_M:
            part = shapely.ops.substring(line, start, end)
            yield tuple((round(float(x), _DIGITS), round(float(z), _DIGITS)) for x, z in part.coords)


def _single(crossings: Sequence[SurveyedPortal]) -> list[SurveyedPortal]:
    """Return crossings without those of the same road in another part of the survey."""
    found: list[SurveyedPortal] = []
    for crossing in crossings:
        if all(math.dist(crossing.position, other.position) > _LEAST_LANE_M for other in found):
            found.append(crossing)
    return found


def _merged(portals: Sequence[SurveyedPortal], crossings: Sequence[SurveyedPortal]) -> Iterator[SurveyedPortal]:
    """Yield the portals of a survey and of the roads that cross its outline: one for each road."""
    given: dict[int, list[SurveyedPortal]] = {}
    for portal in portals:
        away_m = [math.dist(portal.position, crossing.position) for crossing in crossings]
        nearest = away_m.index(min(away_m)) if away_m else -1
        if nearest < 0 or away_m[nearest] > _PORTAL_M:
            yield portal
        else:
            given.setdefault(nearest, []).append(portal)
    for number, crossing in enumerate(crossings):
        kinds = {portal.kind for portal in given.get(number, ())}
        if kinds == {PortalKind.ENTRANCE, PortalKind.EXIT}:
            yield from given[number]
        else:
            kinds -= {PortalKind.BOTH}
            yield crossing._replace(kind=kinds.pop()) if len(kinds) == 1 else crossing


def corners_around(ground: shapely.Geometry) -> tuple[Point, ...]:
    """Return the corners of the largest part of a ground."""
    largest = max(shapely.get_parts(ground), key=lambda part: part.area)
    places = shapely.get_coordinates(shapely.Polygon(largest.exterior).simplify(1e-3).exterior)[:-1]
    return tuple((round(float(x), _DIGITS), round(float(z), _DIGITS)) for x, z in places)
