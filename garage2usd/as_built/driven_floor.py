"""The floor for driving: level in the garage, and sloping on its ramps, straight or bent."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from garage2usd.as_built.driven_road import bent_floors, floors_of_ramps
from garage2usd.as_built.shapes import Thing
from garage2usd.driving import SlopedFloor, heights_m
from garage2usd.garage import LaneGraph
from garage2usd.garage.levels import LevelPlace

BEYOND_TOP_M = 1.0
"""Metres beyond the top of a ramp between levels up to which its floor reaches, level."""


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
    ramps: tuple[SlopedFloor, ...]

    @classmethod
    def of_levels(
        cls, levels: Sequence[LevelPlace], lanes: LaneGraph, things: Iterable[Thing]
    ) -> "tuple[DrivenFloor, ...]":
        """Find the floor of each level among the objects of all, by the paths of these; ramps belong to their foot."""
        named = list(things)
        floors = []
        for number, level in enumerate(levels):
            own = [thing for thing in named if thing.name.startswith(f"{level.path}/")]
            ramps = floors_of_ramps(own)
            if number:  # those of the top level lead to the street and go on
                ramps = tuple(replace(ramp, end_m=float(ramp.runs_m[-1]) + BEYOND_TOP_M) for ramp in ramps)
            floor_m = lanes.floor_m() if level.is_only else level.floor_m
            floors.append(cls(floor_m, (*ramps, *bent_floors(own))))
        return tuple(floors)

    def heights_m(self, x_m: ArrayLike, z_m: ArrayLike) -> NDArray[np.float64]:
        """Return the floor's heights at points; float64, their shape."""
        return heights_m(self.ramps, x_m, z_m, level_m=self.level_m)
