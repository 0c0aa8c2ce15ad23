"""A parking task: a car that drives from one pose to another between obstacles."""

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from garage2usd.driving import DesignCar, Obstacles, Pose
from garage2usd.driving.obstacles import Floats
from garage2usd.driving.path import Path

STEP_S, TICKS = 0.2, 5
"""Duration of a step in seconds, and the number of ticks that it is simulated in."""
BEYOND_M = 15.0
"""Distance in metres around start, goal and path that the car must not leave."""


@dataclass(frozen=True, eq=False)
class ParkingTask:
    """A parking task.

    Attributes
    ----------
    name
        Name of the stall or scene.
    car
        The car.
    start, goal
        Poses of the rear axle at which the car begins and shall stand; x and z in metres in the stage's frame.
    obstacles
        What stands around, without the stall's own objects.
    path
        A proven path from start to goal, clear of `obstacles`; None if none is known.
    margin_m
        Clearance that the reference policy keeps where it searches a path.
    stalls
        Corners (x, z) of stalls, which pictures show; shape (n, 4, 2).
    moving
        Middle (x, z) and yaw of agents at each tick, NaN while absent, as after the last tick;
        shape (ticks, agents, 3).
    sizes_m
        Length and width of each agent; shape (agents, 2).
    """

    name: str
    car: DesignCar
    start: Pose
    goal: Pose
    obstacles: Obstacles
    path: Path | None = None
    margin_m: float = 0.05
    stalls: Floats = field(default_factory=lambda: np.zeros((0, 4, 2)))
    moving: Floats = field(default_factory=lambda: np.zeros((1, 0, 3)))
    sizes_m: Floats = field(default_factory=lambda: np.zeros((0, 2)))

    @property
    def apart_m(self) -> float:
        """Distance from start to goal in metres."""
        return math.dist((self.start.x_m, self.start.z_m), (self.goal.x_m, self.goal.z_m))

    @cached_property
    def arena(self) -> tuple[tuple[float, float], float]:
        """Middle (x, z) and half the side of the square that the car must not leave, in metres."""
        poses = [self.start, self.goal]
        if self.path is not None and self.path.pieces:
            at = self.path.at(np.linspace(0.0, self.path.length_m, 20))
            poses += [Pose(*pose) for pose in zip(at.x_m.tolist(), at.z_m.tolist(), at.yaw_rad.tolist(), strict=True)]
        places = np.array([(pose.x_m, pose.z_m) for pose in poses])
        low, high = places.min(axis=0), places.max(axis=0)
        x, z = ((low + high) / 2).tolist()
        return (x, z), float((high - low).max()) / 2 + BEYOND_M
