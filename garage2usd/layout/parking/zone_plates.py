"""Plates with the names of parking zones on columns and walls."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import starmap
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.layout.grounds import Grounds, distances_m, grounds_of
from garage2usd.layout.parking.zones import zone_of
from garage2usd.layout.placement import PlacedStall, Placement, cos_sin, edge_yaw_rad, of_spec, placed, to_world
from garage2usd.objects.column import ColumnSpec
from garage2usd.objects.kind import Point
from garage2usd.objects.wall import WallSpec
from garage2usd.objects.zone_plate import ColumnPlatesSpec, ZonePlateSpec
from garage2usd.structure.stalls import Edge

_AROUND = (Edge.DOWN, Edge.RIGHT, Edge.UP, Edge.LEFT)
"""Edges that the sides of a column face, in the order of `ColumnPlatesSpec`."""
_FOOT_M = 1.70
"""Height of the lower edges of plates: above the equipment on columns and walls."""
_HALF_OFFSET = 0.225
"""Distance from the middle of a column's side to the middle of its halves, as a share of its width."""
_ON_WALL_M, _FROM_END_M = 0.26, 0.15
"""Width of a plate on a wall, and distance of its middle to the wall's end, between two rows of stalls."""
_SEEN_FROM_M = 0.5
"""A side is hidden by a block within this distance."""
_SIGHT_M = 12.0
"""Greatest distance from a plate to its stalls: across a lane."""
_EQUAL_DISTANCE_M = 1.25
"""Greatest difference in distance for the stalls before both halves of a side to count."""
_STRAIGHT_M = 0.01
"""Greatest lateral offset of a stall that counts for both halves."""


class _PlateSide(NamedTuple):
    """Candidate place of a zone plate, on a side of a column or on a wall: name, floor point, yaw and width."""

    name: str
    middle: Point
    yaw_rad: float
    width_m: float


class _NearestStall(NamedTuple):
    """Nearest stall in front of one half of a column side.

    Attributes
    ----------
    beside, beside_m
        Zone of the nearest stall, and distance to its ground from the middle of the side; empty and infinite without a
        stall in sight.
    """

    beside: str = ""
    beside_m: float = np.inf


def zone_plates(
    columns: Iterable[Placement],
    walls: Iterable[Placement],
    blocks: Iterable[Placement],
    stalls: Iterable[PlacedStall],
) -> list[Placement]:
    """Place zone plates on columns and walls, so that the nearest plate to each stall shows the stall's zone.

    Parameters
    ----------
    columns, walls, blocks, stalls
        Parts of the garage; blocks are its obstacles and stair cores. The zone of a stall is the first part of its
        number, ``B2`` of ``B2-07``; stalls whose numbers have no zone get no plates.

    Notes
    -----
    Each side of a column shows the zone of the nearest stalls in front of it. A side has no plate if a block hides it,
    if no stall is in sight, or if stalls of two zones are in front of it; the adjacent sides show one zone each. A
    stall with the plate of another zone as the nearest gets a plate on a wall.
    """
    numbered = [stall for stall in stalls if zone_of(stall.number)]
    if not numbered:
        return []
    shown = [zone_of(stall.number) for stall in numbered]
    grounds = grounds_of([stall.corners_m() for stall in numbered])
    middles = np.array([stall.centre_m for stall in numbered])
    columns = list(columns)
    sides = list(_column_sides(columns))
    seen = _visible_sides(sides, blocks)
    zone_on = dict(zip(seen, starmap(_zone_on, _nearest_stalls(seen, grounds, middles, shown)), strict=True))
    plates: list[Placement] = []
    for number, column in enumerate(columns):
        own = sides[number * len(_AROUND) : (number + 1) * len(_AROUND)]
        plates += _column_plates(column, tuple(zone_on.get(side, "") for side in own))
    return plates + _wall_plates(_visible_sides(_wall_sides(walls), blocks), grounds, middles, shown, plates)


