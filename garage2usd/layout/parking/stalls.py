"""Stalls on the squares along lanes: placement, turning and tight stalls, floor panels and wheel stops."""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np

from garage2usd.config import BayConfig, FittingsConfig
from garage2usd.config.look import MarkingsLook
from garage2usd.config.stalls import SizeClass
from garage2usd.garage import LaneGraph, Stall, StallKind, StallUse
from garage2usd.layout.floor.markings import hatching
from garage2usd.layout.floor.stall_lines import ghosts_on_stall, stall_lines
from garage2usd.layout.parking.designation import use_symbol
from garage2usd.layout.placement import PlacedStall, Placement, turned_yaw_rad
from garage2usd.layout.tiles import Tile, TileGrid, Tiles, stall_outline
from garage2usd.objects.kind import Point
from garage2usd.objects.panel import Marking, Surface
from garage2usd.objects.stall import StallSpec
from garage2usd.objects.wheel_stop import WHEEL_STOP_HEIGHT_M, WheelStopSpec
from garage2usd.profiles import Profile
from garage2usd.structure.lane_graph import LaneSquares, Square
from garage2usd.structure.lanes import DeadEnd
from garage2usd.structure.stall_runs import turn_of
from garage2usd.structure.stalls import kind_of_angle, slope_of_angle

WHEEL_STOP_FROM_REAR_M = 0.55
"""Distance of a wheel stop's centre from the stall's rear: behind the front wheels of a car parked nose-in."""
_WHEEL_STOP_LENGTH_M, _LOWEST_WHEEL_STOP_M = 1.65, 0.05
_WHEEL_STOP_GAP_M = 0.65
"""Gap between the two blocks of a pair."""
_HATCH_MARGIN_M = 0.25
_NEAR_STALLS = 12
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
_ROOMY_AISLE_M, _ROOMY_STALL_M = 5.5, 2.3
"""Aisle and stall widths at which the design car enters perpendicular stalls with few gear changes."""
_ROUNDING_M = 1e-6


def stalls_of(grid: TileGrid, graph: LaneSquares) -> tuple[PlacedStall, ...]:
    """Place all stalls in reading order, numbered from 1 on each square."""
    return tuple(
        PlacedStall(
            square=tile.square,
            ordinal=place.ordinal,
            edge=place.row.edge,
            stall_type=graph.stall_types[tile.square],
            centre_m=_middle(tile, stall_outline(tile, place.row, place.slot)),
            width_m=place.row.shape.width_m,
            length_m=place.row.shape.length_m,
            yaw_rad=turned_yaw_rad(place.row.edge, turn_of(place.row), place.row.shape.angle_deg),
            angle_deg=place.row.shape.angle_deg,
            turn=turn_of(place.row),
            size=place.row.shape.size,
            use=StallUse.STANDARD if SizeClass(place.row.shape.size).takes_cars else StallUse.MOTORCYCLE,
        )
        for tile in grid
        for place in grid.stall_places.get(tile.square, [])
    )


def with_turning_stalls(
    stalls: tuple[PlacedStall, ...], grid: TileGrid, ends: Sequence[DeadEnd]
) -> tuple[PlacedStall, ...]:
    """Mark one stall of each dead-end aisle as a turning stall, which is kept free.

    It is the stall nearest to the aisle's tip among those that open onto the lane square nearest to the tip; if no
    stall opens onto the aisle, the nearest of all. A stall that cars enter straight ahead does not help to turn, and is
    chosen only if the aisle has no other.
    """
    if not ends:
        return stalls

    def is_straight_on(stall: PlacedStall) -> bool:
        return grid.tiles[stall.access_square].drivable[stall.edge]

    turned = list(stalls)
    opening_on: dict[Square, list[int]] = {}
    for index, stall in enumerate(stalls):
        opening_on.setdefault(stall.access_square, []).append(index)
    places_m = np.array([stall.centre_m for stall in stalls])
    for end in ends:
        tile = grid.tiles[end.tip]
        # rounded, so that ties are broken equally on every machine
        apart_m2 = ((places_m - (tile.x_m, tile.z_m)) ** 2).sum(axis=1).round(6)
        nearest = np.argsort(apart_m2, kind="stable")[:_NEAR_STALLS]
        own = (index for square in end.squares for index in opening_on.get(square, ()))
        back = {square: squares_back for squares_back, square in enumerate(end.squares)}
        # a stable sort, which keeps stalls of one lane square sorted by distance
        for index in sorted(
            dict.fromkeys((*nearest.tolist(), *own)),
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
    stalls: tuple[PlacedStall, ...], look: MarkingsLook, grid: Tiles, ghosts: Mapping[Square, int]
) -> list[Placement]:
    """Make the floor panel of each stall with its lines, and ghost lines of older rows by square."""
    return [stall.placement("Stall", _with_ghosts(stall, look, grid, ghosts)) for stall in stalls]


