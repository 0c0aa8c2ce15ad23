"""The scene of a recording: its views, and the stage with the vehicle in it."""

import hashlib
import json
from collections.abc import Collection, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from pxr import Ar, Usd, UsdUtils

from garage2usd.common.package import VERSION
from garage2usd.reading.files import open_stage
from garage2usd.reading.labels import Labels
from garage2usd.recordings.birds_eye import BirdsEyeViews
from garage2usd.recordings.way import Way
from garage2usd.render import Picture
from garage2usd.render.cameras import USD_FROM_OPENCV, View
from garage2usd.render.devices import ComputeDevice
from garage2usd.render.drawing import MOTION_NEEDS, Drawing
from garage2usd.render.tables import SlotLabels
from garage2usd.sensors.formats.recording import Recording, Shot
from garage2usd.sensors.rays.birds_eye import BirdsEye
from garage2usd.sensors.rig.around_view_camera import AroundViewCamera
from garage2usd.sensors.rig.poses import Matrix, VehiclePose
from garage2usd.sensors.rig.rig import Rig
from garage2usd.sensors.rig.sensors import Camera
from garage2usd.stage.ego_car import EGO_PATH, write_stage_with_car

EGO_FOLDER = "ego"
"""Folder of the ego masks of car-mounted cameras."""
POINTS_FOLDER = "points"
"""Folder of the point clouds, with a subfolder for each LiDAR."""


