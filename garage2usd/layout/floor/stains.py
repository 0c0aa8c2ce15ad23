"""Stains and wear of the floor: oil, damp, cracks, patches, tyre marks, and wheel tracks that darken the lanes.

A stain stays inside its square. Equal squares with equal random numbers therefore stay equal.
"""
# Over 300 lines: all kinds of stains share the free floor of a square, so that they do not overlap.

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from functools import lru_cache

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.common.randomness import Step
from garage2usd.config import FittingsConfig
from garage2usd.config.look import Dirt
from garage2usd.garage import StallUse
from garage2usd.layout.draws import SquareDraws
from garage2usd.layout.placement import PlacedStall, Placement, edge_yaw_rad, of_spec, placed, sum_of_yaws, to_world
from garage2usd.layout.tiles import Tile, Tiles
from garage2usd.objects.drain import DrainSpec
from garage2usd.objects.floor_stain import DirtSpec, StainMark, StainSpec, TyreMarkSpec
from garage2usd.objects.kind import Point, Spec
from garage2usd.objects.panel import PanelSpec
from garage2usd.structure.grid import Cell
from garage2usd.structure.lane_graph import Square
from garage2usd.structure.stalls import Edge

_WEAR_LIFT_M = 0.0008
_CONCRETE_LIFT_M = 0.0012
_TYRE_LIFT_M = 0.0016
_OIL_LIFT_M = 0.002
"""Heights over the floor; stains that may overlap have different heights."""
_SIZES_M = {
    StainMark.OIL: ((0.9, 0.9), (0.7, 0.7), (0.5, 0.5)),
    StainMark.DRIPS: ((0.7, 1.4),),
    StainMark.DAMP: ((2.4, 2.4),),
    StainMark.CRACK: ((1.0, 3.0),),
    StainMark.PATCH: ((0.9, 0.9), (0.8, 1.6)),
}
_VARIANTS = {StainMark.OIL: 6, StainMark.PATCH: 2, StainMark.CRACK: 2}
_WEAR_VARIANTS = 2
_ON_LANES: tuple[tuple[StainMark, float, float], ...] = (
    (StainMark.DAMP, 0.3, _CONCRETE_LIFT_M),
    (StainMark.CRACK, 0.6, _CONCRETE_LIFT_M),
    (StainMark.PATCH, 0.4, _CONCRETE_LIFT_M),
    (StainMark.DRIPS, 0.6, _OIL_LIFT_M),
    (StainMark.OIL, 0.7, _OIL_LIFT_M),
    (StainMark.OIL, 0.4, _OIL_LIFT_M),
)
"""Possible stains of a lane square: mark, share of the squares at the greatest wear, height over the floor."""
_LANE_SLOTS = len(_ON_LANES) + 2
"""Random numbers of a lane square: its stains, brake marks and wear; one for each turn into a stall follows."""
_BRAKED_SHARE = 0.7
_TURNED_SHARE = 0.35
_LEAKED_SHARE = 0.85
_DRIVEN_IN_SHARE = 0.5
_HALF_GAUGE_M = 0.9
"""Distance from the middle of a pair of tyre marks to its outer border."""
_BRAKE_LENGTHS_M = (2.4, 3.6)
_TURN_LENGTH_M = 4.6
_TURN_RAD = math.radians(68)
_STALL_MARK_M = 3.2
_ENGINE_FROM_REAR_M = (1.0, 1.6)
_ENGINE_ASIDE_M = 0.3
_YAWS = 16
_DRAWS = 5
"""Random numbers of each stain: presence, variant, size or yaw, and place across and along."""
_PATCH_FROM_PAINT_M = 0.05
Box = tuple[float, float, float, float]
"""Bounding box: least x and z, greatest x and z, metres from the middle of a square."""
_LIFT_M = 0.0004
"""Height over the floor, below all stains."""
_SLOTS = ((StainMark.REPAIR, 0.3), (StainMark.SEAM, 0.85), (StainMark.SEAM, 0.7), (StainMark.SEAM, 0.5))
"""Possible repairs of a square: mark, and share of the squares."""
_TRIES, _REPAIR_DRAWS = 3, 4
"""Places tried for each repair, and random numbers of each place."""
_REPAIR_SIZES_M = {
    StainMark.SEAM: ((1.0, 4.0), (1.1, 3.2), (0.8, 2.4)),
    StainMark.REPAIR: ((1.4, 1.4), (1.1, 2.2), (2.4, 1.6), (0.8, 3.2)),
}
_REPAIR_VARIANTS = 4
_QUARTER_TURN = np.pi / 2


