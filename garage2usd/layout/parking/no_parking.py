"""No-parking signs on hatched squares, in front of cores, and beside vehicle doors."""

from collections.abc import Collection, Iterable

import numpy as np

from garage2usd.common.randomness import Step, generator
from garage2usd.config import FittingsConfig
from garage2usd.layout.egress.cores import Core
from garage2usd.layout.placement import Placement, edge_yaw_rad, of_spec, placed, to_world
from garage2usd.layout.shell.building import DOOR_FRAME_M
from garage2usd.layout.tiles import TileGrid
from garage2usd.objects.no_parking_sign import SIGN_FOOT_M, NoParkingSignSpec
from garage2usd.objects.outline import Point
from garage2usd.objects.portal import PortalSpec
from garage2usd.structure.doors import door_edges
from garage2usd.structure.lane_graph import Square
from garage2usd.structure.stalls import Edge

__all__ = ["no_parking_signs"]

_QUARTER_TURN = np.pi / 2
_FROM_END_M = 0.35
_FROM_JAMB_M, _FROM_WALL_M = 0.3, 0.4
_FROM_CORE_M = SIGN_FOOT_M + 0.1
"""Least distance of a sign's middle from a core: its foot keeps clear of the door's handle."""


def no_parking_signs(
    grid: TileGrid, walls: Iterable[Placement], cores: Collection[Core], fittings: FittingsConfig, *, seed: int
) -> list[Placement]:
    """Place signs in the centre of some of the empty free squares, before each core, and beside each door.

    There are none if the share of such squares is 0.
    """
    rng = generator(seed, Step.SIGNS)
    built_on = {core.square for core in cores}
    signs = []
    for tile in grid:
        if tile.square in built_on or not grid.is_bare(tile):
            continue
        if rng.random() < fittings.no_parking_sign_rate:
            signs.append(_sign(tile.middle_m, float(rng.integers(4)) * _QUARTER_TURN, tile.square))
    if fittings.no_parking_sign_rate > 0:
        signs += [_before_core(core) for core in cores if core.recess_m]
        signs += _beside_doors(grid, walls)
    return signs


def _before_core(core: Core) -> Placement:
    """Sign at the end of the landing that is not beside a stall, facing the lane."""
    away = -1 if core.along_m <= 0 else 1
    # a core's local +X is opposite to its edge's direction if it faces up or right
    turned = -1 if core.edge.name in {"UP", "RIGHT"} else 1
    across = turned * away * (core.width_m / 2 - _FROM_END_M)
    yaw = edge_yaw_rad(core.edge)
    ahead = core.depth_m / 2 + max(core.recess_m / 2, _FROM_CORE_M)
    return _sign(to_world((across, ahead), core.centre_m, yaw), yaw, core.square)


def _beside_doors(grid: TileGrid, walls: Iterable[Placement]) -> list[Placement]:
    """Signs inside each vehicle door, on the side without a gate, unless cars turn to that side."""
    doors = {f"Portal_r{row:02d}_c{col:02d}_": (row, col) for row, col in door_edges(grid.structure.cells)}
    signs = []
    for wall, door in of_spec(walls, PortalSpec):
        side = -1 if door.is_entrance else 1
        place = wall.to_world((side * (door.door_width_m / 2 - DOOR_FRAME_M + _FROM_JAMB_M), _FROM_WALL_M))
        square = next(square for start, square in doors.items() if wall.name.startswith(start))
        if not grid.tiles[square].drivable[_beside(wall, place)]:
            signs.append(_sign(place, wall.yaw_rad, square))
    return signs


def _beside(wall: Placement, place: Point) -> Edge:
    """Edge of a door's square on the side of a point, as seen from the door's centre."""
    across_x, across_z = to_world((1.0, 0.0), (0.0, 0.0), wall.yaw_rad)
    off = (place[0] - wall.position_m[0]) * abs(across_x) + (place[1] - wall.position_m[2]) * abs(across_z)
    low, high = (Edge.LEFT, Edge.RIGHT) if abs(across_x) > abs(across_z) else (Edge.UP, Edge.DOWN)
    return low if off < 0 else high


def _sign(place: Point, yaw_rad: float, square: Square) -> Placement:
    return placed("NoParkingSign", NoParkingSignSpec(), place, yaw_rad=yaw_rad, square=square)
