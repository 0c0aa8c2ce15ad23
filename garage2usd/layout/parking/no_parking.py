"""No-parking signs on hatched squares, in front of cores, and beside vehicle doors."""

import math
from collections.abc import Collection, Iterable

import numpy as np

from garage2usd.common.randomness import Step, generator
from garage2usd.config import FittingsConfig
from garage2usd.layout.egress.cores import Core
from garage2usd.layout.placement import Placement, edge_yaw_rad, of_spec, placed, sum_of_yaws, to_world
from garage2usd.layout.shell.building import DOOR_FRAME_M
from garage2usd.layout.tiles import Tile, Tiles
from garage2usd.objects.no_parking_sign import SIGN_FOOT_M, NoParkingSignSpec
from garage2usd.objects.outline import Point
from garage2usd.objects.portal import PortalSpec
from garage2usd.structure.lane_graph import Square
from garage2usd.structure.stalls import Edge

__all__ = ["no_parking_signs"]

_QUARTER_TURN = np.pi / 2
_FROM_END_M = 0.35
_FROM_JAMB_M, _FROM_WALL_M = 0.3, 0.4
_FROM_CORE_M = SIGN_FOOT_M + 0.1
"""Least distance of a sign's middle from a core: its foot keeps clear of the door's handle."""


def no_parking_signs(
    grid: Tiles, walls: Iterable[Placement], cores: Collection[Core], fittings: FittingsConfig, *, seed: int
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
            yaw = sum_of_yaws(float(rng.integers(4)) * _QUARTER_TURN, tile.yaw_rad)
            signs.append(_sign(tile.middle_m, yaw, tile.square))
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


def _beside_doors(grid: Tiles, walls: Iterable[Placement]) -> list[Placement]:
    """Signs inside each vehicle door, on the side without a gate, unless cars turn to that side."""
    portals = [grid.tiles[square] for square in grid.doors]
    signs = []
    for wall, door in of_spec(walls, PortalSpec):
        side = -1 if door.is_entrance else 1
        place = wall.to_world((side * (door.door_width_m / 2 - DOOR_FRAME_M + _FROM_JAMB_M), _FROM_WALL_M))
        at = wall.position_m[0], wall.position_m[2]
        portal = min(portals, key=lambda tile: round(math.dist(tile.middle_m, at), 6))
        if not portal.drivable[_beside(portal, at, place)]:
            signs.append(_sign(place, wall.yaw_rad, portal.square))
    return signs


def _beside(portal: Tile, door: Point, place: Point) -> Edge:
    """Edge of a door's piece of floor on the side of a point, as seen from the door's centre."""
    (door_x, door_z), (x, z) = portal.local(door), portal.local(place)
    is_along_x = abs(door_z) / portal.half_z_m > abs(door_x) / portal.half_x_m
    low, high = (Edge.LEFT, Edge.RIGHT) if is_along_x else (Edge.UP, Edge.DOWN)
    return low if (x - door_x if is_along_x else z - door_z) < 0 else high


def _sign(place: Point, yaw_rad: float, square: Square) -> Placement:
    return placed("NoParkingSign", NoParkingSignSpec(), place, yaw_rad=yaw_rad, square=square)
