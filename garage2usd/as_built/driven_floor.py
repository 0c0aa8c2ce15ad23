"""The floor for driving: level in the garage, and sloping on its ramps."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from garage2usd.as_built.driven_road import floors_of_ramps
from garage2usd.as_built.shapes import Thing
from garage2usd.driving import RampFloor, heights_m
from garage2usd.garage import LaneGraph

__all__ = ["DrivenFloor"]


@dataclass(frozen=True, eq=False)
class DrivenFloor:
    """The floor for driving, in metres, Y up.

    Attributes
    ----------
    level_m
        Height of the garage's floor.
    ramps
        Floors of its ramps.
    """

    level_m: float
    ramps: tuple[RampFloor, ...]

    @classmethod
    def of(cls, lanes: LaneGraph, things: Iterable[Thing]) -> "DrivenFloor":
        """Find the floor of the lanes and of the ramps among objects."""
        return cls(lanes.floor_m(), floors_of_ramps(things))

    def heights_m(self, x_m: ArrayLike, z_m: ArrayLike) -> NDArray[np.float64]:
        """Return the floor's heights at points; float64, their shape."""
        return heights_m(self.ramps, x_m, z_m, level_m=self.level_m)
