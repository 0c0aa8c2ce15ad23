"""Poses of a vehicle at which sensors record, in the frames of vehicle, map and stage, and its motion there."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial
from itertools import repeat
from typing import Self

import numpy as np
from numpy.typing import NDArray
from pxr import Usd

from garage2usd.driving.timing import Motion
from garage2usd.driving.trajectory import Trajectory
from garage2usd.scenes.values import metres_y_up

Floats = NDArray[np.float64]
Matrix = NDArray[np.float64]
CAR_FROM_VEHICLE = np.array([[0.0, -1, 0, 0], [0, 0, 1, 0], [-1, 0, 0, 0], [0, 0, 0, 1]])
"""Transform from ISO 8855 axes (x forward, y left, z up) to those of a car that looks to -Z with Y up."""
MAP_TO_Y_UP = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])
"""Transform from a map (x = X, y = -Z, z = Y) to X, Y and Z with Y up."""
_STEP_S = 0.02
_HALF_S = 0.005
"""Time before and after a pose between which the vehicle's motion is measured."""
_END_M = 1e-3
"""Distance below which the last pose is merged with the end of the drive."""


@dataclass(frozen=True, eq=False)
class Twist:
    """Velocity and angular velocity of a rigid body, in its own axes and at its origin.

    Attributes
    ----------
    velocity_m_s
        Velocity in metres per second; float64, shape (3,).
    turn_rad_s
        Angular velocity along the axis of rotation, in radians per second; float64, shape (3,).
    """

    velocity_m_s: Floats
    turn_rad_s: Floats

    @classmethod
    def at_rest(cls) -> Self:
        """Return the twist of a body at rest."""
        return cls(np.zeros(3), np.zeros(3))

    @classmethod
    def between(cls, before: Floats, after: Floats, seconds: float) -> Self:
        """Compute the mean twist between two poses, in the axes halfway; matrices to the world's axes, shape (4, 4).

        `seconds` between the poses is greater than 0.
        """
        from scipy.spatial.transform import Rotation  # noqa: PLC0415 - slow to import, and not always needed

        turned = Rotation.from_matrix(before[:3, :3].T @ after[:3, :3])
        angles = turned.as_rotvec()
        halfway = before[:3, :3] @ Rotation.from_rotvec(angles / 2).as_matrix()
        return cls(halfway.T @ (after[:3, 3] - before[:3, 3]) / seconds, angles / seconds)

    def of_part(self, part_to_whole: Floats) -> Self:
        """Return the twist of a part fixed to the body, in the part's own axes; `part_to_whole` has shape (4, 4)."""
        turn, place_m = part_to_whole[:3, :3], part_to_whole[:3, 3]
        velocity = self.velocity_m_s + np.cross(self.turn_rad_s, place_m)
        return type(self)(turn.T @ velocity, turn.T @ self.turn_rad_s)

    def reversed(self) -> Self:
        """Return the motion of the static world as seen from the moving body."""
        return type(self)(-self.velocity_m_s, -self.turn_rad_s)

    def seen_after(self, points_m: Floats, seconds: float) -> Floats:
        """Transform static points, shape (n, 3), to the moving body's axes after a time; negative times are earlier."""
        from scipy.linalg import expm  # noqa: PLC0415 - as above

        generator = np.zeros((4, 4))
        x, y, z = self.turn_rad_s
        generator[:3, :3] = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
        generator[:3, 3] = self.velocity_m_s
        back = expm(-seconds * generator)
        moved: Floats = points_m @ back[:3, :3].T + back[:3, 3]
        return moved

    @property
    def facts(self) -> dict[str, list[float]]:
        """Velocity and angular velocity as plain values, rounded to micrometres and microradians per second."""
        return {
            "velocity_m_s": [round(float(value), 6) + 0.0 for value in self.velocity_m_s],
            "turn_rad_s": [round(float(value), 6) + 0.0 for value in self.turn_rad_s],
        }


