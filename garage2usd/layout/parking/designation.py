"""Use of single stalls: accessible and charging stalls, their symbols and chargers."""

import math
from collections.abc import Iterable
from collections.abc import Set as AbstractSet
from dataclasses import replace

import numpy as np
import shapely

from garage2usd.config import ParkingConfig
from garage2usd.garage import StallKind, StallUse
from garage2usd.layout.grounds import Points
from garage2usd.layout.placement import PlacedStall, Placement, edge_yaw_rad, rounded
from garage2usd.objects.charger import CHARGER_FRONT_M, ChargerSpec
from garage2usd.objects.kind import Point
from garage2usd.objects.panel import Marking, Paint, Surface
from garage2usd.profiles import Profile
from garage2usd.profiles.access import AccessWidths, access_widths, van_stalls
from garage2usd.structure.lane_graph import Square

_ACCESSIBLE_SHARE = 0.02
_ACCESSIBLE_FROM_STALLS = 25
"""Garages with at least this many stalls have an accessible one."""
_CHARGER_FROM_REAR_M = 0.055
_CHARGER_BEYOND_LINE_M = CHARGER_FRONT_M + 0.01
_BEFORE_GUARD_M = 0.02
_SYMBOL_Z_M = 0.35
_ROUNDING_M = 1e-6


def with_designated_stalls(
    stalls: tuple[PlacedStall, ...],
    anchors: Iterable[Point],
    parking: ParkingConfig,
    profile: Profile,
    *,
    ways_in_and_out: AbstractSet[Square] = frozenset(),
) -> tuple[PlacedStall, ...]:
    """Designate the stalls nearest to `anchors` (stair cores or doors) as accessible, and the next ones for charging.

    Parameters
    ----------
    stalls
        All stalls.
    anchors
        Points (x, z) where people leave on foot.
    parking, profile
        Shares of the uses, or the numbers that the profile requires.
    ways_in_and_out
        Squares of the portals and of the lanes before them. Stalls beside them are the last choice for charging: cars
        back out there, or a charger stands at the edge of the carriageway.

    Notes
    -----
    An accessible stall needs an access aisle of 1.2 m (GB 50763, 3.14.3) or 60 in (ADA 502.3) beside it. Between the
    columns only another stall has this space: the adjacent standard stall becomes the aisle, and the stall on its other
    side the next accessible one, if more are required. A stall without such a neighbour in its row is not eligible. The
    aisle remains in the list of stalls, with its use, so that their number equals the plan's; it yields to the
    accessible stalls the width by which their standard, or that of vans, exceeds a stall's.
    """
    far_m = Points(list(anchors)).nearest_m(np.array([stall.centre_m for stall in stalls]).reshape(-1, 2)).tolist()
    for_cars = sum(stall.use is not StallUse.MOTORCYCLE for stall in stalls)
    accessible = _accessible_count(for_cars, parking, profile)
    charging = round(parking.ev_share * for_cars)
    order = sorted(
        (index for index, stall in enumerate(stalls) if stall.use is StallUse.STANDARD),
        key=lambda index: (round(far_m[index], 6), index),
    )
    uses = [stall.use for stall in stalls]
    vans = van_stalls(profile, accessible)
    divided: dict[int, PlacedStall] = {}
    for index in order:
        if accessible <= 0:
            break
        aisle = _access_aisle(index, stalls, uses)
        if uses[index] is not StallUse.STANDARD or aisle is None:
            continue
        shared = 2 * aisle - index
        is_shared = accessible > 1 and _is_standard_beside(aisle, shared, stalls, uses)
        row, widths = _divided([index, aisle, shared] if is_shared else [index, aisle], stalls, profile, vans)
        uses[aisle] = StallUse.ACCESS_AISLE
        for taken in row[::2]:
            uses[taken] = StallUse.ACCESSIBLE
        accessible -= len(row) - 1
        vans -= min(vans, len(row) - 1)
        divided.update(zip(row, _redrawn([stalls[taken] for taken in row], widths), strict=True))
    quiet_first = sorted(order, key=lambda index: not ways_in_and_out.isdisjoint(_squares_at_ends(stalls[index])))
    for index in [index for index in quiet_first if uses[index] is StallUse.STANDARD][:charging]:
        uses[index] = StallUse.EV
    return tuple(
        stall if use is stall.use else replace(divided.get(index, stall), use=use)
        for index, (stall, use) in enumerate(zip(stalls, uses, strict=True))
    )


