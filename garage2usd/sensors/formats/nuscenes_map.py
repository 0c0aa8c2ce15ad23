"""The global frame of nuScenes, and its map mask of the drivable ground."""

import math
from collections.abc import Collection, Iterable

import numpy as np
from numpy.typing import NDArray
from pxr import Usd, UsdGeom

from garage2usd.sensors.rays.ray_scene import RayScene

__all__ = ["GlobalFrame"]

_MAP_CELL_M = 0.1
"""Cell size of map masks in nuscenes-devkit."""
_MAP_MARGIN_M = 5.0
_KNEE_M = 0.5
"""Height over the ground at which the map mask looks for fixed objects."""
_Z_UP = {
    UsdGeom.Tokens.y: np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]]),
    UsdGeom.Tokens.z: np.eye(3),
}


class GlobalFrame:
    """The transform from the stage to nuScenes' global frame."""

    def __init__(self, stage: Usd.Stage, scene: RayScene) -> None:
        turn = _Z_UP[UsdGeom.GetStageUpAxis(stage)]
        turned = scene.vertices_m @ turn.T
        low, high = turned.min(axis=0), turned.max(axis=0)
        self.matrix = np.eye(4)
        self.matrix[:3, :3] = turn
        self.matrix[:2, 3] = np.ceil(_MAP_MARGIN_M - low[:2])
        self.size_m = high[:2] + self.matrix[:2, 3] + _MAP_MARGIN_M
        self.lowest_m = low[2]

    def to_stage(self, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """Transform points from nuScenes' global frame to the stage's."""
        placed: NDArray[np.float64] = (points_m - self.matrix[:3, 3]) @ self.matrix[:3, :3]
        return placed

    def mask(self, scene: RayScene, grounds: Iterable[Collection[int]], standing: Collection[int]) -> NDArray[np.uint8]:
        """Rasterize the nuScenes map mask: 255 on ground without fixed objects, parked cars ignored.

        Parameters
        ----------
        scene
            The stage's surfaces.
        grounds
            Ids of the objects of the ground, in groups within which none lies above another.
        standing
            Class ids of fixed objects on the ground, whose meshes are closed.

        Returns
        -------
        numpy.ndarray
            Mask; uint8, rows from the north.
        """
        columns, rows = (math.ceil(side / _MAP_CELL_M) for side in self.size_m.tolist())
        across, down = np.meshgrid(np.arange(columns), np.arange(rows))
        x_m, y_m = (across.ravel() + 0.5) * _MAP_CELL_M, (rows - down.ravel() - 0.5) * _MAP_CELL_M
        # what stands on the ground lies in the same plane as it, so that only the ground is looked at, from below
        below = self.to_stage(np.stack([x_m, y_m, np.full_like(x_m, self.lowest_m - 1)], axis=1))
        up = self.matrix[:3, :3].T @ [0.0, 0.0, 1.0]
        ahead = self.matrix[:3, :3].T @ [1.0, 0.0, 0.0]
        mask = np.zeros(rows * columns, dtype=np.uint8)
        for ground in grounds:
            lifts_m = scene.of_objects(ground).cast(below, np.broadcast_to(up, below.shape)).range_m
            found = np.flatnonzero(np.isfinite(lifts_m))
            eyes = below[found] + (lifts_m[found] + _KNEE_M)[:, None] * up
            hits = scene.cast(eyes, np.broadcast_to(ahead, eyes.shape))
            first, second, third = (scene.vertices_m[scene.triangles[hits.triangle, corner]] for corner in range(3))
            # a ray that meets a solid from within began in it
            is_within = (np.cross(second - first, third - first) @ ahead > 0) & (hits.triangle >= 0)
            is_within &= np.isin(scene.class_id[hits.triangle], list(standing))
            mask[found[~is_within]] = 255
        return mask.reshape(rows, columns)
