"""Surveys as IMDF (Indoor Mapping Data Format, OGC 20-094): levels of a venue with stalls, rooms and openings."""

import json
import zipfile
from collections import defaultdict
from collections.abc import Iterator, Mapping
from pathlib import Path, PurePosixPath
from typing import Any, NamedTuple

import numpy as np
import shapely

from garage2usd.common.documents import MAX_REPORT_BYTES
from garage2usd.common.errors import ConfigError
from garage2usd.garage import Point
from garage2usd.survey.drawing_words import PartKind, kind_of, number_told, portal_told, size_told, use_told
from garage2usd.survey.earth import ground_of
from garage2usd.survey.parts import SurveyParts
from garage2usd.survey.stall_cells import stall_corners
from garage2usd.survey.survey import PortalKind, Unplaced
from garage2usd.survey.surveyed_building import SurveyedBuilding, SurveyedLevel, SurveyedRamp
from garage2usd.survey.walls import add_column, add_doors, ring_of

_READ = ("level", "unit", "section", "opening", "fixture", "kiosk", "relationship")
_GROUND = {"parking", "ramp", "road", "walkway", "walkway.island", "unenclosedarea", "unspecified", "lobby", "platform"}
"""Categories of units that are ground; all others are blocks on it."""
_MOST_FILES = 1000
_AT_WALL_M = 2.0


class _Feature(NamedTuple):
    """A feature: its type, id, level, category, names, and its geometry in metres, (x, z)."""

    kind: str
    name: str
    level: str
    category: str
    told: tuple[str, ...]
    properties: Mapping[str, Any]
    ground: shapely.Geometry


def read_imdf_survey(path: Path) -> SurveyedBuilding:
    """Read a survey from an archive or a folder of IMDF.

    Parameters
    ----------
    path
        A ``.zip`` of GeoJSON files, or the folder of these. Stalls are units and sections of the category ``parking``
        that have the size of a stall, with their name as the number; larger sections tell the use of stalls within
        them. Levels have their polygon as outline. Openings of the category ``automobile`` are entrances, columns are
        units and fixtures of this category, other rooms, kiosks and fixtures are blocks. Relationships of the category
        ``ramp`` join levels by their line.

    Raises
    ------
    ConfigError
        If there is no level in the archive, or a file is not GeoJSON.
    MissingExtraError
        Without the extra ``maps``.
    """
    features, origin_deg = _features(path)
    levels = {feature.name: feature for feature in features if feature.kind == "level"}
    if not levels:
        raise ConfigError("SOURCE", str(path), "IMDF, a zip or folder with level.geojson")
    of_level: defaultdict[str, list[_Feature]] = defaultdict(list)
    for feature in features:
        of_level[feature.level].append(feature)
    ordered = sorted(levels.values(), key=_ordinal)
    names = {level.name: _short_name(level) for level in ordered}
    if len(set(names.values())) < len(names):
        names = {level.name: f"{_ordinal(level):g}" for level in ordered}
    if len(set(names.values())) < len(names):
        names = {level.name: level.name for level in ordered}
    surveyed = []
    for level in ordered:
        parts = SurveyParts()
        _add(parts, level, of_level[level.name])
        surveyed.append(SurveyedLevel(names[level.name], parts.survey(origin_deg=origin_deg), _ordinal(level)))
    units = {feature.name: names[feature.level] for feature in features if feature.level in names}
    return SurveyedBuilding(tuple(surveyed), tuple(_ramps(features, units)))


def _features(path: Path) -> tuple[list[_Feature], tuple[float, float] | None]:
    """Return the features of all files in metres, and latitude and longitude of (0, 0)."""
    given: list[tuple[str, Mapping[str, Any], shapely.Geometry]] = []
    for name, text in _files(path):
        try:
            document = json.loads(text)
            members = document.get("features", [])
            for member in members:
                geometry = member.get("geometry")
                kind = str(member.get("feature_type") or PurePosixPath(name).stem)
                if kind in _READ and isinstance(member.get("properties"), dict):
                    given.append((kind, member, shapely.geometry.shape(geometry) if geometry else shapely.Point()))
        except (
            ValueError,
            AttributeError,
            TypeError,
            LookupError,
            shapely.errors.ShapelyError,
            RecursionError,
        ) as error:
            told = (str(error) or type(error).__name__).splitlines()[0][:120]
            raise ConfigError(f"{path.name}: {name}", told, "a FeatureCollection of GeoJSON") from None
    degrees = shapely.get_coordinates([geometry for *_, geometry in given])
    if not np.isfinite(degrees).all() or (len(degrees) and (np.abs(degrees).max(axis=0) > (180, 90)).any()):
        raise ConfigError(
            f"{path.name}: coordinates", "others", "longitudes from -180 to 180, latitudes from -90 to 90"
        )
    origin_deg: tuple[float, float] | None = None
    moved = degrees
    if len(degrees):
        moved, origin_deg = ground_of(degrees, path.name)
    found = []
    grounds = shapely.set_coordinates(np.array([geometry for *_, geometry in given], dtype=object), moved)
    for (kind, member, _), ground in zip(given, grounds, strict=True):
        properties = member["properties"]
        name, own = str(member.get("id")), kind == "level"
        texts = [word for key in ("name", "alt_name", "short_name") for word in _words(properties.get(key))]
        level = name if own else str(properties.get("level_id"))
        found.append(_Feature(kind, name, level, str(properties.get("category")), tuple(texts), properties, ground))
    return found, origin_deg


