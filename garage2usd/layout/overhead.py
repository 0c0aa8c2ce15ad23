"""Exit signs over the aisles, and mirrors at junctions."""

import math
from collections.abc import Iterable

import networkx as nx

from garage2usd.config import FittingsConfig
from garage2usd.grid import NEIGHBOUR_STEPS, Cell
from garage2usd.lanes import LaneGraph, LaneKind, Square
from garage2usd.layout.ceiling import CeilingLevels
from garage2usd.layout.placement import ObjectKind, Placement, edge_yaw_rad
from garage2usd.layout.specs import ExitSignSpec, MirrorSpec, Turn
from garage2usd.layout.tiles import Tile, TileGrid, lane_edges
from garage2usd.stalls import Edge

__all__ = ["exit_signs", "mirrors"]

_SIGN_HEIGHT_M = 0.2
_SIGN_FROM_EDGE_M = 0.45
_MIRROR_RADIUS_M = 0.25
_MIRROR_FROM_COLUMN_M = 0.12
_JUNCTIONS = {LaneKind.CROSSROADS, LaneKind.T_JUNCTION}


def exit_signs(grid: TileGrid, graph: LaneGraph, fittings: FittingsConfig, levels: CeilingLevels) -> list[Placement]:
    """A lit sign over each way into a junction, that points along the shortest way to an exit.

    There are none where the ceiling leaves no room over the clear height.
    """
    foot = fittings.ceiling_height_m - levels.sign_top_m - _SIGN_HEIGHT_M
    if not fittings.exit_signs or foot < fittings.clear_height_m:
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
            _exit_sign(tile, edge, out, fittings.ceiling_height_m, levels.sign_top_m)
            for edge in ways
            if edge is not out and graph.kind(_beyond(tile.square, edge)) is not LaneKind.EXIT
        ]
    return signs


def _exit_sign(tile: Tile, edge: Edge, out: Edge, ceiling_m: float, top_m: float) -> Placement:
    """The sign over one edge of a junction, looking out over it at who comes in."""
    (dr, dc), (out_r, out_c) = NEIGHBOUR_STEPS[edge], NEIGHBOUR_STEPS[out]
    # the driver comes along (-dr, -dc); a right turn leads to (-dc, dr) in rows and columns
    turn = Turn.AHEAD if (out_r, out_c) == (-dr, -dc) else Turn.RIGHT if (out_r, out_c) == (-dc, dr) else Turn.LEFT
    x = tile.x_m + dc * (tile.half_x_m - _SIGN_FROM_EDGE_M)
    z = tile.z_m + dr * (tile.half_z_m - _SIGN_FROM_EDGE_M)
    position = (round(x, 6), ceiling_m, round(z, 6))
    spec = ExitSignSpec(turn, top_m, _SIGN_HEIGHT_M)
    name = f"ExitSign_{edge.name.capitalize()}"
    return Placement(name, ObjectKind.EXIT_SIGN, spec, position, edge_yaw_rad(edge), tile.square)


def mirrors(
    grid: TileGrid,
    graph: LaneGraph,
    columns: Iterable[Placement],
    column_size_m: float,
    fittings: FittingsConfig,
    levels: CeilingLevels,
) -> list[Placement]:
    """A convex mirror on a column at the lower side of each junction, looking up the plan along it."""
    if not fittings.mirrors:
        return []
    feet = {(round(place.position_m[0], 4), round(place.position_m[2], 4)) for place in columns}
    inset = column_size_m / 2 + _MIRROR_FROM_COLUMN_M
    highest = fittings.ceiling_height_m - max(levels.beam_depth_m, 0.08) - 0.02 - _MIRROR_RADIUS_M
    centre = min(fittings.clear_height_m + _MIRROR_RADIUS_M + 0.05, highest)
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
