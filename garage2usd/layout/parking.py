"""Stalls on the squares that lanes serve, their wheel stops, and the cars parked in them."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np

from garage2usd.config import BayConfig, FittingsConfig, ParkingConfig
from garage2usd.config.look import MarkingsLook
from garage2usd.config.vehicles import CAR_BODIES, PAINTS, CarBody
from garage2usd.errors import ConfigError
from garage2usd.layout.designation import use_symbol
from garage2usd.layout.draws import SquareDraws
from garage2usd.layout.ghost_lines import ghosts_on_stall
from garage2usd.layout.markings import hatching
from garage2usd.layout.placement import Placement, Stall, StallUse
from garage2usd.layout.stall_lines import stall_lines
from garage2usd.layout.tiles import Tile, TileGrid, stall_rectangle
from garage2usd.objects.car import CarSpec
from garage2usd.objects.panel import Surface
from garage2usd.objects.stall import StallSpec
from garage2usd.objects.wheel_stop import WHEEL_STOP_HEIGHT_M, WHEEL_STOP_WIDTH_M, WheelStopSpec
from garage2usd.profiles import Profile
from garage2usd.randomness import Step
from garage2usd.structure.dead_ends import DeadEnd
from garage2usd.structure.lane_graph import LaneGraph, Square

__all__ = ["parked_cars", "stall_panels", "stalls_of", "wheel_stops", "with_turning_stalls"]

WHEEL_STOP_FROM_REAR_M = 0.55
"""Middle of a wheel stop from the stall's rear: behind the front wheels of a car parked nose-in."""
_WHEEL_STOP_LENGTH_M, _LOWEST_WHEEL_STOP_M = 1.65, 0.05
_WHEEL_STOP_GAP_M = 0.65
"""Between the two blocks of a pair."""
_LINE_CLEARANCE_M = 0.1
_HATCH_MARGIN_M = 0.25
_NEAR_STALLS = 12
_REAR_CLEARANCE_M = 0.12
_DRAWS_A_CAR = 7
_COATINGS = {
    StallUse.EV: Surface.STALL_EV,
    StallUse.ACCESSIBLE: Surface.STALL_ACCESSIBLE,
    StallUse.ACCESS_AISLE: Surface.STALL_ACCESSIBLE,
}
_HATCHES = {
    StallUse.TURNING: Surface.PAINT_YELLOW,
    StallUse.ACCESS_AISLE: Surface.PAINT_WHITE,
    StallUse.UNREACHABLE: Surface.PAINT_YELLOW,
}


def stalls_of(grid: TileGrid, graph: LaneGraph, bay: BayConfig) -> tuple[Stall, ...]:
    """All stalls in reading order, numbered from 1 on each square."""
    return tuple(
        Stall(
            square=tile.square,
            ordinal=place.ordinal,
            edge=place.row.edge,
            stall_type=graph.stall_types[tile.square],
            centre_m=_middle(tile, stall_rectangle(tile, place.row, place.slot, bay)),
            width_m=bay.stall_width_m,
            length_m=bay.stall_length_m,
        )
        for tile in grid
        for place in grid.stall_places.get(tile.square, [])
    )


def with_turning_stalls(stalls: tuple[Stall, ...], grid: TileGrid, ends: Sequence[DeadEnd]) -> tuple[Stall, ...]:
    """The same with a stall of each dead-end aisle kept free for turning.

    It is the nearest to the aisle's tip of those that open onto the lane nearest to it, or where none opens onto the
    aisle, the nearest of all. A stall that cars drive straight on into helps nobody to turn, and is only taken where
    the aisle has no other.
    """
    if not ends:
        return stalls
    from scipy.spatial import KDTree  # noqa: PLC0415 - few garages have such ends, all wait for imports

    def is_straight_on(stall: Stall) -> bool:
        return grid.tiles[stall.access_square].drivable[stall.edge]

    turned = list(stalls)
    opening_on: dict[Square, list[int]] = {}
    for index, stall in enumerate(stalls):
        opening_on.setdefault(stall.access_square, []).append(index)
    places = KDTree([stall.centre_m for stall in stalls])
    for end in ends:
        tile = grid.tiles[end.tip]
        _, nearest = places.query((tile.x_m, tile.z_m), k=min(len(stalls), _NEAR_STALLS))
        own = (index for square in end.squares for index in opening_on.get(square, ()))
        back = {square: squares_back for squares_back, square in enumerate(end.squares)}
        # a stable sort: the nearest first among those that open onto the same lane
        for index in sorted(
            dict.fromkeys((*np.atleast_1d(nearest).tolist(), *own)),
            key=lambda index: (
                stalls[index].access_square not in back,
                is_straight_on(stalls[index]),
                back.get(stalls[index].access_square, 0),
            ),
        ):
            if turned[index].use is StallUse.STANDARD:
                turned[index] = replace(turned[index], use=StallUse.TURNING)
                break
    return tuple(turned)


