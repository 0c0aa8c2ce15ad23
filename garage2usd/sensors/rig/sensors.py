"""Sensors of a rig and their mounts: pinhole and fisheye cameras with their effects, and LiDARs."""
# Over 300 lines: all settings of all sensors stand together, as a rig's file has them.

import math
from abc import abstractmethod
from typing import Annotated, Literal, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, ValidationInfo, field_validator, model_validator

from garage2usd.common.errors import ConfigError
from garage2usd.common.settings import Settings
from garage2usd.sensors.rays.lenses import KannalaBrandt, Lens, Pinhole, RadiusPolynomial, WoodScape

_Share = Annotated[float, Field(ge=0.0, le=1.0)]
_Ev = Annotated[float, Field(ge=-12.0, le=12.0)]
_Metres = Annotated[float, Field(ge=-1e5, le=1e5)]
_Turn = Annotated[float, Field(ge=-360.0, le=360.0)]
_CAMERA_FROM_SENSOR = np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])
"""Rotation from OpenCV's camera axes (right, down, forward) to forward, left and up; columns are the camera's."""
_LEAST_SIDE_PX, _GREATEST_SIDE_PX = 16, 8192
_Side = Annotated[int, Field(ge=_LEAST_SIDE_PX, le=_GREATEST_SIDE_PX)]
_Focal = Annotated[float, Field(gt=0.0, le=1e5)]
_MOST_SHOTS = 2**22


class CameraEffects(Settings):
    """Settings of a camera's exposure and of the errors of its lens and sensor; effects left out are absent.

    An around view applies them to each of its cameras, so that exposure and colour jump at the seams.
    """

    exposure: Literal["fixed", "automatic"] = "automatic"
    """`"automatic"`: the mean of the picture, clipped at white, becomes `grey`. `"fixed"`: light of 1 is white."""
    grey: float = Field(0.18, gt=0.0, lt=1.0)
    """Target mean of automatic exposure in linear light, where white is 1."""
    exposure_ev: _Ev = 0.0
    """Exposure compensation in stops; positive is brighter."""
    exposure_spread_ev: float = Field(0.0, ge=0.0, le=3.0)
    """Standard deviation of exposure between cameras, in stops."""
    most_gain_ev: float = Field(6.0, ge=0.0, le=12.0)
    """Maximum gain of automatic exposure, in stops."""
    full_well_electrons: float = Field(0.0, ge=0.0, le=1e7)
    """Electrons of a white pixel at a gain of 1, from which Poisson shot noise is drawn; larger gains need
    proportionally fewer. 0 for no shot noise."""
    read_noise_electrons: float = Field(0.0, ge=0.0, le=1e5)
    """Standard deviation of the sensor's read noise in electrons; needs `full_well_electrons`."""
    bits: int = Field(12, ge=8, le=16)
    """Bit depth of the sensor's values; applies if the sensor has noise."""
    white_balance_spread: float = Field(0.0, ge=0.0, le=0.5)
    """Standard deviation of the red and blue white-balance factors between cameras."""
    vignetting: _Share = 0.0
    """Share of the light lost at the edge of the field of view; grows as the square of the angle from the optical
    axis."""
    chromatic_error: float = Field(0.0, ge=-0.02, le=0.02)
    """Lateral chromatic aberration: share by which red is magnified relative to green, and blue reduced. Not for around
    views."""
    bloom: _Share = 0.0
    """Share of the light beyond white that spreads around its source."""
    bloom_width: float = Field(0.02, gt=0.0, le=0.5)
    """Standard deviation of bloom, as a share of the picture's width."""
    flare: _Share = 0.0
    """Share of the light beyond white that appears as a ghost, mirrored about the optical axis."""
    dirt: int = Field(0, ge=0, le=100)
    """Number of smudges on the lens."""
    headroom: float = Field(1.0, ge=1.0, le=64.0)
    """Dynamic range of the sensor as a multiple of white; light above half of white is compressed into the rest. 1
    clips at white."""
    tone: Literal["srgb", "linear"] = "srgb"
    """Transfer curve from linear light to pixel values."""
    exposure_s: float = Field(0.0, ge=0.0, le=0.2)
    """Exposure time of each row in seconds, which gives motion blur; 0 for no blur. Brightness is set by `exposure`.
    Not for around views."""
    readout_s: float = Field(0.0, ge=0.0, le=0.2)
    """Delay in seconds between the first and the last row of a rolling shutter; 0 for a global shutter. Not for around
    views."""
    jpeg_quality: int | None = Field(None, ge=1, le=100)
    """JPEG quality by which the picture is compressed, then decoded and written; no compression if left out."""

    @property
    def shows_motion(self) -> bool:
        """True if pictures depend on the camera's motion."""
        return bool(self.exposure_s or self.readout_s)


