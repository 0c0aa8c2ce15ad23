"""Surveys as DXF: floor plans of CAD programs, by the names of their layers and blocks and by the size of stalls."""

import re
from collections import Counter, defaultdict
from collections.abc import Sequence
from dataclasses import replace
from itertools import chain
from pathlib import Path
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.survey.drawing_words import PartKind, is_one_way, number_told, portal_told, size_told, use_told
from garage2usd.survey.dxf_drawing import Drawing, DrawnText, read_drawing
from garage2usd.survey.dxf_stalls import LEAST_STOREY_M, FoundStall, ShapesInMetres, line_or_point, stalls_in_metres
from garage2usd.survey.parts import SurveyParts
from garage2usd.survey.survey import Survey, Unplaced
from garage2usd.survey.surveyed_building import SurveyedBuilding, SurveyedLevel, SurveyedRamp
from garage2usd.survey.walls import add_column, add_doors, ground_within, ring_of, sides_m, solids_within

Floats = NDArray[np.float64]

_APART_M = 6.0
"""Half the distance from which on parts belong to different floor plans."""
_LEAST_DOOR_M, _AT_WALL_M = 2.1, 2.0
_BESIDE_M = 1.0
_GAP_M = 0.02
_MOST_SAME = 2
"""Stalls that a text may stand in to be a number."""
_LONGEST_WORD = 30
_LEVEL = re.compile(
    r"\b(?:[BPLU]\d|UG|EG|OG|-\d|level|floor|basement|ebene|niveau|nivel|planta|sótano|piano)|geschoss"
    r"|地下|负|层|층|階",
    re.IGNORECASE,
)
"""Words of the titles of floor plans."""
_DIGITS = 2


def read_dxf_survey(path: Path) -> Survey | SurveyedBuilding:
    """Read a survey from floor plans.

    Parameters
    ----------
    path
        A DXF. Names of layers and blocks tell stalls, lanes, columns, walls, outlines, doors, ramps, and stairs or
        lifts. Stalls are rings of their size, blocks of their size, and cells between lines; without a name for stalls,
        rings and cells of their size on any layer. Texts within a stall are its number, or tell its use. Stalls at
        several heights are levels. Of several floor plans beside each other, the one with the most stalls is read;
        the others are levels that are imported by name.

    Raises
    ------
    ConfigError
        If the file is not DXF.
    MissingExtraError
        Without the extra ``cad``.
    """
    drawing = read_drawing(path)
    unread: list[Unplaced] = []
    unit_m, found = stalls_in_metres(drawing, unread)
    unread.extend(Unplaced(f"{count} parts", reason) for reason, count in sorted(drawing.left_out.items()))
    heights_m = _floors_m(found)
    if len(heights_m) < 2:  # noqa: PLR2004 - levels over each other
        return _beside(found, drawing, unit_m, unread)
    levels, names = [], _level_names(found, heights_m)
    ramps = [shape for shape in drawing.shapes if shape.kind is PartKind.RAMP and len(shape.points) > 1]
    for height_m, name in zip(heights_m, names, strict=True):
        of_level = replace(
            drawing,
            shapes=[shape for shape in drawing.shapes if _is_at(shape.heights[0] * unit_m, height_m, heights_m)],
            texts=[text for text in drawing.texts if _is_at(text.height * unit_m, height_m, heights_m)],
        )
        stalls = [stall for stall in found if _is_at(stall.height_m, height_m, heights_m)]
        plans = _plans(stalls, ShapesInMetres(of_level, unit_m))
        apart = [Unplaced(f"{plan.stalls} stalls", f"a floor plan beside that of level {name}") for plan in plans[1:]]
        levels.append(
            SurveyedLevel(name, _survey(stalls, of_level, unit_m, plans[0].ground, apart), height_m, height_m)
        )
    joined = []
    for number, shape in enumerate(ramps):
        ends = [names[_nearest(heights_m, height * unit_m)] for height in shape.heights]
        if ends[0] != ends[1]:
            line = tuple((round(x, 6), round(z, 6)) for x, z in (shape.points * (unit_m, -unit_m)).tolist())
            width_m = shape.width * unit_m or None
            joined.append(
                SurveyedRamp(f"ramp {number + 1}", line, (ends[0], ends[1]), width_m, is_one_way(*shape.told))
            )
    return SurveyedBuilding(tuple(levels), tuple(joined), tuple(unread))


def _beside(
    found: Sequence[FoundStall], drawing: Drawing, unit_m: float, unread: Sequence[Unplaced]
) -> Survey | SurveyedBuilding:
    """Return the survey of the only floor plan, or the one with the most stalls as a level, and the others by name."""
    plans = _plans(found, ShapesInMetres(drawing, unit_m))
    if not plans:
        return Survey((), unread=tuple(unread))
    if len(plans) == 1:
        return _survey(found, drawing, unit_m, plans[0].ground, unread)
    names = _names_of_plans(plans, drawing, unit_m)
    told = [
        Unplaced(name, f"a floor plan of {plan.stalls} stalls beside {names[0]}; --level {name!r} imports it")
        for name, plan in zip(names[1:], plans[1:], strict=True)
    ]
    largest, *others = (
        SurveyedLevel(name, _survey(found, drawing, unit_m, plan.ground, notes), 0.0)
        for name, plan, notes in zip(names, plans, ([*unread, *told], *([unread] * len(told))), strict=True)
    )
    return SurveyedBuilding((largest,), others=tuple(others))


