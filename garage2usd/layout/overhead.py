"""Sprinkler pipes along the aisles, exit signs over them, and mirrors at junctions."""

import math
from collections.abc import Iterable

import networkx as nx

from garage2usd.config import FittingsConfig
from garage2usd.grid import NEIGHBOUR_STEPS, Cell, Structure
from garage2usd.lanes import LaneGraph, LaneKind, Square
from garage2usd.layout.placement import ObjectKind, Placement, edge_yaw_rad
from garage2usd.layout.specs import ExitSignSpec, MirrorSpec, Point, SprinklerSpec, Turn
from garage2usd.layout.tiles import Tile, TileGrid, lane_edges
from garage2usd.stalls import Edge

__all__ = ["exit_signs", "mirrors", "sprinklers"]

_QUARTER_TURN = math.pi / 2
_PIPE_DROP_M = 0.075
_PIPE_RADIUS_M = 0.03
_PIPE_WALL_GAP_M = 0.5
_HEAD_PITCH_M = 3.3
_SIGN_TOP_BELOW_CEILING_M = 0.58
_SIGN_HEIGHT_M = 0.2
_SIGN_FROM_EDGE_M = 0.45
_MIRROR_RADIUS_M = 0.25
_MIRROR_FROM_COLUMN_M = 0.12
_JUNCTIONS = {LaneKind.CROSSROADS, LaneKind.T_JUNCTION}


def sprinklers(structure: Structure, grid: TileGrid, fittings: FittingsConfig) -> list[Placement]:
    """Sprinkler pipes under the ceiling, on the side of each aisle where no duct hangs, over ducts where they cross.

    A pipe along a column of squares leads on to the pipes along rows above and below it.
    """
    if not fittings.sprinklers:
        return []
    pipes: list[Placement] = []
    for tile in grid:
        if tile.cell is not Cell.LANE:
            continue
        if _in_row(structure, tile.square):
            z = tile.z_m + _offset_m(tile.half_z_m, grid)
            pipes.append(_pipe("Sprinkler", tile, (tile.x_m, z), tile.width_m, fittings, along_x=True))
            continue
        x = tile.x_m - _offset_m(tile.half_x_m, grid)
        pipes.append(_pipe("Sprinkler", tile, (x, tile.z_m), tile.depth_m, fittings, along_x=False))
        for name, edge, step in (("SprinklerUp", Edge.UP, -1), ("SprinklerDown", Edge.DOWN, 1)):
            other = grid.neighbour(tile, edge)
            if other is None or other.cell is not Cell.LANE or not _in_row(structure, other.square):
                continue
            start = tile.z_m + step * tile.half_z_m
            end = other.z_m + _offset_m(other.half_z_m, grid) - step * _PIPE_RADIUS_M
            length = abs(end - start)
            pipes.append(_pipe(name, tile, (x, (start + end) / 2), length, fittings, along_x=False, has_heads=False))
    return pipes


def _pipe(
    name: str,
    tile: Tile,
    middle: Point,
    length_m: float,
    fittings: FittingsConfig,
    *,
    along_x: bool,
    has_heads: bool = True,
) -> Placement:
    heads = max(1, round(length_m / _HEAD_PITCH_M)) if has_heads else 0
    spec = SprinklerSpec(round(length_m, 6), _PIPE_RADIUS_M, _PIPE_DROP_M, heads)
    position = (round(middle[0], 6), fittings.ceiling_height_m, round(middle[1], 6))
    return Placement(name, ObjectKind.SPRINKLER, spec, position, _QUARTER_TURN if along_x else 0.0, tile.square)


def _in_row(structure: Structure, square: Square) -> bool:
    """Whether a lane square has a lane beside it in its own row."""
    row, col = square
    cells = structure.cells[row]
    return any(0 <= c < len(cells) and cells[c] == Cell.LANE for c in (col - 1, col + 1))


def _offset_m(half_width_m: float, grid: TileGrid) -> float:
    return max(half_width_m - grid.setback_m - _PIPE_WALL_GAP_M, 0.0)


