"""Outer walls along the contour, vehicle doors, wall posts, and columns with the boards that equipment hangs on."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import product

import numpy as np
import shapely
import shapely.affinity
from numpy.typing import NDArray

from garage2usd.config import BayConfig, FittingsConfig
from garage2usd.config.look import ColumnSection, ColumnsLook, WallsLook
from garage2usd.config.site import DOOR_FRAME_M, DOOR_JAMB_M
from garage2usd.layout.measures import check_clear_width
from garage2usd.layout.placement import Placement, edge_yaw_rad, placed
from garage2usd.layout.tiles import Tile, TileGrid, stall_outline
from garage2usd.objects import Spec
from garage2usd.objects.column import Board, ColumnSpec
from garage2usd.objects.portal import PortalSpec
from garage2usd.objects.wall import WallPostSpec, WallSpec
from garage2usd.structure.grid import NEIGHBOUR_STEPS, Cell, Structure, outside_squares
from garage2usd.structure.stalls import Edge, door_edges

_MAX_DOOR_WIDTH_M = 6.0
_DOOR_HEAD_M = 0.3
_TOUCH_M2 = 1e-4
"""Ground of a stall that rounding may have in common with the column beside it."""
_SIDES = (Edge.DOWN, Edge.RIGHT, Edge.UP, Edge.LEFT)
"""Edges that the sides of a column face, in the order of `Board.side`."""
_BACK_M = 0.02
"""Greatest distance of an equipment's back face from the wall plane."""
_MARGIN_M = 0.03
"""Margin of a board around the equipment, on each side."""
_TOUCH_M = 1e-4


