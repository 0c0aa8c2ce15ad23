"""A garage of several levels as built: each level as a garage of its own, and the lanes of the whole."""

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

from pxr import Usd

from garage2usd.as_built.garage import BuiltGarage
from garage2usd.as_built.shapes import Body, Thing
from garage2usd.as_built.stage_reader import garage_of_stage
from garage2usd.garage import LaneGraph, Point, Stall
from garage2usd.reading.lanes import Lanes, read_lanes
from garage2usd.reading.levels import StageLevel, level_stage, levels_of

__all__ = ["BuiltLevel", "BuiltLevels", "built_levels"]

_SAME_PLACE_DIGITS = 2


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
        nodes, edges = self.lanes.nodes, self.lanes.edges
        sloped = [edge for edge in edges if abs(nodes[edge.start].height_m - nodes[edge.end].height_m) > _RISE_M]
        return tuple(sorted({number for edge in sloped for number in (edge.start, edge.end)}))

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
    return BuiltLevels(str(source), stage, whole, tuple(levels))


def _towards_ramps(lanes: LaneGraph) -> dict[tuple[float, float, int], Point]:
    """Return the unit vector from each landing towards its ramp, by the place and level of the landing."""
    nodes = lanes.nodes
    on_ramps = {
        number
        for edge in lanes.edges
        for number in (edge.start, edge.end)
        if abs(nodes[edge.start].height_m - nodes[edge.end].height_m) > _RISE_M
    }
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