def _column_sides(columns: Iterable[Placement]) -> Iterator[_PlateSide]:
    """Yield the four sides of each column."""
    for column, spec in of_spec(columns, ColumnSpec):
        at = column.position_m[0], column.position_m[2]
        for edge in _AROUND:
            yaw = edge_yaw_rad(edge)
            yield _PlateSide(column.name, to_world((0.0, spec.size_m / 2), at, yaw), yaw, spec.size_m)


def _column_plates(column: Placement, sides: tuple[str, ...]) -> list[Placement]:
    """Return the plates of a column; columns with the same plates share a prototype by rotation."""
    if not any(sides) or not isinstance(column.spec, ColumnSpec):
        return []
    turned = [(*sides[turn:], *sides[:turn]) for turn in range(len(sides))]
    turn = min(range(len(sides)), key=turned.__getitem__)
    spec = ColumnPlatesSpec(turned[turn], column.spec.size_m)
    if not column.spec.fills_square:
        far_m = tuple(column.spec.side_m(side + turn) for side in range(len(sides)))
        spec = replace(spec, sides_m=far_m, is_round=column.spec.is_round)
    x, _, z = column.position_m
    name = column.name.replace("Column", "ZonePlates")
    return [placed(name, spec, (x, z), height_m=_FOOT_M, yaw_rad=edge_yaw_rad(_AROUND[turn]))]


def _wall_sides(walls: Iterable[Placement]) -> Iterator[_PlateSide]:
    """Yield the places at both ends of each wall, between two rows of stalls."""
    for wall, spec in of_spec(walls, WallSpec):
        most = spec.length_m / 2 - _FROM_END_M
        for number, across in enumerate((-most, most), start=1):
            name = f"{wall.name.replace('Wall', 'ZonePlate')}_{number}"
            yield _PlateSide(name, wall.to_world((across, 0.0)), wall.yaw_rad, _ON_WALL_M)


def _visible_sides(sides: Iterable[_PlateSide], blocks: Iterable[Placement]) -> list[_PlateSide]:
    """Return the sides that no block hides."""
    sides = list(sides)
    if not sides:
        return []
    before = shapely.points(np.array([to_world((0.0, _SEEN_FROM_M), side.middle, side.yaw_rad) for side in sides]))
    hiding = shapely.STRtree(grounds_of([outline for block in blocks for outline in block.outlines()]))
    hidden = set(hiding.query(before, predicate="intersects")[0].tolist())
    return [side for number, side in enumerate(sides) if number not in hidden]


def _zone_on(left: _NearestStall, right: _NearestStall) -> str:
    """Return the zone on the plate of a side; empty without a zone, or if two zones are about equally near."""
    near_m = min(left.beside_m, right.beside_m) + _EQUAL_DISTANCE_M
    beside = {half.beside for half in (left, right) if half.beside and half.beside_m <= near_m}
    return beside.pop() if len(beside) == 1 else ""


def _nearest_stalls(
    sides: Sequence[_PlateSide], grounds: Grounds, middles: NDArray[np.float64], shown: Sequence[str]
) -> list[tuple[_NearestStall, _NearestStall]]:
    """Find the nearest stall in front of the left and the right half of each side.

    `grounds`, `middles` and `shown` are the polygons, middles (x, z) and zones of the stalls.
    """
    if not sides:
        return []
    at = np.array([side.middle for side in sides])
    ahead = np.array([cos_sin(side.yaw_rad)[::-1] for side in sides])
    right = ahead[:, ::-1] * (1, -1)
    off_m = np.array([[_HALF_OFFSET * side.width_m] for side in sides])
    reach = np.stack([at - _SIGHT_M * right, at + _SIGHT_M * (right + ahead)])
    side, stall = shapely.STRtree(grounds).query(shapely.box(*reach.min(axis=0).T, *reach.max(axis=0).T))
    is_before = ((middles[stall] - at[side]) * ahead[side]).sum(axis=1) > 0
    side, stall = side[is_before], stall[is_before]
    to_right_m = ((middles[stall] - at[side]) * right[side]).sum(axis=1)
    far_m = shapely.distance(shapely.points(at[side]), grounds[stall]).round(6)
    halves: list[list[_NearestStall]] = []
    for turn in (-1, 1):
        place = at + turn * off_m * right
        order = np.lexsort((stall, distances_m(place[side], middles[stall]).round(6), far_m, side))
        order = order[far_m[order] <= _SIGHT_M]
        found = [_NearestStall()] * len(sides)
        for row in _first_of_each(order[turn * to_right_m[order] > -_STRAIGHT_M], side):
            found[side[row]] = _NearestStall(shown[stall[row]], float(far_m[row]))
        halves.append(found)
    return list(zip(*halves, strict=True))


