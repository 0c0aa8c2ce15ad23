"""Signs over aisles, ramps and stair cores, and mirrors at junctions."""
# Over 300 lines: all signs look for free height between the same beams and services.

import math
from collections import defaultdict
from collections.abc import Iterable, Sequence

import networkx as nx
import numpy as np

from garage2usd.assets.mesh import pascal_case
from garage2usd.config import FittingsConfig
from garage2usd.garage import LaneKind
from garage2usd.layout.ceiling.beams import CeilingLevels
from garage2usd.layout.ceiling.services import TRAYS_REACH_M
from garage2usd.layout.egress.cores import Core
from garage2usd.layout.fittings import TUBE_DEPTH_M
from garage2usd.layout.grounds import Points
from garage2usd.layout.placement import Placement, box_inside, edge_yaw_rad, of_spec, placed, rounded, to_world
from garage2usd.layout.shell.well import Departure, Well
from garage2usd.layout.tiles import Tile, Tiles, lane_edges
from garage2usd.objects.column import ColumnSpec
from garage2usd.objects.exit_sign import EXIT_SIGN_WIDTH_M, ExitSignSpec, Turn
from garage2usd.objects.kind import Point
from garage2usd.objects.lane_sign import LaneSignSpec, LaneSignText
from garage2usd.objects.level_plate import LEVEL_PLATE_WIDTH_M, LevelPlateSpec
from garage2usd.objects.level_sign import Heading, LevelSignSpec
from garage2usd.objects.mirror import MirrorSpec
from garage2usd.structure.grid import NEIGHBOUR_STEPS, Cell
from garage2usd.structure.lane_graph import Square
from garage2usd.structure.stalls import Edge

_SIGN_HEIGHT_M = 0.2
SIGN_FROM_EDGE_M = 0.45
_LANE_SIGN_M, _LEAST_LANE_SIGN_M = 0.4, 0.2
_LANE_SIGN_ASIDE_M = 1.0
"""Distance of signs from the centre of a lane, between the tubes and the ducts and trays; less over narrow lanes."""
_FROM_TRAY_M = 0.05
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
_MOST_M, _LEAST_M = 0.4, 0.2
_BELOW_BEAM_M = 0.03
_GAP_M = 0.1
"""Distance of signs from exit signs, as their readers see them."""
_PLATE_FOOT_M = 1.70
"""Height of plates, as of those of zones: above the equipment on walls."""
_PLATE_FROM_DOOR_M = 0.68
"""Distance of a plate's near edge from the middle of a door."""
_HEADINGS = {Turn.LEFT: Heading.LEFT, Turn.AHEAD: Heading.UP, Turn.RIGHT: Heading.RIGHT}


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
        The pieces of the floor, the settings, and the heights of beams, services and signs.
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
    clear_m = tile.clear_m[0 if edge.along_x else 1]
    beside_m = max(clear_m / 2 - TRAYS_REACH_M - _FROM_TRAY_M - spec.width_m / 2, 0.0)
    aside_m = round(min(_LANE_SIGN_ASIDE_M, beside_m), 6)
    # on the reader's right, which is the sign's local +X
    to_right = aside_m if edge in {Edge.DOWN, Edge.LEFT} else -aside_m
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


