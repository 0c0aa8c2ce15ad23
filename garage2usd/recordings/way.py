"""The way of a recording: poses of the vehicle along a drive or in traffic, and the target stall."""

from collections.abc import Mapping, Sequence
from functools import cached_property, partial
from itertools import pairwise
from pathlib import Path

import numpy as np
import shapely
from numpy.typing import NDArray
from pxr import Usd

from garage2usd.as_built.driven_road import DrivenFloor
from garage2usd.as_built.garage import BuiltGarage, garage_of_stage
from garage2usd.as_built.level import BuiltLevel
from garage2usd.common.errors import ConfigError
from garage2usd.config.outputs import DriveConfig, Leg
from garage2usd.driving.tracks import Floats, Track
from garage2usd.garage import Stall
from garage2usd.garage.levels import nearest_floor
from garage2usd.maps.drives import DrivePlanner
from garage2usd.reading.labels import Labels
from garage2usd.reading.levels import paths_from_above
from garage2usd.recordings.agents import Agents, ego_poses, vehicle_places
from garage2usd.recordings.columns import column_to_y_up
from garage2usd.recordings.own_drive import AVP, with_own_drive
from garage2usd.recordings.traffic import Traffic, pose_times
from garage2usd.render.cameras import find_views
from garage2usd.sensors.rig.poses import CAR_FROM_VEHICLE, MAP_TO_Y_UP, Twist, VehiclePose, poses_along, y_up_to_stage
from garage2usd.sensors.rig.sensors import Sensor
from garage2usd.stage.cameras import EYE_M, FRAMES_PER_SECOND
from garage2usd.stage.driving_car import CAR_NAME

Matrix = NDArray[np.float64]