def _with_ghosts(stall: PlacedStall, look: MarkingsLook, grid: Tiles, ghosts: Mapping[Square, int]) -> StallSpec:
    panel = _stall_panel(stall.width_m, stall.length_m, stall.angle_deg, stall.turn, stall.use, look)
    number = ghosts.get(stall.square)
    if number is None or stall.use in _COATINGS:
        return panel
    count = max(place.row.count for place in grid.stall_places[stall.square])
    middle = grid.tiles[stall.square].middle_m
    older = ghosts_on_stall(number, stall, middle, count * stall.width_m / 2, look.line_width_m)
    return replace(panel, markings=(*panel.markings, *older))


@lru_cache
def _stall_panel(
    width_m: float, length_m: float, angle_deg: float, turn: int, use: StallUse, look: MarkingsLook
) -> StallSpec:
    slope, depth_m = turn * slope_of_angle(angle_deg), length_m
    if kind_of_angle(angle_deg) is StallKind.PARALLEL:
        # the entry is a long side
        lines = _moved(stall_lines(length_m, width_m, look), lambda x, z: (-turn * z, turn * x))
    else:
        depth_m = round(length_m + width_m * abs(slope), 6)
        lines = stall_lines(width_m, depth_m, look, slope)
        if slope:
            lines = _moved(lines, lambda x, z: (x, z + slope * x))
    if not use.is_parked_in:
        lines += hatching(width_m / 2, length_m / 2, margin_m=_HATCH_MARGIN_M, surface=_HATCHES[use])
    return StallSpec(width_m, depth_m, _COATINGS.get(use, Surface.STALL), (*lines, *use_symbol(use)), slope=slope)


def _moved(markings: Iterable[Marking], place: Callable[[float, float], Point]) -> tuple[Marking, ...]:
    """Translate markings corner by corner with a function."""

    def corner(x: float, z: float) -> Point:
        new_x, new_z = place(x, z)
        return round(new_x, 6), round(new_z, 6)

    return tuple(replace(marking, polygon=tuple(corner(x, z) for x, z in marking.polygon)) for marking in markings)


def wheel_stops(stalls: tuple[PlacedStall, ...], fittings: FittingsConfig, profile: Profile) -> list[Placement]:
    """Place a wheel stop near the rear of each stall for cars, unless the height limit makes it ineffective."""
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
        if stall.use.takes_cars and stall.stall_kind is not StallKind.PARALLEL
    ]


def _middle(tile: Tile, corners: tuple[tuple[float, float], ...]) -> tuple[float, float]:
    xs, zs = zip(*corners, strict=True)
    return round(tile.x_m + (min(xs) + max(xs)) / 2, 6), round(tile.z_m + (min(zs) + max(zs)) / 2, 6)


def garage_stalls(
    stalls: Sequence[PlacedStall],
    lanes: LaneSquares,
    blocked: Mapping[str, str] | None = None,
    occupied: Iterable[bool] | None = None,
) -> Iterator[Stall]:
    """Return each stall as a quad that opens onto a lane node.

    Parameters
    ----------
    stalls
        Stalls of the layout.
    lanes
        The lane squares that the stalls open onto.
    blocked
        For each blocked stall, the name of the stall of the misparked car that blocks it.
    occupied
        True for each stall with a car; None if unknown. If given, the stalls have all facts of a stage.
    """
    access = [lanes.number_of[stall.access_square] for stall in stalls]
    return stall_quads(stalls, access, lanes.lanes, blocked, occupied)


def stall_quads(
    stalls: Sequence[PlacedStall],
    access: Iterable[int],
    lanes: LaneGraph,
    blocked: Mapping[str, str] | None = None,
    occupied: Iterable[bool] | None = None,
) -> Iterator[Stall]:
    """Yield each stall as a quad that opens onto a given lane node; parameters as for `garage_stalls`."""
    told = [()] * len(stalls) if occupied is None else [(("occupied", int(is_taken)),) for is_taken in occupied]
    for stall, node, occupancy in zip(stalls, access, told, strict=True):
        left, right, rear_right, rear_left = stall.corners_m()
        by = (blocked or {}).get(stall.name)
        facts: tuple[tuple[str, str | int], ...] = (
            *([("number", stall.number)] if stall.number else []),
            ("type", stall.stall_type.value),
            *([("size", stall.size)] if stall.size != SizeClass.STANDARD else []),
            ("row", stall.square[0]),
            ("column", stall.square[1]),
            ("entryEdge", stall.edge.name.lower()),
            *([("blocked_by", by)] if by else []),
            *occupancy,
        )
        corners = (left, right, rear_right, rear_left)
        yield Stall(stall.name, corners, stall.use, node, facts, lanes.nodes[node].level)


def planned_stalls(lanes: LaneSquares, bay: BayConfig) -> tuple[Stall, ...]:
    """Return the stalls of a plan that cannot be laid out."""
    return tuple(garage_stalls(stalls_of(TileGrid(lanes.structure, lanes, bay), lanes), lanes))


def tight_stalls(lanes: LaneGraph, stalls: Iterable[Stall]) -> tuple[Stall, ...]:
    """Select the stalls that the design car may be unable to enter, in their order."""
    return tuple(
        stall
        for stall in stalls
        if stall.takes_cars
        and (
            lanes.clear_aisle_m(stall.access, stall.outwards) < _ROOMY_AISLE_M - _ROUNDING_M
            or stall.width_m < _ROOMY_STALL_M - _ROUNDING_M
        )
    )