class Sensor(Settings):
    """A sensor of a rig with its mount and pose."""

    name: str = Field(pattern=r"^[A-Za-z][A-Za-z0-9_-]{0,31}$")
    """Unique name within the rig, by which the sensor's files are named."""
    mount: Literal["vehicle", "column", "world"] = "vehicle"
    """Mount of the sensor, in whose frame its pose is given: x forward, y to the left, z up. `"vehicle"` (ISO 8855):
    origin at the middle of the rear axle on the ground. `"column"`: origin at the foot of a column's axis, x horizontal
    towards the middle of the target stall. `"world"`: the stage's X is x, its -Z is y, its Y is z."""
    position_m: tuple[_Metres, _Metres, _Metres]
    """x, y and z of the sensor's origin."""
    yaw_deg: _Turn = 0.0
    """Yaw to the left; at 0 the sensor looks along x."""
    pitch_deg: _Turn = 0.0
    """Pitch, applied after the yaw, right-handed about y (to the left) as in ISO 8855: positive looks down."""
    roll_deg: _Turn = 0.0
    """Roll, applied after the pitch, right-handed about the viewing axis: positive lowers the right side."""

    @property
    def sensor_to_vehicle(self) -> NDArray[np.float64]:
        """Transform from the sensor's axes to those of its mount, in metres, for column vectors; float64, shape (4, 4).

        Cameras have OpenCV's axes (+X right, +Y down, +Z forward). LiDARs look along x, with y to the left and z up.
        """
        from scipy.spatial.transform import Rotation  # noqa: PLC0415 - slow to import, and not always needed

        matrix = np.eye(4)
        angles_deg = [self.yaw_deg, self.pitch_deg, self.roll_deg]
        matrix[:3, :3] = Rotation.from_euler("ZYX", angles_deg, degrees=True).as_matrix() @ self._axes()
        matrix[:3, 3] = self.position_m
        return matrix

    def _axes(self) -> NDArray[np.float64]:
        """Return the rotation from the sensor's own axes to forward, left and up."""
        return np.eye(3)


class Camera(Sensor):
    """A camera of a rig."""

    size_px: tuple[_Side, _Side]
    """Width and height of the camera's pictures."""
    recorded: bool = True
    """True if the camera's pictures are recorded; otherwise the camera only serves an around view."""
    effects: CameraEffects | None = None
    """Imperfections of the camera's pictures; a perfect camera if left out."""

    @property
    @abstractmethod
    def lens(self) -> Lens:
        """The lens of the camera."""

    def scaled(self, scale: float) -> Self:
        """Scale the camera's pictures, with sides rounded to whole pixels.

        Raises
        ------
        ConfigError
            If the pictures would be too small or too large.
        """
        width, height = (round(side * scale) for side in self.size_px)
        if not (min(width, height) >= _LEAST_SIDE_PX and max(width, height) <= _GREATEST_SIDE_PX):
            allowed = f"a scale with which the pictures of {self.name} have sides of {_LEAST_SIDE_PX} to"
            raise ConfigError("scale", scale, f"{allowed} {_GREATEST_SIDE_PX} pixels")
        return self.model_copy(update={"size_px": (width, height), **self._resized((width, height))})

    @abstractmethod
    def _resized(self, size_px: tuple[int, int]) -> dict[str, object]:
        """Return the settings of the lens that change with the size of the picture."""

    def _axes(self) -> NDArray[np.float64]:
        return _CAMERA_FROM_SENSOR

    def _half(self) -> tuple[float, float]:
        return self.size_px[0] / 2, self.size_px[1] / 2


