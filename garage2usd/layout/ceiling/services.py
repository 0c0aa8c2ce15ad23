"""Services under the ceiling along the aisles: ventilation ducts, sprinkler pipes, cable trays."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from garage2usd.config.look import CeilingLook
from garage2usd.layout.ceiling.beams import (
    DUCT_HEIGHT_M,
    DUCT_WIDTH_M,
    PIPE_RADIUS_M,
    TRAY_HEIGHT_M,
    TRAY_WIDTH_M,
    CeilingLevels,
)
from garage2usd.layout.placement import Placement
from garage2usd.layout.tiles import Tile, Tiles
from garage2usd.objects.cable_tray import CableTraySpec
from garage2usd.objects.duct import DuctSpec
from garage2usd.objects.kind import Point, Spec
from garage2usd.objects.sprinkler import SprinklerSpec
from garage2usd.structure.grid import Cell
from garage2usd.structure.stalls import Edge

_QUARTER_TURN = np.pi / 2
_LEAST_SQUARE_M = 4.8
"""Least side of a square with room for all services beside each other."""
_LEAST_JOIN_M = 0.3
"""Least distance of a perpendicular service from a square that is joined to it."""
_HEAD_PITCH_M = 3.3
_HANGER_FROM_BEAM_M = 0.1
_FREE_OF_LINES_M = 1.65
"""Distance from the carriageway's edge beyond which no perpendicular service crosses."""
_FREE_OF_DUCTS_M = 1.45
_HANGER_FROM_JOINT_M = 0.4
_TUBE_GAP_M = 0.12


@dataclass(frozen=True)
class _Service:
    """Cross-section of a service along the aisles.

    Attributes
    ----------
    name
        Name of its pieces.
    side
        Side of the aisle: 1 for +Z of an aisle along X and for -X of an aisle along Z; -1 for the other sides.
    from_edge_m
        Distance of its middle from the carriageway's edge.
    half_width_m
        Half its width.
    """

    name: str
    side: int
    from_edge_m: float
    half_width_m: float


_DUCT = _Service("Duct", -1, 0.75, DUCT_WIDTH_M / 2)
_PIPE = _Service("Sprinkler", 1, 0.5, PIPE_RADIUS_M)
_TRAY = _Service("CableTray", 1, 1.2, TRAY_WIDTH_M / 2)
LINES_REACH_M = _DUCT.from_edge_m + _DUCT.half_width_m + 0.05
"""Distance from the carriageway's edge to the far side of ducts with flanges, and of pipes."""
TRAYS_REACH_M = _TRAY.from_edge_m + _TRAY.half_width_m
"""Distance from the carriageway's edge to the far side of cable trays."""


@dataclass(frozen=True)
class _ServicePiece:
    """Straight piece of a service that starts at the border of a square.

    Attributes
    ----------
    middle_m
        Its middle, in the coordinates of its tile.
    half_square_m
        Half the extent of the square below, along the piece.
    step
        Direction from that border: 1 towards +X or +Z, -1 towards -X or -Z.
    joins
        True if the piece ends at a perpendicular service of a row, False if it ends at the opposite border.
    """

    name: str
    tile: Tile
    middle_m: Point
    length_m: float
    along_x: bool
    half_square_m: float
    step: int
    joins: bool = False


def ducts(grid: Tiles, ceiling_m: float, levels: CeilingLevels, look: CeilingLook) -> list[Placement]:
    """Place ventilation ducts along the aisles, on the side without pipes."""
    if levels.duct_top_m is None:
        return []
    lines = []
    for piece in _service_pieces(_DUCT, grid):
        hangers = _hangers_at_m(piece, grid.setback_m)
        spec = DuctSpec(piece.length_m, DUCT_WIDTH_M, DUCT_HEIGHT_M, levels.duct_top_m, hangers)
        if look.round_ducts:
            spec = replace(spec, is_round=True, joint=piece.step if piece.joins else 0)
        lines.append(_place(piece, spec, ceiling_m - levels.duct_top_m))
    return lines


def sprinklers(grid: Tiles, ceiling_m: float, levels: CeilingLevels) -> list[Placement]:
    """Place sprinkler pipes along the aisles, on the side without ducts; pipes cross above ducts."""
    if levels.pipe_drop_m is None:
        return []
    lines = []
    for piece in _service_pieces(_PIPE, grid):
        heads = () if piece.joins else _heads_at_m(piece.length_m, grid.setback_m)
        rods = _hangers_at_m(piece, grid.setback_m)
        spec = SprinklerSpec(piece.length_m, PIPE_RADIUS_M, levels.pipe_drop_m, rods, heads)
        lines.append(_place(piece, spec, ceiling_m))
    return lines


