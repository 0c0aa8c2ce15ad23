"""Where a sensor is mounted."""

from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from garage2usd.common.settings import Settings

__all__ = ["Sensor"]

_Metres = Annotated[float, Field(ge=-1e5, le=1e5)]
_Turn = Annotated[float, Field(ge=-360.0, le=360.0)]


class Sensor(Settings):
    """A sensor and where it is mounted."""

    name: str = Field(pattern=r"^[A-Za-z][A-Za-z0-9_-]{0,31}$")
    """By which its files are called; no other sensor of the rig has it."""
    mount: Literal["vehicle", "column", "world"] = "vehicle"
    """What it is mounted on, in whose frame its pose is: x forward, y to the left, z up. `"vehicle"` (ISO 8855): from
    the middle of the rear axle on the ground. `"column"`: from the foot of a column's axis; x leads level to the middle
    of the stall that is driven to. `"world"`: the stage's X is x, its -Z is y, its Y is z."""
    position_m: tuple[_Metres, _Metres, _Metres]
    """x, y and z of its origin."""
    yaw_deg: _Turn = 0.0
    """Turn to the left; at 0 it looks along x."""
    pitch_deg: _Turn = 0.0
    """After that, right-handed about its y to the left, as ISO 8855 has it: positive looks down."""
    roll_deg: _Turn = 0.0
    """After that, right-handed about the axis that it looks along: positive lowers its right side."""

    @property
    def sensor_to_vehicle(self) -> NDArray[np.float64]:
        """From the sensor's axes to those of its mount, in metres, for column vectors; float64, shape (4, 4).

        Cameras have OpenCV's axes (+X right, +Y down, +Z forward), LiDARs look along x with y left and z up.
        """
        from scipy.spatial.transform import Rotation  # noqa: PLC0415 - all who import this module would wait for it

        matrix = np.eye(4)
        angles_deg = [self.yaw_deg, self.pitch_deg, self.roll_deg]
        matrix[:3, :3] = Rotation.from_euler("ZYX", angles_deg, degrees=True).as_matrix() @ self._axes()
        matrix[:3, 3] = self.position_m
        return matrix

    def _axes(self) -> NDArray[np.float64]:
        """The sensor's own axes in ones that look forward, left and up."""
        return np.eye(3)
