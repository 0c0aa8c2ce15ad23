"""Surveys as OSM XML: parking lots of OpenStreetMap, and garages as Lanelet2 maps with Autoware's tags."""

import math
import re
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import shapely

from garage2usd.garage import Point, StallUse
from garage2usd.survey.lanelets import lanes_of_lanelets
from garage2usd.survey.osm_areas import SPACE, STALL_AMENITIES, areas_of, is_stall, stalls_of
from garage2usd.survey.osm_elements import OsmElements, OsmWay, read_osm
from garage2usd.survey.osm_levels import OsmArea, OsmLevel, OsmLevels, one_way_of
from garage2usd.survey.osm_ramps import ramps_of
from garage2usd.survey.parking_spaces import ParkingSpace
from garage2usd.survey.parts import SurveyParts
from garage2usd.survey.survey import PortalKind, Survey, SurveyedPortal, Unplaced
from garage2usd.survey.surveyed_building import SurveyedBuilding, SurveyedLevel
from garage2usd.survey.text import length_of, portal_kind_of, size_of, unread_length, use_of

_MOST_IN_A_ROW = 1000
_COLUMNS = {"column", "columns", "pillar"}
_GATES = {"entrance", "gate", "lift_gate", "swing_gate", "sliding_gate", "toll_booth"}
_YES = {"yes", "true", "designated"}
_USE_TAGS = {
    "disabled": "disabled",
    "access:disabled": "disabled",
    "capacity:disabled": "disabled",
    "capacity:charging": "ev",
    "charging": "ev",
}
_BESIDE_M = 6.0
_AT_M = 1.0
_SPACE_M = 0.05
"""Distance from a stall's outline up to which the ends of Autoware's line for the same stall lie on it."""


def read_osm_survey(path: Path) -> Survey | SurveyedBuilding:
    """Read a survey from OpenStreetMap's data or a Lanelet2 map.

    Parameters
    ----------
    path
        OSM XML. Stalls are closed ways and multipolygons with ``amenity=parking_space`` or one of the subtypes
        ``parking``, ``parking_spot`` and ``parking_space``, and Autoware's ways ``type=parking_space`` of two points
        with a ``width``, or as far apart as they lie side by side. With a ``capacity`` above 1, an area is a row of as
        many stalls. Lanes are lanelets for vehicles, and ways ``service=parking_aisle``, and within the outline any
        ``highway=service``; areas of these are ground. Outlines are the areas ``amenity=parking`` with
        stalls. Columns are areas of the subtype ``Columns`` or ``indoor=column``, blocks ``indoor=room``. Entrances are
        nodes ``amenity=parking_entrance`` or gates, and service roads that cross the outline. Stalls on several levels
        (`OsmLevels`) make a building, with the ramps of `garage2usd.survey.osm_ramps`.

    Raises
    ------
    ConfigError
        If the file is not OSM XML; names the element.
    MissingExtraError
        For nodes without ``local_x`` and ``local_y``, without the extra ``maps``.
    """
    osm = read_osm(path)
    levels = OsmLevels(osm, [*stalls_of(osm)])
    if len(levels.names) < 2:  # noqa: PLR2004 - one above another
        return _survey(OsmLevel(osm, levels, levels.names[0] if levels.names else None))
    found = ramps_of(osm, levels)
    surveys = [
        _survey(
            OsmLevel(osm, levels, name, found.parts, found.to_street),
            [SurveyedPortal(place, kind) for level, place, kind in found.portals if level == name],
        )
        for name in levels.names
    ]
    named = zip(levels.names, surveys, strict=True)
    return SurveyedBuilding(
        tuple(SurveyedLevel(name, each, levels.ordinals[name], levels.floors_m.get(name)) for name, each in named),
        found.ramps,
        found.unread,
    )


def _survey(level: OsmLevel, portals: Sequence[SurveyedPortal] = ()) -> Survey:
    """Return the survey of one level, with some portals that its ramps to the street have."""
    osm, parts = level.osm, SurveyParts()
    parts.portals += portals
    _addstalls(parts, level)
    _add_lanelets(parts, level)
    for name, tags, ring in areas_of(osm):
        if ring is None or not level.holds(tags, ring):
            continue
        points = osm.line(ring)
        if not _COLUMNS.isdisjoint(tags.get(key, "").lower() for key in ("subtype", "indoor", "building:part")):
            parts.add_column(name, points)
        elif tags.get("indoor") == "room" or (tags.get("type") == "building" and tags.get("subtype") == "core"):
            parts.add_solid(name, points)
        elif tags.get("amenity") == "parking" or tags.get("building") == "parking":
            parts.add_outline(name, points, maxheight=tags.get("maxheight"))
    ground = shapely.MultiPolygon(list(map(shapely.Polygon, parts.outlines())))
    _add_ways(parts, level, ground)
    _add_portals(parts, level, ground)
    return parts.survey(origin_deg=osm.origin_deg)