class Way:
    """The poses of a vehicle along the drive of a recording, in steps of equal distance.

    Attributes
    ----------
    stage
        The stage.
    poses
        The poses.
    has_vehicle
        True if there is a vehicle; otherwise a single pose represents the stage.
    stall
        The stall that the vehicle parks in at the end, if any.
    about
        Description of the drive.
    to_stage
        Transform from metres with Y up to the stage's axes; shape (4, 4).
    agents
        The other agents of a recording in traffic; None without traffic.
    """

    stage: Usd.Stage
    poses: list[VehiclePose]
    has_vehicle: bool
    stall: Stall | None
    about: Mapping[str, object] | None
    to_stage: Matrix
    agents: Agents | None

    def __init__(
        self,
        stage: Usd.Stage,
        path: Path,
        along: str | None,
        every_m: float,
        settings: DriveConfig,
        traffic: Traffic | None = None,
    ) -> None:
        self.stage, self._source = stage, str(path)
        self.to_stage = y_up_to_stage(stage)
        self.stall, self.agents = None, None
        self._ego: Track | None = None
        if traffic is not None:
            self._take(traffic, along, settings)
            return
        self.has_vehicle = along is not None
        if along is None:
            self.poses, self.about = [VehiclePose(0.0, 0.0, self.to_stage @ MAP_TO_Y_UP)], None
            return
        self._along = along
        entrance, colon, stall = along.partition(":")
        if colon:
            self._drive_to(stall, entrance, along, every_m, settings)
        else:
            self._follow(along, every_m)

    @cached_property
    def garage(self) -> BuiltGarage:
        """The garage as read from the stage."""
        return garage_of_stage(self.stage, source=self._source)

    @cached_property
    def floors(self) -> tuple[DrivenFloor, ...]:
        """The floor of each level, with the ramps up from it, in metres with Y up."""
        return DrivenFloor.of_levels(
            [level.place for level in self.garage.levels], self.garage.lanes, self.garage.things
        )

    def level_at(self, pose: VehiclePose) -> BuiltLevel:
        """Return the level that a vehicle is on, which changes half way on a ramp."""
        levels = self.garage.levels
        height_m = float((np.linalg.inv(self.to_stage) @ pose.vehicle_to_world)[1, 3])
        return levels[nearest_floor([level.place.floor_m for level in levels], height_m)]

    def grounds_of_cars(self, pose: VehiclePose) -> list[NDArray[np.float64]]:
        """Return the corners of the other cars on the level of a vehicle, in metres with Y up; each shape (n, 3)."""
        level = self.level_at(pose)
        left_out = {*self.left_out}
        grounds = (
            ground for name, (ground, _) in level.cars.items() if level.place.path_in_whole(name) not in left_out
        )
        parked = [np.insert(shapely.get_coordinates(ground), 1, level.place.floor_m, axis=1) for ground in grounds]
        driven = self.agents.outlines_m(self.poses.index(pose), level.place.floor_m) if self.agents else []
        return [*parked, *driven]

    def unseen_from_above(self, pose: VehiclePose, labels: Labels) -> list[int]:
        """Return the ids of the objects of other levels, except the ramps that lead down from the vehicle's level."""
        own, levels = self.level_at(pose), self.garage.levels
        shown = paths_from_above([level.place for level in levels], levels.index(own))
        others = tuple(f"{level.place.path}/" for level in levels if level is not own)
        return [each for path, each in labels.ids.items() if path.startswith(others) and not path.startswith(shown)]

    def _take(self, traffic: Traffic, along: str | None, settings: DriveConfig) -> None:
        """Follow the ego through the traffic, or stand in it without an ego."""
        tracks, ego = traffic.tracks, traffic.ego
        foreign = [
            track.agent.prim for track in tracks if track.agent.prim and not self.stage.GetPrimAtPath(track.agent.prim)
        ]
        if foreign:
            raise ConfigError("tracks", foreign[0], "cars of this stage, as the tracks must be those of its garage")
        if ego == AVP:
            begins_s, _ = traffic.between_s or (0.0, 0.0)
            tracks = with_own_drive(tracks, self.garage, settings, along=along, begins_s=begins_s)
        self._ego, times_s = pose_times(tracks, ego, traffic.every_s, traffic.between_s)
        self.agents = Agents(tracks, times_s, ego)
        self.has_vehicle = self._ego is not None
        if self._ego is None:
            fixed = self.to_stage @ MAP_TO_Y_UP
            self.poses = [VehiclePose(time, 0.0, fixed) for time in times_s.tolist()]
        else:
            self.poses = ego_poses(self._ego, times_s, self.to_stage)
            self._along, names = ego, {stall.name: stall for stall in self.garage.stalls}
            self.stall = next((names[name] for _, _, name in self._ego.stall if name in names), None)
        self.about = {"ego": ego, "every_s": traffic.every_s, "tracks": tracks.source}

    @property
    def traffic_facts(self) -> dict[str, object]:
        """The entry of the traffic in the table of frames; nothing without traffic."""
        return {} if self.agents is None else {"traffic": self.agents.facts(self.to_stage)}

    def mount_places(self, sensor: Sensor, times_s: Floats) -> Matrix:
        """Return the transforms from a sensor's mount to the stage's axes at times of the traffic; shape (n, 4, 4)."""
        if sensor.mount == "vehicle" and self._ego is not None:
            placed: Matrix = self.to_stage @ vehicle_places(self._ego, times_s)
            return placed
        return np.broadcast_to(self.mount_to_world(sensor, self.poses[0]), (len(times_s), 4, 4))

    def vehicle_moved(self, times_s: Floats) -> Matrix | None:
        """Return the transforms of the ego car from the origin at times of the traffic; None without an ego."""
        if self._ego is None:
            return None
        moved: Matrix = self.to_stage @ vehicle_places(self._ego, times_s) @ self._from_rest
        return moved

    def stalls_taken(self, number: int) -> tuple[set[str], set[str]]:
        """Return the stalls that agents leave sooner or later, and those with an agent in them at a pose, by name."""
        if self.agents is None:
            return ({self.stall.name} if self.stall else set()), set()
        corners = {stall.name: np.array(stall.corners) for stall in self.garage.stalls}
        prims = {*self.agents.hidden_prims}
        left = {
            level.place.in_whole(home.name)
            for level in self.garage.levels
            for name, (_, home) in level.cars.items()
            if home is not None and level.place.path_in_whole(name) in prims
        }
        return left, self.agents.stalls_taken(number, corners)

    def _drive_to(self, stall: str, entrance: str, along: str, every_m: float, settings: DriveConfig) -> None:
        if not stall or not (entrance.isdecimal() or not entrance):
            raise ConfigError("along", along, "ENTRANCE:STALL as 1:A1-08, or the name of a camera that moves")
        planner = DrivePlanner(self.garage, settings)
        drive = planner.drive(stall, entrance=int(entrance) if entrance else None, leg=Leg.IN)
        self.stall = next(each for each in self.garage.stalls if each.name == drive.route.stall)
        self.poses = poses_along(drive.motion, every_m, to_stage=self.to_stage)
        self.about = {"along": along, "every_m": every_m, **drive.facts}

    def _follow(self, camera: str, every_m: float) -> None:
        """Follow a moving camera as a vehicle, with the rear axle on the floor below the camera."""
        first, last = self.stage.GetStartTimeCode(), self.stage.GetEndTimeCode()
        views = find_views(self.stage, cameras=[camera], frames=f"{first:g}:{max(first, last):g}x1")
        if views[0].frame is None:
            raise ConfigError("along", camera, "ENTRANCE:STALL as 1:A1-08, or the name of a camera that moves")
        to_y_up = np.linalg.inv(self.to_stage)
        eyes = [to_y_up @ view.camera_to_world for view in views]
        seconds = [((view.frame or 0.0) - first) / FRAMES_PER_SECOND for view in views]
        steps = [np.linalg.norm(there[:3, 3] - here[:3, 3]) for here, there in pairwise(eyes)]
        driven = np.concatenate([[0.0], np.cumsum(steps)])
        nearest = [int(np.abs(driven - target).argmin()) for target in np.arange(0.0, driven[-1] + every_m, every_m)]
        self.poses = [
            VehiclePose(
                seconds[number],
                float(driven[number]),
                self.to_stage @ _below(eyes[number]),
                partial(_twist, eyes, seconds, number),
            )
            for number in dict.fromkeys(nearest)
        ]
        self.about = {"along": camera, "every_m": every_m}

    def mount_to_world(self, sensor: Sensor, pose: VehiclePose) -> Matrix:
        """Return the transform from the frame of a sensor's mount to the stage's axes."""
        if sensor.mount == "vehicle":
            return pose.vehicle_to_world
        if sensor.mount == "column":
            return self._column
        fixed: Matrix = self.to_stage @ MAP_TO_Y_UP
        return fixed

    def vehicle_facts(self, pose: VehiclePose) -> dict[str, object]:
        """Return the vehicle's pose, with its level in a garage of several; nothing without a vehicle."""
        if not self.has_vehicle:
            return {}
        return {"vehicle_to_world": pose.vehicle_to_world.tolist(), **self.level_facts(pose)}

    def level_facts(self, pose: VehiclePose) -> dict[str, object]:
        """Return the name of the level that a vehicle is on; nothing in a garage of one level."""
        place = self.level_at(pose).place
        return {} if place.is_only else {"level": place.name}

    def car_moved(self, pose: VehiclePose) -> Matrix:
        """Return the ego car's transform from its place in `garage2usd.stage.ego_car` to a pose, in stage axes."""
        return pose.vehicle_to_world @ self._from_rest

    @cached_property
    def _from_rest(self) -> Matrix:
        """The transform from the stage's axes to a vehicle at the origin, rotated for Y up."""
        return np.linalg.inv(self.to_stage @ CAR_FROM_VEHICLE)

    @cached_property
    def _column(self) -> Matrix:
        if self.stall is None:
            raise ConfigError("along", self._along, "ENTRANCE:STALL, for sensors on a column, which watch it")
        level = self.garage.levels[self.stall.level]
        column = column_to_y_up(level, self.stall)
        column[1, 3] += level.place.floor_m
        return self.to_stage @ column

    @cached_property
    def left_out(self) -> list[str]:
        """Paths of the cars parked in the target stall, or of all parked cars that are agents of the traffic."""
        if self.agents is not None:
            return self.agents.hidden_prims
        if self.stall is None:
            return []
        level = self.garage.levels[self.stall.level]
        own = level.place.own_name(self.stall.name)
        return [
            level.place.path_in_whole(name)
            for name, (_, home) in level.cars.items()
            if home is not None and home.name == own
        ]

    def absent(self, labels: Labels) -> list[str]:
        """Return the paths of objects ignored by all sensors: the cars left out, and a car that drives in the stage."""
        roots = self.stage.GetPseudoRoot().GetChildren()
        driving = [str(root.GetPath().AppendChild(CAR_NAME)) for root in roots]
        return [*labels.with_plates(self.left_out), *driving]


def _twist(eyes: Sequence[Matrix], seconds: Sequence[float], number: int) -> Twist:
    """Compute a vehicle's twist in a frame from the previous and next frame, as far as they exist."""
    before, after = max(number - 1, 0), min(number + 1, len(eyes) - 1)
    if before == after:
        return Twist.at_rest()
    return Twist.between(_below(eyes[before]), _below(eyes[after]), seconds[after] - seconds[before])


def _below(eye: Matrix) -> Matrix:
    """Return the level pose in metres with Y up on the floor below a driver's eye that looks along -Z."""
    ahead = -eye[[0, 2], 2] / (np.hypot(*eye[[0, 2], 2]) or 1.0)
    matrix = np.eye(4)
    matrix[:3, 0] = ahead[0], 0.0, ahead[1]
    matrix[:3, 1] = ahead[1], 0.0, -ahead[0]
    matrix[:3, 2] = 0.0, 1.0, 0.0
    matrix[:3, 3] = eye[:3, 3] - (0.0, EYE_M, 0.0)
    return matrix
