"""The frame of all maps: metres, x to the east is the stage's X, y to the north its -Z, z up its Y."""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["heading_rad", "map_points"]


def map_points(ground: ArrayLike) -> NDArray[np.float64]:
    """Points (x, z) of the stage's ground as (x, y) of the map; float64, shape (..., 2)."""
    points: NDArray[np.float64] = np.asarray(ground, dtype=np.float64) * (1.0, -1.0)
    return points


def heading_rad(yaw_rad: float) -> float:
    """A yaw about the stage's +Y, at 0 to -Z, as a heading counter-clockwise from x, from -pi to pi."""
    return math.remainder(math.pi / 2 + yaw_rad, math.tau)
