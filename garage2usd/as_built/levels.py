"""A garage of several levels as built: each level as a garage of its own, and the lanes of the whole."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

import networkx as nx
import numpy as np
from pxr import Usd, Vt

from garage2usd.as_built.attached_levels import FoundLevel, attached_levels, numbers_of_levels, sloped_nodes
from garage2usd.as_built.garage import BuiltGarage
from garage2usd.as_built.layout_reader import garage_of_layout
from garage2usd.as_built.ramp_line import RampLine
from garage2usd.as_built.shapes import Thing
from garage2usd.as_built.stage_reader import garage_of_stage
from garage2usd.common.errors import StageError
from garage2usd.garage import Fault, LaneGraph, Point, Stall
from garage2usd.garage.joined_levels import JoinedLevels
from garage2usd.objects.ramp import KIND as RAMP
from garage2usd.reading.lanes import read_lanes
from garage2usd.reading.levels import StageLevel, level_stage, levels_of, placed_level
from garage2usd.reading.whole_garage import LEVELS, garage_root
from garage2usd.stage.arrangement import ROOT_NAME
from garage2usd.stage.levels import LevelLayout, path_on_level

__all__ = ["BuiltLevel", "BuiltLevels", "built_levels", "laid_out_levels"]

_SAME_PLACE_DIGITS = 2
_ONTO_RAMP_M = 4.0
"""Length in metres of a straight ramp on which a car that drives onto it, or comes up, may still be turning."""


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
        File of the stage, or what it was laid out from.
    lanes
        The lane graph of all levels; portals are those to the street.
    stalls
        The stalls of all levels.
    levels
        The levels, the top one first.
    faults
        Levels and ramps of the file that do not fit together.
    """

    source: str
    lanes: LaneGraph
    stalls: tuple[Stall, ...]
    levels: tuple[BuiltLevel, ...]
    faults: tuple[Fault, ...] = ()

    @cached_property
    def ramp_nodes(self) -> tuple[int, ...]:
        """Numbers of the lane nodes at the ends of edges that rise or fall, the landings included."""
        return tuple(sorted(sloped_nodes(self.lanes)))

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
            replace(_raised(thing, level.place.floor_m), name=level.path_in_whole(thing.name))
            for level in self.levels
            for thing in level.garage.things
        )


def built_levels(stage: Usd.Stage, source: str | Path) -> BuiltLevels | None:
    """Read a garage of several levels from an open stage; None from a garage of one level.

    Parameters
    ----------
    stage
        The stage, opened by `garage2usd.reading.whole_garage.open_garage`.
    source
        File of the stage.

    Raises
    ------
    StageError
        If none of its levels is active, or one cannot be read.
    """
    root = garage_root(stage)
    places = levels_of(stage)
    if not places:
        if root and root.GetChild(LEVELS):
            raise StageError(source, f"{root.GetPath()}/{LEVELS} has no active level")
        return None
    whole, told = read_lanes(stage), root.GetCustomDataByKey("levels")
    names = [*map(str, told)] if isinstance(told, Sequence | Vt.StringArray) else []
    ahead = _towards_ramps(whole.graph)
    levels = []
    numbers = numbers_of_levels(names, [place.name for place in places])
    for place, number in zip(places, numbers, strict=True):
        garage = garage_of_stage(level_stage(stage, place), source=str(source))
        landings = {
            node.name: ahead[key]
            for node in garage.lanes.nodes
            if node.is_portal and (key := _key(node.position, number)) in ahead
        }
        levels.append(FoundLevel(place, number, replace(garage, landings=landings), placed_level(stage, place)))
    joined = attached_levels(whole, names, levels)
    built = tuple(BuiltLevel(level.place, level.garage) for level in levels)
    return _with_ramps(BuiltLevels(str(source), joined.lanes, joined.stalls, built, joined.faults))


def laid_out_levels(layouts: Sequence[LevelLayout], joined: JoinedLevels, *, source: str) -> BuiltLevels:
    """Return the layouts of the levels of a garage, with its lanes and stalls, as a garage as built."""
    levels = (
        BuiltLevel(
            StageLevel(level.name, path_on_level(f"/{ROOT_NAME}", level.name), level.floor_m),
            garage_of_layout(level.layout, source=source, kind="layout"),
        )
        for level in layouts
    )
    return _with_ramps(BuiltLevels(source, joined.lane_graph, joined.quads, tuple(levels)))


def _with_ramps(built: BuiltLevels) -> BuiltLevels:
    """Return the garage with levels that know the way onto the ramps below them."""
    levels = built.levels
    known = (
        level._replace(garage=replace(level.garage, way_beyond_m=of_level, ramps_below=_ramps_to(lower, level)))
        for level, lower, of_level in zip(levels, [*levels[1:], None], _way_beyond_m(built), strict=True)
    )
    return replace(built, levels=tuple(known))


def _ramps_to(lower: BuiltLevel | None, level: BuiltLevel) -> tuple[Thing, ...]:
    """Return the ramps that lead from a level down to the lower one, at their heights over the level's floor."""
    if lower is None:
        return ()
    below_m = lower.place.floor_m - level.place.floor_m
    return tuple(_raised(thing, below_m) for thing in lower.garage.things if thing.label == RAMP.label)


def _way_beyond_m(built: BuiltLevels) -> list[dict[str, float]]:
    """Return how far the way leads on beyond the edges of landings before a route ends, by name on each level."""
    found: list[dict[str, float]] = [{} for _ in built.levels]
    for line in built.ramp_lines:
        if line.bend is None:
            head = built.lanes.nodes[line.nodes[0 if line.is_down else -1]]
            found[head.level][head.name.rpartition("/")[2]] = _ONTO_RAMP_M
            continue
        for landing, edge, slope in (line.nodes[:3], line.nodes[:-4:-1]):
            node = built.lanes.nodes[landing]
            ends = (built.lanes.nodes[number].position for number in (edge, slope))
            found[node.level][node.name.rpartition("/")[2]] = round(math.dist(*ends), _SAME_PLACE_DIGITS)
    return found


def _towards_ramps(lanes: LaneGraph) -> dict[tuple[float, float, int | None], Point]:
    """Return the unit vector from each landing towards its ramp, by the place and level of the landing."""
    nodes = lanes.nodes
    on_ramps = sloped_nodes(lanes)
    level_ends = on_ramps | {number for on in on_ramps for number in lanes.beside[on]}
    found = {}
    for end in level_ends:
        for other in set(lanes.beside[end]) - level_ends:
            (x, z), (ramp_x, ramp_z) = nodes[other].position, nodes[end].position
            far = math.dist((x, z), (ramp_x, ramp_z)) or 1.0
            way = round((ramp_x - x) / far) + 0.0, round((ramp_z - z) / far) + 0.0
            found[_key(nodes[other].position, nodes[other].level)] = way
    return found


def _key(position: Point, level: int | None) -> tuple[float, float, int | None]:
    return round(position[0], _SAME_PLACE_DIGITS), round(position[1], _SAME_PLACE_DIGITS), level


def _raised(thing: Thing, height_m: float) -> Thing:
    """Return an object some metres higher."""
    bodies = []
    for body in thing.bodies:
        matrix = body.matrix.copy()
        matrix[3, 1] += height_m
        bodies.append(body._replace(matrix=matrix))
    return replace(thing, bodies=tuple(bodies))
