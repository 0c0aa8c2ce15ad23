"""Autoware's parking spaces: lines along the middle of a stall, from its entry to its rear."""

import math
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from garage2usd.garage import Point

_USUAL_WIDTH_M = 2.5
_LEAST_APART_M, _MOST_APART_M = 2.0, 4.0
"""Distances at which two spaces side by side are neighbours, whose stalls meet in the middle between them."""
_PARALLEL_SIN = 0.1
_SHIFTED = 0.5
"""Share of its length by which a neighbour may be shifted along a space."""
_WIDTH_DIGITS = 2


class ParkingSpace(NamedTuple):
    """A parking space: its name, and the (x, z) of both ends of its middle line."""

    name: str
    start: Point
    end: Point

    def ring(self, width_m: float) -> list[Point]:
        """Return the corners (x, z) of the stall around the line."""
        along = np.subtract(self.end, self.start)
        off = np.array([-along[1], along[0]]) / math.hypot(*along) * width_m / 2
        sides = ((self.start, -1), (self.start, 1), (self.end, 1), (self.end, -1))
        return [(float(x), float(z)) for x, z in (np.array(end) + sign * off for end, sign in sides)]

    def usual_width_m(self, others: Iterable["ParkingSpace"]) -> float:
        """Return the distance from the next space beside it, if that is a stall's width, or else 2.5 m."""
        along = np.subtract(self.end, self.start)
        length_m = math.hypot(*along)
        apart = []
        for other in others:
            beside = np.subtract(other.end, other.start)
            away = (np.add(other.start, other.end) - np.add(self.start, self.end)) / 2
            turned = abs(along[0] * beside[1] - along[1] * beside[0]) / length_m / math.hypot(*beside)
            across_m = abs(along[0] * away[1] - along[1] * away[0]) / length_m
            along_m = abs(float(along @ away)) / length_m
            is_beside = turned < _PARALLEL_SIN and along_m < _SHIFTED * length_m
            if is_beside and _LEAST_APART_M <= across_m <= _MOST_APART_M:
                apart.append(round(across_m, _WIDTH_DIGITS))
        return min(apart, default=_USUAL_WIDTH_M)
