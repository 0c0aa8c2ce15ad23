"""Spatial index of the ground of stalls, to find the stall that contains an object."""

from collections.abc import Sequence
from functools import cached_property

import numpy as np
import shapely

from garage2usd.garage import Stall
from garage2usd.layout.grounds import Grounds, grounds_of

_AT_HOME = 0.5


class StallGrounds:
    """Spatial index of the ground of stalls.

    Parameters
    ----------
    stalls
        The stalls.
    """

    def __init__(self, stalls: Sequence[Stall]) -> None:
        self._stalls = stalls

    @cached_property
    def polygons(self) -> Grounds:
        """Polygon of each stall; shape (stalls,)."""
        return grounds_of([stall.corners for stall in self._stalls])

    @cached_property
    def tree(self) -> shapely.STRtree:
        """Spatial index of all stall polygons."""
        return shapely.STRtree(self.polygons)

    def home_of(self, ground: shapely.Polygon) -> Stall | None:
        """Return the stall that contains more than half of a footprint."""
        (home,) = self.homes_of(np.array([ground], dtype=object))
        return home

    def homes_of(self, grounds: Grounds) -> list[Stall | None]:
        """Return for each footprint the stall that contains more than half of it."""
        number, stall = self.tree.query(grounds, predicate="intersects")
        areas = shapely.area(shapely.intersection(self.polygons[stall], grounds[number]))
        most = (_AT_HOME * shapely.area(grounds)).tolist()
        homes: list[Stall | None] = [None] * len(grounds)
        for index, other, area in zip(number.tolist(), stall.tolist(), areas.tolist(), strict=True):
            if area > most[index]:
                homes[index], most[index] = self._stalls[other], area
        return homes
