"""OpenStreetMap's XML of a garage, with the tags that mappers use for parking, as `garage2usd import` reads it."""

import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from garage2usd.as_built import BuiltGarage
from garage2usd.config.outputs import MapsConfig
from garage2usd.garage import Stall, StallKind, StallUse
from garage2usd.maps.facts import stage_facts
from garage2usd.maps.georeference import georeference
from garage2usd.maps.ground_plan import GroundPlan, LevelPlan, ground_plan, level_number
from garage2usd.maps.xml_text import number_text, tag_text, write_lines

_POINT_DIGITS = 4
"""Decimals of the metres in which places of points are equal."""
_WIDTH_DIGITS, _BEARING_DIGITS = 3, 1
_ORIENTATIONS = {
    StallKind.PERPENDICULAR: "perpendicular",
    StallKind.ANGLED: "diagonal",
    StallKind.PARALLEL: "parallel",
}
_SPACES = {
    StallUse.ACCESSIBLE: {"parking_space": "disabled"},
    StallUse.EV: {"parking_space": "charging"},
    StallUse.MOTORCYCLE: {"parking_space": "motorcycle", "use": "motorcycle"},
}


class _Element(NamedTuple):
    """A node or a way: points (x, y) of the map frame, and if these are a ring."""

    points: NDArray[np.float64]
    is_ring: bool
    tags: Mapping[str, str]


def write_openstreetmap(
    garage: BuiltGarage, path: Path, settings: MapsConfig, *, plan: GroundPlan | None = None
) -> None:
    """Write the ground plan of a garage as OSM XML.

    Parameters
    ----------
    garage
        The garage.
    path
        The file, in an existing folder.
    settings
        Geographic position of a garage whose survey had none.
    plan
        Its ground plan, if already known.

    Notes
    -----
    Stalls are areas ``amenity=parking_space``, hatched ground ``area:highway=prohibited``, lanes ways
    ``service=parking_aisle``, ``mouth:direction`` the bearing out of a stall, doors nodes ``amenity=parking_entrance``,
    and the outline ``amenity=parking``. Elements of a garage of several levels have ``level``. Editors are told never
    to upload the file.
    """
    place = georeference(garage.stage, settings)
    elements = list(_elements(plan or ground_plan(garage), place.turn_rad))
    numbers: dict[tuple[float, float, str], int] = {}
    lines_of: list[list[int]] = []
    for element in elements:
        level = element.tags.get("level", "")
        keys = [(x, y, level) for x, y in (element.points.round(_POINT_DIGITS) + 0.0).tolist()]
        lines_of.append([numbers.setdefault(key, len(numbers) + 1) for key in keys])
    degrees = place.degrees([key[:2] for key in numbers])
    tags_of = {
        line[0]: element.tags for element, line in zip(elements, lines_of, strict=True) if len(element.points) == 1
    }
    generator = f"garage2usd {stage_facts(garage.stage).get('version', '')}".strip()
    lines = [f"{tag_text('osm', {'version': '0.6', 'generator': generator, 'upload': 'never'})}>"]
    for number, (longitude, latitude) in zip(numbers.values(), degrees.tolist(), strict=True):
        at = {"id": str(number), "version": "1", "lat": f"{latitude:.10f}", "lon": f"{longitude:.10f}"}
        lines += _lines("node", at, [], tags_of.get(number, {}))
    ways = [(element, line) for element, line in zip(elements, lines_of, strict=True) if len(element.points) > 1]
    for number, (element, line) in enumerate(ways, len(numbers) + 1):
        points = [*line, line[0]] if element.is_ring else line
        lines += _lines("way", {"id": str(number), "version": "1"}, points, element.tags)
    write_lines([*lines, "</osm>"], path)


def _lines(tag: str, attributes: Mapping[str, str], points: list[int], tags: Mapping[str, str]) -> Iterator[str]:
    if not points and not tags:
        yield f"  {tag_text(tag, attributes)} />"
        return
    yield f"  {tag_text(tag, attributes)}>"
    yield from (f'    <nd ref="{point}" />' for point in points)
    yield from (f"    {tag_text('tag', {'k': key, 'v': value})} />" for key, value in tags.items())
    yield f"  </{tag}>"


def _elements(plan: GroundPlan, turn_rad: float) -> Iterator[_Element]:
    for level in plan.levels:
        on = {"level": level.number} if level.number else {}
        for points, is_ring, tags in _of_level(level, turn_rad):
            yield _Element(points, is_ring, {**tags, **on})
    for ramp in plan.ramps:
        tags = {
            **_road(ramp.lane.width_m, one_way=True),
            "level": f"{level_number(ramp.start)};{level_number(ramp.end)}",
            "incline": "down" if ramp.heights_m[-1] < ramp.heights_m[0] else "up",
        }
        yield _Element(ramp.lane.points, False, tags)


def _of_level(level: LevelPlan, turn_rad: float) -> Iterator[_Element]:
    if level.outline is not None:
        yield _Element(_ring(level.outline), True, {"amenity": "parking", "parking": "underground"})
    for block in level.blocks:
        yield _Element(_ring(block), True, {"indoor": "room"})
    for column in level.columns:
        yield _Element(_ring(column), True, {"indoor": "column"})
    for lane in level.lanes:
        yield _Element(lane.points, False, _road(lane.width_m, one_way=lane.one_way))
    for door in level.doors:
        yield _Element(_array([door.position]), False, {"amenity": "parking_entrance", "entrance": door.kind})
    for stall, corners in zip(level.stalls, level.corners, strict=True):
        along = corners[1] - corners[0]  # turned to the right it leads out of the mouth
        bearing_deg = math.degrees(math.atan2(along[1], -along[0]) - turn_rad)
        yield _Element(corners, True, _stall(stall, bearing_deg))


def _road(width_m: float, *, one_way: bool) -> dict[str, str]:
    direction = {"oneway": "yes"} if one_way else {}
    width = number_text(round(width_m, _WIDTH_DIGITS))
    return {"highway": "service", "service": "parking_aisle", "width": width, **direction}


def _stall(stall: Stall, bearing_deg: float) -> dict[str, str]:
    """Return the tags of a stall whose mouth looks to a bearing, clockwise from north."""
    numbered = {"ref": str(stall.number)} if stall.number else {}
    sized = {} if stall.size == "standard" else {"size": stall.size}
    if not stall.is_parked_in:
        return {"area:highway": "prohibited", "use": str(stall.use), **sized, **numbered}
    return {
        "amenity": "parking_space",
        "capacity": "1",
        "orientation": _ORIENTATIONS[stall.kind],
        "mouth:direction": number_text(round(bearing_deg, _BEARING_DIGITS) % 360),
        **_SPACES.get(stall.use, {}),
        **sized,
        **numbered,
    }


def _ring(ground: shapely.Polygon) -> NDArray[np.float64]:
    return _array(shapely.get_coordinates(ground.exterior)[:-1])


def _array(points: ArrayLike) -> NDArray[np.float64]:
    return np.asarray(points, np.float64).reshape(-1, 2)
