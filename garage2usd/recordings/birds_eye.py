"""Bird's-eye views of a recording, with masks of free space and of the vehicle."""

from collections.abc import Collection, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.errors import ConfigError
from garage2usd.common.package import RAYS, require
from garage2usd.config.vehicles import DRIVEN_PAINT, CarBody
from garage2usd.objects.car import car_spec
from garage2usd.reading.labels import Labels
from garage2usd.recordings.way import Way
from garage2usd.render import Picture
from garage2usd.render.cameras import View
from garage2usd.render.free_views import birds_eye_view, looked_through
from garage2usd.render.pictures import classes_of, read_depth, read_ids, write_mask
from garage2usd.sensors.rays.around_view import AroundView
from garage2usd.sensors.rays.birds_eye import BirdsEye, free_space
from garage2usd.sensors.rays.ray_caster import ray_caster
from garage2usd.sensors.rays.sight import seen_points
from garage2usd.sensors.rig.poses import CAR_FROM_VEHICLE, VehiclePose
from garage2usd.sensors.rig.rig import Rig
from garage2usd.sensors.rig.sensors import Camera
from garage2usd.stage.driving_car import driven_asset

if TYPE_CHECKING:
    from garage2usd.sensors.rays.driven_surface import DrivenSurface

FREE_FOLDER = "free_space"
"""Folder of the free-space masks."""
_NAME = "birds_eye"


def check_birds_eye(rig: Rig, kinds: Collection[Picture]) -> None:
    """Check before rendering that bird's-eye views can be recorded.

    Raises
    ------
    ConfigError
        If the rig has no cameras, or a picture needed for free space is not rendered.
    """
    if not rig.cameras:
        raise ConfigError("birds_eye", rig.name, "bird's-eye views beside the pictures of a rig with cameras")
    if not {Picture.SEMANTIC, Picture.INSTANCE}.intersection(kinds):
        allowed = f"{Picture.SEMANTIC} or {Picture.INSTANCE} among them, from which free space is told"
        raise ConfigError("pictures", ",".join(kinds), allowed)


class BirdsEyeViews:
    """The bird's-eye views of a recording, one at each pose of the drive.

    Attributes
    ----------
    views, hidden, unseen
        The views, the ids of the objects hidden from each, and of the objects of other levels that each looks through.
    """

    def __init__(
        self, settings: BirdsEye, way: Way, labels: Labels, *, left_out: Sequence[int], ego_folder: str
    ) -> None:
        """Create the bird's-eye views at all poses; `left_out` has ids hidden from every view."""
        self._settings, self._way, self._labels = settings, way, labels
        self._ego_mask = f"{ego_folder}/{_NAME}.png"
        self.views = [self._view(number, pose) for number, pose in enumerate(way.poses)]
        self.hidden = [[*looked_through(labels, settings), *left_out]] * len(self.views)
        self.unseen = [way.unseen_from_above(pose, labels) for pose in way.poses]

    def write_masks(self, finished: Path, car: CarBody) -> Path:
        """Write the free-space masks of the bird's-eye views, and the mask of the vehicle.

        Returns
        -------
        Path
            The folder of the free-space masks.
        """
        (finished / FREE_FOLDER).mkdir(exist_ok=True)
        ground = self._settings.ground_mask(_outlines_m(car))
        write_mask(ground, finished / self._ego_mask)
        names = {number: entry.name for number, entry in self._labels.classes.items()}
        surface = self._driven_surface()
        for view, pose in zip(self.views, self._way.poses, strict=True):
            free = free_space(self._classes(view, finished), names)
            free[free] = surface.is_free(self._seen_m(view, finished)[free])
            if not self._settings.cars:
                free &= ~self._settings.ground_mask(self._cars_m(pose))
            write_mask(free, finished / FREE_FOLDER / f"{view.name}.png")
        return finished / FREE_FOLDER

    def _view(self, number: int, pose: VehiclePose) -> View:
        view = birds_eye_view(f"{_NAME}_{number:04d}", self._settings, pose.vehicle_to_world)
        facts = {
            "sensor": _NAME,
            "pose": number,
            **pose.facts,
            **self._way.level_facts(pose),
            "size_px": list(view.size_px),
            "ego_mask": self._ego_mask,
            "free_space": f"{FREE_FOLDER}/{view.name}.png",
            "hidden_objects": self._way.left_out,
        }
        return replace(view, facts={**view.facts, **facts})

    def _classes(self, view: View, finished: Path) -> NDArray[np.uint8]:
        """Read the class id of each pixel of a bird's-eye view."""
        instance = read_ids(finished / Picture.INSTANCE / f"{view.name}{Picture.INSTANCE.extension}")
        return classes_of(instance, self._labels.class_ids)

    def _seen_m(self, view: View, finished: Path) -> NDArray[np.float64]:
        """Compute the point of the stage that each pixel of a bird's-eye view shows."""
        depth_m = read_depth(finished / Picture.DEPTH / f"{view.name}{Picture.DEPTH.extension}")
        return seen_points(view.sensor_lens(), depth_m, np.linalg.inv(view.world_to_camera()))

    def _driven_surface(self) -> "DrivenSurface":
        """Return the drivable surface of the garage, without the hidden objects."""
        from garage2usd.sensors.rays.driven_surface import DrivenSurface  # noqa: PLC0415 - of an extra

        without = self._way.absent(self._labels)
        return DrivenSurface(self._way.stage, self._way.floors, self._labels, without=without)

    def _cars_m(self, pose: VehiclePose) -> list[NDArray[np.float64]]:
        """Return the footprints of nearby parked cars in the vehicle's frame."""
        to_vehicle = np.linalg.inv(pose.vehicle_to_world) @ self._way.to_stage
        corners = self._way.grounds_of_cars(pose)
        return [each @ to_vehicle[:2, :3].T + to_vehicle[:2, 3] for each in corners]


def _outlines_m(car: CarBody) -> list[NDArray[np.float64]]:
    """Return the outlines of a car and its mirrors in ISO 8855 axes, origin at the rear axle's middle."""
    outlines = [np.array(outline) - (0.0, car.rear_axle_m) for outline in car_spec(car, DRIVEN_PAINT).outlines()]
    return [np.insert(each, 1, 0.0, axis=1) @ CAR_FROM_VEHICLE[:3, :2] for each in outlines]


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
    turned: NDArray[np.float64] = points @ CAR_FROM_VEHICLE[:3, :3]  # for row vectors: to the vehicle's axes
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
