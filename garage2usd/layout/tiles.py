"""Tiles: pieces of a floor in metres with their surroundings, of which the squares of a plan are one kind."""
# Over 300 lines: what a piece of floor is asked, and the squares of a plan that answer it.

from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import shapely

from garage2usd.config import BayConfig, FittingsConfig
from garage2usd.garage import LaneKind, StallKind
from garage2usd.layout.placement import (
    PlacedStall,
    Placement,
    box_inside,
    placed,
    stall_name,
    sum_of_yaws,
    to_local,
    to_world,
)
from garage2usd.objects.ceiling import CeilingSpec
from garage2usd.objects.kind import Point, Polygon, Spec, rectangle
from garage2usd.structure.grid import Cell, Structure, outside_squares
from garage2usd.structure.lane_graph import LaneSquares, Square
from garage2usd.structure.stalls import Edge, StallRow, door_edges

if TYPE_CHECKING:
    import networkx as nx

CEILING_THICKNESS_M = 0.25
LEAST_FLOOR_M2 = 0.01
"""A piece with less floor around its stalls has no floor panel of its own."""
_LEAST_OPENING_M2 = 1e-6


@dataclass(frozen=True)
class Tile:
    """A rectangular piece of the floor: a square inside the contour of a plan, or a cut of a floor without squares.

    Attributes
    ----------
    square
        (row, col) of a square, or another pair of numbers that identifies the piece.
    cell
        Kind of the piece, as in S.
    x_m, z_m
        Centre of the piece.
    width_m, depth_m
        Extents along the own axes of the piece, which are X and Z unless it is turned.
    drivable
        For each `Edge`, whether cars cross it.
    stall_mouths
        For each `Edge`, whether stalls open across it (lanes only).
    way
        Edge over which cars leave a straight one-way lane, else None.
    kind
        Kind of the lane or portal on it, else None.
    clear_m
        Width between the columns across X and across Z (lanes and portals only).
    yaw_rad
        Rotation of its own axes about +Y.
    """

    square: Square
    cell: Cell
    x_m: float
    z_m: float
    width_m: float
    depth_m: float
    drivable: tuple[bool, bool, bool, bool]
    stall_mouths: tuple[bool, bool, bool, bool]
    way: Edge | None = None
    kind: LaneKind | None = None
    clear_m: tuple[float, float] = (0.0, 0.0)
    yaw_rad: float = 0.0

    def at(self, point: Point) -> Point:
        """Transform a point relative to its centre, along its own axes, to (x, z) in the garage."""
        return to_world(point, (self.x_m, self.z_m), self.yaw_rad)

    def local(self, point: Point) -> Point:
        """Transform a point (x, z) in the garage to its own coordinates."""
        return to_local(point, (self.x_m, self.z_m), self.yaw_rad)

    def placed(
        self, name: str, spec: Spec, point: Point = (0.0, 0.0), *, height_m: float = 0.0, yaw_rad: float = 0.0
    ) -> Placement:
        """Place an object at a point and a yaw in its own coordinates."""
        yaw_rad = sum_of_yaws(yaw_rad, self.yaw_rad)
        return placed(name, spec, self.at(point), height_m=height_m, yaw_rad=yaw_rad, square=self.square)

    @property
    def middle_m(self) -> Point:
        """Centre (x, z) of the tile."""
        return self.x_m, self.z_m

    @property
    def half_x_m(self) -> float:
        """Half of the tile's extent along X."""
        return self.width_m / 2

    @property
    def half_z_m(self) -> float:
        """Half of the tile's extent along Z."""
        return self.depth_m / 2

    @property
    def axis_is_x(self) -> bool | None:
        """True if a straight lane runs along X; None for bends and junctions."""
        up, down, left, right = self.drivable
        if (left or right) and not (up or down):
            return True
        if (up or down) and not (left or right):
            return False
        return None


class StallPlace(NamedTuple):
    """Position of a stall in its row.

    Attributes
    ----------
    ordinal
        Number on the square, from 1.
    row
        The row.
    slot
        Position in the row, from 0.
    is_first, is_last
        True if no stall precedes it, or follows it, in the row.
    """

    ordinal: int
    row: StallRow
    slot: int
    is_first: bool
    is_last: bool


