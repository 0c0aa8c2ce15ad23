"""Point clouds of LiDAR sweeps."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["PointCloud"]


@dataclass(frozen=True, eq=False)
class PointCloud:
    """The point cloud of a LiDAR sweep.

    Attributes
    ----------
    points_m
        Points in the sensor's axes: x forward, y left, z up; float32, shape (n, 3).
    intensity
        Returned light relative to a white diffuse surface at normal incidence, independent of range; float32, 0 to 1,
        shape (n,).
    instance
        Id of the object, as in the table of labels, 0 for none; uint32, shape (n,).
    class_id
        Id of its class, 0 for none; uint8, shape (n,).
    ring
        Index of the laser or row; uint16, shape (n,).
    beam
        Index of the ray within the sweep; uint32, shape (n,).
    """

    points_m: NDArray[np.float32]
    intensity: NDArray[np.float32]
    instance: NDArray[np.uint32]
    class_id: NDArray[np.uint8]
    ring: NDArray[np.uint16]
    beam: NDArray[np.uint32]

    def __len__(self) -> int:
        """Return the number of points."""
        return len(self.points_m)
