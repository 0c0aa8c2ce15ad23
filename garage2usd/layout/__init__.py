"""The layout of a level: every object with its place in metres, independent of file formats."""
# Over 300 lines: the layout and the one function that makes it of a plan.

from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.common.errors import ConfigError
from garage2usd.common.package import drawn_by
from garage2usd.config import GarageConfig, LookConfig
from garage2usd.config.plan import DeadEnds, UnreachableStalls
from garage2usd.garage import LaneGraph, Stall, StallUse
from garage2usd.layout.ceiling.beams import beams, ceiling_levels
from garage2usd.layout.ceiling.lighting import LightLevels
from garage2usd.layout.draws import SquareDraws
from garage2usd.layout.egress.cores import Core, core_placements
from garage2usd.layout.egress.exits import Egress, plan_egress
from garage2usd.layout.egress.shafts import LevelPlan
from garage2usd.layout.floor.panels import with_floor
from garage2usd.layout.furnishing import Floor, furnished
from garage2usd.layout.measures import FloorArea, check_carriageways
from garage2usd.layout.parking.designation import with_designated_stalls
from garage2usd.layout.parking.stalls import garage_stalls, stall_quads, stalls_of, with_turning_stalls
from garage2usd.layout.parking.zones import with_numbers
from garage2usd.layout.placement import PlacedStall, Placement
from garage2usd.layout.shell.building import columns, corner_columns, outer_walls
from garage2usd.layout.shell.well import Well
from garage2usd.layout.source import FloorSource, PlannedFloor
from garage2usd.layout.table import STALL_USES, ObjectTable, StallTable
from garage2usd.layout.tiles import TileGrid, ceiling_panel
from garage2usd.look import drawn_look
from garage2usd.objects import KINDS
from garage2usd.objects.kind import Point
from garage2usd.objects.number_plate import NumberPlateSpec
from garage2usd.structure.grid import Cell, Structure
from garage2usd.structure.lane_graph import LaneSquares, Square
from garage2usd.structure.lanes import DEAD_END_LIMIT_MM, dead_ends

__all__ = [
    "Layout",
    "LightLevels",
    "ObjectTable",
    "PlacedStall",
    "Placement",
    "StallTable",
    "lay_out",
]


_ORDINAL_BITS = 16
"""Bits for the number of a stall on its square in `Layout._stall_keys`."""


