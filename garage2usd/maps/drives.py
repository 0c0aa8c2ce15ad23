"""A drive through a garage, from what is asked for to the car's motion."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from garage2usd.as_built.driven_road import driven_road
from garage2usd.as_built.garage import BuiltGarage
from garage2usd.common.errors import ConfigError
from garage2usd.common.spelling import called
from garage2usd.config.maps import DriveConfig, Leg
from garage2usd.driving import DesignCar, Portal, StallProof
from garage2usd.driving.route import Route, Router
from garage2usd.driving.timing import Motion, timed
from garage2usd.driving.trajectory import Trajectory
from garage2usd.driving.turns import Steering
from garage2usd.garage import LaneKind, Stall

__all__ = ["Drive", "DrivePlanner"]

_NAMED = 6
_STEP_S = 0.05


@dataclass(frozen=True, eq=False)
class Drive:
    """A car that comes, parks and leaves, or one part of that.

    Attributes
    ----------
    route
        Where it drives.
    leg
        Which part.
    motion
        When it is where.
    car, settings
        The car, and its limits.
    """

    route: Route
    leg: Leg
    motion: Motion
    car: DesignCar
    settings: DriveConfig

    @cached_property
    def trajectory(self) -> Trajectory:
        """Its states every 0.05 s, and at the times at which the car starts, stops, or has turned its wheels."""
        return self.motion.sampled(_STEP_S)

    @property
    def facts(self) -> Mapping[str, object]:
        """What is to be said of it beside its states."""
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
    """Plans drives through one garage; what was found for one stall serves the next.

    Parameters
    ----------
    garage
        The garage.
    settings, car
        Limits of the car's motion, and the car.

    Raises
    ------
    ConfigError
        If the garage's file tells of no lanes that lead from an entrance to an exit.
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
        self._router = Router(self.road, steerings, car=self._car)
        self._outlines = {stall.name: stall for stall in garage.parking_stalls}
        self._taken = {stall.name for stall in garage.taken_stalls}
        self._driven = {stall.name: stall for stall in self.road.garage.stalls}
        self._others = {stall.name: _names(stall) for stall in garage.stalls if stall.name not in self._outlines}

    def drive(
        self,
        stall: str | None = None,
        *,
        entrance: int | None = None,
        exit: int | None = None,  # noqa: A002 - the garage's word
        leg: Leg = Leg.BOTH,
    ) -> Drive:
        """The drive to a stall and away from it.

        Parameters
        ----------
        stall
            Its name, or the number painted in it where it has one, in letters of whatever case; left out, the first in
            the garage's order that is free and that a drive is found for, or where there is none the first that a drive
            is found for.
        entrance, exit
            From 1 on in the order of the squares, by rows; left out, those with the shortest way.
        leg
            Whether the car comes, leaves, or does both.

        Raises
        ------
        ConfigError
            If there is no such stall, entrance or exit, or no way is found between them.
        """
        entrances = self._chosen("entrance", entrance, LaneKind.ENTRANCE)
        exits = self._chosen("exit", exit, LaneKind.EXIT)
        candidates = self._in_order() if stall is None else [self._stall(stall)]
        route: Route | StallProof | None = None
        for candidate in candidates:
            route = self._router.route(candidate, entrances=entrances, exits=exits)
            if isinstance(route, Route):
                break
        if not isinstance(route, Route):
            lack = "a garage with a stall that a drive is found for" if stall is None or route is None else _lack(route)
            raise ConfigError("stall", stall, lack)
        return Drive(route, leg, self._motion(route, leg), self._car, self._settings)

    def _motion(self, route: Route, leg: Leg) -> Motion:
        path, parked_after = route.arrival, None
        if leg is Leg.OUT:
            path = route.departure
        elif leg is Leg.BOTH:
            path, parked_after = route.arrival.then(route.departure.pieces), len(route.arrival.pieces)
        return timed(path, self._settings, car=self._car, ramps=self.road.ramps, parked_after=parked_after)

    def _stall(self, asked: str) -> Stall:
        names = called(asked, {name: _names(outline) for name, outline in self._outlines.items()})
        if len(names) == 1:
            return self._driven[names[0]]
        if called(asked, self._others):
            raise ConfigError("stall", asked, "a stall that takes a car, which this one does not")
        known = ", ".join([*self._outlines][:_NAMED]) + (", ..." if len(self._outlines) > _NAMED else "")
        raise ConfigError("stall", asked, f"one of the garage's {len(self._outlines)} stalls: {known}")

    def _in_order(self) -> list[Stall]:
        """The stalls that cars park in, as the garage has them, the free ones first."""
        return sorted((self._driven[name] for name in self._outlines), key=lambda stall: stall.name in self._taken)

    def _chosen(self, field: str, number: int | None, use: LaneKind) -> tuple[Portal, ...]:
        portals = self._router.portals(use)
        if number is None:
            return portals
        if not 1 <= number <= len(portals):
            raise ConfigError(field, number, f"1 to {len(portals)}" if len(portals) > 1 else "1")
        return (portals[number - 1],)


def _names(stall: Stall) -> list[str]:
    """The name of a stall, and what is painted in it."""
    return [stall.name] if stall.number is None else [stall.name, str(stall.number)]


def _lack(proof: StallProof) -> str:
    """What a stall must be to be driven to, with what is in the way of this one."""
    if proof.touched or proof.is_undecided:
        named = ", ".join(proof.touched[:_NAMED]) or "nothing"
        how = "in the way" if proof.is_single_cause else "touched"
        undecided = "; undecided, as the search ended at its bound" if proof.is_undecided else ""
        return f"a stall that the design car gets into and out of{undecided}; {how}: {named}"
    if proof.nose is None:
        return "a stall beside a lane that is driven to from an entrance and on to an exit without turning round"
    ways = [name for name, way in (("from the entrance", proof.way_in), ("to the exit", proof.way_out)) if way is None]
    return f"a stall with a path over the lanes {' and '.join(ways)}, on which none was found that is smooth and clear"
