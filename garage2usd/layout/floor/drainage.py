"""Drainage of the floor: gullies and channels, and the puddles that stand near them and before ramps."""

import math
from collections.abc import Iterable, Iterator, Mapping

import shapely

from garage2usd.common.randomness import Step
from garage2usd.config.look import Drains
from garage2usd.layout.draws import SquareDraws
from garage2usd.layout.placement import Placement, box_inside, of_spec, sum_of_yaws, to_world
from garage2usd.layout.tiles import Tile, Tiles
from garage2usd.native import elementary
from garage2usd.objects.drain import CHANNEL_WIDTH_M, GULLY_SIDE_M, DrainSpec
from garage2usd.objects.floor_stain import PuddleSpec
from garage2usd.objects.kind import Point
from garage2usd.objects.panel import PanelSpec
from garage2usd.structure.grid import Cell
from garage2usd.structure.lane_graph import Square
from garage2usd.structure.stalls import Edge

_DRAIN_LIFT_M = 0.0004
"""Height of drains over the continuous floor: below all stains, and negligible for tyres."""
_GULLY_SPACING = 3
"""Spacing of gullies along a lane, in squares."""
_GULLY_ASIDE_M, _GULLY_ALONG_M = (0.4, -0.4, 0.8, -0.8), (0.0, 0.9, -0.9)
_FROM_PAINT_M = 0.05
_CHANNEL_ASIDE_M = 0.3
"""Distance of a channel from a lane's centre line, clear of the dashes."""
_FROM_DOOR_M = 0.35
_QUARTER_TURN = 1.5707963267948966
_PUDDLE_LIFT_M = 0.0024
"""Height above the floor: above all stains, which show through the water."""
_SIZES_M = ((3.0, 2.0), (2.2, 1.4), (1.5, 1.1), (0.9, 0.7))
_VARIANTS, _YAWS = 12, 16
_LOW_WEIGHT = 3.0
"""Relative probability of a puddle in a low place, at a drain or before a ramp."""
_NUMBERS = 6
"""Random numbers of each square: presence, variant, size, yaw, and position across and along."""
_AROUND_DRAIN_M = 0.7
_LEAST_DRAW = 1e-12


def drains(grid: Tiles, floors: Iterable[Placement], wanted: Drains) -> Iterator[Placement]:
    """Place the drains of all squares.

    Parameters
    ----------
    grid
        Squares of the garage in metres.
    floors
        Floor panels in the same order; gratings avoid their markings.
    wanted
        Kind of drains.
    """
    for tile, panel in zip(grid, floors, strict=True):
        if wanted is Drains.GRATINGS and tile.cell is Cell.LANE and sum(tile.square) % _GULLY_SPACING == 0:
            yield from _gully(tile, panel)
        elif wanted is Drains.CHANNELS and tile.cell is Cell.LANE:
            yield from _lane_channel(tile, grid.setback_m)
        elif wanted is Drains.CHANNELS and tile.square in grid.doors:
            yield _door_channel(tile, grid.doors[tile.square], grid.setback_m)


def _gully(tile: Tile, panel: Placement) -> Iterator[Placement]:
    """Yield a gully at the first place without paint beside the lane's centre line, if any."""
    along_x, half = tile.axis_is_x is not False, GULLY_SIDE_M / 2 + _FROM_PAINT_M
    markings = panel.spec.markings if isinstance(panel.spec, PanelSpec) else ()
    paint = shapely.union_all([shapely.Polygon(marking.polygon) for marking in markings])
    for along in _GULLY_ALONG_M:
        for aside in _GULLY_ASIDE_M:
            x, z = (along, aside) if along_x else (aside, along)
            if not paint.intersects(shapely.box(x - half, z - half, x + half, z + half)):
                yield tile.placed("Gully", DrainSpec(GULLY_SIDE_M, GULLY_SIDE_M), (x, z), height_m=_DRAIN_LIFT_M)
                return


def _lane_channel(tile: Tile, setback_m: float) -> Iterator[Placement]:
    """Yield the channel of a straight lane square or dead end, continuous with those of adjacent squares."""
    up, down, left, right = (tile.drivable[edge] for edge in Edge)
    along_x = tile.axis_is_x
    if along_x is None:
        if not (left and right) and not (up and down):
            return
        along_x = left and right
    (open_start, open_end), half = ((left, right), tile.half_x_m) if along_x else ((up, down), tile.half_z_m)
    start = -half if open_start else setback_m - half
    end = half if open_end else half - setback_m
    middle = (start + end) / 2
    offset = (middle, _CHANNEL_ASIDE_M) if along_x else (_CHANNEL_ASIDE_M, middle)
    yield _channel(tile, end - start, offset, along_x=along_x)


