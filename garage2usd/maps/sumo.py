"""Stalls of a garage in SUMO: the lanes of netconvert's network before them, and parking areas beside those lanes."""
# Over 300 lines: lanes are read from netconvert's network, and stalls put beside them, with the same tolerances.

import math
import xml.etree.ElementTree as ET
from collections.abc import Collection, Iterable, Iterator, Sequence
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

import networkx as nx
import numpy as np
from numpy.typing import NDArray

from garage2usd.as_built import BuiltLevel
from garage2usd.config.outputs import ParkingAreas, SumoConfig
from garage2usd.garage import Stall, StallUse
from garage2usd.maps.frame import map_point, map_points
from garage2usd.maps.level_networks import LevelNetwork
from garage2usd.maps.network import LEFT, RIGHT, Network, Road
from garage2usd.maps.xml_text import child, write_xml
from garage2usd.native import elementary
from garage2usd.scenes.remarks import Remarks

_STEP_M = 0.25
"""Distance between the points of a lane's middle line that stalls are measured to."""
_LEAST_M = 2.0
"""Length of a lane below which a longer one is preferred."""
_DISTANCE_DIGITS = 4
NETWORK_SUFFIX = ".netccfg"
"""End of the name of netconvert's configuration."""
_BADGES = {StallUse.ACCESSIBLE: "accessible", StallUse.EV: "ev", StallUse.MOTORCYCLE: "motorcycle"}
"""Badge of the vehicles that may park in stalls of a use."""
_AREA_M = 1.0
"""Least length of a parking area along its lane, where the lane is as long."""
_DIGITS, _ANGLE_DIGITS = 4, 3
_SEPARATOR = " "


class ParkingLane(NamedTuple):
    """A lane of a road in SUMO's network.

    Attributes
    ----------
    road
        Road of the lane.
    number
        `LEFT` or `RIGHT`.
    """

    road: Road
    number: int

    @property
    def name(self) -> str:
        """SUMO's id of the lane: an edge in the direction of the road has a minus sign before the road's number."""
        return f"{'-' if self.number == RIGHT else ''}{self.road.number}_0"

    def position_m(self, s_m: float) -> float:
        """Convert a distance along the road to a distance from the beginning of the lane."""
        return s_m if self.number == RIGHT else self.road.line.length_m - s_m


class ParkingSpace(NamedTuple):
    """A stall beside its lane, and the part of the lane before its mouth in metres from the lane's beginning."""

    stall: Stall
    lane: ParkingLane
    start_m: float
    end_m: float


class ParkingLanes:
    """Lanes of a network that vehicles reach from an entrance and leave for an exit.

    Parameters
    ----------
    network
        The network, of several levels that of one level.
    driven
        Road and lane numbers on a way from an entrance to an exit, by `driven_lanes` of all levels.
    """

    def __init__(self, network: Network, driven: Collection[tuple[int, int]]) -> None:
        self._usable = [
            ParkingLane(road, number)
            for road in network.roads
            if road.junction is None
            for number in road.lanes
            if (road.number, number) in driven
        ]
        self._near: dict[int, list[ParkingLane]] = {}
        meeting = {junction.number: junction.node for junction in network.junctions}
        for lane in self._usable:
            ends = (end.number for end in (lane.road.predecessor, lane.road.successor) if end and end.is_junction)
            for node in {*lane.road.nodes, *(meeting[number] for number in ends)}:
                self._near.setdefault(node, []).append(lane)

    def space_of(self, stall: Stall) -> ParkingSpace | None:
        """Find the nearest lane before a stall's mouth, among those at its access node if there are any."""
        candidates = self._near.get(stall.access) or self._usable
        if not candidates:
            return None
        mouth = np.array(map_point(stall.mouth))
        lane = min(candidates, key=lambda lane: self._cost(lane, mouth))
        runs = [lane.position_m(self._nearest(lane, corner)[0]) for corner in map_points(stall.corners[:2])]
        return ParkingSpace(stall, lane, min(runs), max(runs))

    def _cost(self, lane: ParkingLane, mouth: NDArray[np.float64]) -> tuple[bool, float, int, int]:
        too_short = lane.road.line.length_m < _LEAST_M
        distance_m = round(self._nearest(lane, mouth)[1], _DISTANCE_DIGITS)
        return too_short, distance_m, lane.road.number, lane.number

    def _nearest(self, lane: ParkingLane, place: NDArray[np.float64]) -> tuple[float, float]:
        """Project a place onto a lane: distance along the road, and distance from the lane."""
        runs, points = self._line(lane)
        start, along = points[:-1], np.diff(points, axis=0)
        length2 = (along**2).sum(axis=1)
        share = np.clip(((place - start) * along).sum(axis=1) / length2, 0.0, 1.0)
        away = np.hypot(*(start + share[:, None] * along - place).T)
        index = int(away.argmin())
        return float(runs[index] + share[index] * (runs[index + 1] - runs[index])), float(away[index])

    def _line(self, lane: ParkingLane) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        if lane not in self._lines:
            length_m = lane.road.line.length_m
            runs = np.linspace(0.0, length_m, 2 + math.ceil(length_m / _STEP_M))
            self._lines[lane] = runs, lane.road.middle_points(lane.number, runs)
        return self._lines[lane]

    @cached_property
    def _lines(self) -> dict[ParkingLane, tuple[NDArray[np.float64], NDArray[np.float64]]]:
        return {}


