"""Signs of levels: over ramps, over the lanes into the junctions before them, over arrivals, and at stair cores."""

from collections import defaultdict
from collections.abc import Iterable

import networkx as nx

from garage2usd.config import FittingsConfig
from garage2usd.layout.ceiling.beams import CeilingLevels
from garage2usd.layout.ceiling.signs_and_mirrors import JUNCTIONS, SIGN_FROM_EDGE_M, edges_in, turn_at
from garage2usd.layout.egress.cores import Core
from garage2usd.layout.fittings import TUBE_DEPTH_M
from garage2usd.layout.placement import Placement, edge_yaw_rad, placed, to_world
from garage2usd.layout.shell.well import Departure, Well
from garage2usd.layout.tiles import Tile, Tiles
from garage2usd.objects.exit_sign import EXIT_SIGN_WIDTH_M, Turn
from garage2usd.objects.lane_sign import LaneSignSpec, LaneSignText
from garage2usd.objects.level_plate import LEVEL_PLATE_WIDTH_M, LevelPlateSpec
from garage2usd.objects.level_sign import Heading, LevelSignSpec
from garage2usd.structure.lane_graph import Square
from garage2usd.structure.stalls import Edge

__all__ = ["level_plates", "level_signs"]

_MOST_M, _LEAST_M = 0.4, 0.2
_BELOW_BEAM_M = 0.03
_GAP_M = 0.1
"""Distance of signs from exit signs, as their readers see them."""
_PLATE_FOOT_M = 1.70
"""Height of plates, as of those of zones: above the equipment on walls."""
_PLATE_FROM_DOOR_M = 0.68
"""Distance of a plate's near edge from the middle of a door."""
_HEADINGS = {Turn.LEFT: Heading.LEFT, Turn.AHEAD: Heading.UP, Turn.RIGHT: Heading.RIGHT}


def level_signs(grid: Tiles, fittings: FittingsConfig, levels: CeilingLevels, well: Well) -> list[Placement]:
    """Place signs that name the levels, for drivers.

    Over the landing before a ramp a sign names the level that it leads to, with an arrow up or down; signs over the
    lanes into the junction before it point there. Over a landing where cars arrive a sign names this level, and beside
    the ramp another one forbids to enter it. Signs hang beside the exit signs and at their height; over landings, which
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
            # on the reader's left; that of the other ramp on the right
            side = 1 if taken[junction, edge] else -1
            taken[junction, edge] += 1
            name = f"LevelSign_{ramp.to}_{edge.name.capitalize()}"
            signs.append(_hung(name, spec, grid.tiles[junction], edge, ceiling_m, side=side))
    return signs


def _before(ramp: Departure, grid: Tiles) -> list[tuple[Square, Edge, Heading]]:
    """Return the junctions before a ramp with each edge over which drivers enter them, and their way to the ramp.

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
    """Hang a sign over a square for drivers who come over the edge that it faces.

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
    """Place a plate with the level's name beside the door of each stair core, on the side of its handle."""
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
