"""Drives through a garage: from the street over lanes and ramps into a stall, and back to the street."""
# Over 300 lines: ways over straight ramps and helices differ in their pieces alone, so they stand beside each other.

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

from garage2usd.as_built.driven_road import BEYOND_TOP_M, bent_floors, portal_mouths, ramp_sides
from garage2usd.as_built.garage import BuiltGarage
from garage2usd.as_built.ramp_line import Bend, RampLine
from garage2usd.common.errors import ConfigError
from garage2usd.common.spelling import find_named, spans_in_words
from garage2usd.config.outputs import DriveConfig, Leg
from garage2usd.driving import BentFloor, DesignCar, Portal, Pose, RampFloor, StallProof
from garage2usd.driving.line_fit import pieces_along
from garage2usd.driving.manoeuvre import Gear
from garage2usd.driving.path import Path, Piece
from garage2usd.driving.road import FloorSpan
from garage2usd.driving.route import Route
from garage2usd.driving.timing import Motion, timed
from garage2usd.driving.trajectory import Trajectory
from garage2usd.garage import LaneKind, Stall
from garage2usd.maps.level_routes import LevelRoutes
from garage2usd.maps.narrow_aisles import narrow_aisles

_STEP_S = 0.05
_BEYOND_FOOT_M = 2.0
_EASING_M = 8.0
"""Length of the clothoids on a helix between straights and circle: the car's rear then runs inside its middle line by
about as much as its front runs outside."""
_TURN_RAD = 1.5 * math.pi
_HALVINGS = 60
_ASIDE_M = 1e-3
"""Distance from the line straight ahead within which the landing at the other end of a ramp is driven to straight."""