def _addstalls(parts: SurveyParts, level: OsmLevel) -> None:
    osm = level.osm
    for name, tags, ring in areas_of(osm):
        if not is_stall(tags):
            continue
        title = tags.get("name") or name
        if not _is_read(parts, level, title, OsmArea(tags, ring or ())):
            continue
        if ring is None:
            parts.unread.append(Unplaced(title, "a stall whose ways do not close a ring"))
        else:
            use = _use(tags)
            size = size_of(tags[key] for key in ("parking_space", "parking_type", "size") if key in tags)
            number, count = tags.get("ref", ""), tags.get("capacity", "1")
            if count.isdecimal() and 1 < float(count) <= _MOST_IN_A_ROW:
                parts.add_row(title, osm.line(ring), int(count), use=_use(tags, of=count), size=size)
                continue
            parts.add_stall(
                title, osm.line(ring), mouth_at=_mouth(osm, name, tags, ring), use=use, size=size, number=number
            )
    for place, node in osm.nodes.items():
        if node.tags.get("amenity") in STALL_AMENITIES and level.holds(node.tags, (place,)):
            parts.unread.append(Unplaced(node.tags.get("name") or node.name, "a stall as a point, without an outline"))
    _add_spaces(parts, level)


def _is_read(parts: SurveyParts, level: OsmLevel, name: str, stall: OsmArea) -> bool:
    """Return True for a stall of the level; note one that is on none with stalls."""
    reason = level.reason_against("a stall", stall.tags, level.levels.of_stall(stall))
    if reason:
        parts.unread.append(Unplaced(name, reason))
    return reason is None


def _add_spaces(parts: SurveyParts, level: OsmLevel) -> None:
    """Add Autoware's parking spaces, lines along the middle of a stall, except those of stalls that are known."""
    osm, known = level.osm, shapely.STRtree(parts.stall_polygons())
    spaces = {}
    for number, way in osm.ways.items():
        if way.tags.get("type") != SPACE:
            continue
        name, line = way.tags.get("name") or way.name, osm.line(way.nodes)
        if not _is_read(parts, level, name, OsmArea(way.tags, way.nodes)):
            continue
        if len(line) != 2 or line[0] == line[1]:  # noqa: PLR2004 - from one end to the other
            parts.unread.append(Unplaced(name, f"a parking space of {len(way.nodes)} points instead of 2 apart"))
            continue
        around = known.query(shapely.LineString(line).interpolate(0.5, normalized=True), predicate="within")
        if not len(around) or not known.geometries[int(around[0])].buffer(_SPACE_M).contains(shapely.LineString(line)):
            spaces[number] = ParkingSpace(name, *line)
    found = list(spaces.values())
    middles = shapely.STRtree([shapely.LineString(space[1:]).centroid for space in found])
    for number, (key, space) in enumerate(spaces.items()):
        way = osm.ways[key]
        width_m = _width(parts, space.name, way.tags)
        if width_m is None and "width" not in way.tags:
            near = middles.query(middles.geometries[number], predicate="dwithin", distance=_BESIDE_M)
            width_m = space.usual_width_m(found[other] for other in sorted(near.tolist()) if other != number)
            parts.unread.append(Unplaced(space.name, f"a parking space without a width; {width_m:g} m are taken"))
        if width_m is not None:
            parts.add_stall(space.name, space.ring(width_m), use=_use(way.tags), number=way.tags.get("ref", ""))


def _mouth(osm: OsmElements, name: str, tags: Mapping[str, str], ring: tuple[int, ...]) -> Point | None:
    """Return the middle of the side of a stall that cars cross; None if unknown.

    It is the side that looks to the bearing ``mouth:direction``, or of a relation the only side that is virtual.
    """
    kind, _, number = name.partition(" ")
    if kind != "relation":
        return _towards(osm.line(ring), tags.get("mouth:direction", ""))
    ways = [osm.ways[way] for way in osm.relations[int(number)].ways("outer", "") if way in osm.ways]
    virtual = [way for way in ways if way.tags.get("type") == "virtual"]
    if len(virtual) != 1 or len(ways) != len(ring):
        return None
    (x, z), (end_x, end_z) = osm.line(virtual[0].nodes)[:2]
    return (x + end_x) / 2, (z + end_z) / 2