@dataclass
class _SquareStains:
    """The stains of one square, in the coordinates of its tile."""

    tile: Tile
    drain: Box | None = None
    placed: list[Placement] = field(default_factory=list)
    boxes: list[tuple[float, Box]] = field(default_factory=list)

    def put(self, name: str, spec: StainSpec | TyreMarkSpec, place: Point, yaw_rad: float, lift_m: float) -> None:
        """Add a stain, unless it overlaps another one of the same height, or is damage of the concrete on a drain."""
        box = stain_box(spec, place, yaw_rad)
        if any(lift_m == height and overlap(box, other) for height, other in self.boxes):
            return
        self.boxes.append((lift_m, box))
        if lift_m == _CONCRETE_LIFT_M and self.drain is not None and overlap(box, self.drain):
            return
        self.placed.append(self.tile.placed(name, spec, place, height_m=lift_m, yaw_rad=yaw_rad))


def floor_stains(
    grid: Tiles,
    floors: Iterable[Placement],
    stalls: Iterable[PlacedStall],
    fittings: FittingsConfig,
    draws: SquareDraws,
    dirt: Dirt = Dirt.USUAL,
    drains: Iterable[Placement] = (),
) -> Iterator[Placement]:
    """Place the stains of all squares.

    Parameters
    ----------
    grid
        Squares of the garage in metres.
    floors
        Floor panels in the same order; patches avoid their markings.
    stalls
        All stalls, in the order of their squares.
    fittings
        Settings with the rate of floor stains.
    draws
        Random numbers of each square.
    dirt
        Darkness of the wheel tracks on lanes.
    drains
        All drains; cracks, patches and damp avoid them.
    """
    rate = fittings.floor_stain_rate
    if not rate:
        return
    stalls_on = grid.stalls_on(stalls)
    most = max((len(row) for row in stalls_on.values()), default=0)
    numbers = draws.of_step(Step.FLOOR_STAINS, max(_LANE_SLOTS + most, 2 * most), _DRAWS)
    drain_on = {drain.square: (drain, spec) for drain, spec in of_spec(drains, DrainSpec)}
    for tile, panel in zip(grid, floors, strict=True):
        floor = _SquareStains(tile, drain_box_on(tile, *drain_on[tile.square]) if tile.square in drain_on else None)
        drawn = numbers[tile.square]
        if tile.cell is Cell.FREE:
            _stain_stalls(floor, stalls_on.get(tile.square, []), drawn, rate)
        elif dirt is not Dirt.SWEPT:
            _wear_lane(floor, drawn, dirt)
        if tile.cell is Cell.LANE:
            _stain_lane(floor, panel.spec, grid.setback_m, drawn, rate)
            mouths = [(edge, stall) for edge in Edge for stall in grid.opening_on(tile, edge, stalls_on)]
            _mark_turns(floor, mouths, grid.setback_m, drawn, rate)
        yield from floor.placed


def _stain_stalls(floor: _SquareStains, stalls: list[PlacedStall], drawn: NDArray[np.float64], rate: float) -> None:
    """Add oil below the engines of parked cars, and tyre marks of cars that drove in."""
    for index, stall in enumerate(stalls):
        (there, variant, _, across, along), (driven, tyre, _, aside, end) = drawn[2 * index : 2 * index + 2].tolist()
        if not stall.use.takes_cars or stall.use is StallUse.EV:
            continue
        rear = -stall.length_m / 2
        number = stall.ordinal
        if driven < rate * _DRIVEN_IN_SHARE:
            room = max(stall.width_m / 2 - _HALF_GAUGE_M - 0.1, 0.0)
            tail = max(stall.length_m - _STALL_MARK_M - 1.2, 0.0)
            place = _to_tile(floor.tile, stall, ((2 * aside - 1) * room, rear + 1.1 + end * tail))
            spec = TyreMarkSpec(int(tyre * 2), _STALL_MARK_M)
            floor.put(f"TyreMarks_{number}", spec, place, sum_of_yaws(stall.yaw_rad, -floor.tile.yaw_rad), _TYRE_LIFT_M)
        if there < rate * _LEAKED_SHARE:
            first, last = _ENGINE_FROM_REAR_M
            local = (2 * across - 1) * _ENGINE_ASIDE_M, rear + first + (last - first) * along
            oil = _stain(StainMark.OIL, variant)
            floor.put(f"Oil_{number}", oil, _to_tile(floor.tile, stall, local), drawn_yaw(variant), _OIL_LIFT_M)


