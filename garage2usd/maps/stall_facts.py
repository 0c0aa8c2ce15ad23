"""What a file says of stalls: number, use, and whether a car stands there."""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.checks import Subject
from garage2usd.reading.ground import StallOutline
from garage2usd.reading.objects import Matrix

__all__ = ["StallFacts"]

_MOVED_M = 0.05
"""How far a stall's prim may lie from the middle of its outline."""


class StallFacts:
    """The stalls of a stage, and which cars stand in them."""

    def __init__(self, stalls: Iterable[StallOutline]) -> None:
        """Take all stalls, without cars yet."""
        self.stalls = tuple(stalls)
        self._subject = Subject("", "stage", self.stalls, (), ())
        self._middles = shapely.STRtree([shapely.Point(stall.centre) for stall in self.stalls])
        self._car_of: dict[StallOutline, str] = {}

    @property
    def by_name(self) -> dict[str, StallOutline]:
        """Each stall by its id, those of an id that several have by their numbers too."""
        names = [stall.name for stall in self.stalls]
        unique = [name if names.count(name) == 1 else f"{name}[{number}]" for number, name in enumerate(names)]
        return dict(zip(unique, self.stalls, strict=True))

    def park(self, car: str, points_m: NDArray[np.floating[Any]], place: Matrix) -> StallOutline | None:
        """The stall that more than half of a car stands in, which counts as occupied from now on.

        Parameters
        ----------
        car
            Its path.
        points_m, place
            Points of its meshes, shape (n, 3), and the matrix from their space to the world.
        """
        ground = shapely.MultiPoint((points_m @ place[:3, :3] + place[3, :3])[:, [0, 2]]).convex_hull
        home = self._subject.home_of(ground)
        if home is not None:
            self._car_of.setdefault(home, car)
        return home

    def at(self, place: Matrix) -> StallOutline | None:
        """The stall whose middle lies where the origin of a matrix does."""
        found = self._middles.query(shapely.Point(place[3, 0], place[3, 2]), predicate="dwithin", distance=_MOVED_M)
        return self.stalls[found[0]] if len(found) else None

    def facts(self, stall: StallOutline) -> dict[str, Any]:
        """What is said of a stall wherever it is named."""
        number = dict(stall.facts).get("number")
        named = {"id": stall.name} if number is None else {"id": stall.name, "number": number}
        return {**named, "use": str(stall.use), "occupied": stall in self._car_of}

    def outline(self, stall: StallOutline) -> dict[str, Any]:
        """What is said of a stall besides: its corners (x, y, z) as `StallOutline` says, lane node, and car."""
        corners: Sequence[tuple[float, float, float]] = [(round(x, 4), 0, round(z, 4)) for x, z in stall.corners]
        car = self._car_of.get(stall)
        return {
            **self.facts(stall),
            "access_node": stall.access,
            "corners_m": corners,
            **({} if car is None else {"car": car}),
        }
