"""Wells of ramps between levels: those of straight ramps, and the choice of a kind.

On each level walls stand around the squares of straight ramps; they are guards of the opening in the slab too. Where
cars drive from a landing onto a ramp the walls leave its whole width open.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np

from garage2usd.common.errors import ConfigError
from garage2usd.config import FittingsConfig, GarageConfig
from garage2usd.config.look import WallsLook
from garage2usd.config.site import BuildingConfig, LinkKind
from garage2usd.garage.ramp_lines import ramp_profile
from garage2usd.layout.ceiling.lighting import TUBE
from garage2usd.layout.placement import Placement, edge_yaw_rad, placed, rounded, to_world
from garage2usd.layout.shell.coil_well import CoilWell
from garage2usd.layout.shell.well import SLAB_M, Opening, Well, WellLane
from garage2usd.layout.tiles import CEILING_THICKNESS_M
from garage2usd.objects.ceiling import CeilingSpec
from garage2usd.objects.flight import FlightSpec
from garage2usd.objects.kind import Point, Spec
from garage2usd.objects.wall import WallSpec
from garage2usd.site.ramp_places import LEVEL_END_M
from garage2usd.structure.building import Flight, Ramps
from garage2usd.structure.grid import Structure
from garage2usd.structure.stalls import Edge

_LEAST_WIDTH_M, _MOST_WIDTH_M = 3.0, 6.0
_LAMP_PITCH_M = 6.0
_MIDDLE = "Middle"


@dataclass(frozen=True)
class WellFrame:
    """The local coordinates of a well in the garage.

    Attributes
    ----------
    way
        The way down.
    origin_m
        (x, z) of the middle of the border at the feet.
    run_m, half_m
        Length of the ramps' squares, and half their width together.
    """

    way: Edge
    origin_m: Point
    run_m: float
    half_m: float

    @classmethod
    def of(cls, flight: Flight, structure: Structure) -> "WellFrame":
        """Return the frame of a flight."""
        rows, cols = zip(*flight.squares, strict=True)
        x, z = structure.column_edges_m, structure.row_edges_m
        left, right = float(x[min(cols)]), float(x[max(cols) + 1])
        top, bottom = float(z[min(rows)]), float(z[max(rows) + 1])
        run = round(flight.run_m(structure), 6)
        half = sum(flight.side_m(structure, link.head) for link in flight.links) / 2
        middle = (left + right) / 2, (top + bottom) / 2
        return cls(flight.way, to_world((0.0, run / 2), middle, edge_yaw_rad(flight.way)), run, half)

    def to_world(self, point: Point) -> Point:
        """Return the (x, z) in the garage of a local point, to the micrometre."""
        return rounded(to_world(point, self.origin_m, edge_yaw_rad(self.way)))

    def placed(
        self, name: str, spec: Spec, point: Point, *, faces: Edge | None = None, height_m: float = 0.0
    ) -> Placement:
        """Place an object at a local point with its +Z down the ramps or towards an edge of a square."""
        yaw = edge_yaw_rad(self.way if faces is None else faces)
        return placed(name, spec, self.to_world(point), height_m=height_m, yaw_rad=yaw)


def flight_profile(run_m: float, building: BuildingConfig) -> tuple[Point, ...]:
    """Return (run, height) pairs along a ramp that fills a run: level ends, transitions of half the slope, and slope.

    Parameters
    ----------
    run_m
        Length of its squares in metres.
    building
        Storey and transitions.
    """
    ends_m = (LEVEL_END_M, LEVEL_END_M)
    profile = ramp_profile(run_m, building.storey_m, building.ramp_transition_m, ends_m)
    return tuple((round(run, 6), round(height, 6)) for run, height in profile)


@dataclass(frozen=True)
class _Lane:
    """Position of a ramp across the well: the borders of its squares and of its carriageway, from the well's middle."""

    name: str
    low_m: float
    high_m: float
    left_m: float
    right_m: float

    @property
    def width_m(self) -> float:
        return round(self.right_m - self.left_m, 6)

    @property
    def middle_m(self) -> float:
        return (self.left_m + self.right_m) / 2