def _towards(ring: Sequence[Point], bearing: str) -> Point | None:
    """Return the middle of the side of a ring that looks to a bearing in degrees, clockwise from north."""
    if not re.fullmatch(r"\d{1,3}(\.\d{1,9})?", bearing) or len(ring) < 3:  # noqa: PLR2004 - a triangle
        return None
    clockwise = -1.0 if shapely.is_ccw(shapely.LinearRing(ring)) else 1.0  # as z leads downwards, seen from below
    bearing_rad = math.radians(float(bearing))
    ahead = np.array([math.sin(bearing_rad), -math.cos(bearing_rad)])
    corners = np.array(ring)
    sides = np.roll(corners, -1, axis=0) - corners
    outwards = clockwise * np.stack([-sides[:, 1], sides[:, 0]], axis=1) / np.linalg.norm(sides, axis=1)[:, None]
    side = int(np.argmax(outwards @ ahead))
    x, z = (corners[side] + sides[side] / 2).tolist()
    return x, z


def _use(tags: Mapping[str, str], *, of: str = "") -> StallUse:
    """Return the use of a stall, or of all stalls of a row; a count decides it if it equals the number of stalls."""
    said = [tags[key] for key in ("use", "parking_space", "parking_type") if key in tags]
    said += [word for key, word in _USE_TAGS.items() if _holds(tags.get(key, "no"), of)]
    if tags.get("wheelchair") == "designated":  # yes says only that wheelchairs may go there
        said.append("disabled")
    return use_of(said)


def _holds(value: str, of: str) -> bool:
    """Return True for ``yes`` and for numbers above 0; if a number is given, for that number only."""
    if value.isdecimal():
        return value == of if of else value.strip("0") != ""
    return value.lower() in _YES


def _add_lanelets(parts: SurveyParts, level: OsmLevel) -> None:
    for lane in lanes_of_lanelets(level.osm):
        if isinstance(lane, Unplaced):
            parts.unread.append(lane)
        elif lane.name not in level.on_ramps:
            reason = level.reason_against("a lane", lane.tags, level.levels_of(lane))
            if reason is None:
                parts.add_lane(lane.name, lane.points, lane.width_m, one_way=lane.one_way)
            elif reason:
                parts.unread.append(Unplaced(lane.name, reason))


def _add_portals(parts: SurveyParts, level: OsmLevel, ground: shapely.MultiPolygon) -> None:
    """Add the nodes that are entrances, and gates on an outline."""
    for number, node in level.osm.nodes.items():
        is_gate = node.tags.get("barrier") in _GATES and ground.boundary.dwithin(shapely.Point(node.position), _AT_M)
        if (is_gate or node.tags.get("amenity") == "parking_entrance") and level.holds_portal(number):
            parts.add_portal(node.position, portal_kind_of(node.tags.get("entrance", "")) or PortalKind.BOTH)
            parts.add_clear_height(node.tags.get("maxheight"))
    for way in level.osm.ways.values():
        told = portal_kind_of(way.tags.get("subtype", "")) if way.tags.get("type") == "gate" else None
        if told is not None and len(way.nodes) > 1 and level.holds(way.tags, way.nodes):
            (x, z), (end_x, end_z) = level.osm.line((way.nodes[0], way.nodes[-1]))
            parts.add_portal(((x + end_x) / 2, (z + end_z) / 2), told)


def _add_ways(parts: SurveyParts, level: OsmLevel, ground: shapely.MultiPolygon) -> None:
    """Add parking aisles, and other service roads that lie within the outline or cross it."""
    osm = level.osm
    for way in osm.ways.values():
        if way.tags.get("highway") != "service" or way.name in level.on_ramps:
            continue
        reason = _reason_against_lane(way, level)
        if reason is not None:
            parts.unread += [Unplaced(way.name, reason)] if reason else []
            continue
        width_m = _width(parts, way.name, way.tags)
        direction = one_way_of(way.tags)
        line = osm.line(way.nodes)[:: -1 if direction < 0 else 1]
        is_aisle = way.tags.get("service") == "parking_aisle"
        if is_aisle or shapely.LineString(line).intersection(ground).length > _SPACE_M:
            parts.add_lane(way.name, line, width_m, one_way=direction != 0)
        else:
            parts.unread.append(Unplaced(way.name, "a service road that is no parking aisle within the outline"))


def _reason_against_lane(way: OsmWay, level: OsmLevel) -> str | None:
    """Explain why a service way is not a lane of a level, as `OsmLevel.reason_against`; None if it is one."""
    reason = level.reason_against("a lane", way.tags, level.levels.of_way(way))
    if reason is None and way.tags.get("area") == "yes":
        return "a service area, which is ground and no lane"
    return "a lane without length" if reason is None and len(way.nodes) < 2 else reason  # noqa: PLR2004 - a line


def _width(parts: SurveyParts, name: str, tags: Mapping[str, str]) -> float | None:
    """Return the width of an element in metres; None if it has none, or one that is noted as unread."""
    if "width" not in tags:
        return None
    width_m = length_of(tags["width"])
    if width_m is None:
        parts.unread.append(Unplaced(name, unread_length("width", tags["width"])))
    return width_m
