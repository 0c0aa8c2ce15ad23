"""Facts for map and scene files: provenance of a stage, and number, use and occupancy of each stall."""

from collections.abc import Iterable, Sequence
from typing import Any

import shapely
from pxr import Usd

from garage2usd.as_built.solids import StallGrounds
from garage2usd.garage import Stall
from garage2usd.layout.grounds import Grounds
from garage2usd.reading.whole_garage import garage_root
from garage2usd.scenes.prims import Matrix

_FACTS = ("generator", "version", "seed", "configDigest", "structureDigest")
_MOVED_M = 0.05
"""Greatest distance of a stall's prim from the middle of its outline."""


def stage_facts(stage: Usd.Stage | None) -> dict[str, str | int]:
    """Read generator, version, seed and digests from a stage's default prim, as far as given."""
    prim = garage_root(stage) if stage else None
    data = prim.GetCustomData() if prim else {}
    return {name: data[name] for name in _FACTS if isinstance(data.get(name), str | int)}


class StallFacts:
    """The stalls of a stage with their parked cars."""

    def __init__(self, stalls: Iterable[Stall], *, floor_m: float = 0.0) -> None:
        """Create the facts of all stalls, without cars, on a floor of some height."""
        self.stalls, self._floor_m = tuple(stalls), floor_m
        self._grounds = StallGrounds(self.stalls)
        self._middles = shapely.STRtree([shapely.Point(stall.centre) for stall in self.stalls])
        self._car_of: dict[Stall, str] = {}

    @property
    def by_name(self) -> dict[str, Stall]:
        """Stalls by id, and by painted number if several share an id."""
        names = [stall.name for stall in self.stalls]
        unique = [name if names.count(name) == 1 else f"{name}[{number}]" for number, name in enumerate(names)]
        return dict(zip(unique, self.stalls, strict=True))

    def park(self, cars: Sequence[str], grounds: Grounds) -> dict[str, Stall | None]:
        """Assign each car to the stall that contains more than half of its footprint, and mark it occupied.

        Parameters
        ----------
        cars
            Prim paths of the cars.
        grounds
            Footprints of the cars.
        """
        homes = dict(zip(cars, self._grounds.homes_of(grounds), strict=True))
        for car, home in homes.items():
            if home is not None:
                self._car_of.setdefault(home, car)
        return homes

    def at(self, place: Matrix) -> Stall | None:
        """Return the stall whose middle is at the origin of a matrix."""
        found = self._middles.query(shapely.Point(place[3, 0], place[3, 2]), predicate="dwithin", distance=_MOVED_M)
        return self.stalls[found[0]] if len(found) else None

    def facts(self, stall: Stall) -> dict[str, Any]:
        """Return the facts of a stall that every mention of it has: id, number, use and occupancy."""
        named = {"id": stall.name} if stall.number is None else {"id": stall.name, "number": stall.number}
        by = stall.blocked_by
        is_blocked = by is not None and any(of.name == by for of in self._car_of)
        blocked = {"blocked_by": by} if is_blocked else {}
        return {**named, "use": str(stall.use), "occupied": is_blocked or stall in self._car_of, **blocked}

    def outline(self, stall: Stall) -> dict[str, Any]:
        """Return the geometric facts of a stall: corners (x, y, z) as in `Stall`, lane node and car."""
        height = self._floor_m or 0
        corners: Sequence[tuple[float, float, float]] = [(round(x, 4), height, round(z, 4)) for x, z in stall.corners]
        car = self._car_of.get(stall)
        return {
            **self.facts(stall),
            "access_node": stall.access,
            "corners_m": corners,
            **({} if car is None else {"car": car}),
        }
