"""The pieces of a floor without squares: cuts of its lanes, rows of stalls, and the free ground between them."""
# Over 300 lines: lanes, rows and free ground are cut one after the other, each from what the others leave.

import math
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import pairwise, product

import networkx as nx
import numpy as np
import shapely

from garage2usd.config import BayConfig
from garage2usd.garage import LaneGraph, Point
from garage2usd.layout.placement import PlacedStall, rounded
from garage2usd.layout.surveyed.ground import SurveyedGround, rectangles
from garage2usd.layout.surveyed.lane_pieces import AXIS_RAD, LanePieces, edge_towards
from garage2usd.layout.tiles import Tile, Tiles
from garage2usd.native import elementary
from garage2usd.objects.kind import Polygon, rectangle
from garage2usd.structure.grid import NEIGHBOUR_STEPS, Cell
from garage2usd.structure.lane_graph import Square
from garage2usd.structure.stalls import Edge

_MOST_MARGIN_M = 1.2
"""Greatest distance between a carriageway and the mouths of its stalls that counts as the lane's."""
_BEFORE_MOUTH_M = 3.0
"""Greatest distance from a stall's mouth to the piece of lane that it opens onto."""
_BEYOND_M = 0.8
"""Distance beyond an edge at which the next piece is looked for."""
_LEAST_FREE_M = 2.0
"""Least width of free ground that counts as a piece's."""
_LEAST_SIDE_M = 3.5
"""Least side of a free piece, in which a stair core has room."""
_TOUCH_M = 0.05
_FREE = -2
"""First number of the pairs by which rows of stalls and free pieces are known: no (row, col) of a tile."""
_DIGITS = 6


