"""A garage as a value: its building, and each level with its layout and, where one was made, its plan."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np

from garage2usd.common.errors import Garage2UsdError
from garage2usd.common.package import VERSION, drawn_by
from garage2usd.config import GarageConfig
from garage2usd.garage import LaneGraph, Stall
from garage2usd.garage.levels import JoinedLevels, LevelLanes, LevelPlace, RampLane, join_levels, level_name
from garage2usd.layout import Layout
from garage2usd.layout.source import FloorSource
from garage2usd.layout.surveyed import SurveyedFloor
from garage2usd.planning import Plan, plan_tape_of, tape_of
from garage2usd.planning.stall_kinds import unheld_shares
from garage2usd.structure.building import Building
from garage2usd.structure.grid import Structure
from garage2usd.structure.lane_graph import LaneSquares

TAPE_JOINT = "/"
"""Stands between the tapes of the ramps and of the levels."""
_DECIMALS = 6


class PlannedParts(NamedTuple):
    """What a level was planned from, and as.

    Attributes
    ----------
    site
        Static objects only, as its lanes were planned on.
    plan
        The structure with its lanes, its score, and the archive of other plans.
    graph
        The lane graph in squares; every stall is reached from an entrance and reaches an exit.
    """

    site: Structure
    plan: Plan
    graph: LaneSquares


@dataclass(frozen=True, eq=False)
class GarageLevel:
    """A level of a garage.

    Attributes
    ----------
    place
        Its place in the garage. In the only level of a garage, names of stalls and files do without that of the level.
    config
        The settings of this level alone; those of the garage where it is the only one.
    layout
        Every object in metres, with the floor at 0. Landings of ramps are portals of the level.
    planned
        What it was planned from and as; None for a level that was surveyed. ``site``, ``plan`` and ``graph`` are its
        parts, and raise an error there.
    source_name
        Its name in the file that it was imported from; empty for others, and in a file without levels.
    """

    place: LevelPlace
    config: GarageConfig
    layout: Layout
    planned: PlannedParts | None
    source_name: str = ""

    _repr_svg_ = drawn_by("garage2usd.view.notebook", "level_svg")

    @property
    def name(self) -> str:
        """Its name: ``U1`` is the top level, also where it is the only one."""
        return self.place.name or level_name(0)

    def __repr__(self) -> str:
        """Return the name and the number of stalls."""
        return f"<GarageLevel {self.name} with {self.layout.parking_stalls} stalls>"

    @property
    def floor_m(self) -> float:
        """Height of its floor; the top one lies at 0."""
        return self.place.floor_m

    @property
    def site(self) -> Structure:
        """Static objects only."""
        return self._planned("site").site

    @property
    def plan(self) -> Plan:
        """The structure with its lanes, its score, and the archive of other plans."""
        return self._planned("plan").plan

    @property
    def graph(self) -> LaneSquares:
        """The lane graph in squares."""
        return self._planned("graph").graph

    def _planned(self, field: str) -> PlannedParts:
        if self.planned is None:
            raise Garage2UsdError(f"{field}: a garage that was imported has none")
        return self.planned

    @property
    def metadata(self) -> dict[str, str | int]:
        """Description of the making of the level, for its stage."""
        made = _metadata(self.config, *(() if self.planned is None else (self.planned.plan,)))
        return {**made, "sourceLevel": self.source_name} if self.source_name else made


@dataclass(frozen=True, eq=False)
class Garage:
    """A garage of one level or several, generated or imported.

    Attributes
    ----------
    config
        The settings of the whole.
    building
        S of each level, R and C of all, and the ramps between levels.
    levels
        The levels, the top one first.
    origin
        Name and digest of the file that it was imported from; empty for others.

    Notes
    -----
    ``site``, ``plan``, ``graph`` and ``layout`` are those of the only level; with several levels they raise an error.
    ``lanes`` and ``stalls`` are those of the whole garage.
    """

    config: GarageConfig
    building: Building
    levels: tuple[GarageLevel, ...]
    origin: Mapping[str, str] = field(default_factory=dict)

    _repr_html_ = drawn_by("garage2usd.view.notebook", "garage_html")

    def __repr__(self) -> str:
        """Return the levels with their stalls."""
        return f"<Garage of {list(self.levels)}>"

    @property
    def site(self) -> Structure:
        """Static objects of the only level."""
        return self._only("site").site

    @property
    def plan(self) -> Plan:
        """Plan of the only level."""
        return self._only("plan").plan

    @property
    def graph(self) -> LaneSquares:
        """Lane graph of the only level, in squares."""
        return self._only("graph").graph

    @property
    def layout(self) -> Layout:
        """Layout of the only level."""
        return self._only("layout").layout

    @property
    def plans(self) -> tuple[Plan, ...]:
        """Plan of each level; empty for a garage that was imported."""
        return tuple(level.planned.plan for level in self.levels if level.planned is not None)

    @property
    def remarks(self) -> tuple[str, ...]:
        """Shares of stalls that the site does not hold, one line each."""
        return unheld_shares(self.plans, self.config)

    @property
    def lanes(self) -> LaneGraph:
        """Lanes of the whole garage, with the ramps between levels."""
        return self.joined.lane_graph

    @property
    def stalls(self) -> tuple[Stall, ...]:
        """Stalls of the whole garage; among several levels their names and numbers begin with the level, ``U2/``."""
        return self.joined.quads

    @property
    def parking_stalls(self) -> int:
        """Number of stalls that cars park in, on all levels."""
        return sum(level.layout.parking_stalls for level in self.levels)

    @property
    def tape(self) -> str:
        """Tape by which `generate` makes the garage again; for several levels the ramps', then each level's, by ``/``.

        Raises
        ------
        ConfigError
            If the lanes of a single level were given in several pieces, which no tape makes.
        """
        if self.building.ramps is None:
            return plan_tape_of(self.levels[0].plan)
        return TAPE_JOINT.join([self.building.ramps.tape, *(tape_of(structure) for structure in self.building.levels)])

    @property
    def metadata(self) -> dict[str, str | int]:
        """Description of the making of the garage, for its stage."""
        return {**_metadata(self.config, *self.plans), **self.origin}

    @cached_property
    def joined(self) -> JoinedLevels:
        """Lanes and stalls of all levels as one graph, whose names begin with the level."""
        return _joined(self.building, self.levels)

    def _only(self, field: str) -> GarageLevel:
        if len(self.levels) > 1:
            raise Garage2UsdError(f"{field}: a garage of {len(self.levels)} levels has one each; use levels[i].{field}")
        return self.levels[0]


def _metadata(config: GarageConfig, *plans: Plan) -> dict[str, str | int]:
    """Return what made a garage or a level, with the digest of its structure if that is one."""
    made: dict[str, str | int] = {
        "generator": "garage2usd",
        "version": VERSION,
        "seed": config.seed,
        "configDigest": config.digest(),
    }
    digest = {"structureDigest": plans[0].structure.digest()} if len(plans) == 1 else {}
    side = {"drivesOn": "left"} if config.standard.drives_on_left else {}
    return {**made, **digest, "profile": config.standard.name, **side}


def _joined(building: Building, levels: Sequence[GarageLevel]) -> JoinedLevels:
    """Join the lanes of all levels by the ramps."""
    if levels[0].place.is_only:
        layout = levels[0].layout
        return JoinedLevels(layout.lane_graph, layout.quads, layout.node_squares())
    of_levels = [
        LevelLanes(level.name, level.floor_m, layout.lane_graph, layout.quads, layout.node_squares())
        for level in levels
        for layout in [level.layout]
    ]
    ramps: list[RampLane] = []
    for lower in range(1, len(levels)):
        layout, floor_m = levels[lower].layout, levels[lower].floor_m
        if isinstance(layout.source, SurveyedFloor):
            ramps += _surveyed_ramps(levels[lower - 1].layout.source, layout.source, lower, floor_m)
            continue
        lanes = layout.well.lanes(layout.structure) if layout.well else ()
        for link, lane in zip(building.links, lanes, strict=True):
            head = lower - 1, levels[lower - 1].graph.number_of[link.head]
            foot = lower, levels[lower].graph.number_of[link.foot]
            start, end = (head, foot) if link.is_down else (foot, head)
            points = tuple((x, round(floor_m + height, _DECIMALS), z) for x, height, z in lane.points)
            squares = tuple(_square_of(layout.structure, link.squares, x, z) for x, _, z in points)
            ramps.append(RampLane(start, end, points, squares, lower, lane.width_m))
    return join_levels(of_levels, ramps)


def _surveyed_ramps(upper: FloorSource, floor: SurveyedFloor, number: int, floor_m: float) -> Iterator[RampLane]:
    """Yield the ramps up from a level that was surveyed; a node is named by the ramp and by its number on it."""
    assert isinstance(upper, SurveyedFloor)
    heads, first = upper.part.ramps.down, upper.first_landing + len(upper.part.ramps.up)
    for index, ramp in enumerate(floor.part.ramps.up):
        head = number - 1, first + heads.index(ramp)
        foot = number, floor.first_landing + index
        points = tuple((x, round(floor_m + height, _DECIMALS), z) for x, height, z in ramp.points())
        squares = tuple((index + 1, place) for place in range(len(points)))
        start, end = (head, foot) if ramp.is_down else (foot, head)
        yield RampLane(start, end, points, squares, number, ramp.line.width_m)


def _square_of(structure: Structure, squares: tuple[tuple[int, int], ...], x: float, z: float) -> tuple[int, int]:
    """Return the square of a ramp that a point lies on, the nearest one at an end."""
    edges_x, edges_z = structure.column_edges_m, structure.row_edges_m
    middles = [((edges_x[col] + edges_x[col + 1]) / 2, (edges_z[row] + edges_z[row + 1]) / 2) for row, col in squares]
    far = [abs(mid_x - x) + abs(mid_z - z) for mid_x, mid_z in middles]
    return squares[int(np.argmin(far))]