@dataclass(frozen=True, eq=False)
class Layout:
    """Every object of a level with its place.

    Attributes
    ----------
    structure
        Tiles of the stage: the squares of a plan, or the pieces into which the floor of a survey is cut.
    source
        The plan or survey that was laid out.
    placements
        All objects: those of tiles in reading order, then those of the building.
    stalls
        All stalls in reading order, which is also the order of their placements.
    ceiling_height_m
        Height of the ceiling's underside.
    illuminance
        Illuminance of lanes and stalls.
    cores
        The stair cores.
    compartments
        Number of each square's fire compartment, from 1; 0 outside and on obstacles. int32, shape (rows, cols).
    look
        Look of the level, with the values that the seed drew.
    unreachable
        Names of the stalls that no car gets into; they are marked or left out.
    undecided
        Names of those unreachable stalls whose path search ended at its bound.
    well
        The ramps to other levels of the building; None in a building of one level.
    shafts
        The shafts of lower levels' stair cores that have no door on this level.
    reaching
        For the stall of each car that stands over a line, the name of the adjacent stall that the car reaches into.
    misparked
        Names of the stalls of misparked cars, which stand so far over a line that they may block the adjacent stall.
    held_back
        Names of the stalls whose cars stand between the lines, because others need the room beside them.
    blocked
        For each stall that a misparked car is proven to block, the name of that car's stall; empty until it is proven.
    """

    structure: Structure
    source: FloorSource = field(repr=False)
    placements: ObjectTable
    stalls: StallTable
    ceiling_height_m: float
    illuminance: LightLevels
    cores: tuple[Core, ...]
    compartments: NDArray[np.int32]
    look: LookConfig = field(default_factory=LookConfig)
    unreachable: frozenset[str] = frozenset()
    reaching: Mapping[str, str] = field(default_factory=dict)
    misparked: frozenset[str] = frozenset()
    held_back: frozenset[str] = frozenset()
    blocked: Mapping[str, str] = field(default_factory=dict)
    undecided: frozenset[str] = frozenset()
    well: Well | None = None
    shafts: tuple[Core, ...] = ()

    _repr_svg_ = drawn_by("garage2usd.view.notebook", "layout_svg")

    @property
    def matrices(self) -> Structure | None:
        """S, R and C of the plan; None for a survey, which has no grid."""
        return self.source.matrices

    @property
    def lane_graph(self) -> LaneGraph:
        """The lane graph in metres."""
        return self.source.lanes

    @cached_property
    def quads(self) -> tuple[Stall, ...]:
        """The stalls in the form of `garage2usd.garage`, in the order of `Layout.stalls`, with occupancy."""
        stalls, occupied = tuple(self.stalls), self.are_occupied().tolist()
        return tuple(stall_quads(stalls, self.source.access(stalls), self.lane_graph, self.blocked, occupied))

    def node_squares(self) -> NDArray[np.int32]:
        """Return the (row, col) that names each lane node in files; int32, shape (nodes, 2)."""
        return self.source.node_squares()

    def counts(self) -> dict[str, int]:
        """Number of objects of each kind."""
        counts = np.bincount(self.placements.kind, minlength=len(KINDS)).tolist()
        return {kind.name: count for kind, count in zip(KINDS, counts, strict=True)}

    def plates_of_cars(self) -> Iterator[tuple[int, int, str]]:
        """Yield the rows in `placements` of the number plates of each car and of the car, and the text on them."""
        objects, (plates, cars) = self.placements, self.cars_with_plates()
        texts = [shape.text if isinstance(shape, NumberPlateSpec) else "" for shape in objects.specs]
        read = (texts[spec] for spec in objects.spec[plates].tolist())
        return zip(plates.tolist(), cars.tolist(), read, strict=True)

    def cars_with_plates(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Rows in `placements` of all number plates, and of the car that each belongs to; shape (plates,)."""
        plates = self.placements.rows_of("number_plate")
        return plates, self._cars_at(self.placements.square[plates], self.placements.ordinal[plates])

    def cars_in_stalls(self) -> NDArray[np.intp]:
        """Row in `placements` of the car or motorbike in each stall, -1 for an empty stall; shape (stalls,)."""
        return self._cars_at(self.stalls.square, self.stalls.ordinal)

    def parked_motorbikes(self) -> NDArray[np.intp]:
        """Rows in `placements` of the motorbikes parked in stalls, without those of the clutter; shape (n,)."""
        rows = self.placements.rows_of("motorbike")
        parked: NDArray[np.intp] = rows[self.placements.square[rows, 0] >= 0]
        return parked

    def are_occupied(self) -> NDArray[np.bool_]:
        """True for each stall with a parked vehicle, or blocked by a misparked one; bool, shape (stalls,)."""
        occupied: NDArray[np.bool_] = self.cars_in_stalls() >= 0
        return occupied | np.isin(self.stalls.names(), list(self.blocked)) if self.blocked else occupied

    def _cars_at(self, square: NDArray[np.integer[Any]], ordinal: NDArray[np.integer[Any]]) -> NDArray[np.intp]:
        """Row in `placements` of the vehicle in the stall with each square and ordinal; -1 for an empty stall."""
        rows = np.concatenate([self.placements.rows_of("car"), self.parked_motorbikes()])
        cars = self._stall_keys(self.placements.square[rows], self.placements.ordinal[rows])
        order = np.argsort(cars)
        keys, rows = np.append(cars[order], -1), np.append(rows[order], -1)
        wanted = self._stall_keys(square, ordinal)
        found = np.searchsorted(keys[:-1], wanted)
        return np.where(keys[found] == wanted, rows[found], -1)

    def _stall_keys(self, square: NDArray[np.integer[Any]], ordinal: NDArray[np.integer[Any]]) -> NDArray[np.int64]:
        """Encode the square and ordinal of each stall as one integer."""
        row, col = square.T.astype(np.int64)
        keys: NDArray[np.int64] = (row * self.structure.shape[1] + col) << _ORDINAL_BITS | ordinal
        return keys

    @property
    def parking_stalls(self) -> int:
        """Number of stalls that cars park in: the number of stalls in reports, plans and data sets.

        Stalls that are kept free, such as access aisles and turning stalls, do not count.
        """
        return int(self.stalls.takes_cars.sum())

    def __repr__(self) -> str:
        """Return the numbers of stalls and of objects."""
        return f"<Layout of {self.parking_stalls} stalls and {len(self.placements)} objects>"

    @property
    def landings(self) -> frozenset[tuple[int, int]]:
        """(row, col) of the landings of ramps between levels, which are portals of S but do not lead to the street."""
        return frozenset(self.well.landings) if self.well else frozenset()

    @property
    def area(self) -> FloorArea:
        """Area of its floor, and of all ground inside its outline."""
        return self.source.area

    @property
    def kept_free_stalls(self) -> int:
        """Number of marked stalls that are kept free: access aisles, turning stalls and unreachable ones."""
        return sum(not STALL_USES[use].is_parked_in for use in self.stalls.use.tolist())

    def uses_in_words(self) -> str:
        """Describe the uses of stalls with their numbers: for cars, then for motorcycles, then kept free."""
        counts = Counter(STALL_USES[use] for use in self.stalls.use.tolist())
        for_motorcycles = counts.pop(StallUse.MOTORCYCLE, 0)
        told = [
            ", ".join(
                f"{count} {use.replace('_', ' ')}" for use, count in counts.most_common() if use.takes_cars is taken
            )
            for taken in (True, False)
        ]
        told[0] += f"; {for_motorcycles} for motorcycles" if for_motorcycles else ""
        return "; kept free: ".join(filter(None, told))

    def columns_at_mouths(self) -> tuple[str, ...]:
        """Names of the columns between stalls and lanes that are not set back from the mouths of stalls."""
        return corner_columns(self.structure, self.of_kind("column"))

    def of_kind(self, kind: str) -> tuple[Placement, ...]:
        """Return all objects of a kind, given by name."""
        return tuple(self.placements.at(self.placements.rows_of(kind)))


def lay_out(
    structure: Structure,
    graph: LaneSquares,
    config: GarageConfig,
    *,
    unreachable: Collection[str] = (),
    held_back: Collection[str] = (),
    kept_clear: shapely.Geometry | None = None,
    open_boots: Collection[str] = (),
    well: Well | None = None,
    egress: Egress | None = None,
) -> Layout:
    """Place every object of a planned level.

    Parameters
    ----------
    structure
        A complete structure.
    graph
        Lane graph of the structure, which reaches every stall.
    config
        Settings: sizes, fittings, parking and seed.
    unreachable
        Names of the stalls that cars do not get into. With ``plan.unreachable_stalls = "drop"`` they are left out, else
        hatched and kept free.
    held_back
        Names of the stalls whose cars must not stand over a line, because others need the room beside them.
    kept_clear
        Ground (x, z) that cars need on their ways into stalls and out; without it no clutter is placed.
    open_boots
        Names of the stalls whose cars have open boots.
    well
        The ramps to other levels; None in a building of one level.
    egress
        Fire compartments and stair cores; planned for this level alone if left out.

    Raises
    ------
    ConfigError
        If a lane or a door is too narrow for cars, a named stall does not exist or takes no car, or all stalls are
        left out.
    """
    bay, fittings, look = config.bay, config.fittings, drawn_look(config.look, config.seed)
    ceiling, beam_depth_m = fittings.ceiling_height_m, ceiling_levels(fittings).beam_depth_m
    wells, no_ways_out = (well.squares, well.no_ways_out) if well else ((), ())
    compartments, cores, shafts = egress or plan_egress([LevelPlan(structure, graph, config)], wells)[0]
    built = [*cores, *shafts]
    grid = TileGrid(structure, graph, bay, left_out=_left_out(built, config, unreachable))
    if not grid.stall_places:
        raise ConfigError("plan.unreachable_stalls", "drop", "a plan that leaves a stall that cars get into")
    check_carriageways(grid)
    pillars = columns(grid, bay, fittings, look.columns, beam_depth_m)
    used = _used_stalls(grid, graph, cores, config, unreachable, no_ways_out)
    stalls = with_numbers(used, graph, has_zones=fittings.zones, keeps_left=config.standard.drives_on_left)
    storey_m = well.building.storey_m if well and not well.is_top else None
    floor = Floor(
        tiles=grid,
        lanes=graph.lanes,
        stalls=stalls,
        quads=tuple(garage_stalls(stalls, graph)),
        shell=outer_walls(grid, fittings, look.walls),
        pillars=pillars,
        blocks=core_placements(structure, built, ceiling, look.walls, wells),
        ceilings=[ceiling_panel(tile, fittings, storey_m) for tile in grid],
        beams=beams(structure, bay, ceiling, beam_depth_m, pillars),
        cores=cores,
        shafts=shafts,
        area_m2=sum(tile.width_m * tile.depth_m for tile in grid),
        draws=_draws(grid, config),
        laid=with_floor,
        well=well,
    )
    found = furnished(floor, config, look, held_back=held_back, kept_clear=kept_clear, open_boots=open_boots)
    return Layout(
        structure,
        PlannedFloor(structure, graph, lay_out, Egress(compartments, cores, shafts), well),
        ObjectTable(found.objects),
        StallTable(stalls),
        ceiling,
        found.illuminance,
        cores,
        compartments,
        look,
        frozenset(unreachable),
        found.reaching,
        found.misparked,
        frozenset(held_back),
        well=well,
        shafts=shafts,
    )


def _draws(grid: TileGrid, config: GarageConfig) -> SquareDraws:
    arrangements = config.stage.arrangements if config.stage.is_nested(len(grid.tiles)) else None
    return SquareDraws(grid.tiles, seed=config.seed, arrangements=arrangements)


def _left_out(cores: Iterable[Core], config: GarageConfig, unreachable: Collection[str]) -> set[str]:
    """Return the names of the stalls in place of which cores stand, and of unreachable stalls that are dropped."""
    is_dropped = config.plan.unreachable_stalls is UnreachableStalls.DROP
    return {name for core in cores for name in core.stalls}.union(unreachable if is_dropped else ())


def _used_stalls(
    grid: TileGrid,
    graph: LaneSquares,
    cores: Sequence[Core],
    config: GarageConfig,
    unreachable: Collection[str],
    no_ways_out: Collection[Square],
) -> tuple[PlacedStall, ...]:
    """Return all stalls, each with its use."""
    stalls = tuple(
        replace(stall, use=StallUse.UNREACHABLE) if stall.name in unreachable else stall
        for stall in stalls_of(grid, graph)
    )
    if config.plan.dead_ends is DeadEnds.STANDARD:
        clause = config.standard.dead_end_length
        limit_mm = min(DEAD_END_LIMIT_MM, round(clause.amount * 1000) if clause else DEAD_END_LIMIT_MM)
        long_ends = [end for end in dead_ends(grid.structure, limit_mm) if end.needs_turning_stall]
        stalls = with_turning_stalls(stalls, grid, long_ends)
    portals = {*grid.structure.where(Cell.ENTRANCE), *grid.structure.where(Cell.EXIT)}
    return with_designated_stalls(
        stalls,
        _foot_exits(grid, cores, no_ways_out),
        config.parking,
        config.standard,
        ways_in_and_out=portals.union(*(graph.graph[portal] for portal in portals)),
    )


def _foot_exits(grid: TileGrid, cores: Iterable[Core], no_ways_out: Collection[Square]) -> list[Point]:
    """Return the exits on foot, (x, z): the doors of the stair cores or, without cores, the first exit for cars."""
    exits = [square for square in grid.structure.where(Cell.EXIT) if square not in no_ways_out]
    return [core.door_m for core in cores] or [grid.tiles[square].middle_m for square in exits[:1]]
