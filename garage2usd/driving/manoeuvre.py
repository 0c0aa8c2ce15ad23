"""A parking manoeuvre: arcs and straights with their gears, from one pose of the car to another."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from garage2usd.driving.car import Pose
from garage2usd.driving.obstacles import Floats
from garage2usd.native import elementary


class Gear(StrEnum):
    """Gear of the car: forward or reverse."""

    FORWARD = "forward"
    REVERSE = "reverse"

    @property
    def sign(self) -> int:
        """1 for forward, -1 for reverse."""
        return 1 if self is Gear.FORWARD else -1

    @property
    def other(self) -> "Gear":
        """The opposite gear."""
        return Gear.REVERSE if self is Gear.FORWARD else Gear.FORWARD


@dataclass(frozen=True, slots=True)
class Move:
    """One arc or straight of a manoeuvre.

    Attributes
    ----------
    gear
        Gear of the car.
    curvature_per_m
        Curvature of the rear axle's path, positive to the driver's left; 0 on a straight.
    length_m
        Length of the rear axle's path, positive in both gears.
    """

    gear: Gear
    curvature_per_m: float
    length_m: float


@dataclass(frozen=True, slots=True)
class Waypoint:
    """A pose along a manoeuvre, with the gear and curvature that follow.

    Attributes
    ----------
    pose
        Pose of the car.
    arc_m
        Distance driven since the start, of the rear axle's middle.
    gear, curvature_per_m
        Gear and curvature of the move at the pose; at the end, of the last move.
    """

    pose: Pose
    arc_m: float
    gear: Gear
    curvature_per_m: float


@dataclass(frozen=True, slots=True)
class Manoeuvre:
    """A collision-free parking manoeuvre.

    Attributes
    ----------
    start
        First pose of the car.
    moves
        Arcs and straights, in order.
    clearance_m
        Lower bound of the distance between the car's body and all obstacles along the manoeuvre.
    """

    start: Pose
    moves: tuple[Move, ...]
    clearance_m: float

    @property
    def end(self) -> Pose:
        """Last pose of the manoeuvre."""
        pose = self.start
        for move in self.moves:
            pose = pose.moved(move.gear.sign * move.length_m, move.curvature_per_m)
        return pose

    @property
    def length_m(self) -> float:
        """Length of the path of the rear axle's middle in metres."""
        return sum(move.length_m for move in self.moves)

    @property
    def gear_changes(self) -> int:
        """Number of gear changes in the manoeuvre."""
        return sum(one.gear is not other.gear for one, other in pairwise(self.moves))

    def reversed(self) -> "Manoeuvre":
        """Return the manoeuvre backwards in time: from its end to its start, over the same ground."""
        moves = (Move(move.gear.other, move.curvature_per_m, move.length_m) for move in reversed(self.moves))
        return Manoeuvre(self.end, tuple(moves), self.clearance_m)

    def waypoints(self, step_m: float = 0.25) -> Iterator[Waypoint]:
        """Return poses at most `step_m` apart along the manoeuvre, including the ends of each move."""
        pose, driven = self.start, 0.0
        for move in self.moves:
            count = _steps(move, step_m)
            for number in range(count):
                part = move.length_m * number / count
                at = pose.moved(move.gear.sign * part, move.curvature_per_m)
                yield Waypoint(at, driven + part, move.gear, move.curvature_per_m)
            pose = pose.moved(move.gear.sign * move.length_m, move.curvature_per_m)
            driven += move.length_m
        if self.moves:
            yield Waypoint(pose, driven, self.moves[-1].gear, self.moves[-1].curvature_per_m)

    def poses(self, step_m: float) -> tuple[Floats, NDArray[np.int64]]:
        """Return the poses of `waypoints` as an array, for a manoeuvre with at least one move.

        Returns
        -------
        tuple
            x, z and yaw of each pose, shape (n + 1, 3), and the number of the move at each pose but the last.
        """
        starts = [self.start]
        for move in self.moves:
            starts.append(starts[-1].moved(move.gear.sign * move.length_m, move.curvature_per_m))
        counts = np.array([_steps(move, step_m) for move in self.moves])
        owner = np.repeat(np.arange(len(counts)), counts)
        number = np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)
        lengths, signs, curvatures = np.array(
            [(move.length_m, move.gear.sign, move.curvature_per_m) for move in self.moves]
        )[owner].T
        x, z, yaws = np.array([(pose.x_m, pose.z_m, pose.yaw_rad) for pose in starts[:-1]])[owner].T
        driven = signs * lengths * number / counts[owner]
        yaw = yaws + driven * curvatures
        bends = driven * curvatures != 0
        curvature = np.where(bends, curvatures, 1.0)
        before, after = elementary.turned(yaws), elementary.turned(yaw)
        along_x = np.where(bends, (after.real - before.real) / curvature, -after.imag * driven)
        along_z = np.where(bends, (before.imag - after.imag) / curvature, -after.real * driven)
        end = [[starts[-1].x_m, starts[-1].z_m, starts[-1].yaw_rad]]
        return np.concatenate([np.stack([x + along_x, z + along_z, yaw], axis=1), end]), owner


def _steps(move: Move, step_m: float) -> int:
    """Return the number of steps of at most a given length that divide a move."""
    return max(math.ceil(move.length_m / step_m - 1e-9), 1)
