"""GeoJSON (RFC 7946) of a garage: its ground plan in longitude and latitude, as `garage2usd import` reads it."""

import json
import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import shapely
from numpy.typing import ArrayLike

from garage2usd.as_built import BuiltGarage
from garage2usd.config.outputs import MapsConfig
from garage2usd.maps.facts import stage_facts
from garage2usd.maps.frame import projection
from garage2usd.maps.georeference import Georeference, georeference
from garage2usd.maps.ground_plan import GroundPlan, LevelPlan, ground_plan, level_number

_DIGITS = 4
_Geometry = tuple[str, ArrayLike]
"""Type of a geometry, and the points (x, y) of the map frame of its only line or ring."""


def write_geojson(garage: BuiltGarage, path: Path, settings: MapsConfig, *, plan: GroundPlan | None = None) -> None:
    """Write the ground plan of a garage as a FeatureCollection.

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
    The property ``kind`` tells the features apart: ``outline``, ``block``, ``column``, ``lane``, ``entrance``, ``exit``
    and ``stall``. Features of a garage of several levels have ``level`` (-1 is U1), lanes of ramps both of theirs. The
    ring of a stall begins at the left end of its mouth, which is the side ``mouth``, 0. The member ``local_frame`` has
    the projection by which positions become the stage's metres, with the turn and shift that follow it.
    """
    place = georeference(garage.stage, settings)
    found = list(_features(plan or ground_plan(garage)))
    sizes = [len(np.asarray(points).reshape(-1, 2)) for (_, points), _ in found]
    all_points = np.concatenate([np.asarray(points).reshape(-1, 2) for (_, points), _ in found])
    parts = np.split(place.degrees(all_points), np.cumsum(sizes)[:-1])
    lines = [
        json.dumps(_feature(form, degrees.tolist(), properties), ensure_ascii=False, allow_nan=False)
        for ((form, _), properties), degrees in zip(found, parts, strict=True)
    ]
    head = {
        "type": "FeatureCollection",
        "garage2usd": stage_facts(garage.stage),
        "local_frame": _frame(place),
    }
    opening = json.dumps(head, ensure_ascii=False).removesuffix("}")
    path.write_text(f'{opening}, "features": [\n' + ",\n".join(lines) + "\n]}\n", encoding="utf-8", newline="\n")


def _frame(place: Georeference) -> dict[str, Any]:
    return {
        "projection": projection(place.latitude_deg, place.longitude_deg),
        "turn_deg": round(math.degrees(place.turn_rad), 9),
        "shift_m": place.shift_m,
        "axes": "x east, z south; turned from x towards z, then shifted",
    }


def _feature(form: str, degrees: list[list[float]], properties: Mapping[str, Any]) -> dict[str, Any]:
    coordinates: Any = degrees
    if form == "Point":
        (coordinates,) = degrees
    elif form == "Polygon":
        coordinates = [[*degrees, degrees[0]]]
    identity = {"id": properties["id"]} if "id" in properties else {}
    return {
        "type": "Feature",
        **identity,
        "properties": dict(properties),
        "geometry": {"type": form, "coordinates": coordinates},
    }


def _features(plan: GroundPlan) -> Iterator[tuple[_Geometry, dict[str, Any]]]:
    for level in plan.levels:
        on = {"level": level.number} if level.number else {}
        for geometry, properties in _of_level(level):
            yield geometry, {**properties, **on}
    for ramp in plan.ramps:
        yield (
            ("LineString", ramp.lane.points),
            {
                "kind": "lane",
                "ramp": True,
                "width": round(ramp.lane.width_m, _DIGITS),
                "oneway": "yes",
                "level": f"{level_number(ramp.start)};{level_number(ramp.end)}",
                "heights_m": ramp.heights_m,
            },
        )


def _of_level(level: LevelPlan) -> Iterator[tuple[_Geometry, dict[str, Any]]]:
    for kind, grounds in (
        ("outline", [] if level.outline is None else [level.outline]),
        ("block", level.blocks),
        ("column", level.columns),
    ):
        for ground in grounds:
            yield ("Polygon", _ring(ground)), {"kind": kind}
    for lane in level.lanes:
        direction = "yes" if lane.one_way else "no"
        yield (
            ("LineString", lane.points),
            {"kind": "lane", "width": round(lane.width_m, _DIGITS), "oneway": direction},
        )
    for door in level.doors:
        yield ("Point", [door.position]), {"kind": door.kind}
    taken = level.taken_stalls
    for stall, corners in zip(level.stalls, level.corners, strict=True):
        numbered = {"number": str(stall.number)} if stall.number else {}
        yield (
            ("Polygon", corners),
            {
                "kind": "stall",
                "id": level.name_of(stall),
                **numbered,
                "use": str(stall.use),
                "size": stall.size,
                "orientation": str(stall.kind),
                "mouth": 0,
                "occupied": stall in taken,
            },
        )


def _ring(ground: shapely.Polygon) -> Sequence[Sequence[float]]:
    """Return the corners of a polygon counter-clockwise, as RFC 7946 asks."""
    ring = shapely.geometry.polygon.orient(ground).exterior
    corners: list[list[float]] = shapely.get_coordinates(ring)[:-1].tolist()
    return corners