_Street = Mapping[LaneKind, tuple[Portal, ...]]
"""Entrances and exits to the street that a drive may use."""


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
    narrow_aisles
        The two-way aisles in whose middle the car drives, as they are too narrow for two cars, one line for each.
    """

    route: Route
    leg: Leg
    motion: Motion
    car: DesignCar
    settings: DriveConfig
    narrow_aisles: tuple[str, ...] = ()

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
            "narrow_aisles": list(self.narrow_aisles),
            "settings": self.settings.model_dump(mode="json"),
        }


@dataclass(frozen=True, eq=False)
class DrivenLeg:
    """A path between the street and a stall.

    Attributes
    ----------
    path
        The path.
    portal
        The portal to the street at its other end.
    spans
        The floors along the path.
    stretches
        Length, level and whether it is a ramp, of each stretch; of a ramp the upper level.
    is_full
        True if it is clear of a car in every other stall.
    """

    path: Path
    portal: Portal
    spans: tuple[FloorSpan, ...]
    stretches: tuple[tuple[float, int, bool], ...]
    is_full: bool


@dataclass(frozen=True)
class RoutePart:
    """A part of a route: the path on one level, or over a ramp between two levels.

    Attributes
    ----------
    pieces
        Pieces of the path.
    level
        Number of the level, the upper one of a ramp.
    is_ramp
        True on a ramp.
    is_bent
        True on a ramp that bends: it begins and ends on landings.
    """

    pieces: tuple[Piece, ...]
    level: int
    is_ramp: bool = False
    is_bent: bool = False

    @property
    def length_m(self) -> float:
        """Length of its path as seen from above."""
        return sum(piece.length_m for piece in self.pieces)


class PlannedRoute(NamedTuple):
    """A route, and the parts of its two paths in the order of driving.

    Attributes
    ----------
    route
        The route.
    arrival, departure
        Parts of the paths into the stall and out of it.
    """

    route: Route
    arrival: tuple[RoutePart, ...]
    departure: tuple[RoutePart, ...]


class DrivePlanner:
    """Planner of drives through a garage.

    Parameters
    ----------
    garage
        The garage.
    settings, car
        Limits of the car's motion, and the car.
    are_stalls_changing
        True if other cars may take the place of the parked ones: paths are then clear of both.

    Notes
    -----
    Each level is driven between its portals and landings (`garage2usd.maps.level_routes`), among the obstacles of this
    level only. Straight ramps are driven along the line through their landings, helices on clothoids and a circle, and
    other ramps on clothoids that are fitted to their line.
    """

    def __init__(
        self,
        garage: BuiltGarage,
        settings: DriveConfig | None = None,
        *,
        car: DesignCar | None = None,
        are_stalls_changing: bool = False,
    ) -> None:
        self._garage, self._settings, self._car = garage, settings or DriveConfig(), car or DesignCar()
        self._are_stalls_changing = are_stalls_changing
        self._routes: dict[int, LevelRoutes] = {}
        self._bent: dict[int, tuple[BentFloor, ...]] = {}
        self._proofs: dict[str, StallProof] = {}

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
            Name of the stall, or its number with its level, ``U2/B2-07``; case-insensitive. If left out, the first free
            stall of the lowest level with a feasible drive, or else the first stall of that level with one.
        entrance, exit
            Numbers of the portals to the street, from 1 in the order of the squares, by rows; if left out, those of the
            shortest route.
        leg
            Leg to drive: to the stall, away from it, or both.

        Raises
        ------
        ConfigError
            If the stall, entrance or exit does not exist, or no drive connects them.
        """
        planned = self.route(stall, entrance=entrance, exit=exit)
        route = planned.route
        parts = {Leg.IN: planned.arrival, Leg.OUT: planned.departure, Leg.BOTH: planned.arrival + planned.departure}[
            leg
        ]
        whole = route.arrival.then(route.departure.pieces)
        path = {Leg.IN: route.arrival, Leg.OUT: route.departure, Leg.BOTH: whole}[leg]
        parked_after = len(route.arrival.pieces) if leg is Leg.BOTH else None
        motion = timed(path, self._settings, car=self._car, parked_after=parked_after, spans=self.spans(parts))
        return Drive(route, leg, motion, self._car, self._settings, self._narrow_aisles(path.start, parts))

    def _narrow_aisles(self, start: Pose, parts: Sequence[RoutePart]) -> tuple[str, ...]:
        """Return the aisles along the parts of a path that are too narrow to keep to one side, one line for each."""
        lines: dict[str, None] = {}
        for part in parts:
            path, level = Path(start, part.pieces), self._garage.levels[part.level]
            if not part.is_ramp:
                for aisle in narrow_aisles(path, level.lanes, self._car):
                    lines[str(aisle) if level.place.is_only else f"{level.place.name}: {aisle}"] = None
            start = path.end
        return tuple(lines)

    def route(
        self,
        stall: str | None = None,
        *,
        entrance: int | None = None,
        exit: int | None = None,  # noqa: A002 - the garage's word
    ) -> PlannedRoute:
        """Find the route to a stall and away from it, without its timing; parameters and errors as of `drive`."""
        found = None if stall is None else self._stall(stall)
        driven = self._garage.lanes.driven
        joined = [each for each in self._garage.stalls if each.takes_cars and each.access in driven]
        if not joined or (found is not None and found not in joined):
            raise ConfigError("stall", stall, "a stall that lanes and ramps join with the street")
        level = max(each.level for each in joined) if found is None else found.level
        way = self._way_to_street(level)
        street = {
            kind: _portals_asked(field, number, self._ends(way[-1], kind, None))
            for kind, field, number in (
                (LaneKind.ENTRANCE, "entrance", entrance),
                (LaneKind.EXIT, "exit", exit),
            )
        }
        place = self._garage.levels[level].place
        route = self._on(level).route_of(
            None if found is None else place.own_name(found.name),
            entrances=self._towards_street(way, LaneKind.ENTRANCE, street),
            exits=self._towards_street(way, LaneKind.EXIT, street),
        )
        into, start = self._led(way, route.entrance, RoutePart(route.arrival.pieces, level), street, is_in=True)
        out, end = self._led(way, route.exit, RoutePart(route.departure.pieces, level), street, is_in=False)
        arrival = Path(start.pose, tuple(piece for part in into for piece in part.pieces))
        departure = Path(route.departure.start, tuple(piece for part in out for piece in part.pieces))
        whole = Route(place.in_whole(route.stall), route.nose, start, end, arrival, departure, route.is_full)
        return PlannedRoute(whole, tuple(into), tuple(out))

    def spans(self, parts: Sequence[RoutePart]) -> tuple[FloorSpan, ...]:
        """Return the floors along the parts of a path; the level changes half way on a ramp.

        A path on a level begins and ends at the tops of the ramps from above, and on the landings of those from below.
        """
        spans: list[FloorSpan] = []
        along = 0.0
        for before, part, after in zip([None, *parts], parts, [*parts[1:], None], strict=False):
            end = along + part.length_m
            ramps = [each for each in (before, after) if each is not None and each.is_ramp and not each.is_bent]
            if part.is_bent and before is not None and after is not None:
                floors = self._bent_floors(part.level + 1)
                for end_m, level in ((along + part.length_m / 2, before.level), (end, after.level)):
                    spans.append(FloorSpan(end_m, self._garage.levels[level].place.floor_m, floors))
            elif not part.is_ramp:
                upper = ramps[-1].level if ramps else None
                if len(ramps) > 1:
                    # ramps to both levels overlap in plan; switch between them at the foot of the upper one
                    is_down = ramps[1].level == part.level
                    foot_m = self._ramp_m(part.level) + _BEYOND_FOOT_M
                    change_m = along + foot_m if is_down else end - foot_m
                    spans.append(self._span(change_m, part.level, ramps[0].level))
                reach_m = 0.0
                if after is not None and after in ramps:
                    is_down = after.level == part.level
                    half_m = self._ramp_m(after.level + 1) / 2
                    reach_m = after.length_m + half_m if is_down else -half_m
                spans.append(self._span(end + reach_m, part.level, upper))
            along = end
        return tuple(spans)

    @property
    def keeps_left(self) -> bool:
        """True where traffic keeps to the left."""
        return self._on(0).road.keeps_left

    def proof_of(self, stall: Stall) -> StallProof:
        """Return the proof of a stall of the whole garage, searched once."""
        if stall.name not in self._proofs:
            own = self._garage.levels[stall.level].place.own_name(stall.name)
            self._proofs[stall.name] = self._on(stall.level).proof_of(own)
        return self._proofs[stall.name]

    def leg(self, stall: Stall, leg: Leg, *, parked: Pose | None = None) -> DrivenLeg | None:
        """Return the shortest path found from the street into a stall, or out of it to the street; None without one.

        Parameters
        ----------
        stall
            A stall of the whole garage.
        leg
            `Leg.IN` or `Leg.OUT`.
        parked
            Pose of the car in the stall when it leaves, if it is another one than that of the proof.
        """
        proof, is_in = self.proof_of(stall), leg is Leg.IN
        if not proof.is_proven:
            return None
        kind = LaneKind.ENTRANCE if is_in else LaneKind.EXIT
        way = self._way_to_street(stall.level)
        street = {kind: self._ends(way[-1], kind, None)}
        portals = self._towards_street(way, kind, street)
        own = self._garage.levels[stall.level].place.own_name(stall.name)
        found = self._on(stall.level).leg_of(own, proof, portals, parked=parked, is_in=is_in)
        if found is None:
            return None
        path, portal = found
        try:
            parts, end = self._led(way, portal, RoutePart(path.pieces, stall.level), street, is_in=is_in)
        except ConfigError:
            return None
        whole = Path(end.pose if is_in else path.start, tuple(piece for part in parts for piece in part.pieces))
        stretches = tuple((part.length_m, part.level, part.is_ramp) for part in parts)
        return DrivenLeg(whole, end, self.spans(parts), stretches, proof.is_full)

    def is_driven_through(self) -> bool:
        """Return True if a drive is found from the street to the lowest level, and one from there back to the street.

        The first, the middle and the last stall of that level are tried.
        """
        lowest = len(self._garage.levels) - 1
        for level in range(lowest):
            router, out = self._on(level).router, level - 1 if level else None
            down = self._ends(level, LaneKind.ENTRANCE, out), self._ends(level, LaneKind.EXIT, level + 1)
            up = self._ends(level, LaneKind.ENTRANCE, level + 1), self._ends(level, LaneKind.EXIT, out)
            for entrances, exits in (down, up):
                if not any(router.through(entrance, exits) for entrance in entrances):
                    return False
        names = [stall.name for stall in self._garage.stalls if stall.takes_cars and stall.level == lowest]
        middle = len(names) // 2
        return any(self._is_driven_to(name) for name in (*names[:1], *names[middle : middle + 1], *names[-1:]))

    def _is_driven_to(self, stall: str) -> bool:
        try:
            self.drive(stall)
        except ConfigError:
            return False
        return True

    def _stall(self, asked: str) -> Stall:
        stalls = {stall.name: stall for stall in self._garage.stalls if stall.takes_cars}
        names = find_named(asked, {name: _names(stall) for name, stall in stalls.items()})
        if len(names) == 1:
            return stalls[names[0]]
        others = {stall.name: _names(stall) for stall in self._garage.stalls if not stall.takes_cars}
        if find_named(asked, others):
            raise ConfigError("stall", asked, "a stall that takes a car, which this one does not")
        raise _unknown_stall(asked, stalls.values(), names)

    def _on(self, level: int) -> LevelRoutes:
        if level not in self._routes:
            self._routes[level] = LevelRoutes(
                self._garage.levels[level],
                self._settings,
                self._car,
                are_stalls_changing=self._are_stalls_changing,
            )
        return self._routes[level]

    @cached_property
    def _beyond(self) -> dict[tuple[int, str], int]:
        """Level at the other end of the ramp at each landing, by the level and the name of the landing."""
        nodes = self._garage.lanes.nodes
        found = {}
        for line in self._garage.ramp_lines:
            ends = [nodes[number] for number in (line.nodes[0], line.nodes[-1])]
            for end, other in (ends, ends[::-1]):
                found[end.level, end.name.rpartition("/")[2]] = other.level
        return found

    def _ends(self, level: int, kind: LaneKind, other: int | None) -> tuple[Portal, ...]:
        """Return the portals of a level that lead to another level, or to the street if that is None."""
        landings = self._garage.levels[level].landings
        return tuple(
            portal
            for portal in self._on(level).router.portals(kind)
            if (self._beyond.get((level, portal.name)) == other if portal.name in landings else other is None)
        )

    def _way_to_street(self, level: int) -> tuple[int, ...]:
        """Return the levels from one to the nearest one with portals to the street, in the order of driving out."""
        ways: list[tuple[int, ...]] = [(level,)]
        for way in ways:
            if all(self._ends(way[-1], kind, None) for kind in (LaneKind.ENTRANCE, LaneKind.EXIT)):
                return way
            beside = sorted({other for (own, _), other in self._beyond.items() if own == way[-1]})
            seen = {each for known in ways for each in known}
            ways += [(*way, other) for other in beside if other not in seen]
        return (level,)

    def _towards_street(self, way: Sequence[int], kind: LaneKind, street: _Street) -> tuple[Portal, ...]:
        """Return the portals of the first level of a way to the next level, or else the chosen ones to the street."""
        return self._ends(way[0], kind, way[1]) if len(way) > 1 else street[kind]

    def _led(
        self, way: Sequence[int], portal: Portal, part: RoutePart, street: _Street, *, is_in: bool
    ) -> tuple[list[RoutePart], Portal]:
        """Extend a path from a level's landing to the street, or from the street to the landing, over all levels."""
        parts, end = [part], portal
        for number, (level, other) in enumerate(pairwise(way), 1):
            planner = self._on(other)
            pose, portal_name = end.pose, end.name
            if is_in:
                exits = self._ends(other, LaneKind.EXIT, level)
                entrances = self._towards_street(way[number:], LaneKind.ENTRANCE, street)
            else:
                exits = self._towards_street(way[number:], LaneKind.EXIT, street)
                entrances = self._ends(other, LaneKind.ENTRANCE, level)
            found = [
                (path, entrance, exit_)
                for entrance in entrances
                if (led := planner.router.through(entrance, exits)) is not None
                for path, exit_ in [led]
            ]
            if not found:
                raise ConfigError("stall", portal.name, f"a garage whose level {other + 1} is driven through")
            path, entrance, exit_ = min(found, key=lambda each: each[0].length_m)
            one, two = (path.end, pose) if is_in else (pose, path.start)
            names = (exit_.name, portal_name) if is_in else (portal_name, entrance.name)
            between = self._over_ramp(min(level, other), one, two, names)
            own = RoutePart(path.pieces, other)
            parts = [own, between, *parts] if is_in else [*parts, between, own]
            end = entrance if is_in else exit_
        return parts, end

    def _over_ramp(self, upper: int, one: Pose, other: Pose, landings: tuple[str, str]) -> RoutePart:
        """Return the path over the ramp below a level, between poses on its landings."""
        nodes = self._garage.lanes.nodes
        run_m = math.hypot(other.x_m - one.x_m, other.z_m - one.z_m)
        ahead = (Piece(Gear.FORWARD, run_m),)
        for line in self._garage.ramp_lines:
            ends = [nodes[number] for number in (line.nodes[0], line.nodes[-1])]
            names = tuple(end.name.rpartition("/")[2] for end in ends)
            if {end.level for end in ends} == {upper, upper + 1} and names == landings:
                bend, end = line.bend, Path(one, ahead).end
                if bend is not None:
                    return RoutePart(_round(bend, one, other), upper, is_ramp=True, is_bent=True)
                if not line.is_straight or math.hypot(end.x_m - other.x_m, end.z_m - other.z_m) > _ASIDE_M:
                    pieces = self._along(line, one, other, upper)
                    return RoutePart(pieces, upper, is_ramp=True, is_bent=not line.is_straight)
        return RoutePart(ahead, upper, is_ramp=True)

    def _along(self, line: RampLine, one: Pose, other: Pose, upper: int) -> tuple[Piece, ...]:
        """Return the pieces of the way over a ramp of any line, clear of its walls."""
        pieces = pieces_along(line.line, one, other, self._car)
        sides = ramp_sides(self._garage.levels[upper + 1].things)
        if pieces is None or Path(one, pieces).clearance_m(self._car, sides) <= 0:
            wanted = "a garage whose ramps bend so widely that the car gets round between their walls"
            raise ConfigError("stall", self._garage.lanes.nodes[line.nodes[0]].name, wanted)
        return pieces

    def _bent_floors(self, lower: int) -> tuple[BentFloor, ...]:
        """Return the floors of the ramps that bend down to a level, at their heights in the garage."""
        if lower not in self._bent:
            level = self._garage.levels[lower]
            floors = bent_floors(level.things)
            self._bent[lower] = tuple(floor.lifted(level.place.floor_m) for floor in floors)
        return self._bent[lower]

    def _to_the_street(self, level: int) -> tuple[RampFloor, ...]:
        """Return the floors of the ramps between a level and the street."""
        if level == 0:
            return self._on(0).road.ramps
        built = self._garage.levels[level]
        mouths = [mouth for mouth in portal_mouths(built) if built.lanes.nodes[mouth.number].name not in built.landings]
        return tuple(mouth.ramp for mouth in mouths if mouth.ramp is not None)

    def _ramp_m(self, lower: int) -> float:
        """Return the length of the ramps down to a level, as seen from above."""
        runs_m = [float(ramp.runs_m[-1] - ramp.runs_m[0]) for ramp in self._on(lower).road.ramps]
        if not runs_m:
            name = self._garage.levels[lower].place.name
            raise ConfigError("stall", name, "a level whose ramps have a straight floor to drive on")
        return max(runs_m)

    def _span(self, end_m: float, level: int, upper: int | None) -> FloorSpan:
        """Return the floors of a level with the ramps down from an upper level, and with those to the street."""
        own_m = self._garage.levels[level].place.floor_m
        ramps = [_lifted(ramp, own_m, math.inf) for ramp in self._to_the_street(level)]
        if upper is not None:
            foot_m = self._garage.levels[upper + 1].place.floor_m
            ramps += [
                _lifted(ramp, foot_m, float(ramp.runs_m[-1]) + BEYOND_TOP_M) for ramp in self._on(upper + 1).road.ramps
            ]
        return FloorSpan(end_m, own_m, tuple(ramps))


