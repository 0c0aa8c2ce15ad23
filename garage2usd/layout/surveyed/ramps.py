"""Ramps of a surveyed building: one carriageway for each direction, between walls, from the lanes of level to level."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import shapely

from garage2usd.garage import LaneKind, Point
from garage2usd.garage.path_line import PathLine
from garage2usd.garage.ramp_lines import heights_along
from garage2usd.layout.ceiling.lighting import TUBE
from garage2usd.layout.placement import Placement, placed
from garage2usd.layout.shell.well import SLAB_M
from garage2usd.objects.path_ramp import PathRampSpec
from garage2usd.structure.helix import WALL_M
from garage2usd.survey.lane_network import Gate

_LAMP_PITCH_M = 6.0
_LEAST_EDGE_M = 0.5
"""Least distance between two nodes of a ramp's lane, over which it rises enough to be known as a ramp."""


class Storey(NamedTuple):
    """What ramps between two levels are built by.

    Attributes
    ----------
    rise_m
        Height from floor to floor.
    ceiling_m, above_m
        Height of the ceiling of the lower level over its floor, and of the upper one over its own.
    """

    rise_m: float
    ceiling_m: float
    above_m: float


@dataclass(frozen=True)
class PlacedRamp:
    """A carriageway in one direction from a level to the next one.

    Attributes
    ----------
    name
        Its name among those of its level.
    source
        Id of the ramp in the source.
    upper
        Number of the upper level from 0; the lower one is the next.
    line
        Middle line from the foot to the head, (x, z), with the width between the walls or to the middle of the ramp.
    is_down
        True if cars drive down.
    storey
        Heights of both levels.
    walls
        True for a wall on the right and on the left, looking up.
    profile
        (distance, height) pairs from the foot.
    room_m
        Height of the ramp up to which there is a slab over it.
    """

    name: str
    source: str
    upper: int
    line: PathLine
    is_down: bool
    storey: Storey
    walls: tuple[bool, bool]
    profile: tuple[Point, ...]
    room_m: float

    @property
    def open_m(self) -> float:
        """Distance from the foot from which on there is no slab over the ramp."""
        runs, heights = zip(*self.profile, strict=True)
        return round(float(np.interp(self.room_m, heights[1:-1], runs[1:-1])), 4)

    @cached_property
    def ground(self) -> shapely.Geometry:
        """Its ground with its walls."""
        return self.line.ground(0.0, self.line.length_m, self._sides_m)

    @cached_property
    def opening(self) -> shapely.Geometry:
        """The opening in the floor of the upper level."""
        return self.line.ground(self.open_m, self.line.length_m, self._sides_m)

    @property
    def _sides_m(self) -> tuple[float, float]:
        right, left = (self.line.width_m / 2 + WALL_M * has_wall for has_wall in self.walls)
        return right, left

    @property
    def slope(self) -> float:
        """Its steepest slope along the middle line."""
        return max((high - low) / (end - start) for (start, low), (end, high) in pairwise(self.profile))

    def gate(self, *, at_head: bool) -> Gate:
        """Return the landing at one end, as the lanes of its level join it."""
        line = self.line.turned() if at_head else self.line
        places = line.at([0.0])
        foot = float(places.u_m[0]), float(places.v_m[0])
        kind = LaneKind.EXIT if at_head is self.is_down else LaneKind.ENTRANCE
        way = round(float(places.along_u[0]), 6) + 0.0, round(float(places.along_v[0]), 6) + 0.0
        return Gate(kind, foot, way, self.line.width_m, is_landing=True)

    def points(self) -> tuple[tuple[float, float, float], ...]:
        """Return (x, height over the lower floor, z) along the line in the direction of driving."""
        runs = [run for run, _ in self.profile]
        for run in self.line.stations_m(self.profile).tolist():
            if min(abs(run - other) for other in runs) > _LEAST_EDGE_M:
                runs.append(run)
        runs.sort()
        places, heights = self.line.at(runs), heights_along(self.profile, runs)
        found = [
            (round(x, 6), round(height, 6), round(z, 6))
            for x, height, z in zip(places.u_m.tolist(), heights.tolist(), places.v_m.tolist(), strict=True)
        ]
        return tuple(found[::-1] if self.is_down else found)

    def placement(self, *, is_under: bool, is_over: bool) -> Placement:
        """Place the ramp on its lower level.

        Parameters
        ----------
        is_under, is_over
            True if a ramp of the level above, or of the one below, lies over it or under it.
        """
        (x, z), storey = self.line.points[0], self.storey
        local = PathLine(tuple((round(v - z, 4), round(u - x, 4)) for u, v in self.line.points), self.line.width_m)
        top_m = storey.rise_m if is_under else storey.rise_m + storey.above_m
        spec = PathRampSpec(
            local,
            self.profile,
            1,
            SLAB_M,
            WALL_M,
            round(top_m, 6),
            round(top_m, 6),
            open_m=self.open_m,
            ceiling_m=storey.ceiling_m,
            walls=(self.walls[1], self.walls[0]),
            has_head_wall=not is_over,
        )
        return placed(f"Ramp_{self.name}", spec, (x, z))

    def tubes(self, *, is_under: bool) -> Iterator[Placement]:
        """Yield tube lights over the part without a slab, under the ceiling of the upper level or the ramp above."""
        start, storey = self.open_m, self.storey
        count = max(1, round((self.line.length_m - start) / _LAMP_PITCH_M))
        runs = start + (np.arange(count) + 0.5) * (self.line.length_m - start) / count
        places, heights = self.line.at(runs), heights_along(self.profile, runs)
        for number, (x, z, height) in enumerate(zip(places.u_m, places.v_m, heights, strict=True), 1):
            over_m = storey.rise_m + (float(height) - SLAB_M if is_under else storey.above_m)
            yield placed(f"Tube_{self.name}_{number}", TUBE, (float(x), float(z)), height_m=round(over_m, 6))


class LevelRamps(NamedTuple):
    """The ramps of one level: those with their foot on it, and those with their head on it.

    Attributes
    ----------
    up, down
        Ramps from this level up, and from it down.
    over
        Ground of the ramps of the level above.
    """

    up: tuple[PlacedRamp, ...] = ()
    down: tuple[PlacedRamp, ...] = ()
    over: shapely.Geometry = shapely.Polygon()

    @property
    def gates(self) -> list[Gate]:
        """The landings: those at the feet, and then those at the heads."""
        return [ramp.gate(at_head=False) for ramp in self.up] + [ramp.gate(at_head=True) for ramp in self.down]

    @property
    def standing(self) -> list[shapely.Polygon]:
        """Ground on which nothing else stands: of ramps, and of openings in the floor."""
        grounds = [ramp.ground for ramp in self.up] + [ramp.opening for ramp in self.down]
        return [part for part in shapely.get_parts(grounds).tolist() if part.geom_type == "Polygon"]

    @property
    def openings(self) -> shapely.Geometry:
        """Openings in the floor."""
        return shapely.union_all([ramp.opening for ramp in self.down])

    def placements(self) -> list[Placement]:
        """Place the ramps with their foot on the level."""
        below = shapely.union_all([ramp.ground for ramp in self.down])
        return [
            ramp.placement(is_under=ramp.ground.intersects(self.over), is_over=ramp.ground.intersects(below))
            for ramp in self.up
        ]

    def tubes(self) -> list[Placement]:
        """Place the lights over these ramps."""
        return [tube for ramp in self.up for tube in ramp.tubes(is_under=ramp.ground.intersects(self.over))]