def _names_of_plans(plans: Sequence["_Plan"], drawing: Drawing, unit_m: float) -> list[str]:
    """Return the name of each floor plan: the largest text on it or beside it that tells a level, or else a number."""
    texts = sorted(drawing.texts, key=lambda text: -text.size)
    names: list[str] = []
    for number, plan in enumerate(plans):
        around = plan.ground.envelope.buffer(_APART_M, join_style="mitre")
        near = [
            text.text
            for text in texts
            if _LEVEL.search(text.text) and around.intersects(_place(text, unit_m)) and len(text.text) <= _LONGEST_WORD
        ]
        names.append(next((text for text in near if text not in names), f"plan {number + 1}"))
    return names


def _place(text: DrawnText, unit_m: float) -> shapely.Point:
    (x, y), *_ = text.places
    return shapely.Point(x * unit_m, -y * unit_m)


def _survey(
    found: Sequence[FoundStall], drawing: Drawing, unit_m: float, plan: shapely.Geometry, unread: Sequence[Unplaced]
) -> Survey:
    """Return the survey of a floor plan."""
    parts = SurveyParts()
    parts.unread.extend(unread)
    shapes = ShapesInMetres(drawing, unit_m)
    ours = [stall for stall in found if plan.intersects(shapely.Point(np.mean(stall.corners, axis=0)))]
    mouths = [shapely.LineString(line) for line in shapes.of(PartKind.MOUTH, plan) if len(line) > 1]
    _add_stalls(parts, ours, drawing, unit_m, mouths)
    stalls = parts.stall_polygons()
    for number, ring in enumerate(shapes.of(PartKind.COLUMN, plan, rings=True)):
        add_column(parts, f"column {number + 1}", shapely.Polygon(ring))
    rings = sorted(shapes.of(PartKind.OUTLINE, plan, rings=True), key=lambda ring: shapely.Polygon(ring).area)
    for number, ring in enumerate(rings):  # the inner faces of walls before the outer ones
        parts.add_outline(f"outline {number + 1}", ring)
    walls = [shapely.LineString(line) for line in shapes.of(PartKind.WALL, plan) if len(line) > 1]
    doors = [shapely.LineString(line) for line in shapes.of(PartKind.DOOR, plan) if len(line) == 2]  # noqa: PLR2004
    wide = [door for door in doors if door.length >= _LEAST_DOOR_M]
    outlines = parts.outlines()
    ground = shapely.Polygon(outlines[0]) if outlines else ground_within([*walls, *wide], stalls)
    if ground is not None:
        if not outlines:
            parts.add_outline("walls", ground.exterior.coords)
        for number, solid in enumerate(solids_within(walls, ground, stalls)):
            parts.add_solid(f"wall {number + 1}", ring_of(solid))
    for number, ring in enumerate(shapes.of(PartKind.SOLID, plan, rings=True)):
        parts.add_solid(f"block {number + 1}", ring_of(shapely.Polygon(ring)))
    _add_lanes(parts, shapes, plan, stalls)
    _add_portals(parts, shapes, plan, ground, drawing)
    return parts.survey()


def _floors_m(found: Sequence[FoundStall]) -> list[float]:
    """Return the heights in metres of levels with stalls, the lowest first; heights that are close are one level."""
    heights_m: list[float] = []
    for height_m in sorted(stall.height_m for stall in found):
        if not heights_m or height_m - heights_m[-1] > LEAST_STOREY_M:
            heights_m.append(round(height_m, 3))
    counts = Counter(_nearest(heights_m, stall.height_m) for stall in found)
    return [height_m for number, height_m in enumerate(heights_m) if counts[number] > 1]


def _nearest(heights_m: Sequence[float], height_m: float) -> int:
    return int(np.argmin(np.abs(np.array(heights_m) - height_m)))


def _is_at(height_m: float, level_m: float, levels_m: Sequence[float]) -> bool:
    return levels_m[_nearest(levels_m, height_m)] == level_m


def _level_names(found: Sequence[FoundStall], heights_m: Sequence[float]) -> list[str]:
    """Return the names of levels: the end of their stalls' layer after a ``_``, if these differ, else their heights."""
    ends = [
        {
            stall.told[0].rpartition("_")[2]
            for stall in found
            if stall.told and _is_at(stall.height_m, height_m, heights_m)
        }
        for height_m in heights_m
    ]
    names = [next(iter(end)) for end in ends if len(end) == 1]
    return names if len(set(names)) == len(heights_m) else [f"{height_m:g} m" for height_m in heights_m]


class _Plan(NamedTuple):
    """The ground of a floor plan and its number of stalls."""

    ground: shapely.Geometry
    stalls: int


