"""A way that a car drives: arcs and straights with their gears, from one pose to another."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from garage2usd.driving.car import Pose
from garage2usd.driving.sweep import Floats

__all__ = ["Gear", "Manoeuvre", "Move", "Waypoint"]


class Gear(StrEnum):
    """Which way a car drives."""

    FORWARD = "forward"
    REVERSE = "reverse"

    @property
    def sign(self) -> int:
        """1 forward, -1 in reverse."""
        return 1 if self is Gear.FORWARD else -1

    @property
    def other(self) -> "Gear":
        """The opposite one."""
        return Gear.REVERSE if self is Gear.FORWARD else Gear.FORWARD


@dataclass(frozen=True, slots=True)
class Move:
    """One arc or straight.

    Attributes
    ----------
    gear
        Which way.
    curvature_per_m
        Of the rear axle's way, positive to the driver's left; 0 on a straight.
    length_m
        Of the rear axle's way, positive in both gears.
    """

    gear: Gear
    curvature_per_m: float
    length_m: float


@dataclass(frozen=True, slots=True)
class Waypoint:
    """A pose on the way, with how the car comes on from there.

    Attributes
    ----------
    pose
        Where the car is.
    arc_m
        Way of the rear axle's middle since the start.
    gear, curvature_per_m
        Of the move that the pose lies on; of the last one at the end.
    """

    pose: Pose
    arc_m: float
    gear: Gear
    curvature_per_m: float


@dataclass(frozen=True, slots=True)
class Manoeuvre:
    """A way without a touch.

    Attributes
    ----------
    start
        Where it begins.
    moves
        What is driven, in order.
    clearance_m
        What is left at least between the car's body and everything else on the whole way: a lower bound.
    """

    start: Pose
    moves: tuple[Move, ...]
    clearance_m: float

    @property
    def end(self) -> Pose:
        """Where it ends."""
        pose = self.start
        for move in self.moves:
            pose = pose.moved(move.gear.sign * move.length_m, move.curvature_per_m)
        return pose

    @property
    def length_m(self) -> float:
        """Way of the rear axle's middle."""
        return sum(move.length_m for move in self.moves)

    @property
    def gear_changes(self) -> int:
        """How often the car stops to go the other way."""
        return sum(one.gear is not other.gear for one, other in pairwise(self.moves))

    def reversed(self) -> "Manoeuvre":
        """The same way backwards in time: from its end to its start, over the same ground."""
        moves = (Move(move.gear.other, move.curvature_per_m, move.length_m) for move in reversed(self.moves))
        return Manoeuvre(self.end, tuple(moves), self.clearance_m)

    def waypoints(self, step_m: float = 0.25) -> Iterator[Waypoint]:
        """Poses at most `step_m` apart along the way, with those at the ends of each move; the last is the end."""
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
        """The poses of `waypoints` as an array, for a way that has moves.

        Returns
        -------
        tuple
            x, z and yaw of each, shape (n + 1, 3), and the number of the move that each but the last lies on.
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
        along_x = np.where(bends, (np.cos(yaw) - np.cos(yaws)) / curvature, -np.sin(yaw) * driven)
        along_z = np.where(bends, -(np.sin(yaw) - np.sin(yaws)) / curvature, -np.cos(yaw) * driven)
        end = [[starts[-1].x_m, starts[-1].z_m, starts[-1].yaw_rad]]
        return np.concatenate([np.stack([x + along_x, z + along_z, yaw], axis=1), end]), owner


def _steps(move: Move, step_m: float) -> int:
    """In how many steps of at most a length a move is driven."""
    return max(math.ceil(move.length_m / step_m - 1e-9), 1)
