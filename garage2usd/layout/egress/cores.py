"""Stair cores: candidate positions beside lanes, the stalls that they replace, and their placements."""
# Over 300 lines: candidates among perpendicular, angled and parallel stalls share their geometry.

from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np
import shapely

from garage2usd.config import GarageConfig
from garage2usd.config.look import NATURAL, WallsLook
from garage2usd.garage import StallKind
from garage2usd.layout.placement import (
    Placement,
    box_inside,
    edge_yaw_rad,
    placed,
    point_inside,
    rounded,
    stall_name,
    to_world,
)
from garage2usd.layout.tiles import Tile, Tiles
from garage2usd.objects.kind import Box, Point
from garage2usd.objects.obstacle import ObstacleSpec
from garage2usd.profiles import Profile
from garage2usd.structure.grid import Cell, Structure, outside_squares
from garage2usd.structure.lane_graph import LaneSquares, Square
from garage2usd.structure.stalls import Edge, StallRow, StallShape

RECESS_M = 0.5
"""Least setback of a core's door from the lane, so that nobody steps into traffic."""
_FROM_REAR_M = 0.2
FROM_COLUMN_M = 0.08
"""Gap for the zone plates of the adjacent column."""
_LEAST_WIDTH_M, MOST_WIDTH_M = 2.6, 4.6
_LEAST_DEPTH_M = 3.0
_MOST_STALLS = 2
_WALL_CLEARANCE_M = 0.6
"""Clearance beside a car if the profile has no clause for it."""
_DOOR_SIDES = (Edge.DOWN, Edge.UP, Edge.LEFT, Edge.RIGHT)


@dataclass(frozen=True)
class Core:
    """A block with stairs or lifts and a door to a lane.

    Attributes
    ----------
    square
        (row, col) of its square.
    edge
        Edge of that square that the door faces.
    centre_m
        (x, z) of its centre.
    width_m, depth_m
        Extent along that edge and across it.
    along_m
        Position of its centre along that edge, from the square's centre.
    recess_m
        Distance from that edge back to the door.
    stalls
        Ids of the stalls that it replaces.
    has_door
        False where a shaft passes a level without a door.
    lane_square
        `Tile.square` of the piece of lane in front of its door, where that is not the square beyond its edge.
    """

    square: Square
    edge: Edge
    centre_m: Point
    width_m: float
    depth_m: float
    along_m: float = 0.0
    recess_m: float = 0.0
    stalls: tuple[str, ...] = ()
    has_door: bool = True
    lane_square: Square | None = None

    @property
    def lane(self) -> Square:
        """(row, col) of the lane square in front of its door."""
        return self.lane_square or self.edge.beyond(self.square)

    @property
    def along_x(self) -> bool:
        """True if the edge that its door faces runs along X."""
        return self.edge.along_x

    def beside_m(self, half_m: float) -> float:
        """Centre of the free part beside the core along its edge, from the square's centre; `half_m` is half a side."""
        side = 1 if self.along_m < 0 else -1
        return round((self.along_m + side * (self.width_m / 2 + half_m)) / 2, 6)

    def landing(self, tile: Tile) -> Box:
        """Floor between its door and the lane, in its square's coordinates."""
        along = self.along_m - self.width_m / 2, self.along_m + self.width_m / 2
        half = tile.half_x_m, tile.half_z_m
        left, top, right, bottom = box_inside(self.edge, half, along, (0.0, self.recess_m))
        return round(left, 6), round(top, 6), round(right, 6), round(bottom, 6)

    @property
    def ground(self) -> shapely.Polygon:
        """Outline (x, z) of the core, including the floor between its door and the lane."""
        x, near, far = self.width_m / 2, self.depth_m / 2 + self.recess_m, -self.depth_m / 2
        corners = ((-x, near), (x, near), (x, far), (-x, far))
        return shapely.Polygon([to_world(corner, self.centre_m, edge_yaw_rad(self.edge)) for corner in corners])

    @property
    def door_m(self) -> Point:
        """Centre (x, z) of the core's door."""
        return to_world((0.0, self.depth_m / 2), self.centre_m, edge_yaw_rad(self.edge))


def obstacle_cores(structure: Structure, wells: Collection[Square] = ()) -> list[Core]:
    """Make a core of each obstacle that fills a square beside a lane, except on the squares of ramps' wells."""
    cells = structure.cells
    lane = np.pad(cells == Cell.LANE, 1)
    x, z = structure.column_edges_m, structure.row_edges_m
    cores = []
    for row, col in _blocks(structure, wells):
        for edge in _DOOR_SIDES:
            other = edge.beyond((row, col))
            if lane[other[0] + 1, other[1] + 1]:
                sides = float(x[col + 1] - x[col]), float(z[row + 1] - z[row])
                width, depth = sides if edge.along_x else sides[::-1]
                centre = float(x[col] + x[col + 1]) / 2, float(z[row] + z[row + 1]) / 2
                cores.append(Core((row, col), edge, centre, round(width, 6), round(depth, 6)))
                break
    return cores


