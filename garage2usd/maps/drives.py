"""Planning of a drive through a garage: from stall, entrance and exit to the car's motion."""

from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from garage2usd.as_built.driven_road import driven_road
from garage2usd.as_built.garage import BuiltGarage
from garage2usd.common.errors import ConfigError
from garage2usd.common.spelling import find_named, spans_in_words
from garage2usd.config.maps import DriveConfig, Leg
from garage2usd.driving import DesignCar, Portal, StallProof
from garage2usd.driving.route import Route, Router
from garage2usd.driving.timing import Motion, timed
from garage2usd.driving.trajectory import Trajectory
from garage2usd.driving.turns import Steering
from garage2usd.garage import LaneKind, Stall

__all__ = ["Drive", "DrivePlanner", "portals_asked", "unknown_stall"]

_NAMED = 6
_STEP_S = 0.05


@dataclass(frozen=True, eq=False)
class Drive:
    """A drive of a car that enters, parks and leaves a garage, or a leg of it.

    Attributes
    ----------
    route
        Route of the car.
    leg
        Leg of the drive.
    motion
        Motion of the car over time.
    car, settings
        The car, and the limits of its motion.
    """

    route: Route
    leg: Leg
    motion: Motion
    car: DesignCar
    settings: DriveConfig

    @cached_property
    def trajectory(self) -> Trajectory:
        """States of the car every 0.05 s, and at the times of starts, stops and finished steering."""
        return self.motion.sampled(_STEP_S)

    @property
    def facts(self) -> Mapping[str, object]:
        """Facts about the drive besides its states."""
        return {
            "stall": self.route.stall,
            "leg": self.leg.value,
            "nose": self.route.nose.value,
            "entrance": self.route.entrance.name if self.leg is not Leg.OUT else None,
            "exit": self.route.exit.name if self.leg is not Leg.IN else None,
            "clear_with_all_stalls_taken": self.route.is_full,
            "settings": self.settings.model_dump(mode="json"),
        }


