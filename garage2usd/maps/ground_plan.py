"""The ground plan of a garage, level by level, in the frame of all maps: what GeoJSON, OpenStreetMap and DXF show."""

import math
import re
from collections import defaultdict
from collections.abc import Iterator
from functools import cached_property
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.as_built import BuiltGarage, BuiltLevel
from garage2usd.garage import LaneGraph, Stall
from garage2usd.garage.levels import LevelPlace
from garage2usd.maps.frame import map_point, map_points

Floats = NDArray[np.float64]

_GRID_M = 1e-3
_CLOSED_M = 0.5
"""Half the width of the gaps in the floor, as of gutters and inner walls, that belong to the ground of a level."""
_STRAIGHT_M = 2e-3
_LEAF_M = 0.1
"""Thickness up to which parts of a block, as leaves and frames of doors, stand out of its ground."""
_DOOR_M = 12.0
"""Greatest distance from the lane node of a portal to its door."""
_LEVEL_NAME = re.compile(r"U(\d+)")


class PlanLane(NamedTuple):
    """The centre line of a lane: points (x, y), float64 of shape (n, 2), its width, and if cars drive along it only."""

    points: Floats
    width_m: float
    one_way: bool


class PlanRamp(NamedTuple):
    """A ramp between two levels: the places of its ends, its lane in the direction of driving, and heights."""

    start: LevelPlace
    end: LevelPlace
    lane: PlanLane
    heights_m: tuple[float, ...]


class PlanDoor(NamedTuple):
    """A door to the street: ``entrance`` or ``exit``, (x, y) of its middle on the outline, and both of its jambs."""

    kind: str
    position: tuple[float, float]
    jambs: Floats


class LevelPlan:
    """The ground plan of a level.

    Parameters
    ----------
    level
        The level.

    Attributes
    ----------
    place
        Its name and height.
    stalls
        Its stalls, with ids in the whole garage and the numbers that are painted.
    corners
        (x, y) of their corners in the order of `Stall`; float64, shape (stalls, 4, 2).
    """

    def __init__(self, level: BuiltLevel) -> None:
        self._level, self.place = level, level.place
        self.stalls = level.stalls
        self.corners: Floats = map_points([stall.corners for stall in level.stalls]).reshape(-1, 4, 2)

    @property
    def number(self) -> str:
        """The level as OpenStreetMap counts it, -1 the first below the street; empty for the only one."""
        return level_number(self.place)

    @property
    def taken_stalls(self) -> frozenset[Stall]:
        """Stalls with a car, or blocked by one."""
        return self._level.taken_stalls

    def name_of(self, stall: Stall) -> str:
        """Return the id of a stall in the whole garage."""
        return self.place.in_whole(stall.name)

    @cached_property
    def outline(self) -> shapely.Polygon | None:
        """The inner faces of the outer walls, or the edge of the floor where there are none; None without a floor."""
        things = self._level.things
        floors = [
            shapely.Polygon(map_points(outline))
            for thing in things
            if thing.label == "floor"
            for body in thing.bodies
            for outline, _, _ in body.pieces()
        ]
        if not floors:
            return None
        walls = shapely.union_all(list(self._bodies("wall")))
        ground = _closed(shapely.union_all([*floors, *self.blocks, walls], grid_size=_GRID_M))
        whole = shapely.union_all([shapely.Polygon(part.exterior) for part in shapely.get_parts(ground)])
        inside = _largest(_closed(shapely.difference(whole, walls, grid_size=_GRID_M)))
        return shapely.simplify(shapely.Polygon(inside.exterior), _STRAIGHT_M).normalize()

    @cached_property
    def columns(self) -> list[shapely.Polygon]:
        """The columns, each as the ground that it takes."""
        return list(self._bodies("column"))

    @cached_property
    def blocks(self) -> list[shapely.Polygon]:
        """Blocks on the floor, as stair cores and rooms, without the leaves of their doors."""
        found = []
        for whole in self._bodies("obstacle"):
            body = whole.buffer(-_LEAF_M, join_style="mitre").buffer(_LEAF_M, join_style="mitre")
            if not body.is_empty:
                found.append(shapely.simplify(shapely.Polygon(_largest(body).exterior), _STRAIGHT_M).normalize())
        return found

    def _bodies(self, label: str) -> Iterator[shapely.Geometry]:
        """Yield the ground of each standing object of a class."""
        pieces = defaultdict(list)
        for solid in self._level.solids.standing(label):
            pieces[solid.name].append(shapely.transform(solid.footprint, map_points))
        return (shapely.union_all(parts, grid_size=_GRID_M).normalize() for parts in pieces.values())

    @cached_property
    def _door_of(self) -> dict[int, PlanDoor]:
        """The door of each portal to the street, by its lane node."""
        level, edge = self._level, None if self.outline is None else self.outline.exterior
        found = {}
        for number in level.street_portals:
            node = level.lanes.nodes[number]
            doors = [door for door in level.doors if math.dist(door.position, node.position) < _DOOR_M]
            door = min(doors, key=lambda door: math.dist(door.position, node.position), default=None)
            at = shapely.Point(map_point(node.position if door is None else door.position))
            if edge is None:
                found[number] = PlanDoor(node.kind, (at.x, at.y), np.array([(at.x, at.y)] * 2))
                continue
            run_m = float(shapely.line_locate_point(edge, at))
            width_m = node.widths_m[0] if door is None or door.clear_width_m is None else door.clear_width_m
            runs = np.array([run_m, run_m - width_m / 2, run_m + width_m / 2]) % edge.length
            middle, *jambs = shapely.get_coordinates(shapely.line_interpolate_point(edge, runs)).round(4).tolist()
            found[number] = PlanDoor(node.kind, (middle[0], middle[1]), np.array(jambs))
        return found

    @property
    def doors(self) -> list[PlanDoor]:
        """The doors to the street."""
        return list(self._door_of.values())

    @cached_property
    def lanes(self) -> list[PlanLane]:
        """The lanes from junction to junction; those at portals begin or end in the door."""
        graph = self._level.lanes
        found = []
        for nodes, width_m, one_way in _runs(graph):
            ends = [(self._door_of[end].position,) if end in self._door_of else () for end in (nodes[0], nodes[-1])]
            inner = map_points([graph.nodes[node].position for node in nodes]).tolist()
            line = shapely.simplify(shapely.LineString([*ends[0], *inner, *ends[1]]), _STRAIGHT_M)
            found.append(PlanLane(shapely.get_coordinates(line), width_m, one_way))
        return found


