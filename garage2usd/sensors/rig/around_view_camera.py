"""The around view of a rig: its four cameras and the ground it covers."""

from collections.abc import Mapping
from typing import Annotated, Literal, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, PrivateAttr, field_validator

from garage2usd.common.errors import ConfigError
from garage2usd.common.settings import Settings
from garage2usd.config.vehicles import CarBody
from garage2usd.sensors.rays.around_view import SECTORS, AroundView, Eye
from garage2usd.sensors.rig.sensors import Camera, CameraEffects

_VIEW_FROM_SENSOR = np.array([[0.0, -1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
"""Rotation from the view's axes (right, down, into the ground) to a sensor's (forward, left, up); columns are the
view's."""
_LEAST_PX_M, _LARGEST_PX_M = 0.001, 1.0
_Metres = Annotated[float, Field(ge=-100.0, le=100.0)]


class ServingCameras(Settings):
    """Names of the cameras of the around view's front, rear, left and right sector."""

    front: str = "front"
    rear: str = "rear"
    left: str = "left"
    right: str = "right"


class AroundViewCamera(Camera):
    """A virtual camera that shows the ground through four cameras of the rig, forwards at the top.

    Its pose is that of the picture's middle on the ground, without rotation.
    """

    kind: Literal["around_view"]
    """`"around_view"`."""
    position_m: tuple[_Metres, _Metres, Annotated[float, Field(ge=0.0, le=0.0)]] = (1.4, 0.0, 0.0)
    """x and y of the picture's middle; z is 0, on the ground."""
    metres_per_px: float = Field(0.02, ge=_LEAST_PX_M, le=_LARGEST_PX_M)
    """Width and height of a pixel on the ground."""
    cameras: ServingCameras = ServingCameras()
    """Names of the cameras that the view is composed of."""
    car_margin_m: float = Field(0.0, ge=0.0, le=2.0)
    """Margin in metres by which the black rectangle of the car is larger than the car on each side."""
    _served: tuple[tuple[Camera, ...], CarBody] | None = PrivateAttr(None)

    @field_validator("mount")
    @classmethod
    def _on_the_car(cls, mount: str) -> str:
        if mount != "vehicle":
            raise ValueError("vehicle, for an around view")
        return mount

    @field_validator("yaw_deg", "pitch_deg", "roll_deg")
    @classmethod
    def _unturned(cls, angle_deg: float) -> float:
        if angle_deg:
            raise ValueError("0, for an around view")
        return angle_deg

    @field_validator("effects")
    @classmethod
    def _without_effects_of_one_eye(cls, effects: CameraEffects | None) -> CameraEffects | None:
        for name in ("chromatic_error", "exposure_s", "readout_s"):
            if effects is not None and getattr(effects, name):
                raise ValueError(f"effects without {name}, for an around view")
        return effects

    def through(self, cameras: Mapping[str, Camera], car: CarBody) -> Self:
        """Bind the around view to the cameras of a rig, given by name, and to its car.

        Raises
        ------
        ValueError
            If a required camera is missing, is not mounted on a car above the ground, or is an around view itself.
        """
        served = self.model_copy()
        serving = tuple(self._checked(getattr(self.cameras, side), side, cameras) for side in SECTORS)
        served.__pydantic_private__ = {"_served": (serving, car)}
        return served

    @property
    def lens(self) -> AroundView:
        """The lens of the around view.

        Raises
        ------
        ValueError
            If the camera belongs to no rig.
        """
        if self._served is None:
            raise ValueError(f"{self.name} looks through cameras of a rig, and is in none")
        serving, car = self._served
        front, rear, left, right = (self._eye(camera) for camera in serving)
        return AroundView(
            size_px=self.size_px,
            centre_px=self._half(),
            metres_per_px=self.metres_per_px,
            car_m=self._ground_of(car),
            eyes=(front, rear, left, right),
        )

    def _ground_of(self, car: CarBody) -> tuple[float, float, float, float]:
        """Return the edges of the car's footprint in the picture's axes, see `AroundView.car_m`."""
        (ahead_m, left_m, _), margin_m = self.position_m, self.car_margin_m
        half_m, nose_m = car.width_m / 2 + margin_m, car.ahead_m + margin_m
        tail_m = car.length_m - car.ahead_m + margin_m
        return left_m - half_m, ahead_m - nose_m, left_m + half_m, ahead_m + tail_m

    def _checked(self, name: str, side: str, cameras: Mapping[str, Camera]) -> Camera:
        camera = cameras.get(name)
        if camera is None or isinstance(camera, AroundViewCamera) or camera.mount != "vehicle":
            on_vehicle = [
                each.name
                for each in cameras.values()
                if each.mount == "vehicle" and not isinstance(each, AroundViewCamera)
            ]
            allowed = f"cameras on the vehicle ({', '.join(on_vehicle) or 'the rig has none'})"
            raise ValueError(f"{allowed} for {self.name} to look through; its {side} is {name}")
        if camera.position_m[2] <= 0:
            raise ValueError(f"{name} over the ground, for {self.name} to look through")
        return camera

    def _eye(self, camera: Camera) -> Eye:
        return Eye(camera.name, camera.lens, np.linalg.inv(self.sensor_to_vehicle) @ camera.sensor_to_vehicle)

    def _resized(self, size_px: tuple[int, int]) -> dict[str, object]:
        metres_per_px = self.metres_per_px * self.size_px[0] / size_px[0]
        if not _LEAST_PX_M <= metres_per_px <= _LARGEST_PX_M:
            allowed = f"with which pixels of {self.name} are {_LEAST_PX_M} to {_LARGEST_PX_M} m wide"
            raise ConfigError("scale", size_px[0] / self.size_px[0], allowed)
        return {"metres_per_px": metres_per_px}

    def _axes(self) -> NDArray[np.float64]:
        return _VIEW_FROM_SENSOR