def columns(
    grid: TileGrid, bay: BayConfig, fittings: FittingsConfig, look: ColumnsLook, beam_depth_m: float
) -> list[Placement]:
    """Place a column on every inner corner of the squares, except in the middle of lanes and in walls.

    A quarter of a column is on each of the squares around its corner; stalls and carriageways keep half a column width
    clear for any section. A rectangular column is long parallel to the adjacent stalls. Columns between two squares of
    stalls that open to the same side stand `bay.column_setback_m` behind the mouths, unless a stall is in the way.
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
            _column_position_m(grid, bay, row, col),
        )
        for row, col in np.argwhere(inner & off_lane).tolist()
    ]


def corner_columns(structure: Structure, pillars: Iterable[Placement]) -> tuple[str, ...]:
    """Return the names of the columns that stand on a corner of squares beside a lane."""
    cells = np.pad(structure.cells, 1, constant_values=Cell.OBSTACLE)
    rows = {float(z): row for row, z in enumerate(structure.row_edges_m)}
    cols = {float(x): col for col, x in enumerate(structure.column_edges_m)}
    names = []
    for place in pillars:
        row, col = rows.get(place.position_m[2]), cols.get(place.position_m[0])
        if row is not None and col is not None and (cells[row : row + 2, col : col + 2] != Cell.FREE).any():
            names.append(place.name)
    return tuple(names)


def _column_position_m(grid: TileGrid, bay: BayConfig, row: int, col: int) -> tuple[float, float, float]:
    """Return the position of the column at a corner: the corner, or set back from the mouths of adjacent stalls."""
    x, z = float(grid.structure.column_edges_m[col]), float(grid.structure.row_edges_m[row])
    back = _back_of_mouths(grid, row, col) if bay.column_setback_m else None
    if back is None:
        return x, 0.0, z
    step_row, step_col = NEIGHBOUR_STEPS[back]
    moved = x + step_col * bay.column_setback_m, z + step_row * bay.column_setback_m
    half = bay.column_size_m / 2
    foot = shapely.box(moved[0] - half, moved[1] - half, moved[0] + half, moved[1] + half)
    way = shapely.union(foot, shapely.box(x - half, z - half, x + half, z + half)).convex_hull
    for square in product((row - 1, row), (col - 1, col)):
        tile = grid.tiles[square]
        grounds = [
            shapely.Polygon(stall_outline(tile, place.row, place.slot)) for place in grid.stall_places.get(square, ())
        ]
        x_m, z_m = tile.middle_m
        if any(shapely.affinity.translate(ground, x_m, z_m).intersection(way).area > _TOUCH_M2 for ground in grounds):
            return x, 0.0, z
        is_behind = tile.cell is Cell.FREE
        if is_behind and bay.column_setback_m + half > (tile.depth_m if back.along_x else tile.width_m) - half:
            return x, 0.0, z
    return round(moved[0], 6), 0.0, round(moved[1], 6)


def _back_of_mouths(grid: TileGrid, row: int, col: int) -> Edge | None:
    """Return the direction away from the lane at a corner between two squares whose stalls open to the same side."""
    for mouth in Edge:
        step_row, step_col = NEIGHBOUR_STEPS[mouth]
        along = (0, 1) if step_row else (1, 0)
        # the two squares behind the corner as seen from the lane
        first = (row if step_row < 0 else row - 1, col - 1) if step_row else (row - 1, col if step_col < 0 else col - 1)
        bays = [first, (first[0] + along[0], first[1] + along[1])]
        opens = [
            grid.tiles[mouth.beyond(square)].cell is not Cell.FREE
            and any(place.row.edge is mouth for place in grid.stall_places.get(square, ()))
            for square in bays
        ]
        if all(opens):
            return mouth.opposite
    return None


def _stalls_along_x(grid: TileGrid, row: int, col: int) -> bool:
    """Return True if most stalls on the squares around a corner are long along X."""
    around = [(row + down, col + right) for down, right in product((-1, 0), (-1, 0))]
    edges = [place.row.edge for square in around for place in grid.stall_places.get(square, ())]
    return sum(1 if edge.along_x else -1 for edge in edges) < 0


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


def with_boards(pillars: Iterable[Placement], hung: Sequence[Placement]) -> list[Placement]:
    """Add a board to the columns behind each mounted object with a gap to the column.

    Parameters
    ----------
    pillars
        All columns.
    hung
        Equipment on columns and walls.
    """
    found: list[Placement] = []
    for pillar in pillars:
        spec = pillar.spec
        if isinstance(spec, ColumnSpec) and not spec.fills_square:
            boards = [board for each in hung if (board := _board(pillar, spec, each)) is not None]
            pillar = replace(pillar, spec=replace(spec, boards=tuple(sorted(boards))))  # noqa: PLW2901
        found.append(pillar)
    return found


def _board(pillar: Placement, column: ColumnSpec, hung: Placement) -> Board | None:
    """Return the board behind an object on the column; None for other objects and without a gap."""
    x, z = hung.position_m[0] - pillar.position_m[0], hung.position_m[2] - pillar.position_m[2]
    half = column.size_m / 2
    if max(abs(x), abs(z)) > half + _TOUCH_M:
        return None
    side = next(number for number, edge in enumerate(_SIDES) if edge_yaw_rad(edge) == hung.yaw_rad)
    if not column.is_round and half - column.side_m(side) < _TOUCH_M:
        return None
    across = (x, -z, -x, z)[side]
    left, right, low, high = _back_extent_m(hung.spec)
    left, right = max(across + left - _MARGIN_M, -half), min(across + right + _MARGIN_M, half)
    return Board(side, *(round(value, 4) for value in (left, right, low - _MARGIN_M, high + _MARGIN_M)))


@lru_cache(maxsize=16)
def _back_extent_m(spec: Spec) -> tuple[float, float, float, float]:
    """Return left, right, low and high of an object's back face."""
    points = np.concatenate([part.points for part in spec.asset().parts])
    x, y, _ = points[points[:, 2] < _BACK_M].T
    return float(x.min()), float(x.max()), float(y.min()), float(y.max())
