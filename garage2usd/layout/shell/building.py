"""Outer walls along the contour, vehicle doors, wall posts and columns."""

from dataclasses import replace
from itertools import product

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.config import BayConfig, FittingsConfig
from garage2usd.config.look import ColumnSection, ColumnsLook, WallsLook
from garage2usd.config.site import DOOR_FRAME_M, DOOR_JAMB_M
from garage2usd.layout.clearance import check_clear_width
from garage2usd.layout.placement import Placement, edge_yaw_rad, placed
from garage2usd.layout.tiles import Tile, TileGrid
from garage2usd.objects.column import ColumnSpec
from garage2usd.objects.portal import PortalSpec
from garage2usd.objects.wall import WallPostSpec, WallSpec
from garage2usd.structure.doors import door_edges
from garage2usd.structure.grid import NEIGHBOUR_STEPS, Cell, Structure, outside_squares
from garage2usd.structure.stalls import Edge

__all__ = ["DOOR_FRAME_M", "columns", "ground_inside", "outer_walls"]

_MAX_DOOR_WIDTH_M = 6.0
_DOOR_HEAD_M = 0.3


def columns(
    grid: TileGrid, bay: BayConfig, fittings: FittingsConfig, look: ColumnsLook, beam_depth_m: float
) -> list[Placement]:
    """Place a column on every inner corner of the squares, except in the middle of lanes and in walls.

    A quarter of a column is on each of the squares around its corner; stalls and carriageways keep half a column width
    clear for any section. A rectangular column is long parallel to the adjacent stalls.
    """
    structure = grid.structure
    cells = np.pad(structure.cells, 1, constant_values=Cell.OBSTACLE)
    around = np.stack([cells[:-1, :-1], cells[:-1, 1:], cells[1:, :-1], cells[1:, 1:]])
    inner = (around != Cell.OBSTACLE).all(axis=0)
    off_lane = (around == Cell.FREE).any(axis=0)
    spec = ColumnSpec(
        bay.column_size_m,
        fittings.ceiling_height_m,
        section=look.section,
        guard=look.guard,
        guard_height_m=look.guard_height_m,
    )
    if not spec.fills_square:
        spec = replace(spec, head_m=beam_depth_m)
    is_turned = look.section is ColumnSection.RECTANGULAR
    return [
        Placement(
            f"Column_r{row:02d}_c{col:02d}",
            replace(spec, is_long_along_x=True) if is_turned and _stalls_along_x(grid, row, col) else spec,
            (float(structure.column_edges_m[col]), 0.0, float(structure.row_edges_m[row])),
        )
        for row, col in np.argwhere(inner & off_lane).tolist()
    ]


def _stalls_along_x(grid: TileGrid, row: int, col: int) -> bool:
    """Return True if most stalls on the squares around a corner are long along X."""
    around = [(row + down, col + right) for down, right in product((-1, 0), (-1, 0))]
    edges = [place.row.edge for square in around for place in grid.stall_places.get(square, ())]
    return sum(1 if edge.along_x else -1 for edge in edges) < 0


def ground_inside(structure: Structure) -> shapely.Geometry:
    """Return the ground (x, z) inside the contour, including obstacles."""
    x, z = structure.column_edges_m, structure.row_edges_m
    squares = np.argwhere(~outside_squares(structure.cells)).tolist()
    return shapely.union_all([shapely.box(x[col], z[row], x[col + 1], z[row + 1]) for row, col in squares])


def outer_walls(grid: TileGrid, fittings: FittingsConfig, look: WallsLook) -> list[Placement]:
    """Place a wall outside every edge of the contour, a vehicle door at each portal, and posts in convex corners.

    In a reflex corner, the wall along X is shortened by the thickness of the wall along Z.

    Raises
    ------
    ConfigError
        If a portal's square is too narrow for a vehicle door.
    """
    thickness, height, structure = fittings.wall_thickness_m, fittings.ceiling_height_m, grid.structure
    outside = np.pad(outside_squares(structure.cells), 1, constant_values=True)
    doors = door_edges(structure.cells)
    walls: list[Placement] = []
    for tile in grid:
        walls += [
            _wall(tile, edge, outside, fittings, look, has_door=doors.get(tile.square) is edge)
            for edge in Edge
            if outside[edge.beyond((tile.square[0] + 1, tile.square[1] + 1))]
        ]
    post = WallPostSpec(thickness, height)
    rows, cols = structure.shape
    for row, col in product(range(rows + 1), range(cols + 1)):
        around = ~outside[row : row + 2, col : col + 2]
        if around.sum() == 1:
            (down, right), *_ = np.argwhere(around).tolist()
            x = float(structure.column_edges_m[col]) + (0.5 - right) * thickness
            z = float(structure.row_edges_m[row]) + (0.5 - down) * thickness
            walls.append(placed(f"Post_r{row:02d}_c{col:02d}", post, (x, z)))
    return walls


def _wall(
    tile: Tile,
    edge: Edge,
    outside: NDArray[np.bool_],
    fittings: FittingsConfig,
    look: WallsLook,
    *,
    has_door: bool,
) -> Placement:
    """Return the wall outside one edge of a tile, with or without a vehicle door."""
    row, col = tile.square
    dr, dc = NEIGHBOUR_STEPS[edge]
    x, z = tile.x_m + dc * tile.half_x_m, tile.z_m + dr * tile.half_z_m
    length = tile.width_m if dr else tile.depth_m
    if dr:
        reflex = [not outside[row + 1 + dr, col + 1 + side] for side in (-1, 1)]
        length -= fittings.wall_thickness_m * sum(reflex)
        x += fittings.wall_thickness_m / 2 * (reflex[0] - reflex[1])
    spec: WallSpec | PortalSpec = WallSpec(
        round(length, 6), fittings.ceiling_height_m, fittings.wall_thickness_m, look.dado_m, look.has_stripe
    )
    if has_door:
        door_width_m = min(_MAX_DOOR_WIDTH_M, spec.length_m - 2 * DOOR_JAMB_M)
        check_clear_width(tile, door_width_m - 2 * DOOR_FRAME_M, along_x=dr != 0)
        spec = PortalSpec(
            spec.length_m,
            spec.height_m,
            spec.thickness_m,
            door_width_m=round(door_width_m, 6),
            door_height_m=round(max(fittings.clear_height_m + DOOR_FRAME_M, spec.height_m - 2 * _DOOR_HEAD_M), 6),
            is_entrance=tile.cell is Cell.ENTRANCE,
        )
    # the inner face looks into the square
    name = f"{'Portal' if has_door else 'Wall'}_r{row:02d}_c{col:02d}_{edge.name.capitalize()}"
    return placed(name, spec, (x, z), yaw_rad=edge_yaw_rad(edge.opposite))