class Scene:
    """The views of a recording, and the objects hidden from them."""

    def __init__(self, stage: Usd.Stage, labels: Labels, way: Way, rig: Rig, birds_eye: BirdsEye | None = None) -> None:
        self._stage, self._way, self._rig = stage, way, rig
        self._ego_id = max(labels.ids.values(), default=0) + 1
        cars = [number for number, entry in labels.classes.items() if entry.name == rig.body.semantic_class]
        self.labels = replace(
            labels,
            ids={**labels.ids, EGO_PATH: self._ego_id},
            class_ids={**labels.class_ids, self._ego_id: cars[0] if cars else 0},
        )
        if way.agents is not None:
            self.labels = way.agents.labelled(self.labels, self._ego_id + 1)
        self._left_out = [labels.ids[name] for name in labels.with_plates(way.left_out) if name in labels.ids]
        self.shots = [(camera, number, pose) for number, pose in enumerate(way.poses) for camera in rig.cameras]
        views = [self._view(camera, number, pose) for camera, number, pose in self.shots]
        left_out = [*self._left_out, self._ego_id]
        self.birds_eye = (
            BirdsEyeViews(birds_eye, way, self.labels, left_out=left_out, ego_folder=EGO_FOLDER) if birds_eye else None
        )
        self.views = [*views, *(self.birds_eye.views if self.birds_eye else ())]

    def hidden(self) -> list[list[int]]:
        """Return for each view the ids of hidden objects: its own car, and the car parked in the target stall."""
        absent = [self._way.agents.hidden(pose) if self._way.agents else [] for pose in range(len(self._way.poses))]
        shots = [
            [*self._left_out, *([] if self._sees_vehicle(camera) else [self._ego_id]), *absent[pose]]
            for camera, pose, _ in self.shots
        ]
        above = zip(self.birds_eye.hidden, absent, strict=True) if self.birds_eye else ()
        return [*shots, *([*hidden, *others] for hidden, others in above)]

    def unseen(self) -> list[list[int]]:
        """Return for each view the ids of objects of other levels that it looks through."""
        if self.birds_eye is None:
            return []
        return [*([] for _ in self.shots), *self.birds_eye.unseen]

    def needed(self, kinds: Collection[Picture]) -> tuple[Picture, ...]:
        """Return the kinds of pictures to render, including those that colour is developed from."""
        blurs = Picture.COLOUR in kinds and any(view.shows_motion for view in self.views)
        return MOTION_NEEDS if blurs else ()

    @property
    def _is_lit(self) -> bool:
        """True if a vehicle is present and its lamps are on."""
        return self._way.has_vehicle and self._rig.lamps == "on"

    def _sees_vehicle(self, camera: Camera) -> bool:
        """Test if a camera may see the vehicle: it is mounted elsewhere, or the ego vehicle is set visible."""
        own = self._rig.ego_visible and not isinstance(camera, AroundViewCamera)
        return self._way.has_vehicle and (camera.mount != "vehicle" or own)

    def drawing(
        self,
        work: Path,
        finished: Path,
        kinds: Sequence[Picture],
        *,
        samples: int,
        seed: int,
        device: ComputeDevice,
    ) -> Drawing:
        """Create the render job of the recording's views, with the vehicle in the stage for other cameras."""
        with_car = work / "stage.usdc"
        with_car.unlink(missing_ok=True)
        agents = self._way.agents
        others = agents.models if agents else ()
        write_stage_with_car(with_car, self._stage, self._rig.body, is_lit=self._is_lit, others=others)
        of_agents = [agents.moved(pose, self._way.to_stage) if agents else {} for pose in range(len(self._way.poses))]

        def placed(number: int, pose: VehiclePose, *, has_ego: bool) -> dict[int, Matrix]:
            return of_agents[number] | ({self._ego_id: self._way.car_moved(pose)} if has_ego else {})

        moved = [
            placed(number, pose, has_ego=self._is_lit or self._sees_vehicle(camera))
            for camera, number, pose in self.shots
        ]
        if self.birds_eye:
            moved += [placed(number, pose, has_ego=self._is_lit) for number, pose in enumerate(self._way.poses)]
        return Drawing(
            open_stage(with_car),
            self.labels,
            self.views,
            self.hidden(),
            kinds,
            samples,
            seed,
            finished,
            frozenset({self._ego_id}),
            moved,
            device,
            unseen=self.unseen(),
        )

    def moves(self, number: int) -> dict[int, Matrix]:
        """Return the motion of each moving object from a pose to the next, by its id, in the stage's axes."""
        before, after = (self._way.poses[each] for each in (number, number + 1))
        moves = {}
        if self._way.has_vehicle:
            moves[self._ego_id] = after.vehicle_to_world @ np.linalg.inv(before.vehicle_to_world)
        agents, times_s = self._way.agents, np.array([before.time_s, after.time_s])
        if agents is not None:
            for instance, (owner, _) in agents.shown(number).items():
                first, last = agents.model_places(owner, times_s, self._way.to_stage)
                moves[instance] = last @ np.linalg.inv(first)
        return moves

    def slot_labels(self, finished: Path) -> SlotLabels:
        """Return the labels of parking slots: the target stall is free, and in traffic each that no car is in."""
        views = self.views
        numbers = [number for _, number, _ in self.shots] + list(range(len(self._way.poses) if self.birds_eye else 0))
        left, _ = self._way.stalls_taken(0)
        taken = {view.name: self._way.stalls_taken(number)[1] for view, number in zip(views, numbers, strict=True)}
        changing = taken if self._way.agents else {}
        return SlotLabels(self._stage, self.labels, views, finished, left, changing)

    def recording(self, path: Path, folder: Path, kinds: Sequence[Picture]) -> Recording:
        """Return the recording with the files of its pictures."""
        return Recording(
            self._rig.name,
            path,
            tuple(
                Shot(
                    view.name,
                    camera,
                    number,
                    pose.time_s,
                    self._way.mount_to_world(camera, pose),
                    {kind.value: folder / kind / f"{view.name}{kind.extension}" for kind in kinds},
                )
                for view, (camera, number, pose) in zip(self.views, self.shots, strict=False)
            ),
        )

    def _view(self, camera: Camera, number: int, pose: VehiclePose) -> View:
        lens = camera.lens
        sensor_to_world = self._way.mount_to_world(camera, pose) @ camera.sensor_to_vehicle
        placed = (
            {"sensor_to_vehicle": camera.sensor_to_vehicle.tolist(), "ego_mask": f"{EGO_FOLDER}/{camera.name}.png"}
            if camera.mount == "vehicle"
            else {"sensor_to_world": sensor_to_world.tolist()}
        )
        facts = {
            "sensor": camera.name,
            "mount": camera.mount,
            "pose": number,
            **pose.facts,
            "size_px": list(lens.size_px),
            "lens": lens.parameters(),
            **self._way.vehicle_facts(pose),
            **placed,
            "hidden_objects": self._way.left_out,
        }
        name = f"{camera.name}_{number:04d}"
        is_carried = camera.mount == "vehicle"
        twist = None
        if camera.effects is not None and camera.effects.shows_motion:
            of_mount = pose.twist if is_carried else pose.twist.reversed()
            twist = of_mount.of_part(np.linalg.inv(pose.vehicle_to_world) @ sensor_to_world)
        return View(
            name,
            camera.name,
            None,
            lens,
            lens.size_px,
            sensor_to_world @ USD_FROM_OPENCV,
            facts,
            camera.effects,
            twist,
            is_carried,
        )

    def key(self, path: Path, kinds: Sequence[Picture], *, samples: int, seed: int, device: ComputeDevice) -> str:
        """Compute a digest that differs between recordings of different frames."""
        document: dict[str, Any] = {
            "version": VERSION,
            "stage": _digest(self._stage, path),
            "views": [[view.name, view.lens_job(), view.camera_to_world.tolist(), view.facts] for view in self.views],
            "effects": [None if view.effects is None else view.effects.model_dump(mode="json") for view in self.views],
            "motion": [None if view.twist is None else view.twist.facts for view in self.views if view.shows_motion],
            "hidden": self.hidden(),
            "unseen": self.unseen(),
            "agents": self._way.agents.facts(self._way.to_stage) if self._way.agents else None,
            "car": [self._rig.car, self._rig.models.sha256 if self._rig.models else ""],
            "lamps": self._rig.lamps,
            "kinds": kinds,
            "samples": samples,
            "seed": seed,
            "device": device.kind,
        }
        return hashlib.sha256(json.dumps(document).encode()).hexdigest()


def _digest(stage: Usd.Stage, path: Path) -> str:
    """Compute a digest of all files of a stage and of its table of labels."""
    layers, assets, _ = UsdUtils.ComputeAllDependencies(stage.GetRootLayer().identifier)
    names = [*(layer.realPath for layer in layers), *assets, str(path.with_name(f"{path.stem}_labels.json"))]
    files = {Ar.SplitPackageRelativePathOuter(name)[0] for name in names}
    digest = hashlib.sha256()
    for file in sorted(map(Path, files), key=lambda file: file.name):
        if file.is_file():
            digest.update(hashlib.sha256(file.read_bytes()).digest())
    return digest.hexdigest()