def _to_tile(tile: Tile, stall: PlacedStall, local: Point) -> Point:
    """Convert a point from the coordinates of a stall to those of a tile."""
    return tile.local(stall.to_world(local))


def _wear_lane(floor: _SquareStains, drawn: NDArray[np.float64], dirt: Dirt) -> None:
    """Darken a lane square along the wheel tracks of cars."""
    tile = floor.tile
    ways = [edge for edge in Edge if tile.drivable[edge]]
    if not ways:  # an isolated lane square
        return
    mark, towards = _wear_pattern(ways)
    yaw = edge_yaw_rad(towards)
    sides = tile.width_m, tile.depth_m
    width, depth = sides if towards.along_x else sides[::-1]
    variant, side, *_ = drawn[_LANE_SLOTS - 1].tolist()
    kind = int(variant * _WEAR_VARIANTS) if mark is StainMark.WEAR_STRAIGHT else 0
    if mark is StainMark.WEAR_STRAIGHT and side < 1 / 2:
        yaw = edge_yaw_rad(towards.opposite)
    is_usual = dirt is Dirt.USUAL
    spec = StainSpec(mark, kind, width, depth) if is_usual else DirtSpec(mark, kind, width, depth, dirt)
    floor.put("Wear", spec, (0.0, 0.0), yaw, _WEAR_LIFT_M)


_RIGHT_OF = {Edge.DOWN: Edge.RIGHT, Edge.RIGHT: Edge.UP, Edge.UP: Edge.LEFT, Edge.LEFT: Edge.DOWN}
"""Edge on a wear pattern's +X side, by the edge on its +Z side."""


def _wear_pattern(ways: list[Edge]) -> tuple[StainMark, Edge]:
    """Return the wear pattern for a lane square's open edges, and the edge on the pattern's +Z side."""
    missing = [edge for edge in Edge if edge not in ways]
    if not missing:
        return StainMark.WEAR_CROSS, Edge.DOWN
    if len(missing) == 1:
        return StainMark.WEAR_T, missing[0].opposite
    bends = [edge for edge in ways if _RIGHT_OF[edge] in ways]
    return (StainMark.WEAR_BEND, bends[0]) if bends else (StainMark.WEAR_STRAIGHT, ways[0])


def _stain_lane(floor: _SquareStains, panel: Spec, setback_m: float, drawn: NDArray[np.float64], rate: float) -> None:
    """Add damp, cracks, patches, oil and brake marks to a lane square."""
    tile = floor.tile
    for slot, ((mark, share, lift_m), numbers) in enumerate(zip(_ON_LANES, drawn.tolist(), strict=False), 1):
        there, variant, size, across, along = numbers
        if there >= rate * share:
            continue
        spec = _stain(mark, variant)
        yaw = drawn_yaw(size) if mark is not StainMark.PATCH else 0.0
        place = _offset_within(tile, setback_m, stain_box(spec, (0.0, 0.0), yaw), across, along)
        if place is None or (mark is StainMark.PATCH and overlaps_paint(panel, stain_box(spec, place, yaw))):
            continue
        floor.put(f"{mark.value.capitalize()}_{slot}", spec, place, yaw, lift_m)
    there, variant, size, across, along = drawn[len(_ON_LANES)].tolist()
    if tile.axis_is_x is not None and there < rate * _BRAKED_SHARE:
        ends = (Edge.LEFT, Edge.RIGHT) if tile.axis_is_x else (Edge.UP, Edge.DOWN)
        yaw = edge_yaw_rad(ends[size >= 1 / 2])
        marks = TyreMarkSpec(int(variant * 2), _BRAKE_LENGTHS_M[int(size * 8) % 2])
        place = _offset_within(tile, setback_m, stain_box(marks, (0.0, 0.0), yaw), across, along)
        if place is not None:
            floor.put("BrakeMarks", marks, place, yaw, _TYRE_LIFT_M)


def _drain_box(drain: Placement, spec: DrainSpec) -> Box:
    """Return the bounding box of an axis-aligned drain in the garage."""
    x, _, z = drain.position_m
    half_x, half_z = spec.width_m / 2, spec.length_m / 2
    if drain.yaw_rad:
        half_x, half_z = half_z, half_x
    return x - half_x, z - half_z, x + half_x, z + half_z


