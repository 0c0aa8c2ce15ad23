"""The points of a LiDAR's sweep."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["PointCloud"]


@dataclass(frozen=True, eq=False)
class PointCloud:
    """The points of a sweep.

    Attributes
    ----------
    points_m
        In the sensor's axes: x forward, y left, z up; float32, shape (n, 3).
    intensity
        Share of the light that comes back, over that from a white diffuse surface that is met squarely, whatever the
        range; float32, 0 to 1, shape (n,).
    instance
        Id of the object, as in the table of labels, 0 for none; uint32, shape (n,).
    class_id
        Id of its class, 0 for none; uint8, shape (n,).
    ring
        Number of the laser or row; uint16, shape (n,).
    beam
        Number of the ray within the sweep; uint32, shape (n,).
    """

    points_m: NDArray[np.float32]
    intensity: NDArray[np.float32]
    instance: NDArray[np.uint32]
    class_id: NDArray[np.uint8]
    ring: NDArray[np.uint16]
    beam: NDArray[np.uint32]

    def __len__(self) -> int:
        """How many points there are."""
        return len(self.points_m)