def _door_channel(tile: Tile, door: Edge, setback_m: float) -> Placement:
    """Return the channel across a portal, for the water from the ramp."""
    half = tile.half_x_m, tile.half_z_m
    reach = (half[0] if door.along_x else half[1]) - setback_m
    depth = _FROM_DOOR_M, _FROM_DOOR_M + CHANNEL_WIDTH_M
    x0, z0, x1, z1 = box_inside(door, half, (-reach, reach), depth)
    return _channel(tile, 2 * reach, ((x0 + x1) / 2, (z0 + z1) / 2), along_x=door.along_x)


def _channel(tile: Tile, length_m: float, offset: Point, *, along_x: bool) -> Placement:
    """Return a channel of a length, `offset` (x, z) from the middle of its tile."""
    spec = DrainSpec(CHANNEL_WIDTH_M, round(length_m, 6))
    return tile.placed("Channel", spec, offset, height_m=_DRAIN_LIFT_M, yaw_rad=_QUARTER_TURN if along_x else 0.0)


def puddles(
    grid: Tiles,
    wet: float,
    drains: Iterable[Placement],
    bumps: Iterable[Placement],
    draws: SquareDraws,
) -> list[Placement]:
    """Place puddles on a share of the lane squares without a bump, clear of columns and stalls.

    The puddles of a larger share include those of a smaller one.

    Parameters
    ----------
    grid
        Squares of the garage in metres.
    wet
        Share of the squares, 0 to 1; rounded to whole squares.
    drains
        All drains.
    bumps
        Speed bumps; their squares stay dry.
    draws
        Random numbers for each square.
    """
    if not wet:
        return []
    drain_on = {drain.square: (drain, spec) for drain, spec in of_spec(drains, DrainSpec)}
    numbers = draws.of_step(Step.PUDDLES, _NUMBERS)
    with_bump = {bump.square for bump in bumps}
    lanes = [tile for tile in grid if tile.cell is Cell.LANE and tile.square not in with_bump]

    def dryness(tile: Tile) -> float:
        """Sort key of a square for a weighted sample: the squares with the least keys are sampled."""
        is_low = tile.square in drain_on or _is_before_ramp(tile, grid)
        return -elementary.log(max(1.0 - float(numbers[tile.square][0]), _LEAST_DRAW)) / (
            _LOW_WEIGHT if is_low else 1.0
        )

    count = round(wet * len(lanes))
    wettest = {tile.square for tile in sorted(lanes, key=dryness)[:count]}
    return [_puddle(tile, drain_on, grid, numbers[tile.square].tolist()) for tile in lanes if tile.square in wettest]


def _is_before_ramp(tile: Tile, grid: Tiles) -> bool:
    around = (grid.neighbour(tile, edge) for edge in Edge if tile.drivable[edge])
    return any(other is not None and other.cell in {Cell.ENTRANCE, Cell.EXIT} for other in around)


def _puddle(
    tile: Tile, drain_on: Mapping[Square | None, tuple[Placement, DrainSpec]], grid: Tiles, drawn: list[float]
) -> Placement:
    """Puddle of one square, with the drawn size or the greatest that fits."""
    _, shape, size, turn, across, along = drawn
    yaw = int(turn * _YAWS) * (math.tau / _YAWS) - math.pi
    variant = int(shape * _VARIANTS)
    half_x, half_z = tile.half_x_m - grid.setback_m, tile.half_z_m - grid.setback_m
    for width, depth in _SIZES_M[int(size * len(_SIZES_M)) :]:
        reach_x, reach_z = _reach(width, depth, yaw)
        if reach_x <= half_x and reach_z <= half_z:
            break
    room_x, room_z = max(half_x - reach_x, 0.0), max(half_z - reach_z, 0.0)
    x, z = (2 * across - 1) * room_x, (2 * along - 1) * room_z
    if tile.square in drain_on:
        drain, grating = drain_on[tile.square]
        # centred on a gully, or at a random position along a channel
        drain_x, drain_z = tile.local((drain.position_m[0], drain.position_m[2]))
        is_along_x = bool(sum_of_yaws(drain.yaw_rad, -tile.yaw_rad))
        aside_x, aside_z = (2 * across - 1) * _AROUND_DRAIN_M, (2 * along - 1) * _AROUND_DRAIN_M
        if not (grating.is_channel and is_along_x):
            x = min(max(drain_x + aside_x, -room_x), room_x)
        if not grating.is_channel or is_along_x:
            z = min(max(drain_z + aside_z, -room_z), room_z)
    spec = PuddleSpec(variant, width, depth)
    return tile.placed("Puddle", spec, (x, z), height_m=_PUDDLE_LIFT_M, yaw_rad=yaw)


def _reach(width_m: float, depth_m: float, yaw_rad: float) -> tuple[float, float]:
    """Half extents along X and Z of a rotated rectangle."""
    corners = [to_world((side * width_m / 2, depth_m / 2), (0.0, 0.0), yaw_rad) for side in (-1, 1)]
    return max(abs(x) for x, _ in corners), max(abs(z) for _, z in corners)
