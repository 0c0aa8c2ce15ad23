"""A garage as built: its levels, and the lanes and stalls of the whole; metres, Y up."""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import networkx as nx
import numpy as np
from pxr import Usd, Vt

from garage2usd.as_built.attached_levels import FoundLevel, attached_levels, numbers_of_levels, sloped_nodes
from garage2usd.as_built.layout_reader import level_of_layout
from garage2usd.as_built.level import BuiltLevel
from garage2usd.as_built.ramp_line import RampLine
from garage2usd.as_built.shapes import Thing
from garage2usd.as_built.stage_reader import level_of_stage
from garage2usd.common.errors import StageError
from garage2usd.common.progress import Progress, counted, silent
from garage2usd.garage import Fault, LaneGraph, Point, Stall
from garage2usd.garage.levels import LevelPlace
from garage2usd.garage_model import Garage
from garage2usd.objects.ramp import KIND as RAMP
from garage2usd.reading.lanes import read_lanes
from garage2usd.reading.levels import level_stage, levels_of, placed_level
from garage2usd.reading.whole_garage import garage_root, open_garage
from garage2usd.scenes.prims import PlacedObject

_SAME_PLACE_DIGITS = 2
_AXIS = 0.02
"""Sine of the angle to an axis up to which a ramp of a stage lies along it."""
_ONTO_RAMP_M = 4.0
"""Length in metres of a straight ramp on which a car that drives onto it, or comes up, may still be turning."""


@dataclass(frozen=True, eq=False)
class BuiltGarage:
    """A garage as built.

    Attributes
    ----------
    source
        File of the garage, or what it was laid out from.
    lanes
        The lane graph of all levels; portals are those to the street.
    stalls
        The stalls of all levels; among several levels their names begin with that of their level, ``U2/``.
    levels
        The levels, the top one first.
    faults
        Levels and ramps of the file that do not fit together; contradictions of a level are its own.
    stage
        The stage, if the file is one.
    """

    source: str
    lanes: LaneGraph
    stalls: tuple[Stall, ...]
    levels: tuple[BuiltLevel, ...]
    faults: tuple[Fault, ...] = ()
    stage: Usd.Stage | None = None

    @classmethod
    def of_level(cls, level: BuiltLevel) -> "BuiltGarage":
        """Return the garage whose only level is this one."""
        return cls(level.source, level.lanes, level.stalls, (level,), stage=level.stage)

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
            replace(_raised(thing, level.place.floor_m), name=level.place.path_in_whole(thing.name))
            for level in self.levels
            for thing in level.things
        )


def garage_of_file(path: str | Path, *, progress: Progress = silent) -> BuiltGarage:
    """Read a garage from a stage's file; raises as `garage_of_stage`, and if the stage cannot be opened."""
    progress("opening", 0, 1)
    return garage_of_stage(open_garage(Path(path)), source=str(path), progress=progress)


def garage_of_stage(
    stage: Usd.Stage,
    *,
    source: str,
    objects: Callable[[], Iterable[PlacedObject]] | None = None,
    is_judged: bool = True,
    progress: Progress = silent,
) -> BuiltGarage:
    """Read a garage from an open stage in its current composition.

    Parameters
    ----------
    stage
        The stage, opened by `garage2usd.reading.whole_garage.open_garage`.
    source
        File of the stage.
    objects
        Returns the objects of the stage, as for `garage2usd.as_built.contents.read_contents`. It is called only for a
        garage without levels in its stage; levels are read one by one.
    is_judged
        True to read also the data that only rules need: illuminance, and stalls moved without their outlines.
    progress
        Told how many levels are read.

    Raises
    ------
    StageError
        If it has levels of which none is active, one cannot be read, or its prims are nested too deeply.
    """
    try:
        places = levels_of(stage)
        if places[0].is_only:
            known = None if objects is None else objects()
            return BuiltGarage.of_level(
                level_of_stage(stage, source=source, place=places[0], objects=known, is_judged=is_judged)
            )
        return _of_levels(stage, places, source=source, is_judged=is_judged, progress=progress)
    except RecursionError:
        raise StageError(source, "its prims are nested too deeply to be read") from None


def garage_as_made(garage: Garage, *, source: str, kind: str, faults: tuple[Fault, ...] = ()) -> BuiltGarage:
    """Return a garage as it will be built.

    Parameters
    ----------
    garage
        The garage as a value.
    source, kind
        As for `garage2usd.as_built.level.BuiltLevel`.
    faults
        Contradictions in the file that it comes from.
    """
    keeps_left = garage.config.standard.drives_on_left
    levels = tuple(
        replace(level_of_layout(level.layout, source=source, kind=kind, place=level.place), keeps_left=keeps_left)
        for level in garage.levels
    )
    joined = garage.joined
    return _with_ramps(BuiltGarage(source, joined.lane_graph, joined.quads, levels, faults))


def _of_levels(
    stage: Usd.Stage, places: Sequence[LevelPlace], *, source: str, is_judged: bool, progress: Progress
) -> BuiltGarage:
    """Read the levels of a stage, and join them as its lane graph tells."""
    whole, told = read_lanes(stage), garage_root(stage).GetCustomDataByKey("levels")
    names = [*map(str, told)] if isinstance(told, Sequence | Vt.StringArray) else []
    ahead = _towards_ramps(whole.graph)
    levels = []
    numbers = numbers_of_levels(names, [place.name for place in places])
    for place, number in counted("reading", zip(places, numbers, strict=True), len(places), progress):
        level = level_of_stage(level_stage(stage, place), source=source, place=place, is_judged=is_judged)
        landings = {
            node.name: ahead[key]
            for node in level.lanes.nodes
            if node.is_portal and (key := _key(node.position, number)) in ahead
        }
        levels.append(FoundLevel(replace(level, landings=landings), number, placed_level(stage, place)))
    joined = attached_levels(whole, names, levels)
    built = tuple(level.built for level in levels)
    return _with_ramps(BuiltGarage(source, joined.lanes, joined.stalls, built, joined.faults, stage))


def _with_ramps(built: BuiltGarage) -> BuiltGarage:
    """Return the garage with levels that know the way onto the ramps below them."""
    levels = built.levels
    known = (
        replace(level, way_beyond_m=of_level, ramps_below=_ramps_to(lower, level))
        for level, lower, of_level in zip(levels, [*levels[1:], None], _way_beyond_m(built), strict=True)
    )
    return replace(built, levels=tuple(known))


def _ramps_to(lower: BuiltLevel | None, level: BuiltLevel) -> tuple[Thing, ...]:
    """Return the ramps that lead from a level down to the lower one, at their heights over the level's floor."""
    if lower is None:
        return ()
    below_m = lower.place.floor_m - level.place.floor_m
    return tuple(_raised(thing, below_m) for thing in lower.things if thing.label == RAMP.label)


def _way_beyond_m(built: BuiltGarage) -> list[dict[str, float]]:
    """Return how far the way leads on beyond the edges of landings before a route ends, by name on each level."""
    found: list[dict[str, float]] = [{} for _ in built.levels]
    for line in built.ramp_lines:
        if line.is_straight:
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
            along = (ramp_x - x) / far, (ramp_z - z) / far
            is_on_axis = min(map(abs, along)) < _AXIS
            way_x, way_z = (round(part, None if is_on_axis else _SAME_PLACE_DIGITS + 4) + 0.0 for part in along)
            way = way_x, way_z
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
