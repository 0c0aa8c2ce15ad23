"""Settings of the building's fittings, of the parked cars, and of people and loose objects."""

from enum import StrEnum
from typing import Literal

from pydantic import Field, ValidationInfo, field_validator, model_validator

from garage2usd.common.settings import Settings
from garage2usd.config.markets import MarketName, PaintShares, SegmentShares

CEILING_ROOM_M = 0.15
"""Space between the clear height and the ceiling, in metres, for lamps and door heads."""
_ROUNDING_M = 1e-9
_SLAB_M, _RAMP_FOOT_M, _RAMP_LANDING_M = 0.3, 0.5, 2.5


class FittingsConfig(Settings):
    """Fittings of the building: walls, ramps, services, lights, signs and equipment."""

    clear_height_m: float = Field(2.2, ge=2.0, le=6)
    """Clear height: nothing hangs lower."""
    ceiling_height_m: float = Field(3.2, ge=2.4, le=8)
    """Height of the ceiling's underside above the floor; it leaves room for lights over the clear height."""
    wall_thickness_m: float = Field(0.3, ge=0.1, le=1)
    """Thickness of the outer walls, outside the contour."""
    ramps: bool = True
    """A ramp up to street level behind each portal; if false, portals have closed roller doors."""
    ramp_slope_percent: float = Field(15.0, ge=5, le=20)
    """Slope of the ramps between their transitions."""
    ramp_transition_m: float = Field(3.6, ge=1, le=10)
    """Length of the transitions of half that slope at a ramp's foot and top."""
    barriers: bool = True
    """A barrier gate with a ticket column at each ramp."""
    stall_numbers: bool = True
    """A number painted at the entry of each stall."""
    zones: bool = True
    """Zones by letter and number, on plates around the columns; stalls are numbered within their zone."""
    tubes_per_cell: int = Field(2, ge=0, le=6)
    """Tube lights over each lane square; squares with stalls carry one."""
    lane_lux: float = Field(50.0, gt=0, le=2000)
    """Least mean direct illuminance of the lanes' floor. All tubes have the brightness that this or `stall_lux`
    requires, whichever is greater; `build` reports which of the two decides."""
    stall_lux: float = Field(30.0, gt=0, le=2000)
    """Least mean direct illuminance of the stalls' floor."""
    beams: bool = True
    """Beams from column to column, as deep as the services above the clear height allow."""
    ducts: bool = True
    """Ventilation ducts along the aisles, where there is space above the clear height."""
    cable_trays: bool = True
    """Cable trays along the aisles, where there is space above the clear height."""
    sprinklers: bool = True
    """Sprinkler pipes along the aisles, where there is space above the clear height."""
    exit_signs: bool = True
    """Lit exit signs at junctions, where there is space above the clear height."""
    fire_shutters: bool = Field(True, exclude_if=lambda has_any: has_any)
    """Rolled-up fire shutters at the feet of the ramps between levels, where there is space above the clear height."""
    mirrors: bool = True
    """Convex mirrors at blind corners, on columns and walls."""
    hydrant_cabinets: bool = True
    """Fire hydrant cabinets on columns and walls; every stall and lane is within reach of two."""
    fire_extinguishers: bool = True
    """Pairs of fire extinguishers on columns and walls; every stall and lane is within reach of one."""
    speed_bump_rate: float = Field(0.15, ge=0, le=1)
    """Share of straight lane squares that carry a speed bump."""
    cone_rate: float = Field(0.04, ge=0, le=1)
    """Share of the empty standard stalls that are closed by cones, and of the hatched squares with cones."""
    wheel_stops: bool | Literal["pairs"] = True
    """A wheel stop in each stall: true for a bar across the stall, 'pairs' for a block behind each front wheel."""
    floor_stain_rate: float = Field(0.5, ge=0, le=1)
    """Amount of oil, damp, cracks, patches and tyre marks; 0 for a new floor."""
    no_parking_sign_rate: float = Field(0.5, ge=0, le=1)
    """Share of the free squares without stalls that carry no-parking signs. Unless it is 0, signs also stand before
    stair cores and beside vehicle doors."""
    stair_cores: bool = True
    """Stair cores, as many as the profile requires exits on foot, each in place of two stalls beside a column or a
    wall. Obstacles beside a lane always become cores. A garage with few stalls has fewer."""

    @property
    def ramp_profile(self) -> tuple[tuple[float, float], ...]:
        """Profile of a ramp's floor: (run, height) points in metres, from the inner face of the door's wall outwards.

        Beyond the wall follow a level foot, half slope, full slope, half slope, and a landing at street level.
        """
        rise = self.ceiling_height_m + _SLAB_M
        slope, gentle_m = self.ramp_slope_percent / 100, self.ramp_transition_m
        transition = min(gentle_m * slope / 2, rise / 2)
        run, height = self.wall_thickness_m, 0.0
        profile = [(run, height)]
        for length, climb in (
            (_RAMP_FOOT_M, 0.0),
            (gentle_m, transition),
            ((rise - 2 * transition) / slope, rise - 2 * transition),
            (gentle_m, transition),
            (_RAMP_LANDING_M, 0.0),
        ):
            run, height = run + length, height + climb
            profile.append((run, height))
        return tuple((round(run, 6), round(height, 6)) for run, height in profile)

    @field_validator("ceiling_height_m")
    @classmethod
    def _over_the_clear_height(cls, ceiling_m: float, settings: ValidationInfo) -> float:
        clear_m = settings.data.get("clear_height_m")
        if clear_m is not None and ceiling_m < clear_m + CEILING_ROOM_M - _ROUNDING_M:
            raise ValueError(f"at least {CEILING_ROOM_M} m over fittings.clear_height_m, which is {clear_m}")
        return ceiling_m