class Tiles:
    """The pieces of a floor, on which objects are placed along lanes, at stalls and on free ground.

    Attributes
    ----------
    tiles
        All pieces by their `Tile.square`, in reading order.
    bay
        Sizes of stalls and columns.
    setback_m
        Distance between the carriageway and the edges of a lane's piece that cars do not cross.
    doors
        Edge of the vehicle door of each portal's piece.
    stall_places
        Stalls of each square with stalls, in the order of their numbers; none without squares.
    mouths
        Ground of stalls and before their mouths that equipment at doors keeps clear; None if a plan does so.
    """

    tiles: Mapping[Square, Tile]
    bay: BayConfig
    setback_m: float
    doors: Mapping[Square, Edge]
    stall_places: Mapping[Square, list[StallPlace]]
    mouths: shapely.Geometry | None = None

    def __iter__(self) -> Iterator[Tile]:
        """Iterate over the pieces in reading order."""
        return iter(self.tiles.values())

    def neighbour(self, tile: Tile, *edges: Edge) -> Tile | None:
        """Piece beyond one edge, or beyond a corner between two edges; None outside and on obstacles."""
        raise NotImplementedError

    def has_upright_stalls(self, square: Square) -> bool:
        """True if a square has stalls, and all of them are perpendicular."""
        places = self.stall_places.get(square, ())
        return bool(places) and all(place.row.shape.kind is StallKind.PERPENDICULAR for place in places)

    def openings(self, tile: Tile) -> tuple[Polygon, ...]:  # noqa: ARG002 - squares ask it
        """Outlines of the stalls on a free piece, whose panels replace its floor; none without squares."""
        return ()

    def is_bare(self, tile: Tile) -> bool:
        """True if a piece is free, and no stalls cover it."""
        raise NotImplementedError

    def row_along_x(self, tile: Tile) -> bool | None:
        """True if the stalls of a free piece stand in a row along its X, False for one along its Z; None without."""
        raise NotImplementedError

    def stalls_on(self, stalls: Iterable[PlacedStall]) -> Mapping[Square, list[PlacedStall]]:
        """Group stalls by the free pieces that they stand on."""
        raise NotImplementedError

    def opening_on(
        self, tile: Tile, edge: Edge, stalls_on: Mapping[Square, list[PlacedStall]]
    ) -> Sequence[PlacedStall]:
        """Return the stalls that open onto a lane's piece over one of its edges."""
        raise NotImplementedError

    @property
    def ways(self) -> "nx.DiGraph[Square]":
        """The steps that cars may drive between the pieces of lanes and portals, with ``length_m``."""
        raise NotImplementedError

    @property
    def one_way_stretches(self) -> Sequence[Sequence[Square]]:
        """The one-way stretches of lane between junctions, each as its pieces in the direction of driving."""
        raise NotImplementedError

    @property
    def ground(self) -> shapely.Geometry:
        """The ground (x, z) inside the walls, including obstacles."""
        raise NotImplementedError


