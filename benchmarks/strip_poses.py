"""Poses of a car from which strips of the ground beside it are drawn: before stalls, and along a drive."""

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import shapely
from numpy.typing import NDArray
from pxr import Usd
from strips import SIDES

from garage2usd.as_built.garage import garage_of_stage
from garage2usd.config.outputs import DriveConfig
from garage2usd.recordings.way import Way
from garage2usd.sensors.rig.around_view_camera import AroundViewCamera
from garage2usd.sensors.rig.rig import Rig
from garage2usd.sensors.slots import read_slots
from garage2usd.stage.cameras import DRIVE_NAME

__all__ = ["Pose", "StripPoses"]

_BEFORE_MOUTH_M = 1.5, 3.2
"""From the mouth of a stall to the middle of the car."""
_ALONG_M = 3.0
"""How far it is on or back along the aisle at most."""
_TURN_DEG, _TURNING_DEG = 10.0, 35.0
"""Standard deviations of the heading from that of the aisle: of most cars, and of those that turn in or out."""
_TURNING_SHARE = 0.15
_DRIVE_SHARE = 0.2
_DRIVE_STEP_M = 0.25
_DRIVE_TURN_DEG, _DRIVE_OFF_M = 3.0, 0.4
_ATTEMPTS = 60
"""For each pose, until it is free and a corner is in its picture."""

Matrix = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Pose:
    """Where a car is, and which side of it is drawn.

    Attributes
    ----------
    camera
        The around view of that side.
    vehicle_to_world
        From ISO 8855's axes to the stage's, in metres, for column vectors; float64, shape (4, 4).
    """

    camera: AroundViewCamera
    vehicle_to_world: Matrix

    @property
    def camera_to_world(self) -> Matrix:
        """From the view's axes (OpenCV's) to the stage's; float64, shape (4, 4)."""
        matrix: Matrix = self.vehicle_to_world @ self.camera.sensor_to_vehicle
        return matrix


class StripPoses:
    """Poses in a stage with Y up, whose cars touch nothing and see an entry corner."""

    def __init__(self, stage: Usd.Stage, path: Path, rig: Rig, random: np.random.Generator) -> None:
        self._random, self._body = random, rig.body
        self._cameras = {camera.name: camera for camera in rig.sensors if isinstance(camera, AroundViewCamera)}
        self._slots_m = np.stack([slot.corners_m for slot in read_slots(stage).slots])
        self._solids = garage_of_stage(stage, source=str(path)).levels[0].solids
        way = Way(stage, path, DRIVE_NAME, _DRIVE_STEP_M, DriveConfig())
        self._drive = [pose.vehicle_to_world for pose in way.poses]

    def drawn(self, count: int) -> list[Pose]:
        """So many poses, or fewer where no room is found for them."""
        found = (self._pose() for _ in range(count))
        return [pose for pose in found if pose is not None]

    def _pose(self) -> Pose | None:
        is_driven = self._random.random() < _DRIVE_SHARE
        for _ in range(_ATTEMPTS):
            pose = self._along_drive() if is_driven else self._before_a_stall()
            if self._is_free(pose) and self._shows_corner(pose):
                return pose
        return None

    def _before_a_stall(self) -> Pose:
        random = self._random
        corners_m = self._slots_m[random.integers(len(self._slots_m))]
        mouth_m, rear_m = corners_m[:2].mean(axis=0), corners_m[2:].mean(axis=0)
        outwards = (mouth_m - rear_m)[[0, 2]] / np.linalg.norm(mouth_m - rear_m)
        aisle = np.array([-outwards[1], outwards[0]])
        middle = mouth_m[[0, 2]] + outwards * random.uniform(*_BEFORE_MOUTH_M)
        middle += aisle * random.uniform(-_ALONG_M, _ALONG_M)
        side = SIDES[random.integers(2)]
        forward = -aisle if side == "left" else aisle  # who looks along (x, z) has (z, -x) to the left
        sd_deg = _TURNING_DEG if random.random() < _TURNING_SHARE else _TURN_DEG
        forward = _turned(forward, random.normal(0.0, sd_deg))
        return self._at(side, middle, forward, float(mouth_m[1]))

    def _along_drive(self) -> Pose:
        random = self._random
        way = self._drive[random.integers(len(self._drive))]
        forward = _turned(way[[0, 2], 0] / np.linalg.norm(way[[0, 2], 0]), random.normal(0.0, _DRIVE_TURN_DEG))
        off_m = random.normal(0.0, _DRIVE_OFF_M)
        middle = way[[0, 2], 3] + np.array([forward[1], -forward[0]]) * off_m
        return self._at(SIDES[random.integers(2)], middle, forward, float(way[1, 3]))

    def _at(self, side: str, middle: Matrix, forward: Matrix, floor_m: float) -> Pose:
        """A car whose middle is at (x, z) and that looks along (x, z)."""
        axle = middle - forward * (self._body.ahead_m - self._body.length_m / 2)
        matrix = np.eye(4)
        matrix[:3, 0] = forward[0], 0.0, forward[1]
        matrix[:3, 1] = forward[1], 0.0, -forward[0]
        matrix[:3, 2] = 0.0, 1.0, 0.0
        matrix[:3, 3] = axle[0], floor_m, axle[1]
        return Pose(self._cameras[side], matrix)

    def _is_free(self, pose: Pose) -> bool:
        """Whether nothing that stands is where the car is."""
        half_m, body = self._body.width_m / 2, self._body
        tail_m = body.ahead_m - body.length_m
        ground = np.array([[body.ahead_m, half_m], [body.ahead_m, -half_m], [tail_m, -half_m], [tail_m, half_m]])
        turn, place = pose.vehicle_to_world[[0, 2], :2], pose.vehicle_to_world[[0, 2], 3]
        return not self._solids.at(shapely.Polygon(ground @ turn.T + place))

    def _shows_corner(self, pose: Pose) -> bool:
        """Whether an entry corner is in the picture, hidden or not."""
        lens, to_view = pose.camera.lens, np.linalg.inv(pose.camera_to_world)
        entries_m = self._slots_m[:, :2].reshape(-1, 3)
        places = lens.project(entries_m @ to_view[:3, :3].T + to_view[:3, 3])
        inside = places[lens.within(places)]
        return bool((~lens.over_car(inside)).any())


def _turned(forward: Matrix, angle_deg: float) -> Matrix:
    cos, sin = math.cos(math.radians(angle_deg)), math.sin(math.radians(angle_deg))
    return np.array([[cos, -sin], [sin, cos]]) @ forward