def stall_panels(
    stalls: tuple[Stall, ...], look: MarkingsLook, grid: TileGrid, ghosts: Mapping[Square, int]
) -> list[Placement]:
    """The floor of each stall with its lines, below them those of older rows by the squares that show them."""
    return [stall.placement("Stall", _with_ghosts(stall, look, grid, ghosts)) for stall in stalls]


def _with_ghosts(stall: Stall, look: MarkingsLook, grid: TileGrid, ghosts: Mapping[Square, int]) -> StallSpec:
    panel = _stall_panel(stall.width_m, stall.length_m, stall.use, look)
    number = ghosts.get(stall.square)
    if number is None or stall.use in _COATINGS:
        return panel
    count = max(place.row.count for place in grid.stall_places[stall.square])
    middle = grid.tiles[stall.square].middle_m
    older = ghosts_on_stall(number, stall, middle, count * stall.width_m / 2, look.line_width_m)
    return replace(panel, markings=(*panel.markings, *older))


@lru_cache
def _stall_panel(width_m: float, length_m: float, use: StallUse, look: MarkingsLook) -> StallSpec:
    lines = stall_lines(width_m, length_m, look)
    if not use.takes_cars:
        lines += hatching(width_m / 2, length_m / 2, margin_m=_HATCH_MARGIN_M, surface=_HATCHES[use])
    return StallSpec(width_m, length_m, _COATINGS.get(use, Surface.STALL), (*lines, *use_symbol(use)))


def wheel_stops(stalls: tuple[Stall, ...], fittings: FittingsConfig, profile: Profile) -> list[Placement]:
    """A wheel stop near the rear of each stall that cars park in, unless that would be too low to stop a wheel."""
    clause = profile.wheel_stop_height
    height_m = min(WHEEL_STOP_HEIGHT_M, clause.amount if clause else math.inf)
    if not fittings.wheel_stops or height_m < _LOWEST_WHEEL_STOP_M:
        return []
    gap_m = _WHEEL_STOP_GAP_M if fittings.wheel_stops == "pairs" else 0.0
    return [
        stall.placement(
            "WheelStop",
            WheelStopSpec(min(_WHEEL_STOP_LENGTH_M, round(stall.width_m - 0.6, 3)), height_m, gap_m),
            (0.0, -stall.length_m / 2 + WHEEL_STOP_FROM_REAR_M),
        )
        for stall in stalls
        if stall.use.takes_cars
    ]


