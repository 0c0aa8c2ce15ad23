"""Sensor rigs: the cameras and LiDARs of a car or a column and their mounts, read from TOML into frozen models."""

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import Field, ValidationInfo, field_validator

from garage2usd.common.documents import read_toml, shipped_toml
from garage2usd.common.errors import ConfigError
from garage2usd.common.settings import Settings, validated
from garage2usd.config.files import absolute_in
from garage2usd.config.own_cars import ModelFolder, OwnCar, cars_by_name, folder_of, read_own_cars
from garage2usd.config.vehicles import CarBody
from garage2usd.sensors.rig.around_view_camera import AroundViewCamera
from garage2usd.sensors.rig.sensors import (
    Camera,
    KannalaBrandtCamera,
    PinholeCamera,
    Sensor,
    SolidStateLidar,
    SpinningLidar,
    WoodScapeCamera,
)

RIG_NAMES = ("avp_around_view", "avp_surround", "column_camera", "lidar_32", "woodscape_like")
"""Names of the shipped rigs."""

_AnySensor = Annotated[
    PinholeCamera | KannalaBrandtCamera | WoodScapeCamera | AroundViewCamera | SpinningLidar | SolidStateLidar,
    Field(discriminator="kind"),
]


class Rig(Settings):
    """A rig: sensors that record together."""

    name: str = Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9._-]{0,63}$")
    """Short name of the rig."""
    title: str = Field("", max_length=500)
    """Title of the rig, for example the product it is modelled on."""
    models: ModelFolder | None = None
    """Own car models in USD or GLB, a folder or files, which `car` may name (see the guide of own cars)."""
    car: str = "hatchback"
    """The ego car, which masks show: a body of garage2usd's catalogue, such as `"saloon"`, `"suv"` or `"van"`, or a
    model in `models` by its file name without the extension. The trajectory is that of the design car."""
    ego_visible: bool = False
    """True if cameras on the car see its body in the masked pixels; around views never do."""
    lamps: Literal["off", "on"] = "off"
    """State of the ego car's head and tail lamps, which light the ground before and behind the car along a drive."""
    sensors: Annotated[tuple[_AnySensor, ...], Field(min_length=1, max_length=64)]
    """The sensors of the rig."""

    @field_validator("models", mode="before")
    @classmethod
    def _folder(cls, models: object) -> object:
        return folder_of(models)

    @field_validator("models")
    @classmethod
    def _read(cls, models: ModelFolder | None) -> ModelFolder | None:
        """Return the folder of car models with a digest of its contents; reject a folder of another digest."""
        return read_own_cars(models)[0] if models else None

    @field_validator("car")
    @classmethod
    def _known_car(cls, car: str, settings: ValidationInfo) -> str:
        names = cars_by_name(settings.data.get("models"))
        if car not in names:
            raise ValueError(f"one of {', '.join(names)}")
        return car

    @field_validator("sensors")
    @classmethod
    def _own_names(cls, sensors: tuple[Sensor, ...]) -> tuple[Sensor, ...]:
        names = [sensor.name.casefold() for sensor in sensors]  # file systems may ignore case
        for sensor in sensors:
            if names.count(sensor.name.casefold()) > 1:
                raise ValueError(f"sensors of different names; {names.count(sensor.name.casefold())} are {sensor.name}")
        return sensors

    @field_validator("sensors")
    @classmethod
    def _through_its_cameras(cls, sensors: tuple[Sensor, ...], settings: ValidationInfo) -> tuple[Sensor, ...]:
        if not {"models", "car"} <= settings.data.keys():
            return sensors
        if not any(not isinstance(sensor, Camera) or sensor.recorded for sensor in sensors):
            raise ValueError("one that is recorded at least")
        return _looking_through(sensors, cars_by_name(settings.data["models"])[settings.data["car"]])

    @property
    def body(self) -> CarBody:
        """The body of the ego car."""
        return cars_by_name(self.models)[self.car]

    @property
    def remarks(self) -> tuple[str, ...]:
        """Lines on the parts and properties of the user's car model that are ignored or changed, one for each kind."""
        body = self.body
        return body.remarks if isinstance(body, OwnCar) else ()

    @property
    def cameras(self) -> tuple[Camera, ...]:
        """The cameras whose pictures are recorded."""
        return tuple(sensor for sensor in self.sensors if isinstance(sensor, Camera) and sensor.recorded)

    @property
    def recorded(self) -> tuple[Sensor, ...]:
        """The recorded sensors, without cameras that only serve an around view."""
        return tuple(sensor for sensor in self.sensors if not isinstance(sensor, Camera) or sensor.recorded)

    def scaled(self, scale: float) -> Self:
        """Scale the pictures of the rig's cameras.

        Raises
        ------
        ConfigError
            If pictures would be too small or too large.
        """
        sensors = tuple(
            sensor.scaled(scale) if isinstance(sensor, Camera) and sensor.recorded else sensor
            for sensor in self.sensors
        )
        return self.model_copy(update={"sensors": _looking_through(sensors, self.body)})

    def without_cameras(self) -> Self:
        """Return the rig with its LiDARs only, of which it must have at least one."""
        return self.model_copy(update={"sensors": self.lidars})

    @property
    def lidars(self) -> tuple[SpinningLidar | SolidStateLidar, ...]:
        """The LiDARs of the rig."""
        return tuple(sensor for sensor in self.sensors if isinstance(sensor, SpinningLidar | SolidStateLidar))


def _looking_through(sensors: tuple[Sensor, ...], car: CarBody) -> tuple[Sensor, ...]:
    """Bind the around views among sensors to the cameras they are composed of."""
    cameras = {sensor.name: sensor for sensor in sensors if isinstance(sensor, Camera)}
    return tuple(sensor.through(cameras, car) if isinstance(sensor, AroundViewCamera) else sensor for sensor in sensors)


def read_rig(name_or_path: str | Path) -> Rig:
    """Read a sensor rig: a shipped one by its name, or a user's from a TOML file.

    Parameters
    ----------
    name_or_path
        One of `RIG_NAMES`, or the path of a ``.toml`` file.

    Raises
    ------
    ConfigError
        If the rig is unknown, or the file is unreadable or invalid.
    """
    name = str(name_or_path)
    if name in RIG_NAMES:
        return _shipped(name)
    if not name.lower().endswith(".toml"):
        raise ConfigError("rig", name, f"one of {', '.join(RIG_NAMES)}, or a path that ends in .toml")
    settings = read_toml(Path(name), field="rig")
    if "models" in settings:
        settings = {**settings, "models": absolute_in(Path(name).parent, settings["models"])}
    return rig_from_mapping(settings)


def rig_from_mapping(settings: Mapping[str, Any]) -> Rig:
    """Validate a sensor rig given as nested mappings, as TOML reads them.

    Raises
    ------
    ConfigError
        If a setting is invalid; the message names the setting, its value and the allowed values.
    """
    return validated(Rig, settings, within="rig")


@cache
def _shipped(name: str) -> Rig:
    return rig_from_mapping(shipped_toml("garage2usd.sensors", f"rigs/{name}"))