def _squares_at_ends(stall: PlacedStall) -> tuple[Square, Square]:
    """Return the squares before the entry of a stall and behind its rear."""
    return stall.access_square, stall.edge.opposite.beyond(stall.square)


def _divided(
    row: list[int], stalls: tuple[PlacedStall, ...], profile: Profile, vans: int
) -> tuple[list[int], AccessWidths | None]:
    """Divide a width between an accessible stall, its access aisle and, if there is space, the stall beyond.

    Van-accessible stalls come first. If not even one fits, the stalls are unchanged.
    """
    width_m = stalls[row[0]].width_m
    for most_vans in dict.fromkeys((vans, 0)):
        for taken in (row, row[:2]) if len(row) > 2 else (row,):  # noqa: PLR2004 - the aisle between two
            count = len(taken) - 1
            widths = access_widths(profile, width_m, stalls=count, vans=min(most_vans, count))
            if widths:
                return taken, widths
    return row, None


def _redrawn(row: list[PlacedStall], widths: AccessWidths | None) -> list[PlacedStall]:
    """Divide the area of a row of stalls anew, from its first stall on, into given widths."""
    if widths is None or math.isclose(widths.aisle_m, row[0].width_m, abs_tol=_ROUNDING_M):
        return row
    first, *others = widths.stalls_m
    (x, z), (beside_x, beside_z) = row[0].centre_m, row[1].centre_m
    step_x, step_z = (beside_x - x) / row[0].width_m, (beside_z - z) / row[0].width_m
    done_m, redrawn = -row[0].width_m / 2, []
    for stall, width_m in zip(row, (first, widths.aisle_m, *others), strict=True):
        middle_m = done_m + width_m / 2
        centre = rounded((x + step_x * middle_m, z + step_z * middle_m))
        # the sides of an angled stall keep their length
        length_m = stall.length_m - (width_m - stall.width_m) * abs(stall.slope)
        redrawn.append(replace(stall, width_m=round(width_m, 6), length_m=round(length_m, 6), centre_m=centre))
        done_m += width_m
    return redrawn


def _accessible_count(stalls: int, parking: ParkingConfig, profile: Profile) -> int:
    """Number of accessible stalls: the user's share, or the number that the profile requires."""
    if parking.accessible_share is None and profile.accessible_stalls is not None:
        return profile.accessible_stalls.required(stalls)
    share = _ACCESSIBLE_SHARE if parking.accessible_share is None else parking.accessible_share
    least = 1 if share > 0 and stalls >= _ACCESSIBLE_FROM_STALLS else 0
    return max(round(share * stalls), least)


def _access_aisle(index: int, stalls: tuple[PlacedStall, ...], uses: list[StallUse]) -> int | None:
    """Choose a standard stall beside an accessible one as access aisle, preferably with another on its far side."""
    beside = [other for other in (index - 1, index + 1) if _is_standard_beside(index, other, stalls, uses)]
    return max(beside, key=lambda aisle: _is_standard_beside(aisle, 2 * aisle - index, stalls, uses), default=None)


def _is_standard_beside(index: int, other: int, stalls: tuple[PlacedStall, ...], uses: list[StallUse]) -> bool:
    """True if `other` is a standard stall in the same row and adjacent to the stall at an index."""
    if not 0 <= other < len(stalls) or uses[other] is not StallUse.STANDARD:
        return False
    first, second = stalls[index], stalls[other]
    # the middle one of three stalls may be left out
    is_next = abs(first.ordinal - second.ordinal) == 1
    is_beside = is_next and (first.square, first.edge) == (second.square, second.edge)
    return is_beside and first.stall_kind is not StallKind.PARALLEL


