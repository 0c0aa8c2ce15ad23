"""Parking zones named by letter and number (``B2``), and the plates with their names on columns and walls."""

import string
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import starmap
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.layout.grounds import Grounds, distances_m, grounds_of
from garage2usd.layout.placement import PlacedStall, Placement, cos_sin, edge_yaw_rad, of_spec, placed, to_world
from garage2usd.objects.column import ColumnSpec
from garage2usd.objects.kind import Point
from garage2usd.objects.wall import WallSpec
from garage2usd.objects.zone_plate import ColumnPlatesSpec, ZonePlateSpec
from garage2usd.structure.grid import Structure
from garage2usd.structure.lane_graph import Square
from garage2usd.structure.stalls import Edge

_LETTERS = "".join(letter for letter in string.ascii_uppercase if letter not in "IO")
_MAX_NUMBER = 99
_MIN_SIDE = 4
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
_EQUAL_DISTANCE_M = 1.0
"""Greatest difference in distance for the stalls before both halves of a side to count."""
_STRAIGHT_M = 0.01
"""Greatest lateral offset of a stall that counts for both halves."""


class Zone(NamedTuple):
    """Parking zone, a block of squares: letter of its columns, number of its rows from 1."""

    letter: str
    number: int

    def __str__(self) -> str:
        """Return the name of the zone: ``B2``."""
        return f"{self.letter}{self.number}"


class Zones:
    """Zones of a garage: blocks of 4 x 4 squares, larger if letters or numbers run out."""

    def __init__(self, structure: Structure) -> None:
        rows, columns = structure.shape
        self._side = max(_MIN_SIDE, -(-columns // len(_LETTERS)), -(-rows // _MAX_NUMBER))

    def of(self, square: Square) -> Zone:
        """Return the zone of a square (row, col)."""
        row, col = square
        return Zone(_LETTERS[col // self._side], row // self._side + 1)


def zone_of(number: str) -> str:
    """Return the name of the zone in a stall's number, ``B2`` of ``B2-07``; empty without one."""
    zone = number.rpartition("-")[0]
    return zone if len(zone) > 1 and zone[0] in string.ascii_uppercase and set(zone[1:]) <= {*string.digits} else ""


def with_numbers(stalls: Iterable[PlacedStall], zones: Zones | None) -> tuple[PlacedStall, ...]:
    """Number the stalls, for example ``B2-07`` by zone, or ``007`` in a garage without zones.

    Stalls in which nobody parks have no number.
    """
    counts: Counter[Zone | None] = Counter()
    numbered = []
    for stall in stalls:
        if not stall.use.is_parked_in:
            numbered.append(stall)
            continue
        zone = zones.of(stall.square) if zones else None
        counts[zone] += 1
        number = f"{zone}-{counts[zone]:02d}" if zone else f"{counts[zone]:03d}"
        numbered.append(replace(stall, number=number))
    return tuple(numbered)


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
        Zone of the nearest stall, and distance to its ground; empty and infinite without a stall in sight.
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
    halves: list[list[_NearestStall]] = []
    for turn in (-1, 1):
        place = at + turn * off_m * right
        far_m = shapely.distance(shapely.points(place[side]), grounds[stall]).round(6)
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
    on_columns = [
        (plate.text, place.to_world(plate.middle))
        for place, spec in of_spec(plates, ColumnPlatesSpec)
        for plate in spec.plates()
    ]
    text = np.array([zone for zone, _ in on_columns], dtype=zones.dtype)
    nearest, nearest_m = np.full(len(zones), "", dtype=zones.dtype), np.full(len(zones), np.inf)
    if len(text):
        at = shapely.points([middle for _, middle in on_columns])
        (_, number), nearest_m = shapely.STRtree(at).query_nearest(
            shapely.points(middles), all_matches=False, return_distance=True
        )
        nearest = text[number]
    missing = {*shown}.difference(text.tolist())
    places = np.array([side.middle for side in sides])
    _, beside = shapely.STRtree(grounds).query_nearest(shapely.points(places), all_matches=False)
    found: list[Placement] = []
    for stall in np.flatnonzero(nearest != zones).tolist():
        far_m = np.where(zones[beside] == zones[stall], distances_m(middles[stall], places), np.inf)
        side = sides[int(far_m.argmin())]
        is_nearer = nearest[stall] != zones[stall] and far_m.min() < nearest_m[stall]
        if is_nearer or (shown[stall] in missing and far_m.min() < np.inf):
            spec = ZonePlateSpec(shown[stall], side.width_m)
            found.append(placed(side.name, spec, side.middle, height_m=_FOOT_M, yaw_rad=side.yaw_rad))
            missing.discard(shown[stall])
            to_it_m = distances_m(middles, np.array(side.middle))
            nearest = np.where(to_it_m < nearest_m, zones[stall], nearest)
            nearest_m = np.minimum(nearest_m, to_it_m)
    return found