class ParkingConfig(Settings):
    """Parked cars and the equipment of stalls: occupancy, chargers, accessible stalls, bodies, paints and poses."""

    occupancy: float = Field(0.6, ge=0, le=1)
    """Share of the stalls that hold a car, and of those for motorcycles that hold one."""
    occupied_stalls: tuple[str, ...] | None = None
    """Ids of the stalls that hold a car or motorcycle, such as ``Stall_r03_c07_2``; all others are free, whatever the
    occupancy."""
    empty_stalls: tuple[str, ...] = ()
    """Ids of stalls that are free, whatever the occupancy."""
    ev_share: float = Field(0.08, ge=0, le=1)
    """Share of the stalls that have a charger."""
    accessible_share: float | None = Field(None, ge=0, le=1)
    """Share of the stalls that are accessible; at least one in a garage of 25 stalls or more, unless it is 0. If left
    out, the number that the profile requires, or a share of 0.02 if it requires none. Each has a hatched access
    aisle beside it, shared by two stalls, which takes the place of one stall."""
    market: MarketName | None = None
    """Market whose mix of cars parks there; if left out, that of the profile's country, or 'world' if it names none."""
    bodies: SegmentShares | None = None
    """Shares of the body classes, such as ``{suv = 0.4, hatchback = 0.6}``, normalised by their sum; if left out, the
    market's. A class that is not named has none. A car is drawn among the bodies that fit its stall."""
    more_models: int = Field(4, ge=0, le=100)
    """A garage has one model of each body class, drawn by its seed, and as many more as the share of the class times
    this number; 100 for all of the catalogue. Each model adds an asset of about 130 KB."""
    paints: PaintShares | None = None
    """Shares of the paints, such as ``{white = 0.5, black = 0.5}``, normalised by their sum; by default the
    market's."""
    reversed_share: float | None = Field(None, ge=0, le=1)
    """Share of the parked cars that stand nose out; if left out, the market's."""
    lateral_spread_m: float = Field(0.15, ge=0, le=0.5)
    """Standard deviation of a parked car's lateral offset from the centre line of its stall, limited by the lines."""
    yaw_spread_deg: float = Field(1.2, ge=0, le=3)
    """Standard deviation of the angle between a parked car and its stall, limited by the lines."""
    max_yaw_deg: float = Field(4.0, ge=0, le=5)
    """Largest angle between a parked car and its stall."""
    over_line: float = Field(0.02, ge=0, le=0.2)
    """Share of the parked cars that stand a few centimetres over a line, only where the car in the next stall, present
    or future, still has room."""
    turned_wheels: float = Field(0.0, ge=0, le=1)
    """Share of the parked cars whose front wheels are left turned. Each angle adds an asset for each body."""
    dusty: float = Field(0.0, ge=0, le=1)
    """Share of the parked cars whose flanks are dusty. Adds an asset for each body."""
    lit: float = Field(0.0, ge=0, le=1)
    """Share of the parked cars whose head and tail lamps glow. Adds an asset for each body. The glow lights its
    surroundings in renderers that treat emissive faces as lights."""
    misparked: float = Field(0.0, ge=0, le=0.5)
    """Share of the parked cars that stand far over a line, at an angle or across two stalls, limited by the free stalls
    beside cars; the stall that such a car covers is labelled as blocked."""

    @model_validator(mode="after")
    def _no_stall_both_ways(self) -> "ParkingConfig":
        both = sorted(set(self.occupied_stalls or ()) & set(self.empty_stalls))
        if both:
            raise ValueError(f"no stall that occupied_stalls and empty_stalls both name ({', '.join(both)})")
        return self


