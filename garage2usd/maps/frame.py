"""The common frame of all maps in metres: x east is the stage's X, y north its -Z, z up its Y."""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray


def map_points(ground: ArrayLike) -> NDArray[np.float64]:
    """Convert ground points (x, z) of the stage to map points (x, y); float64, shape (..., 2)."""
    return np.asarray(ground, dtype=np.float64) * (1.0, -1.0)


def map_point(ground: tuple[float, float]) -> tuple[float, float]:
    """Convert a ground point (x, z) of the stage to a map point (x, y)."""
    x, y = map_points(ground).tolist()
    return x, y


def projection(latitude_deg: float, longitude_deg: float) -> str:
    """Return the transverse Mercator projection around the map's origin as a PROJ string, with true scale."""
    latitude, longitude = (repr(degrees + 0.0).removesuffix(".0") for degrees in (latitude_deg, longitude_deg))
    return f"+proj=tmerc +lat_0={latitude} +lon_0={longitude} +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m +no_defs"


def heading_rad(yaw_rad: float) -> float:
    """Convert a yaw about the stage's +Y (0 towards -Z) to a heading counter-clockwise from x, from -pi to pi."""
    return math.remainder(math.pi / 2 + yaw_rad, math.tau)
