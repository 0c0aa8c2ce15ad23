"""Stair cores: where people leave on foot, and which stalls give way to them."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from garage2usd.config import GarageConfig
from garage2usd.config.look import NATURAL, WallsLook
from garage2usd.layout.placement import Placement, box_inside, edge_yaw_rad, placed, rounded, stall_name, to_world
from garage2usd.layout.tiles import Tile
from garage2usd.objects.obstacle import ObstacleSpec
from garage2usd.objects.outline import Box, Point
from garage2usd.profiles import Profile
from garage2usd.structure.grid import Cell, Structure, outside_squares
from garage2usd.structure.lane_graph import LaneSquares, Square
from garage2usd.structure.stalls import Edge, StallRow

__all__ = ["Core", "core_candidates", "core_placements", "obstacle_cores"]

RECESS_M = 0.5
"""How far the door of a core among stalls stands back from the lane, so that nobody steps into traffic."""
_FROM_REAR_M = 0.2
_FROM_COLUMN_M = 0.08
"""Room for the zone plates of the column beside."""
_LEAST_WIDTH_M, _MOST_WIDTH_M = 2.6, 4.6
_LEAST_DEPTH_M = 3.0
_MOST_STALLS = 2
_WALL_CLEARANCE_M = 0.6
"""Beside a car, where the profile asks for nothing."""
_DOOR_SIDES = (Edge.DOWN, Edge.UP, Edge.LEFT, Edge.RIGHT)


@dataclass(frozen=True)
class Core:
    """A block with stairs or lifts, with a door onto a lane.

    Attributes
    ----------
    square
        (row, col) of the square that it stands on.
    edge
        The edge of that square that its door looks to.
    centre_m
        (x, z) of its middle.
    width_m, depth_m
        Its extent along that edge and across it.
    along_m
        Its middle along that edge, from the square's middle.
    recess_m
        From that edge back to its door.
    stalls
        Ids of the stalls in whose place it stands.
    """

    square: Square
    edge: Edge
    centre_m: Point
    width_m: float
    depth_m: float
    along_m: float = 0.0
    recess_m: float = 0.0
    stalls: tuple[str, ...] = ()

    @property
    def lane(self) -> Square:
        """(row, col) of the lane square that its door opens onto."""
        return self.edge.beyond(self.square)

    @property
    def along_x(self) -> bool:
        """Whether the edge that its door looks to runs along X."""
        return self.edge.along_x

    def beside_m(self, half_m: float) -> float:
        """The middle of what it leaves of a square of half an extent along its edge, from the square's middle."""
        side = 1 if self.along_m < 0 else -1
        return round((self.along_m + side * (self.width_m / 2 + half_m)) / 2, 6)

    def landing(self, tile: Tile) -> Box:
        """The floor between its door and the lane, in its square's coordinates."""
        along = self.along_m - self.width_m / 2, self.along_m + self.width_m / 2
        half = tile.half_x_m, tile.half_z_m
        left, top, right, bottom = box_inside(self.edge, half, along, (0.0, self.recess_m))
        return round(left, 6), round(top, 6), round(right, 6), round(bottom, 6)

    @property
    def door_m(self) -> Point:
        """(x, z) of the middle of its door."""
        return to_world((0.0, self.depth_m / 2), self.centre_m, edge_yaw_rad(self.edge))


def obstacle_cores(structure: Structure) -> list[Core]:
    """The obstacles that fill a square beside a lane, each with a door onto it."""
    cells = structure.cells
    lane = np.pad(cells == Cell.LANE, 1)
    x, z = structure.column_edges_m, structure.row_edges_m
    cores = []
    for row, col in np.argwhere((cells == Cell.OBSTACLE) & ~outside_squares(cells)).tolist():
        for edge in _DOOR_SIDES:
            other = edge.beyond((row, col))
            if lane[other[0] + 1, other[1] + 1]:
                sides = float(x[col + 1] - x[col]), float(z[row + 1] - z[row])
                width, depth = sides if edge.along_x else sides[::-1]
                centre = float(x[col] + x[col + 1]) / 2, float(z[row] + z[row + 1]) / 2
                cores.append(Core((row, col), edge, centre, round(width, 6), round(depth, 6)))
                break
    return cores


