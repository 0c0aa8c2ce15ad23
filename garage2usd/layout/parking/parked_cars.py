"""Parked cars: bodies, poses and occupied stalls."""
# Over 300 lines: body and pose of a car depend on each other and on the adjacent cars.

import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise
from statistics import NormalDist
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.errors import ConfigError
from garage2usd.common.randomness import Step
from garage2usd.config import GarageConfig, ParkingConfig
from garage2usd.config.vehicles import CAR_BODIES, CarBody
from garage2usd.garage import Stall, StallKind, StallUse
from garage2usd.layout.draws import SquareDraws
from garage2usd.layout.parking.designation import room_for_charger_m
from garage2usd.layout.parking.fleet import Fleet
from garage2usd.layout.parking.stalls import WHEEL_STOP_FROM_REAR_M
from garage2usd.layout.placement import PlacedStall, Placement
from garage2usd.native import elementary
from garage2usd.objects.car import CarSpec
from garage2usd.objects.wheel_stop import WHEEL_STOP_HEIGHT_M, WHEEL_STOP_WIDTH_M
from garage2usd.structure.lane_graph import Square

_END_CLEARANCE_M = 0.1
"""Distance between a car and the entry of its stall."""
_REAR_CLEARANCE_M = 0.12
_LINE_M = 0.05
"""Half the width of a line, which car bodies between their lines do not touch."""
_ROW_END_M = 0.03
"""Distance of mirrors from the line at the end of a row, beside columns and walls."""
_GAP_M = 0.1
"""Distance between two adjacent cars, mirrors included."""
_OVER_M = (0.01, 0.08)
"""Range by which a car body reaches over the centre of a line."""
_FAR_OVER_M = (0.25, 0.75)
"""Range for a misparked car, whose body is less than half in the next stall."""
_SLANT_DEG = (4.0, 12.0)
_SLANTED_SHARE = 0.4
"""Share of the misparked cars at an angle, limited by the length of their stalls; an assumption."""
_DRAWS_A_CAR, _HABITS, _STATES = 7, 4, 3
_STEER_DEG = (-20.0, -10.0, 10.0, 20.0)
"""Steering angles of parked cars; few, so that cars share assets. Assumption."""
_TOUCH_M, _ROUNDING_M = 1e-3, 1e-9
_USUAL = NormalDist()


class ParkedCars(NamedTuple):
    """The parked cars of a garage.

    Attributes
    ----------
    cars
        The cars, in the order of their stalls.
    reaching
        For each car whose body stands over a line, the name of its stall and that of the stall that it reaches into.
    misparked
        Names of the stalls of misparked cars.
    """

    cars: list[Placement]
    reaching: dict[str, str]
    misparked: frozenset[str]

    @property
    def touched(self) -> set[str]:
        """Names of the stalls that cars occupy or reach into."""
        return {car.stall for car in self.cars if car.stall}.union(self.reaching.values())


@dataclass(frozen=True, slots=True)
class _Car:
    """A car before its lateral position in the stall is known; lengths in metres, angles in radians."""

    stall: PlacedStall
    body: CarBody
    paint: str
    is_reversed: bool
    yaw: float
    room_m: float
    side_share: float
    along_share: float
    steer_deg: float
    is_dusty: bool
    is_lit: bool

    def half_x(self, *, mirrors: bool = True) -> float:
        """Half of the car's extent across the stall."""
        # wheel arches protrude from the body
        width_m = None if mirrors else self.body.width_m + 0.02
        return self.body.half_extents_m(self.yaw, width_m=width_m)[0]

    @property
    def half_z(self) -> float:
        """Half of the car's extent along the stall."""
        return self.body.half_extents_m(self.yaw)[1]

    def placement(self, side_m: float) -> Placement:
        """The car at a lateral offset from the centre line of its stall."""
        rear_most = self.stall.length_m / 2 - _END_CLEARANCE_M - self.room_m + self.half_z
        along = rear_most + self.along_share * max(self.room_m - 2 * self.half_z, 0.0)
        turned = self.stall.yaw_rad + self.yaw + (math.pi if self.is_reversed else 0.0)
        spec = CarSpec(self.body.name, self.paint, self.steer_deg, self.is_dusty, self.is_lit)
        return self.stall.placement("Car", spec, (side_m, along), yaw_rad=round(math.remainder(turned, math.tau), 6))


