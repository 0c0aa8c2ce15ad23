"""A level of a garage as built: lanes, stalls and objects, as far as its file has them, and circulation; metres."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray
from pxr import Usd

from garage2usd.as_built.openings import Door, Ramp, doors_of, ramps_of
from garage2usd.as_built.shapes import Thing
from garage2usd.as_built.solids import Solid, Solids, StallGrounds
from garage2usd.garage import Fault, LaneGraph, Point, Stall, StallUse
from garage2usd.garage.levels import ONLY_LEVEL, LevelPlace
from garage2usd.objects import CAR_LABELS
from garage2usd.planning import measured_circulation
from garage2usd.site.portals import outer_squares
from garage2usd.structure.grid import Cell, Structure

_MM2_PER_M2 = 1_000_000
_LINE_M = 0.06
"""Half the width of a stall's painted line in metres; the line is centred on the stall's border."""


class LaneRun(NamedTuple):
    """A dead end with its branches, or a stretch of lanes without a junction.

    Attributes
    ----------
    lanes
        Names of its lane nodes, of a dead end from the deepest one on.
    length_m
        Its length from border to border.
    """

    lanes: tuple[str, ...]
    length_m: float


class LaneCirculation(NamedTuple):
    """Circulation on the lanes of a garage.

    Attributes
    ----------
    loops
        Number of independent circuits.
    dead_ends, stretches
        The dead ends, and the stretches without a junction.
    blocks
        Names of the four lane nodes of each block of two by two, from its upper left to its lower right.
    """

    loops: int
    dead_ends: tuple[LaneRun, ...]
    stretches: tuple[LaneRun, ...]
    blocks: tuple[tuple[str, ...], ...]


def lane_circulation(structure: Structure) -> LaneCirculation:
    """Measure the circulation on the lanes of a structure."""
    found = measured_circulation(structure)
    return LaneCirculation(
        found.circulation.loops,
        tuple(LaneRun(_names(run.squares), run.length_m) for run in found.dead_ends),
        tuple(LaneRun(_names(run.squares), run.length_m) for run in found.stretches),
        tuple(
            _names([(row, col), (row, col + 1), (row + 1, col), (row + 1, col + 1)])
            for row, col in found.circulation.blocks
        ),
    )


def _names(squares: Iterable[tuple[int, int]]) -> tuple[str, ...]:
    """Name the lane nodes on squares as `garage2usd.garage.LaneNode` does."""
    return tuple(f"[{row}, {col}]" for row, col in squares)


@dataclass(frozen=True, eq=False)
class BuiltLevel:
    """A level of a garage as built, as a garage of its own with its floor at 0.

    Attributes
    ----------
    source
        File of the garage.
    kind
        ``stage``, ``report`` or ``plan``.
    lanes, stalls
        Lane graph and stalls.
    things
        All objects; empty for a plan that could not be laid out.
    structure
        S, R and C, if known.
    compartments
        Number of the fire compartment of each square of S, from 1; None where none are declared.
    lane_lux, stall_lux
        Mean illuminance of the floor; None if unknown.
    lamps, dead_lamps
        Number of lamps, and of those without light.
    faults
        Contradictions in the file's lanes and stalls.
    stage
        The stage, if the file is one.
    landings
        Portals that are landings of ramps to other levels, not portals to the street: the unit vector (x, z) from each
        towards its ramp, by name.
    way_beyond_m
        How far beyond the edge of a landing a car drives before its way through the level ends, by name.
    ramps_below
        The ramps that lead down from the landings, at their heights over the floor.
    place
        Its name, the path of its prim and the height of its floor in the whole garage.
    is_surveyed
        True if its stalls and lanes are those of a survey, which nobody designed to a standard.
    keeps_left
        True where traffic keeps to the left.
    """

    source: str
    kind: str
    lanes: LaneGraph
    stalls: tuple[Stall, ...]
    things: tuple[Thing, ...] = ()
    structure: Structure | None = None
    compartments: NDArray[np.int32] | None = None
    lane_lux: float | None = None
    stall_lux: float | None = None
    lamps: int = 0
    dead_lamps: int = 0
    faults: tuple[Fault, ...] = ()
    stage: Usd.Stage | None = None
    landings: Mapping[str, Point] = field(default_factory=dict)
    way_beyond_m: Mapping[str, float] = field(default_factory=dict)
    ramps_below: tuple[Thing, ...] = ()
    place: LevelPlace = ONLY_LEVEL
    is_surveyed: bool = False
    keeps_left: bool = False

    @property
    def street_portals(self) -> list[int]:
        """Numbers of the entrances and exits that lead to the street."""
        portals = self.lanes.portals("entrance", "exit")
        return [number for number in portals if self.lanes.nodes[number].name not in self.landings]

    @cached_property
    def solids(self) -> Solids:
        """Solid pieces of all objects that a car can touch."""
        return Solids(self.things)

    @cached_property
    def doors(self) -> tuple[Door, ...]:
        """The vehicle doors."""
        return tuple(doors_of(self.things))

    @cached_property
    def ramps(self) -> tuple[Ramp, ...]:
        """The ramps."""
        return tuple(ramps_of(self.things))

    @cached_property
    def circulation(self) -> LaneCirculation | None:
        """Circulation of traffic on the lanes; None if S, R and C are unknown."""
        return None if self.structure is None else lane_circulation(self.structure)

    @cached_property
    def parking_stalls(self) -> tuple[Stall, ...]:
        """Stalls that take cars."""
        return tuple(stall for stall in self.stalls if stall.takes_cars)

    @cached_property
    def stall_grounds(self) -> StallGrounds:
        """Spatial index of the ground of all stalls."""
        return StallGrounds(self.stalls)

    @cached_property
    def standing_in_stalls(self) -> dict[Stall, list[Solid]]:
        """Standing pieces on the ground for a car in each stall, without those only on its lines."""
        inside = shapely.buffer(self.stall_grounds.rectangles, -_LINE_M)
        return dict(zip(self.stalls, self.solids.standing_at_each(inside), strict=True))

    @cached_property
    def cars(self) -> dict[str, tuple[shapely.Polygon, Stall | None]]:
        """Convex ground of each car, and the stall that contains more than half of it."""
        pieces = list(self.solids.standing(*CAR_LABELS))
        names = list(dict.fromkeys(solid.name for solid in pieces))
        number_of = {name: number for number, name in enumerate(names)}
        owner = np.array([number_of[solid.name] for solid in pieces], dtype=np.int64)
        order = np.argsort(owner, kind="stable")
        parts = np.array([solid.footprint for solid in pieces], dtype=object)[order]
        if not pieces:
            return {}
        grounds = shapely.convex_hull(shapely.multipolygons(parts, indices=owner[order]))
        homes = self.stall_grounds.homes_of(grounds)
        return {name: (ground, home) for name, ground, home in zip(names, grounds, homes, strict=True)}

    @cached_property
    def taken_stalls(self) -> frozenset[Stall]:
        """Stalls with a car or motorcycle, and stalls blocked by a misparked car."""
        own = frozenset(home for _, home in self.cars.values() if home is not None)
        names = {stall.name for stall in own}
        return own.union(self._motorcycle_homes, (stall for stall in self.stalls if stall.blocked_by in names))

    @cached_property
    def _motorcycle_homes(self) -> frozenset[Stall]:
        """Stalls for motorcycles with a motorbike."""
        pieces = np.array([solid.footprint for solid in self.solids.standing("motorbike")], dtype=object)
        homes = self.stall_grounds.homes_of(pieces) if len(pieces) else []
        return frozenset(home for home in homes if home is not None and home.use is StallUse.MOTORCYCLE)

    def compartment_at(self, place: Point) -> int:
        """Return the number of the fire compartment at a place; 0 where none are declared."""
        if self.structure is None or self.compartments is None:
            return 0
        return int(self.compartments[_square_at(place, self.structure)])

    def compartment_areas_m2(self) -> dict[int, float]:
        """Return the floor area of each fire compartment by its number; of the floor as 0 where none are declared.

        It is NaN if S, R and C are unknown.
        """
        if self.structure is None:
            return {0: math.nan}
        areas = np.outer(self.structure.row_depths_mm, self.structure.column_widths_mm) / _MM2_PER_M2
        inside = self.structure.cells != Cell.OBSTACLE
        numbers = np.zeros(inside.shape, np.int32) if self.compartments is None else self.compartments
        return {
            number: float(areas[inside & (numbers == number)].sum()) for number in np.unique(numbers[inside]).tolist()
        }

    def is_on_contour(self, place: Point) -> bool | None:
        """Return True if a place lies beside the edge of the contour; None if S, R and C are unknown."""
        if self.structure is None:
            return None
        return bool(outer_squares(self.structure.cells)[_square_at(place, self.structure)])

    @property
    def has_whole_graph(self) -> bool:
        """True if lane nodes and edges are consistent: a node without a route is then a finding, not a damaged file."""
        return all(fault.rule != "lane-graph" for fault in self.faults)


def _square_at(place: Point, structure: Structure) -> tuple[int, int]:
    """Return the (row, col) of the square at a place, or the nearest one."""
    edges = (structure.row_edges_m, place[1]), (structure.column_edges_m, place[0])
    row, col = (int(np.clip(np.searchsorted(lines, at) - 1, 0, len(lines) - 2)) for lines, at in edges)
    return row, col
