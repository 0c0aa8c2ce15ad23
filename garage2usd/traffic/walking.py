"""Walks of people between cars and the stair cores, over the free ground beside stalls, aisles and columns."""

import math
from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import dijkstra

from garage2usd.as_built.core_reader import core_doors
from garage2usd.as_built.level import BuiltLevel
from garage2usd.garage import Point
from garage2usd.objects import CAR_LABELS
from garage2usd.traffic.ground import Cells, Ground

Floats = NDArray[np.float64]
BREADTH_M, DEPTH_M = 0.46, 0.30
"""Size of a person seen from above (DIN 33402-2, 50th percentile: 0.46 m across the shoulders)."""
PERSON_RADIUS_M = math.hypot(BREADTH_M, DEPTH_M) / 2
_GRID_M = 0.4
_CLEAR_M = 0.3
_HEAD_M = 2.0
"""Height under which an object is in a walker's way."""
_MIDDLE_COST = 1.6
"""Cost of the middle of an aisle, as a factor on that of its sides along the mouths of stalls."""
_SIDE_M = 1.4
_TO_DOOR_M, _TRIED = 4.0, 16
_AROUND_M, _ASIDE_M = 0.25, 1.5


class Walkways:
    """The free ground of a level for walking, and the shortest walks to its doors.

    Parameters
    ----------
    level
        The level.
    """

    def __init__(self, level: BuiltLevel) -> None:
        quads = shapely.polygons(np.array([stall.corners for stall in level.stalls]).reshape(-1, 4, 2))
        standing = [
            piece for _, label, pieces in level.solids.grounds(_HEAD_M) if label not in CAR_LABELS for piece in pieces
        ]
        cars = [ground for ground, _ in level.cars.values()]
        self.standing = shapely.union_all(standing)
        """Ground of everything that stands in a walker's way, except cars."""
        shapely.prepare(self.standing)
        self._near = [
            shapely.buffer(ground, PERSON_RADIUS_M + 0.05, quad_segs=4)
            for ground in (shapely.union_all([self.standing, *quads, *cars]), self.standing)
        ]
        for ground in self._near:
            shapely.prepare(ground)
        self._blocked = shapely.buffer(shapely.union_all([*standing, *quads, *cars]), _CLEAR_M, quad_segs=4)
        shapely.prepare(self._blocked)
        nodes = level.lanes.positions_m
        low, high = nodes.min(axis=0) - 8.0, nodes.max(axis=0) + 8.0
        self._low = np.floor(low / _GRID_M) * _GRID_M
        self._shape = tuple(np.ceil((high - self._low) / _GRID_M).astype(int) + 1)
        cols, rows = np.meshgrid(np.arange(self._shape[0]), np.arange(self._shape[1]), indexing="ij")
        self._places = np.stack([cols.ravel(), rows.ravel()], axis=1) * _GRID_M + self._low
        lanes = shapely.union_all(_lane_grounds(level))
        shapely.prepare(lanes)
        is_free = shapely.contains_xy(lanes, self._places) & ~shapely.contains_xy(self._blocked, self._places)
        self._number = np.full(len(self._places), -1)
        self._number[is_free] = np.arange(int(is_free.sum()))
        self._free = self._places[is_free]
        self._graph = self._connected(is_free.reshape(self._shape), lanes)
        doors = [door.position for door in core_doors(level)]
        if not doors:
            doors = [level.lanes.nodes[number].position for number in level.street_portals]
        self.doors: tuple[Point, ...] = tuple(dict.fromkeys(doors))
        entries = [self._nearest(door, _TO_DOOR_M) for door in self.doors]
        self.doors = tuple(door for door, entry in zip(self.doors, entries, strict=True) if entry is not None)
        self._entries = [entry for entry in entries if entry is not None]
        self._fields = [dijkstra(self._graph, indices=entry, return_predecessors=True) for entry in self._entries]

    def _connected(self, is_free: NDArray[np.bool_], lanes: shapely.Geometry) -> coo_matrix:
        number = self._number.reshape(self._shape)
        near_edge = shapely.boundary(lanes)
        beside = shapely.distance(shapely.points(self._free), near_edge) <= _SIDE_M
        weight = np.where(beside, 1.0, _MIDDLE_COST)
        rows, cols, costs = [], [], []
        for step, far in (((1, 0), 1.0), ((0, 1), 1.0), ((1, 1), math.sqrt(2)), ((1, -1), math.sqrt(2))):
            one = is_free[: self._shape[0] - step[0], max(-step[1], 0) : self._shape[1] - max(step[1], 0)]
            low = max(step[1], 0)
            other = is_free[step[0] :, low : self._shape[1] + min(step[1], 0)]
            both = one & other
            start = number[: self._shape[0] - step[0], max(-step[1], 0) : self._shape[1] - max(step[1], 0)][both]
            end = number[step[0] :, low : self._shape[1] + min(step[1], 0)][both]
            rows.append(start)
            cols.append(end)
            costs.append(far * _GRID_M * (weight[start] + weight[end]) / 2)
        start, end, cost = (np.concatenate(each) for each in (rows, cols, costs))
        size = len(self._free)
        return coo_matrix(
            (np.concatenate([cost, cost]), (np.concatenate([start, end]), np.concatenate([end, start]))), (size, size)
        ).tocsr()

    def _nearest(self, place: Point, within_m: float) -> int | None:
        """Return the number of the free grid point nearest to a place."""
        if not len(self._free):
            return None
        away = np.hypot(*(self._free - np.array(place)).T)
        nearest = np.argsort(away, kind="stable")[:_TRIED]
        nearest = nearest[away[nearest] <= within_m]
        lines = shapely.linestrings(np.stack([np.broadcast_to(place, (len(nearest), 2)), self._free[nearest]], axis=1))
        for ground in self._near:
            found = nearest[~shapely.intersects(ground, lines)]
            if len(found):
                return int(found[0])
        return int(nearest[0]) if len(nearest) else None

    def distance_m(self, place: Point) -> float:
        """Return the cost of the walk from a place to the nearest door, infinite without one."""
        entry = self._nearest(place, 3.0)
        if entry is None or not self._fields:
            return math.inf
        return min(float(cost[entry]) for cost, _ in self._fields)

    def walk(self, place: Point) -> Floats | None:
        """Return the corners (x, z) of the walk from a place beside the free ground to in front of the nearest door.

        Notes
        -----
        The walk over the grid (Dijkstra 1959) is straightened as far as the ground is free.
        """
        start = self._nearest(place, 3.0)
        if start is None or not self._fields:
            return None
        door = min(range(len(self._fields)), key=lambda number: float(self._fields[number][0][start]))
        cost, before = self._fields[door]
        if not math.isfinite(cost[start]):
            return None
        return np.array([np.array(place), *self._straightened(self._free[_traced(before, start)])])

    def around(
        self, start: Point, end: Point | None, ground: Ground, layer: int, *, wanted: Sequence[Cells] = ()
    ) -> Floats | None:
        """Return the corners (x, z) of the shortest walk between two places around the ground that cars hold.

        The walk goes over the grid; None if cars block all. Without an end it leads to the nearest place out of the way
        of the cars that want some ground.
        """
        clear_m = PERSON_RADIUS_M + _AROUND_M
        is_kept = ~ground.near_cars(self._free, layer, clear_m)
        other = None if end is None else self._nearest(end, 3.0)
        if other is not None:
            is_kept[other] = True
        elif end is not None:
            return None
        away = np.where(is_kept, np.hypot(*(self._free - np.array(start)).T), np.inf)
        one = int(away.argmin())
        if away[one] > _ASIDE_M:
            return None
        kept = np.flatnonzero(is_kept)
        number = np.cumsum(is_kept) - 1
        cost, before = dijkstra(self._graph[kept][:, kept], indices=number[one], return_predecessors=True)
        if other is None:
            is_aside = ~ground.near_cars(self._free[kept], layer, clear_m + _AROUND_M, wanted=wanted)
            at = int(np.where(is_aside, cost, np.inf).argmin())
            if not is_aside[at]:
                return None
        else:
            at = int(number[other])
        if not math.isfinite(cost[at]):
            return None
        return np.array([start, *self._free[kept[_traced(before, at)[::-1]]]])

    def _straightened(self, places: Floats) -> Sequence[Floats]:
        kept = [places[0]]
        at = 0
        while at < len(places) - 1:
            last = min(at + 24, len(places) - 1)
            while last > at + 1:
                line = shapely.LineString([places[at], places[last]])
                if (
                    not self._blocked.intersects(line)
                    and np.ptp(places[at : last + 1] @ _across(line), axis=0) < _SIDE_M / 2
                ):
                    break
                last -= 1
            kept.append(places[last])
            at = last
        return kept


def _traced(before: NDArray[np.int32], at: int) -> list[int]:
    """Return the numbers of the grid points from one back to the root of a tree of shortest walks."""
    numbers = [at]
    while before[numbers[-1]] >= 0:
        numbers.append(int(before[numbers[-1]]))
    return numbers


def _across(line: shapely.LineString) -> Floats:
    (x, z), (to_x, to_z) = line.coords
    length = math.hypot(to_x - x, to_z - z) or 1.0
    return np.array([-(to_z - z) / length, (to_x - x) / length])


def _lane_grounds(level: BuiltLevel) -> list[shapely.Geometry]:
    """Return the ground of the aisles between the mouths of stalls."""
    found = []
    for edge in level.lanes.edges:
        one, other = (level.lanes.nodes[number] for number in (edge.start, edge.end))
        if one.level == other.level and one.position != other.position:
            line = shapely.LineString([one.position, other.position])
            found.append(shapely.buffer(line, edge.width_m / 2 + 0.3, cap_style="flat"))
    for node in level.lanes.nodes:
        width_x, width_z = node.sides_m or node.widths_m
        x, z = node.position
        found.append(shapely.box(x - width_x / 2, z - width_z / 2, x + width_x / 2, z + width_z / 2))
    return found