def drain_box_on(floor: Tile | Placement, drain: Placement, spec: DrainSpec) -> Box:
    """Return the bounding box of an axis-aligned drain in the coordinates of a tile or panel."""
    x, z = floor.local((drain.position_m[0], drain.position_m[2]))
    turned = replace(drain, position_m=(x, 0.0, z), yaw_rad=sum_of_yaws(drain.yaw_rad, -floor.yaw_rad))
    return _drain_box(turned, spec)


def _mark_turns(
    floor: _SquareStains,
    stalls: list[tuple[Edge, PlacedStall]],
    setback_m: float,
    drawn: NDArray[np.float64],
    rate: float,
) -> None:
    """Add the curved tyre marks of cars that turned into stalls over edges of a lane square."""
    tile = floor.tile
    for index, ((mouth, stall), numbers) in enumerate(zip(stalls, drawn[_LANE_SLOTS:].tolist(), strict=False)):
        there, variant, size, *_ = numbers
        if there >= rate * _TURNED_SHARE:
            continue
        turn = _TURN_RAD if size < 1 / 2 else -_TURN_RAD
        place = _to_tile(tile, stall, (0.0, stall.length_m / 2 + 0.02))
        yaw = sum_of_yaws(stall.yaw_rad, -tile.yaw_rad)
        for signed in (turn, -turn):
            spec = TyreMarkSpec(int(variant * 2), _TURN_LENGTH_M, round(signed, 6))
            x0, z0, x1, z1 = stain_box(spec, place, yaw)
            # the mark ends at the mouth's edge and keeps the cars' distance from the other edges
            if _lies_within(tile, (x0, z0, x1, z1), setback_m, mouth):
                floor.put(f"TurnMarks_{index + 1}", spec, place, yaw, _TYRE_LIFT_M)
                break


def _lies_within(tile: Tile, box: Box, setback_m: float, mouth: Edge) -> bool:
    """Return True if a box keeps the setback from all edges of a tile; at the edge of the mouth, no setback."""
    limits = {
        Edge.LEFT: tile.half_x_m + box[0],
        Edge.UP: tile.half_z_m + box[1],
        Edge.RIGHT: tile.half_x_m - box[2],
        Edge.DOWN: tile.half_z_m - box[3],
    }
    return all(room >= (0.0 if edge is mouth else setback_m) for edge, room in limits.items())


def _stain(mark: StainMark, variant: float) -> StainSpec:
    """Return the stain of a mark by a random number from 0 to 1."""
    sizes = _SIZES_M[mark]
    kind = int(variant * _VARIANTS.get(mark, 1))
    # one size for each variant limits the number of prototypes
    return StainSpec(mark, kind, *sizes[kind % len(sizes)])


def drawn_yaw(draw: float) -> float:
    """Return one of sixteen yaws by the last digits of a random number."""
    return int(draw * 1000 * _YAWS) % _YAWS * (math.tau / _YAWS) - math.pi


def _offset_within(tile: Tile, setback_m: float, box: Box, across: float, along: float) -> Point | None:
    """Return an offset that keeps a box inside the borders of a square; None if the box is too large."""
    x0, z0 = setback_m - tile.half_x_m - box[0], setback_m - tile.half_z_m - box[1]
    x1, z1 = tile.half_x_m - setback_m - box[2], tile.half_z_m - setback_m - box[3]
    if x0 > x1 or z0 > z1:
        return None
    return x0 + (x1 - x0) * across, z0 + (z1 - z0) * along


def overlaps_paint(panel: Spec, box: Box) -> bool:
    """Return True if a box overlaps a marking of a panel."""
    return isinstance(panel, PanelSpec) and any(overlap(box, paint) for paint in _marking_boxes(panel))


@lru_cache(maxsize=4096)
def _marking_boxes(panel: PanelSpec) -> tuple[Box, ...]:
    """Return the bounding boxes of a panel's markings, with a gap around each."""
    gap = _PATCH_FROM_PAINT_M
    corners = [np.array(marking.polygon) for marking in panel.markings]
    return tuple((*(shape.min(axis=0) - gap).tolist(), *(shape.max(axis=0) + gap).tolist()) for shape in corners)