def parked_cars(stalls: tuple[Stall, ...], parking: ParkingConfig, draws: SquareDraws) -> list[Placement]:
    """Random cars, each inside its stall by construction.

    Notes
    -----
    A car is drawn among the bodies that fit, then its yaw, then its offset from what the turned footprint leaves
    between the lines. Every stall draws the same number of times, so that the occupancy moves no other car.
    """
    most = max((stall.ordinal for stall in stalls), default=0)
    numbers = draws.of_step(Step.CARS, most, _DRAWS_A_CAR)
    holds_car = _occupancy(stalls, parking)
    placements = []
    for stall in stalls:
        drawn = numbers[stall.square][stall.ordinal - 1].tolist()
        occupied, reverse, yaw_share, side_share, along_share, body_index, paint_index = drawn
        if not holds_car.get(stall.name, occupied < parking.occupancy) or not stall.use.takes_cars:
            continue
        is_reversed = reverse < parking.reversed_share
        bodies = [
            body
            for body in CAR_BODIES
            if body.length_m <= _room_m(stall, body, is_reversed=is_reversed)
            and body.overall_width_m <= stall.width_m - 2 * _LINE_CLEARANCE_M
        ]
        if not bodies:
            if holds_car.get(stall.name):
                least = min(body.length_m for body in CAR_BODIES)
                raise ConfigError("parking.occupied_stalls", stall.name, f"stalls that a car of {least} m fits into")
            continue
        body = bodies[int(body_index * len(bodies))]
        limit = math.radians(parking.max_yaw_deg)
        room_m = _room_m(stall, body, is_reversed=is_reversed)
        yaw = _fitting_yaw((2 * yaw_share - 1) * limit, body, stall.width_m - 2 * _LINE_CLEARANCE_M, room_m)
        half_x = (body.overall_width_m * math.cos(yaw) + body.length_m * abs(math.sin(yaw))) / 2
        half_z = (body.length_m * math.cos(yaw) + body.overall_width_m * abs(math.sin(yaw))) / 2
        side_slack = max(stall.width_m / 2 - _LINE_CLEARANCE_M - half_x, 0.0)
        rear_most = stall.length_m / 2 - _LINE_CLEARANCE_M - room_m + half_z
        along = rear_most + along_share * max(room_m - 2 * half_z, 0.0)
        turned = stall.yaw_rad + yaw + (math.pi if is_reversed else 0.0)
        spec = CarSpec(body.name, PAINTS[int(paint_index * len(PAINTS))])
        point = (2 * side_share - 1) * side_slack, along
        placements.append(stall.placement("Car", spec, point, yaw_rad=round(math.remainder(turned, math.tau), 6)))
    return placements


def _occupancy(stalls: tuple[Stall, ...], parking: ParkingConfig) -> dict[str, bool]:
    """Whether a car stands in each stall that the configuration names."""
    uses = {stall.name: stall.use for stall in stalls}
    named = {}
    for field, holds_car in (("occupied_stalls", True), ("empty_stalls", False)):
        for name in getattr(parking, field) or ():
            if name not in uses:
                raise ConfigError(f"parking.{field}", name, f"ids of stalls of this garage, as {next(iter(uses))}")
            if holds_car and not uses[name].takes_cars:
                raise ConfigError(
                    f"parking.{field}",
                    name,
                    "stalls that are not kept free for turning, for wheelchairs or as out of reach",
                )
            named[name] = holds_car
    if parking.occupied_stalls is not None:
        return dict.fromkeys(uses, False) | named
    return named


def _room_m(stall: Stall, body: CarBody, *, is_reversed: bool) -> float:
    """Length of a stall that a car may take: short of its mouth, and with the tyres before the wheel stop."""
    overhang_m = body.length_m - body.wheelbase_m - body.front_overhang_m if is_reversed else body.front_overhang_m
    # half the chord of a tyre at the stop's height
    tyre_m = math.sqrt((2 * body.wheel_radius_m - WHEEL_STOP_HEIGHT_M) * WHEEL_STOP_HEIGHT_M)
    axle_m = WHEEL_STOP_FROM_REAR_M + WHEEL_STOP_WIDTH_M / 2 + tyre_m
    return stall.length_m - _LINE_CLEARANCE_M - max(_REAR_CLEARANCE_M, axle_m - overhang_m)


def _fitting_yaw(yaw_rad: float, body: CarBody, width_m: float, length_m: float) -> float:
    """The drawn yaw, made smaller where the turned footprint would leave the stall's room."""
    side_room, end_room = width_m - body.overall_width_m, length_m - body.length_m
    # width' <= width + length |sin yaw| and length' <= length + width |sin yaw|
    limit = max(min(side_room / body.length_m, end_room / body.overall_width_m), 0.0)
    return math.copysign(min(abs(yaw_rad), math.asin(min(limit, 1.0))), yaw_rad)


def _middle(tile: Tile, corners: tuple[tuple[float, float], ...]) -> tuple[float, float]:
    xs, zs = zip(*corners, strict=True)
    return round(tile.x_m + (min(xs) + max(xs)) / 2, 6), round(tile.z_m + (min(zs) + max(zs)) / 2, 6)
