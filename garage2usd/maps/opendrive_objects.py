"""OpenDRIVE objects and signals: stalls, columns, walls, speed bumps and signs beside roads."""
# Over 300 lines: one writer for each kind of object and signal, with the frame that they share.

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.as_built import BuiltLevel
from garage2usd.as_built.shapes import Thing
from garage2usd.garage import Stall, StallUse
from garage2usd.maps.frame import heading_rad, map_point, map_points
from garage2usd.maps.network import Network, Road, RoadPlaces
from garage2usd.maps.xml_text import child
from garage2usd.native import elementary

Floats = NDArray[np.float64]

_ACCESS = {
    StallUse.STANDARD: "car",
    StallUse.ACCESSIBLE: "handicapped",
    StallUse.EV: "electric",
    StallUse.MOTORCYCLE: "all",
}
_RESTRICTIONS = {StallUse.MOTORCYCLE: "motorcycles"}
"""What the standard's list of accesses has no word for, as its free text for the application."""
_LINE_WIDTH_M = 0.12
_TYPES = {
    "column": ("pole", "column"),
    "wall": ("barrier", "wall"),
    "obstacle": ("building", "core"),
    "speed_bump": ("roadSurface", "speedBump"),
    "barrier": ("barrier", "gate"),
}
"""OpenDRIVE type and subtype of solid objects, by semantic class."""
_OTHER_SIGN = ("OpenDRIVE", "-1")
_SIGNS = {"traffic_sign": ("DE", "286"), "exit_sign": _OTHER_SIGN, "lane_sign": _OTHER_SIGN}
"""Country and number of signs: no stopping for longer than three minutes (Zeichen 286 of the German StVO).
Escape signs of ISO 7010 have no number in a road traffic act."""
_LANE_SIGNS = {"NoEntrySign": ("DE", "267"), "OneWaySign": ("DE", "220")}
"""The same of signs of one-way lanes, by the beginning of their names."""
_APART_M = 0.01
"""Gap up to which walls in line are merged."""
_DIGITS = 3
_DEEP_M = 0.002
"""Depth below the floor that single precision may give objects on it."""


class MapObject(NamedTuple):
    """An OpenDRIVE object beside a road.

    Attributes
    ----------
    road, s_m, t_m
        Road of the object, and its middle's distance along the road and offset to the left.
    heading_rad
        Heading of the object's axis u in the map.
    corners_m
        Outline (u, v); float64, shape (n, 2).
    name, type, subtype
        OpenDRIVE's name, type and subtype.
    bottom_m, height_m
        Bottom over the road, and height of the object.
    stall
        The stall, if the object is one.
    data
        User data without an OpenDRIVE attribute.
    """

    road: Road
    s_m: float
    t_m: float
    heading_rad: float
    corners_m: Floats
    name: str
    type: str
    subtype: str
    bottom_m: float = 0.0
    height_m: float = 0.0
    stall: Stall | None = None
    data: tuple[tuple[str, str], ...] = ()


class Signal(NamedTuple):
    """An OpenDRIVE signal: a sign beside a road whose front faces `heading_rad` in the map."""

    road: Road
    s_m: float
    t_m: float
    heading_rad: float
    name: str
    country: str
    type: str
    bottom_m: float
    height_m: float
    width_m: float