class _Row:
    """Adjacent stalls of a square, from the left as seen looking out of their entries, and their cars."""

    def __init__(self, stalls: Sequence[PlacedStall], cars: Mapping[str, _Car], tight: Collection[str]) -> None:
        self.stalls = stalls
        self.width_m = stalls[0].width_m
        self.numbers = [number for number, stall in enumerate(stalls) if stall.name in cars]
        self.cars = {number: cars[stalls[number].name] for number in self.numbers}
        # far over a line, a car of an angled row would leave the row or stand on the adjacent wheel stop
        self.takes_misparked = stalls[0].stall_kind is StallKind.PERPENDICULAR
        self.is_tight = any(stall.name in tight for stall in stalls)
        self.limits = {number: self._limits(number) for number in self.numbers}
        self.reaching: dict[int, int] = {}
        self.misparked: set[int] = set()

    def yields_width(self, number: int) -> bool:
        """True if a stall exists whose car can leave some of its width to the next one."""
        inside = 0 <= number < len(self.stalls)
        return inside and self.stalls[number].use in {StallUse.STANDARD, StallUse.EV} and not self.is_tight

    def free_beside(self, number: int) -> list[int]:
        """Indices of the adjacent stalls without a car of their own or one that reaches into them."""
        beside = [other for other in (number - 1, number + 1) if self.takes_misparked and self.yields_width(other)]
        return [other for other in beside if other not in self.cars and other not in self.reaching.values()]

    def _limits(self, number: int) -> tuple[float, float]:
        """Interval of a car's centre if it is between its lines."""
        car = self.cars[number]
        free_m = max(self.width_m / 2 - _LINE_M - car.half_x(mirrors=False), 0.0)
        walled_m = max(self.width_m / 2 - _ROW_END_M - car.half_x(), 0.0)
        return -(free_m if self.yields_width(number - 1) else walled_m), free_m if self.yields_width(
            number + 1
        ) else walled_m

    def _ranges(self) -> dict[int, tuple[float, float]] | None:
        """Interval of each car's lateral offset that leaves space for all others; None if there is no solution."""
        least: dict[int, float] = {}
        most: dict[int, float] = {}
        for numbers, sign, found in ((self.numbers, 1, least), (self.numbers[::-1], -1, most)):
            before: int | None = None
            for number in numbers:
                low, high = self.limits[number]
                bound = low if sign > 0 else -high
                if before is not None:
                    halves_m = self.cars[before].half_x() + self.cars[number].half_x()
                    bound = max(bound, found[before] * sign + halves_m + _GAP_M - abs(number - before) * self.width_m)
                found[number] = sign * bound
                before = number
        ranges = {number: (least[number], most[number]) for number in self.numbers}
        return ranges if all(low <= high + _ROUNDING_M for low, high in ranges.values()) else None

    def lean(self, number: int, beside: int, over_m: float, yaw: float | None = None) -> bool:
        """Let the body of a car reach into the adjacent stall by `over_m`; False if there is no space.

        A car at an angle reaches farther, as it also keeps off its other line.
        """
        before, car, limits = self.cars[number], self.cars[number], self.limits[number]
        if yaw is not None:
            car = replace(car, yaw=yaw)
            self.cars[number] = car
        over_m = max(over_m, car.half_x() + car.half_x(mirrors=False) - self.width_m + _ROW_END_M)
        side_m = (self.width_m / 2 + over_m - car.half_x(mirrors=False)) * (beside - number)
        self.limits[number] = side_m, side_m
        if self._ranges() is None:
            self.cars[number], self.limits[number] = before, limits
            return False
        self.reaching[number] = beside
        return True

    def places(self, spread_m: float) -> dict[int, float]:
        """Lateral offset of each car from the centre line of its stall."""
        placed: dict[int, float] = {}
        ranges = self._ranges()
        assert ranges is not None
        before: int | None = None
        for number in self.numbers:
            low, high = ranges[number]
            car = self.cars[number]
            if before is not None:
                halves_m = self.cars[before].half_x() + car.half_x()
                low = max(low, placed[before] + halves_m + _GAP_M - (number - before) * self.width_m)
            placed[number] = _cut_normal(car.side_share, spread_m, low, max(low, high))
            before = number
        return placed


