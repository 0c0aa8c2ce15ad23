"""The proof that a car gets from a lane into a stall and out again without a touch, by ways that do it."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from garage2usd.driving.car import DesignCar, Point, Pose
from garage2usd.driving.manoeuvre import Gear, Manoeuvre, Move
from garage2usd.driving.obstacles import Obstacles
from garage2usd.driving.search import HEADINGS, Task, search
from garage2usd.driving.sweep import Floats, bulge, least_clearance, touched_shapes
from garage2usd.errors import ConfigError

__all__ = ["LanePose", "Limits", "Search", "find_way", "least_clearance_m", "touched_parked"]

_QUARTER = math.pi / 2
_HEADING_ERROR = 1e-6
_SAME = 1e-9
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
        Whether fine steps are tried where coarse ones found nothing; it takes about half a second a stall.
    """

    margin_m: float = 0.05
    gear_changes: int = 4
    reach_m: float = 12.0
    is_thorough: bool = True


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
        Whether there is no way at the search's resolution; False where it was given up or succeeded.
    """

    way: Manoeuvre | None
    touched: tuple[str, ...] = ()
    is_exhausted: bool = False


_PASSES = ((0.36, 16_384), (0.24, 65_536), (0.12, 131_072))
"""Length of a straight step in metres and most places looked at: coarse first, then fine."""


def find_way(
    car: DesignCar, parked: Pose, obstacles: Obstacles, lanes: Sequence[LanePose], limits: Limits | None = None
) -> Search:
    """Find a way from a parked pose to any of some lane poses.

    Parameters
    ----------
    car
        The car.
    parked
        Where it stands.
    obstacles
        What it must not touch.
    lanes
        Where the way may end; directions differ by quarter turns.
    limits
        Margin, gear changes, reach and effort.

    Returns
    -------
    Search
        Driven backwards in time, `Manoeuvre.reversed`, the way leads in, from the lane in the same direction.

    Raises
    ------
    ConfigError
        If the lanes' directions differ by other than quarter turns.
    """
    limits = limits or Limits()
    if not lanes:
        return Search(None, (), is_exhausted=True)
    frame = lanes[0].yaw_rad
    goals = np.array([_goal(car, parked, lane, frame) for lane in lanes])
    start = np.array([0.0, 0.0, math.remainder(parked.yaw_rad - frame, math.tau)])
    reach = limits.reach_m + car.length_m
    near = obstacles.near((parked.x_m, parked.z_m), math.sqrt(2) * reach)
    local = near.seen_from(parked.x_m, parked.z_m, frame).near((0.0, 0.0), reach)
    scene = local.met_by(car)
    touched = np.zeros(len(local.pieces), np.int64)
    standing = local.named(touched_shapes(scene, start, limits.margin_m))
    if standing:
        return Search(None, standing, is_exhausted=True)

    def look(goals: Floats, straight_m: float, effort: int) -> tuple[int, Floats]:
        task = Task(
            scene,
            start,
            goals,
            radius=car.rear_axle_radius_m,
            margin=limits.margin_m,
            reach=limits.reach_m,
            straight_m=straight_m,
            max_changes=limits.gear_changes,
            max_nodes=effort,
        )
        return search(task, touched)

    found, steps = 0, np.empty((0, 3))
    for straight_m, effort in _PASSES if limits.is_thorough else _PASSES[:-1]:
        touched[:] = 0
        found, steps = look(goals, straight_m, effort)
        headings = np.unique(goals[:, 0])
        if found < 0 and len(headings) > 1:
            # a lane that is out of reach may draw the search away from another one: each direction for itself
            outcomes = []
            for heading in headings:
                outcome, steps = look(goals[goals[:, 0] == heading], straight_m, effort)
                outcomes.append(outcome)
                if outcome > 0:
                    break
            found = 1 if 1 in outcomes else min(outcomes)
        if found > 0:
            break
    if found <= 0:
        order = np.argsort(-touched, kind="stable")
        return Search(None, local.named(order[touched[order] > 0]), is_exhausted=found == 0)
    way = Manoeuvre(parked, _moves(steps, car.rear_axle_radius_m), 0.0)
    return Search(Manoeuvre(parked, way.moves, least_clearance_m(car, way, near)))


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


def _goal(car: DesignCar, parked: Pose, lane: LanePose, frame: float) -> tuple[float, float, float, float, float]:
    """Heading number, and least and most x and z of the rear axle's middle, in the frame of the search."""
    turned = lane.yaw_rad - frame
    quarters = round(turned / _QUARTER)
    if abs(turned - quarters * _QUARTER) > _HEADING_ERROR:
        raise ConfigError("lanes", turned, "directions that differ by quarter turns")
    axle = car.centred(lane.middle_m, lane.yaw_rad)
    x, z = axle.x_m - parked.x_m, axle.z_m - parked.z_m
    cos, sin = math.cos(frame), math.sin(frame)
    x, z = x * cos - z * sin, x * sin + z * cos
    half_x, half_z = lane.width_m / 2, lane.length_m / 2
    if quarters % 2:
        half_x, half_z = half_z, half_x
    heading = (quarters * HEADINGS // 4) % HEADINGS
    return heading, x - half_x - _SAME, z - half_z - _SAME, x + half_x + _SAME, z + half_z + _SAME


def _moves(steps: Floats, radius_m: float) -> tuple[Move, ...]:
    """Steps as moves: equal ones in a row are one."""
    moves: list[Move] = []
    previous = None
    for gear, steering, length in steps.tolist():
        if (gear, steering) == previous:
            last = moves[-1]
            moves[-1] = Move(last.gear, last.curvature_per_m, last.length_m + length)
        else:
            moves.append(Move(Gear.FORWARD if gear > 0 else Gear.REVERSE, steering / radius_m, length))
        previous = (gear, steering)
    return tuple(moves)