def exit_signs(grid: TileGrid, graph: LaneGraph, fittings: FittingsConfig) -> list[Placement]:
    """A lit sign over each way into a junction, that points along the shortest way to an exit.

    There are none where the ceiling leaves no room over the clear height.
    """
    height = fittings.ceiling_height_m - _SIGN_TOP_BELOW_CEILING_M
    if not fittings.exit_signs or height - _SIGN_HEIGHT_M < fittings.clear_height_m:
        return []
    exits = {square for square, kind in graph.graph.nodes(data="kind") if kind is LaneKind.EXIT}
    distance = nx.multi_source_dijkstra_path_length(graph.graph, exits, weight="length_m")
    signs: list[Placement] = []
    for tile in grid:
        if tile.cell is not Cell.LANE or graph.kind(tile.square) not in _JUNCTIONS or tile.square not in distance:
            continue
        ways = {edge: distance.get(_beyond(tile.square, edge), math.inf) for edge in lane_edges(tile)}
        out = min(ways, key=lambda edge: (round(ways[edge], 6), edge))
        signs += [
            _exit_sign(tile, edge, out, fittings)
            for edge in ways
            if edge is not out and graph.kind(_beyond(tile.square, edge)) is not LaneKind.EXIT
        ]
    return signs


def _exit_sign(tile: Tile, edge: Edge, out: Edge, fittings: FittingsConfig) -> Placement:
    """The sign over one edge of a junction, looking out over it at who comes in."""
    (dr, dc), (out_r, out_c) = NEIGHBOUR_STEPS[edge], NEIGHBOUR_STEPS[out]
    # the driver comes along (-dr, -dc); a right turn leads to (-dc, dr) in rows and columns
    turn = Turn.AHEAD if (out_r, out_c) == (-dr, -dc) else Turn.RIGHT if (out_r, out_c) == (-dc, dr) else Turn.LEFT
    x = tile.x_m + dc * (tile.half_x_m - _SIGN_FROM_EDGE_M)
    z = tile.z_m + dr * (tile.half_z_m - _SIGN_FROM_EDGE_M)
    position = (round(x, 6), fittings.ceiling_height_m, round(z, 6))
    spec = ExitSignSpec(turn, _SIGN_TOP_BELOW_CEILING_M, _SIGN_HEIGHT_M)
    name = f"ExitSign_{edge.name.capitalize()}"
    return Placement(name, ObjectKind.EXIT_SIGN, spec, position, edge_yaw_rad(edge), tile.square)


def mirrors(
    grid: TileGrid, graph: LaneGraph, columns: Iterable[Placement], column_size_m: float, fittings: FittingsConfig
) -> list[Placement]:
    """A convex mirror on a column at the lower side of each junction, looking up the plan along it."""
    if not fittings.mirrors:
        return []
    feet = {(round(place.position_m[0], 4), round(place.position_m[2], 4)) for place in columns}
    inset = column_size_m / 2 + _MIRROR_FROM_COLUMN_M
    centre = min(fittings.clear_height_m + _MIRROR_RADIUS_M + 0.05, fittings.ceiling_height_m - _MIRROR_RADIUS_M - 0.1)
    placed: list[Placement] = []
    for tile in grid:
        if tile.cell is not Cell.LANE or graph.kind(tile.square) not in _JUNCTIONS:
            continue
        for side in (-1, 1):
            x, z = tile.x_m + side * tile.half_x_m, tile.z_m + tile.half_z_m
            if (round(x, 4), round(z, 4)) in feet:
                position = (round(x, 6), round(centre, 6), round(z - inset, 6))
                spec, yaw = MirrorSpec(_MIRROR_RADIUS_M), edge_yaw_rad(Edge.UP)
                placed.append(Placement("Mirror", ObjectKind.MIRROR, spec, position, yaw, tile.square))
                break
    return placed


def _beyond(square: Square, edge: Edge) -> Square:
    dr, dc = NEIGHBOUR_STEPS[edge]
    return square[0] + dr, square[1] + dc
