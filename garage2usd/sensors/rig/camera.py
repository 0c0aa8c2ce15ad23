"""Cameras of a rig: pinhole, Kannala-Brandt and WoodScape fisheye."""

import math
from abc import abstractmethod
from typing import Annotated, Literal, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, ValidationInfo, field_validator

from garage2usd.common.errors import ConfigError
from garage2usd.sensors.rays.lenses import KannalaBrandt, Lens, Pinhole, WoodScape
from garage2usd.sensors.rays.radius_polynomial import RadiusPolynomial
from garage2usd.sensors.rig.camera_effects import CameraEffects
from garage2usd.sensors.rig.mount import Sensor

__all__ = ["Camera", "KannalaBrandtCamera", "PinholeCamera", "WoodScapeCamera"]

_CAMERA_FROM_SENSOR = np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])
"""Rotation from OpenCV's camera axes (right, down, forward) to forward, left and up; columns are the camera's."""
_LEAST_SIDE_PX, _GREATEST_SIDE_PX = 16, 8192
_Side = Annotated[int, Field(ge=_LEAST_SIDE_PX, le=_GREATEST_SIDE_PX)]
_Focal = Annotated[float, Field(gt=0.0, le=1e5)]


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