def _blocks(structure: Structure, wells: Collection[Square]) -> list[Square]:
    """Return the obstacles inside the contour, except the squares of wells."""
    inside = (structure.cells == Cell.OBSTACLE) & ~outside_squares(structure.cells)
    return [(row, col) for row, col in np.argwhere(inside).tolist() if (row, col) not in wells]


def core_placements(
    structure: Structure | None,
    cores: list[Core],
    height_m: float,
    look: WallsLook,
    wells: Collection[Square] = (),
) -> list[Placement]:
    """Place all cores and shafts, and a concrete block on every other obstacle inside the contour of a plan.

    The squares of ramps' wells have none.
    """
    dado_m = None if look.dado == NATURAL else look.dado_m
    by_square = {core.square: core for core in cores}
    placements = []
    if structure is not None:
        x, z = structure.column_edges_m, structure.row_edges_m
        for row, col in _blocks(structure, wells):
            if (row, col) in by_square:
                continue
            width, depth = round(float(x[col + 1] - x[col]), 6), round(float(z[row + 1] - z[row]), 6)
            spec = ObstacleSpec(width, depth, height_m, has_door=False, dado_m=dado_m)
            position = (float(x[col] + x[col + 1]) / 2, 0.0, float(z[row] + z[row + 1]) / 2)
            placements.append(Placement(f"Obstacle_r{row:02d}_c{col:02d}", spec, position))
    for core in cores:
        row, col = core.square
        kind = "Core" if core.recess_m else "Obstacle" if core.has_door else "Shaft"
        place = f"r{row:02d}_c{col:02d}" if core.lane_square is None else f"{col:03d}"
        name = f"{kind}_{place}" + (f"_{core.edge.name.capitalize()}" if core.recess_m else "")
        spec = ObstacleSpec(core.width_m, core.depth_m, height_m, has_door=core.has_door, dado_m=dado_m)
        placements.append(placed(name, spec, core.centre_m, yaw_rad=edge_yaw_rad(core.edge)))
    return placements


def core_candidates(structure: Structure, graph: LaneSquares, config: GarageConfig) -> Iterator[Core]:
    """Yield all candidate cores beside a lane: on free squares without stalls, or at the ends of rows of stalls.

    A candidate replaces as many stalls as it needs; the car in the next stall keeps its clearance from the wall.
    """
    named = names_of_rows(graph)
    leaning = _leaning_grounds(structure, named)
    for core in _candidates(structure, graph, named, config):
        others = [stall for name, stall in leaning.items() if name not in core.stalls]
        if not others or not shapely.intersects(core.ground, others).any():
            yield core


_NamedRows = Mapping[tuple[Square, Edge], tuple[StallRow, tuple[str, ...]]]


def names_of_rows(graph: LaneSquares) -> _NamedRows:
    """Rows by square and edge, with the names of their stalls."""
    ordinals: Counter[Square] = Counter()
    named = {}
    for row in graph.stall_rows:
        first = ordinals[row.square] + 1
        ordinals[row.square] += row.count
        names = tuple(stall_name(row.square, first + index) for index in range(row.count))
        named[row.square, row.edge] = row, names
    return named


def _candidates(structure: Structure, graph: LaneSquares, named: _NamedRows, config: GarageConfig) -> Iterator[Core]:
    """Yield all candidates, including those that overlap an angled stall of an adjacent square."""
    for row, names in named.values():
        if row.shape.kind is StallKind.PERPENDICULAR:
            yield from _in_row(structure, row, names, config)
        else:
            yield from _across_rows(structure, row, named, config)
    shape = StallShape(config.bay.stall_width_m, config.bay.stall_length_m)
    with_stalls = {square for square, _ in named}
    for square in structure.where(Cell.FREE):
        for edge in Edge if square not in with_stalls else ():
            if edge.beyond(square) in graph.graph and structure.cells[edge.beyond(square)] == Cell.LANE:
                yield from _in_row(structure, StallRow(*square, edge, shape, ()), (), config)


def _leaning_grounds(structure: Structure, named: _NamedRows) -> dict[str, shapely.Polygon]:
    """Outline (x, z) of each angled stall by its name."""
    grounds = {}
    for row, names in named.values():
        if not row.shape.slope:
            continue
        depth = row.shape.depth_m
        lean = row.lean * row.shape.slope * depth
        for name, start in zip(names, row.starts_m, strict=True):
            end = start + row.shape.pitch_m
            corners = ((start, 0.0), (end, 0.0), (end + lean, depth), (start + lean, depth))
            grounds[name] = shapely.Polygon([point_inside(structure, row.square, row.edge, *at) for at in corners])
    return grounds