def park_cars(
    stalls: tuple[PlacedStall, ...],
    config: GarageConfig,
    draws: SquareDraws,
    *,
    tight: Iterable[Stall] = (),
    held_back: Collection[str] = (),
) -> ParkedCars:
    """Park random cars, without collisions and within the lengths of their stalls.

    Parameters
    ----------
    stalls
        All stalls.
    config
        Occupancy, shares of bodies, paints and poses; the country of its profile selects the market.
    draws
        Random numbers.
    tight
        Stalls whose cars keep their mirrors between the lines, and so do adjacent cars.
    held_back
        Names of the stalls whose cars do not stand over a line.

    Notes
    -----
    A car is drawn among the garage's models that fit, then its yaw, then its lateral offset from a normal distribution
    truncated by neighbours and lines. Every stall uses the same number of draws, so that the occupancy changes no other
    car. A car stands over a line only towards a stall of the same row, and far over only in rows of perpendicular
    stalls.
    """
    parking = config.parking
    most = max((stall.ordinal for stall in stalls), default=0)
    numbers = draws.of_step(Step.CARS, most, _DRAWS_A_CAR)
    habits = draws.of_part(Step.CARS, "over the line", most, _HABITS)
    states = draws.of_part(Step.CARS, "wheels and dust", most, _STATES)
    lamps = draws.of_part(Step.CARS, "lamps", most, 1)
    ranks = draws.of_all(Step.CARS, "models", len(CAR_BODIES)).tolist()
    fleet = Fleet(parking, config.standard.country, ranks)
    holds_car = occupancy_of(stalls, parking)
    cars: dict[str, _Car] = {}
    for stall in stalls:
        drawn = numbers[stall.square][stall.ordinal - 1].tolist()
        if stall.use.takes_cars and holds_car.get(stall.name, drawn[0] < parking.occupancy):
            state = [found[stall.square][stall.ordinal - 1] for found in (states, lamps)]
            car = _car(stall, drawn, np.concatenate(state).tolist(), fleet, parking)
            if car is not None:
                cars[stall.name] = car
            elif holds_car.get(stall.name):
                least = min(body.length_m for body in CAR_BODIES)
                raise ConfigError("parking.occupied_stalls", stall.name, f"stalls that a car of {least} m fits into")
    names = {stall.name for stall in tight}
    rows = [_Row(row, cars, names) for row in _rows(stalls) if any(stall.name in cars for stall in row)]
    _lean_over(rows, parking, habits, held_back)
    placed = {
        row.stalls[number].name: row.cars[number].placement(side_m)
        for row in rows
        for number, side_m in row.places(parking.lateral_spread_m).items()
    }
    named = [(row, [stall.name for stall in row.stalls]) for row in rows]
    return ParkedCars(
        [placed[name] for name in cars],
        {names[number]: names[beside] for row, names in named for number, beside in row.reaching.items()},
        frozenset(names[number] for row, names in named for number in row.misparked),
    )


def _car(
    stall: PlacedStall, drawn: Sequence[float], state: Sequence[float], fleet: Fleet, parking: ParkingConfig
) -> _Car | None:
    """Car of a stall by its random numbers, and those of its state; None if no body fits."""
    _, reverse, yaw_share, side_share, along_share, body_share, paint_share = drawn
    # cars in parallel and angled stalls face along the traffic; assumes that nobody backs into them
    is_reversed = stall.stall_kind is StallKind.PERPENDICULAR and reverse < fleet.reversed_share
    behind_m = max(_REAR_CLEARANCE_M, room_for_charger_m(stall))
    bodies = fitting(stall.width_m, stall.length_m, is_reversed=is_reversed, behind_m=behind_m)
    if not bodies:
        return None
    body = fleet.body_of(bodies, body_share)
    room_m = _room_m(stall.length_m, body, is_reversed=is_reversed, behind_m=behind_m)
    # width' <= width + length |sin yaw| and length' <= length + width |sin yaw|
    side_room, end_room = stall.width_m - 2 * _END_CLEARANCE_M - body.overall_width_m, room_m - body.length_m
    sin = max(min((side_room + _GAP_M) / body.length_m, end_room / body.overall_width_m), 0.0)
    most = min(math.radians(parking.max_yaw_deg), elementary.arcsin(min(sin, 1.0)))
    yaw = _cut_normal(yaw_share, math.radians(parking.yaw_spread_deg), -most, most)
    turned, angle, dust, lamps = state
    steer_deg = _STEER_DEG[int(angle * len(_STEER_DEG))] if turned < parking.turned_wheels else 0.0
    return _Car(
        stall,
        body,
        fleet.paint_of(paint_share),
        is_reversed,
        yaw,
        room_m,
        side_share,
        along_share,
        steer_deg,
        dust < parking.dusty,
        lamps < parking.lit,
    )


def _rows(stalls: Iterable[PlacedStall]) -> list[list[PlacedStall]]:
    """Rows of adjacent stalls on a square, from the left as seen looking out of their entries.

    The distance of angled stalls across their sides is their width. Each parallel stall is a row of its own.
    """
    rows: list[list[PlacedStall]] = []
    of_side: dict[tuple[object, ...], list[PlacedStall]] = {}
    for stall in stalls:
        of_side.setdefault((stall.square, stall.edge, stall.yaw_rad), []).append(stall)
    for group in of_side.values():
        cos, sin = elementary.cos(group[0].yaw_rad), -elementary.sin(group[0].yaw_rad)
        ordered = sorted((stall.centre_m[0] * cos + stall.centre_m[1] * sin, stall.name, stall) for stall in group)
        row = [ordered[0][2]]
        for (before_m, _, _), (across_m, _, stall) in pairwise(ordered):
            if abs(across_m - before_m - stall.width_m) > _TOUCH_M:
                rows.append(row)
                row = []
            row.append(stall)
        rows.append(row)
    return rows