class PinholeCamera(Camera):
    """A pinhole camera, without distortion."""

    kind: Literal["pinhole"]
    """`"pinhole"`."""
    focal_px: tuple[_Focal, _Focal]
    """Focal lengths fx and fy."""
    centre_px: tuple[float, float] | None = None
    """Principal point, where the optical axis meets the picture, from its left and upper edge (OpenCV's cx and cy plus
    0.5); the middle of the picture if left out."""

    @property
    def lens(self) -> Pinhole:
        """The pinhole lens of the camera."""
        return Pinhole(size_px=self.size_px, centre_px=self.centre_px or self._half(), focal_px=self.focal_px)

    def _resized(self, size_px: tuple[int, int]) -> dict[str, object]:
        lens = self.lens.resized(size_px)
        return {"focal_px": lens.focal_px, "centre_px": lens.centre_px}


class KannalaBrandtCamera(Camera):
    """A fisheye camera of the model of Kannala and Brandt, as in OpenCV and ROS ("equidistant")."""

    kind: Literal["kannala_brandt"]
    """`"kannala_brandt"`."""
    focal_px: tuple[_Focal, _Focal]
    """Focal lengths fx and fy."""
    coefficients: tuple[float, float, float, float]
    """k1 to k4 of r = theta (1 + k1 theta^2 + k2 theta^4 + k3 theta^6 + k4 theta^8)."""
    centre_px: tuple[float, float] | None = None
    """Principal point, where the optical axis meets the picture, from its left and upper edge (OpenCV's cx and cy plus
    0.5); the middle of the picture if left out."""
    field_of_view_deg: float = Field(gt=0.0, le=360.0)
    """Full field of view; r must increase up to half of it."""

    @field_validator("field_of_view_deg")
    @classmethod
    def _grows(cls, field_of_view_deg: float, settings: ValidationInfo) -> float:
        if "coefficients" in settings.data:
            k1, k2, k3, k4 = settings.data["coefficients"]
            _check_grows(field_of_view_deg, (0.0, 1.0, 0.0, k1, 0.0, k2, 0.0, k3, 0.0, k4))
        return field_of_view_deg

    @property
    def lens(self) -> KannalaBrandt:
        """The Kannala-Brandt lens of the camera."""
        return KannalaBrandt(
            size_px=self.size_px,
            centre_px=self.centre_px or self._half(),
            focal_px=self.focal_px,
            coefficients=self.coefficients,
            max_angle_rad=math.radians(self.field_of_view_deg / 2),
        )

    def _resized(self, size_px: tuple[int, int]) -> dict[str, object]:
        lens = self.lens.resized(size_px)
        return {"focal_px": lens.focal_px, "centre_px": lens.centre_px}


class WoodScapeCamera(Camera):
    """A fisheye camera of WoodScape's polynomial model."""

    kind: Literal["woodscape"]
    """`"woodscape"`."""
    coefficients_px: tuple[float, float, float, float]
    """k1 to k4 of r = k1 theta + k2 theta^2 + k3 theta^3 + k4 theta^4."""
    centre_offset_px: tuple[float, float] = (0.0, 0.0)
    """Offset of the principal point from the middle of the picture: WoodScape's cx_offset and cy_offset."""
    aspect_ratio: float = Field(1.0, gt=0.1, lt=10.0)
    """Factor by which rows are stretched."""
    field_of_view_deg: float = Field(gt=0.0, le=360.0)
    """Full field of view; r must increase up to half of it."""

    @field_validator("field_of_view_deg")
    @classmethod
    def _grows(cls, field_of_view_deg: float, settings: ValidationInfo) -> float:
        if "coefficients_px" in settings.data:
            _check_grows(field_of_view_deg, (0.0, *settings.data["coefficients_px"]))
        return field_of_view_deg

    @property
    def lens(self) -> WoodScape:
        """The WoodScape lens of the camera."""
        (half_width, half_height), (right, down) = self._half(), self.centre_offset_px
        return WoodScape(
            size_px=self.size_px,
            centre_px=(half_width + right, half_height + down),
            coefficients_px=self.coefficients_px,
            aspect_ratio=self.aspect_ratio,
            max_angle_rad=math.radians(self.field_of_view_deg / 2),
        )

    def _resized(self, size_px: tuple[int, int]) -> dict[str, object]:
        lens = self.lens.resized(size_px)
        offset = lens.centre_px[0] - size_px[0] / 2, lens.centre_px[1] - size_px[1] / 2
        return {
            "coefficients_px": lens.coefficients_px,
            "centre_offset_px": offset,
            "aspect_ratio": lens.aspect_ratio,
        }