def _in_row(structure: Structure, row: StallRow, names: tuple[str, ...], config: GarageConfig) -> Iterator[Core]:
    """Yield the cores that fit the two ends of a row of perpendicular stalls."""
    room = _room_m(structure, row, config)
    if room is None:
        return
    low, high, depth_m = room
    taken, width_m = min(_MOST_STALLS, row.count), row.shape.width_m
    start = -row.count * width_m / 2
    gap = gap_to_stalls_m(width_m, config.standard)
    spans: tuple[tuple[float, float, tuple[str, ...]], ...] = ((low, high, names),)
    if taken < row.count:
        spans = (
            (low, start + taken * width_m - gap, names[:taken]),
            (-start - taken * width_m + gap, high, names[-taken:]),
        )
    for left, right, stalls in spans:
        width = min(right - left, MOST_WIDTH_M)
        if width < _LEAST_WIDTH_M:
            continue
        # against the column or the wall, or centred if no stall is left
        middle = (left + right) / 2 if taken == row.count else left + width / 2 if left == low else right - width / 2
        yield _core(structure, row, (middle, width, depth_m), stalls)


def _across_rows(
    structure: Structure,
    row: StallRow,
    named: _NamedRows,
    config: GarageConfig,
) -> Iterator[Core]:
    """Yield the cores at the two ends of a square with angled or parallel stalls, in place of those they overlap."""
    room = _room_m(structure, row, config)
    if room is None:
        return
    low, high, depth_m = room
    width = min(high - low, MOST_WIDTH_M)
    if width < _LEAST_WIDTH_M:
        return
    gap = gap_to_stalls_m(row.shape.width_m, config.standard)
    spans = list(_spans_m(structure, row, named, RECESS_M + depth_m))
    for left in dict.fromkeys((low, high - width)):
        touched = tuple(name for name, start, end in spans if start < left + width + gap and end > left - gap)
        yield _core(structure, row, (left + width / 2, width, depth_m), touched)


def _spans_m(
    structure: Structure,
    row: StallRow,
    named: _NamedRows,
    depth_m: float,
) -> Iterator[tuple[str, float, float]]:
    """Name and extent of a row's stalls and those of adjacent squares, along the row from its square's centre."""
    edges_m = structure.column_edges_m if row.edge.along_x else structure.row_edges_m
    at = row.col if row.edge.along_x else row.row
    for step, end in ((0, None), (-1, row.edge.ends[0]), (1, row.edge.ends[1])):
        square = row.square if end is None else end.beyond(row.square)
        other, names = named.get((square, row.edge), (None, ()))
        if other is None:
            continue
        off_m = float(edges_m[at + step] + edges_m[at + step + 1] - edges_m[at] - edges_m[at + 1]) / 2
        lean = other.lean * other.shape.slope * min(depth_m, other.shape.depth_m)
        for name, start in zip(names, other.starts_m, strict=True):
            yield name, off_m + start + min(lean, 0.0), off_m + start + other.shape.pitch_m + max(lean, 0.0)


def _room_m(structure: Structure, row: StallRow, config: GarageConfig) -> tuple[float, float, float] | None:
    """Interval along a row's square available to a core, from its centre, and its depth; None if too small."""
    bay = config.bay
    sides_m = structure.column_widths_mm[row.col] / 1000, structure.row_depths_mm[row.row] / 1000
    side_m, across_m = (float(side) for side in (sides_m if row.edge.along_x else sides_m[::-1]))
    depth_m = min(bay.stall_length_m, across_m) - RECESS_M - _FROM_REAR_M
    if depth_m < _LEAST_DEPTH_M:
        return None
    beside_column_m = bay.column_size_m / 2 + FROM_COLUMN_M
    kept_low_m, kept_high_m = (
        0.0 if structure.cell_at(edge.beyond(row.square)) is Cell.OBSTACLE else beside_column_m
        for edge in row.edge.ends
    )
    return kept_low_m - side_m / 2, side_m / 2 - kept_high_m, depth_m


def _core(structure: Structure, row: StallRow, place: tuple[float, float, float], stalls: tuple[str, ...]) -> Core:
    middle, width, depth = place
    centre = rounded(point_inside(structure, row.square, row.edge, middle, RECESS_M + depth / 2))
    return Core(row.square, row.edge, centre, round(width, 6), round(depth, 6), round(middle, 6), RECESS_M, stalls)


def crossings_to(cores: Iterable[Core], tiles: Tiles) -> dict[Square, float]:
    """Return where the crossings to the doors of cores lie, in metres along their lanes from the middle of a piece."""
    crossings: dict[Square, float] = {}
    for core in cores:
        lane = tiles.tiles[core.lane]
        at = lane.local(core.door_m)[0 if core.along_x else 1]
        crossings.setdefault(core.lane, round(at, 6) if lane.axis_is_x is core.along_x else 0.0)
    return crossings


def gap_to_stalls_m(stall_width_m: float, profile: Profile) -> float:
    """Gap between a core and the next stall's line that keeps the clearance of a centred car."""
    wall_m = profile.wall_clearance.amount if profile.wall_clearance else _WALL_CLEARANCE_M
    return max(wall_m - (stall_width_m - profile.car_width_m) / 2, 0.0)


def is_wide_enough(width_m: float, depth_m: float) -> bool:
    """True if stairs or a lift fit into a core."""
    return width_m >= _LEAST_WIDTH_M and depth_m >= _LEAST_DEPTH_M
