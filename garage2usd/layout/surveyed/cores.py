"""Stair cores and blocks of a surveyed garage: where it has blocks, and on free ground beside its lanes."""

import math
from collections.abc import Iterable, Iterator, Sequence

import numpy as np
import shapely

from garage2usd.config import GarageConfig
from garage2usd.config.look import NATURAL, WallsLook
from garage2usd.layout.ceiling.beams import ceiling_levels
from garage2usd.layout.egress.cores import (
    FROM_COLUMN_M,
    MOST_WIDTH_M,
    RECESS_M,
    Core,
    core_placements,
    gap_to_stalls_m,
    is_wide_enough,
)
from garage2usd.layout.egress.exits import exits_asked, price_off_straight_m, reach_to_exits_m
from garage2usd.layout.egress.shafts import Places, chosen_shafts
from garage2usd.layout.placement import PlacedStall, Placement, placed, rounded, sum_of_yaws
from garage2usd.layout.surveyed.tiles import SurveyedTiles
from garage2usd.layout.tiles import Tile
from garage2usd.native import elementary
from garage2usd.objects.kind import Polygon
from garage2usd.objects.obstacle import ObstacleSpec
from garage2usd.structure.stalls import Edge

_FROM_REAR_M = 0.2
_BESIDE_M = 0.8
"""Distance from the side of a block at which the lane before its door is looked for."""
_RECTANGULAR = 0.98
"""Least share of its rectangle that a block fills to be one."""
_TOUCH_M = 0.01
_LONGEST_M = 15.0
"""Greatest distance between two corners of a stall or column."""
_SOLIDS = -4
"""First number of the pairs by which blocks are known: no (row, col) of a tile."""


def surveyed_cores(
    tiles: SurveyedTiles, stalls: Sequence[PlacedStall], pillars: Iterable[Placement], config: GarageConfig
) -> tuple[Core, ...]:
    """Choose the stair cores of a surveyed garage as `garage2usd.layout.egress.exits.plan_egress` does.

    Its rectangular blocks beside lanes are cores. Further ones stand on free pieces along the axes of the garage that
    have a lane beside them; there may be too few, as no stall makes room for one.
    """
    fixed = list(_cores_of_blocks(tiles))
    gap_m = gap_to_stalls_m(config.bay.stall_width_m, config.standard)
    beside = [(stall.corners_m(), gap_m) for stall in stalls]
    beside += [(outline, FROM_COLUMN_M) for pillar in pillars for outline in pillar.outlines()]
    candidates = [
        core
        for tile, edge, lane in tiles.free_beside_lanes()
        if (core := _core(tile, edge, lane, beside, config)) is not None
    ]
    if not config.fittings.stair_cores or not candidates:
        return tuple(fixed)
    sprinklered = ceiling_levels(config.fittings).pipe_drop_m is not None
    exits, reach_m = exits_asked(config.standard), reach_to_exits_m(config.standard, sprinklered=sprinklered)
    straight = [tiles.tiles[core.lane].axis_is_x is core.along_x for core in candidates]
    places = Places(
        [(core,) for core in candidates],
        np.array([[core.door_m for core in candidates]]),
        np.array([price_off_straight_m(is_straight=each) for each in straight]),
        np.zeros(len(candidates), np.intp),
        [{core.square} for core in candidates],
        np.arange(len(candidates)),
    )
    points = np.array([stall.centre_m for stall in stalls])
    doors = np.array([[core.door_m for core in fixed]]).reshape(1, -1, 2)
    chosen = chosen_shafts([points], places, doors, exits, reach_m, 0)
    return (*fixed, *(core for (core,) in chosen if core is not None))


