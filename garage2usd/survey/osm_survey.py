"""Surveys as OSM XML: parking lots of OpenStreetMap, and garages as Lanelet2 maps with Autoware's tags."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import shapely

from garage2usd.garage import Point, StallUse
from garage2usd.survey.lanelets import lanes_of_lanelets
from garage2usd.survey.osm_elements import OsmElements, OsmWay, read_osm, ring_of
from garage2usd.survey.parts import SurveyParts
from garage2usd.survey.survey import Survey, Unplaced
from garage2usd.survey.text import length_of, levels_of, size_of, unread_length, use_of

_MOST_IN_A_ROW = 1000
_STALL_AMENITIES = {"parking_space"}
_STALL_SUBTYPES = {"parking", "parking_spot", "parking_space"}
_HATCHED = "hatched_road_markings"
_GATES = {"entrance", "gate", "lift_gate", "swing_gate", "sliding_gate", "toll_booth"}
_YES = {"yes", "true", "designated"}
_USE_TAGS = {
    "disabled": "disabled",
    "access:disabled": "disabled",
    "capacity:disabled": "disabled",
    "capacity:charging": "ev",
    "charging": "ev",
}
_ONE_WAY = {"yes": 1, "true": 1, "1": 1, "-1": -1, "reverse": -1}
_SPACE_M = 0.05
"""Distance from a stall's outline up to which the ends of Autoware's line for the same stall lie on it."""


def read_osm_survey(path: Path) -> Survey:
    """Read a survey from OpenStreetMap's data or a Lanelet2 map.

    Parameters
    ----------
    path
        OSM XML. Stalls are closed ways and multipolygons with ``amenity=parking_space`` or one of the subtypes
        ``parking``, ``parking_spot`` and ``parking_space``, and Autoware's ways ``type=parking_space`` of two points
        with a ``width``. With a ``capacity`` above 1, an area is a row of as many stalls. Lanes are lanelets for
        vehicles, and ways ``service=parking_aisle``, and within the outline any ``highway=service``; areas of these are
        ground. The outline is
        the one of ``amenity=parking`` with the most stalls. Columns are areas of the subtype ``Columns``. Entrances
        are nodes ``amenity=parking_entrance`` or gates, and service roads that cross the outline. If the stalls have
        tags ``level``, the level with the most stalls is read.

    Raises
    ------
    ConfigError
        If the file is not OSM XML; names the element.
    MissingExtraError
        For nodes without ``local_x`` and ``local_y``, without the extra ``maps``.
    """
    osm = read_osm(path)
    parts = SurveyParts()
    level = _level(osm)
    _add_stalls(parts, osm, level)
    _add_lanelets(parts, osm, level)
    for name, tags, ring in _areas(osm):
        if ring is None or not _is_on(tags, level):
            continue
        points = osm.line(ring)
        if tags.get("subtype", "").lower() in {"column", "columns", "pillar"}:
            parts.add_column(name, points)
        elif tags.get("amenity") == "parking" or tags.get("building") == "parking":
            parts.add_outline(name, points)
    outline = parts.outline()
    _add_ways(parts, osm, level, outline)
    _add_portals(parts, osm, level, outline)
    return parts.survey(origin_deg=osm.origin_deg)


def _is_stall(tags: Mapping[str, str]) -> bool:
    is_area = tags.get("type") in {"multipolygon", "area"} or tags.get("area") == "yes"
    return (
        tags.get("amenity") in _STALL_AMENITIES
        or (is_area and tags.get("subtype") in _STALL_SUBTYPES)
        or (tags.get("type") == _HATCHED and "use" in tags)
    )


def _areas(osm: OsmElements) -> Iterator[tuple[str, Mapping[str, str], tuple[int, ...] | None]]:
    """Yield relations and ways that may enclose ground, as name, tags and ring of nodes; None if they are not closed.

    A way whose relation is yielded with the same meaning is left out.
    """
    of_relations = set()
    for relation in osm.relations.values():
        if relation.tags.get("type") == "multipolygon":
            outer = relation.ways("outer", "")
            if _is_stall(relation.tags):
                of_relations.update(outer)
            lines = [osm.ways[way].nodes for way in outer if way in osm.ways]
            is_whole = len(lines) == len(outer)
            yield relation.name, relation.tags, ring_of(lines) if is_whole else None
    for number, way in osm.ways.items():
        if number in of_relations and _is_stall(way.tags):
            continue
        if way.is_closed or way.tags.get("area") == "yes" or way.tags.get("type") in {"area", _HATCHED}:
            ring = way.nodes[:-1] if way.is_closed else way.nodes
            yield way.name, way.tags, ring if len(ring) > 2 else None  # noqa: PLR2004 - a triangle
        elif _is_stall(way.tags):
            yield way.name, way.tags, None


def _level(osm: OsmElements) -> str | None:
    """Return the level with the most stalls, the first in the file of equal ones; None if no stall has one."""
    stalls = (tags for _, tags, _ in _areas(osm) if _is_stall(tags))
    levels = Counter(level for tags in stalls for level in sorted(levels_of(tags)))
    return levels.most_common(1)[0][0] if levels else None


def _is_on(tags: Mapping[str, str], level: str | None) -> bool:
    levels = levels_of(tags) if level is not None else set()
    return not levels or level in levels


def _add_stalls(parts: SurveyParts, osm: OsmElements, level: str | None) -> None:
    for name, tags, ring in _areas(osm):
        if not _is_stall(tags):
            continue
        title = tags.get("name") or name
        if not _is_on(tags, level):
            parts.unread.append(Unplaced(title, f"a stall on level {_told_level(tags)} instead of {level}"))
        elif ring is None:
            parts.unread.append(Unplaced(title, "a stall whose ways do not close a ring"))
        else:
            use = _use(tags)
            size = size_of(tags[key] for key in ("parking_space", "parking_type", "size") if key in tags)
            number, count = tags.get("ref", ""), tags.get("capacity", "1")
            if count.isdecimal() and 1 < float(count) <= _MOST_IN_A_ROW:
                parts.add_row(title, osm.line(ring), int(count), use=_use(tags, of=count), size=size)
                continue
            parts.add_stall(title, osm.line(ring), mouth_at=_mouth(osm, name, ring), use=use, size=size, number=number)
    for node in osm.nodes.values():
        if node.tags.get("amenity") in _STALL_AMENITIES:
            parts.unread.append(Unplaced(node.tags.get("name") or node.name, "a stall as a point, without an outline"))
    _add_spaces(parts, osm)


def _add_spaces(parts: SurveyParts, osm: OsmElements) -> None:
    """Add Autoware's parking spaces, lines along the middle of a stall, except those of stalls that are known."""
    known = shapely.STRtree(parts.stall_polygons())
    for way in osm.ways.values():
        if way.tags.get("type") != "parking_space":
            continue
        name = way.tags.get("name") or way.name
        line = osm.line(way.nodes)
        if len(line) != 2 or line[0] == line[1]:  # noqa: PLR2004 - from one end to the other
            parts.unread.append(Unplaced(name, f"a parking space of {len(way.nodes)} points instead of 2 apart"))
            continue
        middle = shapely.LineString(line).interpolate(0.5, normalized=True)
        around = known.query(middle, predicate="within")
        if len(around) and _lies_in(line, known.geometries[int(around[0])]):
            continue
        width_m = _width(parts, name, way.tags)
        if width_m is None:
            if "width" not in way.tags:
                parts.unread.append(Unplaced(name, f"a parking space without a width among {', '.join(way.tags)}"))
            continue
        half = width_m / 2
        (x, z), (end_x, end_z) = line
        length_m = ((end_x - x) ** 2 + (end_z - z) ** 2) ** 0.5
        off_x, off_z = -(end_z - z) / length_m * half, (end_x - x) / length_m * half
        ring = [
            (x - off_x, z - off_z),
            (x + off_x, z + off_z),
            (end_x + off_x, end_z + off_z),
            (end_x - off_x, end_z - off_z),
        ]
        parts.add_stall(name, ring, use=_use(way.tags), number=way.tags.get("ref", ""))