class SurveyedTiles(Tiles):
    """The pieces of the floor of a surveyed garage.

    Parameters
    ----------
    ground
        The ground inside its outline.
    lanes
        Its lane graph.
    stalls
        Its stalls.
    bay
        Size of the columns, beside which carriageways keep clear.
    solids
        Blocks on the floor.
    wells
        Ramps on the floor, and openings in it.

    Attributes
    ----------
    solids
        The blocks.
    """

    def __init__(
        self,
        ground: SurveyedGround,
        lanes: LaneGraph,
        stalls: Sequence[PlacedStall],
        bay: BayConfig,
        solids: Sequence[shapely.Polygon] = (),
        wells: Sequence[shapely.Polygon] = (),
    ) -> None:
        self.bay, self.setback_m = bay, bay.column_size_m / 2
        self.stall_places = {}
        self._outline, self._lines, self._stalls = ground.polygon, ground.lines, tuple(stalls)
        self.solids, self._wells = tuple(solids), tuple(wells)
        self.mouths = shapely.union_all([shapely.MultiPoint(_with_front(stall)).convex_hull for stall in stalls])
        walls = self._outline.boundary
        standing = shapely.union_all(
            [walls, *solids, *wells, *(shapely.Polygon(stall.corners_m()) for stall in stalls)]
        )
        pieces = LanePieces(lanes, ground.lines, standing, self.setback_m)
        self.doors, self._beside, self._steps = pieces.doors, pieces.beside, pieces.steps
        found = {tile.square: tile for tile in pieces.tiles}
        self._opening: dict[tuple[Square, Edge], list[PlacedStall]] = defaultdict(list)
        found = self._with_mouths(found)
        rows = list(self._rows())
        self._rows_on = {tile.square: row for tile, row in rows}
        found |= {tile.square: tile for tile, _ in rows}
        found |= {tile.square: tile for tile in self._free(found.values(), len(rows))}
        self.tiles = found
        self._tree = shapely.STRtree([_ground(tile) for tile in found.values()])
        self._keys = list(found)

    def neighbour(self, tile: Tile, *edges: Edge) -> Tile | None:
        """Piece beyond one edge, or beyond a corner between two edges; None outside and where there is none."""
        if len(edges) == 1 and (tile.square, edges[0]) in self._beside:
            return self.tiles[self._beside[tile.square, edges[0]]]
        down, right = (sum(NEIGHBOUR_STEPS[edge][axis] for edge in edges) for axis in (0, 1))
        point = tile.at((right * (tile.half_x_m + _BEYOND_M), down * (tile.half_z_m + _BEYOND_M)))
        near = self._tree.query(shapely.Point(point), predicate="intersects").tolist()
        return self.tiles[self._keys[min(near)]] if near else None

    def is_bare(self, tile: Tile) -> bool:
        """True if a piece is free, and no stalls cover it."""
        return tile.cell is Cell.FREE and tile.square not in self._rows_on

    def openings(self, tile: Tile) -> tuple[Polygon, ...]:
        """Openings in the floor of a piece: the whole piece for a row of stalls, whose panels cover it."""
        if tile.square not in self._rows_on:
            return ()
        return (rectangle(-tile.half_x_m, -tile.half_z_m, tile.half_x_m, tile.half_z_m),)

    def row_along_x(self, tile: Tile) -> bool | None:
        """True for a row of stalls, which lies along its X; None for another piece."""
        return True if tile.square in self._rows_on else None

    def stalls_on(self, stalls: Iterable[PlacedStall]) -> dict[Square, list[PlacedStall]]:
        """Group stalls by the rows that they stand in."""
        names = {stall.name: square for square, row in self._rows_on.items() for stall in row}
        found: dict[Square, list[PlacedStall]] = {}
        for stall in stalls:
            found.setdefault(names[stall.name], []).append(stall)
        return found

    def opening_on(
        self,
        tile: Tile,
        edge: Edge,
        stalls_on: Mapping[Square, list[PlacedStall]],  # noqa: ARG002 - known of all stalls
    ) -> list[PlacedStall]:
        """Return the stalls that open onto a lane's piece over one of its edges."""
        return self._opening.get((tile.square, edge), [])

    @cached_property
    def ways(self) -> "nx.DiGraph[Square]":
        """The steps that cars may drive between the pieces of lanes and portals, with ``length_m``."""
        ways: nx.DiGraph[Square] = nx.DiGraph()
        ways.add_nodes_from(tile.square for tile in self if tile.cell is not Cell.FREE)
        for start, end, one_way in self._steps:
            length_m = math.dist(self.tiles[start].middle_m, self.tiles[end].middle_m)
            ways.add_edge(start, end, length_m=length_m)
            if not one_way:
                ways.add_edge(end, start, length_m=length_m)
        return ways

    @cached_property
    def one_way_stretches(self) -> list[list[Square]]:
        """The one-way stretches of lane between junctions, each as its pieces in the direction of driving."""
        lanes = {tile.square for tile in self if tile.cell is Cell.LANE}
        onward: dict[Square, list[Square]] = defaultdict(list)
        back: dict[Square, list[Square]] = defaultdict(list)
        for start, end, one_way in self._steps:
            if one_way and {start, end} <= lanes:
                onward[start].append(end)
                back[end].append(start)
        around = self.ways.to_undirected().subgraph(lanes)
        inner = {square for square in around if around.degree(square) == 2}  # noqa: PLR2004 - neither junction nor tip
        found = []
        for start in sorted(onward, reverse=True):
            if start in inner and back[start]:
                continue
            for first in onward[start]:
                stretch = [start, first]
                while stretch[-1] in inner and onward[stretch[-1]] and onward[stretch[-1]][0] not in stretch:
                    stretch.append(onward[stretch[-1]][0])
                found.append(stretch)
        return found

    @property
    def ground(self) -> shapely.Geometry:
        """The ground (x, z) inside the outline."""
        return self._outline

    def lane_at(self, point: Point) -> Tile | None:
        """Return the piece of lane that a point (x, z) lies on."""
        near = self._tree.query(shapely.Point(point), predicate="intersects").tolist()
        lanes = (self.tiles[self._keys[index]] for index in sorted(near))
        return next((tile for tile in lanes if tile.cell is Cell.LANE), None)

    def free_beside_lanes(self) -> Iterator[tuple[Tile, Edge, Tile]]:
        """Yield each free piece with an edge of it and the piece of lane beyond."""
        for tile in self:
            if self.is_bare(tile):
                for edge in Edge:
                    other = self.neighbour(tile, edge)
                    if other is not None and other.cell is Cell.LANE:
                        yield tile, edge, other

    def _with_mouths(self, found: Mapping[Square, Tile]) -> dict[Square, Tile]:
        """Return the pieces of lanes, as wide as the stalls beside them allow, with the edges that stalls open onto."""
        lanes = [tile for tile in found.values() if tile.cell is Cell.LANE]
        if not lanes:
            return dict(found)
        tree = shapely.STRtree([_ground(tile) for tile in lanes])
        half_m: dict[Square, dict[bool, float]] = defaultdict(dict)
        for stall in self._stalls:
            (left, right, *_), mouth = stall.corners_m(), _mouth(stall)
            # out of the mouth: a quarter turn from the way along it
            away_x, away_z = left[1] - right[1], right[0] - left[0]
            size = math.hypot(away_x, away_z)
            sign = 1 if (mouth[0] - stall.centre_m[0]) * away_x + (mouth[1] - stall.centre_m[1]) * away_z > 0 else -1
            ahead = sign * away_x / size, sign * away_z / size
            ray = shapely.LineString(
                [mouth, (mouth[0] + ahead[0] * _BEFORE_MOUTH_M, mouth[1] + ahead[1] * _BEFORE_MOUTH_M)]
            )
            met = tree.query(ray, predicate="intersects").tolist()
            if not met:
                continue
            start = shapely.Point(mouth)
            tile = lanes[min(met, key=lambda index: (round(tree.geometries[index].distance(start), 3), index))]
            edge = edge_towards(elementary.arctan2(ahead[1], -ahead[0]), tile.yaw_rad)
            if tile.drivable[edge] and tile.axis_is_x is not None:
                continue
            self._opening[tile.square, edge].append(stall)
            local = tile.local(mouth)
            far_m = abs(local[1] if edge.along_x else local[0])
            half = half_m[tile.square]
            half[edge.along_x] = min(half.get(edge.along_x, math.inf), far_m)
        return {square: self._fitted(tile, half_m.get(square, {})) for square, tile in found.items()}

    def _fitted(self, tile: Tile, half_m: Mapping[bool, float]) -> Tile:
        """Return a piece of lane, extended to the mouths of its stalls if they are near the carriageway."""
        up, down, left, right = (bool(self._opening.get((tile.square, edge))) for edge in Edge)
        sides_m = [tile.width_m, tile.depth_m]
        along_x = tile.axis_is_x
        half = None if along_x is None else half_m.get(along_x)
        if along_x is not None and half and half < tile.clear_m[int(along_x)] / 2 + _MOST_MARGIN_M:
            sides_m[int(along_x)] = round(2 * half, _DIGITS)
        mouths = up, down, left, right
        return replace(tile, stall_mouths=mouths, width_m=sides_m[0], depth_m=sides_m[1])

    def _rows(self) -> Iterator[tuple[Tile, list[PlacedStall]]]:
        """Yield the pieces of rows of stalls, with the stalls in each, as long as the pieces of lanes."""
        rows: nx.Graph[int] = nx.Graph()
        rows.add_nodes_from(range(len(self._stalls)))
        sides = [_sides(stall) for stall in self._stalls]
        middles = [(index, middle) for index, pair in enumerate(sides) for middle in pair]
        tree = shapely.STRtree(shapely.points([middle for _, middle in middles]))
        one, other = tree.query(tree.geometries, predicate="dwithin", distance=_TOUCH_M)
        for first, second in zip(one.tolist(), other.tolist(), strict=True):
            a, b = middles[first][0], middles[second][0]
            if a != b and abs(math.remainder(self._stalls[a].yaw_rad - self._stalls[b].yaw_rad, math.tau)) < _TOUCH_M:
                rows.add_edge(a, b)
        number = 0
        for members in sorted(map(sorted, nx.connected_components(rows))):
            frame = _free_tile((0, 0), (0.0, 0.0), (0.0, 0.0), _row_yaw_rad(self._stalls[members[0]]))
            local = {index: frame.local(self._stalls[index].centre_m)[0] for index in members}
            ordered = sorted(members, key=lambda index: (round(local[index], 3), index))
            whole = _row_tile([self._stalls[index] for index in ordered], frame, (_FREE, number))
            ends = whole.at((-whole.half_x_m, 0.0)), whole.at((whole.half_x_m, 0.0))
            fields: dict[int, list[PlacedStall]] = {}
            cuts = np.array(self._lines.cuts_m(*map(rounded, ends)))
            for index in ordered:
                at = whole.local(_mouth(self._stalls[index]))[0] + whole.half_x_m
                fields.setdefault(int(np.searchsorted(cuts, at)), []).append(self._stalls[index])
            for stalls in fields.values():
                yield _row_tile(stalls, frame, (_FREE, number)), stalls
                number += 1

    def _free(self, lanes: Iterable[Tile], count: int) -> Iterator[Tile]:
        """Yield rectangular pieces of the ground without lanes and stalls."""
        taken = [*self.solids, *self._wells, *(_ground(tile) for tile in lanes)]
        free = self._outline.difference(shapely.union_all(taken))
        half_m = _LEAST_FREE_M / 2
        open_ground = free.buffer(-half_m, join_style="mitre").buffer(half_m, join_style="mitre").intersection(free)
        for part in sorted(shapely.get_parts(open_ground), key=lambda ground: ground.bounds):
            for box in rectangles(part, _LEAST_SIDE_M):
                left, top, right, bottom = box.bounds
                columns = self._lines.cuts_m((left, top), (right, top))
                rows = self._lines.cuts_m((left, top), (left, bottom))
                for (z0, z1), (x0, x1) in product(pairwise(rows), pairwise(columns)):
                    if min(x1 - x0, z1 - z0) < _LEAST_SIDE_M:
                        continue
                    middle = left + (x0 + x1) / 2, top + (z0 + z1) / 2
                    yield _free_tile((_FREE, count), middle, (x1 - x0, z1 - z0))
                    count += 1