def _lean_over(
    rows: Sequence[_Row],
    parking: ParkingConfig,
    habits: Mapping[Square, NDArray[np.float64]],
    held_back: Collection[str],
) -> None:
    """Shift some cars over their lines, as many of the eligible ones as the shares of all cars require."""
    count = sum(len(row.cars) for row in rows)

    def chance(share: float, able: int) -> float:
        return min(share * count / able, 1.0) if able else 0.0

    def drawn(row: _Row, number: int) -> list[float]:
        stall = row.stalls[number]
        found: list[float] = habits[stall.square][stall.ordinal - 1].tolist()
        return found

    misparking = chance(parking.misparked, sum(bool(row.free_beside(n)) for row in rows for n in row.numbers))
    able = sum(row.yields_width(n - 1) or row.yields_width(n + 1) for row in rows for n in row.numbers)
    leaning = chance(parking.over_line, able)
    for row in rows:
        for number in row.numbers:
            is_far, is_over, side, depth = drawn(row, number)
            if is_far < misparking and (free := row.free_beside(number)):
                beside = free[int(side * len(free))]
                low, high = _FAR_OVER_M
                over_m = low + depth * (high - low)
                slanted = is_far < misparking * _SLANTED_SHARE
                yaw = _slant(row.cars[number], depth, beside - number) if slanted else None
                if row.lean(number, beside, over_m if yaw is None else low, yaw):
                    row.misparked.add(number)
            elif is_over < leaning and row.stalls[number].name not in held_back:
                low, high = _OVER_M
                sides = (number - 1, number + 1) if side < 0.5 else (number + 1, number - 1)  # noqa: PLR2004
                for beside in sides:
                    if row.yields_width(beside) and row.lean(number, beside, low + depth * (high - low)):
                        break


def _slant(car: _Car, share: float, towards: int) -> float:
    """Yaw of a car at an angle, limited by the length of its stall."""
    room_m = max(car.room_m - car.body.length_m, 0.0) / car.body.overall_width_m
    low, high = map(math.radians, _SLANT_DEG)
    return math.copysign(min(low + share * (high - low), elementary.arcsin(min(room_m, 1.0))), towards)


def occupancy_of(stalls: tuple[PlacedStall, ...], parking: ParkingConfig) -> dict[str, bool]:
    """Occupancy of the stalls named in the configuration."""
    uses = {stall.name: stall.use for stall in stalls}
    named = {}
    for field, holds_car in (("occupied_stalls", True), ("empty_stalls", False)):
        for name in getattr(parking, field) or ():
            if name not in uses:
                raise ConfigError(f"parking.{field}", name, f"ids of stalls of this garage, as {next(iter(uses))}")
            if holds_car and not uses[name].is_parked_in:
                raise ConfigError(
                    f"parking.{field}",
                    name,
                    "stalls that are not kept free for turning, for wheelchairs or as out of reach",
                )
            named[name] = holds_car
    if parking.occupied_stalls is not None:
        return dict.fromkeys(uses, False) | named
    return named


@lru_cache
def fitting(
    width_m: float, length_m: float, *, is_reversed: bool, behind_m: float = _REAR_CLEARANCE_M
) -> tuple[CarBody, ...]:
    """Bodies that fit a stall of a width and length in metres, with a clearance behind them."""
    return tuple(
        body
        for body in CAR_BODIES
        if body.fits(
            width_m - 2 * _END_CLEARANCE_M, _room_m(length_m, body, is_reversed=is_reversed, behind_m=behind_m)
        )
    )


def _room_m(length_m: float, body: CarBody, *, is_reversed: bool, behind_m: float) -> float:
    """Length of a stall usable by a car, from the entry to the tyres at the wheel stop."""
    overhang_m = body.length_m - body.wheelbase_m - body.front_overhang_m if is_reversed else body.front_overhang_m
    # half of the tyre's chord at the height of the wheel stop
    tyre_m = math.sqrt((2 * body.wheel_radius_m - WHEEL_STOP_HEIGHT_M) * WHEEL_STOP_HEIGHT_M)
    axle_m = WHEEL_STOP_FROM_REAR_M + WHEEL_STOP_WIDTH_M / 2 + tyre_m
    return length_m - _END_CLEARANCE_M - max(behind_m, axle_m - overhang_m)


def _cut_normal(share: float, spread: float, low: float, high: float) -> float:
    """Quantile at `share` (0 to 1) of a normal distribution around 0, truncated to two bounds."""
    if spread <= 0 or high - low < _ROUNDING_M:
        return min(max(0.0, low), high)
    first, last = _USUAL.cdf(low / spread), _USUAL.cdf(high / spread)
    at = first + share * (last - first)
    if not 0 < at < 1:
        return min(max(0.0, low), high)
    return min(max(_USUAL.inv_cdf(at) * spread, low), high)
