"""Surveys as GeoJSON (RFC 7946): stalls and outlines as polygons, lanes as lines, columns and portals as points."""
# Over 300 lines: features of many kinds and levels end as the same parts.

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.documents import read_json
from garage2usd.garage import Point
from garage2usd.survey.parts import SurveyParts
from garage2usd.survey.stall_cells import stall_corners
from garage2usd.survey.survey import PortalKind, Survey, Unplaced
from garage2usd.survey.surveyed_building import SurveyedBuilding, SurveyedLevel, SurveyedRamp, ordinals_of
from garage2usd.survey.text import (
    length_of,
    levels_of,
    number_of,
    portal_kind_of,
    refuse,
    size_of,
    unread_length,
    use_of,
)

Floats = NDArray[np.float64]

_KIND_KEYS = ("kind", "type", "amenity", "service", "entrance", "highway")
_KINDS = {
    "stall": "stall",
    "parking_space": "stall",
    "parking_spot": "stall",
    "lane": "lane",
    "aisle": "lane",
    "parking_aisle": "lane",
    "service": "lane",
    "column": "column",
    "pillar": "column",
    "block": "block",
    "outline": "outline",
    "parking": "outline",
}
_UNNAMED = "area"
"""Kind of an area that tells none."""
_SHAPES = {
    "stall": ("Polygon", "MultiPolygon"),
    "outline": ("Polygon", "MultiPolygon"),
    "block": ("Polygon", "MultiPolygon"),
    "lane": ("LineString", "MultiLineString"),
    "column": ("Point", "MultiPoint", "Polygon", "MultiPolygon"),
    "portal": ("Point", "MultiPoint"),
    _UNNAMED: ("Polygon", "MultiPolygon"),
}
_NESTING = {"Point": 0, "MultiPoint": 1, "LineString": 1, "MultiLineString": 2, "Polygon": 2, "MultiPolygon": 3}
_COLUMN_M = 0.4
_MOST_BYTES = 40 * 1024 * 1024
"""Size limit of a file, which takes up to twenty times as much memory."""
_TRUE = {"yes", "true", "1", "-1", "reverse"}


class _Shape(NamedTuple):
    """A point, a line or the outer ring of a polygon: its feature, its meaning, and positions as given."""

    name: str
    kind: str
    properties: Mapping[str, Any]
    place: str
    positions: list[tuple[float, float]]
    is_area: bool
    portal: PortalKind


def read_geojson_survey(path: Path) -> Survey | SurveyedBuilding:
    """Read a survey from a GeoJSON object.

    Parameters
    ----------
    path
        A FeatureCollection or a Feature. Positions are longitude and latitude, or with the member
        ``"coordinates": "metres"`` of the outermost object metres east and north. The first of the properties ``kind``,
        ``type``, ``amenity``, ``service``, ``entrance`` and ``highway`` that has a known value tells what a feature is:
        ``stall`` or ``parking_space``, ``lane``, ``parking_aisle`` or ``service`` (with ``width``, ``oneway``),
        ``column`` (with ``size_m`` if it is a point), ``entrance``, ``exit`` or ``portal``, ``block``, and
        ``outline`` or ``parking``. Stalls may have ``use``, ``size``, ``number`` and ``mouth``, the number of the
        position of their ring at which the side begins that cars cross. Stalls with several values of ``level`` make a
        building; lanes with two levels are its ramps, from the first one or as ``incline`` (``up``, ``down``) tells.

    Raises
    ------
    ConfigError
        If the file is not GeoJSON; names the feature.
    MissingExtraError
        For longitudes and latitudes, without the extra ``maps``.
    """
    document = read_json(path, field="SOURCE", max_bytes=_MOST_BYTES)
    parts = SurveyParts()
    shapes = list(_shapes_of(document, path, parts))
    if any(shape.kind == "stall" for shape in shapes):
        shapes = [shape for shape in shapes if shape.kind != _UNNAMED]
    form = document.get("coordinates", "degrees")
    if form not in ("metres", "degrees"):
        refuse(f"{path.name}: coordinates", form, "'metres', or 'degrees' for longitude and latitude")
    origin_deg = None
    positions = np.array([position for shape in shapes for position in shape.positions]).reshape(-1, 2)
    ground: Floats = positions * (1.0, -1.0)
    if form == "degrees" and shapes:
        for shape in shapes:
            _check_degrees(shape)
        from garage2usd.survey.earth import ground_of  # noqa: PLC0415 - files in metres do without its extra

        ground, origin_deg = ground_of(positions, path.name)
    ends: list[int] = np.cumsum([len(shape.positions) for shape in shapes])[:-1].tolist() if shapes else []
    placed = [
        (shape, [(x, z) for x, z in points.tolist()])
        for shape, points in zip(shapes, np.split(ground, ends), strict=False)
    ]
    placed = list(_with_stalls_by_size(placed, parts.remarks))
    names = list(dict.fromkeys(name for shape, _ in placed if shape.kind == "stall" for name in _levels(shape)))
    if len(names) < 2:  # noqa: PLR2004 - one above another
        for shape, points in placed:
            _add(parts, shape, points)
        return parts.survey(origin_deg=origin_deg)
    return _building(placed, names, parts.unread, origin_deg)


