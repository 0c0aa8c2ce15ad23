"""Floor drains: gullies beside the centre line of lanes, channels along lanes and at vehicle doors."""

from collections.abc import Iterable, Iterator

import shapely

from garage2usd.config.look import Drains
from garage2usd.layout.placement import Placement, box_inside
from garage2usd.layout.tiles import Tile, Tiles
from garage2usd.objects.drain import CHANNEL_WIDTH_M, GULLY_SIDE_M, DrainSpec
from garage2usd.objects.outline import Point
from garage2usd.objects.panel import PanelSpec
from garage2usd.structure.grid import Cell
from garage2usd.structure.stalls import Edge

__all__ = ["drains"]

_LIFT_M = 0.0004
"""Height of drains over the continuous floor: below all stains, and negligible for tyres."""
_GULLY_SPACING = 3
"""Spacing of gullies along a lane, in squares."""
_GULLY_ASIDE_M, _GULLY_ALONG_M = (0.4, -0.4, 0.8, -0.8), (0.0, 0.9, -0.9)
_FROM_PAINT_M = 0.05
_CHANNEL_ASIDE_M = 0.3
"""Distance of a channel from a lane's centre line, clear of the dashes."""
_FROM_DOOR_M = 0.35
_QUARTER_TURN = 1.5707963267948966


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
                yield tile.placed("Gully", DrainSpec(GULLY_SIDE_M, GULLY_SIDE_M), (x, z), height_m=_LIFT_M)
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
    return tile.placed("Channel", spec, offset, height_m=_LIFT_M, yaw_rad=_QUARTER_TURN if along_x else 0.0)
