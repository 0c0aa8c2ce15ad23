"""Stalls, columns and outlines of an OSM XML file: its closed ways and multipolygons."""

from collections.abc import Iterator, Mapping

from garage2usd.survey.osm_elements import OsmElements, ring_of
from garage2usd.survey.osm_levels import OsmArea

STALL_AMENITIES = {"parking_space"}
_STALL_SUBTYPES = {"parking", "parking_spot", "parking_space"}
_HATCHED, SPACE = "hatched_road_markings", "parking_space"


def is_stall(tags: Mapping[str, str]) -> bool:
    """Return True for the tags of a stall."""
    is_area = tags.get("type") in {"multipolygon", "area"} or tags.get("area") == "yes"
    return (
        tags.get("amenity") in STALL_AMENITIES
        or (is_area and tags.get("subtype") in _STALL_SUBTYPES)
        or ("use" in tags and (tags.get("type") == _HATCHED or tags.get("area:highway") == "prohibited"))
    )


def areas_of(osm: OsmElements) -> Iterator[tuple[str, Mapping[str, str], tuple[int, ...] | None]]:
    """Yield relations and ways that may enclose ground, as name, tags and ring of nodes; None if they are not closed.

    A way whose relation is yielded with the same meaning is left out.
    """
    of_relations = set()
    for relation in osm.relations.values():
        if relation.tags.get("type") == "multipolygon":
            outer = relation.ways("outer", "")
            if is_stall(relation.tags):
                of_relations.update(outer)
            lines = [osm.ways[way].nodes for way in outer if way in osm.ways]
            is_whole = len(lines) == len(outer)
            yield relation.name, relation.tags, ring_of(lines) if is_whole else None
    for number, way in osm.ways.items():
        if number in of_relations and is_stall(way.tags):
            continue
        if way.is_closed or way.tags.get("area") == "yes" or way.tags.get("type") in {"area", _HATCHED}:
            ring = way.nodes[:-1] if way.is_closed else way.nodes
            yield way.name, way.tags, ring if len(ring) > 2 else None  # noqa: PLR2004 - a triangle
        elif is_stall(way.tags):
            yield way.name, way.tags, None


def stalls_of(osm: OsmElements) -> Iterator[OsmArea]:
    """Yield the stalls of a file."""
    for _, tags, ring in areas_of(osm):
        if is_stall(tags):
            yield OsmArea(tags, ring or ())
    for way in osm.ways.values():
        if way.tags.get("type") == SPACE:
            yield OsmArea(way.tags, way.nodes)