def _free_tile(square: Square, middle: Point, sides_m: Point, yaw_rad: float = 0.0) -> Tile:
    """Return a free piece by its middle (x, z) and its extent along its own axes."""
    (x, z), (width_m, depth_m) = rounded(middle), rounded(sides_m)
    nothing = (False, False, False, False)
    return Tile(square, Cell.FREE, x, z, width_m, depth_m, nothing, nothing, yaw_rad=yaw_rad)


def _row_yaw_rad(stall: PlacedStall) -> float:
    """Return the yaw of axes with X along the mouth of a stall, within a quarter turn."""
    left, right, *_ = stall.corners_m()
    yaw = math.remainder(elementary.arctan2(left[1] - right[1], right[0] - left[0]), math.pi)
    if abs(abs(yaw) - math.pi / 2) < AXIS_RAD:
        return math.pi / 2
    return 0.0 if abs(yaw) < AXIS_RAD else round(yaw, 9)


def _row_tile(stalls: Sequence[PlacedStall], frame: Tile, square: Square) -> Tile:
    """Return the piece of some stalls of a row along the X of a frame."""
    corners = np.array([frame.local(corner) for stall in stalls for corner in stall.corners_m()])
    low, high = corners.min(axis=0), corners.max(axis=0)
    middle = frame.at((float(low[0] + high[0]) / 2, float(low[1] + high[1]) / 2))
    return _free_tile(square, middle, (float(high[0] - low[0]), float(high[1] - low[1])), frame.yaw_rad)


