"""The well of the ramps between levels, as one level has its part of it, and the fire shutters in its openings."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import NamedTuple

from garage2usd.config import FittingsConfig
from garage2usd.config.look import WallsLook
from garage2usd.config.site import BuildingConfig
from garage2usd.garage.levels import level_name
from garage2usd.layout.placement import Placement, edge_yaw_rad, placed
from garage2usd.objects.fire_shutter import FireShutterSpec
from garage2usd.objects.kind import Point
from garage2usd.structure.building import Ramps
from garage2usd.structure.grid import Structure
from garage2usd.structure.stalls import Edge

SLAB_M = 0.25
"""Thickness of a ramp's slab."""
_LEAST_M, _MOST_M = 0.26, 0.42
"""Height of a shutter that is rolled up."""
_DEPTH_M = 0.3
_OVER_CLEAR_M = 0.02


class WellLane(NamedTuple):
    """The carriageway of a ramp.

    Attributes
    ----------
    points
        (x, height, z) in the direction of driving: at its ends, where its slope changes, and along its bends; heights
        over the floor at its foot.
    width_m
        Its width between the walls.
    run_m
        Its length, as seen from above.
    slope
        Its steepest slope; in bends along the inner wall.
    """

    points: tuple[tuple[float, float, float], ...]
    width_m: float
    run_m: float
    slope: float


class Departure(NamedTuple):
    """A ramp over which cars leave a level.

    Attributes
    ----------
    landing
        (row, col) of its landing on the level.
    way
        Direction from the landing to the ramp.
    to
        Name of the level that it leads to.
    is_up
        True if it leads up, towards the street.
    """

    landing: tuple[int, int]
    way: Edge
    to: str
    is_up: bool


class Opening(NamedTuple):
    """An opening in the walls of the well, through which cars drive between a landing and a ramp.

    Attributes
    ----------
    name
        ``Down`` or ``Up``, as the ramp.
    middle_m
        (x, z) of its middle, on the face of the wall.
    faces
        Direction from the ramp to the landing.
    width_m
        Its width.
    """

    name: str
    middle_m: Point
    faces: Edge
    width_m: float


@dataclass(frozen=True, eq=False)
class Well(ABC):
    """The part of the well that belongs to one level.

    Attributes
    ----------
    pair
        The ramps.
    level, levels
        Number of the level from 0 at the top, and number of levels.
    building
        Storey, slope and transitions.
    wall_m
        Thickness of the walls.
    """

    pair: Ramps
    level: int
    levels: int
    building: BuildingConfig
    wall_m: float

    @property
    def name(self) -> str:
        """Name of the level."""
        return level_name(self.level)

    def way_in_words(self, *, is_down: bool) -> str:
        """Describe, after a blank, where the ramp down or up leads to or comes from, as seen from this level."""
        above, below = level_name(self.level - 1), level_name(self.level + 1)
        if self.is_top:
            return f" to {below}" if is_down else f" from {below}"
        if self.is_bottom:
            return f" from {above}" if is_down else f" to {above}"
        return f" from {above}, to {below}" if is_down else f" from {below}, to {above}"

    @property
    def squares(self) -> frozenset[tuple[int, int]]:
        """(row, col) of the squares of the ramps."""
        return frozenset(self.pair.squares)

    @property
    def landings(self) -> dict[tuple[int, int], Point]:
        """Unit vector (x, z) towards the ramp from each landing of this level, by (row, col)."""
        heads = {} if self.is_bottom else {link.head: _vector(link.head_way) for link in self.pair.links}
        feet = {} if self.is_top else {link.foot: _vector(link.foot_way) for link in self.pair.links}
        return {**heads, **feet}

    @property
    def departures(self) -> tuple[Departure, ...]:
        """Ramps over which cars leave this level, the one down first."""
        down, up = self.pair.links
        below = (
            () if self.is_bottom else (Departure(down.head, down.head_way, level_name(self.level + 1), is_up=False),)
        )
        above = () if self.is_top else (Departure(up.foot, up.foot_way, level_name(self.level - 1), is_up=True),)
        return below + above

    @property
    def arrivals(self) -> dict[tuple[int, int], Edge]:
        """Direction to the ramp from each landing of this level on which cars arrive, by (row, col)."""
        down, up = self.pair.links
        below = {} if self.is_bottom else {up.head: up.head_way}
        above = {} if self.is_top else {down.foot: down.foot_way}
        return {**below, **above}

    @property
    def no_ways_out(self) -> frozenset[tuple[int, int]]:
        """(row, col) of the landings of this level that do not lead to the street: all but that of the ramp up."""
        return frozenset(self.landings) - {departure.landing for departure in self.departures if departure.is_up}

    @property
    def is_top(self) -> bool:
        """True on the top level, which has a ceiling over the well."""
        return self.level == 0

    @property
    def is_bottom(self) -> bool:
        """True on the bottom level, which no ramp leaves downwards."""
        return self.level == self.levels - 1

    @abstractmethod
    def walls(self, structure: Structure, fittings: FittingsConfig, look: WallsLook) -> list[Placement]:
        """Place the walls around the well and between its ramps, and the edges of the slab over the openings.

        Raises
        ------
        ConfigError
            If a ramp is left too narrow for a car.
        """

    @abstractmethod
    def openings(self, structure: Structure) -> list[Opening]:
        """Return the openings to the ramps whose foot is on this level."""

    @abstractmethod
    def beside_floors(self, walls: list[Placement]) -> list[Placement]:
        """Return the walls beside a floor, on which objects can hang; not those between the ramps."""

    @abstractmethod
    def ramps(self, structure: Structure, fittings: FittingsConfig) -> list[Placement]:
        """Place the ramps whose foot is on this level, and floors of this level within the well."""

    @abstractmethod
    def ceilings(self, structure: Structure, fittings: FittingsConfig) -> list[Placement]:
        """Place the ceiling over the well on the top level."""

    @abstractmethod
    def tubes(self, structure: Structure, fittings: FittingsConfig) -> list[Placement]:
        """Place tube lights over ramps: on the top ceiling, else on the ramps above those with their foot here."""

    @abstractmethod
    def lanes(self, structure: Structure) -> list[WellLane]:
        """Return the carriageways of the ramp down and of the ramp up from the level above to this one."""


def _vector(way: Edge) -> Point:
    down, right = way.beyond((0, 0))
    return float(right), float(down)


def fire_shutters(well: Well, structure: Structure, fittings: FittingsConfig) -> list[Placement]:
    """Place a fire shutter in each opening of a level to a ramp up from it.

    They keep a fire from the levels above. There are none without space above the clear height.
    """
    ceiling_m = fittings.ceiling_height_m
    height_m = round(min(_MOST_M, ceiling_m - fittings.clear_height_m - _OVER_CLEAR_M), 3)
    if not fittings.fire_shutters or height_m < _LEAST_M:
        return []
    return [
        placed(
            f"FireShutter_{opening.name}",
            FireShutterSpec(opening.width_m, ceiling_m, round(ceiling_m - height_m, 3), _DEPTH_M),
            opening.middle_m,
            yaw_rad=edge_yaw_rad(opening.faces),
        )
        for opening in well.openings(structure)
    ]
