"""Routes of a car on one level of a garage: from a portal or landing into a stall, and out to another."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

from garage2usd.as_built.driven_road import driven_road
from garage2usd.as_built.level import BuiltLevel
from garage2usd.common.errors import ConfigError
from garage2usd.config.outputs import DriveConfig
from garage2usd.driving import DesignCar, Portal, Pose, StallProof
from garage2usd.driving.path import Path
from garage2usd.driving.route import Route, Router
from garage2usd.driving.turns import Steering
from garage2usd.objects.cone import KIND as CONE

_NAMED = 6


class LevelRoutes:
    """Routes on one level of a garage; searches are reused between stalls.

    Parameters
    ----------
    level
        The level.
    settings, car
        Limits of the car's motion, and the car.
    are_stalls_changing
        True if other cars may take the place of the parked ones: paths are then clear of both, and of cones in the
        stall itself.

    Raises
    ------
    ConfigError
        If the level has no lanes from an entrance to an exit.
    """

    def __init__(
        self, level: BuiltLevel, settings: DriveConfig, car: DesignCar, *, are_stalls_changing: bool = False
    ) -> None:
        if not level.has_whole_graph or not level.lanes.portals("entrance") or not level.lanes.portals("exit"):
            raise ConfigError("PATH", level.source, "a garage whose lanes join an entrance and an exit")
        self.road = driven_road(level, car=car)
        if are_stalls_changing:
            # a parked car leaves its stall, but cones in it stay in the way
            cones = {thing.name for thing in level.things if thing.label == CONE.label}
            own = {
                stall: tuple(name for name in names if name not in cones)
                for stall, names in self.road.garage.own.items()
            }
            self.road = replace(self.road, garage=replace(self.road.garage, taken=frozenset(), own=own))
        curvature, wheelbase_m = 1 / car.rear_axle_radius_m, car.wheelbase_m
        # as fast as on a lane, or so slowly that the wheels turn on less way
        rate, fast_m_s = settings.steering_rate_rad_s, settings.lane_speed_m_s
        speeds_m_s = (fast_m_s, min(fast_m_s, settings.parking_speed_m_s))
        steerings = [Steering(curvature, rate / (wheelbase_m * speed)) for speed in speeds_m_s]
        self.router = Router(self.road, steerings, car=car)
        self._names = [stall.name for stall in level.parking_stalls]
        self._taken = {stall.name for stall in level.taken_stalls}
        self._driven = {stall.name: stall for stall in self.road.garage.stalls}

    def proof_of(self, stall: str) -> StallProof:
        """Return the proof of a stall of the level."""
        return self.router.proof_of(self._driven[stall])

    def leg_of(
        self, stall: str, proof: StallProof, portals: Sequence[Portal], *, parked: Pose | None, is_in: bool
    ) -> tuple[Path, Portal] | None:
        """Return the shortest path found from one of some portals into a proven stall, or out of it to one."""
        if is_in:
            return self.router.arrival(self._driven[stall], proof, portals)
        return self.router.departure(self._driven[stall], proof, portals, parked=parked)

    def route_of(self, stall: str | None, *, entrances: Sequence[Portal], exits: Sequence[Portal]) -> Route:
        """Return the route from one of some entrances into a stall, and out to one of some exits.

        Parameters
        ----------
        stall
            Name of the stall within the level. If left out, the first free stall in the level's order with a feasible
            route, or else the first stall with one.
        entrances, exits
            The portals and landings that the route may begin and end at.

        Raises
        ------
        ConfigError
            If no such route is found.
        """
        if not (entrances and exits):
            raise ConfigError("stall", stall, "a stall that lanes and ramps join with the street")
        lacks: Counter[str] = Counter()
        # as on the level, free stalls first
        every = sorted((self._driven[name] for name in self._names), key=lambda stall: stall.name in self._taken)
        for candidate in every if stall is None else [self._driven[stall]]:
            route = self.router.route(candidate, entrances=entrances, exits=exits)
            if isinstance(route, Route):
                return route
            lacks[_lack(route)] += 1
        lack = lacks.most_common(1)[0][0] if lacks else "a garage with a stall that takes a car"
        raise ConfigError("stall", f"any of {lacks.total()}" if stall is None else stall, lack)


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
