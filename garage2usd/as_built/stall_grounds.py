"""The ground of stalls, and which of them something stands in."""

from collections.abc import Sequence
from functools import cached_property

import numpy as np
import shapely

from garage2usd.garage import Stall
from garage2usd.layout.grounds import Grounds, grounds_of

__all__ = ["StallGrounds"]

_AT_HOME = 0.5


class StallGrounds:
    """The grounds of some stalls, by place.

    Parameters
    ----------
    stalls
        The stalls.
    """

    def __init__(self, stalls: Sequence[Stall]) -> None:
        self._stalls = stalls

    @cached_property
    def polygons(self) -> Grounds:
        """The ground of each stall; shape (stalls,)."""
        return grounds_of([stall.corners for stall in self._stalls])

    @cached_property
    def tree(self) -> shapely.STRtree:
        """All of them, by place."""
        return shapely.STRtree(self.polygons)

    def home_of(self, ground: shapely.Polygon) -> Stall | None:
        """The stall that more than half of a ground lies in."""
        (home,) = self.homes_of(np.array([ground], dtype=object))
        return home

    def homes_of(self, grounds: Grounds) -> list[Stall | None]:
        """For each of some grounds, the stall that more than half of it lies in."""
        number, stall = self.tree.query(grounds, predicate="intersects")
        areas = shapely.area(shapely.intersection(self.polygons[stall], grounds[number]))
        most = (_AT_HOME * shapely.area(grounds)).tolist()
        homes: list[Stall | None] = [None] * len(grounds)
        for index, other, area in zip(number.tolist(), stall.tolist(), areas.tolist(), strict=True):
            if area > most[index]:
                homes[index], most[index] = self._stalls[other], area
        return homes