class TileGrid(Tiles):
    """The squares of a plan as pieces of its floor."""

    def __init__(
        self, structure: Structure, graph: LaneSquares, bay: BayConfig, *, left_out: Collection[str] = ()
    ) -> None:
        """Place every square of `structure` in metres with its surroundings; `left_out` names stalls to omit."""
        self.structure, self.bay = structure, bay
        self.setback_m = bay.carriageway_setback_m
        self.doors = door_edges(structure.cells)
        self._lanes = graph
        self.stall_places = _stall_places(graph.stall_rows, left_out)
        mouths = {
            (*place.row.edge.beyond(square), place.row.edge.opposite)
            for square, places in self.stall_places.items()
            for place in places
        }
        x, z = structure.column_edges_m, structure.row_edges_m
        self.tiles = {
            (row, col): Tile(
                square=(row, col),
                cell=Cell(structure.cells[row, col]),
                x_m=float(x[col] + x[col + 1]) / 2,
                z_m=float(z[row] + z[row + 1]) / 2,
                width_m=float(structure.column_widths_mm[col]) / 1000,
                depth_m=float(structure.row_depths_mm[row]) / 1000,
                drivable=_by_edge(row, col, lambda square, edge: graph.graph.has_edge(square, edge.beyond(square))),
                stall_mouths=_by_edge(row, col, lambda square, edge: (*square, edge) in mouths),
                way=_way((row, col), graph),
                kind=graph.kind((row, col)) if (row, col) in graph.graph else None,
                clear_m=(
                    float(structure.column_widths_mm[col]) / 1000 - 2 * graph.setback_m,
                    float(structure.row_depths_mm[row]) / 1000 - 2 * graph.setback_m,
                ),
            )
            for row, col in np.argwhere(structure.cells != Cell.OBSTACLE).tolist()
        }

    def neighbour(self, tile: Tile, *edges: Edge) -> Tile | None:
        """Tile beyond one edge, or beyond a corner between two edges; None outside and on obstacles."""
        square = tile.square
        for edge in edges:
            square = edge.beyond(square)
        return self.tiles.get(square)

    def is_bare(self, tile: Tile) -> bool:
        """True if a tile is free, and neither its own stalls nor angled stalls of adjacent tiles cover it."""
        return tile.cell is Cell.FREE and not self.stall_places.get(tile.square) and not self.openings(tile)

    def row_along_x(self, tile: Tile) -> bool | None:
        """True if the stalls of a square stand in a row along X, False for one along Z; None without."""
        places = self.stall_places.get(tile.square)
        return places[0].row.edge.along_x if places else None

    def stalls_on(self, stalls: Iterable[PlacedStall]) -> dict[Square, list[PlacedStall]]:
        """Group stalls by their squares."""
        found: dict[Square, list[PlacedStall]] = {}
        for stall in stalls:
            found.setdefault(stall.square, []).append(stall)
        return found

    def opening_on(self, tile: Tile, edge: Edge, stalls_on: Mapping[Square, list[PlacedStall]]) -> list[PlacedStall]:
        """Return the stalls that open onto a lane square over one of its edges."""
        beyond = stalls_on.get(edge.beyond(tile.square), [])
        return [stall for stall in beyond if stall.access_square == tile.square]

    @cached_property
    def ways(self) -> "nx.DiGraph[Square]":
        """The steps that cars may drive between the squares of lanes and portals, with ``length_m``."""
        ways = self._lanes.graph.to_directed()
        allows = self._lanes.directions.allows
        ways.remove_edges_from([step for step in ways.edges if not allows(*step)])
        return ways

    @property
    def one_way_stretches(self) -> tuple[tuple[Square, ...], ...]:
        """The one-way stretches of lane between junctions, each as its squares in the direction of driving."""
        return self._lanes.directions.stretches(self.structure)

    @cached_property
    def ground(self) -> shapely.Geometry:
        """The ground (x, z) inside the contour, including obstacles."""
        return ground_inside(self.structure)

    def openings(self, tile: Tile) -> tuple[Polygon, ...]:
        """Outlines of the stalls on a tile in its coordinates, including parts of angled stalls of adjacent tiles."""
        own = [stall_outline(tile, place.row, place.slot) for place in self.stall_places.get(tile.square, [])]
        beside = [
            (self.tiles[other], place)
            for edge in Edge
            for other in [edge.beyond(tile.square)]
            for place in self.stall_places.get(other, [])
            if place.row.shape.slope and edge in place.row.edge.ends
        ]
        if not beside and not any(place.row.shape.slope for place in self.stall_places.get(tile.square, [])):
            return tuple(own)
        ground = shapely.box(-tile.half_x_m, -tile.half_z_m, tile.half_x_m, tile.half_z_m)
        for other, place in beside:
            x, z = other.x_m - tile.x_m, other.z_m - tile.z_m
            own.append(tuple((px + x, pz + z) for px, pz in stall_outline(other, place.row, place.slot)))
        parts = (ground.intersection(shapely.Polygon(outline)) for outline in own)
        return tuple(
            tuple((round(px, 6), round(pz, 6)) for px, pz in part.exterior.coords[:-1])
            for part in parts
            if part.area > _LEAST_OPENING_M2
        )


def ground_inside(structure: Structure) -> shapely.Geometry:
    """Return the ground (x, z) inside the contour, including obstacles."""
    x, z = structure.column_edges_m, structure.row_edges_m
    squares = np.argwhere(~outside_squares(structure.cells)).tolist()
    return shapely.union_all([shapely.box(x[col], z[row], x[col + 1], z[row + 1]) for row, col in squares])


