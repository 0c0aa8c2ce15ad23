"""A garage of several levels as built: each level as a garage of its own, and the lanes of the whole."""

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

import networkx as nx
import numpy as np
from numpy.typing import NDArray
from pxr import Usd

from garage2usd.as_built.garage import BuiltGarage
from garage2usd.as_built.shapes import Body, Thing
from garage2usd.as_built.stage_reader import garage_of_stage
from garage2usd.garage import LaneGraph, Point, Stall
from garage2usd.reading.lanes import Lanes, read_lanes
from garage2usd.reading.levels import StageLevel, level_stage, levels_of

__all__ = ["Bend", "BuiltLevel", "BuiltLevels", "RampLine", "built_levels"]

_SAME_PLACE_DIGITS = 2


class Bend(NamedTuple):
    """The line of a ramp that bends: straight in, three quarters of a circle, straight out across itself.

    Attributes
    ----------
    crossing
        (x, z) where the straights cross.
    way_in, way_out
        Unit vectors (x, z) in the direction of driving.
    radius_m
        Radius of the circle.
    is_left
        True if cars turn to the left.
    """

    crossing: Point
    way_in: Point
    way_out: Point
    radius_m: float
    is_left: bool


class RampLine(NamedTuple):
    """The lane of a ramp between levels.

    Attributes
    ----------
    nodes
        Numbers of its lane nodes in the direction of driving, from landing to landing.
    places
        (x, height, z) of these; float64, shape (n, 3).
    sloped
        Numbers of those between which it rises or falls.
    width_m
        Width of its carriageway.
    """

    nodes: tuple[int, ...]
    places: NDArray[np.float64]
    sloped: tuple[int, ...]
    width_m: float

    @property
    def slope(self) -> NDArray[np.float64]:
        """(x, height, z) of the nodes between which it rises or falls; float64, shape (n, 3)."""
        first = self.nodes.index(self.sloped[0])
        return self.places[first : first + len(self.sloped)]

    @property
    def is_straight(self) -> bool:
        """True if its ends lie in one line."""
        (in_x, in_z), (out_x, out_z) = self._ways
        return abs(out_x * in_z - out_z * in_x) < _STRAIGHT_SIN and in_x * out_x + in_z * out_z > 0

    @property
    def bend(self) -> Bend | None:
        """The bend of a helix; None for a straight ramp, and for one that is no three quarters of a circle."""
        x, z = self.places[:, 0], self.places[:, 2]
        (in_x, in_z), (out_x, out_z) = self._ways
        turned = out_x * in_z - out_z * in_x
        if abs(turned) < 1 - _STRAIGHT_SIN:
            return None
        # the crossing lies ahead of the first place, in line with the last straight
        ahead = ((x[-1] - x[0]) * out_z - (z[-1] - z[0]) * out_x) / (in_x * out_z - in_z * out_x)
        crossing = float(x[0] + ahead * in_x), float(z[0] + ahead * in_z)
        radius = float(((x - crossing[0]) * in_x + (z - crossing[1]) * in_z).max()) / 2
        middle = crossing[0] + radius * (in_x - out_x), crossing[1] + radius * (in_z - out_z)
        away = np.hypot(x - middle[0], z - middle[1])
        if radius <= 0 or (np.abs(away - radius) < _ROUND * radius).sum() < _LEAST_PLACES:
            return None
        return Bend(crossing, (in_x, in_z), (out_x, out_z), radius, is_left=bool(turned < 0))

    @property
    def _ways(self) -> tuple[Point, Point]:
        """Unit vectors (x, z) along its first and its last piece."""
        x, z = self.places[:, 0], self.places[:, 2]
        return _unit(x[1] - x[0], z[1] - z[0]), _unit(x[-1] - x[-2], z[-1] - z[-2])


class BuiltLevel(NamedTuple):
    """One level of a garage as built.

    Attributes
    ----------
    place
        Its name, the path of its prim and the height of its floor.
    garage
        The level as a garage of its own, with its floor at 0.
    """

    place: StageLevel
    garage: BuiltGarage

    def path_in_whole(self, path: str) -> str:
        """Return the path in the whole stage of a prim of the level's own; any other place after the level's name."""
        root = f"/{self.place.path.split('/')[1]}"
        if path == root or path.startswith(f"{root}/"):
            return self.place.path + path[len(root) :]
        return f"{self.place.name}/{path}" if path else self.place.name

    def own_names(self, names: Iterable[str]) -> list[str]:
        """Return the names within the level of those stalls of the whole garage that are on it."""
        start = f"{self.place.name}/"
        return [name.removeprefix(start) for name in names if name.startswith(start)]


