"""Ego masks: the pixels of a vehicle-mounted camera that show the vehicle itself."""

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.extras import RAYS, require
from garage2usd.config.vehicles import CarBody
from garage2usd.sensors.rays.around_view import AroundView
from garage2usd.sensors.rays.ray_caster import ray_caster
from garage2usd.sensors.rig.camera import Camera
from garage2usd.sensors.rig.poses import CAR_FROM_VEHICLE
from garage2usd.stage.driving_car import driven_asset

__all__ = ["ego_mask", "ego_triangles_m"]


def ego_triangles_m(car: CarBody) -> NDArray[np.float64]:
    """Return the surface of the ego car as triangles in ISO 8855 axes, origin at the rear axle; shape (n, 3, 3)."""
    fans = []
    for part in driven_asset(car).parts:
        starts = np.cumsum(part.face_counts) - part.face_counts
        for step in range(1, int(part.face_counts.max(initial=0)) - 1):
            large = starts[part.face_counts >= step + 2]
            corners = [part.face_indices[large + corner] for corner in (0, step, step + 1)]
            fans.append(np.stack([part.points[corner] for corner in corners], axis=1))
    points = np.concatenate(fans).astype(np.float64) - (0.0, 0.0, car.rear_axle_m)
    turned: NDArray[np.float64] = points @ CAR_FROM_VEHICLE[:3, :3]  # rows, so that it leads to the vehicle's axes
    return turned


def ego_mask(camera: Camera, car: CarBody) -> NDArray[np.bool_]:
    """Compute the mask of camera pixels whose rays hit the car that carries the camera; shape (rows, columns).

    For an around view, pixels are masked if the car covers their ground.

    Raises
    ------
    MissingExtraError
        If the packages for ray casting are not installed.
    """
    lens, place = camera.lens, camera.sensor_to_vehicle
    if isinstance(lens, AroundView):
        return lens.over_car(lens.middles()).reshape(lens.size_px[::-1])
    require("the mask of a camera's own car", RAYS)
    triangles = ego_triangles_m(car)
    numbers = np.arange(3 * len(triangles)).reshape(-1, 3)
    caster = ray_caster(triangles.reshape(-1, 3), numbers)
    rays = lens.rays(lens.middles())
    seen = np.flatnonzero(np.isfinite(rays).all(axis=1))
    directions = rays[seen] @ place[:3, :3].T
    mask = np.zeros(len(rays), dtype=np.bool_)
    mask[seen] = caster.first(np.broadcast_to(place[:3, 3], directions.shape), directions) >= 0
    return mask.reshape(lens.size_px[::-1])
