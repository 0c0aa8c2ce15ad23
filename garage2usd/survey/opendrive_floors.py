"""Floors of an OpenDRIVE map: the heights at which its roads are level, a storey or more apart."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from garage2usd.survey.opendrive_lines import Cubics

_STOREY_M = 2.0
"""Least difference in metres of the heights of two floors."""
_LEVEL_M = 0.3
"""Greatest difference in metres of the heights of a level road, and of its end from the floor that it lies on."""
_SAMPLES = 9


def level_name(height_m: float) -> str:
    """Return the name of the level of a floor."""
    return f"{height_m:g} m"


@dataclass(frozen=True)
class Floors:
    """The floors of a map.

    Attributes
    ----------
    heights_m
        Height of each floor, from the top; at least one.
    """

    heights_m: tuple[float, ...]

    @classmethod
    def of(cls, profiles: Sequence[tuple[Cubics, float]]) -> Self:
        """Find the floors among the elevations and lengths in metres of all roads.

        The heights of level roads that no gap of a storey divides are one floor, at the mean by their lengths. Maps of
        hilly ground without gaps have one floor.
        """
        level = []
        for heights, length_m in profiles:
            found = heights.at(np.linspace(0.0, length_m, _SAMPLES))
            if np.ptp(found) <= _LEVEL_M:
                level.append((float(found.mean()), length_m))
        groups: list[list[tuple[float, float]]] = []
        for each in sorted(level, reverse=True):
            if not groups or groups[-1][-1][0] - each[0] > _STOREY_M:
                groups.append([])
            groups[-1].append(each)
        means = [
            np.average([height_m for height_m, _ in group], weights=[max(m, _LEVEL_M) for _, m in group])
            for group in groups
        ]
        return cls(tuple(round(float(mean), 2) + 0.0 for mean in means) or (0.0,))

    def nearest(self, height_m: float) -> float:
        """Return the height of the floor nearest to a height; the upper one of two."""
        return min(self.heights_m, key=lambda floor_m: abs(floor_m - height_m))

    def joined(self, heights: Cubics, length_m: float) -> tuple[float, float]:
        """Return the floors at both ends of a road; twice the nearest one if it does not lead from floor to floor."""
        start_m, end_m = heights.at(np.array([0.0, length_m])).tolist()
        floors = self.nearest(start_m), self.nearest(end_m)
        if max(abs(floors[0] - start_m), abs(floors[1] - end_m)) <= _LEVEL_M:
            return floors
        middle = self.nearest(float(heights.at(np.array([length_m / 2]))[0]))
        return middle, middle
