"""Complete routes of a car: from outside an entrance into a stall, and from the stall to outside an exit."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import chain

from garage2usd.driving.car import DesignCar, Pose
from garage2usd.driving.garage import Find, Nose, StallProof, prove_garage
from garage2usd.driving.manoeuvre import Manoeuvre
from garage2usd.driving.obstacles import Obstacles
from garage2usd.driving.path import Path
from garage2usd.driving.proof import LanePose, Limits, families
from garage2usd.driving.road import DrivenRoad, Portal
from garage2usd.driving.roadmap import GRAINS, Grain, Roadmap, path_between_portals, path_from_entrance, path_to_exit
from garage2usd.driving.turns import Steering
from garage2usd.driving.way_search import find_guided_way, find_way_by_steps
from garage2usd.garage import LaneKind, Stall

_MORE_CHANGES, _FURTHER_M = 6, 20.0
"""Gear changes and reach of a second manoeuvre search, for stalls without room to turn on the lanes."""


@dataclass(frozen=True, eq=False)
class Route:
    """A route from outside an entrance into a stall, and out of it to outside an exit.

    Attributes
    ----------
    stall
        Name of the stall.
    nose
        Nose in or nose out.
    entrance, exit
        Portals of the route.
    arrival, departure
        The two paths; the departure begins where the arrival ends.
    is_full
        True if the paths are collision-free with a car in every other stall.
    """

    stall: str
    nose: Nose
    entrance: Portal
    exit: Portal
    arrival: Path
    departure: Path
    is_full: bool


class Router:
    """Router of one garage, with shared caches.

    Parameters
    ----------
    road
        The garage.
    steerings
        Steerings of the car on lanes, the most comfortable first.
    car, limits
        The car, and the limits of its manoeuvres.
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
        self._through = lru_cache(maxsize=None)(self._found_through)

    def portals(self, kind: LaneKind) -> tuple[Portal, ...]:
        """Return the entrances or the exits, in reading order."""
        return tuple(portal for portal in self._road.portals if portal.kind is kind)

    def route(
        self,
        stall: Stall,
        *,
        proof: StallProof | None = None,
        entrances: Iterable[Portal] | None = None,
        exits: Iterable[Portal] | None = None,
    ) -> Route | StallProof:
        """Return the shortest route found into a stall and out of it, or the proof that explains why there is none.

        Parameters
        ----------
        stall
            A stall of the garage.
        proof
            Proof of the stall, if known.
        entrances, exits
            Permitted portals; the default is all.
        """
        proof = proof or self.proof_of(stall)
        if proof.nose is None or proof.way_in is None or proof.way_out is None:
            return proof
        entrances = self.portals(LaneKind.ENTRANCE) if entrances is None else tuple(entrances)
        exits = self.portals(LaneKind.EXIT) if exits is None else tuple(exits)
        arrival, departure = self.arrival(stall, proof, entrances), self.departure(stall, proof, exits)
        if arrival is None or departure is None:
            return replace(
                proof, way_in=proof.way_in if arrival else None, way_out=proof.way_out if departure else None
            )
        return Route(stall.name, proof.nose, arrival[1], departure[1], arrival[0], departure[0], proof.is_full)

    def proof_of(self, stall: Stall) -> StallProof:
        """Search the proof of a stall."""
        (proof,) = prove_garage(self._road.garage, [stall], car=self._car, limits=self._limits)
        return proof

    def arrival(self, stall: Stall, proof: StallProof, entrances: Sequence[Portal]) -> tuple[Path, Portal] | None:
        """Return the shortest path found from outside one of some entrances into a proven stall."""
        assert proof.way_in is not None
        return self._led(stall, proof.way_in.end, entrances, proof.way_in, is_full=proof.is_full, is_back=True)

    def departure(
        self, stall: Stall, proof: StallProof, exits: Sequence[Portal], *, parked: Pose | None = None
    ) -> tuple[Path, Portal] | None:
        """Return the shortest path found out of a proven stall to outside one of some exits.

        `parked` is the pose of the car in the stall, if it is another one than at the end of the arrival.
        """
        assert proof.way_out is not None
        if parked is None:
            return self._led(stall, proof.way_out.start, exits, proof.way_out, is_full=proof.is_full, is_back=False)
        return self._led(stall, parked, exits, None, is_full=proof.is_full, is_back=False)

    def through(self, entrance: Portal, exits: Sequence[Portal]) -> tuple[Path, Portal] | None:
        """Return the shortest path found from an entrance through the garage to one of some exits; it is kept."""
        return self._through(entrance, tuple(exits))

    def _found_through(self, entrance: Portal, exits: tuple[Portal, ...]) -> tuple[Path, Portal] | None:
        for is_full in (True, False):
            found = self._roadmap(is_full).network.through(entrance, exits)
            if found is not None:
                return found
            for grain in GRAINS:
                found = path_between_portals(self._roadmap(is_full), entrance, exits, grain)
                if found is not None:
                    return found
        return None

    def _led(
        self,
        stall: Stall,
        parked: Pose,
        portals: Sequence[Portal],
        proven: Manoeuvre | None,
        *,
        is_full: bool,
        is_back: bool,
    ) -> tuple[Path, Portal] | None:
        """Extend the proven manoeuvre to a portal, or back to one; otherwise find another from the same parked pose."""
        roadmap = self._roadmap(is_full)
        garage = self._road.garage
        used = garage.lanes.arriving if is_back else garage.lanes.leaving
        poses = roadmap.roomy_poses([arc for arc in garage.near(stall.access) if arc in used], is_back=is_back)
        standing = self._standing(is_full).without(garage.unseen(stall))
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
            chain([proven] if proven else [], ways(self._limits, together)),
            chain(ways(self._limits, each), ways(further, together), ways(further, each)),
            ways(further, together, find_guided_way),
        )
        # test all ways of a round coarsely before testing any of them finely
        for found in rounds:
            kept: list[Manoeuvre] = []
            for grain in (None, *GRAINS):
                for way in kept[:] if kept else found:
                    if grain is None:
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
    roadmap: Roadmap, way: Manoeuvre, portals: Sequence[Portal], grain: Grain | None, *, is_back: bool
) -> tuple[Path, Portal] | None:
    """Join a manoeuvre between a lane and a stall with the path over lanes before or after it."""
    parking = Path.of_way(way)
    if grain is None:
        found = roadmap.network.led(parking.start if is_back else parking.end, portals, is_back=is_back)
    elif is_back:
        found = path_from_entrance(roadmap, parking.start, portals, grain)
    else:
        found = path_to_exit(roadmap, parking.end, portals, grain)
    if found is None:
        return None
    return (found[0].then(parking.pieces) if is_back else parking.then(found[0].pieces)), found[1]