def _with_stalls_by_size(
    placed: Sequence[tuple[_Shape, list[Point]]], remarks: list[str]
) -> Iterator[tuple[_Shape, list[Point]]]:
    """Yield shapes; areas without a kind that have the size of a stall are stalls, whose numbers are their names."""
    count = 0
    for shape, points in placed:
        if shape.kind != _UNNAMED:
            yield shape, points
        elif stall_corners(points) is not None:
            count += 1
            told = {"number": shape.properties.get("name")} | dict(shape.properties)
            yield shape._replace(kind="stall", properties=told), points
    if count:
        remarks.append(f"{count} areas that tell no kind are read as stalls, by their size")


def _building(
    placed: Sequence[tuple[_Shape, list[Point]]],
    names: Sequence[str],
    unread: Sequence[Unplaced],
    origin_deg: tuple[float, float] | None,
) -> SurveyedBuilding:
    """Return the levels with stalls, and lanes on two of them as ramps from the first level that they name."""
    collected = {name: SurveyParts() for name in names}
    ordinals = ordinals_of(names)
    ramps, missed = [], list(unread)
    for shape, points in placed:
        told = [name for name in _levels(shape) if name in collected]
        if shape.kind == "lane" and len(told) == 2 and len(points) > 1:  # noqa: PLR2004 - from one to the other
            width_m, way = _lane(shape, missed)
            climbs = {"up": 1, "down": -1}.get(str(shape.properties.get("incline", "")), 0)
            if climbs and climbs * (ordinals[told[1]] - ordinals[told[0]]) < 0:
                told.reverse()
            line = points[::-1] if way < 0 else points
            start, end = told[::-1] if way < 0 else told
            ramps.append(SurveyedRamp(shape.name, tuple(line), (start, end), width_m, way != 0))
            continue
        if _levels(shape) and not told:
            missed.append(Unplaced(shape.name, f"a {shape.kind} on level {', '.join(_levels(shape))} without stalls"))
        for name in told or ([] if _levels(shape) else names):
            _add(collected[name], shape, points)
    levels = tuple(
        SurveyedLevel(name, parts.survey(origin_deg=origin_deg), ordinals[name]) for name, parts in collected.items()
    )
    return SurveyedBuilding(levels, tuple(ramps), tuple(missed))


def _levels(shape: _Shape) -> list[str]:
    """Return the levels of a feature in the order in which it names them."""
    told = str(shape.properties.get("level", "") if shape.properties.get("level") is not None else "")
    words = told.split(";")
    return list(dict.fromkeys(name for word in words for name in sorted(levels_of({"level": word}))))