def surveyed_blocks(tiles: SurveyedTiles, cores: Sequence[Core], height_m: float, look: WallsLook) -> list[Placement]:
    """Place the cores, and the other blocks of a survey as boxes of the size of their smallest rectangles."""
    has_door = {core.square for core in cores}
    dado_m = None if look.dado == NATURAL else look.dado_m
    found = []
    for number, solid in enumerate(tiles.solids):
        if (_SOLIDS, number) in has_door:
            continue
        box = shapely.get_coordinates(shapely.oriented_envelope(solid))
        (x0, z0), (x1, z1), (x2, z2) = box[:3].tolist()
        spec = ObstacleSpec(
            round(math.dist((x0, z0), (x1, z1)), 6),
            round(math.dist((x1, z1), (x2, z2)), 6),
            height_m,
            has_door=False,
            dado_m=dado_m,
        )
        yaw_rad = sum_of_yaws(0.0, elementary.arctan2(z0 - z1, x1 - x0))
        found.append(placed(f"Obstacle_{number:03d}", spec, ((x0 + x2) / 2, (z0 + z2) / 2), yaw_rad=yaw_rad))
    return found + core_placements(None, list(cores), height_m, look)


def _cores_of_blocks(tiles: SurveyedTiles) -> Iterator[Core]:
    """Yield the core of each rectangular block along the axes that is large enough and has a lane beside it."""
    for number, solid in enumerate(tiles.solids):
        left, top, right, bottom = solid.bounds
        if solid.area < _RECTANGULAR * (right - left) * (bottom - top):
            continue
        middle = (left + right) / 2, (top + bottom) / 2
        for edge in (Edge.DOWN, Edge.UP, Edge.LEFT, Edge.RIGHT):
            before = {
                Edge.DOWN: (middle[0], bottom + _BESIDE_M),
                Edge.UP: (middle[0], top - _BESIDE_M),
                Edge.LEFT: (left - _BESIDE_M, middle[1]),
                Edge.RIGHT: (right + _BESIDE_M, middle[1]),
            }[edge]
            sides = (right - left, bottom - top) if edge.along_x else (bottom - top, right - left)
            lane = tiles.lane_at(before)
            if lane is not None and is_wide_enough(*sides):
                width_m, depth_m = rounded(sides)
                yield Core((_SOLIDS, number), edge, rounded(middle), width_m, depth_m, lane_square=lane.square)
                break


def _core(
    tile: Tile,
    edge: Edge,
    lane: Tile,
    beside: Sequence[tuple[Polygon, float]],
    config: GarageConfig,
) -> Core | None:
    """Return the core on a free piece with its door over one edge, clear of grounds beside; None without room."""
    if tile.yaw_rad:
        return None
    side_m, across_m = (tile.width_m, tile.depth_m) if edge.along_x else (tile.depth_m, tile.width_m)
    low_m, high_m = -side_m / 2, side_m / 2
    rear_m = min(config.bay.stall_length_m, across_m) - _FROM_REAR_M
    for ground, clear_m in beside:
        if math.dist(ground[0], tile.middle_m) > side_m + across_m + _LONGEST_M:
            continue
        local = np.array([tile.local(corner) for corner in ground])
        along, across = local.T if edge.along_x else local.T[::-1]
        inwards = across_m / 2 + (across if edge in {Edge.UP, Edge.LEFT} else -across)
        if inwards.max() < _TOUCH_M or along.min() - clear_m > high_m or along.max() + clear_m < low_m:
            continue
        if inwards.min() > across_m - _TOUCH_M:
            rear_m = min(rear_m, float(inwards.min()) - clear_m)
        elif along.mean() < 0:
            low_m = max(low_m, float(along.max()) + clear_m)
        else:
            high_m = min(high_m, float(along.min()) - clear_m)
    width_m = min(high_m - low_m, MOST_WIDTH_M)
    depth_m = rear_m - RECESS_M
    if not is_wide_enough(width_m, depth_m):
        return None
    along_m, inwards_m = (low_m + high_m) / 2, RECESS_M + depth_m / 2
    point = {
        Edge.UP: (along_m, inwards_m - tile.half_z_m),
        Edge.DOWN: (along_m, tile.half_z_m - inwards_m),
        Edge.LEFT: (inwards_m - tile.half_x_m, along_m),
        Edge.RIGHT: (tile.half_x_m - inwards_m, along_m),
    }[edge]
    return Core(
        tile.square,
        edge,
        rounded(tile.at(point)),
        round(width_m, 6),
        round(depth_m, 6),
        along_m=round(along_m, 6),
        recess_m=RECESS_M,
        lane_square=lane.square,
    )
