"""Poses of parts in an asset: wheels stand in poses, so that equal ones share their arrays."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.native import elementary

__all__ = ["Pose"]

_DIGITS = 12
"""Digits of sines, so that a quarter and half a turn are exact."""


class Pose(NamedTuple):
    """A pose in an asset: position in metres, and rotation about +Y in degrees."""

    x_m: float
    y_m: float
    z_m: float
    yaw_deg: float = 0.0

    @property
    def turn(self) -> NDArray[np.float64]:
        """Rotation for row vectors; float64, shape (3, 3). The nose of a car faces -Z."""
        angle = np.radians(self.yaw_deg)
        cos, sin = round(elementary.cos(float(angle)), _DIGITS), round(elementary.sin(float(angle)), _DIGITS)
        return np.array([(cos, 0.0, -sin), (0.0, 1.0, 0.0), (sin, 0.0, cos)])

    @property
    def single(self) -> "Pose":
        """The pose as a layer holds it, in single precision."""
        return Pose(*np.array(self, np.float32).tolist())

    def placed(self, points: NDArray[np.floating[Any]]) -> NDArray[np.float64]:
        """Move points of the pose's axes to those of the asset; shapes (n, 3)."""
        moved: NDArray[np.float64] = points.astype(np.float64) @ self.turn + self[:3]
        return moved

    def taken_back(self, points: NDArray[np.floating[Any]]) -> NDArray[np.float64]:
        """Move points of the asset's axes to those of the pose; shapes (n, 3)."""
        moved: NDArray[np.float64] = (points.astype(np.float64) - self[:3]) @ self.turn.T
        return moved
