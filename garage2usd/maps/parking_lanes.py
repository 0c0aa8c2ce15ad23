"""Lanes of SUMO's network before the stalls of a garage."""

import math
from collections.abc import Collection, Iterable, Iterator
from functools import cached_property
from typing import NamedTuple

import networkx as nx
import numpy as np
from numpy.typing import NDArray

from garage2usd.garage import Stall
from garage2usd.maps.frame import map_point, map_points
from garage2usd.maps.network import LEFT, RIGHT, Network, Road

__all__ = ["ParkingLane", "ParkingLanes", "ParkingSpace", "driven_lanes"]

_STEP_M = 0.25
"""Distance between the points of a lane's middle line that stalls are measured to."""
_LEAST_M = 2.0
"""Length of a lane below which a longer one is preferred."""
_DIGITS = 4


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
        """Return the distance from the beginning of the lane of a place along its road."""
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
        distance_m = round(self._nearest(lane, mouth)[1], _DIGITS)
        return too_short, distance_m, lane.road.number, lane.number

    def _nearest(self, lane: ParkingLane, place: NDArray[np.float64]) -> tuple[float, float]:
        """Return the distance along the road of a lane's point nearest to a place, and the distance between both."""
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
    """Find the lanes on a way from an entrance to an exit; all lanes if there is none of either.

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