def _shapes_of(document: object, path: Path, parts: SurveyParts) -> Iterator[_Shape]:
    """Yield the shapes of all features with a known meaning."""
    if not isinstance(document, dict) or document.get("type") not in ("FeatureCollection", "Feature"):
        found = document.get("type", "nothing") if isinstance(document, dict) else document
        refuse(f"{path.name}: type", found, "a GeoJSON object of the type FeatureCollection or Feature")
    features = document.get("features", "nothing") if document["type"] == "FeatureCollection" else [document]
    if not isinstance(features, list):
        refuse(f"{path.name}: features", features, "a list of features")
    for index, feature in enumerate(features):
        place = f"{path.name}: features.{index}"
        if not isinstance(feature, dict) or feature.get("type") != "Feature":
            refuse(place, feature, "an object of the type Feature")
        properties = feature.get("properties") or {}
        if not isinstance(properties, dict):
            refuse(f"{place}.properties", properties, "an object or null")
        kind, portal = _kind_of(properties)
        geometry = feature.get("geometry")
        if kind is None and not (isinstance(geometry, dict) and geometry.get("type") in _SHAPES[_UNNAMED]):
            continue
        given = feature.get("id", properties.get("id", properties.get("name")))
        name = f"feature {index}" if given is None or isinstance(given, dict | list) else str(given)
        yield from _parts_of(geometry, _Shape(name, kind or _UNNAMED, properties, place, [], False, portal), parts)


def _kind_of(properties: Mapping[str, Any]) -> tuple[str | None, PortalKind]:
    for key in _KIND_KEYS:
        word = str(properties.get(key, "")).lower()
        if word in _KINDS:
            return _KINDS[word], PortalKind.BOTH
        portal = portal_kind_of(word)
        if portal is not None:
            return "portal", portal
    return None, PortalKind.BOTH


def _parts_of(geometry: object, shape: _Shape, parts: SurveyParts) -> Iterator[_Shape]:
    """Yield a shape for each point, line or polygon of a geometry."""
    place = f"{shape.place}.geometry"
    if geometry is None:
        parts.unread.append(Unplaced(shape.name, f"a {shape.kind} without geometry"))
        return
    if not isinstance(geometry, dict) or geometry.get("type") not in (*_NESTING, "GeometryCollection"):
        found = geometry.get("type", "nothing") if isinstance(geometry, dict) else geometry
        refuse(f"{place}.type", found, f"one of {', '.join(_NESTING)}, GeometryCollection")
    form = geometry["type"]
    if form not in _SHAPES[shape.kind]:
        reason = f"a {shape.kind} as a {form}; it may be a {' or '.join(_SHAPES[shape.kind])}"
        parts.unread.append(Unplaced(shape.name, reason))
        return
    coordinates = geometry.get("coordinates")
    members = coordinates if form.startswith("Multi") else [coordinates]
    if not isinstance(members, list):
        refuse(f"{place}.coordinates", members, f"the positions of a {form}")
    for number, member in enumerate(members):
        rings = member
        is_area = form.endswith("Polygon")
        if is_area:
            if not isinstance(rings, list) or not rings:
                refuse(f"{place}.coordinates", rings, "a list of rings, the outer one first")
            member, *holes = rings  # noqa: PLW2901 - the outer ring represents the polygon
            if holes:
                reason = f"the {len(holes)} holes in this {shape.kind}; they become floor"
                parts.unread.append(Unplaced(shape.name, reason))
        positions = [member] if form.endswith("Point") else member
        if not isinstance(positions, list):
            refuse(f"{place}.coordinates", positions, "a list of positions")
        name = shape.name if len(members) == 1 else f"{shape.name}, part {number + 1}"
        found = [_position(position, f"{place}.coordinates") for position in positions]
        yield shape._replace(name=name, positions=found, is_area=is_area)


