"""Settings of what is written: the files of the stage, and maps and scenarios; the garage stays the same."""

from enum import StrEnum
from pathlib import PurePosixPath

from pydantic import Field, ValidationInfo, field_validator

from garage2usd.common.settings import Settings

_NESTED_FROM_SQUARES = 2000


class TextureQuality(StrEnum):
    """Resolution of the textures."""

    LOW = "low"
    """A quarter of the full width and height, 0.15 MB in all."""
    MEDIUM = "medium"
    """Half of the full width and height, 0.5 MB in all."""
    HIGH = "high"
    """The full width and height, 2 MB in all."""


class StageForm(StrEnum):
    """Composition of the stage."""

    AUTO = "auto"
    """Nested from 2000 squares on, else instanced."""
    INSTANCED = "instanced"
    """References to one asset for each shape, instanced."""
    NESTED = "nested"
    """Equal squares share a prototype too, which keeps large garages light; their objects cannot be overridden."""
    FLAT = "flat"
    """Everything in one layer without references, variants or instances, for readers without composition."""


class UpAxis(StrEnum):
    """Axis of a stage that points up."""

    Y = "Y"
    """As in most programs that draw."""
    Z = "Z"
    """As in robotics and Isaac Sim: the garage is turned as a whole, so that its X stays and its -Z becomes Y."""


class AssetPlace(StrEnum):
    """Location of a stage's assets, which are the same in every garage."""

    OWN = "own"
    """In a folder beside the stage that belongs to it, or inside a ``.usdz``."""
    SHARED = "shared"
    """In a folder shared by many stages."""


class StageConfig(Settings):
    """Files of the stage."""

    texture_quality: TextureQuality = TextureQuality.MEDIUM
    """Resolution of the textures: 'low', 'medium' or 'high'."""
    form: StageForm = StageForm.AUTO
    """'instanced', 'nested' for large garages, 'auto' to choose one of these by size, or 'flat' for readers without
    composition, which repeats the meshes for each object."""
    up_axis: UpAxis = UpAxis.Y
    """Axis that points up, 'Y' or 'Z'. Labels, plans and reports have the garage's own axes, of which Y points up."""
    arrangements: int = Field(16, ge=1, le=100_000)
    """In the nested form, number of different arrangements of cars and other movable objects that the squares share."""
    assets: AssetPlace = AssetPlace.OWN
    """'own', or 'shared' for a folder of assets and textures that the ``.usda`` and ``.usdc`` files of many garages
    refer to."""
    asset_folder: str = Field("../assets", min_length=1, max_length=200, pattern=r"^[^@:\\\x00-\x1f\x7f]+$")
    """Folder of shared assets: a path with forward slashes, relative to the stage's folder."""

    @field_validator("assets")
    @classmethod
    def _composed(cls, assets: AssetPlace, settings: ValidationInfo) -> AssetPlace:
        if assets is AssetPlace.SHARED and settings.data.get("form") is StageForm.FLAT:
            raise ValueError("'own' where stage.form is 'flat', which refers to no assets")
        return assets

    @field_validator("asset_folder")
    @classmethod
    def _relative(cls, folder: str) -> str:
        path = PurePosixPath(folder)
        if path.is_absolute():
            raise ValueError("a path relative to the folder of the stage")
        return str(path)

    def is_nested(self, squares: int) -> bool:
        """True if equal squares share a prototype in a garage of `squares` squares."""
        return self.form is StageForm.NESTED or (self.form is StageForm.AUTO and squares >= _NESTED_FROM_SQUARES)


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
    """True if only vehicles with the badge of its use (attribute ``parkingBadges``) may park in a stall that is
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