def _ground(tile: Tile) -> shapely.Polygon:
    """Return the ground (x, z) of a piece."""
    x, z = tile.half_x_m, tile.half_z_m
    return shapely.Polygon([tile.at(corner) for corner in ((-x, -z), (x, -z), (x, z), (-x, z))])


def _mouth(stall: PlacedStall) -> Point:
    """Return the middle of the side over which cars enter a stall."""
    left, right, *_ = stall.corners_m()
    return (left[0] + right[0]) / 2, (left[1] + right[1]) / 2


def _with_front(stall: PlacedStall) -> list[Point]:
    """Return the corners of a stall with the ground before its mouth on which cars turn into it."""
    left, right, rear_right, rear_left = stall.corners_m()
    middle, (x, z) = _mouth(stall), stall.centre_m
    scale = _BEFORE_MOUTH_M / math.dist(middle, (x, z))
    ahead_x, ahead_z = (middle[0] - x) * scale, (middle[1] - z) * scale
    return [rear_left, rear_right, *((at[0] + ahead_x, at[1] + ahead_z) for at in (left, right))]


def _sides(stall: PlacedStall) -> tuple[Point, Point]:
    """Return the middles of the two sides of a stall that it has in common with its neighbours."""
    left, right, rear_right, rear_left = stall.corners_m()
    return (
        ((left[0] + rear_left[0]) / 2, (left[1] + rear_left[1]) / 2),
        ((right[0] + rear_right[0]) / 2, (right[1] + rear_right[1]) / 2),
    )
