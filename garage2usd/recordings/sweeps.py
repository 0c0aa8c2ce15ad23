"""LiDAR sweeps of a recording: point clouds at each pose of the drive."""

import shutil
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from pxr import Usd

from garage2usd.as_built import BuiltGarage
from garage2usd.common.progress import Progress
from garage2usd.driving.tracks import AgentClass, AgentState, Floats
from garage2usd.reading.files import open_stage
from garage2usd.reading.labels import Labels
from garage2usd.recordings.scene import POINTS_FOLDER
from garage2usd.recordings.way import Way
from garage2usd.sensors.formats.nuscenes_boxes import ATTRIBUTES, ObjectBox, spread_points
from garage2usd.sensors.formats.recording import Shot
from garage2usd.sensors.formats.ros_scene import MarkedAgent
from garage2usd.sensors.rays.lidar import measure, ray_times_s
from garage2usd.sensors.rays.moved_scene import MovedScene, joined
from garage2usd.sensors.rays.point_cloud import CloudFormat, PointCloud, write_cloud
from garage2usd.sensors.rays.ray_scene import RayScene, read_ray_scene
from garage2usd.sensors.rig.poses import VehiclePose
from garage2usd.sensors.rig.rig import Rig
from garage2usd.sensors.rig.sensors import Lidar
from garage2usd.stage.ego_car import AGENTS_PATH, EGO_PATH, write_stage_with_car


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
        self._moved: _Moving | None = None

    @property
    def described(self) -> str:
        """The recorded LiDAR sweeps in words."""
        places, lidars = len(self._way.poses), ", ".join(lidar.name for lidar in self._rig.lidars)
        count = places * len(self._rig.lidars)
        return f"{count} sweep{'s' if count > 1 else ''} of {lidars}: {', '.join(self._formats)}"

    @property
    def garage(self) -> BuiltGarage:
        """The garage."""
        return self._way.garage

    @property
    def left_out(self) -> list[str]:
        """Paths of the parked cars that are not there, or move."""
        return self._way.left_out

    def marked_agents(self) -> list[list[MarkedAgent]]:
        """Return the agents of the traffic at each pose; nothing without traffic."""
        return [] if self._way.agents is None else self._way.agents.marked(self._way.to_stage)

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
        moving = self._moving(work)
        sweeps = list(self._sweeps())
        facts = []
        for done, (lidar, number, pose) in enumerate(sweeps):
            progress("points", done, len(sweeps))
            cloud = self._measured(moving, lidar, number, pose)
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

    def _measured(self, moving: "_Moving | None", lidar: Lidar, number: int, pose: VehiclePose) -> PointCloud:
        """Measure a sweep; in traffic each ray at its own time."""
        place = self._way.mount_to_world(lidar, pose) @ lidar.sensor_to_vehicle
        if moving is None or (self._way.agents is None and lidar.mount == "vehicle"):
            return measure(self.solids, lidar, place, seed=self._seed, sweep=number)
        if self._way.agents is None:
            return measure(moving.scene.at(self._way.car_moved(pose)), lidar, place, seed=self._seed, sweep=number)
        times_s = pose.time_s + ray_times_s(lidar)
        scene = moving.at(number, times_s, sees_vehicle=lidar.mount != "vehicle")
        places = self._way.mount_places(lidar, times_s) @ lidar.sensor_to_vehicle
        given_in = place if lidar.motion_compensated else None
        cloud = measure(scene, lidar, places, seed=self._seed, sweep=number, given_in=given_in)
        return replace(cloud, time_s=(times_s[cloud.beam] - pose.time_s).astype(np.float32))

    def _moving(self, work: Path) -> "_Moving | None":
        """Read the moving vehicle, which LiDARs mounted elsewhere see, and the agents of the traffic."""
        sees_vehicle = self._way.has_vehicle and any(lidar.mount != "vehicle" for lidar in self._rig.lidars)
        if self._moved is not None or (self._way.agents is None and not sees_vehicle):
            return self._moved
        path = work / "stage_of_lidars.usdc"
        path.unlink(missing_ok=True)
        models = self._way.agents.models if self._way.agents else []
        write_stage_with_car(path, self.stage, self._rig.body, others=models)
        # poses of a person keep their own ids until they are apart
        every = read_ray_scene(open_stage(path), replace(self.labels, parts={}), only=[EGO_PATH, AGENTS_PATH])
        ids = [self.labels.ids[EGO_PATH], *(self.labels.ids[model.path] for model in models)]
        things = [every.of_objects([number]) for number in ids]
        whole = (replace(thing, instance=self.labels.instances_of(thing.instance)) for thing in things)
        self._moved = _Moving(self._way, joined(self.solids, *whole), ids)
        return self._moved

    def traffic_at(self, work: Path) -> Callable[[int], tuple[MovedScene, list[ObjectBox]]] | None:
        """Return the surfaces and the boxes of agents at a pose by its number; None without traffic."""
        moving = self._moving(work) if self._way.agents is not None else None
        if moving is None:
            return None

        def found(number: int) -> tuple[MovedScene, list[ObjectBox]]:
            return moving.at(number, np.array([self._way.poses[number].time_s])), moving.boxes(number, self.labels)

        return found

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


class _Moving:
    """The surfaces of the garage with those that move: the ego car and the models of agents, with their ids."""

    def __init__(self, way: Way, scene: MovedScene, ids: Sequence[int]) -> None:
        self._way, self.scene = way, scene
        self._ids = ids
        self._thing_of = dict(zip(ids, scene.things, strict=True))

    def at(self, number: int, times_s: Floats, *, sees_vehicle: bool = False) -> MovedScene:
        """Return the surfaces at the times of the rays of a sweep at a pose, or at one time."""
        agents, to_stage = self._way.agents, self._way.to_stage
        if agents is None:
            raise TypeError("a sweep without traffic")
        placed = {
            model: agents.model_places(owner, times_s, to_stage) for owner, model in agents.shown(number).values()
        }
        vehicle = self._way.vehicle_moved(times_s) if sees_vehicle else None
        return self.scene.at(vehicle, *(placed.get(each) for each in self._ids[1:]))

    def boxes(self, number: int, labels: Labels) -> list[ObjectBox]:
        """Return the boxes of the agents that are there at a pose, of the sizes that the tracks have."""
        agents, to_stage = self._way.agents, self._way.to_stage
        if agents is None:
            raise TypeError("boxes without traffic")
        time_s, found = self._way.poses[number].time_s, []
        for instance, (owner, model) in agents.shown(number).items():
            track, thing = agents.track(owner), self._thing_of[model]
            place = to_stage @ agents.places(owner, np.array([time_s]))[0]
            moved = agents.model_places(owner, np.array([time_s]), to_stage)[0]
            size_m = np.array([track.agent.length_m, track.agent.width_m, track.agent.height_m])
            points = spread_points(thing.vertices_m[thing.triangles], instance)
            state = AgentState(track.sampled(np.array([time_s])).state[0])
            found.append(
                ObjectBox(
                    instance,
                    labels.class_ids[instance],
                    place[:3, 3] + place[:3, 1] * size_m[2] / 2,
                    np.stack([-place[:3, 2], -place[:3, 0], place[:3, 1]], axis=1),
                    size_m,
                    points @ moved[:3, :3].T + moved[:3, 3],
                    0.0,
                    ATTRIBUTES[state] if track.agent.kind is not AgentClass.TROLLEY else "",
                    to_stage[:3, :3] @ agents.velocity_m_s(owner, time_s),
                )
            )
        return found
