"""Limits and result of a search for a manoeuvre between a stall and a lane, and the poses on lanes where it may end."""

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from garage2usd.driving.car import DesignCar, Point, Pose
from garage2usd.driving.manoeuvre import Manoeuvre
from garage2usd.driving.obstacles import Obstacles, bulge, least_clearance, touched_shapes
from garage2usd.garage import Arc, LaneGraph
from garage2usd.native import elementary

_FINE_RAD = math.radians(1.0)
_FINE_M = 0.5
_SHORTEST_M = 1e-3
_QUARTER = math.pi / 2
_ASKEW_RAD, _SAME_RAD = 1e-4, 1e-9


@dataclass(frozen=True, slots=True)
class LanePose:
    """Poses in line with a lane at which a manoeuvre may start or end, within a rectangle along the lane.

    Attributes
    ----------
    middle_m
        (x, z) of the rectangle's middle.
    yaw_rad
        Direction of driving, right-handed about +Y; at 0 to -Z.
    length_m, width_m
        Size of the rectangle for the middle of the car's footprint, along and across the direction of driving.
    """

    middle_m: Point
    yaw_rad: float
    length_m: float
    width_m: float


@dataclass(frozen=True, slots=True)
class Limits:
    """Limits of a manoeuvre search.

    Attributes
    ----------
    margin_m
        Clearance kept around the car along the whole manoeuvre.
    gear_changes
        Greatest number of gear changes between lane and stall.
    reach_m
        Greatest distance of the rear axle from the stall along either axis of the lanes.
    is_thorough
        True to repeat a failed coarse search with fine steps, and then with a guided search; takes seconds.
    """

    margin_m: float = 0.05
    gear_changes: int = 4
    reach_m: float = 12.0
    is_thorough: bool = True


class Outcome(StrEnum):
    """Outcome of a manoeuvre search."""

    REACHED = "reached"
    UNDECIDED = "undecided"
    IMPOSSIBLE = "impossible"


@dataclass(frozen=True, slots=True)
class Search:
    """Result of a search for a manoeuvre out of a stall.

    Attributes
    ----------
    way
        Manoeuvre from the stall to the lane; None if none was found.
    touched
        Names of the obstacles that the car touched, the most frequent first.
    is_exhausted
        True if no manoeuvre exists at the search's resolution; False if the search succeeded or reached its bound.
    """

    way: Manoeuvre | None
    touched: tuple[str, ...] = ()
    is_exhausted: bool = False

    @property
    def outcome(self) -> Outcome:
        """Reached, impossible at the search's resolution, or undecided because the search reached its bound."""
        if self.way is not None:
            return Outcome.REACHED
        return Outcome.IMPOSSIBLE if self.is_exhausted else Outcome.UNDECIDED


def touched_parked(car: DesignCar, parked: Pose, obstacles: Obstacles, margin_m: float) -> tuple[str, ...]:
    """Return the names of the obstacles closer than a margin to a parked car."""
    near = obstacles.near((parked.x_m, parked.z_m), car.length_m + margin_m)
    pose = np.array([parked.x_m, parked.z_m, parked.yaw_rad])
    return near.named(touched_shapes(near.met_by(car), pose, margin_m))


def least_clearance_m(car: DesignCar, way: Manoeuvre, obstacles: Obstacles, *, most_m: float = 1.0) -> float:
    """Compute a lower bound of the clearance between a car and all obstacles along a manoeuvre, at most `most_m`."""
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


def lane_poses(lanes: LaneGraph, arcs: Iterable[Arc], car: DesignCar) -> list[LanePose]:
    """Return the poses of a car in line with lane arcs, its middle on the arc and its body within the carriageway."""
    poses = (_pose(lanes, arc, car) for arc in arcs)
    return [pose for pose in poses if pose is not None and min(pose.length_m, pose.width_m) >= 0]


def _pose(lanes: LaneGraph, arc: Arc, car: DesignCar) -> LanePose | None:
    """Return the lane pose along an arc's centre line, as far as the car stays on the ground of both nodes."""
    start, end = (lanes.nodes[number] for number in arc)
    way = end.position[0] - start.position[0], end.position[1] - start.position[1]
    length = math.hypot(*way)
    if length < _SHORTEST_M:
        return None
    along = way[0] / length, way[1] / length
    low = max(0.0, car.length_m / 2 - start.reach_m(along))
    high = min(length, length + end.reach_m(along) - car.length_m / 2)
    middle = (low + high) / 2
    place = start.position[0] + along[0] * middle, start.position[1] + along[1] * middle
    return LanePose(place, _yaw_rad(along), high - low, lanes.arcs[arc].width_m - car.width_m)


def families(poses: Iterable[LanePose]) -> list[list[LanePose]]:
    """Group lane poses whose directions differ by quarter turns, and round those differences to exact quarter turns."""
    families: list[list[LanePose]] = []
    for pose in poses:
        for family in families:
            turned = pose.yaw_rad - family[0].yaw_rad
            quarters = round(turned / _QUARTER)
            off = abs(turned - quarters * _QUARTER)
            if off < _ASKEW_RAD:
                exact = family[0].yaw_rad + quarters * _QUARTER
                family.append(pose if off < _SAME_RAD else replace(pose, yaw_rad=exact))
                break
        else:
            families.append([pose])
    return families


def _yaw_rad(along: Point) -> float:
    """Return the yaw of a direction, with negative zeros removed so that the yaw is unique."""
    return elementary.arctan2(-along[0] + 0.0, -along[1] + 0.0)
