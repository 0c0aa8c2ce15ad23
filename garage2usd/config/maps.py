"""Settings of maps and scenarios; none of them decides what the garage is."""

from enum import StrEnum

from pydantic import Field, ValidationInfo, field_validator

from garage2usd.common.settings import Settings

__all__ = ["DriveConfig", "GridConfig", "Leg", "MapsConfig", "ParkingAreas", "ScenarioConfig", "SumoConfig"]


class Leg(StrEnum):
    """Which part of a visit is driven."""

    BOTH = "both"
    IN = "in"
    OUT = "out"


class ParkingAreas(StrEnum):
    """Which stalls are one parking area of SUMO."""

    BAY = "bay"
    """Those before one lane node: vehicles stop close to their space."""
    ROW = "row"
    """All along a lane from one junction to the next."""
    STALL = "stall"
    """Each by itself, so that a vehicle can be sent to a certain stall."""


class GridConfig(Settings):
    """The occupancy grid of robots."""

    resolution_m: float = Field(0.05, ge=0.01, le=1.0)
    """Side of a cell."""
    low_m: float = Field(0.1, ge=0.0, le=2.0)
    """What ends lower is driven over."""
    high_m: float = Field(1.8, gt=0.0, le=10.0)
    """What begins higher is driven under."""
    keepout: bool = False
    """Whether a mask for nav2's keep-out filter is written beside it: of hatched ground, where robots are not to go."""
    speed: bool = False
    """Whether a mask for nav2's speed filter is written beside it: slower on ramps and around speed bumps."""

    @field_validator("high_m")
    @classmethod
    def _over_low(cls, high_m: float, settings: ValidationInfo) -> float:
        if high_m <= settings.data.get("low_m", 0.0):
            raise ValueError("more than maps.grid.low_m")
        return high_m


class DriveConfig(Settings):
    """How the car drives whose trajectory scenarios play."""

    lane_speed_m_s: float = Field(2.5, gt=0.0, le=15.0)
    """Most on aisles and ramps."""
    parking_speed_m_s: float = Field(0.8, gt=0.0, le=5.0)
    """Most on the way between aisle and stall."""
    acceleration_m_s2: float = Field(1.0, gt=0.0, le=8.0)
    """Most along the path, speeding up or braking."""
    lateral_acceleration_m_s2: float = Field(1.5, gt=0.0, le=8.0)
    """Most across the path."""
    steering_rate_rad_s: float = Field(0.6, gt=0.0, le=5.0)
    """Most of the front wheels' angle (that of a single wheel between them)."""
    shift_s: float = Field(1.0, ge=0.0, le=10.0)
    """Standstill in which the gear is changed."""
    parked_s: float = Field(5.0, ge=0.0, le=3600.0)
    """Standstill in the stall, where a scenario parks and leaves."""


class ScenarioConfig(Settings):
    """What the car of an OpenSCENARIO scenario drives."""

    stall: str | None = None
    """Its name, or the number painted in it; without one the first stall in the stage's order that is free and that a
    drive is found for, or where there is none the first that a drive is found for, whose parked car is left out."""
    entrance: int | None = Field(None, ge=1)
    """From 1 on in reading order; without one that of the shortest way."""
    exit: int | None = Field(None, ge=1)
    """From 1 on in reading order; without one that of the shortest way."""
    leg: Leg = Leg.BOTH
    """Whether the car comes (``"in"``), leaves (``"out"``), or comes, parks and leaves (``"both"``)."""


class SumoConfig(Settings):
    """The parking areas of SUMO."""

    areas: ParkingAreas = ParkingAreas.BAY
    """Which stalls are one parking area: of a bay (``"bay"``), of a row (``"row"``), or each stall (``"stall"``)."""
    badges: bool = True
    """Whether only vehicles with the badge of its use (attribute ``parkingBadges``) may park in a stall that is
    accessible, for EVs or for motorcycles."""


class MapsConfig(Settings):
    """Maps, scenarios and grids that are made of the stage."""

    latitude_deg: float = Field(49.0, ge=-80.0, le=84.0)
    """Of the stage's origin on the WGS 84 ellipsoid, where UTM reaches; north is the stage's -Z."""
    longitude_deg: float = Field(9.0, ge=-180.0, lt=180.0)
    """Of the stage's origin."""
    speed_limit_km_h: float = Field(10.0, gt=0.0, le=50.0)
    """Said of all lanes and ramps."""
    grid: GridConfig = GridConfig()
    """The occupancy grid of robots."""
    drive: DriveConfig = DriveConfig()
    """How the car of scenarios drives."""
    scenario: ScenarioConfig = ScenarioConfig()
    """What it drives."""
    sumo: SumoConfig = SumoConfig()
    """The parking areas of SUMO."""