def stalls_of(level: BuiltLevel, places: RoadPlaces, network: Network) -> Iterator[MapObject]:
    """Yield the stalls of a garage as OpenDRIVE objects, with their corners as in `Stall`.

    Axis u leads from the tail to the nose of a car parked nose in.
    """
    taken = level.taken_stalls
    through = {number: road for road in network.roads if road.junction is None for number in road.nodes}
    meeting = {junction.node: junction.number for junction in network.junctions}
    for stall in level.stalls:
        road, s_m, t_m = places.of_stall(stall)
        ahead = map_point(stall.backwards)
        heading = math.atan2(-ahead[1], -ahead[0])
        away = map_points(stall.corners) - map_points(stall.centre)
        access = through.get(stall.access)
        data = [("use", str(stall.use)), ("occupied", "true" if stall in taken else "false")]
        data += [] if stall.number is None else [("number", level.place.own_name(str(stall.number)))]
        data += [] if stall.size == "standard" else [("size", stall.size)]
        data += [("accessRoad", str(access.number))] if access is not None else []
        data += [("accessJunction", str(meeting[stall.access]))] if stall.access in meeting else []
        kind = "parkingSpace" if stall.is_parked_in else "none"
        yield MapObject(
            road,
            s_m,
            t_m,
            heading,
            _turned(away, -heading),
            stall.name,
            kind,
            str(stall.use),
            stall=stall,
            data=tuple(data),
        )


def solids_of(level: BuiltLevel, places: RoadPlaces) -> Iterator[MapObject]:
    """Yield the outlines of columns, walls, obstacles, gates and speed bumps; walls in line are merged."""
    pieces: dict[str, list[tuple[str, shapely.Polygon, float, float]]] = {label: [] for label in _TYPES}
    for solid in level.solids.standing(*_TYPES):
        outline = shapely.transform(solid.footprint, map_points)
        pieces[solid.label].append((solid.name, outline, solid.bottom_m, solid.top_m))
    for label, found in pieces.items():
        for name, outline, low_m, high_m in _joined_walls(found) if label == "wall" else found:
            middle = outline.centroid
            road, s_m, t_m = places.of_point((middle.x, middle.y))
            corners = shapely.get_coordinates(shapely.normalize(outline))[:-1] - (middle.x, middle.y)
            bottom_m = _over_road(low_m, road, s_m)
            height_m = max(_over_road(high_m, road, s_m) - bottom_m, 0.0)
            yield MapObject(road, s_m, t_m, 0.0, corners, name, *_TYPES[label], bottom_m, height_m)


def signals_of(level: BuiltLevel, places: RoadPlaces) -> Iterator[Signal]:
    """Yield the signs of a garage as OpenDRIVE signals."""
    for thing in level.things:
        if thing.label in _SIGNS and thing.bodies:
            yield _signal(thing, places)


def add_objects(parent: ET.Element, objects: Iterable[tuple[int, MapObject]]) -> None:
    """Add numbered OpenDRIVE objects to a road's element."""
    for number, thing in objects:
        low, high = thing.corners_m.min(axis=0), thing.corners_m.max(axis=0)
        length_m, width_m = (high - low).tolist()
        element = child(
            parent,
            "object",
            id=str(number),
            name=thing.name,
            type=thing.type,
            subtype=thing.subtype,
            s=thing.s_m,
            t=thing.t_m,
            zOffset=thing.bottom_m,
            hdg=_about_road(thing.heading_rad, thing.road, thing.s_m),
            pitch=0,
            roll=0,
            orientation="none",
            length=length_m,
            width=width_m,
            height=thing.height_m,
            dynamic="no",
        )
        outline = child(child(element, "outlines"), "outline", id="0", outer="true", closed="true")
        for index, (u, v) in enumerate(thing.corners_m.tolist()):
            child(outline, "cornerLocal", id=str(index), u=u, v=v, z=0, height=thing.height_m)
        if thing.stall is not None and thing.stall.is_parked_in:
            restrictions = _RESTRICTIONS.get(thing.stall.use)
            restricted = {} if restrictions is None else {"restrictions": restrictions}
            child(element, "parkingSpace", access=_ACCESS.get(thing.stall.use, "car"), **restricted)
            _add_markings(element, thing.corners_m)
        for code, value in thing.data:
            child(element, "userData", code=code, value=value)


def add_signals(parent: ET.Element, signals: Iterable[tuple[int, Signal]]) -> None:
    """Add numbered OpenDRIVE signals to a road's element."""
    for number, sign in signals:
        child(
            parent,
            "signal",
            id=str(number),
            name=sign.name,
            s=sign.s_m,
            t=sign.t_m,
            zOffset=sign.bottom_m,
            hOffset=_about_road(sign.heading_rad, sign.road, sign.s_m),
            pitch=0,
            roll=0,
            orientation="none",
            dynamic="no",
            country=sign.country,
            type=sign.type,
            subtype="-1",
            height=sign.height_m,
            width=sign.width_m,
        )


