"""OpenDRIVE 1.8 map of a garage."""

import math
import xml.etree.ElementTree as ET
from collections import defaultdict
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

import numpy as np
import shapely
from pxr import Usd

from garage2usd.as_built import BuiltGarage
from garage2usd.config.outputs import MapsConfig
from garage2usd.maps.facts import stage_facts
from garage2usd.maps.frame import projection
from garage2usd.maps.ground_plan import GroundPlan, ground_plan
from garage2usd.maps.level_networks import LevelNetwork, level_networks
from garage2usd.maps.network import LEFT, RIGHT, Junction, Neighbour, Network, Road, RoadPlaces
from garage2usd.maps.opendrive_objects import (
    MapObject,
    Signal,
    add_objects,
    add_signals,
    signals_of,
    solids_of,
    stalls_of,
)
from garage2usd.maps.xml_text import child, number_text, write_xml

_CENTRE_LINE_M = 0.12
_DIGITS = 4
_AROUND_M = 10.0
"""Margin of the map's bounds around its roads."""


def write_opendrive(
    garage: BuiltGarage,
    path: Path,
    settings: MapsConfig,
    *,
    networks: Sequence[LevelNetwork] | None = None,
    plan: GroundPlan | None = None,
) -> Sequence[LevelNetwork]:
    """Write a garage as an OpenDRIVE 1.8 map in the common map frame (`garage2usd.maps.frame`).

    Parameters
    ----------
    garage
        The garage.
    path
        The file, in an existing folder.
    settings
        Geographic position and speed limit.
    networks
        Roads of its levels by `garage2usd.maps.level_networks.level_networks`, if already known.
    plan
        Its ground plan, likewise.

    Returns
    -------
    sequence of LevelNetwork
        The roads of the file, level by level.

    Raises
    ------
    StageError
        If a level has no complete lane graph, or a ramp leads to no landing.

    Notes
    -----
    Numbers of roads, junctions and objects are integers, as CARLA requires; the ids of stalls are names. Stalls,
    columns and walls lie beside straight roads (`garage2usd.maps.network`), with outlines as they stand in the
    stage. The projection is a transverse Mercator around the stage's origin, in which metres are metres. The header has
    the outline and the blocks of each level, and the middles of its doors, as user data x y after x y.
    """
    levels = level_networks(garage) if networks is None else networks
    first_number = 1 + sum(len(network.roads) + len(network.junctions) for _, network in levels)
    objects: dict[Road, list[tuple[int, MapObject]]] = defaultdict(list)
    signals: dict[Road, list[tuple[int, Signal]]] = defaultdict(list)
    roads: list[Road] = []
    number = 0
    for level, network in levels:
        places = RoadPlaces(network, level.stalls, first_number=first_number)
        for thing in (*stalls_of(level, places, network), *solids_of(level, places)):
            number += 1
            objects[thing.road].append((number, thing))
        for sign in signals_of(level, places):
            number += 1
            signals[sign.road].append((number, sign))
        for line in places.lines:
            line.floor_m = network.roads[0].floor_m
        first_number += len(places.lines)
        roads += [*network.roads, *places.lines]
    root = ET.Element("OpenDRIVE")
    header = _add_header(root, garage.source, garage.stage, [network for _, network in levels], settings)
    _add_outlines(header, plan or ground_plan(garage))
    for road in roads:
        element = _add_road(root, road, settings)
        if road in objects:
            add_objects(child(element, "objects"), objects[road])
        if road in signals:
            add_signals(child(element, "signals"), signals[road])
    for _, network in levels:
        for junction in network.junctions:
            _add_junction(root, junction, network)
    write_xml(root, path)
    return levels


def _add_header(
    root: ET.Element, source: str, stage: Usd.Stage | None, networks: Sequence[Network], settings: MapsConfig
) -> ET.Element:
    facts = stage_facts(stage)
    roads = [road for network in networks for road in network.roads]
    ends = np.array([road.line.at(s)[:2] for road in roads for s in (0.0, road.line.length_m)])
    (west, south), (east, north) = ends.min(axis=0) - _AROUND_M, ends.max(axis=0) + _AROUND_M
    header = child(
        root,
        "header",
        revMajor="1",
        revMinor="8",
        name=Path(source).stem,
        version=str(facts.get("version", "")),
        vendor="garage2usd",
        north=north,
        south=south,
        east=east,
        west=west,
    )
    child(header, "geoReference").text = projection(settings.latitude_deg, settings.longitude_deg)
    for name, value in facts.items():
        child(header, "userData", code=name, value=str(value))
    return header