def _files(path: Path) -> Iterator[tuple[str, bytes]]:
    """Yield the names and contents of the files of features in an archive or a folder."""
    try:
        if path.is_dir():
            for file in sorted(path.glob("*.*json"))[:_MOST_FILES]:
                if file.stat().st_size > MAX_REPORT_BYTES:
                    raise ConfigError("SOURCE", str(file), f"a file of at most {MAX_REPORT_BYTES} bytes")
                yield file.name, file.read_bytes()
            return
        with zipfile.ZipFile(path) as archive:
            members = [member for member in archive.infolist() if member.filename.lower().endswith("json")]
            members = [member for member in members if "__MACOSX" not in member.filename]
            if len(members) > _MOST_FILES or sum(member.file_size for member in members) > MAX_REPORT_BYTES:
                raise ConfigError("SOURCE", str(path), f"IMDF of at most {_MOST_FILES} files, {MAX_REPORT_BYTES} bytes")
            for member in members:
                yield member.filename, archive.read(member)
    except (OSError, zipfile.BadZipFile, NotImplementedError, RuntimeError, EOFError) as error:
        told = (getattr(error, "strerror", None) or str(error)).splitlines()[0][:120]
        raise ConfigError("SOURCE", str(path), f"IMDF, a zip or a folder of GeoJSON files ({told})") from None


def _words(labels: object) -> list[str]:
    """Return the texts of labels by language, as {"en": "P2"}."""
    values = labels.values() if isinstance(labels, dict) else [labels]
    return [value for value in values if isinstance(value, str) and value]


def _ordinal(level: _Feature) -> float:
    value = level.properties.get("ordinal")
    return float(value) if isinstance(value, int | float) else 0.0


def _short_name(level: _Feature) -> str:
    short = _words(level.properties.get("short_name"))
    return (short or list(level.told) or [f"{_ordinal(level):g}"])[0]


def _add(parts: SurveyParts, level: _Feature, features: list[_Feature]) -> None:
    """Add the parts of a level."""
    for area in _areas(level.ground):
        parts.add_outline(level.name, area.exterior.coords)
    _add_stalls(parts, features)
    doors: list[tuple[Point, PortalKind]] = []
    for feature in features:
        if feature.kind == "opening" and feature.category == "automobile" and not feature.ground.is_empty:
            middle = feature.ground.centroid
            if level.ground.boundary.distance(middle) <= _AT_WALL_M:
                doors.append((middle.coords[0], portal_told(*feature.told)))
        elif (
            feature.kind in {"unit", "fixture", "kiosk"}
            and not _is_parking(feature)
            and feature.category not in _GROUND
        ):
            for area in _areas(feature.ground):
                if "column" in (feature.category, kind_of(" ".join(feature.told)) or ""):
                    add_column(parts, feature.name, area)
                else:
                    parts.add_solid(feature.name, ring_of(area))
    add_doors(parts, doors)


def _add_stalls(parts: SurveyParts, features: list[_Feature]) -> None:
    stalls = [feature for feature in features if feature.kind in {"unit", "section"} and _is_parking(feature)]
    zones = [feature for feature in stalls if feature.kind == "section" and not _corners(feature)]
    for stall in stalls:
        corners = _corners(stall)
        if not corners:
            continue
        within = [zone.category for zone in zones if zone.ground.contains(stall.ground.centroid)]
        said = (*stall.told, stall.category, *within)
        number = number_told(*stall.told)
        parts.add_stall(number or stall.name, corners, use=use_told(*said), size=size_told(*said), number=number)
    larger = [stall.name for stall in stalls if stall.kind == "unit" and not _corners(stall)]
    if larger and not parts.stalls:
        parts.unread.append(
            Unplaced(larger[0], "a unit of the category parking, larger than a stall, and none within it")
        )


def _is_parking(feature: _Feature) -> bool:
    named = feature.kind == "unit" and feature.category in _GROUND and kind_of(" ".join(feature.told)) is PartKind.STALL
    return named or feature.category.partition(".")[0] == "parking"


def _corners(feature: _Feature) -> tuple[Point, ...] | None:
    areas = _areas(feature.ground)
    return stall_corners(areas[0].exterior.coords) if len(areas) == 1 else None


def _areas(ground: shapely.Geometry) -> list[shapely.Polygon]:
    return [part for part in shapely.get_parts(ground) if part.geom_type == "Polygon" and not part.is_empty]


def _ramps(features: list[_Feature], level_of: Mapping[str, str]) -> Iterator[SurveyedRamp]:
    """Yield the ramps between units of different levels."""
    for feature in features:
        if feature.kind != "relationship" or feature.category != "ramp" or feature.ground.geom_type != "LineString":
            continue
        ends = [feature.properties.get(key) for key in ("origin", "destination")]
        levels = [level_of.get(str(end.get("id")), "") if isinstance(end, dict) else "" for end in ends]
        if all(levels) and levels[0] != levels[1]:
            line = tuple((round(float(x), 6), round(float(z), 6)) for x, z in feature.ground.coords)
            one_way = feature.properties.get("direction") == "directed"
            yield SurveyedRamp(feature.name, line, (levels[0], levels[1]), None, one_way)
