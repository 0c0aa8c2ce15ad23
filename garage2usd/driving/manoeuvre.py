"""A way that a car drives: arcs and straights with their gears, from one pose to another."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum
from itertools import pairwise

from garage2usd.driving.car import Pose

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
            count = max(math.ceil(move.length_m / step_m - 1e-9), 1)
            for number in range(count):
                part = move.length_m * number / count
                at = pose.moved(move.gear.sign * part, move.curvature_per_m)
                yield Waypoint(at, driven + part, move.gear, move.curvature_per_m)
            pose = pose.moved(move.gear.sign * move.length_m, move.curvature_per_m)
            driven += move.length_m
        if self.moves:
            yield Waypoint(pose, driven, self.moves[-1].gear, self.moves[-1].curvature_per_m)