def _position(position: object, place: str) -> tuple[float, float]:
    if not isinstance(position, list) or len(position) < 2:  # noqa: PLR2004 - x and y, perhaps a height
        refuse(place, position, "positions of two numbers or three")
    for value in position[:2]:
        if isinstance(value, str):
            refuse(place, value, "a number of degrees or metres")
    x, y = (number_of(value, place, unit="degrees or metres") for value in position[:2])
    return x, y


def _check_degrees(shape: _Shape) -> None:
    for longitude, latitude in shape.positions:
        if abs(longitude) > 180 or abs(latitude) > 90:  # noqa: PLR2004 - of the earth
            allowed = "longitude from -180 to 180 and latitude from -90 to 90; " + (
                "the longitude comes first, and these seem to be swapped"
                if abs(longitude) <= 90 and abs(latitude) <= 180  # noqa: PLR2004
                else 'metres need the member "coordinates": "metres" of the outermost object'
            )
            refuse(f"{shape.place}.geometry.coordinates", (longitude, latitude), allowed)


def _add(parts: SurveyParts, shape: _Shape, points: Sequence[Point]) -> None:
    properties = shape.properties
    if shape.kind == "stall":
        said = [str(properties[key]) for key in ("use", "parking_space", "access") if key in properties]
        if str(properties.get("disabled")).lower() in _TRUE or str(properties.get("disabled", "")) == "designated":
            said.append("disabled")
        number = next((properties[key] for key in ("number", "ref") if properties.get(key) is not None), "")
        size = size_of(str(properties[key]) for key in ("size", "parking_space") if key in properties)
        mouth_at = _mouth(parts, shape, points)
        parts.add_stall(shape.name, points, mouth_at=mouth_at, use=use_of(said), size=size, number=str(number))
    elif shape.kind == "lane":
        width_m, way = _lane(shape, parts.unread)
        parts.add_lane(shape.name, points[::-1] if way < 0 else points, width_m, one_way=way != 0)
    elif shape.kind == "outline":
        parts.add_outline(shape.name, points, maxheight=shape.properties.get("maxheight"))
        if ceiling_m := length_of(shape.properties.get("ceiling_height")):
            parts.ceiling_heights_m.append(ceiling_m)
    elif shape.kind == "block":
        parts.add_solid(shape.name, points[:-1] if points[0] == points[-1] else points)
    elif shape.kind == "portal":
        parts.add_portal(points[0], shape.portal)
    elif shape.is_area:
        parts.add_column(shape.name, points)
    else:
        size_m = length_of(properties.get("size_m", _COLUMN_M))
        if size_m is None:
            parts.unread.append(Unplaced(shape.name, unread_length("size_m", properties["size_m"])))
        parts.add_square_column(points[0], size_m or _COLUMN_M)


def _lane(shape: _Shape, unread: list[Unplaced]) -> tuple[float | None, int]:
    """Return the width of a lane, if known, and 1 or -1 if cars drive along its points or against them only, else 0."""
    properties = shape.properties
    key = next((key for key in ("width_m", "width") if properties.get(key) is not None), None)
    width_m = None if key is None else length_of(properties[key])
    if key is not None and width_m is None:
        unread.append(Unplaced(shape.name, unread_length(key, properties[key])))
    direction = str(properties.get("oneway", properties.get("one_way", "no"))).lower()
    return width_m, 0 if direction not in _TRUE else -1 if direction in {"-1", "reverse"} else 1


def _mouth(parts: SurveyParts, shape: _Shape, points: Sequence[Point]) -> Point | None:
    """Return the middle of the side of a stall that cars cross; None if it has none, or one that is noted as unread."""
    given = shape.properties.get("mouth")
    if given is None:
        return None
    ring = points[:-1] if points[0] == points[-1] else points
    if isinstance(given, bool) or not isinstance(given, int) or not 0 <= given < len(ring):
        parts.unread.append(Unplaced(shape.name, f"the mouth {given!r}, which is no number from 0 to {len(ring) - 1}"))
        return None
    (x, z), (next_x, next_z) = ring[given], ring[(given + 1) % len(ring)]
    return (x + next_x) / 2, (z + next_z) / 2
