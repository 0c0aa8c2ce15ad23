"""Walks of people between cars and the stair cores, over the free ground beside stalls, aisles and columns."""
# Over 300 lines: walks to a door, around cars and out of their way are found on the same grid.

import math
from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.ndimage import binary_dilation
from scipy.sparse import coo_matrix, csr_matrix
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import cKDTree

from garage2usd.as_built.core_reader import core_doors
from garage2usd.as_built.level import BuiltLevel
from garage2usd.garage import Point
from garage2usd.objects import CAR_LABELS

Floats = NDArray[np.float64]
BREADTH_M, DEPTH_M = 0.46, 0.30
"""Size of a person seen from above (DIN 33402-2, 50th percentile: 0.46 m across the shoulders)."""
PERSON_RADIUS_M = math.hypot(BREADTH_M, DEPTH_M) / 2
_GRID_M = 0.4
_CLEAR_M, _WIDE_M = 0.34, 0.62
"""Distance from cars, stalls and the building that people keep, and such with trolleys."""
_EDGE_M, _CELL_M = 0.065, 0.2
"""Distance between a person and the middle of a cell that a car holds, beyond the person's radius."""
_HEAD_M = 2.0
"""Height under which an object is in a walker's way."""
_MIDDLE_COST = 1.6
"""Cost of the middle of an aisle, as a factor on that of its sides along the mouths of stalls."""
_STALL_COST = 6.0
"""Cost of an empty stall, likewise: people stand there who step aside."""
_PARKED_M = 0.13
"""Distance from parked cars at points of the grid: half way between two of them there is 0.05 m left."""
_SIDE_M = 1.4
_TO_DOOR_M, _BEFORE_DOOR_M, _TRIED = 4.0, 0.5, 16
_AROUND_M, _ASIDE_M, _SEEN_M = 0.3, 2.0, 6.0


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
        every = shapely.union_all([self.standing, *quads, *cars])
        self._near = [shapely.buffer(ground, _CLEAR_M - 0.01, quad_segs=8) for ground in (every, self.standing)]
        blocked = shapely.buffer(every, _CLEAR_M, quad_segs=8)
        wide = shapely.buffer(every, _WIDE_M, quad_segs=8)
        nodes = level.lanes.positions_m
        low, high = nodes.min(axis=0) - 8.0, nodes.max(axis=0) + 8.0
        self._low = np.floor(low / _GRID_M) * _GRID_M
        self._shape = tuple(np.ceil((high - self._low) / _GRID_M).astype(int) + 1)
        cols, rows = np.meshgrid(np.arange(self._shape[0]), np.arange(self._shape[1]), indexing="ij")
        places = np.stack([cols.ravel(), rows.ravel()], axis=1) * _GRID_M + self._low
        self._lanes = shapely.union_all(_lane_grounds(level))
        for ground in (*self._near, blocked, wide, self._lanes):
            shapely.prepare(ground)
        is_lane = shapely.contains_xy(self._lanes, places) & ~shapely.contains_xy(blocked, places)
        # who steps aside may stand in an empty stall
        stalls = shapely.buffer(shapely.union_all(quads), _CLEAR_M, quad_segs=8)
        shapely.prepare((stalls, self._near[1]))
        is_free = is_lane | (shapely.contains_xy(stalls, places) & ~shapely.contains_xy(self._near[1], places))
        self._number = np.full(len(places), -1)
        self._number[is_free] = np.arange(int(is_free.sum()))
        self._free, self._is_lane = places[is_free], is_lane[is_free]
        self._tree = cKDTree(self._free)
        self._is_wide = ~shapely.contains_xy(wide, self._free)
        self._index = np.flatnonzero(is_free)
        self._graph = self._connected(is_free.reshape(self._shape))
        doors = [door.position for door in core_doors(level)]
        if not doors:
            doors = [level.lanes.nodes[number].position for number in level.street_portals]
        entries = {door: self._nearest(door, _TO_DOOR_M, short_m=_BEFORE_DOOR_M) for door in dict.fromkeys(doors)}
        self._doors = [(door, entry) for door, entry in entries.items() if entry is not None]
        self.door_places = np.array([self._free[entry] for _, entry in self._doors]).reshape(-1, 2)
        self._fields = [dijkstra(self._graph, indices=entry, return_predecessors=True) for _, entry in self._doors]
        self._wide_fields: list[tuple[Floats, NDArray[np.int32]]] = []
        self._beside_of: dict[shapely.Polygon, NDArray[np.int64]] = {}
        self._walks: dict[tuple[int, bool], Floats | None] = {}

    def _connected(self, is_free: NDArray[np.bool_]) -> csr_matrix:
        number = self._number.reshape(self._shape)
        beside = shapely.distance(shapely.points(self._free), shapely.boundary(self._lanes)) <= _SIDE_M
        weight = np.where(self._is_lane, np.where(beside, 1.0, _MIDDLE_COST), _STALL_COST)
        found = []
        for step, far in (((1, 0), 1.0), ((0, 1), 1.0), ((1, 1), math.sqrt(2)), ((1, -1), math.sqrt(2))):
            before = slice(0, self._shape[0] - step[0]), slice(max(-step[1], 0), self._shape[1] - max(step[1], 0))
            after = slice(step[0], None), slice(max(step[1], 0), self._shape[1] + min(step[1], 0))
            is_edge = is_free[before] & is_free[after]
            start, end = number[before][is_edge], number[after][is_edge]
            found.append(np.stack([start, end, far * _GRID_M * (weight[start] + weight[end]) / 2], axis=1))
        edges = np.concatenate(found)
        ends = edges[:, :2].astype(np.int64)
        # an edge between two free places may cut a corner
        lines, is_lane = shapely.linestrings(self._free[ends]), self._is_lane[ends].all(axis=1)
        is_clear = ~shapely.intersects(self._near[1], lines)
        is_clear[is_lane] &= ~shapely.intersects(self._near[0], lines[is_lane])
        (start, end), cost, size = ends[is_clear].T, edges[is_clear, 2], len(self._free)
        both = np.concatenate([start, end]), np.concatenate([end, start])
        return coo_matrix((np.concatenate([cost, cost]), both), (size, size)).tocsr()

    def _nearest(
        self,
        place: Point,
        within_m: float,
        *,
        among: NDArray[np.bool_] | None = None,
        short_m: float = 0.0,
        held: Floats | None = None,
    ) -> int | None:
        """Return the number of the free grid point nearest to a place, to which the way is free; None without one.

        Notes
        -----
        Beside a car the way may lead over stalls, but through nothing that stands there. A way to a door ends short of
        it. None leads closer to places that are held, rows of (x, z, distance), than their distance.
        """
        away = np.hypot(*(self._free - np.array(place)).T)
        away = np.where(self._is_lane if among is None else among, away, np.inf)
        nearest = np.argsort(away, kind="stable")[:_TRIED]
        nearest = nearest[away[nearest] <= within_m]
        if not len(nearest):
            return None
        starts = np.broadcast_to(place, (len(nearest), 2))
        shares = short_m / np.maximum(away[nearest], short_m or 1.0)
        starts = starts + (self._free[nearest] - starts) * shares[:, None]
        lines = shapely.linestrings(np.stack([starts, self._free[nearest]], axis=1))
        if held is not None and len(held):
            apart = shapely.distance(lines[:, None], shapely.points(held[:, :2])[None])
            is_open = (apart >= held[:, 2] - 1e-6).all(axis=1)
            nearest, lines = nearest[is_open], lines[is_open]
        for ground in self._near if among is None or among is self._is_wide else self._near[1:]:
            if short_m or ground is self._near[1] or not ground.intersects(shapely.Point(place)):
                found = nearest[~shapely.intersects(ground, lines)]
                if len(found):
                    return int(found[0])
        return None

    def is_clear(self, corners: Floats, *, over_stalls: bool = False) -> bool:
        """Return True if a person may walk along a line without touching the building, and off the stalls."""
        return not self._near[over_stalls].intersects(shapely.LineString(corners))

    def distance_m(self, place: Point) -> float:
        """Return the cost of the walk from a place to the nearest door, infinite without one."""
        entry = self._nearest(place, 3.0)
        if entry is None or not self._fields:
            return math.inf
        return min(float(cost[entry]) for cost, _ in self._fields)

    def walk(self, place: Point, *, is_wide: bool = False) -> Floats | None:
        """Return the corners (x, z) of the walk from a place beside the free ground to the nearest door.

        Notes
        -----
        The walk over the grid (Dijkstra 1959) is straightened as far as the ground is free. A wide one has room for a
        trolley.
        """
        start = self._nearest(place, 3.0, among=self._is_wide if is_wide else None)
        if start is None or not self._fields:
            return None
        if (start, is_wide) not in self._walks:
            self._walks[start, is_wide] = self._to_door(start, is_wide=is_wide)
        found = self._walks[start, is_wide]
        return None if found is None else np.concatenate([[place], found])

    def _to_door(self, start: int, *, is_wide: bool) -> Floats | None:
        fields, numbers = self._fields, np.arange(len(self._free))
        if is_wide:
            numbers = np.flatnonzero(self._is_wide)
            graph, own = self._graph[numbers][:, numbers], np.cumsum(self._is_wide) - 1
            if not self._wide_fields:
                entries = [
                    self._nearest(door, _TO_DOOR_M, among=self._is_wide, short_m=_BEFORE_DOOR_M)
                    for door, _ in self._doors
                ]
                self._wide_fields = [
                    dijkstra(graph, indices=own[entry], return_predecessors=True)
                    for entry in entries
                    if entry is not None
                ]
            fields, start = self._wide_fields, int(own[start])
        if not fields:
            return None
        nearest = min(range(len(fields)), key=lambda number: float(fields[number][0][start]))
        cost, before = fields[nearest]
        if not math.isfinite(cost[start]):
            return None
        found = self._free[numbers[_traced(before, start)]]
        return found if is_wide else self._straightened(np.concatenate([found, self._before_door(nearest)]))

    def _before_door(self, number: int) -> Floats:
        """Return the place in front of a door up to which people walk, if it is beyond the grid; shape (n, 2)."""
        door, entry = self._doors[number]
        start = self._free[entry]
        length = float(np.hypot(*(np.array(door) - start)))
        end = start + (np.array(door) - start) * max(1 - _BEFORE_DOOR_M / (length or 1.0), 0.0)
        return end[None] if self.is_clear(np.array([start, end])) else np.empty((0, 2))

    def to_the_right(self, corners: Floats, by_m: float) -> Floats:
        """Return a walk whose inner corners are moved to its right where the ground is free."""
        if len(corners) < 4:  # noqa: PLR2004 - two corners at each end stay
            return corners
        along = corners[2:] - corners[:-2]
        along /= np.maximum(np.hypot(*along.T), 1e-9)[:, None]
        moved = corners.copy()
        moved[1:-1] += by_m * np.stack([-along[:, 1], along[:, 0]], axis=1)
        lines = shapely.linestrings(np.stack([moved[:-1], moved[1:]], axis=1))
        is_bad = shapely.intersects(self._near[0], lines) | ~self._lanes.covers(lines)
        stays = np.concatenate([is_bad, [True]]) | np.concatenate([[True], is_bad])
        moved[stays] = corners[stays]
        lines = shapely.linestrings(np.stack([moved[:-1], moved[1:]], axis=1))[1:-1]
        return moved if not shapely.intersects(self._near[0], lines).any() else corners

    def across(self, place: Point, outwards: Floats) -> Floats | None:
        """Return the place straight across the aisle from one beside it; None if the way is not free."""
        for far_m in np.arange(9.0, 2.5, -0.5).tolist():
            end = np.array(place) + far_m * outwards
            line = np.array([place, end])
            if self._lanes.contains(shapely.Point(end)) and self.is_clear(line):
                return np.asarray(end)
        return None

    def rolls_m(self, corners: Floats, most_m: float) -> float:
        """Return how far a trolley can roll on straight beyond the end of a walk."""
        along = corners[-1] - corners[-2]
        along /= np.hypot(*along) or 1.0
        ground = shapely.buffer(shapely.LineString([corners[-1], corners[-1] + along * most_m]), _WIDE_M - _CLEAR_M)
        hit = ground.intersection(self._near[0])
        far = float(hit.distance(shapely.Point(corners[-1]))) if not hit.is_empty else most_m
        return min(far - (_WIDE_M if not hit.is_empty else 0.0), most_m)

    def around(
        self,
        start: Point,
        end: Point | None,
        cars: Floats,
        people: Floats,
        *,
        wanted: tuple[Floats, Floats],
        parked: Sequence[shapely.Polygon] = (),
        radius_m: float = PERSON_RADIUS_M,
    ) -> Floats | None:
        """Return the corners (x, z) of the shortest walk between two places around cars and people.

        The walk goes over the grid; None if they block all.

        Parameters
        ----------
        start, end
            The places. Without an end the walk leads to the nearest place out of the way of cars.
        cars
            Middles of the cells that cars hold; shape (n, 2).
        people
            Places (x, z) that other people hold, and how far to keep away; shape (n, 3).
        wanted
            Those that others want besides: of cars, and of people.
        parked
            Outlines of parked cars.
        radius_m
            Radius of who walks; more than that of a person with a trolley.
        """
        # who is further away will have moved on by then
        cars, people = (rows[np.abs(rows[:, :2] - np.array(start)).max(axis=1) < _SEEN_M] for rows in (cars, people))
        is_kept = ~self._near_places(cars, radius_m + _AROUND_M) & ~self._within(people)
        if radius_m > PERSON_RADIUS_M:
            is_kept &= self._is_wide
        beside = [self._beside(ground) for ground in parked]
        is_kept[np.concatenate(beside) if beside else []] = False
        other = None if end is None else self._nearest(end, 3.0, among=is_kept)
        if other is None and end is not None:
            return None
        held = np.concatenate([people, np.insert(cars, 2, radius_m + _CELL_M, axis=1)])
        held = held[np.abs(held[:, :2] - np.array(start)).max(axis=1) < _ASIDE_M + 1.0]
        # who is closer already does not come closer still
        held[:, 2] = np.minimum(held[:, 2], np.hypot(*(held[:, :2] - np.array(start)).T))
        one = self._nearest(start, _ASIDE_M, among=is_kept, held=held)
        if one is None:
            return None
        kept = np.flatnonzero(is_kept)
        number = np.cumsum(is_kept) - 1
        cost, before = dijkstra(self._graph[kept][:, kept], indices=number[one], return_predecessors=True)
        if other is None:
            by_cars = np.concatenate([cars, wanted[0]]) if len(wanted[0]) else cars
            is_aside = ~self._near_places(by_cars, radius_m + _AROUND_M * (1 + bool(len(wanted[0]))))
            is_aside = (is_aside & ~self._within(wanted[1]))[kept]
            at = int(np.where(is_aside, cost, np.inf).argmin())
            if not is_aside[at]:
                return None
        else:
            at = int(number[other])
        if not math.isfinite(cost[at]):
            return None
        walk: Floats = np.concatenate([[start], self._free[kept[_traced(before, at)[::-1]]]])
        return walk

    def _beside(self, ground: shapely.Polygon) -> NDArray[np.int64]:
        """Return the numbers of the free grid points that are too near to a parked car."""
        if ground not in self._beside_of:
            middle = np.array(ground.centroid.coords[0])
            reach_m = float(np.hypot(*(shapely.get_coordinates(ground) - middle).T).max()) + 1.0
            near = np.array(self._tree.query_ball_point(middle, reach_m), dtype=np.int64)
            apart = shapely.distance(shapely.points(self._free[near]), ground)
            self._beside_of[ground] = near[apart < PERSON_RADIUS_M + _PARKED_M]
        return self._beside_of[ground]

    def _within(self, places: Floats) -> NDArray[np.bool_]:
        """Return True for each free grid point within a distance of a place; rows of (x, z, distance)."""
        found = np.zeros(len(self._free), dtype=bool)
        # an edge between two points of the grid comes closer than they do
        for near in self._tree.query_ball_point(places[:, :2], places[:, 2] + _EDGE_M) if len(places) else ():
            found[near] = True
        return found

    def _near_places(self, places: Floats, radius_m: float) -> NDArray[np.bool_]:
        """Return True for each free grid point within a distance of some places."""
        if not len(places):
            return np.zeros(len(self._free), dtype=bool)
        marked = np.zeros(self._shape, dtype=bool)
        at = np.round((places - self._low) / _GRID_M).astype(int)
        at = at[((at >= 0) & (at < self._shape)).all(axis=1)]
        marked[at[:, 0], at[:, 1]] = True
        reach = math.ceil(radius_m / _GRID_M)
        steps = np.arange(-reach, reach + 1) * _GRID_M
        disc = np.hypot(steps[:, None], steps[None, :]) <= radius_m + _GRID_M / 4
        near: NDArray[np.bool_] = binary_dilation(marked, disc).ravel()[self._index]
        return near

    def _straightened(self, places: Floats) -> Floats:
        kept = [places[0]]
        at = 0
        while at < len(places) - 1:
            last = min(at + 24, len(places) - 1)
            while last > at + 1:
                line = shapely.LineString([places[at], places[last]])
                if (
                    np.ptp(places[at : last + 1] @ _across(line), axis=0) < _SIDE_M / 2
                    and not self._near[0].intersects(line)
                ):  # fmt: skip
                    break
                last -= 1
            kept.append(places[last])
            at = last
        return np.array(kept)


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
