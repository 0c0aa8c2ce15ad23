"""The well of the ramps between levels, as one level has its part of it: walls, slab edges, ramps and lamps.

On each level walls stand around the squares of the ramps; they are guards of the opening in the slab too. Where cars
drive from a landing onto a ramp the walls leave its whole width open.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from garage2usd.common.errors import ConfigError
from garage2usd.config import FittingsConfig
from garage2usd.config.building import BuildingConfig
from garage2usd.config.look import WallsLook
from garage2usd.layout.ceiling.lamps import TUBE
from garage2usd.layout.placement import Placement
from garage2usd.layout.shell.well_frame import WellFrame
from garage2usd.layout.tiles import CEILING_THICKNESS_M
from garage2usd.objects.ceiling import CeilingSpec
from garage2usd.objects.flight import FlightSpec
from garage2usd.objects.outline import Point
from garage2usd.objects.wall import WallSpec
from garage2usd.site.flights import LEVEL_END_M
from garage2usd.structure.building import Flight, level_name
from garage2usd.structure.grid import Structure
from garage2usd.structure.stalls import Edge

__all__ = ["SLAB_M", "Well", "WellLane", "flight_profile"]

SLAB_M = 0.25
"""Thickness of a ramp's slab."""
_LEAST_WIDTH_M, _MOST_WIDTH_M = 3.0, 6.0
_LAMP_PITCH_M = 6.0
_MIDDLE = "Middle"


def flight_profile(run_m: float, building: BuildingConfig) -> tuple[Point, ...]:
    """Return (run, height) pairs along a ramp that fills a run: level ends, transitions of half the slope, and slope.

    Parameters
    ----------
    run_m
        Length of its squares in metres.
    building
        Storey and transitions.
    """
    rise, gentle_m = building.storey_m, building.ramp_transition_m
    slope = rise / (run_m - 2 * LEVEL_END_M - gentle_m)
    run, height = 0.0, 0.0
    profile = [(run, height)]
    for length, grade in (
        (LEVEL_END_M, 0.0),
        (gentle_m, slope / 2),
        (run_m - 2 * (LEVEL_END_M + gentle_m), slope),
        (gentle_m, slope / 2),
        (LEVEL_END_M, 0.0),
    ):
        run, height = run + length, height + length * grade
        profile.append((run, height))
    return tuple((round(run, 6), round(height, 6)) for run, height in profile)


@dataclass(frozen=True)
class _Lane:
    """One ramp across the well: the borders of its squares and of its carriageway, from the well's middle."""

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


class WellLane(NamedTuple):
    """The carriageway of a ramp.

    Attributes
    ----------
    points
        (x, height, z) in the direction of driving where its slope changes, heights over the floor at its foot.
    width_m
        Its width between the walls.
    """

    points: tuple[tuple[float, float, float], ...]
    width_m: float


