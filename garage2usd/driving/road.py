"""The road of a garage: poses of cars outside its portals, obstacles, and heights of the floor."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from garage2usd.driving.car import Point, Pose
from garage2usd.driving.garage import DrivenGarage
from garage2usd.driving.obstacles import Obstacles
from garage2usd.driving.path import PathPoints
from garage2usd.garage import LaneKind
from garage2usd.native import elementary

Floats = NDArray[np.float64]
_ON_EDGE = 1e-9
_EDGE_M = 1e-5
"""Distance in metres beside a straight ramp that belongs to it: coordinates of stages have single precision."""


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


class SlopedFloor(Protocol):
    """The floor of a ramp of any kind."""

    def at(self, x_m: Floats, z_m: Floats) -> Floats:
        """Return the heights of the ramp's floor at points, NaN beside it; float64, their shape."""
        ...


@dataclass(frozen=True, eq=False)
class BentFloor:
    """The floor of a ramp that bends.

    Attributes
    ----------
    triangles
        (x, height, z) of the corners of its triangles; float64, shape (n, 3, 3).
    """

    triangles: Floats

    def at(self, x_m: Floats, z_m: Floats) -> Floats:
        """Return the heights of the ramp's floor at points, NaN beside it; the lowest of several above one another."""
        order = np.argsort(x_m, axis=None, kind="stable")
        x, z = x_m.reshape(-1)[order], z_m.reshape(-1)[order]
        found = np.full(x.shape, np.inf)
        for corners in self.triangles:
            (x0, y0, z0), (x1, y1, z1), (x2, y2, z2) = corners.tolist()
            double = (x1 - x0) * (z2 - z0) - (x2 - x0) * (z1 - z0)
            low, high = np.searchsorted(x, [min(x0, x1, x2) - _ON_EDGE, max(x0, x1, x2) + _ON_EDGE])
            if double == 0.0 or low == high:
                continue
            near = slice(low, high)
            away_x, away_z = x[near] - x0, z[near] - z0
            first = (away_x * (z2 - z0) - (x2 - x0) * away_z) / double
            second = ((x1 - x0) * away_z - away_x * (z1 - z0)) / double
            is_on = (first >= -_ON_EDGE) & (second >= -_ON_EDGE) & (first + second <= 1 + _ON_EDGE)
            heights = y0 + first * (y1 - y0) + second * (y2 - y0)
            found[near] = np.where(is_on, np.minimum(found[near], heights), found[near])
        result = np.full(x.shape, np.nan)
        result[order] = np.where(np.isinf(found), np.nan, found)
        return result.reshape(x_m.shape)

    def lifted(self, height_m: float) -> "BentFloor":
        """Return the floor some metres higher."""
        return BentFloor(self.triangles + np.array([0.0, height_m, 0.0]))


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

    def at(self, x_m: Floats, z_m: Floats) -> Floats:
        """Return the heights of the ramp's floor at points, NaN beside it; float64, their shape."""
        away_x, away_z = x_m - self.foot_m[0], z_m - self.foot_m[1]
        run = away_x * self.uphill[0] + away_z * self.uphill[1]
        aside = np.abs(away_x * self.uphill[1] - away_z * self.uphill[0])
        is_on = (aside <= self.half_width_m + _EDGE_M) & (run >= self.runs_m[0]) & (run <= self.end_m)
        heights: Floats = np.where(is_on, np.interp(run, self.runs_m, self.heights_m), np.nan)
        return heights


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
    keeps_left
        True where traffic keeps to the left.
    """

    garage: DrivenGarage
    standing: Obstacles
    portals: tuple[Portal, ...]
    ramps: tuple[RampFloor, ...] = ()
    keeps_left: bool = False


class FloorSpan(NamedTuple):
    """A part of a path, and the floors of that part.

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
    ramps: tuple[SlopedFloor, ...]


def floor_heights_m(spans: Sequence[FloorSpan], plan_m: Floats, x_m: Floats, z_m: Floats) -> Floats:
    """Return the floor's heights at points of a path, given their distances along it as seen from above."""
    ends = np.array([span.end_m for span in spans[:-1]])
    number = np.searchsorted(ends, plan_m, side="right")
    heights: Floats = np.zeros(np.broadcast(x_m, z_m).shape)
    for index, span in enumerate(spans):
        here = number == index
        heights[here] = heights_m(span.ramps, x_m[here], z_m[here], level_m=span.level_m)
    return heights


def tilt(spans: Sequence[FloorSpan], plan_m: Floats, points: PathPoints, wheelbase_m: float) -> tuple[Floats, Floats]:
    """Return the floor's heights under the rear axle at points of a path, and the pitch of a car; shape (n,)."""
    height, nose = (
        floor_heights_m(
            spans,
            plan_m,
            points.x_m - elementary.sin(points.yaw_rad) * ahead,
            points.z_m - elementary.cos(points.yaw_rad) * ahead,
        )
        for ahead in (0.0, wheelbase_m)
    )
    pitch: Floats = elementary.arctan((nose - height) / wheelbase_m)
    return height, pitch


def heights_m(ramps: Sequence[SlopedFloor], x_m: ArrayLike, z_m: ArrayLike, *, level_m: float = 0.0) -> Floats:
    """Return the floor's heights at points; float64, their shape. `level_m` is the height beside ramps."""
    x, z = np.asarray(x_m, dtype=np.float64), np.asarray(z_m, dtype=np.float64)
    heights: Floats = np.full(np.broadcast(x, z).shape, level_m)
    for ramp in ramps:
        on_ramp = ramp.at(x, z)
        heights = np.where(np.isnan(on_ramp), heights, on_ramp)
    return heights