def _add_outlines(header: ET.Element, plan: GroundPlan) -> None:
    """Tell the outline, the blocks and the doors of each level, for which OpenDRIVE has no element."""
    for level in plan.levels:
        grounds = [] if level.outline is None else [("outline", level.outline)]
        grounds += [("block", block) for block in level.blocks]
        told = [(code, shapely.get_coordinates(ground.exterior)[:-1].ravel()) for code, ground in grounds]
        told += [(door.kind, np.array(door.position)) for door in level.doors]
        for code, numbers in told:
            words = " ".join(map(number_text, numbers.round(_DIGITS).tolist()))
            child(header, "userData", code=level.place.after(code, joint=" "), value=words)


def _add_road(root: ET.Element, road: Road, settings: MapsConfig) -> ET.Element:
    junction = "-1" if road.junction is None else str(road.junction)
    element = child(
        root, "road", name="", length=road.line.length_m, id=str(road.number), junction=junction, rule="RHT"
    )
    if road.predecessor is not None or road.successor is not None:
        link = child(element, "link")
        for tag, neighbour in (("predecessor", road.predecessor), ("successor", road.successor)):
            if neighbour is not None:
                _add_neighbour(link, tag, neighbour)
    kind = child(element, "type", s=0, type="lowSpeed")
    child(kind, "speed", max=settings.speed_limit_km_h, unit="km/h")
    plan, s_m = child(element, "planView"), 0.0
    for arc in road.line.arcs:
        (x, y), heading = arc.start, math.remainder(arc.heading_rad, math.tau)
        geometry = child(plan, "geometry", s=s_m, x=x, y=y, hdg=heading, length=arc.length_m)
        if arc.curvature_per_m == 0.0:
            child(geometry, "line")
        else:
            child(geometry, "arc", curvature=arc.curvature_per_m)
        s_m += arc.length_m
    elevation = child(element, "elevationProfile")
    profile = road.profile_m or ((0.0, 0.0), (road.line.length_m, 0.0))
    for (start, height), (end, next_height) in pairwise(profile):
        child(
            elevation, "elevation", s=start, a=height + road.floor_m, b=(next_height - height) / (end - start), c=0, d=0
        )
    _add_lanes(element, road, settings)
    return element


def _add_neighbour(link: ET.Element, tag: str, neighbour: Neighbour) -> None:
    if neighbour.is_junction:
        child(link, tag, elementType="junction", elementId=str(neighbour.number))
    else:
        at = "start" if neighbour.at_start else "end"
        child(link, tag, elementType="road", elementId=str(neighbour.number), contactPoint=at)


def _add_lanes(element: ET.Element, road: Road, settings: MapsConfig) -> None:
    lanes = child(element, "lanes")
    if road.start.middle_m or road.end.middle_m:
        a, b, c, d = _eased(road.start.middle_m, road.end.middle_m, road.line.length_m)
        child(lanes, "laneOffset", s=0, a=a, b=b, c=c, d=d)
    section = child(lanes, "laneSection", s=0)
    for side, number in (("left", LEFT), ("center", 0), ("right", RIGHT)):
        if number == 0:
            centre = child(child(section, side), "lane", id="0", type="none", level="false")
            is_marked = road.lanes == (LEFT, RIGHT) and road.line.is_straight
            mark = {"type": "broken" if is_marked else "none", "color": "white", "width": _CENTRE_LINE_M}
            child(centre, "roadMark", sOffset=0, **mark)
        elif number in road.lanes:
            lane = child(child(section, side), "lane", id=str(number), type="driving", level="false")
            _add_lane(lane, road, number)
            # SUMO ignores the road's speed
            child(lane, "speed", sOffset=0, max=settings.speed_limit_km_h, unit="km/h")


def _add_lane(lane: ET.Element, road: Road, number: int) -> None:
    before, after = road.lane_before.get(number), road.lane_after.get(number)
    if before is not None or after is not None:
        link = child(lane, "link")
        if before is not None:
            child(link, "predecessor", id=str(before))
        if after is not None:
            child(link, "successor", id=str(after))
    a, b, c, d = _eased(road.start.width_m(number), road.end.width_m(number), road.line.length_m)
    child(lane, "width", sOffset=0, a=a, b=b, c=c, d=d)


def _eased(start: float, end: float, length_m: float) -> tuple[float, float, float, float]:
    """Return the coefficients of the cubic between two values with zero slope at both ends."""
    rise = end - start
    return start, 0.0, 3 * rise / length_m**2, -2 * rise / length_m**3


def _add_junction(root: ET.Element, junction: Junction, network: Network) -> None:
    name = network.nodes[junction.node].name
    element = child(root, "junction", id=str(junction.number), name=name, type="default")
    for index, link in enumerate(junction.links):
        connection = child(
            element,
            "connection",
            id=str(index),
            incomingRoad=str(link.incoming),
            connectingRoad=str(link.connecting),
            contactPoint="start",
        )
        child(connection, "laneLink", from_=str(link.from_lane), to=str(link.to_lane))
