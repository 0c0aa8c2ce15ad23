"""The road of a garage: poses of cars outside its portals, obstacles, and heights of the floor."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from garage2usd.driving.car import Point, Pose
from garage2usd.driving.garage import DrivenGarage
from garage2usd.driving.obstacles import Obstacles
from garage2usd.garage import LaneKind

__all__ = ["DrivenRoad", "FloorSpan", "Portal", "RampFloor", "floor_heights_m", "heights_m"]

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Portal:
    """An entrance or exit of the garage, as start or end of a route.

    Attributes
    ----------
    node
        Number of its lane node.
    name
        Name of the portal.
    kind
        Entrance or exit.
    pose
        Pose of a car before it enters or after it has left.
    """

    node: int
    name: str
    kind: LaneKind
    pose: Pose


@dataclass(frozen=True, eq=False)
class RampFloor:
    """The floor of a straight ramp.

    Attributes
    ----------
    foot_m
        (x, z) of a point on the ramp's centre line, the origin of its runs.
    uphill
        Unit vector (x, z).
    half_width_m
        Distance from the centre line to the sides.
    runs_m, heights_m
        Height profile from the foot, the runs ascending; shape (n,).
    end_m
        Run up to which the floor reaches, level beyond its profile; infinite for a ramp to the street.
    """

    foot_m: Point
    uphill: Point
    half_width_m: float
    runs_m: Floats
    heights_m: Floats
    end_m: float = math.inf

    @property
    def top_m(self) -> Point:
        """(x, z) of the ramp's top on its centre line."""
        run = float(self.runs_m[-1])
        return self.foot_m[0] + run * self.uphill[0], self.foot_m[1] + run * self.uphill[1]


@dataclass(frozen=True, eq=False)
class DrivenRoad:
    """A garage as a road from portal to portal.

    Attributes
    ----------
    garage
        Stalls, lanes and obstacles; the arms of gates are down.
    standing
        Obstacles on lanes and ramps; the arms of gates are up, since they open to each car.
    portals
        Entrances and exits.
    ramps
        Floors of the ramps; all other floor is at height 0.
    """

    garage: DrivenGarage
    standing: Obstacles
    portals: tuple[Portal, ...]
    ramps: tuple[RampFloor, ...] = ()


class FloorSpan(NamedTuple):
    """A part of a path over several levels, and the floors of that part.

    Attributes
    ----------
    end_m
        Distance along the path, as seen from above, at which the part ends.
    level_m
        Height of the floor beside ramps.
    ramps
        Floors of ramps.
    """

    end_m: float
    level_m: float
    ramps: tuple[RampFloor, ...]


def floor_heights_m(
    ramps: Sequence[RampFloor], spans: Sequence[FloorSpan], plan_m: Floats, x_m: Floats, z_m: Floats
) -> Floats:
    """Return the floor's heights at points on one level, or at distances along a path over several levels."""
    if not spans:
        return heights_m(ramps, x_m, z_m)
    ends = np.array([span.end_m for span in spans[:-1]])
    number = np.searchsorted(ends, plan_m, side="right")
    heights: Floats = np.zeros(np.broadcast(x_m, z_m).shape)
    for index, span in enumerate(spans):
        here = number == index
        heights[here] = heights_m(span.ramps, x_m[here], z_m[here], level_m=span.level_m)
    return heights


def heights_m(ramps: Sequence[RampFloor], x_m: ArrayLike, z_m: ArrayLike, *, level_m: float = 0.0) -> Floats:
    """Return the floor's heights at points; float64, their shape. `level_m` is the height beside ramps."""
    x, z = np.asarray(x_m, dtype=np.float64), np.asarray(z_m, dtype=np.float64)
    heights: Floats = np.full(np.broadcast(x, z).shape, level_m)
    for ramp in ramps:
        away_x, away_z = x - ramp.foot_m[0], z - ramp.foot_m[1]
        run = away_x * ramp.uphill[0] + away_z * ramp.uphill[1]
        aside = np.abs(away_x * ramp.uphill[1] - away_z * ramp.uphill[0])
        is_on = (aside <= ramp.half_width_m) & (run >= ramp.runs_m[0]) & (run <= ramp.end_m)
        heights = np.where(is_on, np.interp(run, ramp.runs_m, ramp.heights_m), heights)
    return heights