def _first_of_each(rows: NDArray[np.intp], owner: NDArray[np.intp]) -> list[int]:
    """Return the first row of each owner."""
    return [int(row) for row in rows[np.unique(owner[rows], return_index=True)[1]]]


def _wall_plates(
    sides: Sequence[_PlateSide],
    grounds: Grounds,
    middles: NDArray[np.float64],
    shown: Sequence[str],
    plates: Sequence[Placement],
) -> list[Placement]:
    """Return the plates on walls for stalls whose nearest plate shows another zone, if their zone has a wall."""
    if not sides:
        return []
    zones = np.array(shown)
    nearest, nearest_m = _nearest_plates(plates, middles, zones)
    missing = {*shown}.difference(nearest.tolist())
    places = np.array([side.middle for side in sides])
    _, beside = shapely.STRtree(grounds).query_nearest(shapely.points(places), all_matches=False)
    found: list[Placement] = []
    tried: set[int] = set()
    # a plate for one stall may be the nearest one to a stall of another zone, which then needs its own
    while wrong := {*np.flatnonzero(nearest != zones).tolist()} - tried:
        tried.add(stall := min(wrong))
        far_m = np.where(zones[beside] == zones[stall], distances_m(middles[stall], places), np.inf)
        side = sides[int(far_m.argmin())]
        if far_m.min() < nearest_m[stall] or (shown[stall] in missing and far_m.min() < np.inf):
            spec = ZonePlateSpec(shown[stall], side.width_m)
            found.append(placed(side.name, spec, side.middle, height_m=_FOOT_M, yaw_rad=side.yaw_rad))
            missing.discard(shown[stall])
            to_it_m = distances_m(middles, np.array(side.middle))
            to_it_m[((middles - side.middle) * cos_sin(side.yaw_rad)[::-1]).sum(axis=1) <= 0] = np.inf
            nearest = np.where(to_it_m < nearest_m, zones[stall], nearest)
            nearest_m = np.minimum(nearest_m, to_it_m)
    return found


def _nearest_plates(
    plates: Sequence[Placement], middles: NDArray[np.float64], zones: NDArray[np.str_]
) -> tuple[NDArray[np.str_], NDArray[np.float64]]:
    """Return text and distance of the nearest plate that faces each stall; empty and infinite without one in sight."""
    on_columns = [
        (plate.text, place.to_world(plate.middle), cos_sin(place.yaw_rad + plate.yaw_rad)[::-1])
        for place, spec in of_spec(plates, ColumnPlatesSpec)
        for plate in spec.plates()
    ]
    nearest, nearest_m = np.full(len(zones), "", dtype=zones.dtype), np.full(len(zones), np.inf)
    if on_columns:
        texts, at, ahead = map(np.array, zip(*on_columns, strict=True))
        stall, plate = shapely.STRtree(shapely.points(at)).query(shapely.points(middles), "dwithin", _SIGHT_M)
        is_before = ((middles[stall] - at[plate]) * ahead[plate]).sum(axis=1) > 0
        stall, plate = stall[is_before], plate[is_before]
        far_m = distances_m(middles[stall], at[plate])
        for row in _first_of_each(np.lexsort((plate, far_m.round(6), stall)), stall):
            nearest[stall[row]], nearest_m[stall[row]] = texts[plate[row]], far_m[row]
    return nearest, nearest_m