def use_symbol(use: StallUse) -> tuple[Marking, ...]:
    """White symbol of a stall's use, upright for a driver who enters; empty for a standard stall."""
    if use is StallUse.EV:
        bolt = ((0.12, -0.75), (-0.38, 0.12), (-0.04, 0.12), (-0.16, 0.75), (0.38, -0.18), (0.03, -0.18))
        return (Marking(tuple((x, z + _SYMBOL_Z_M) for x, z in bolt), Surface.PAINT_WHITE, Paint.STALL_SYMBOL),)
    if use is StallUse.ACCESSIBLE:
        return tuple(Marking(shape, Surface.PAINT_WHITE, Paint.STALL_SYMBOL) for shape in _wheelchair())
    if use is StallUse.MOTORCYCLE:
        return tuple(Marking(shape, Surface.PAINT_WHITE, Paint.STALL_SYMBOL) for shape in _motorcycle())
    return ()


def _motorcycle() -> list[tuple[Point, ...]]:
    """The outlines of a motorcycle seen from its right, as polygons without holes."""
    wheels = [shapely.Point(x, 0.16).buffer(0.16, quad_segs=4) for x in (-0.30, 0.30)]
    lines = [
        [(-0.30, 0.16), (-0.10, 0.12), (0.14, 0.12)],
        [(0.30, 0.16), (0.17, -0.20), (0.06, -0.26)],
        [(0.17, -0.20), (0.27, -0.24)],
    ]
    strokes = [shapely.LineString(line).buffer(0.035, cap_style="flat", join_style="mitre") for line in lines]
    tank_and_seat = shapely.Polygon(
        [
            (0.19, -0.10),
            (0.10, -0.19),
            (-0.02, -0.17),
            (-0.08, -0.09),
            (-0.42, -0.15),
            (-0.38, -0.03),
            (-0.10, 0.14),
            (0.14, 0.14),
        ]
    )
    shapes = shapely.get_parts(shapely.union_all([*wheels, *strokes, tank_and_seat], grid_size=1e-4))
    return [
        tuple((round(x, 6), round(z - 0.1, 6)) for x, z in list(shape.exterior.coords)[:-1])
        for shape in sorted(shapes, key=lambda shape: shape.bounds)
    ]


def _wheelchair() -> list[tuple[Point, ...]]:
    """Outlines of a wheelchair with its user, as polygons without holes."""
    head = shapely.Point(-0.1, -0.68).buffer(0.12, quad_segs=4)
    body = shapely.LineString([(-0.07, -0.5), (0.0, 0.0), (0.38, 0.0), (0.52, 0.46), (0.68, 0.41)])
    arm = shapely.LineString([(-0.04, -0.24), (0.32, -0.24)])
    angles = [math.radians(30 + 200 * step / 20) for step in range(21)]
    wheel = shapely.LineString([(0.05 + 0.38 * math.cos(a), 0.22 + 0.38 * math.sin(a)) for a in angles])
    strokes = [line.buffer(0.055, cap_style="flat", join_style="mitre") for line in (body, arm, wheel)]
    shapes = shapely.get_parts(shapely.union_all([head, *strokes], grid_size=1e-4))
    return [
        tuple((round(x - 0.1, 6), round(z + _SYMBOL_Z_M, 6)) for x, z in list(shape.exterior.coords)[:-1])
        for shape in sorted(shapes, key=lambda shape: shape.bounds)
    ]


def room_for_charger_m(stall: PlacedStall) -> float:
    """Return the depth that a charger takes at the rear of a stall; 0 without a charger, or with one beside the car."""
    if stall.use is not StallUse.EV or stall.stall_kind is StallKind.PARALLEL:
        return 0.0
    return _CHARGER_FROM_REAR_M + CHARGER_FRONT_M + _BEFORE_GUARD_M


def chargers(stalls: tuple[PlacedStall, ...]) -> list[Placement]:
    """Place a charging post at the rear of each charging stall, behind the car; beside the car in parallel stalls."""
    return [_charger(stall) for stall in stalls if stall.use is StallUse.EV]


def _charger(stall: PlacedStall) -> Placement:
    if stall.stall_kind is not StallKind.PARALLEL:
        return stall.placement("Charger", ChargerSpec(), (0.0, -stall.length_m / 2 + _CHARGER_FROM_REAR_M))
    return stall.placement(
        "Charger",
        ChargerSpec(),
        (stall.turn * (stall.width_m / 2 + _CHARGER_BEYOND_LINE_M), 0.0),
        yaw_rad=edge_yaw_rad(stall.edge),
    )