@dataclass(frozen=True, eq=False)
class BuiltLevels:
    """A garage of several levels as built.

    Attributes
    ----------
    source
        File of the stage.
    stage
        The stage.
    whole
        Lane graph and stalls of all levels; portals are those to the street.
    levels
        The levels, the top one first.
    """

    source: str
    stage: Usd.Stage
    whole: Lanes
    levels: tuple[BuiltLevel, ...]

    @property
    def lanes(self) -> LaneGraph:
        """The lane graph of all levels."""
        return self.whole.graph

    @property
    def stalls(self) -> tuple[Stall, ...]:
        """The stalls of all levels."""
        return tuple(self.whole.stalls)

    @cached_property
    def ramp_nodes(self) -> tuple[int, ...]:
        """Numbers of the lane nodes at the ends of edges that rise or fall, the landings included."""
        return tuple(sorted(_sloped_nodes(self.lanes)))

    @cached_property
    def ramp_lines(self) -> tuple[RampLine, ...]:
        """The lanes of the ramps between levels, in the order of their nodes."""
        lanes, sloped = self.lanes, set(self.ramp_nodes)
        ways = lanes.graph
        found = []
        for part in sorted(map(sorted, nx.weakly_connected_components(ways.subgraph(sloped)))):
            graph = ways.subgraph(part)
            order = list(nx.topological_sort(graph)) if nx.is_directed_acyclic_graph(graph) else part
            inner = tuple(order)
            for _ in range(2):  # the level part at the end, and the landing
                order = [*[*ways.predecessors(order[0])][:1], *order, *[*ways.successors(order[-1])][:1]]
            places = np.array(
                [(node.position[0], node.height_m, node.position[1]) for node in map(lanes.nodes.__getitem__, order)]
            )
            width_m = min(edge.width_m for edge in lanes.edges if edge.start in sloped and edge.start in part)
            found.append(RampLine(tuple(order), places, inner, width_m))
        return tuple(found)

    @cached_property
    def things(self) -> tuple[Thing, ...]:
        """All objects of all levels, at their heights."""
        return tuple(
            Thing(
                level.path_in_whole(thing.name),
                thing.label,
                tuple(_lifted(body, level.place.floor_m) for body in thing.bodies),
            )
            for level in self.levels
            for thing in level.garage.things
        )


_RISE_M = 0.01
_STRAIGHT_SIN = 0.02
_ROUND = 0.02
_LEAST_PLACES = 6


def _unit(x: float, z: float) -> Point:
    far = math.hypot(x, z) or 1.0
    return float(x) / far, float(z) / far


def built_levels(stage: Usd.Stage, source: str | Path) -> BuiltLevels | None:
    """Read a garage of several levels from an open stage; None from a garage of one level."""
    places = levels_of(stage)
    if not places:
        return None
    whole = read_lanes(stage)
    ahead = _towards_ramps(whole.graph)
    levels = []
    for number, place in enumerate(places):
        garage = garage_of_stage(level_stage(stage, place), source=str(source))
        landings = {
            node.name: ahead[key]
            for node in garage.lanes.nodes
            if node.is_portal and (key := _key(node.position, number)) in ahead
        }
        levels.append(BuiltLevel(place, replace(garage, landings=landings)))
    built = BuiltLevels(str(source), stage, whole, tuple(levels))
    beyond = _level_beyond_m(built)
    if not any(beyond):
        return built
    levels = [
        level._replace(garage=replace(level.garage, level_beyond_m=of_level))
        for level, of_level in zip(levels, beyond, strict=True)
    ]
    return replace(built, levels=tuple(levels))


def _level_beyond_m(built: BuiltLevels) -> list[dict[str, float]]:
    """Return the length of the level floor beyond the edges of landings of helices, by name on each level."""
    found: list[dict[str, float]] = [{} for _ in built.levels]
    for line in built.ramp_lines:
        if line.bend is None:
            continue
        for landing, edge, slope in (line.nodes[:3], line.nodes[:-4:-1]):
            node = built.lanes.nodes[landing]
            ends = (built.lanes.nodes[number].position for number in (edge, slope))
            found[node.level][node.name.rpartition("/")[2]] = round(math.dist(*ends), _SAME_PLACE_DIGITS)
    return found


def _sloped_nodes(lanes: LaneGraph) -> set[int]:
    """Return the numbers of the nodes at the ends of edges that rise or fall."""
    nodes = lanes.nodes
    sloped = (edge for edge in lanes.edges if abs(nodes[edge.start].height_m - nodes[edge.end].height_m) > _RISE_M)
    return {number for edge in sloped for number in (edge.start, edge.end)}


def _towards_ramps(lanes: LaneGraph) -> dict[tuple[float, float, int], Point]:
    """Return the unit vector from each landing towards its ramp, by the place and level of the landing."""
    nodes = lanes.nodes
    on_ramps = _sloped_nodes(lanes)
    level_ends = on_ramps | {number for on in on_ramps for number in lanes.beside[on]}
    found = {}
    for end in level_ends:
        for other in set(lanes.beside[end]) - level_ends:
            (x, z), (ramp_x, ramp_z) = nodes[other].position, nodes[end].position
            far = math.dist((x, z), (ramp_x, ramp_z)) or 1.0
            way = round((ramp_x - x) / far) + 0.0, round((ramp_z - z) / far) + 0.0
            found[_key(nodes[other].position, nodes[other].level)] = way
    return found


def _key(position: Point, level: int) -> tuple[float, float, int]:
    return round(position[0], _SAME_PLACE_DIGITS), round(position[1], _SAME_PLACE_DIGITS), level


def _lifted(body: Body, floor_m: float) -> Body:
    matrix = body.matrix.copy()
    matrix[3, 1] += floor_m
    return body._replace(matrix=matrix)
