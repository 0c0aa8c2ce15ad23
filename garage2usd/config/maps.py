"""Settings of maps and scenarios; none of them changes the garage."""

from enum import StrEnum

from pydantic import Field, ValidationInfo, field_validator

from garage2usd.common.settings import Settings

__all__ = ["DriveConfig", "GridConfig", "Leg", "MapsConfig", "ParkingAreas", "ScenarioConfig", "SumoConfig"]


class Leg(StrEnum):
    """Part of a visit that is driven: arrival, departure or both."""

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
    """The occupancy grid for robots."""

    resolution_m: float = Field(0.05, ge=0.01, le=1.0)
    """Side of a cell."""
    low_m: float = Field(0.1, ge=0.0, le=2.0)
    """Objects that end below this height above the floor are driven over."""
    high_m: float = Field(1.8, gt=0.0, le=10.0)
    """Objects that begin above this height above the floor are driven under."""
    keepout: bool = False
    """Write a mask for nav2's keep-out filter beside the grid, which covers hatched areas."""
    speed: bool = False
    """Write a mask for nav2's speed filter beside the grid: slower on ramps and around speed bumps."""

    @field_validator("high_m")
    @classmethod
    def _over_low(cls, high_m: float, settings: ValidationInfo) -> float:
        if high_m <= settings.data.get("low_m", 0.0):
            raise ValueError("more than maps.grid.low_m")
        return high_m


class DriveConfig(Settings):
    """Limits of speed, acceleration and steering of the car that scenarios play."""

    lane_speed_m_s: float = Field(2.5, gt=0.0, le=15.0)
    """Highest speed on aisles and ramps."""
    parking_speed_m_s: float = Field(0.8, gt=0.0, le=5.0)
    """Highest speed between aisle and stall."""
    acceleration_m_s2: float = Field(1.0, gt=0.0, le=8.0)
    """Largest acceleration along the path, speeding up or braking."""
    lateral_acceleration_m_s2: float = Field(1.5, gt=0.0, le=8.0)
    """Largest acceleration across the path."""
    steering_rate_rad_s: float = Field(0.6, gt=0.0, le=5.0)
    """Highest steering rate of the equivalent single front wheel (bicycle model)."""
    shift_s: float = Field(1.0, ge=0.0, le=10.0)
    """Standstill while the gear is changed."""
    parked_s: float = Field(5.0, ge=0.0, le=3600.0)
    """Standstill in the stall, if a scenario parks and leaves."""


class ScenarioConfig(Settings):
    """Stall, portals and part of a visit that an OpenSCENARIO scenario drives."""

    stall: str | None = None
    """Id of the stall, or the number painted in it, which in a garage of several levels begins with its level,
    ``U2/A1-08``. If left out, the first free stall in the stage's order to which a drive is found, of several levels on
    the lowest; if there is none, the first stall to which a drive is found, without its parked car."""
    entrance: int | None = Field(None, ge=1)
    """Number of the entrance, from 1 in reading order; if left out, that of the shortest path."""
    exit: int | None = Field(None, ge=1)
    """Number of the exit, from 1 in reading order; if left out, that of the shortest path."""
    leg: Leg = Leg.BOTH
    """The car arrives (``"in"``), leaves (``"out"``), or arrives, parks and leaves (``"both"``)."""


class SumoConfig(Settings):
    """The parking areas of SUMO."""

    areas: ParkingAreas = ParkingAreas.BAY
    """Which stalls are one parking area: of a bay (``"bay"``), of a row (``"row"``), or each stall (``"stall"``)."""
    badges: bool = True
    """Whether only vehicles with the badge of its use (attribute ``parkingBadges``) may park in a stall that is
    accessible, for EVs or for motorcycles."""


class MapsConfig(Settings):
    """Maps, scenarios and grids that are exported from the stage."""

    latitude_deg: float = Field(49.0, ge=-80.0, le=84.0)
    """Latitude of the stage's origin on the WGS 84 ellipsoid, within UTM's range; north is the stage's -Z."""
    longitude_deg: float = Field(9.0, ge=-180.0, lt=180.0)
    """Longitude of the stage's origin."""
    speed_limit_km_h: float = Field(10.0, gt=0.0, le=50.0)
    """Speed limit on all lanes and ramps."""
    grid: GridConfig = GridConfig()
    """The occupancy grid of robots."""
    drive: DriveConfig = DriveConfig()
    """Driving limits of the car in scenarios."""
    scenario: ScenarioConfig = ScenarioConfig()
    """The drive of an OpenSCENARIO scenario."""
    sumo: SumoConfig = SumoConfig()
    """The parking areas of SUMO."""