class DrivePlanner:
    """Planner of drives through one garage, which reuses searches between stalls.

    Parameters
    ----------
    garage
        The garage.
    settings, car
        Limits of the car's motion, and the car.

    Raises
    ------
    ConfigError
        If the garage's file has no lanes from an entrance to an exit.
    """

    def __init__(
        self, garage: BuiltGarage, settings: DriveConfig | None = None, *, car: DesignCar | None = None
    ) -> None:
        self._settings, self._car = settings or DriveConfig(), car or DesignCar()
        if not garage.has_whole_graph or not garage.lanes.portals("entrance") or not garage.lanes.portals("exit"):
            raise ConfigError("PATH", garage.source, "a garage whose lanes join an entrance and an exit")
        self.road = driven_road(garage, car=self._car)
        curvature, wheelbase_m = 1 / self._car.rear_axle_radius_m, self._car.wheelbase_m
        # as fast as on a lane, or so slowly that the wheels turn on less way
        rate, fast_m_s = self._settings.steering_rate_rad_s, self._settings.lane_speed_m_s
        speeds_m_s = (fast_m_s, min(fast_m_s, self._settings.parking_speed_m_s))
        steerings = [Steering(curvature, rate / (wheelbase_m * speed)) for speed in speeds_m_s]
        self.router = Router(self.road, steerings, car=self._car)
        self._outlines = {stall.name: stall for stall in garage.parking_stalls}
        self._taken = {stall.name for stall in garage.taken_stalls}
        self._driven = {stall.name: stall for stall in self.road.garage.stalls}
        self._others = {stall.name: _names(stall) for stall in garage.stalls if stall.name not in self._outlines}

    def route_of(self, stall: str | None, *, entrances: Sequence[Portal], exits: Sequence[Portal]) -> Route:
        """Return the route from one of some entrances into a stall, and out to one of some exits.

        Parameters
        ----------
        stall, entrances, exits
            As for `drive`, the portals by themselves.

        Raises
        ------
        ConfigError
            If the stall does not exist, or no such route is found.
        """
        if not (entrances and exits):
            raise ConfigError("stall", stall, "a stall that lanes and ramps join with the street")
        lacks: Counter[str] = Counter()
        for candidate in self._in_order() if stall is None else [self._stall(stall)]:
            route = self.router.route(candidate, entrances=entrances, exits=exits)
            if isinstance(route, Route):
                return route
            lacks[_lack(route)] += 1
        lack = lacks.most_common(1)[0][0] if lacks else "a garage with a stall that takes a car"
        raise ConfigError("stall", f"any of {lacks.total()}" if stall is None else stall, lack)

    def drive(
        self,
        stall: str | None = None,
        *,
        entrance: int | None = None,
        exit: int | None = None,  # noqa: A002 - the garage's word
        leg: Leg = Leg.BOTH,
    ) -> Drive:
        """Plan the drive to a stall and away from it.

        Parameters
        ----------
        stall
            Name of the stall or its painted number, case-insensitive. If left out, the first free stall in the garage's
            order with a feasible drive, or else the first stall with one.
        entrance, exit
            Numbers from 1 in the order of the squares, by rows; if left out, those of the shortest route.
        leg
            Leg to drive: to the stall, away from it, or both.

        Raises
        ------
        ConfigError
            If the stall, entrance or exit does not exist, or no drive connects them.
        """
        route = self.route_of(
            stall,
            entrances=portals_asked("entrance", entrance, self.router.portals(LaneKind.ENTRANCE)),
            exits=portals_asked("exit", exit, self.router.portals(LaneKind.EXIT)),
        )
        return Drive(route, leg, self._motion(route, leg), self._car, self._settings)

    def _motion(self, route: Route, leg: Leg) -> Motion:
        path, parked_after = route.arrival, None
        if leg is Leg.OUT:
            path = route.departure
        elif leg is Leg.BOTH:
            path, parked_after = route.arrival.then(route.departure.pieces), len(route.arrival.pieces)
        return timed(path, self._settings, car=self._car, ramps=self.road.ramps, parked_after=parked_after)

    def _stall(self, asked: str) -> Stall:
        names = find_named(asked, {name: _names(outline) for name, outline in self._outlines.items()})
        if len(names) == 1:
            return self._driven[names[0]]
        if find_named(asked, self._others):
            raise ConfigError("stall", asked, "a stall that takes a car, which this one does not")
        raise unknown_stall(asked, self._outlines.values(), names)

    def _in_order(self) -> list[Stall]:
        """Order the stalls for cars as in the garage, free ones first."""
        return sorted((self._driven[name] for name in self._outlines), key=lambda stall: stall.name in self._taken)


def portals_asked(field: str, number: int | None, portals: Sequence[Portal]) -> tuple[Portal, ...]:
    """Return the entrance or exit of a number from 1 on, or all of them.

    Raises
    ------
    ConfigError
        If none has the number; it names `field`.
    """
    if number is None:
        return tuple(portals)
    if not 1 <= number <= len(portals):
        raise ConfigError(field, number, f"1 to {len(portals)}" if len(portals) > 1 else "1")
    return (portals[number - 1],)


def unknown_stall(asked: str, stalls: Collection[Stall], found: Sequence[str]) -> ConfigError:
    """Make the error on a stall that no stall, or several are called; it lists the painted numbers."""
    if found:
        return ConfigError("stall", asked, f"a number that is painted once, or else a name: {', '.join(found)}")
    known = spans_in_words(str(stall.number or stall.name) for stall in stalls)
    return ConfigError("stall", asked, f"one of the garage's {len(stalls)} stalls: {known}")


def _names(stall: Stall) -> list[str]:
    """Return the name of a stall and its painted number."""
    return [stall.name] if stall.number is None else [stall.name, str(stall.number)]


def _lack(proof: StallProof) -> str:
    """Explain why a stall cannot be the target of a drive."""
    if proof.touched or proof.is_undecided:
        named = ", ".join(proof.touched[:_NAMED]) or "nothing"
        how = "in the way" if proof.is_single_cause else "touched"
        undecided = "; undecided, as the search ended at its bound" if proof.is_undecided else ""
        return f"a stall that the design car gets into and out of{undecided}; {how}: {named}"
    if proof.nose is None:
        return "a stall beside a lane that is driven to from an entrance and on to an exit without turning round"
    ways = [name for name, way in (("from the entrance", proof.way_in), ("to the exit", proof.way_out)) if way is None]
    return f"a stall with a path over the lanes {' and '.join(ways)}, on which none was found that is smooth and clear"
