"""Exit signs and one-way signs over the aisles, and mirrors at junctions."""

import math
from collections.abc import Iterable, Sequence

import networkx as nx
import numpy as np

from garage2usd.assets.mesh import pascal_case
from garage2usd.config import FittingsConfig
from garage2usd.garage import LaneKind
from garage2usd.layout.ceiling.beams import CeilingLevels
from garage2usd.layout.fittings import TUBE_DEPTH_M
from garage2usd.layout.nearness import Points
from garage2usd.layout.placement import Placement, box_inside, edge_yaw_rad, of_spec, rounded
from garage2usd.layout.shell.well import Well
from garage2usd.layout.tiles import Tile, Tiles, lane_edges
from garage2usd.objects.column import ColumnSpec
from garage2usd.objects.exit_sign import ExitSignSpec, Turn
from garage2usd.objects.lane_sign import LaneSignSpec, LaneSignText
from garage2usd.objects.mirror import MirrorSpec
from garage2usd.objects.outline import Point
from garage2usd.structure.grid import NEIGHBOUR_STEPS, Cell
from garage2usd.structure.lane_graph import Square
from garage2usd.structure.stalls import Edge

__all__ = ["JUNCTIONS", "SIGN_FROM_EDGE_M", "edges_in", "exit_signs", "lane_signs", "mirrors", "turn_at"]

_SIGN_HEIGHT_M = 0.2
SIGN_FROM_EDGE_M = 0.45
_LANE_SIGN_M, _LEAST_LANE_SIGN_M = 0.4, 0.2
_LANE_SIGN_ASIDE_M = 1.0
"""Distance of signs from the centre of a lane, between the tubes and the ducts and trays."""
_MIRROR_RADIUS_M = 0.25
_MIRROR_GAP_M = 0.05
_MIRROR_FROM_COLUMN_M, _MIRROR_FROM_WALL_M = 0.07, 0.22
_ARM_TO_COLUMN_M, _ARM_TO_EDGE_M, _ARM_TO_WALL_M = 0.12, 0.099, 0.29
"""Lengths along the diagonal: to a column's bevelled edge, to the sharp edge of a core, to the meeting of two walls."""
_COLUMN_FROM_CORNER_M = 0.3
"""Greatest distance of a column from the corner that it stands in."""
_INTO_COLUMN_M = 0.025
"""Depth to which an arm enters a column that it meets at an angle."""
_CORNERS = tuple((vertical, side) for vertical in (Edge.DOWN, Edge.UP) for side in (Edge.LEFT, Edge.RIGHT))
JUNCTIONS = {LaneKind.CROSSROADS, LaneKind.T_JUNCTION}


def exit_signs(
    grid: Tiles,
    fittings: FittingsConfig,
    levels: CeilingLevels,
    well: Well | None = None,
) -> list[Placement]:
    """Place lit exit signs over the lanes into each junction, pointing along the shortest route to an exit.

    There are none without space above the clear height, and at junctions without a route.

    Parameters
    ----------
    grid, fittings, levels
        The pieces of the floor, the heights and what hangs at them.
    well
        The ramps to other levels. Only the one up leads out; where cars arrive over a ramp and have several ways, a
        sign hangs over the landing too.
    """
    foot = fittings.ceiling_height_m - levels.sign_top_m - _SIGN_HEIGHT_M
    if not fittings.exit_signs or foot < fittings.clear_height_m:
        return []
    exits = {tile.square for tile in grid if tile.kind is LaneKind.EXIT}
    ways_back = grid.ways.reverse()
    if well:
        entrances = [tile.square for tile in grid if tile.kind is LaneKind.ENTRANCE]
        ways_back.remove_nodes_from({*well.no_ways_out, *entrances})
        exits -= well.no_ways_out
    if not exits:
        return []
    distance = nx.multi_source_dijkstra_path_length(ways_back, exits, weight="length_m")
    arrivals = well.arrivals if well else {}
    signs: list[Placement] = []
    for tile in grid:
        is_junction = tile.cell is Cell.LANE and tile.kind in JUNCTIONS and tile.square in distance
        if not is_junction and tile.square not in arrivals:
            continue
        beyond = {edge: other.square for edge in lane_edges(tile) if (other := grid.neighbour(tile, edge))}
        ways = {
            edge: distance.get(square, math.inf) if grid.ways.has_edge(tile.square, square) else math.inf
            for edge, square in beyond.items()
        }
        out = min(ways, key=lambda edge: (round(ways[edge], 6), edge))
        if tile.square in arrivals:
            if len(ways) > 1 and math.isfinite(ways[out]):
                signs.append(_exit_sign(tile, arrivals[tile.square], out, fittings.ceiling_height_m, levels.sign_top_m))
            continue
        signs += [
            _exit_sign(tile, edge, out, fittings.ceiling_height_m, levels.sign_top_m)
            for edge in edges_in(tile, grid, out)
        ]
    return signs


