"""The reference policy: the planner's path, driven in the environment's own dynamics."""

import math

import numpy as np
from numpy.typing import NDArray

from garage2usd.config.outputs import DriveConfig
from garage2usd.driving import DesignCar, LanePose, Limits, Search, find_way
from garage2usd.driving.path import Path
from garage2usd.driving.timing import timed
from garage2usd.environment.task import STEP_S, ParkingTask
from garage2usd.native import elementary

ACCELERATION_M_S2 = 2.0
"""Acceleration of the car at an action of 1."""
_SPEED_M_S, _PUSH_M_S2 = 1.5, 1.5
_WITHIN_M = 0.05
_LEAST_REACH_M, _BEYOND_M = 20.0, 10.0


def steering_rad(car: DesignCar) -> float:
    """Return the angle of the front wheels at full lock, on the car's middle line, in radians."""
    return elementary.arctan(car.wheelbase_m / car.rear_axle_radius_m)


def reference_path(task: ParkingTask, *, gear_changes: int = 4) -> Path | None:
    """Return the planner's path from start to goal of a task.

    Parameters
    ----------
    task
        The task.
    gear_changes
        Greatest number of gear changes, where the task has no path and `garage2usd.driving.find_way` searches one.
    """
    if task.path is not None:
        return task.path
    way = searched_way(task, gear_changes=gear_changes).way
    return None if way is None else Path.of_way(way.reversed())


def searched_way(task: ParkingTask, *, gear_changes: int = 4) -> Search:
    """Search a way from the goal of a task back to its start, by `garage2usd.driving.find_way`."""
    ahead_m = task.car.length_m / 2 - task.car.rear_overhang_m
    at = task.start
    middle = at.x_m - elementary.sin(at.yaw_rad) * ahead_m, at.z_m - elementary.cos(at.yaw_rad) * ahead_m
    reach_m = max(_LEAST_REACH_M, task.apart_m + _BEYOND_M)
    limits = Limits(margin_m=task.margin_m, gear_changes=gear_changes, reach_m=reach_m)
    lane = LanePose(middle, at.yaw_rad, _WITHIN_M, _WITHIN_M)
    return find_way(task.car, task.goal, task.obstacles, [lane], limits)


def reference_actions(task: ParkingTask, *, gear_changes: int = 4) -> NDArray[np.float32] | None:
    """Return the continuous actions that park the car: the planner's path, driven open loop.

    Parameters
    ----------
    task
        The task, such as ``environment.unwrapped.task`` after a reset.
    gear_changes
        As for `reference_path`.

    Returns
    -------
    ndarray or None
        Acceleration and steering of each step, in [-1, 1]; shape (n, 2). None if no path is found.

    Notes
    -----
    The car stops where gear or curvature change abruptly. Each run between two stops takes a whole number of steps with
    an acceleration, a constant speed and a braking, so that it ends exactly at the end of its piece. On clothoids the
    steering of a step has the mean curvature, which leads to the exact heading and within a millimetre of the place.
    """
    path = reference_path(task, gear_changes=gear_changes)
    if path is None:
        return None
    full_rad = steering_rad(task.car)
    actions = [np.zeros((0, 2))]
    for run in timed(path, DriveConfig(), car=task.car).runs:
        sign, length_m = run.path.pieces[0].gear.sign, run.path.length_m
        pushes, steady = _steps(length_m)
        push = length_m / (STEP_S**2 * pushes * (pushes + steady))
        accelerations = np.repeat([push, 0.0, -push], [pushes, steady, pushes])
        speeds = np.concatenate([[0.0], np.cumsum(accelerations) * STEP_S])
        arcs = np.concatenate([[0.0], np.cumsum(speeds[1:] + speeds[:-1]) / 2 * STEP_S])
        bends = np.diff(run.path.at(np.minimum(arcs, length_m)).yaw_rad) / (sign * np.diff(arcs))
        steering = elementary.arctan(task.car.wheelbase_m * bends) / full_rad
        actions.append(np.stack([sign * accelerations / ACCELERATION_M_S2, np.clip(steering, -1, 1)], axis=1))
    return np.concatenate(actions).astype(np.float32)


def _steps(length_m: float) -> tuple[int, int]:
    """Return the fewest steps of acceleration and of constant speed that a run of some length takes.

    With n steps of acceleration a, m of constant speed and n of braking the car drives a t^2 n (n + m).
    """
    slow = math.ceil(length_m / (_SPEED_M_S * STEP_S))
    most = math.ceil(math.sqrt(length_m / _PUSH_M_S2) / STEP_S) + 1
    options = [
        (pushes, max(slow, math.ceil(length_m / (_PUSH_M_S2 * STEP_S**2 * pushes)), pushes) - pushes)
        for pushes in range(1, most + 1)
    ]
    return min(options, key=lambda each: 2 * each[0] + each[1])
