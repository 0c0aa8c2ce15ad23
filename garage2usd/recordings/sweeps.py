"""LiDAR sweeps of a recording: point clouds at each pose of the drive."""

import shutil
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from pxr import Usd

from garage2usd.common.progress import Progress
from garage2usd.reading.files import open_stage
from garage2usd.reading.labels import Labels
from garage2usd.recordings.scene import POINTS_FOLDER
from garage2usd.recordings.way import Way
from garage2usd.sensors.formats.recording import Shot
from garage2usd.sensors.rays.lidar import MovedScene, joined, measure
from garage2usd.sensors.rays.point_cloud import CloudFormat, PointCloud, write_cloud
from garage2usd.sensors.rays.ray_scene import RayScene, read_ray_scene
from garage2usd.sensors.rig.poses import VehiclePose
from garage2usd.sensors.rig.rig import Rig
from garage2usd.sensors.rig.sensors import Lidar
from garage2usd.stage.ego_car import EGO_PATH, write_stage_with_car


class Sweeps:
    """The LiDAR sweeps of a recording: one for each LiDAR at each pose.

    Parameters
    ----------
    stage
        The recorded stage.
    labels
        Table of labels of the stage, including the ego vehicle at `garage2usd.stage.ego_car.EGO_PATH`.
    way
        Poses of the vehicle.
    rig
        The rig with its LiDARs and car.
    formats
        File formats of the point clouds.
    seed
        Seed of the noise.
    """

    def __init__(
        self, stage: Usd.Stage, labels: Labels, way: Way, rig: Rig, formats: Sequence[CloudFormat], seed: int
    ) -> None:
        self.stage, self.labels = stage, labels
        self._way, self._rig = way, rig
        self._formats, self._seed = formats, seed

    @property
    def described(self) -> str:
        """The recorded LiDAR sweeps in words."""
        places, lidars = len(self._way.poses), ", ".join(lidar.name for lidar in self._rig.lidars)
        count = places * len(self._rig.lidars)
        return f"{count} sweep{'s' if count > 1 else ''} of {lidars}: {', '.join(self._formats)}"

    @cached_property
    def solids(self) -> RayScene:
        """The solid surfaces of the garage, without the car parked in the target stall."""
        return read_ray_scene(self.stage, self.labels, without=self._way.absent(self.labels))

    def write(self, finished: Path, work: Path, progress: Progress) -> list[dict[str, Any]]:
        """Cast the rays of all LiDAR sweeps and write their point clouds.

        Parameters
        ----------
        finished
            Parent folder of `POINTS_FOLDER`, which is replaced if it exists.
        work
            Folder for temporary files.
        progress
            Receives each sweep.

        Returns
        -------
        list of dict
            Entry of ``frames.json`` for each sweep.
        """
        shutil.rmtree(finished / POINTS_FOLDER, ignore_errors=True)
        for each in self._rig.lidars:
            (finished / POINTS_FOLDER / each.name).mkdir(parents=True)
        sees_vehicle = self._way.has_vehicle and any(lidar.mount != "vehicle" for lidar in self._rig.lidars)
        watched = self._watched(work) if sees_vehicle else None
        sweeps = list(self._sweeps())
        facts = []
        for done, (lidar, number, pose) in enumerate(sweeps):
            progress("points", done, len(sweeps))
            scene: RayScene | MovedScene = self.solids
            if watched is not None and lidar.mount != "vehicle":
                scene = watched.at(self._way.car_moved(pose))
            place = self._way.mount_to_world(lidar, pose) @ lidar.sensor_to_vehicle
            cloud = measure(scene, lidar, place, seed=self._seed, sweep=number)
            for kind, path in self._files(lidar, number).items():
                write_cloud(cloud, finished / path, CloudFormat(kind))
            facts.append(self._facts(lidar, number, pose, cloud))
        progress("points", len(sweeps), len(sweeps))
        return facts

    def shots(self, folder: Path) -> list[Shot]:
        """Return the LiDAR shots in order of time, with their files below a folder."""
        return [
            Shot(
                _name(lidar, number),
                lidar,
                number,
                pose.time_s,
                self._way.mount_to_world(lidar, pose),
                {kind: folder / path for kind, path in self._files(lidar, number).items()},
            )
            for lidar, number, pose in self._sweeps()
        ]

    def _sweeps(self) -> Iterator[tuple[Lidar, int, VehiclePose]]:
        for number, pose in enumerate(self._way.poses):
            for lidar in self._rig.lidars:
                yield lidar, number, pose

    def _watched(self, work: Path) -> MovedScene:
        """Read the garage with the moving vehicle, which LiDARs mounted elsewhere see."""
        path = work / "stage_of_lidars.usdc"
        path.unlink(missing_ok=True)
        write_stage_with_car(path, self.stage, self._rig.body)
        return joined(self.solids, read_ray_scene(open_stage(path), self.labels, only=[EGO_PATH]))

    def _files(self, lidar: Lidar, number: int) -> Mapping[str, str]:
        name = _name(lidar, number)
        return {kind.value: f"{POINTS_FOLDER}/{lidar.name}/{name}.{kind}" for kind in self._formats}

    def _facts(self, lidar: Lidar, number: int, pose: VehiclePose, cloud: PointCloud) -> dict[str, Any]:
        to_world = self._way.mount_to_world(lidar, pose) @ lidar.sensor_to_vehicle
        is_carried = lidar.mount == "vehicle"
        own = {"sensor_to_vehicle": lidar.sensor_to_vehicle.tolist()} if is_carried else {}
        path_of = {entry: path for path, entry in self.labels.ids.items()}
        ids, counts = (each.tolist() for each in np.unique(cloud.instance, return_counts=True))
        return {
            "name": _name(lidar, number),
            "sensor": lidar.name,
            "mount": lidar.mount,
            "pose": number,
            **pose.facts,
            "files": dict(self._files(lidar, number)),
            **self._way.vehicle_facts(pose),
            **own,
            "sensor_to_world": to_world.tolist(),
            "hidden_objects": self._way.left_out,
            "points": len(cloud),
            "instances": [
                {
                    "id": entry,
                    "path": path_of[entry],
                    "class": self.labels.classes[self.labels.class_ids[entry]].name,
                    "points": count,
                }
                for entry, count in zip(ids, counts, strict=True)
                if entry
            ],
        }


def _name(lidar: Lidar, number: int) -> str:
    return f"{lidar.name}_{number:04d}"