@dataclass(frozen=True, eq=False)
class Well:
    """The part of the well that one level has.

    Local coordinates have their origin on the floor in the middle of the border at the ramps' feet; +Z is the way down.

    Attributes
    ----------
    flight
        The ramps.
    level, levels
        Number of the level from 0 at the top, and number of levels.
    building
        Storey, slope and transitions.
    wall_m
        Thickness of the walls.
    """

    flight: Flight
    level: int
    levels: int
    building: BuildingConfig
    wall_m: float

    @property
    def name(self) -> str:
        """Name of the level."""
        return level_name(self.level)

    def way_in_words(self, *, is_down: bool) -> str:
        """Tell where the ramp down or up leads to or comes from, as seen from this level, after a blank."""
        above, below = level_name(self.level - 1), level_name(self.level + 1)
        if self.is_top:
            return f" to {below}" if is_down else f" from {below}"
        if self.is_bottom:
            return f" from {above}" if is_down else f" to {above}"
        return f" from {above}, to {below}" if is_down else f" from {below}, to {above}"

    @property
    def squares(self) -> frozenset[tuple[int, int]]:
        """(row, col) of the squares of the ramps."""
        return frozenset(self.flight.squares)

    @property
    def landings(self) -> dict[tuple[int, int], Point]:
        """Unit vector (x, z) towards the ramp from each landing of this level, by (row, col)."""
        down_row, down_col = self.flight.way.beyond((0, 0))
        heads = {} if self.is_bottom else {link.head: (float(down_col), float(down_row)) for link in self.flight.links}
        feet = {} if self.is_top else {link.foot: (-float(down_col), -float(down_row)) for link in self.flight.links}
        return {**heads, **feet}

    @property
    def is_top(self) -> bool:
        """True on the top level, which has a ceiling over the well."""
        return self.level == 0

    @property
    def is_bottom(self) -> bool:
        """True on the bottom level, which no ramp leaves downwards."""
        return self.level == self.levels - 1

    def walls(self, structure: Structure, fittings: FittingsConfig, look: WallsLook) -> list[Placement]:
        """Place the walls around the well and between its ramps, and the edges of the slab over the openings.

        Raises
        ------
        ConfigError
            If a ramp is left too narrow for a car.
        """
        frame = WellFrame.of(self.flight, structure)
        first, last = lanes = self._lanes(structure)
        way, right = self.flight.way, self.flight.right
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
            if name.startswith(_MIDDLE):  # the floor beside it slopes
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

    def beside_floors(self, walls: list[Placement]) -> list[Placement]:
        """Return those of its walls that stand beside a floor, on which things can hang: not between the ramps."""
        return [wall for wall in walls if _MIDDLE not in wall.name and not wall.position_m[1]]

    def ramps(self, structure: Structure) -> list[Placement]:
        """Place the ramps whose foot is on this level."""
        if self.is_top:
            return []
        frame = WellFrame.of(self.flight, structure)
        profile = flight_profile(frame.run_m, self.building)
        return [
            frame.placed(f"Ramp_{lane.name}", FlightSpec(lane.width_m, profile, SLAB_M), (lane.middle_m, 0.0))
            for lane in self._lanes(structure)
        ]

    def ceilings(self, structure: Structure, fittings: FittingsConfig) -> list[Placement]:
        """Place the ceiling over the well on the top level."""
        if not self.is_top:
            return []
        frame = WellFrame.of(self.flight, structure)
        spec = CeilingSpec(round(2 * frame.half_m, 6), frame.run_m, CEILING_THICKNESS_M)
        middle = (0.0, -frame.run_m / 2)
        return [frame.placed("Ceiling_Well", spec, middle, height_m=fittings.ceiling_height_m)]

    def tubes(self, structure: Structure, fittings: FittingsConfig) -> list[Placement]:
        """Place tube lights over ramps: on the top ceiling, else on the ramps above those with their foot here."""
        if self.level == 1:
            return []
        frame = WellFrame.of(self.flight, structure)
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
        frame = WellFrame.of(self.flight, structure)
        profile = flight_profile(frame.run_m, self.building)
        found = []
        for lane in sorted(self._lanes(structure), key=lambda lane: lane.name != "Down"):
            points = [(frame.to_world((lane.middle_m, -run)), height) for run, height in profile]
            along = points[::-1] if lane.name == "Down" else points
            found.append(WellLane(tuple((x, height, z) for (x, z), height in along), lane.width_m))
        return found

    def _lanes(self, structure: Structure) -> tuple[_Lane, _Lane]:
        """Return the two ramps across the well, in the order of their local X."""
        frame, thick = WellFrame.of(self.flight, structure), self.wall_m
        links = self.flight.links[::-1] if self.flight.keeps_left else self.flight.links
        low = -frame.half_m
        lanes: list[_Lane] = []
        for link in links:
            high = low + self.flight.side_m(structure, link.head)
            room = round(high - low - 2 * thick, 6)
            if room < _LEAST_WIDTH_M:
                wanted = f"1, or squares that leave ramps {_LEAST_WIDTH_M} m between their walls"
                raise ConfigError("building.levels", self.levels, wanted)
            # in the middle of its squares, as the lanes to its landings are
            half = min(room, _MOST_WIDTH_M) / 2
            middle = (low + high) / 2
            borders = (round(x, 6) for x in (low, high, middle - half, middle + half))
            lanes.append(_Lane("Down" if link.is_down else "Up", *borders))
            low = high
        return lanes[0], lanes[1]
