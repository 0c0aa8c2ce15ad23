"""Sensor mounts: the frame and the pose of a sensor."""

from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from garage2usd.common.settings import Settings

__all__ = ["Sensor"]

_Metres = Annotated[float, Field(ge=-1e5, le=1e5)]
_Turn = Annotated[float, Field(ge=-360.0, le=360.0)]


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
        from scipy.spatial.transform import Rotation  # noqa: PLC0415 - all who import this module would wait for it

        matrix = np.eye(4)
        angles_deg = [self.yaw_deg, self.pitch_deg, self.roll_deg]
        matrix[:3, :3] = Rotation.from_euler("ZYX", angles_deg, degrees=True).as_matrix() @ self._axes()
        matrix[:3, 3] = self.position_m
        return matrix

    def _axes(self) -> NDArray[np.float64]:
        """Return the rotation from the sensor's own axes to forward, left and up."""
        return np.eye(3)