def _add_markings(element: ET.Element, corners: Floats) -> None:
    """Add the stall markings on three sides; the entry has no line."""
    markings = child(element, "markings")
    for start, end in ((1, 2), (2, 3), (3, 0)):
        line = child(
            markings,
            "marking",
            color="white",
            width=_LINE_WIDTH_M,
            zOffset=0,
            startOffset=0,
            stopOffset=0,
            lineLength=float(np.linalg.norm(corners[start] - corners[end])),
            spaceLength=0,
        )
        for corner in (start, end):
            child(line, "cornerReference", id=str(corner))


def _signal(thing: Thing, places: RoadPlaces) -> Signal:
    """Create the OpenDRIVE signal of a sign, which faces its own +Z."""
    points = np.concatenate([body.world_points() for body in thing.bodies])
    low, high = points.min(axis=0), points.max(axis=0)
    front = thing.bodies[0].matrix[2, [0, 2]]
    middle = float(low[0] + high[0]) / 2, -float(low[2] + high[2]) / 2
    road, s_m, t_m = places.of_point(middle)
    across = np.array([front[1], -front[0]]) / (np.linalg.norm(front) or 1.0)
    name = thing.name.rpartition("/")[2]
    country, number = _LANE_SIGNS.get(name.partition("_")[0], _SIGNS[thing.label])
    return Signal(
        road,
        s_m,
        t_m,
        heading_rad(math.atan2(-front[0], -front[1])),
        name,
        country,
        number,
        _over_road(float(low[1]), road, s_m),
        round(float(high[1] - low[1]), _DIGITS),
        round(float(np.ptp(points[:, [0, 2]] @ across)), _DIGITS),
    )


def _joined_walls(
    walls: Sequence[tuple[str, shapely.Polygon, float, float]],
) -> Iterator[tuple[str, shapely.Polygon, float, float]]:
    """Merge walls in line, given as boxes."""
    rows: dict[tuple[int, float, float, float, float], list[tuple[float, float, str]]] = {}
    for name, outline, bottom_m, top_m in walls:
        if outline.area < (1 - 1e-3) * outline.envelope.area:
            yield name, outline, bottom_m, top_m
            continue
        x, y, right, top = (round(value, _DIGITS) for value in outline.bounds)
        heights = round(bottom_m, _DIGITS), round(top_m, _DIGITS)
        is_upright = top - y > right - x
        start, end, low, high = (y, top, x, right) if is_upright else (x, right, y, top)
        rows.setdefault((int(is_upright), low, high, *heights), []).append((start, end, name))
    for (is_upright, low, high, bottom_m, top_m), spans in sorted(rows.items()):
        spans.sort()
        while spans:
            start, end, name = spans.pop(0)
            while spans and spans[0][0] <= end + _APART_M:
                end = max(end, spans.pop(0)[1])
            yield (
                name,
                shapely.box(*((low, start, high, end) if is_upright else (start, low, end, high))),
                bottom_m,
                top_m,
            )


def _over_road(height_m: float, road: Road, s_m: float) -> float:
    """Return a height relative to a road; tiny depths below the surface are set to 0."""
    over_m = round(height_m - road.height_m(s_m), _DIGITS)
    return over_m if over_m < -_DEEP_M else max(over_m, 0.0)


def _about_road(heading: float, road: Road, s_m: float) -> float:
    return math.remainder(heading - road.line.at(s_m)[2], math.tau)


def _turned(points: Floats, angle_rad: float) -> Floats:
    cos, sin = elementary.cos(angle_rad), elementary.sin(angle_rad)
    turned: Floats = points @ np.array([[cos, sin], [-sin, cos]])
    return turned