def edges_in(tile: Tile, grid: Tiles, out: Edge) -> list[Edge]:
    """Return the edges over which drivers enter a junction that they leave over another one."""
    beyond = [(edge, grid.neighbour(tile, edge)) for edge in lane_edges(tile) if edge is not out]
    return [
        edge
        for edge, other in beyond
        if other is not None and other.kind is not LaneKind.EXIT and grid.ways.has_edge(other.square, tile.square)
    ]


def turn_at(edge: Edge, out: Edge) -> Turn:
    """Return the turn of a driver who enters a square over an edge and leaves it over another one."""
    (dr, dc), away = NEIGHBOUR_STEPS[edge], NEIGHBOUR_STEPS[out]
    # the driver moves along (-dr, -dc); a right turn leads to (-dc, dr) in rows and columns
    return {(-dr, -dc): Turn.AHEAD, (-dc, dr): Turn.RIGHT}.get(away, Turn.LEFT)


def _exit_sign(tile: Tile, edge: Edge, out: Edge, ceiling_m: float, top_m: float) -> Placement:
    """Sign over one edge of a junction, facing the drivers who enter there."""
    dr, dc = NEIGHBOUR_STEPS[edge]
    point = dc * (tile.half_x_m - SIGN_FROM_EDGE_M), dr * (tile.half_z_m - SIGN_FROM_EDGE_M)
    spec = ExitSignSpec(turn_at(edge, out), top_m, _SIGN_HEIGHT_M)
    name = f"ExitSign_{edge.name.capitalize()}"
    return tile.placed(name, spec, point, height_m=ceiling_m, yaw_rad=edge_yaw_rad(edge))


def lane_signs(grid: Tiles, fittings: FittingsConfig, levels: CeilingLevels) -> list[Placement]:
    """Place signs over both ends of one-way lanes: one-way signs at the start, no-entry signs at the end.

    Each hangs over the right half of the lane's first square, as seen by its reader. There are none without space above
    the clear height.
    """
    room = fittings.ceiling_height_m - levels.sign_top_m - fittings.clear_height_m
    height_m = round(min(_LANE_SIGN_M, room), 3)
    if not fittings.exit_signs or height_m < _LEAST_LANE_SIGN_M:
        return []
    signs: list[Placement] = []
    for stretch in grid.one_way_stretches:
        for (junction, first), says in (
            ((stretch[0], stretch[1]), LaneSignText.ONE_WAY),
            ((stretch[-1], stretch[-2]), LaneSignText.NO_ENTRY),
        ):
            if len(stretch) > 2:  # noqa: PLR2004 - not a step between two junctions
                spec = LaneSignSpec(says, levels.sign_top_m, height_m)
                signs.append(_lane_sign(grid.tiles[first], _edge_towards(first, junction, grid), spec, fittings))
    return signs


def _lane_sign(tile: Tile, edge: Edge, spec: LaneSignSpec, fittings: FittingsConfig) -> Placement:
    """Sign over one edge of a lane square, facing the drivers who cross that edge."""
    half = (tile.half_x_m, tile.half_z_m)
    # on the reader's right, which is the sign's local +X
    to_right = _LANE_SIGN_ASIDE_M if edge in {Edge.DOWN, Edge.LEFT} else -_LANE_SIGN_ASIDE_M
    x, z, *_ = box_inside(edge, half, (to_right, to_right), (SIGN_FROM_EDGE_M, SIGN_FROM_EDGE_M))
    name = f"{pascal_case(spec.says)}Sign_{edge.name.capitalize()}"
    return tile.placed(name, spec, (x, z), height_m=fittings.ceiling_height_m, yaw_rad=edge_yaw_rad(edge))


def _edge_towards(square: Square, other: Square, grid: Tiles) -> Edge:
    tile, beyond = grid.tiles[square], grid.tiles[other]
    return next(edge for edge in Edge if grid.neighbour(tile, edge) == beyond)


