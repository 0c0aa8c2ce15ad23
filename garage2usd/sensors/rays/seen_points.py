"""Points visible in a picture, from its depth."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from garage2usd.sensors.rays.lenses import Lens, Pinhole

__all__ = ["seen_points"]


def seen_points(
    lens: Lens, depth_m: NDArray[np.floating[Any]], sensor_to_world: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Unproject a depth picture to the point seen at each pixel.

    Parameters
    ----------
    lens
        Lens of the picture.
    depth_m
        Depth along the axis for pinholes and bird's-eye views, along the ray for other lenses; not finite where nothing
        is hit; shape (rows, columns).
    sensor_to_world
        Transform from camera axes (OpenCV's) to the world, in metres; float64, shape (4, 4).

    Returns
    -------
    ndarray
        Points in the world, float64, shape (rows, columns, 3); not finite where nothing is hit.
    """
    middles = lens.middles()
    rays = lens.rays(middles)
    if isinstance(lens, Pinhole):
        rays /= rays[:, 2:]
    depth = np.where(np.isfinite(depth_m), depth_m, np.nan).reshape(-1, 1)
    points = lens.starts(middles) + rays * depth
    world: NDArray[np.float64] = points @ sensor_to_world[:3, :3].T + sensor_to_world[:3, 3]
    return world.reshape(*depth_m.shape, 3)