def _plans(found: Sequence[FoundStall], shapes: ShapesInMetres) -> list[_Plan]:
    """Return the floor plans with stalls, the one with the most first."""
    if not found:
        return []
    stalls = [shapely.Polygon(stall.corners) for stall in found]
    middles = shapely.centroid(stalls)
    rings = [shapely.Polygon(ring) for ring in shapes.of(PartKind.OUTLINE, None, rings=True) if len(ring) > 3]  # noqa: PLR2004
    held = [ring.buffer(_BESIDE_M) for ring in rings if shapely.contains(ring, middles).sum() > 1]
    if len(held) > 1:  # stalls outside of all outlines are plans of their own
        outside = ~shapely.intersects(shapely.union_all(held), middles)
        around = held + [ground.buffer(_APART_M) for ground, is_out in zip(stalls, outside, strict=True) if is_out]
    else:
        around = held + [ground.buffer(_APART_M) for ground in stalls]
        for kind in (PartKind.WALL, PartKind.COLUMN):
            around += [line_or_point(line).buffer(_APART_M) for line in shapes.of(kind, None)]
    grounds = shapely.get_parts(shapely.union_all(around))
    plans = [_Plan(ground, int(shapely.intersects(ground, middles).sum())) for ground in grounds]
    return sorted((plan for plan in plans if plan.stalls), key=lambda plan: (-plan.stalls, *plan.ground.bounds))


def _add_stalls(
    parts: SurveyParts,
    found: Sequence[FoundStall],
    drawing: Drawing,
    unit_m: float,
    mouths: Sequence[shapely.LineString],
) -> None:
    grounds = shapely.STRtree([shapely.Polygon(stall.corners) for stall in found])
    texts: defaultdict[int, list[str]] = defaultdict(list)
    for text in drawing.texts:
        for x, y in text.places:
            within = grounds.query(shapely.Point(x * unit_m, -y * unit_m), predicate="intersects")
            if len(within):
                texts[int(within[0])].append(text.text)
                break
    entries = shapely.STRtree([mouth.interpolate(0.5, normalized=True) for mouth in mouths])
    common = Counter(text for said in texts.values() for text in set(said))
    for number, stall in enumerate(found):
        said = [text for text in texts[number] if len(text) <= _LONGEST_WORD]
        written = number_told(*(text for text in said if common[text] <= _MOST_SAME))
        names = (*said, *stall.told)
        name = written or stall.name
        edge = grounds.geometries[number].exterior
        along = [mouths[entry] for entry in entries.query(edge, predicate="dwithin", distance=_GAP_M).tolist()]
        own = [mouth for mouth in along if edge.buffer(_GAP_M).covers(mouth)]
        mouth_at = own[0].interpolate(0.5, normalized=True).coords[0] if own else None
        parts.add_stall(
            name, stall.corners, mouth_at=mouth_at, use=use_told(*names), size=size_told(*names), number=written
        )


def _add_lanes(
    parts: SurveyParts, shapes: ShapesInMetres, plan: shapely.Geometry, stalls: Sequence[shapely.Polygon]
) -> None:
    """Add the lines in the middle of lanes; areas and the edges of lanes, which run along stalls, are named."""
    around, edges, areas = shapely.union_all(list(stalls)), 0, 0
    for shape, points in shapes.pairs(PartKind.LANE, plan):
        if shape.is_closed or len(points) < 2:  # noqa: PLR2004 - a line
            areas += 1
        elif shapely.LineString(points).distance(around) < _BESIDE_M:
            edges += 1
        else:
            width_m = shape.width * shapes.unit_m or None
            parts.add_lane(shape.name, points.tolist(), width_m, one_way=is_one_way(*shape.told))
    for count, what in ((areas, "areas of lanes"), (edges, "lines along stalls, the edges of lanes")):
        if count:
            parts.unread.append(Unplaced(f"{count} parts", f"{what}, whose middle the drawing does not have"))


def _add_portals(
    parts: SurveyParts, shapes: ShapesInMetres, plan: shapely.Geometry, ground: shapely.Polygon | None, drawing: Drawing
) -> None:
    """Add the doors in the outline that are wide enough for cars, one for all shapes that touch each other."""
    if ground is None:
        return
    wide = plan.buffer(_APART_M)
    doors = [
        (line_or_point(points).buffer(_GAP_M), shape.told, len(points) == 1)
        for shape, points in shapes.pairs(PartKind.DOOR, wide)
    ]
    merged = shapely.get_parts(shapely.union_all([area for area, _, _ in doors]))
    found = []
    for area in merged:
        members = [(told, is_point) for other, told, is_point in doors if other.intersects(area)]
        middle = area.centroid if area.geom_type == "Polygon" else area
        is_wide = any(is_point for _, is_point in members) or sides_m(area)[1] >= _LEAST_DOOR_M
        if is_wide and middle.distance(ground.exterior) <= _AT_WALL_M:
            said = [text.text for text in drawing.texts if area.distance(_place(text, shapes.unit_m)) < _BESIDE_M]
            names = chain(said, *(told for told, _ in members))
            found.append((middle.coords[0], portal_told(*names)))
    add_doors(parts, found)
