"""Picture of a parking task from above."""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray
from PIL import Image, ImageDraw

from garage2usd.driving import Pose
from garage2usd.driving.obstacles import Floats
from garage2usd.environment.task import ParkingTask

SIDE = 600
_FINER = 2
_FLOOR, _LINE, _STANDS, _GOAL, _CAR, _GLASS = "#e9ecef", "#ffffff", "#495057", "#2f9e44", "#1c7ed6", "#a5d8ff"
_AGENT, _TRAIL, _PLAN, _TYRE = "#f08c00", "#1864ab", "#40c057", "#212529"
_TYRE_M = 0.64, 0.22
_PANE = ((0.0, 1.0), (0.0, -1.0), (0.7, -0.85), (0.7, 0.85))
_ENDS = np.array([(1, 1), (1, -1), (-1, -1), (-1, 1)]) / 2


def draw_task(
    task: ParkingTask, pose: Pose, steering_rad: float, *, trail: Floats, tick: int, side: int = SIDE
) -> NDArray[np.uint8]:
    """Draw a task from above: stalls, what stands there, agents, goal, proven path, trail and car.

    Parameters
    ----------
    task
        The task.
    pose, steering_rad
        Pose of the car, and the angle of its front wheels.
    trail
        Poses of the car so far; shape (n, at least 2).
    tick
        Number of ticks since the start, for the agents.
    side
        Width and height in pixels.

    Returns
    -------
    ndarray
        Red, green and blue; shape (side, side, 3).
    """
    (mid_x, mid_z), half_m = task.arena
    pixels, scale = side * _FINER, side * _FINER / (2 * half_m)
    image = Image.new("RGB", (pixels, pixels), _FLOOR)
    pen = ImageDraw.Draw(image)

    def at(points: Floats) -> list[tuple[float, float]]:
        return [((x - mid_x + half_m) * scale, (z - mid_z + half_m) * scale) for x, z in points.tolist()]

    for stall in task.stalls:
        pen.line(at(stall[[0, 3, 2, 1]]), _LINE, 2 * _FINER)
    for piece in task.obstacles.near((mid_x, mid_z), half_m).pieces:
        pen.polygon(at(piece), fill=_STANDS, outline=_STANDS, width=_FINER)
    if task.path is not None and task.path.pieces:
        along = task.path.at(np.linspace(0.0, task.path.length_m, 100))
        pen.line(at(np.stack([along.x_m, along.z_m], axis=1)), _PLAN, 2 * _FINER)
    car = task.car
    pen.polygon(at(np.array(car.corners(task.goal))), outline=_GOAL, width=2 * _FINER)
    if tick < len(task.moving):
        for (x, z, yaw_rad), size_m in zip(task.moving[tick].tolist(), task.sizes_m.tolist(), strict=True):
            if not math.isnan(x):
                pen.polygon(at(_points(Pose(x, z, yaw_rad), _ENDS * size_m)), fill=_AGENT)
    if len(trail) > 1:
        pen.line(at(trail[:, :2]), _TRAIL, 2 * _FINER)
    pen.polygon(at(np.array(car.corners(pose))), fill=_CAR)
    front_m, side_m = car.ahead_m - car.length_m / 4, 0.4 * car.width_m
    pen.polygon(at(_points(pose, [(front_m - back_m, side_m * left) for back_m, left in _PANE])), fill=_GLASS)
    for left in (1, -1):
        ((x, z),) = _points(pose, [(car.wheelbase_m, left * car.track_m / 2)]).tolist()
        pen.polygon(at(_points(Pose(x, z, pose.yaw_rad + steering_rad), _ENDS * _TYRE_M)), fill=_TYRE)
    return np.asarray(image.resize((side, side), Image.Resampling.LANCZOS))


def _points(pose: Pose, offsets_m: ArrayLike) -> Floats:
    """Return the points at distances ahead and to the left of a pose, shape (n, 2), as (x, z)."""
    ahead, left = np.asarray(offsets_m, dtype=np.float64).T
    sin, cos = math.sin(pose.yaw_rad), math.cos(pose.yaw_rad)
    return np.stack([pose.x_m - sin * ahead - cos * left, pose.z_m - cos * ahead + sin * left], axis=1)