def overlap(one: Box, other: Box) -> bool:
    """Return True if two boxes overlap."""
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]


def stain_box(spec: StainSpec | TyreMarkSpec, place: Point, yaw_rad: float) -> Box:
    """Return the bounding box of a stain at a place."""
    x0, z0, x1, z1 = _turned_box(spec, yaw_rad)
    return x0 + place[0], z0 + place[1], x1 + place[0], z1 + place[1]


@lru_cache(maxsize=4096)
def _turned_box(spec: StainSpec | TyreMarkSpec, yaw_rad: float) -> Box:
    """Return the bounding box of a rotated stain around the origin."""
    if isinstance(spec, StainSpec):
        x, z = spec.width_m / 2, spec.depth_m / 2
        corners = [(-x, -z), (-x, z), (x, z), (x, -z)]
    elif spec.turn_rad:
        radius = spec.length_m / abs(spec.turn_rad)
        side = math.copysign(1.0, spec.turn_rad)
        angles = [abs(spec.turn_rad) * step / 8 for step in range(9)]
        corners = [
            (side * (radius - r * math.cos(angle)), r * math.sin(angle))
            for angle in angles
            for r in (radius - _HALF_GAUGE_M, radius + _HALF_GAUGE_M)
        ]
    else:
        corners = [(x, z) for x in (-_HALF_GAUGE_M, _HALF_GAUGE_M) for z in (0.0, spec.length_m)]
    turned = [to_world(corner, (0.0, 0.0), yaw_rad) for corner in corners]
    xs, zs = zip(*turned, strict=True)
    return min(xs), min(zs), max(xs), max(zs)


def floor_repairs(
    floors: Iterable[Placement], draws: SquareDraws, drains: Iterable[Placement] = ()
) -> Iterator[Placement]:
    """Place sealed cracks and patches on the floor of each square, none over another, over a drain or an opening.

    Parameters
    ----------
    floors
        Floor panels of the squares, at most one on each. Patches avoid their markings, which cars wear off old cracks.
    draws
        Random numbers of each square.
    drains
        All drains.
    """
    numbers = draws.of_part(Step.FLOOR_STAINS, "repairs", len(_SLOTS), _TRIES, _REPAIR_DRAWS)
    drained = _drains_by_square(drains)
    for floor, panel in of_spec(floors, PanelSpec):
        if floor.square is None:
            continue
        # in the coordinates of the panel, as all that follows
        taken = [drain_box_on(floor, drain, spec) for drain, spec in drained.get(floor.square, [])]
        openings = shapely.union_all([shapely.Polygon(opening) for opening in panel.openings])
        half_x, half_z = panel.width_m / 2, panel.depth_m / 2
        for number, ((mark, share), tries) in enumerate(zip(_SLOTS, numbers[floor.square].tolist(), strict=True), 1):
            if tries[0][0] >= share:
                continue
            for there, turn, across, along in tries:
                sizes = _REPAIR_SIZES_M[mark]
                spec = StainSpec(mark, int(there * 1e3) % _REPAIR_VARIANTS, *sizes[int(there * 1e5) % len(sizes)])
                yaw = drawn_yaw(turn) if mark is StainMark.SEAM else int(2 * turn) * _QUARTER_TURN
                left, top, right, bottom = stain_box(spec, (0.0, 0.0), yaw)
                room_x, room_z = 2 * half_x - (right - left), 2 * half_z - (bottom - top)
                if min(room_x, room_z) < 0:
                    continue
                place = across * room_x - half_x - left, along * room_z - half_z - top
                box = stain_box(spec, place, yaw)
                if any(overlap(box, other) for other in taken) or openings.intersects(shapely.box(*box)):
                    continue
                if mark is StainMark.REPAIR and overlaps_paint(panel, box):
                    continue
                taken.append(box)
                name = f"{mark.value.capitalize()}_{number}"
                yaw = sum_of_yaws(yaw, floor.yaw_rad)
                yield placed(name, spec, floor.to_world(place), height_m=_LIFT_M, yaw_rad=yaw, square=floor.square)
                break


def _drains_by_square(drains: Iterable[Placement]) -> dict[Square | None, list[tuple[Placement, DrainSpec]]]:
    """Group the drains by square."""
    found: dict[Square | None, list[tuple[Placement, DrainSpec]]] = {}
    for drain, spec in of_spec(drains, DrainSpec):
        found.setdefault(drain.square, []).append((drain, spec))
    return found