class GroundPlan(NamedTuple):
    """The ground plan of a garage: its levels, the top one first, and the ramps between them."""

    levels: tuple[LevelPlan, ...]
    ramps: tuple[PlanRamp, ...]


def ground_plan(garage: BuiltGarage) -> GroundPlan:
    """Return the ground plan of a garage."""
    places = [level.place for level in garage.levels]
    ramps = []
    for line in garage.ramp_lines:
        first, last = (garage.lanes.nodes[number].level for number in (line.nodes[0], line.nodes[-1]))
        lane = PlanLane(map_points(line.places[:, [0, 2]]), line.width_m, one_way=True)
        ramps.append(PlanRamp(places[first], places[last], lane, tuple(line.places[:, 1].round(3).tolist())))
    return GroundPlan(tuple(map(LevelPlan, garage.levels)), tuple(ramps))


def level_number(place: LevelPlace) -> str:
    """Return a level as OpenStreetMap counts it, ``-1`` for U1; its name if it has another; empty for the only one."""
    found = _LEVEL_NAME.fullmatch(place.name)
    return f"-{int(found[1])}" if found else place.name


def _runs(lanes: LaneGraph) -> Iterator[tuple[list[int], float, bool]]:
    """Yield nodes, width and direction of the lanes between junctions, portals, and changes of width or direction."""
    at: defaultdict[int, list[int]] = defaultdict(list)
    for index, edge in enumerate(lanes.edges):
        at[edge.start].append(index)
        at[edge.end].append(index)

    def following(index: int, node: int) -> int | None:
        """Return the edge that goes on from an edge beyond a node."""
        edge, others = lanes.edges[index], [other for other in at[node] if other != index]
        if len(others) != 1 or lanes.nodes[node].is_portal:
            return None
        other = lanes.edges[others[0]]
        is_along = not edge.one_way or (edge.end == node) == (other.start == node)
        return others[0] if (other.width_m, other.one_way) == (edge.width_m, edge.one_way) and is_along else None

    taken: set[int] = set()
    for index, edge in enumerate(lanes.edges):
        if index in taken:
            continue
        taken.add(index)
        nodes = [edge.start, edge.end]
        for is_back in (False, True):
            here = index
            while (onward := following(here, nodes[0 if is_back else -1])) is not None and onward not in taken:
                taken.add(onward)
                here, end = onward, nodes[0 if is_back else -1]
                beyond = lanes.edges[here].end if lanes.edges[here].start == end else lanes.edges[here].start
                nodes.insert(0 if is_back else len(nodes), beyond)
        yield nodes, edge.width_m, edge.one_way


def _closed(ground: shapely.Geometry) -> shapely.Geometry:
    """Return ground without its narrow gaps."""
    return ground.buffer(_CLOSED_M, join_style="mitre").buffer(-_CLOSED_M, join_style="mitre")


def _largest(ground: shapely.Geometry) -> shapely.Polygon:
    parts: list[shapely.Polygon] = list(shapely.get_parts(ground))
    return max(parts, key=lambda part: float(part.area))