@dataclass(frozen=True, eq=False)
class FlightWell(Well):
    """The well of straight ramps; local coordinates as in `WellFrame`."""

    pair: Flight

    def walls(self, structure: Structure, fittings: FittingsConfig, look: WallsLook) -> list[Placement]:
        """Place the walls around the well and between its ramps, and the edges of the slab over the openings.

        Raises
        ------
        ConfigError
            If a ramp is left too narrow for a car.
        """
        frame = WellFrame.of(self.pair, structure)
        first, last = lanes = self._lanes(structure)
        way, right = self.pair.way, self.pair.right
        height = round(fittings.ceiling_height_m if self.is_top else self.building.storey_m, 6)
        plain = WallSpec(frame.run_m, height, self.wall_m, look.dado_m, look.has_stripe)
        found: list[Placement] = []

        def wall(name: str, spec: WallSpec, place: Point, faces: Edge, low_m: float = 0.0) -> None:
            found.append(frame.placed(f"Wall_Well_{name}", spec, place, faces=faces, height_m=low_m))

        for name, spans, faces in (
            ("Left", (first.low_m, first.left_m), right.opposite),
            (f"{_MIDDLE}Left", (first.right_m, first.high_m), right.opposite),
            (f"{_MIDDLE}Right", (last.left_m, last.low_m), right),
            ("Right", (last.high_m, last.right_m), right),
        ):
            face, back = spans
            spec = replace(plain, thickness_m=round(abs(back - face), 6))
            if name.startswith(_MIDDLE):  # the floors on both sides slope
                spec = replace(spec, dado_m=0.0, has_stripe=False)
            wall(name, spec, (face, -frame.run_m / 2), faces)
        for name, along, faces, is_open in (
            ("Foot", 0.0, way, not self.is_top),
            ("Head", -frame.run_m, way.opposite, not self.is_bottom),
        ):
            for lane in lanes:
                spec, low = replace(plain, length_m=lane.width_m), 0.0
                if is_open:
                    # what is left of a wall over an opening is the edge of the slab
                    low = fittings.ceiling_height_m
                    spec = replace(spec, height_m=round(height - low, 6), dado_m=0.0, has_stripe=False)
                if spec.height_m > 0:
                    wall(f"{name}{lane.name}", spec, (lane.middle_m, along), faces, low)
        return found

    def openings(self, structure: Structure) -> list[Opening]:
        """Return the openings to the ramps whose foot is on this level."""
        if self.is_top:
            return []
        frame = WellFrame.of(self.pair, structure)
        return [
            Opening(lane.name, frame.to_world((lane.middle_m, 0.0)), self.pair.way, lane.width_m)
            for lane in self._lanes(structure)
        ]

    def beside_floors(self, walls: list[Placement]) -> list[Placement]:
        """Return the walls beside a floor, on which objects can hang; not those between the ramps."""
        return [wall for wall in walls if _MIDDLE not in wall.name and not wall.position_m[1]]

    def ramps(self, structure: Structure, fittings: FittingsConfig) -> list[Placement]:  # noqa: ARG002
        """Place the ramps whose foot is on this level."""
        if self.is_top:
            return []
        frame = WellFrame.of(self.pair, structure)
        profile = flight_profile(frame.run_m, self.building)
        return [
            frame.placed(f"Ramp_{lane.name}", FlightSpec(lane.width_m, profile, SLAB_M), (lane.middle_m, 0.0))
            for lane in self._lanes(structure)
        ]

    def ceilings(self, structure: Structure, fittings: FittingsConfig) -> list[Placement]:
        """Place the ceiling over the well on the top level."""
        if not self.is_top:
            return []
        frame = WellFrame.of(self.pair, structure)
        spec = CeilingSpec(round(2 * frame.half_m, 6), frame.run_m, CEILING_THICKNESS_M)
        middle = (0.0, -frame.run_m / 2)
        return [frame.placed("Ceiling_Well", spec, middle, height_m=fittings.ceiling_height_m)]

    def tubes(self, structure: Structure, fittings: FittingsConfig) -> list[Placement]:
        """Place tube lights over ramps: on the top ceiling, else on the ramps above those with their foot here."""
        if self.level == 1:
            return []
        frame = WellFrame.of(self.pair, structure)
        runs, heights = zip(*flight_profile(frame.run_m, self.building), strict=True)
        count = max(1, round(frame.run_m / _LAMP_PITCH_M))
        found = []
        for lane in self._lanes(structure):
            for number in range(count):
                at = (number + 0.5) * frame.run_m / count
                over = fittings.ceiling_height_m
                if not self.is_top:
                    over = self.building.storey_m + float(np.interp(at, runs, heights)) - SLAB_M
                name = f"Tube_Well_{lane.name}_{number + 1}"
                found.append(frame.placed(name, TUBE, (lane.middle_m, -at), height_m=round(over, 6)))
        return found

    def lanes(self, structure: Structure) -> list[WellLane]:
        """Return the carriageways of the ramp down and of the ramp up from the level above to this one."""
        frame = WellFrame.of(self.pair, structure)
        profile = flight_profile(frame.run_m, self.building)
        slope = max((high - low) / (end - start) for (start, low), (end, high) in pairwise(profile))
        found = []
        for lane in sorted(self._lanes(structure), key=lambda lane: lane.name != "Down"):
            points = [(frame.to_world((lane.middle_m, -run)), height) for run, height in profile]
            along = points[::-1] if lane.name == "Down" else points
            found.append(
                WellLane(tuple((x, height, z) for (x, z), height in along), lane.width_m, profile[-1][0], slope)
            )
        return found

    def _lanes(self, structure: Structure) -> tuple[_Lane, _Lane]:
        """Return the two ramps across the well, in the order of their local X."""
        frame, thick = WellFrame.of(self.pair, structure), self.wall_m
        links = self.pair.links[::-1] if self.pair.keeps_left else self.pair.links
        low = -frame.half_m
        lanes: list[_Lane] = []
        for link in links:
            high = low + self.pair.side_m(structure, link.head)
            room = round(high - low - 2 * thick, 6)
            if room < _LEAST_WIDTH_M:
                wanted = f"1, or squares that leave ramps {_LEAST_WIDTH_M} m between their walls"
                raise ConfigError("building.levels", self.levels, wanted)
            # centred in its squares, like the lanes to its landings
            half = min(room, _MOST_WIDTH_M) / 2
            middle = (low + high) / 2
            borders = (round(x, 6) for x in (low, high, middle - half, middle + half))
            lanes.append(_Lane("Down" if link.is_down else "Up", *borders))
            low = high
        return lanes[0], lanes[1]


_WELLS: dict[LinkKind, Callable[[Any, int, int, BuildingConfig, float], Well]] = {
    LinkKind.STRAIGHT: FlightWell,
    LinkKind.HELIX: CoilWell,
}


def make_well(pair: Ramps, level: int, config: GarageConfig) -> Well:
    """Return the part of the well of a pair of ramps that belongs to one level.

    Parameters
    ----------
    pair
        The ramps.
    level
        Number of the level from 0 at the top.
    config
        Settings of the whole garage.
    """
    building = config.building
    return _WELLS[building.ramps](pair, level, building.levels, building, config.fittings.wall_thickness_m)