def _portals_asked(field: str, number: int | None, portals: Sequence[Portal]) -> tuple[Portal, ...]:
    """Return the entrance or exit of a number, counted from 1; all of them for None.

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


def _unknown_stall(asked: str, stalls: Collection[Stall], found: Sequence[str]) -> ConfigError:
    """Return the error for a stall name that matches no stall, or several; it lists the painted numbers."""
    if found:
        return ConfigError("stall", asked, f"a number that is painted once, or else a name: {', '.join(found)}")
    known = spans_in_words(str(stall.number or stall.name) for stall in stalls)
    return ConfigError("stall", asked, f"one of the garage's {len(stalls)} stalls: {known}")


def _names(stall: Stall) -> list[str]:
    """Return the name of a stall and its painted number."""
    return [stall.name] if stall.number is None else [stall.name, str(stall.number)]


def _lifted(ramp: RampFloor, floor_m: float, end_m: float) -> RampFloor:
    return replace(ramp, heights_m=ramp.heights_m + floor_m, end_m=end_m)


def _round(bend: Bend, one: Pose, other: Pose) -> tuple[Piece, ...]:
    """Return the pieces of the way round a bend: straight, clothoid, circle, clothoid, straight."""
    (x, z), (in_x, in_z), (out_x, out_z) = bend.crossing, bend.way_in, bend.way_out
    sign = 1.0 if bend.is_left else -1.0
    low, high = bend.radius_m / 2, bend.radius_m
    for _ in range(_HALVINGS):  # until the circle between the clothoids is concentric with the bend
        radius = (low + high) / 2
        _, aside = _middle_of(radius)
        low, high = (low, radius) if aside > bend.radius_m else (radius, high)
    ahead, _ = _middle_of(radius)
    before = (x - one.x_m) * in_x + (z - one.z_m) * in_z + bend.radius_m - ahead
    after = (other.x_m - x) * out_x + (other.z_m - z) * out_z + bend.radius_m - ahead
    if min(before, after) < 0:
        raise ConfigError("stall", [x, z], "a garage whose helices have room for a car's steering before their circle")
    curvature = sign / radius
    circle_m = _TURN_RAD * radius - _EASING_M
    return (
        Piece(Gear.FORWARD, before),
        Piece(Gear.FORWARD, _EASING_M, 0.0, curvature),
        Piece(Gear.FORWARD, circle_m, curvature, curvature),
        Piece(Gear.FORWARD, _EASING_M, curvature, 0.0),
        Piece(Gear.FORWARD, after),
    )


def _middle_of(radius: float) -> tuple[float, float]:
    """Return the centre of the circle that a clothoid leads into: distances ahead and aside of its start."""
    end = Path(Pose(0.0, 0.0, 0.0), (Piece(Gear.FORWARD, _EASING_M, 0.0, 1 / radius),)).end
    # at yaw 0 a car looks along -Z, with its left at -X
    turned = _EASING_M / (2 * radius)
    return -end.z_m - radius * math.sin(turned), -end.x_m + radius * math.cos(turned)