@dataclass(frozen=True, eq=False)
class VehiclePose:
    """A pose of a vehicle on its drive.

    Attributes
    ----------
    time_s, distance_m
        Time since the start, and distance driven in both gears.
    vehicle_to_world
        Transform from the vehicle's ISO 8855 axes (origin at the middle of the rear axle on the ground) to the stage's
        axes, in metres, for column vectors; float64, shape (4, 4).
    find_twist
        Function that computes `twist`, called only if the motion is needed.
    """

    time_s: float
    distance_m: float
    vehicle_to_world: Matrix
    find_twist: Callable[[], Twist] = Twist.at_rest

    @cached_property
    def twist(self) -> Twist:
        """Velocity and turning rate of the vehicle at the pose, in ISO 8855 axes."""
        return self.find_twist()

    @property
    def facts(self) -> dict[str, float]:
        """Time and distance of the vehicle pose, rounded to a microsecond and a micrometre."""
        return {"time_s": round(self.time_s, 6), "distance_m": round(self.distance_m, 6)}


def poses_along(motion: Motion, every_m: float, *, to_stage: Matrix) -> list[VehiclePose]:
    """Sample a drive's vehicle poses in equal steps of distance, from its start to its end.

    Parameters
    ----------
    motion
        Motion of the car over time.
    every_m
        Step, greater than 0. During a stop, the pose is that of the arrival.
    to_stage
        Transform from metres with Y up to the stage's axes; shape (4, 4), see `y_up_to_stage`.
    """
    driven = motion.sampled(_STEP_S)
    length_m = float(driven.arc_m[-1])
    steps = np.arange(0.0, length_m - _END_M, every_m)
    reached, first = np.unique(driven.arc_m, return_index=True)
    times = np.append(np.interp(steps, reached, driven.time_s[first]), driven.time_s[-1])
    states = motion.at(times)
    around = np.clip(times - _HALF_S, 0.0, driven.time_s[-1]), np.clip(times + _HALF_S, 0.0, driven.time_s[-1])
    before, after = (vehicle_to_y_up(motion.at(each)) for each in around)
    twists = map(partial, repeat(Twist.between), before, after, (around[1] - around[0]).tolist())
    placed = zip(times.tolist(), states.arc_m.tolist(), vehicle_to_y_up(states), twists, strict=True)
    return [VehiclePose(time, arc, to_stage @ matrix, twist) for time, arc, matrix, twist in placed]


def vehicle_to_y_up(states: Trajectory) -> Matrix:
    """Return the vehicle's transform to metres with Y up at each state of a trajectory; float64, shape (n, 4, 4)."""
    columns = (states.x_m, states.y_m, states.z_m, states.yaw_rad, states.pitch_rad)
    placed: Matrix = car_to_y_up(np.stack(columns, axis=1)) @ CAR_FROM_VEHICLE
    return placed


def car_to_y_up(states: Floats) -> Matrix:
    """Return the transform of a car that looks to -Z to metres with Y up, float64 of shape (n, 4, 4).

    States are x, y, z, yaw and pitch, shape (n, 5), as of `garage2usd.driving.tracks.Track.at`.
    """
    yaw_rad, pitch_rad = states[:, 3], states[:, 4]
    sin_yaw, cos_yaw = np.sin(yaw_rad), np.cos(yaw_rad)
    sin_pitch, cos_pitch = np.sin(pitch_rad), np.cos(pitch_rad)
    zero = np.zeros_like(sin_yaw)
    car = np.zeros((len(sin_yaw), 4, 4))
    # about +Y by the yaw, before that about +X by the pitch
    car[:, 0, :3] = np.stack([cos_yaw, sin_yaw * sin_pitch, sin_yaw * cos_pitch], axis=1)
    car[:, 1, :3] = np.stack([zero, cos_pitch, -sin_pitch], axis=1)
    car[:, 2, :3] = np.stack([-sin_yaw, cos_yaw * sin_pitch, cos_yaw * cos_pitch], axis=1)
    car[:, :3, 3] = states[:, :3]
    car[:, 3, 3] = 1.0
    return car


def y_up_to_stage(stage: Usd.Stage) -> Matrix:
    """Return the rotation from Y up to the stage's axes, both in metres; for column vectors, shape (4, 4)."""
    turn = np.eye(4)
    to_metres = metres_y_up(stage)
    # `to_metres` is for row vectors; unchanged, it is the inverse rotation for column vectors
    turn[:3, :3] = to_metres[:3, :3] / np.linalg.norm(to_metres[0, :3])
    return turn
