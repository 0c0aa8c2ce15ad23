"""LiDARs of a rig: spinning and solid-state."""

from typing import Annotated, Literal, Self

import numpy as np
from pydantic import Field, field_validator, model_validator

from garage2usd.sensors.rig.mount import Sensor

__all__ = ["Lidar", "SolidStateLidar", "SpinningLidar"]


_MOST_SHOTS = 2**22


class Lidar(Sensor):
    """A LiDAR of a rig."""

    range_m: tuple[float, float]
    """Range of the nearest and of the farthest return."""
    range_noise_m: float = Field(0.0, ge=0.0, le=1.0)
    """Standard deviation of a return's range."""
    rate_hz: float = Field(10.0, gt=0.0, le=1000.0)
    """Sweeps per second."""

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
        beams: tuple[float, ...] = tuple(np.linspace(self.lowest_deg, self.highest_deg, self.channels).tolist())
        return beams


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
