"""The global frame of nuScenes, and its map mask of the drivable ground."""

import math
from collections.abc import Collection

import numpy as np
from numpy.typing import NDArray
from pxr import Usd, UsdGeom

from garage2usd.reading.labels import Labels
from garage2usd.sensors.formats.nuscenes_classes import FLAT, STANDING
from garage2usd.sensors.formats.nuscenes_locations import Location
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

    def mask(self, scene: RayScene, location: Location, labels: Labels) -> NDArray[np.uint8]:
        """Rasterize the nuScenes map mask: 255 on ground without fixed objects, parked cars ignored.

        Parameters
        ----------
        scene
            The stage's surfaces; meshes of fixed objects are closed.
        location
            The location to show.
        labels
            Table of labels of the stage.

        Returns
        -------
        numpy.ndarray
            Mask; uint8, rows from the north.

        Notes
        -----
        The walls of a level end its ramps where others go on, a storey below or above: their feet on the map of the
        level at the head, and their heads on that of the level at the foot.
        """
        columns, rows = (math.ceil(side / _MAP_CELL_M) for side in self.size_m.tolist())
        across, down = np.meshgrid(np.arange(columns), np.arange(rows))
        x_m, y_m = (across.ravel() + 0.5) * _MAP_CELL_M, (rows - down.ravel() - 0.5) * _MAP_CELL_M
        # what stands on the ground lies in the same plane as it, so that only the ground is looked at, from below
        lowest_m = self.lowest_m - 1
        below = self.to_stage(np.stack([x_m, y_m, np.full_like(x_m, lowest_m)], axis=1))
        ahead, up = (self.matrix[:3, :3].T @ way for way in ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]))
        standing = [number for number, each in labels.classes.items() if each.name in STANDING]
        mask = np.zeros(rows * columns, dtype=np.uint8)
        for ground in location.objects(labels, FLAT):
            lifts_m = scene.of_objects(ground).cast(below, np.broadcast_to(up, below.shape)).range_m
            found = np.flatnonzero(np.isfinite(lifts_m))
            eyes = below[found] + (lifts_m[found] + _KNEE_M)[:, None] * up
            mask[found[~_is_within(scene, standing, eyes, ahead)]] = 255
        if location.floor_m is not None:
            found = np.flatnonzero(mask)
            eyes = below[found] + (location.floor_m - lowest_m + _KNEE_M) * up
            own = scene.of_objects(location.objects(labels, STANDING)[0])
            mask[found[_is_within(own, standing, eyes, up)]] = 0
        return mask.reshape(rows, columns)


def _is_within(
    scene: RayScene, class_ids: Collection[int], places_m: NDArray[np.float64], way: NDArray[np.float64]
) -> NDArray[np.bool_]:
    """Test if places of shape (n, 3) lie within solids of some classes, by what is met on a way from there."""
    hits = scene.cast(places_m, np.broadcast_to(way, places_m.shape))
    first, second, third = (scene.vertices_m[scene.triangles[hits.triangle, corner]] for corner in range(3))
    # a ray that meets a solid from within began in it
    is_within: NDArray[np.bool_] = (np.cross(second - first, third - first) @ way > 0) & (hits.triangle >= 0)
    return is_within & np.isin(scene.class_id[hits.triangle], list(class_ids))
