"""Settings of what stands, hangs and parks in the garage."""

from typing import Literal

from pydantic import Field, ValidationInfo, field_validator, model_validator

from garage2usd.common.settings import Settings
from garage2usd.config.markets import MarketName, PaintShares, SegmentShares

__all__ = ["FittingsConfig", "ParkingConfig"]

CEILING_ROOM_M = 0.15
"""What lights and the heads of doors need between the clear height and the ceiling."""
_ROUNDING_M = 1e-9
_SLAB_M, _RAMP_FOOT_M, _RAMP_LANDING_M = 0.3, 0.5, 2.5


class FittingsConfig(Settings):
    """The building's fittings."""

    clear_height_m: float = Field(2.2, ge=2.0, le=6)
    """Height that nothing hangs below."""
    ceiling_height_m: float = Field(3.2, ge=2.4, le=8)
    """Height of the ceiling's underside above the floor; it leaves room for lights over the clear height."""
    wall_thickness_m: float = Field(0.3, ge=0.1, le=1)
    """Thickness of the outer walls, outside the contour."""
    ramps: bool = True
    """A ramp to the ground outside behind each portal; without, portals have closed roller doors."""
    ramp_slope_percent: float = Field(15.0, ge=5, le=20)
    """Slope of the ramps between their gentler pieces."""
    ramp_transition_m: float = Field(3.6, ge=1, le=10)
    """Length of the pieces of half that slope at a ramp's foot and top."""
    barriers: bool = True
    """A barrier gate with a ticket column at each ramp."""
    stall_numbers: bool = True
    """A number painted at the mouth of each stall."""
    zones: bool = True
    """Zones by letter and number, on plates around the columns; stalls are numbered within theirs."""
    tubes_per_cell: int = Field(2, ge=0, le=6)
    """Tube lights over each lane square; squares with stalls carry one."""
    lane_lux: float = Field(50.0, gt=0, le=2000)
    """Least mean direct illuminance wanted on the lanes' floor: all tubes are as bright as this or `stall_lux` needs,
    whichever needs more; `build` says which of the two decides."""
    stall_lux: float = Field(30.0, gt=0, le=2000)
    """The same on the stalls."""
    beams: bool = True
    """Beams from column to column, as deep as the room that services leave over the clear height."""
    ducts: bool = True
    """Ventilation ducts along the aisles, where they find room over the clear height."""
    cable_trays: bool = True
    """Cable trays along the aisles, where they find room."""
    sprinklers: bool = True
    """Sprinkler pipes along the aisles, where they find room."""
    exit_signs: bool = True
    """Lit signs at junctions, where the ceiling leaves room over the clear height."""
    mirrors: bool = True
    """Convex mirrors at blind corners, on columns and walls."""
    hydrant_cabinets: bool = True
    """Fire hydrant cabinets on columns and walls, so many that two jets reach every stall and lane."""
    fire_extinguishers: bool = True
    """Pairs of fire extinguishers on columns and walls, so many that one is in reach of every stall and lane."""
    speed_bump_rate: float = Field(0.15, ge=0, le=1)
    """Share of straight lane squares that carry a speed bump."""
    cone_rate: float = Field(0.04, ge=0, le=1)
    """Share of the standard stalls without a car that cones close, and of the hatched squares with cones."""
    wheel_stops: bool | Literal["pairs"] = True
    """A wheel stop in each stall: true for a bar across it, 'pairs' for a block behind each front wheel."""
    floor_stain_rate: float = Field(0.5, ge=0, le=1)
    """How much oil, damp, cracks, patches and tyre marks there are; 0 for a new floor."""
    no_parking_sign_rate: float = Field(0.5, ge=0, le=1)
    """Share of the free squares without stalls that carry no-parking signs. Signs stand before stair cores and beside
    vehicle doors too, unless it is 0."""
    stair_cores: bool = True
    """As many stair cores as the profile's exits for people ask for, each in the place of two stalls beside a column or
    a wall; obstacles beside a lane are cores anyway. In a garage with few stalls there are fewer."""

    @property
    def ramp_profile(self) -> tuple[tuple[float, float], ...]:
        """(run, height) along a ramp's floor from the inner face of the door's wall to its far end.

        From the back of that wall on: a level foot, half slope, full slope, half slope, and a landing on the ground.
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
    """The parked cars."""

    occupancy: float = Field(0.6, ge=0, le=1)
    """Share of the stalls that hold a car, and of those for motorcycles that hold one."""
    occupied_stalls: tuple[str, ...] | None = None
    """Ids of the stalls that hold a car or motorcycle, as ``Stall_r03_c07_2``; all others are free then, whatever the
    occupancy."""
    empty_stalls: tuple[str, ...] = ()
    """Ids of stalls that are free, whatever the occupancy."""
    ev_share: float = Field(0.08, ge=0, le=1)
    """Share of the stalls that have a charger."""
    accessible_share: float | None = Field(None, ge=0, le=1)
    """Share of the stalls that are accessible: one at least in a garage of 25 stalls or more, unless it is 0. Left out,
    as many as the profile asks for, or a share of 0.02 where it asks for none. Each has a hatched access aisle beside
    it, that two of them share and that takes the place of a stall."""
    market: MarketName | None = None
    """Whose cars park there; left out, those of the profile's country, or of the world where it names none."""
    bodies: SegmentShares | None = None
    """Shares of the classes of bodies, as ``{suv = 0.4, hatchback = 0.6}``, as parts of their sum; left out, the
    market's. A class that is not named has none. A car is drawn among the bodies that fit into its stall."""
    paints: PaintShares | None = None
    """Shares of the paints likewise, as ``{white = 0.5, black = 0.5}``."""
    reversed_share: float | None = Field(None, ge=0, le=1)
    """Share of the parked cars that stand nose out; left out, the market's."""
    lateral_spread_m: float = Field(0.15, ge=0, le=0.5)
    """Standard deviation of how far a parked car stands beside the middle of its stall, as far as the lines leave
    room."""
    yaw_spread_deg: float = Field(1.2, ge=0, le=3)
    """Standard deviation of the angle between a parked car and its stall, as far as the lines leave room."""
    max_yaw_deg: float = Field(4.0, ge=0, le=5)
    """Largest such angle."""
    over_line: float = Field(0.02, ge=0, le=0.2)
    """Share of the parked cars that stand a few centimetres over a line, only where the next stall's car, parked or to
    come, has its room nevertheless."""
    turned_wheels: float = Field(0.0, ge=0, le=1)
    """Share of the parked cars whose front wheels are left turned. Each body is one more asset for each angle."""
    dusty: float = Field(0.0, ge=0, le=1)
    """Share of the parked cars whose flanks are covered with dust; one more asset likewise."""
    lit: float = Field(0.0, ge=0, le=1)
    """Share of the parked cars whose head and tail lamps glow; one more asset likewise. Their glow is seen, and lights
    what is near them as far as a renderer takes glowing faces for lights."""
    misparked: float = Field(0.0, ge=0, le=0.5)
    """Share of the parked cars that stand far over a line, aslant or across two stalls, as far as there are free stalls
    beside cars: that stall is told as blocked."""

    @model_validator(mode="after")
    def _no_stall_both_ways(self) -> "ParkingConfig":
        both = sorted(set(self.occupied_stalls or ()) & set(self.empty_stalls))
        if both:
            raise ValueError(f"no stall that occupied_stalls and empty_stalls both name ({', '.join(both)})")
        return self
