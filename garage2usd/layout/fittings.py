"""Fittings of single squares: tube lights, speed bumps, cones."""

import math
from collections.abc import Collection, Container, Mapping

import numpy as np

from garage2usd.common.randomness import Step, generator
from garage2usd.config import FittingsConfig
from garage2usd.garage import LaneKind, StallUse
from garage2usd.layout.ceiling.beams import CeilingLevels
from garage2usd.layout.ceiling.lighting import TUBE
from garage2usd.layout.ceiling.services import LINES_REACH_M
from garage2usd.layout.draws import SquareDraws
from garage2usd.layout.egress.cores import Core
from garage2usd.layout.placement import PlacedStall, Placement, sum_of_yaws
from garage2usd.layout.tiles import Tile, Tiles
from garage2usd.objects.cone import ConeSpec
from garage2usd.objects.speed_bump import SPEED_BUMP_HEIGHT_M, SpeedBumpSpec
from garage2usd.profiles import Profile
from garage2usd.structure.grid import Cell
from garage2usd.structure.lane_graph import Square
from garage2usd.structure.stalls import Edge

_QUARTER_TURN = np.pi / 2
TUBE_DEPTH_M = 0.105
"""Depth of a tube light below the ceiling."""
_CONES_ACROSS_M = (-0.75, 0.0, 0.75)
_CONES_FROM_MOUTH_M = 0.9
_CONES_FROM_EDGE_M = 0.95
_TUBE_GAP_M = 0.1
_JUNCTION_TUBE_OFFSET_M = 1.2
_LOWEST_BUMP_M = 0.02


def tube_lights(
    grid: Tiles, fittings: FittingsConfig, levels: CeilingLevels, cores: Mapping[Square, Core] | None = None
) -> list[Placement]:
    """Place tube lights under the ceiling: in line along lanes, one over each square with stalls or a portal.

    Their number is limited by the space between beams and, over junctions and bends, between pipes and ducts at the
    same height. Beside a core, the tube hangs over the remaining stalls.
    """
    lights: list[Placement] = []
    for tile in grid:
        core = cores.get(tile.square) if cores else None
        if core is not None and grid.row_along_x(tile) is None:
            continue
        beside_m = core.beside_m(tile.half_x_m if core.along_x else tile.half_z_m) if core else 0.0
        along_x = _tube_along_x(tile, grid)
        along_m, across_m = (beside_m, 0.0) if core is None or core.along_x is along_x else (0.0, beside_m)
        count = fittings.tubes_per_cell if tile.cell is Cell.LANE else min(1, fittings.tubes_per_cell)
        length = tile.width_m if along_x else tile.depth_m
        is_crossed = tile.axis_is_x is None and levels.lines_beside_tubes
        room = length - 2 * (grid.setback_m + (LINES_REACH_M if is_crossed else 0.0)) - TUBE.length_m
        least_pitch = TUBE.length_m + _TUBE_GAP_M
        count = min(count, 1 + max(int(room / least_pitch), 0))
        pitch = min(length / max(count, 1), room / max(count - 1, 1))
        if tile.axis_is_x is None:
            pitch = min(pitch, 2 * _JUNCTION_TUBE_OFFSET_M)
        for index in range(count):
            offset = along_m + (index - (count - 1) / 2) * max(pitch, least_pitch)
            point = (offset, across_m) if along_x else (across_m, offset)
            yaw, height = 0.0 if along_x else _QUARTER_TURN, fittings.ceiling_height_m
            lights.append(tile.placed(f"Tube_{index + 1}", TUBE, point, height_m=height, yaw_rad=yaw))
    return lights


def _tube_along_x(tile: Tile, grid: Tiles) -> bool:
    if tile.cell is Cell.FREE:
        return grid.row_along_x(tile) is not False
    return tile.axis_is_x is not False


def speed_bumps(
    grid: Tiles,
    fittings: FittingsConfig,
    profile: Profile,
    *,
    seed: int,
    crossings: Collection[Square] = (),
) -> list[Placement]:
    """Place speed bumps across straight lanes, never on two consecutive squares and never on a crossing.

    There are none if the height limit of the profile makes them ineffective.
    """
    clause = profile.speed_bump_height
    height_m = min(SPEED_BUMP_HEIGHT_M, clause.amount if clause else math.inf)
    if height_m < _LOWEST_BUMP_M:
        return []
    rng = generator(seed, Step.SPEED_BUMPS)
    bumps: dict[Square, Placement] = {}
    for tile in grid:
        straight = tile.cell is Cell.LANE and tile.kind is LaneKind.STRAIGHT
        if not straight or tile.axis_is_x is None or sum(tile.drivable) != 2:  # noqa: PLR2004
            continue
        wanted = rng.random() < fittings.speed_bump_rate
        beside = (grid.neighbour(tile, edge) for edge in Edge)
        if not wanted or tile.square in crossings or any(other and other.square in bumps for other in beside):
            continue
        spec = SpeedBumpSpec(round(tile.clear_m[int(tile.axis_is_x)] - 0.2, 3), height_m)
        yaw = sum_of_yaws(_QUARTER_TURN if tile.axis_is_x else 0.0, tile.yaw_rad)
        bumps[tile.square] = Placement("SpeedBump", spec, (tile.x_m, 0.0, tile.z_m), yaw, tile.square)
    return list(bumps.values())


def cones(
    grid: Tiles,
    stalls: tuple[PlacedStall, ...],
    taken: Container[str],
    fittings: FittingsConfig,
    draws: SquareDraws,
    *,
    built_on: Container[Square] = (),
) -> list[Placement]:
    """Place cones across the entries of some free standard stalls, and on corners of some hatched squares."""
    most = max((stall.ordinal for stall in stalls), default=0)
    numbers = draws.of_step(Step.CONES, most + 1)
    found: list[Placement] = []
    for stall in stalls:
        is_drawn = numbers[stall.square][stall.ordinal] < fittings.cone_rate
        if is_drawn and stall.use is StallUse.STANDARD and stall.name not in taken:
            along = stall.length_m / 2 - _CONES_FROM_MOUTH_M
            found += [
                stall.placement("Cone", ConeSpec(), (across, along), piece=piece)
                for piece, across in enumerate(_CONES_ACROSS_M, start=1)
            ]
    for tile in grid:
        x, z = tile.half_x_m - _CONES_FROM_EDGE_M, tile.half_z_m - _CONES_FROM_EDGE_M
        is_hatched = tile.square not in built_on and grid.is_bare(tile)
        if is_hatched and min(x, z) > _CONES_FROM_EDGE_M and numbers[tile.square][0] < fittings.cone_rate:
            for number, point in enumerate(((-x, -z), (x, -z), (-x, z), (x, z)), start=1):
                found.append(tile.placed(f"Cone_{number}", ConeSpec(), point))
    return found