def mirrors(
    grid: Tiles,
    columns: Iterable[Placement],
    fittings: FittingsConfig,
    levels: CeilingLevels,
) -> list[Placement]:
    """Place convex mirrors on columns and walls at the blind corners of junctions and bends.

    Notes
    -----
    A driver who enters over an edge cannot see into a side lane if no lane square lies in the corner between the two. A
    mirror in a corner faces across the square and shows the side lane to drivers from the two opposite edges. Corners
    are chosen greedily, so that few mirrors serve all edges. There are none without space above the clear height.
    """
    highest = fittings.ceiling_height_m - max(levels.beam_depth_m, TUBE_DEPTH_M) - _MIRROR_GAP_M - _MIRROR_RADIUS_M
    if not fittings.mirrors or highest - _MIRROR_RADIUS_M < fittings.clear_height_m:
        return []
    feet = [((place.position_m[0], place.position_m[2]), spec) for place, spec in of_spec(columns, ColumnSpec)]
    nearest = Points([foot for foot, _ in feet])
    height = round(min(fittings.clear_height_m + _MIRROR_RADIUS_M + _MIRROR_GAP_M, highest), 6)
    found: list[Placement] = []
    for tile in grid:
        if tile.cell is not Cell.LANE or tile.axis_is_x is not None:
            continue
        unserved = {edge for edge in lane_edges(tile) if _is_blind(edge, tile, grid)}
        mounts = {corner: mount for corner in _CORNERS if (mount := _mount_m(corner, tile, grid, feet, nearest))}
        while mounts:
            corner = max(mounts, key=lambda corner: len(unserved.intersection(_served(corner))))
            (inset_x, inset_z), arm = mounts.pop(corner)
            if not unserved.intersection(_served(corner)):
                break
            unserved.difference_update(_served(corner))
            side_z, side_x = (sum(NEIGHBOUR_STEPS[edge]) for edge in corner)
            point = side_x * (tile.half_x_m - inset_x), side_z * (tile.half_z_m - inset_z)
            name = "Mirror_" + "".join(edge.name.capitalize() for edge in corner)
            yaw = round(math.atan2(-side_x, -side_z), 6)
            spec = MirrorSpec(_MIRROR_RADIUS_M, arm)
            found.append(tile.placed(name, spec, point, height_m=height, yaw_rad=yaw))
    return found


def _is_blind(edge: Edge, tile: Tile, grid: Tiles) -> bool:
    """True if a driver who enters over an edge sees a side lane only from inside the square."""
    between = (grid.neighbour(tile, edge, side) for side in edge.ends if tile.drivable[side])
    return any(other is None or other.cell is Cell.FREE for other in between)


def _served(corner: tuple[Edge, Edge]) -> set[Edge]:
    """Edges from which entering drivers face a corner."""
    return set(Edge) - set(corner)


def _mount_m(
    corner: tuple[Edge, Edge],
    tile: Tile,
    grid: Tiles,
    feet: Sequence[tuple[Point, ColumnSpec]],
    beside: Points,
) -> tuple[Point, float] | None:
    """Distances of a mirror's centre from the sides of a corner along X and Z, and length of its arm.

    None without a support.
    """
    side_z, side_x = (sum(NEIGHBOUR_STEPS[edge]) for edge in corner)
    point = tile.at((side_x * tile.half_x_m, side_z * tile.half_z_m))
    _, near, far_m = beside.within(_COLUMN_FROM_CORNER_M, np.array([point]))
    if len(near):
        foot, column = feet[near[np.argmin(far_m)]]
        # mirrors around one column must not touch: a thin column needs longer arms
        nearest = column.size_m / 2 + _MIRROR_FROM_COLUMN_M
        inset = max(nearest, _MIRROR_RADIUS_M)
        usual_m = ColumnSpec(column.size_m, column.height_m).diagonal_m
        beyond = 0.0 if column.fills_square else usual_m - column.diagonal_m + _INTO_COLUMN_M
        x, z = tile.local(foot)
        insets = inset + tile.half_x_m - side_x * x, inset + tile.half_z_m - side_z * z
        return rounded(insets), round(_ARM_TO_COLUMN_M + (inset - nearest) * math.sqrt(2) + beyond, 6)
    if any(grid.neighbour(tile, edge) is None for edge in corner):
        return (_MIRROR_FROM_WALL_M, _MIRROR_FROM_WALL_M), _ARM_TO_WALL_M
    if grid.neighbour(tile, *corner) is None:
        return (_MIRROR_FROM_COLUMN_M, _MIRROR_FROM_COLUMN_M), _ARM_TO_EDGE_M
    return None