def driven_lanes(networks: Iterable[Network]) -> set[tuple[int, int]]:
    """Find the lanes on routes from an entrance to an exit; all lanes if there is no entrance or no exit.

    Parameters
    ----------
    networks
        The network of a garage, or those of all its levels, joined by their ramps.

    Returns
    -------
    set of tuple
        Numbers of roads and lanes.

    Notes
    -----
    Vehicles turn round where an aisle with two lanes ends, as netconvert makes a connection for that. A lane that
    begins where an aisle meets a one-way lane is not an entrance.
    """
    networks = tuple(networks)
    graph = nx.DiGraph([pair for network in networks for pair in _connections(network)])
    graph.add_nodes_from((road.number, lane) for network in networks for road in network.roads for lane in road.lanes)
    ends = [end for network in networks for road in network.roads for end in _open_ends(road)]
    sources = [lane for lane, is_start in ends if is_start and not graph.in_degree(lane)]
    sinks = [lane for lane, is_start in ends if not is_start and not graph.out_degree(lane)]
    if not sources or not sinks:
        return set(graph)
    graph.add_edges_from(((0, 0), source) for source in sources)
    graph.add_edges_from((sink, (0, 1)) for sink in sinks)
    driven: set[tuple[int, int]] = nx.descendants(graph, (0, 0)) & nx.ancestors(graph, (0, 1))
    return driven


def _open_ends(road: Road) -> Iterator[tuple[tuple[int, int], bool]]:
    """Yield the lanes of a road at ends that no other road meets; True for those that begin there."""
    for neighbour, starting in ((road.predecessor, RIGHT), (road.successor, LEFT)):
        if neighbour is None:
            yield from (((road.number, lane), lane == starting) for lane in road.lanes)


def _connections(network: Network) -> Iterator[tuple[tuple[int, int], tuple[int, int]]]:
    """Yield pairs of lanes, as road and lane numbers, of which the second follows the first."""
    for road in network.roads:
        ends = {RIGHT: (road.successor, road.lane_after), LEFT: (road.predecessor, road.lane_before)}
        for lane, (neighbour, lanes) in ends.items():
            if lane not in road.lanes:
                continue
            if neighbour is None:
                if -lane in road.lanes:
                    yield (road.number, lane), (road.number, -lane)
            elif lane in lanes and not neighbour.is_junction:
                yield (road.number, lane), (neighbour.number, lanes[lane])
    for junction in network.junctions:
        for link in junction.links:
            yield (link.incoming, link.from_lane), (link.connecting, link.to_lane)


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
    """Write netconvert's configuration, which keeps the lengths of roads and the coordinates of the map."""
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