def level_signs(grid: Tiles, fittings: FittingsConfig, levels: CeilingLevels, well: Well) -> list[Placement]:
    """Place signs that name the levels, for drivers.

    Over the landing before a ramp a sign names the level that it leads to, with an arrow up or down; signs over the
    lanes into the junction before it point there. Over a landing where cars arrive a sign names this level, and a
    no-entry sign hangs beside the ramp. Signs hang beside the exit signs and at their height; over landings, which
    no services cross, higher up where they must. There are none without space above the clear height.
    """
    ceiling_m, room_m = fittings.ceiling_height_m, fittings.ceiling_height_m - fittings.clear_height_m
    if not fittings.exit_signs:
        return []
    signs: list[Placement] = []
    least_top_m = max(levels.beam_depth_m, TUBE_DEPTH_M) + _BELOW_BEAM_M
    height_m = round(min(_MOST_M, room_m - least_top_m), 3)
    if height_m >= _LEAST_M:
        top_m = round(min(levels.sign_top_m, room_m - height_m), 3)
        for ramp in well.departures:
            heading = Heading.UP if ramp.is_up else Heading.DOWN
            spec = LevelSignSpec(ramp.to, heading, top_m, height_m, is_way_out=ramp.is_up)
            signs.append(_hung("RampSign", spec, grid.tiles[ramp.landing], ramp.way.opposite, ceiling_m, at_back=True))
        for landing, way in well.arrivals.items():
            spec = LevelSignSpec(well.name, None, top_m, height_m)
            signs.append(_hung("LevelSign", spec, grid.tiles[landing], way, ceiling_m, side=1, at_back=True))
            no_entry = LaneSignSpec(LaneSignText.NO_ENTRY, top_m, height_m)
            signs.append(
                _hung("NoEntrySign", no_entry, grid.tiles[landing], way.opposite, ceiling_m, side=1, at_back=True)
            )
    height_m = round(min(_MOST_M, room_m - levels.sign_top_m), 3)
    if height_m < _LEAST_M:
        return signs
    taken: dict[tuple[Square, Edge], int] = defaultdict(int)
    for ramp in well.departures:
        for junction, edge, heading in _before(ramp, grid):
            spec = LevelSignSpec(ramp.to, heading, levels.sign_top_m, height_m)
            # on the reader's left; the sign for the other ramp hangs on the right
            side = 1 if taken[junction, edge] else -1
            taken[junction, edge] += 1
            name = f"LevelSign_{ramp.to}_{edge.name.capitalize()}"
            signs.append(_hung(name, spec, grid.tiles[junction], edge, ceiling_m, side=side))
    return signs


def _before(ramp: Departure, grid: Tiles) -> list[tuple[Square, Edge, Heading]]:
    """Return the junctions before a ramp, with each edge over which drivers enter them, and the turn towards the ramp.

    Lanes may lead to a landing from the side too. From a junction with several ways the first one counts.
    """
    outs: dict[Square, Square] = {}
    for square in sorted({*nx.all_neighbors(grid.ways, ramp.landing)}):
        way = _back_to_junction(ramp.landing, square, grid)
        if way is not None:
            outs.setdefault(*way)
    found = []
    for junction, following in outs.items():
        (out,) = (edge for edge in Edge if edge.beyond(junction) == following)
        found += [(junction, edge, _HEADINGS[turn_at(edge, out)]) for edge in edges_in(grid.tiles[junction], grid, out)]
    return found


def _back_to_junction(landing: Square, square: Square, grid: Tiles) -> tuple[Square, Square] | None:
    """Return the junction from which a lane leads over a square to a landing, and the next square; None without one."""
    last, seen = landing, {landing}
    while grid.ways.has_edge(square, last):
        if grid.tiles[square].kind in JUNCTIONS:
            return square, last
        seen.add(square)
        others = [*{*nx.all_neighbors(grid.ways, square)} - {last}]
        if len(others) != 1 or others[0] in seen:
            break
        last, square = square, others[0]
    return None


def _hung(
    name: str,
    spec: LevelSignSpec | LaneSignSpec,
    tile: Tile,
    faces: Edge,
    ceiling_m: float,
    *,
    side: int = 0,
    at_back: bool = False,
) -> Placement:
    """Hang a sign over a square so that it faces the drivers who cross an edge.

    It hangs beside that edge or, `at_back`, beside the opposite one; on the reader's right (1) of the place of an exit
    sign, on the left (-1), or in the middle (0).
    """
    half_m = tile.half_z_m if faces.along_x else tile.half_x_m
    ahead_m = half_m - SIGN_FROM_EDGE_M
    aside_m = side * (EXIT_SIGN_WIDTH_M / 2 + _GAP_M + spec.width_m / 2)
    yaw = edge_yaw_rad(faces)
    place = to_world((aside_m, -ahead_m if at_back else ahead_m), tile.middle_m, yaw)
    return placed(name, spec, place, height_m=ceiling_m, yaw_rad=yaw, square=tile.square)


def level_plates(cores: Iterable[Core], well: Well) -> list[Placement]:
    """Place a sign with the level's name beside the door of each stair core, on the side of its handle."""
    across_m = _PLATE_FROM_DOOR_M + LEVEL_PLATE_WIDTH_M / 2
    return [
        placed(
            f"LevelPlate_r{core.square[0]:02d}_c{core.square[1]:02d}_{core.edge.name.capitalize()}",
            LevelPlateSpec(well.name),
            to_world((across_m, core.depth_m / 2), core.centre_m, edge_yaw_rad(core.edge)),
            height_m=_PLATE_FOOT_M,
            yaw_rad=edge_yaw_rad(core.edge),
        )
        for core in cores
        if core.width_m / 2 >= across_m + LEVEL_PLATE_WIDTH_M / 2
    ]