def cable_trays(grid: Tiles, ceiling_m: float, levels: CeilingLevels) -> list[Placement]:
    """Place cable trays along the aisles, beside the pipes; trays cross above pipes and ducts."""
    if levels.tray_drop_m is None:
        return []
    lines = []
    for piece in _service_pieces(_TRAY, grid):
        rods = _hangers_at_m(piece, grid.setback_m)
        spec = CableTraySpec(piece.length_m, TRAY_WIDTH_M, TRAY_HEIGHT_M, levels.tray_drop_m, rods)
        lines.append(_place(piece, spec, ceiling_m))
    return lines


def _place(piece: _ServicePiece, spec: Spec, height_m: float) -> Placement:
    """Place a piece of a service at a height over the floor."""
    tile, yaw = piece.tile, _QUARTER_TURN if piece.along_x else 0.0
    return tile.placed(piece.name, spec, piece.middle_m, height_m=round(height_m, 6), yaw_rad=yaw)


def _service_pieces(line: _Service, grid: Tiles) -> Iterator[_ServicePiece]:
    """Yield the piece of a service over each lane square: along X if a lane is beside it in its row, else along Z.

    A service along a column of squares continues to those of the rows above and below.
    """

    def in_row(tile: Tile) -> bool:
        """Return True if a lane is beside a lane's piece along its X."""
        beside = (grid.neighbour(tile, edge) for edge in (Edge.LEFT, Edge.RIGHT))
        return any(other is not None and other.cell is Cell.LANE for other in beside)

    def from_middle_m(half_m: float) -> float:
        """Return the distance of the service from the middle of an aisle."""
        return max(half_m - grid.setback_m - line.from_edge_m, 0.0)

    for tile in grid:
        if tile.cell is not Cell.LANE or not _has_room(tile):
            continue
        if in_row(tile):
            middle = 0.0, line.side * from_middle_m(tile.half_z_m)
            yield _ServicePiece(line.name, tile, middle, round(tile.width_m, 6), True, tile.half_x_m, 1)
            continue
        x = -line.side * from_middle_m(tile.half_x_m)
        yield _ServicePiece(line.name, tile, (x, 0.0), round(tile.depth_m, 6), False, tile.half_z_m, 1)
        for turn, edge, step in (("Up", Edge.UP, -1), ("Down", Edge.DOWN, 1)):
            other = grid.neighbour(tile, edge)
            if other is None or other.cell is not Cell.LANE or not in_row(other) or not _has_room(other):
                continue
            start = step * tile.half_z_m
            beside = line.side * from_middle_m(other.half_z_m) - step * line.half_width_m
            end = tile.local(other.at((0.0, beside)))[1]
            length = round(step * (end - start), 6)
            if length < _LEAST_JOIN_M:
                continue
            yield _ServicePiece(
                f"{line.name}{turn}", tile, (x, (start + end) / 2), length, False, other.half_z_m, step, joins=True
            )


def _has_room(tile: Tile) -> bool:
    """Return True if a square has room for all services beside each other."""
    return min(tile.width_m, tile.depth_m) >= _LEAST_SQUARE_M


def _hangers_at_m(piece: _ServicePiece, setback_m: float) -> tuple[float, ...]:
    """Return the places of hangers along a piece: beside beams, clear of crossing services and tube lights."""
    near, free = setback_m + _HANGER_FROM_BEAM_M, setback_m + _FREE_OF_LINES_M
    length = piece.length_m
    wanted = (near, free, length - _HANGER_FROM_JOINT_M) if piece.joins else (near, free, length - free, length - near)
    places = sorted({round(at, 6) for at in wanted if near <= at < length - _HANGER_FROM_BEAM_M})
    places = [at for at in places if abs(at - piece.half_square_m) > _TUBE_GAP_M]
    return tuple(round(piece.step * (at - length / 2), 6) for at in places)


def _heads_at_m(length_m: float, setback_m: float) -> tuple[float, ...]:
    """Return the places of sprinkler heads along a pipe over a square, evenly spaced and clear of crossing ducts."""
    count = max(1, round(length_m / _HEAD_PITCH_M))
    most = max(length_m / 2 - setback_m - _FREE_OF_DUCTS_M, 0.0)
    even = ((index + 0.5) * length_m / count - length_m / 2 for index in range(count))
    return tuple(round(min(max(at, -most), most), 6) for at in even)
