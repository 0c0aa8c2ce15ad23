"""Whole routes: from before an entrance into a stall, and from the stall to behind an exit."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import chain

from garage2usd.driving.car import DesignCar
from garage2usd.driving.garage import Find, Nose, StallProof, prove_garage
from garage2usd.driving.lane_poses import families
from garage2usd.driving.lane_search import path_from_entrance, path_to_exit
from garage2usd.driving.manoeuvre import Manoeuvre
from garage2usd.driving.obstacles import Obstacles
from garage2usd.driving.path import Path
from garage2usd.driving.proof import LanePose, Limits
from garage2usd.driving.road import DrivenRoad, Portal
from garage2usd.driving.roadmap import GRAINS, Grain, Roadmap
from garage2usd.driving.turns import Steering
from garage2usd.driving.way_search import find_guided_way, find_way_by_steps
from garage2usd.garage import LaneKind, Stall

__all__ = ["Route", "Router"]

_MORE_CHANGES, _FURTHER_M = 6, 20.0
"""Gear changes and reach of a way between lane and stall where the usual ones leave no room to turn on the lanes."""


@dataclass(frozen=True, eq=False)
class Route:
    """From before an entrance into a stall, and out of it to behind an exit.

    Attributes
    ----------
    stall
        Name of the stall.
    nose
        How the car stands in it.
    entrance, exit
        Where it comes from, and where it leaves.
    arrival, departure
        The paths; the second begins where the first ends.
    is_full
        Whether they are clear with a car in every other stall.
    """

    stall: str
    nose: Nose
    entrance: Portal
    exit: Portal
    arrival: Path
    departure: Path
    is_full: bool


class Router:
    """What the routes of one garage share.

    Parameters
    ----------
    road
        The garage.
    steerings
        How the car may turn on lanes, the most comfortable way first.
    car, limits
        The car, and what is asked of its driver.
    """

    def __init__(
        self,
        road: DrivenRoad,
        steerings: Sequence[Steering],
        *,
        car: DesignCar | None = None,
        limits: Limits | None = None,
    ) -> None:
        self._road, self._steerings = road, tuple(steerings)
        self._car, self._limits = car or DesignCar(), limits or Limits()
        self._standing = lru_cache(maxsize=2)(self._stood)
        self._roadmap = lru_cache(maxsize=2)(self._mapped)

    def portals(self, kind: LaneKind) -> tuple[Portal, ...]:
        """The entrances or the exits, in reading order."""
        return tuple(portal for portal in self._road.portals if portal.kind is kind)

    def route(
        self,
        stall: Stall,
        *,
        proof: StallProof | None = None,
        entrances: Iterable[Portal] | None = None,
        exits: Iterable[Portal] | None = None,
    ) -> Route | StallProof:
        """The shortest route found into a stall and out of it, or the proof that there are no ways or what they lack.

        Parameters
        ----------
        stall
            A stall of the garage.
        proof
            Its proof, where it is known.
        entrances, exits
            Those that may be used; left out, all.
        """
        if proof is None:
            (proof,) = prove_garage(self._road.garage, [stall], car=self._car, limits=self._limits)
        if proof.nose is None or proof.way_in is None or proof.way_out is None:
            return proof
        entrances = self.portals(LaneKind.ENTRANCE) if entrances is None else tuple(entrances)
        exits = self.portals(LaneKind.EXIT) if exits is None else tuple(exits)
        arrival = self._led(stall, proof, proof.way_in, entrances, is_back=True)
        departure = self._led(stall, proof, proof.way_out, exits, is_back=False)
        if arrival is None or departure is None:
            return replace(
                proof, way_in=proof.way_in if arrival else None, way_out=proof.way_out if departure else None
            )
        return Route(stall.name, proof.nose, arrival[1], departure[1], arrival[0], departure[0], proof.is_full)

    def _led(
        self, stall: Stall, proof: StallProof, proven: Manoeuvre, portals: Sequence[Portal], *, is_back: bool
    ) -> tuple[Path, Portal] | None:
        """The proven way led on to a portal, or back to one; else another way from the same parked pose."""
        roadmap = self._roadmap(proof.is_full)
        parked = proven.end if is_back else proven.start
        garage = self._road.garage
        used = garage.lanes.arriving if is_back else garage.lanes.leaving
        poses = roadmap.roomy_poses([arc for arc in garage.near(stall.access) if arc in used], is_back=is_back)
        standing = self._standing(proof.is_full).without(garage.unseen(stall))
        further = replace(self._limits, gear_changes=_MORE_CHANGES, reach_m=_FURTHER_M)

        def ways(
            limits: Limits, lanes: Iterable[Sequence[LanePose]], find: Find = find_way_by_steps
        ) -> Iterator[Manoeuvre]:
            for some in lanes:
                way = find(self._car, parked, standing, some, limits).way
                if way is not None:
                    yield way.reversed() if is_back else way

        together, each = families(poses), [[pose] for pose in poses]
        rounds = (
            chain([proven], ways(self._limits, together)),
            chain(ways(self._limits, each), ways(further, together), ways(further, each)),
            ways(further, together, find_guided_way),
        )
        # a coarse look at all ways of a round comes before a fine one at any
        for found in rounds:
            kept: list[Manoeuvre] = []
            for grain in GRAINS:
                for way in kept[:] if kept else found:
                    if grain is GRAINS[0]:
                        kept.append(way)
                    led = _joined(roadmap, way, portals, grain, is_back=is_back)
                    if led is not None:
                        return led
        return None

    def _stood(self, is_full: bool) -> Obstacles:  # noqa: FBT001
        standing = self._road.standing
        return standing.joined(self._road.garage.absent_cars(self._car)) if is_full else standing

    def _mapped(self, is_full: bool) -> Roadmap:  # noqa: FBT001
        return Roadmap(self._road, self._standing(is_full), self._car, self._steerings, self._limits.margin_m)


def _joined(
    roadmap: Roadmap, way: Manoeuvre, portals: Sequence[Portal], grain: Grain, *, is_back: bool
) -> tuple[Path, Portal] | None:
    """A way between a lane and a stall with the path over lanes before it or after it."""
    parking = Path.of_way(way)
    if is_back:
        found = path_from_entrance(roadmap, parking.start, portals, grain)
        return found and (found[0].then(parking.pieces), found[1])
    found = path_to_exit(roadmap, parking.end, portals, grain)
    return found and (parking.then(found[0].pieces), found[1])
