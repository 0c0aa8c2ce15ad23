"""The road of a garage: where cars stand before its portals, what is in their way, and the heights of its floor."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from garage2usd.driving.car import Point, Pose
from garage2usd.driving.garage import DrivenGarage
from garage2usd.driving.obstacles import Obstacles
from garage2usd.garage import LaneKind

__all__ = ["DrivenRoad", "Portal", "RampFloor", "heights_m"]

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Portal:
    """An entrance or an exit.

    Attributes
    ----------
    node
        Number of its node.
    name
        Its name.
    kind
        Which of the two it is.
    pose
        Where a car stands before it enters or after it has left.
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
        (x, z) of a point on its middle line, from which runs are measured.
    uphill
        Unit vector (x, z).
    half_width_m
        From its middle line to its sides.
    runs_m, heights_m
        Its profile from its foot on, the runs ascending; shape (n,).
    """

    foot_m: Point
    uphill: Point
    half_width_m: float
    runs_m: Floats
    heights_m: Floats

    @property
    def top_m(self) -> Point:
        """(x, z) where it ends on its middle line."""
        run = float(self.runs_m[-1])
        return self.foot_m[0] + run * self.uphill[0], self.foot_m[1] + run * self.uphill[1]


@dataclass(frozen=True, eq=False)
class DrivenRoad:
    """A garage that is driven through from portal to portal.

    Attributes
    ----------
    garage
        Its stalls and lanes, and what stands in it; there the arms of gates count as down.
    standing
        What is in the way on lanes and ramps: the arms of all gates are up, as they open to who drives in or out.
    portals
        Entrances and exits.
    ramps
        The floors of its ramps; all other floor lies at 0.
    """

    garage: DrivenGarage
    standing: Obstacles
    portals: tuple[Portal, ...]
    ramps: tuple[RampFloor, ...] = ()


def heights_m(ramps: Sequence[RampFloor], x_m: ArrayLike, z_m: ArrayLike, *, level_m: float = 0.0) -> Floats:
    """Heights of the floor at points; float64, their shape. `level_m` is that of the floor beside ramps."""
    x, z = np.asarray(x_m, dtype=np.float64), np.asarray(z_m, dtype=np.float64)
    heights: Floats = np.full(np.broadcast(x, z).shape, level_m)
    for ramp in ramps:
        away_x, away_z = x - ramp.foot_m[0], z - ramp.foot_m[1]
        run = away_x * ramp.uphill[0] + away_z * ramp.uphill[1]
        aside = np.abs(away_x * ramp.uphill[1] - away_z * ramp.uphill[0])
        is_on = (aside <= ramp.half_width_m) & (run >= ramp.runs_m[0])
        heights = np.where(is_on, np.interp(run, ramp.runs_m, ramp.heights_m), heights)
    return heights