class ClutterAmount(StrEnum):
    """Default density of people and loose objects, for all counts that the user leaves out."""

    NONE = "none"
    USUAL = "usual"
    CROWDED = "crowded"
    """Five times the usual counts."""

    @property
    def factor(self) -> float:
        """Factor on the usual counts."""
        return {ClutterAmount.NONE: 0.0, ClutterAmount.USUAL: 1.0, ClutterAmount.CROWDED: 5.0}[self]


_USUAL = {
    "people": 6.0,
    "bicycles": 3.0,
    "motorbikes": 2.0,
    "trolleys": 2.0,
    "prams": 0.5,
    "bins": 2.0,
    "boxes": 2.0,
    "pallets": 1.0,
    "bags": 1.0,
    "open_boots": 1.5,
}
"""Usual counts per hundred stalls; assumptions, as no survey is published."""


class ClutterConfig(Settings):
    """People and loose objects, placed where no car drives or parks.

    Counts are per hundred stalls and upper limits: an object that finds no free place is left out.
    """

    amount: ClutterAmount = ClutterAmount.NONE
    """Default for counts that are left out: 'none', the 'usual' ones, or 'crowded', five times the usual ones."""
    people: float | None = Field(None, ge=0, le=200)
    """People who stand, wait, look at a phone or walk; usually 6."""
    bicycles: float | None = Field(None, ge=0, le=200)
    """Bicycles; usually 3."""
    motorbikes: float | None = Field(None, ge=0, le=200)
    """Motorbikes; usually 2."""
    trolleys: float | None = Field(None, ge=0, le=200)
    """Shopping trolleys; usually 2."""
    prams: float | None = Field(None, ge=0, le=200)
    """Prams; usually 0.5."""
    bins: float | None = Field(None, ge=0, le=200)
    """Wheeled waste bins; usually 2."""
    boxes: float | None = Field(None, ge=0, le=200)
    """Cardboard boxes; usually 2."""
    pallets: float | None = Field(None, ge=0, le=200)
    """Pallets, bare or in stacks; usually 1."""
    bags: float | None = Field(None, ge=0, le=200)
    """Bags on the floor; usually 1."""
    open_boots: float | None = Field(None, ge=0, le=200)
    """Parked cars whose tailgate or boot lid is open; usually 1.5."""

    def per_hundred(self, what: str) -> float:
        """Return the count per hundred stalls of the setting named `what`."""
        given: float | None = getattr(self, what)
        return _USUAL[what] * self.amount.factor if given is None else given

    @property
    def is_any(self) -> bool:
        """True if any count is greater than 0."""
        return any(self.per_hundred(what) > 0 for what in _USUAL)