def _check_grows(field_of_view_deg: float, coefficients: tuple[float, ...]) -> None:
    most_deg = 2 * math.degrees(RadiusPolynomial(coefficients).grows_up_to_rad)
    if field_of_view_deg > most_deg:
        raise ValueError(f"at most {most_deg:.2f} degrees, up to which the radius of these coefficients grows")


class Lidar(Sensor):
    """A LiDAR of a rig."""

    range_m: tuple[float, float]
    """Range of the nearest and of the farthest return."""
    range_noise_m: float = Field(0.0, ge=0.0, le=1.0)
    """Standard deviation of a return's range."""
    rate_hz: float = Field(10.0, gt=0.0, le=1000.0)
    """Sweeps per second."""

    motion_compensated: bool = True
    """In traffic: True if points are in the axes of the sensor at the time of the sweep, so that only what moves is
    distorted; False for each point in the axes of its own ray."""

    @field_validator("range_m")
    @classmethod
    def _nearest_first(cls, range_m: tuple[float, float]) -> tuple[float, float]:
        if not 0 <= range_m[0] < range_m[1]:
            raise ValueError("a nearest distance of at least 0 and a farther one")
        return range_m


class SpinningLidar(Lidar):
    """A spinning LiDAR, which turns about its z axis."""

    kind: Literal["spinning_lidar"]
    """`"spinning_lidar"`."""
    elevations_deg: tuple[Annotated[float, Field(ge=-90.0, le=90.0)], ...] = Field((), max_length=1024)
    """Elevation of each beam over the horizon; alternatively `channels` with `lowest_deg` and `highest_deg`."""
    channels: int | None = Field(None, ge=1, le=1024)
    """Number of beams, from the lowest to the highest with equal steps."""
    lowest_deg: float | None = Field(None, ge=-90.0, le=90.0)
    """Elevation of the lowest of the `channels`."""
    highest_deg: float | None = Field(None, ge=-90.0, le=90.0)
    """Elevation of the highest of the `channels`."""
    azimuth_steps: int = Field(ge=1, le=65536)
    """Shots of each beam per revolution."""

    @model_validator(mode="after")
    def _either(self) -> Self:
        fan = self.channels, self.lowest_deg, self.highest_deg
        is_listed, is_fan = bool(self.elevations_deg), None not in fan
        if is_listed == is_fan or (is_listed and fan != (None, None, None)):
            raise ValueError("elevations_deg alone, or channels with lowest_deg and highest_deg")
        if self.lowest_deg is not None and self.highest_deg is not None and self.lowest_deg > self.highest_deg:
            raise ValueError("a lowest_deg that is not over highest_deg")
        _check_shots(self.azimuth_steps * len(self.beams_deg))
        return self

    @property
    def beams_deg(self) -> tuple[float, ...]:
        """Elevation of each beam over the horizon."""
        if self.channels is None or self.lowest_deg is None or self.highest_deg is None:
            return self.elevations_deg
        return tuple(np.linspace(self.lowest_deg, self.highest_deg, self.channels).tolist())


class SolidStateLidar(Lidar):
    """A solid-state LiDAR, which looks forward only."""

    kind: Literal["solid_state_lidar"]
    """`"solid_state_lidar"`."""
    horizontal_deg: float = Field(gt=0.0, le=180.0)
    """Horizontal field of view."""
    vertical_deg: float = Field(gt=0.0, le=180.0)
    """Vertical field of view."""
    columns: int = Field(ge=1, le=8192)
    """Shots across."""
    rows: int = Field(ge=1, le=8192)
    """Shots from top to bottom; one scan has `columns` times `rows`."""
    pattern: Literal["raster", "rosette"] = "raster"
    """`"raster"`: line by line; `"rosette"`: the shots form a rosette through the middle."""

    @model_validator(mode="after")
    def _not_too_many(self) -> Self:
        _check_shots(self.columns * self.rows)
        return self


def _check_shots(shots: int) -> None:
    if shots > _MOST_SHOTS:
        raise ValueError(f"at most {_MOST_SHOTS} shots in a scan; this one has {shots}")