def _lies_in(line: Sequence[Point], stall: shapely.Polygon) -> bool:
    return bool(stall.buffer(_SPACE_M).contains(shapely.LineString(line)))


def _mouth(osm: OsmElements, name: str, ring: tuple[int, ...]) -> Point | None:
    """Return the middle of the only side of a stall's relation that is virtual, so that cars cross it."""
    kind, _, number = name.partition(" ")
    if kind != "relation":
        return None
    ways = [osm.ways[way] for way in osm.relations[int(number)].ways("outer", "") if way in osm.ways]
    virtual = [way for way in ways if way.tags.get("type") == "virtual"]
    if len(virtual) != 1 or len(ways) != len(ring):
        return None
    (x, z), (end_x, end_z) = osm.line(virtual[0].nodes)[:2]
    return (x + end_x) / 2, (z + end_z) / 2


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


def _add_lanelets(parts: SurveyParts, osm: OsmElements, level: str | None) -> None:
    for lane in lanes_of_lanelets(osm):
        if isinstance(lane, Unplaced):
            parts.unread.append(lane)
        elif _is_on(lane.tags, level):
            parts.add_lane(lane.name, lane.points, lane.width_m, one_way=lane.one_way)
        else:
            parts.unread.append(Unplaced(lane.name, f"a lane on level {_told_level(lane.tags)} instead of {level}"))


