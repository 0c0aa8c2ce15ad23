"""What hangs from the ceiling or lies on the lanes: tube lights, ducts, speed bumps, signs."""

import numpy as np
from numpy.typing import NDArray

from garage2usd.config import FittingsConfig
from garage2usd.grid import NEIGHBOUR_STEPS, Cell, Structure
from garage2usd.lanes import LaneGraph, LaneKind, Square
from garage2usd.layout.placement import ObjectKind, Placement
from garage2usd.layout.specs import DuctSpec, NoParkingSignSpec, SpeedBumpSpec, TubeLightSpec
from garage2usd.layout.tiles import Tile, TileGrid
from garage2usd.randomness import Step, generator

__all__ = ["ducts", "no_parking_signs", "speed_bumps", "tube_lights"]

_QUARTER_TURN = np.pi / 2
_TUBE = TubeLightSpec(length_m=1.5, width_m=0.12)
_JUNCTION_TUBE_OFFSET_M = 1.2
_DUCT_WIDTH_M = 0.8
_DUCT_HEIGHT_M = 0.35
_HANGER_M = 0.15
_DUCT_WALL_GAP_M = 0.3


def tube_lights(grid: TileGrid, fittings: FittingsConfig) -> list[Placement]:
    """Tube lights under the ceiling: in line along lanes, one over each square with stalls or a portal."""
    lights: list[Placement] = []
    for tile in grid:
        count = fittings.tubes_per_cell if tile.cell is Cell.LANE else min(1, fittings.tubes_per_cell)
        along_x = _tube_along_x(tile, grid)
        length = tile.width_m if along_x else tile.depth_m
        pitch = length / max(count, 1)
        if tile.axis_is_x is None:
            pitch = min(pitch, 2 * _JUNCTION_TUBE_OFFSET_M)
        for index in range(count):
            offset = (index - (count - 1) / 2) * max(pitch, _TUBE.length_m + 0.1)
            x = tile.x_m + (offset if along_x else 0.0)
            z = tile.z_m + (0.0 if along_x else offset)
            position = (round(x, 6), fittings.ceiling_height_m, round(z, 6))
            yaw = 0.0 if along_x else _QUARTER_TURN
            lights.append(Placement(f"Tube_{index + 1}", ObjectKind.LIGHT, _TUBE, position, yaw, tile.square))
    return lights


def _tube_along_x(tile: Tile, grid: TileGrid) -> bool:
    if tile.cell is Cell.FREE:
        rows = grid.rows_by_square.get(tile.square)
        return not rows or NEIGHBOUR_STEPS[rows[0].edge][0] != 0
    return tile.axis_is_x is not False


def ducts(structure: Structure, grid: TileGrid, fittings: FittingsConfig) -> list[Placement]:
    """Ventilation ducts along the aisles: trunks along rows of lanes, and along columns between them.

    A trunk hangs over the side of its aisle, so that lights hang free. Where a duct along a column meets a trunk along
    a row, a branch leads on to the trunk's side.
    """
    if not fittings.ducts:
        return []
    lane = structure.cells == Cell.LANE
    trunk = _in_runs(lane)
    riser = _in_runs((lane & ~trunk).T).T
    top_m = fittings.ceiling_height_m - _HANGER_M
    placements: list[Placement] = []
    for tile in grid:
        if trunk[tile.square]:
            spec = _duct(tile.width_m)
            position = (tile.x_m, top_m, round(tile.z_m - _side_offset_m(tile.half_z_m, grid), 6))
            placements.append(Placement("Duct", ObjectKind.DUCT, spec, position, _QUARTER_TURN, tile.square))
        elif riser[tile.square]:
            x = round(tile.x_m + _side_offset_m(tile.half_x_m, grid), 6)
            placements.append(
                Placement("Duct", ObjectKind.DUCT, _duct(tile.depth_m), (x, top_m, tile.z_m), 0.0, tile.square)
            )
            placements += _branches(tile, x, top_m, trunk, grid)
    return placements


def _branches(riser: Tile, x: float, top_m: float, trunk: NDArray[np.bool_], grid: TileGrid) -> list[Placement]:
    """The pieces that join the end of a duct along a column to the sides of the trunks above and below it."""
    branches = []
    for name, step in (("BranchDown", 1), ("BranchUp", -1)):
        tile = grid.tiles.get((riser.square[0] + step, riser.square[1]))
        if tile is None or not trunk[tile.square]:
            continue
        trunk_z = tile.z_m - _side_offset_m(tile.half_z_m, grid)
        start = tile.z_m - step * tile.half_z_m
        end = trunk_z - step * _DUCT_WIDTH_M / 2
        spec = _duct(abs(end - start))
        position = (x, top_m, round((start + end) / 2, 6))
        branches.append(Placement(f"Duct{name}", ObjectKind.DUCT, spec, position, 0.0, riser.square))
    return branches


def _duct(length_m: float) -> DuctSpec:
    return DuctSpec(round(length_m, 6), _DUCT_WIDTH_M, _DUCT_HEIGHT_M, _HANGER_M)


def _side_offset_m(half_width_m: float, grid: TileGrid) -> float:
    """Distance of a duct's middle from the aisle's middle."""
    return max(half_width_m - grid.setback_m - _DUCT_WALL_GAP_M - _DUCT_WIDTH_M / 2, 0.0)


def _in_runs(lane: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Lane squares with a lane beside them in their own row."""
    padded = np.pad(lane, ((0, 0), (1, 1)))
    run: NDArray[np.bool_] = lane & (padded[:, :-2] | padded[:, 2:])
    return run


def speed_bumps(grid: TileGrid, graph: LaneGraph, fittings: FittingsConfig, *, seed: int) -> list[Placement]:
    """Speed bumps across straight lanes, never on two squares in a row."""
    rng = generator(seed, Step.SPEED_BUMPS)
    bumps: dict[Square, Placement] = {}
    for tile in grid:
        straight = tile.cell is Cell.LANE and graph.kind(tile.square) is LaneKind.STRAIGHT
        if not straight or tile.axis_is_x is None or sum(tile.drivable) != 2:  # noqa: PLR2004
            continue
        row, col = tile.square
        wanted = rng.random() < fittings.speed_bump_rate
        if not wanted or (row - 1, col) in bumps or (row, col - 1) in bumps:
            continue
        spec = SpeedBumpSpec(round(grid.clear_width_m(tile) - 0.2, 3))
        yaw = _QUARTER_TURN if tile.axis_is_x else 0.0
        bumps[tile.square] = Placement(
            "SpeedBump", ObjectKind.SPEED_BUMP, spec, (tile.x_m, 0.0, tile.z_m), yaw, tile.square
        )
    return list(bumps.values())


def no_parking_signs(grid: TileGrid, fittings: FittingsConfig, *, seed: int) -> list[Placement]:
    """A no-parking sign in the middle of some of the free squares that hold no stall."""
    rng = generator(seed, Step.SIGNS)
    signs = []
    for tile in grid:
        if tile.cell is not Cell.FREE or tile.square in grid.rows_by_square:
            continue
        if rng.random() < fittings.no_parking_sign_rate:
            yaw = float(rng.integers(4)) * _QUARTER_TURN
            position = (tile.x_m, 0.0, tile.z_m)
            signs.append(
                Placement("NoParkingSign", ObjectKind.NO_PARKING_SIGN, NoParkingSignSpec(), position, yaw, tile.square)
            )
    return signs
