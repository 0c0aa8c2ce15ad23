"""What is asked of a way between a stall and a lane and what was found, and how near a car comes to obstacles."""

import math
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from garage2usd.driving.car import DesignCar, Point, Pose
from garage2usd.driving.manoeuvre import Manoeuvre
from garage2usd.driving.obstacles import Obstacles
from garage2usd.driving.sweep import bulge, least_clearance, touched_shapes

__all__ = ["LanePose", "Limits", "Outcome", "Search", "least_clearance_m", "touched_parked"]

_FINE_RAD = math.radians(1.0)
_FINE_M = 0.5


@dataclass(frozen=True, slots=True)
class LanePose:
    """Where on a lane a car may begin or end: in line with it, anywhere on a rectangle along it.

    Attributes
    ----------
    middle_m
        (x, z) of the rectangle's middle.
    yaw_rad
        Direction of driving, right-handed about +Y; at 0 to -Z.
    length_m, width_m
        Of the rectangle in which the middle of the car's footprint lies, along the direction and across it.
    """

    middle_m: Point
    yaw_rad: float
    length_m: float
    width_m: float


@dataclass(frozen=True, slots=True)
class Limits:
    """What a driver is asked for.

    Attributes
    ----------
    margin_m
        What is kept clear around the car all the way.
    gear_changes
        Most of them, between lane and stall.
    reach_m
        How far from the stall the rear axle goes along either axis of the lanes.
    is_thorough
        Whether fine steps, and then a guided search, are tried where coarse steps found nothing; it takes seconds.
    """

    margin_m: float = 0.05
    gear_changes: int = 4
    reach_m: float = 12.0
    is_thorough: bool = True


class Outcome(StrEnum):
    """What a search came to."""

    REACHED = "reached"
    UNDECIDED = "undecided"
    IMPOSSIBLE = "impossible"


@dataclass(frozen=True, slots=True)
class Search:
    """What a search for a way out found.

    Attributes
    ----------
    way
        The way from the stall to the lane, if there is one.
    touched
        Names of what stood in the way, most often first.
    is_exhausted
        Whether there is no way at the search's resolution; False where the search ended at its bound or succeeded.
    """

    way: Manoeuvre | None
    touched: tuple[str, ...] = ()
    is_exhausted: bool = False

    @property
    def outcome(self) -> Outcome:
        """Reached, impossible at the search's resolution, or undecided: the search ended at its bound."""
        if self.way is not None:
            return Outcome.REACHED
        return Outcome.IMPOSSIBLE if self.is_exhausted else Outcome.UNDECIDED


def touched_parked(car: DesignCar, parked: Pose, obstacles: Obstacles, margin_m: float) -> tuple[str, ...]:
    """Names of what comes nearer than a margin to a car where it is parked."""
    near = obstacles.near((parked.x_m, parked.z_m), car.length_m + margin_m)
    pose = np.array([parked.x_m, parked.z_m, parked.yaw_rad])
    return near.named(touched_shapes(near.met_by(car), pose, margin_m))


def least_clearance_m(car: DesignCar, way: Manoeuvre, obstacles: Obstacles, *, most_m: float = 1.0) -> float:
    """What is left at least between a car and all obstacles on a way: a lower bound, at most `most_m`."""
    scene = obstacles.met_by(car)
    step_m = min(_FINE_M, _FINE_RAD * car.rear_axle_radius_m)
    if not way.moves:
        poses = np.array([[way.start.x_m, way.start.z_m, way.start.yaw_rad]] * 2)
        return least_clearance(scene, poses, np.zeros(1), most_m)
    poses, move = way.poses(step_m)
    bends = [abs(each.curvature_per_m) for each in way.moves]
    turns = np.array([each.length_m * bend for each, bend in zip(way.moves, bends, strict=True)]) / np.bincount(move)
    lies_off = [bulge(1 / bend if bend else 0.0, turn, scene.body) for bend, turn in zip(bends, turns, strict=True)]
    return least_clearance(scene, poses, np.array(lies_off)[move], most_m)
