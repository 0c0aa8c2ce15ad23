"""The drivable surface of a garage: the floor and the floors of ramps with enough headroom for a car."""

from collections.abc import Collection, Sequence

import numpy as np
from numpy.typing import NDArray
from pxr import Usd

from garage2usd.as_built.driven_ground import CAR_HEIGHT_M
from garage2usd.as_built.driven_road import DrivenFloor
from garage2usd.reading.labels import Labels
from garage2usd.sensors.rays.ray_scene import read_ray_scene
from garage2usd.sensors.rig.poses import y_up_to_stage

_STEP_M = 0.08
"""Height over the floor up to which a car drives over an obstacle: a speed bump, not a kerb."""
_ROUNDING_M = 0.01
"""Tolerance of the headroom over a ramp, where the slab comes down to the height of the car."""


class DrivenSurface:
    """The drivable surface of a garage.

    Parameters
    ----------
    stage
        The stage of the garage.
    floors
        Its floors, one for each level.
    labels
        Table of labels of the stage.
    without
        Paths of prims that are ignored, with all their descendants.
    """

    def __init__(
        self, stage: Usd.Stage, floors: Sequence[DrivenFloor], labels: Labels, *, without: Collection[str] = ()
    ) -> None:
        self._floors = tuple(floors)
        self._solids = read_ray_scene(stage, labels, without=without)
        self._to_stage = y_up_to_stage(stage)

    def is_free(self, points_m: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Test if a car can drive at each point: on the drivable surface, with free headroom above.

        Parameters
        ----------
        points_m
            Points in the stage's axes, in metres; shape (n, 3). Points that are not finite are not free.

        Returns
        -------
        ndarray
            bool, shape (n,).
        """
        places = points_m @ self._to_stage[:3, :3]  # the inverse rotation
        is_free = np.zeros(len(places), dtype=np.bool_)
        for floor in self._floors:
            is_free |= self._is_free_on(floor, places)
        return is_free

    def _is_free_on(self, floor: DrivenFloor, places: NDArray[np.float64]) -> NDArray[np.bool_]:
        floor_m = floor.heights_m(places[:, 0], places[:, 2])
        with np.errstate(invalid="ignore"):
            is_free: NDArray[np.bool_] = np.abs(places[:, 1] - floor_m) < _STEP_M
        begins = places[is_free]
        begins[:, 1] = floor_m[is_free] + _STEP_M
        up = np.broadcast_to(self._to_stage[:3, 1], begins.shape)
        range_m = self._solids.cast(begins @ self._to_stage[:3, :3].T, up).range_m
        is_free[is_free] = range_m >= CAR_HEIGHT_M - _STEP_M - _ROUNDING_M
        return is_free