def _add_portals(parts: SurveyParts, osm: OsmElements, level: str | None, outline: tuple[Point, ...] | None) -> None:
    """Add the nodes that are entrances, and gates on the outline."""
    for node in osm.nodes.values():
        is_gate = node.tags.get("barrier") in _GATES and _is_near(node.position, outline)
        if (is_gate or node.tags.get("amenity") == "parking_entrance") and _is_on(node.tags, level):
            parts.add_portal(node.position)


def _add_ways(parts: SurveyParts, osm: OsmElements, level: str | None, outline: tuple[Point, ...] | None) -> None:
    """Add parking aisles, and other service roads that lie within the outline or cross it."""
    ground = None if outline is None else shapely.Polygon(outline)
    for way in osm.ways.values():
        if way.tags.get("highway") != "service":
            continue
        reason = _reason_against_lane(way, level)
        if reason:
            parts.unread.append(Unplaced(way.name, reason))
            continue
        width_m = _width(parts, way.name, way.tags)
        direction = _ONE_WAY.get(way.tags.get("oneway", "no").lower(), 0)
        line = osm.line(way.nodes)[:: -1 if direction < 0 else 1]
        is_aisle = way.tags.get("service") == "parking_aisle"
        if is_aisle or (ground is not None and shapely.LineString(line).intersection(ground).length > _SPACE_M):
            parts.add_lane(way.name, line, width_m, one_way=direction != 0)
        else:
            parts.unread.append(Unplaced(way.name, "a service road that is no parking aisle within the outline"))


def _reason_against_lane(way: OsmWay, level: str | None) -> str:
    """Explain why a service way is not a lane of a level; empty if it is one."""
    if not _is_on(way.tags, level):
        return f"a lane on level {_told_level(way.tags)} instead of {level}"
    if way.tags.get("area") == "yes":
        return "a service area, which is ground and no lane"
    return "a lane without length" if len(way.nodes) < 2 else ""  # noqa: PLR2004 - a line


def _is_near(position: Point, outline: tuple[Point, ...] | None) -> bool:
    if outline is None:
        return False
    return bool(shapely.Polygon(outline).exterior.distance(shapely.Point(position)) < 1.0)


def _width(parts: SurveyParts, name: str, tags: Mapping[str, str]) -> float | None:
    """Return the width of an element in metres; None if it has none, or one that is noted as unread."""
    if "width" not in tags:
        return None
    width_m = length_of(tags["width"])
    if width_m is None:
        parts.unread.append(Unplaced(name, unread_length("width", tags["width"])))
    return width_m


def _told_level(tags: Mapping[str, str]) -> str:
    return tags.get("level") or tags.get("repeat_on", "")