def _way(square: Square, graph: LaneSquares) -> Edge | None:
    """Edge over which cars leave a one-way square, if they enter only over the opposite edge; else None."""
    one_way = graph.directions.one_way
    ways = [
        edge
        for edge in Edge
        if {(square, edge.beyond(square)), (edge.opposite.beyond(square), square)} & one_way
        and graph.directions.allows(edge.opposite.beyond(square), square)
        and graph.directions.allows(square, edge.beyond(square))
    ]
    return ways[0] if len(ways) == 1 else None


def _stall_places(rows: Iterable[StallRow], left_out: Collection[str]) -> dict[Square, list[StallPlace]]:
    """Positions of the stalls of each square with stalls, in the order of their numbers."""
    ordinals: Counter[Square] = Counter()
    places: dict[Square, list[StallPlace]] = {}
    for row in rows:
        square = row.square
        first = ordinals[square] + 1
        ordinals[square] += row.count
        is_stall = [stall_name(square, first + index) not in left_out for index in range(row.count)]
        around = [False, *is_stall, False]
        found = [
            StallPlace(first + index, row, index, not around[index], not around[index + 2])
            for index in range(row.count)
            if is_stall[index]
        ]
        if found:
            places.setdefault(square, []).extend(found)
    return places


def lane_edges(tile: Tile) -> list[Edge]:
    """Edges of a tile that cars cross."""
    return [edge for edge in Edge if tile.drivable[edge]]


def ceiling_panel(tile: Tile, fittings: FittingsConfig, storey_m: float | None = None) -> Placement:
    """Make the ceiling slab over one square, up to the floor of the level a storey above if there is one."""
    spec = CeilingSpec(tile.width_m, tile.depth_m, CEILING_THICKNESS_M)
    if storey_m is not None:
        spec = CeilingSpec(tile.width_m, tile.depth_m, round(storey_m - fittings.ceiling_height_m, 6), bears_floor=True)
    position = (tile.x_m, fittings.ceiling_height_m, tile.z_m)
    return Placement("Ceiling", spec, position, square=tile.square)


def stall_outline(tile: Tile, row: StallRow, slot: int) -> Polygon:
    """Rectangle or parallelogram of one stall of a row, in the tile's coordinates."""
    start, shape = row.starts_m[slot], row.shape
    return row_strip(tile, row, start, start + shape.pitch_m, (0.0, shape.depth_m))


def row_strip(tile: Tile, row: StallRow, start: float, end: float, depth: tuple[float, float]) -> Polygon:
    """Strip of a row on a tile between two distances inside the entries, with the slant of its stalls."""
    lean = row.lean * row.shape.slope
    if not lean:
        return row_rectangle(tile, row.edge, start, end, depth)
    near, far = depth
    return row_polygon(tile, row, ((start, near), (end, near), (end, far), (start, far)))


def row_polygon(tile: Tile, row: StallRow, points: Iterable[Point]) -> Polygon:
    """Polygon on a tile by its corners along a row's entries and inside them, with the slant of its stalls."""
    lean = row.lean * row.shape.slope
    return tuple(row_point(tile, row.edge, along + lean * inside, inside) for along, inside in points)


def row_point(tile: Tile, edge: Edge, along_m: float, inside_m: float) -> Point:
    """Point on a tile by its distance along an edge, from the edge's centre, and inwards."""
    x, z, *_ = box_inside(edge, (tile.half_x_m, tile.half_z_m), (along_m, along_m), (inside_m, inside_m))
    return round(x, 6), round(z, 6)


def row_rectangle(tile: Tile, edge: Edge, start: float, end: float, depth: tuple[float, float]) -> Polygon:
    """Rectangle on a tile from `start` to `end` along an edge, with a depth inwards."""
    box = box_inside(edge, (tile.half_x_m, tile.half_z_m), (start, end), depth)
    return rectangle(*(round(side, 6) for side in box))


def _by_edge(row: int, col: int, test: Callable[[Square, Edge], bool]) -> tuple[bool, bool, bool, bool]:
    up, down, left, right = (test((row, col), edge) for edge in Edge)
    return up, down, left, right