def core_placements(structure: Structure, cores: list[Core], height_m: float, look: WallsLook) -> list[Placement]:
    """A concrete block on every obstacle inside the contour, with a door where it is a core, and all other cores."""
    dado_m = None if look.dado == NATURAL else look.dado_m
    x, z = structure.column_edges_m, structure.row_edges_m
    by_square = {core.square: core for core in cores}
    placements = []
    for row, col in np.argwhere((structure.cells == Cell.OBSTACLE) & ~outside_squares(structure.cells)).tolist():
        if (row, col) not in by_square:
            width, depth = round(float(x[col + 1] - x[col]), 6), round(float(z[row + 1] - z[row]), 6)
            spec = ObstacleSpec(width, depth, height_m, has_door=False, dado_m=dado_m)
            position = (float(x[col] + x[col + 1]) / 2, 0.0, float(z[row] + z[row + 1]) / 2)
            placements.append(Placement(f"Obstacle_r{row:02d}_c{col:02d}", spec, position))
    for core in cores:
        row, col = core.square
        kind = "Core" if core.recess_m else "Obstacle"
        name = f"{kind}_r{row:02d}_c{col:02d}" + (f"_{core.edge.name.capitalize()}" if core.recess_m else "")
        spec = ObstacleSpec(core.width_m, core.depth_m, height_m, dado_m=dado_m)
        placements.append(placed(name, spec, core.centre_m, yaw_rad=edge_yaw_rad(core.edge)))
    return placements


def core_candidates(structure: Structure, graph: LaneSquares, config: GarageConfig) -> Iterator[Core]:
    """Every place for a core beside a lane: on a free square without stalls, or at the end of a row of stalls.

    One takes the place of as many stalls as it needs; the car in the next one keeps its distance from the wall.
    """
    ordinals: dict[Square, int] = {}
    for row in graph.stall_rows:
        square = row.square
        first = ordinals.get(square, 1)
        ordinals[square] = first + row.count
        names = tuple(stall_name(square, first + index) for index in range(row.count))
        yield from _in_row(structure, row, names, config)
    for square in structure.where(Cell.FREE):
        if square not in ordinals:
            for edge in Edge:
                if edge.beyond(square) in graph.graph and structure.cells[edge.beyond(square)] == Cell.LANE:
                    yield from _in_row(structure, StallRow(*square, edge, 0), (), config)


def _in_row(structure: Structure, row: StallRow, names: tuple[str, ...], config: GarageConfig) -> Iterator[Core]:
    """The cores that fit the two ends of a row of stalls."""
    bay = config.bay
    sides_m = structure.column_widths_mm[row.col] / 1000, structure.row_depths_mm[row.row] / 1000
    side_m, across_m = (float(side) for side in (sides_m if row.edge.along_x else sides_m[::-1]))
    depth_m = min(bay.stall_length_m, across_m) - RECESS_M - _FROM_REAR_M
    if depth_m < _LEAST_DEPTH_M:
        return
    low, high = (
        sign * (side_m / 2 - (bay.column_size_m / 2 + _FROM_COLUMN_M) * _is_inside(structure, edge.beyond(row.square)))
        for sign, edge in zip((-1, 1), row.edge.ends, strict=True)
    )
    taken = min(_MOST_STALLS, row.count)
    start = -row.count * bay.stall_width_m / 2
    gap = _gap_to_stalls_m(bay.stall_width_m, config.standard)
    spans: tuple[tuple[float, float, tuple[str, ...]], ...] = ((low, high, names),)
    if taken < row.count:
        spans = (
            (low, start + taken * bay.stall_width_m - gap, names[:taken]),
            (-start - taken * bay.stall_width_m + gap, high, names[-taken:]),
        )
    for left, right, stalls in spans:
        width = min(right - left, _MOST_WIDTH_M)
        if width < _LEAST_WIDTH_M:
            continue
        # against the column or the wall, or in the middle where no stall is left
        middle = (left + right) / 2 if taken == row.count else left + width / 2 if left == low else right - width / 2
        yield _core(structure, row, (middle, width, depth_m), stalls)


def _core(structure: Structure, row: StallRow, place: tuple[float, float, float], stalls: tuple[str, ...]) -> Core:
    middle, width, depth = place
    x, z = structure.column_edges_m, structure.row_edges_m
    half_x, half_z = (float(e[i + 1] - e[i]) / 2 for e, i in ((x, row.col), (z, row.row)))
    back = RECESS_M + depth / 2
    off_x, off_z, *_ = box_inside(row.edge, (half_x, half_z), (middle, middle), (back, back))
    centre = rounded((float(x[row.col]) + half_x + off_x, float(z[row.row]) + half_z + off_z))
    return Core(row.square, row.edge, centre, round(width, 6), round(depth, 6), round(middle, 6), RECESS_M, stalls)


def _gap_to_stalls_m(stall_width_m: float, profile: Profile) -> float:
    """What a core leaves beside the next stall's line, so that a car in its middle keeps its distance."""
    wall_m = profile.wall_clearance.amount if profile.wall_clearance else _WALL_CLEARANCE_M
    return max(wall_m - (stall_width_m - profile.car_width_m) / 2, 0.0)


def _is_inside(structure: Structure, square: Square) -> bool:
    """Whether a square is part of the garage."""
    row, col = square
    rows, cols = structure.shape
    return 0 <= row < rows and 0 <= col < cols and bool(structure.cells[row, col] != Cell.OBSTACLE)
