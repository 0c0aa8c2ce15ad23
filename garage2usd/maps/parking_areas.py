"""Parking areas of SUMO: the stalls of a garage beside the lanes of the network that netconvert makes of its map."""

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from garage2usd.as_built import BuiltLevel
from garage2usd.config.maps import ParkingAreas, SumoConfig
from garage2usd.garage import Stall, StallUse
from garage2usd.maps.frame import map_point
from garage2usd.maps.level_networks import LevelNetwork
from garage2usd.maps.parking_lanes import ParkingLane, ParkingLanes, ParkingSpace, driven_lanes
from garage2usd.maps.xml_text import child, write_xml
from garage2usd.native import elementary
from garage2usd.scenes.remarks import Remarks

__all__ = ["NETWORK_SUFFIX", "write_parking_areas"]

NETWORK_SUFFIX = ".netccfg"
"""End of the name of netconvert's configuration."""
_BADGES = {StallUse.ACCESSIBLE: "accessible", StallUse.EV: "ev", StallUse.MOTORCYCLE: "motorcycle"}
"""Badge of the vehicles that may park in stalls of a use."""
_AREA_M = 1.0
"""Least length of a parking area along its lane, where the lane is as long."""
_DIGITS, _ANGLE_DIGITS = 4, 3
_SEPARATOR = " "


def write_parking_areas(
    networks: Sequence[LevelNetwork],
    path: Path,
    settings: SumoConfig,
    *,
    network_file: Path,
    road_file: str,
    remarks: Remarks,
) -> None:
    """Write the stalls of a garage as ``parkingArea`` elements of SUMO, and netconvert's configuration for the network.

    Parameters
    ----------
    networks
        Roads of the garage's levels by `garage2usd.maps.level_networks.level_networks`.
    path
        The additional file (``.add.xml``), in an existing folder.
    settings
        Which stalls are one parking area, and whether badges are asked for.
    network_file
        Netconvert's configuration (``.netccfg``). It keeps the map's coordinates and the lengths of its roads.
    road_file
        Name of the OpenDRIVE map of the same garage.
    remarks
        Told of the stalls that are left out.

    Notes
    -----
    SUMO places the front bumper of a parked vehicle at a space's x and y and draws the space behind it, so these are
    the middle of the stall's far end for a car parked nose in. An angle of 0 points to -y, and positive ones turn
    counter-clockwise, in degrees; the documentation of SUMO says otherwise (its issue 18141).
    """
    driven = driven_lanes(network for _, network in networks)
    root = ET.Element("additional")
    for level, network in networks:
        lanes = ParkingLanes(network, driven)
        spaces = list(_spaces(level, lanes, remarks))
        for name, area in _areas(spaces, settings.areas):
            _add_area(root, name, area, level, settings)
    write_xml(root, path)
    _write_configuration(network_file, road_file)


def _spaces(level: BuiltLevel, lanes: ParkingLanes, remarks: Remarks) -> Iterator[ParkingSpace]:
    """Yield the stalls where cars park beside their lanes."""
    parking = [stall for stall in level.stalls if stall.is_parked_in]
    for stall in level.stalls:
        if not stall.is_parked_in:
            remarks.add("stalls where nobody parks are left out", stall.name)
    for stall in parking:
        space = lanes.space_of(stall)
        if space is None:
            remarks.add("stalls without a lane from an entrance and to an exit are left out", stall.name)
        else:
            yield space


def _areas(spaces: Iterable[ParkingSpace], areas: ParkingAreas) -> Iterator[tuple[str, list[ParkingSpace]]]:
    """Yield parking areas with their ids, in the order of lanes and along each lane."""
    found: dict[tuple[ParkingLane, StallUse, int, str], list[ParkingSpace]] = {}
    for space in spaces:
        bay = space.stall.access if areas is ParkingAreas.BAY else 0
        name = space.stall.name if areas is ParkingAreas.STALL else ""
        found.setdefault((space.lane, space.stall.use, bay, name), []).append(space)
    ordered = [sorted(area, key=_order) for area in found.values()]
    ordered.sort(key=lambda area: (area[0].lane.road.number, area[0].lane.number, _order(area[0])))
    counts: dict[str, int] = {}
    for area in ordered:
        stem = area[0].stall.name if areas is ParkingAreas.STALL else area[0].lane.name
        counts[stem] = counts.get(stem, 0) + 1
        is_sole = areas is ParkingAreas.STALL and counts[stem] == 1
        yield stem if is_sole else f"{stem}.{counts[stem]}", area


def _order(space: ParkingSpace) -> tuple[float, float, str]:
    return space.start_m, space.end_m, space.stall.name


def _add_area(
    root: ET.Element, name: str, area: Sequence[ParkingSpace], level: BuiltLevel, settings: SumoConfig
) -> None:
    lane, use = area[0].lane, area[0].stall.use
    length_m = lane.road.line.length_m
    least_m = min(_AREA_M, length_m)
    first_m, last_m = min(space.start_m for space in area), max(space.end_m for space in area)
    end_m = min(max(last_m, least_m), length_m)
    start_m = max(min(first_m, end_m - least_m), 0.0)
    badges = {"acceptedBadges": _BADGES[use]} if settings.badges and use in _BADGES else {}
    names = [space.stall.name for space in area]
    element = child(
        root,
        "parkingArea",
        id=name,
        lane=lane.name,
        startPos=round(start_m, _DIGITS),
        endPos=round(end_m, _DIGITS),
        friendlyPos="true",
        roadsideCapacity=0,
        name=names[0] if len(names) == 1 else f"{names[0]} to {names[-1]}",
        **badges,
    )
    facts = {
        "use": [str(use)],
        "stalls": names,
        "occupied": [space.stall.name for space in area if space.stall in level.taken_stalls],
    }
    for key, values in facts.items():
        child(element, "param", key=key, value=_SEPARATOR.join(values))
    for space in area:
        _add_space(element, space.stall, level.lanes.floor_m() + lane.road.floor_m)


def _add_space(element: ET.Element, stall: Stall, floor_m: float) -> None:
    (x, y), (back_x, back_y) = map_point(stall.centre), map_point(stall.backwards)
    half_m = stall.length_m / 2
    heading_deg = math.degrees(elementary.arctan2(-back_y, -back_x))
    child(
        element,
        "space",
        x=round(x - back_x * half_m, _DIGITS),
        y=round(y - back_y * half_m, _DIGITS),
        z=round(floor_m, _DIGITS),
        name=stall.name,
        width=round(stall.width_m, _DIGITS),
        length=round(stall.length_m, _DIGITS),
        angle=round((heading_deg + 90.0) % 360.0, _ANGLE_DIGITS) % 360.0,
        slope=0,
    )


def _write_configuration(network_file: Path, road_file: str) -> None:
    """Write netconvert's configuration, by which lanes are as long as the map's roads and coordinates are the map's."""
    root = ET.Element("netconvertConfiguration")
    options = {
        "input": {"opendrive-files": road_file},
        "output": {"output-file": f"{network_file.stem}.net.xml", "precision": "6"},
        "junctions": {"default.junctions.radius": "0"},
        "processing": {"offset.disable-normalization": "true"},
    }
    for section, values in options.items():
        group = child(root, section)
        for option, value in values.items():
            child(group, option, value=value)
    write_xml(root, network_file)
