"""The lanes of a surveyed floor, cut into pieces: junctions, bends, portals, and the stretches between them."""

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.garage import LaneEdge, LaneGraph, LaneKind, Point
from garage2usd.layout.surveyed.ground import StructuralLines
from garage2usd.layout.tiles import Tile
from garage2usd.native import elementary
from garage2usd.structure.grid import Cell
from garage2usd.structure.lane_graph import Square
from garage2usd.structure.stalls import Edge

Floats = NDArray[np.float64]
_LEAST_PIECE_M = 0.5
_STRAIGHT_RAD = math.radians(3.0)
"""Turn up to which a lane goes straight on."""
AXIS_RAD = math.radians(0.2)
"""Turn from the axes of the garage up to which a piece lies along them."""
_BEYOND_TIP_M = 1.2
"""Greatest distance to a wall or stalls ahead of a dead end, beyond half its width, up to which it is driven."""
_LANES = -1
"""First number of the pairs by which pieces are known: no (row, col) of a tile."""
_TURNS_RAD = {Edge.RIGHT: 0.0, Edge.UP: math.pi / 2, Edge.LEFT: math.pi, Edge.DOWN: -math.pi / 2}
"""Turn of the way over each edge of a piece from its +X, by quarters."""
_DIGITS = 6


class _Joint(NamedTuple):
    """A junction, bend or portal: its node, its axes' turn, its extent along them, and the node beyond each edge."""

    node: int
    yaw_rad: float
    sides_m: tuple[float, float]
    beyond: dict[Edge, int]


class LanePieces:
    """The pieces of the lanes of a surveyed garage.

    Parameters
    ----------
    lanes
        The lane graph.
    lines
        The lines of columns, at which lanes are cut.
    standing
        Walls and stalls, up to which dead ends are driven.
    setback_m
        Clearance on both sides of a carriageway that belongs to its lane.

    Attributes
    ----------
    tiles
        The pieces.
    doors
        Edge of the vehicle door of each portal.
    beside
        The piece beyond each edge that cars cross.
    steps
        Adjacent pieces in the direction of driving, and whether it is the only one.
    """

    def __init__(self, lanes: LaneGraph, lines: StructuralLines, standing: shapely.Geometry, setback_m: float) -> None:
        self._lanes, self._lines, self._standing, self._setback_m = lanes, lines, standing, setback_m
        self.doors: dict[Square, Edge] = {}
        self.beside: dict[tuple[Square, Edge], Square] = {}
        self.steps: list[tuple[Square, Square, bool]] = []
        self.tiles = tuple(self._cut_lanes())

    def _cut_lanes(self) -> Iterator[Tile]:
        """Yield the pieces of junctions, bends and portals, and those of the lanes between them."""
        joints = {node: self._joint(node) for node in range(len(self._lanes.nodes)) if self._is_joint(node)}
        square_of = {node: (_LANES, number) for number, node in enumerate(joints)}
        for node, joint in joints.items():
            yield self._joint_tile(joint, square_of[node])
        count = len(joints)
        for joint in joints.values():
            for edge, node in joint.beyond.items():
                way = self._way_from(joint.node, node, joints)
                end = joints.get(way[-1])
                back = [] if end is None else [turn for turn, at in end.beyond.items() if at == way[-2]]
                if end is not None and back and (end.node, way[-2]) < (joint.node, way[1]):
                    continue  # the stretch is cut from its other end
                pieces = list(self._cut(way, joint, end, count))
                count += len(pieces)
                yield from pieces
                chain = [square_of[joint.node], *(piece.square for piece in pieces)]
                chain += [square_of[end.node]] if end is not None else []
                turns = [edge, *(turn for piece in pieces for turn in _ends_of(piece, way, self._lanes))]
                turns += back
                self._join(chain, turns, way)

    def _is_joint(self, node: int) -> bool:
        beside = self._lanes.beside[node]
        if self._lanes.nodes[node].is_portal or len(beside) > 2:  # noqa: PLR2004 - a junction
            return True
        if len(beside) != 2:  # noqa: PLR2004 - a tip
            return not beside
        one, other = (self._heading_rad(node, end) for end in beside)
        return abs(math.remainder(one - other - math.pi, math.tau)) > _STRAIGHT_RAD

    def _edge(self, one: int, other: int) -> LaneEdge:
        """Return the edge between two adjacent nodes."""
        return self._lanes.arcs.get((one, other)) or self._lanes.arcs[other, one]

    def _heading_rad(self, start: int, end: int) -> float:
        """Return the yaw that turns +X towards another node."""
        (x0, z0), (x1, z1) = (self._lanes.nodes[node].position for node in (start, end))
        return elementary.arctan2(z0 - z1, x1 - x0)

    def _width_m(self, one: int, other: int) -> float:
        """Return the extent of a lane across its direction, with the clearance of columns on both sides."""
        return self._edge(one, other).width_m + 2 * self._setback_m

    def _joint(self, node: int) -> _Joint:
        beside = self._lanes.beside[node]
        lane = self._lanes.nodes[node]
        if not beside:
            return _Joint(node, 0.0, lane.sides_m or lane.widths_m, {})
        main = max(beside, key=lambda other: (round(self._width_m(node, other), 3), -other))
        yaw = _axis_yaw_rad(self._heading_rad(node, main))
        beyond: dict[Edge, int] = {}
        off = [
            (round(abs(math.remainder(self._heading_rad(node, other) - yaw - turn, math.tau)), 6), number, edge)
            for number, other in enumerate(beside)
            for edge, turn in _TURNS_RAD.items()
        ]
        joined: set[int] = set()
        # assign each lane to the edge that it crosses most directly; beyond four lanes, the others end beside the piece
        for _, number, edge in sorted(off):
            if edge not in beyond and number not in joined:
                beyond[edge] = beside[number]
                joined.add(number)
        if lane.is_portal:
            along_m = (lane.sides_m or lane.widths_m)[0]
            across_m = max(along_m, self._width_m(node, main))
            is_along_x = not next(iter(beyond)).along_x
            return _Joint(node, yaw, (along_m, across_m) if is_along_x else (across_m, along_m), beyond)
        along_x = [self._width_m(node, other) for edge, other in beyond.items() if not edge.along_x]
        along_z = [self._width_m(node, other) for edge, other in beyond.items() if edge.along_x]
        widest = max([*along_x, *along_z])
        return _Joint(node, yaw, (max(along_z, default=widest), max(along_x, default=widest)), beyond)

    def _joint_tile(self, joint: _Joint, square: Square) -> Tile:
        lane = self._lanes.nodes[joint.node]
        kind = LaneKind(lane.kind) if lane.kind in set(LaneKind) else LaneKind.STRAIGHT
        cell = {LaneKind.ENTRANCE: Cell.ENTRANCE, LaneKind.EXIT: Cell.EXIT}.get(kind, Cell.LANE)
        up, down, left, right = (edge in joint.beyond for edge in Edge)
        width_m, depth_m = joint.sides_m
        if cell is not Cell.LANE and joint.beyond:
            self.doors[square] = next(iter(joint.beyond)).opposite
        return Tile(
            square=square,
            cell=cell,
            x_m=lane.position[0],
            z_m=lane.position[1],
            width_m=round(width_m, _DIGITS),
            depth_m=round(depth_m, _DIGITS),
            drivable=(up, down, left, right),
            stall_mouths=(False, False, False, False),
            kind=kind,
            clear_m=(width_m - 2 * self._setback_m, depth_m - 2 * self._setback_m),
            yaw_rad=joint.yaw_rad,
        )

    def _way_from(self, start: int, onward: int, joints: Mapping[int, _Joint]) -> list[int]:
        """Return the nodes of a lane from a joint to the next one, or to its tip."""
        way = [start, onward]
        while way[-1] not in joints:
            others = [node for node in self._lanes.beside[way[-1]] if node != way[-2]]
            if not others:
                break
            way.append(others[0])
        return way

    def _cut(self, way: Sequence[int], start: _Joint, end: _Joint | None, count: int) -> Iterator[Tile]:
        """Yield the pieces of a lane between two joints, of equal length on each straight stretch."""
        line = np.array([self._lanes.nodes[node].position for node in way])
        if end is None:
            line[-1] += self._beyond_tip(line[-2], line[-1], self._width_m(*way[-2:]))
        lengths = np.linalg.norm(np.diff(line, axis=0), axis=1)
        runs = np.concatenate([[0.0], np.cumsum(lengths)])
        first = _reach_m(start, line[1] - line[0])
        last = runs[-1] - (_reach_m(end, line[-2] - line[-1]) if end is not None else 0.0)
        along = shapely.LineString(line)
        bounds = [first, *self._bends(line, runs, first, last), last]
        for low, high in pairwise(bounds):
            if high - low < _LEAST_PIECE_M:
                continue
            ends = (along.interpolate(low).coords[0], along.interpolate(high).coords[0])
            for near, far in pairwise(self._lines.cuts_m(*ends)):
                at = low + (near + far) / 2
                number = min(int(np.searchsorted(runs, at, side="right")) - 1, len(lengths) - 1)
                middle = along.interpolate(at).coords[0]
                yield self._piece((way[number], way[number + 1]), middle, far - near, (_LANES, count))
                count += 1

    def _beyond_tip(self, before: Floats, tip: Floats, width_m: float) -> Floats:
        """Return the vector from the tip of a lane to the wall or stalls ahead, else half of the lane's width."""
        ahead = (tip - before) / np.linalg.norm(tip - before)
        aside = ahead[::-1] * (1.0, -1.0) * (width_m / 2 - self._setback_m)
        reach_m = width_m / 2 + _BEYOND_TIP_M
        rays = shapely.linestrings([[tip + side, tip + side + reach_m * ahead] for side in (-aside, 0 * aside, aside)])
        stopped = [
            shapely.distance(shapely.Point(ray.coords[0]), met)
            for ray in rays
            if not (met := shapely.intersection(ray, self._standing)).is_empty
        ]
        beyond: Floats = ahead * min([*stopped, *([width_m / 2] if not stopped else [])])
        return beyond

    def _bends(self, line: Floats, runs: Floats, first: float, last: float) -> list[float]:
        """Return the distances along a line at which its direction has changed enough to begin a new stretch."""
        found: list[float] = []
        steps = np.diff(line, axis=0)
        headings = [elementary.arctan2(-z, x) for x, z in steps.tolist()]
        base = headings[0]
        for number, heading in enumerate(headings[1:], start=1):
            if abs(math.remainder(heading - base, math.tau)) > _STRAIGHT_RAD and first < runs[number] < last:
                found.append(float(runs[number]))
                base = heading
        return found

    def _piece(self, step: tuple[int, int], middle: Point, length_m: float, square: Square) -> Tile:
        heading = self._heading_rad(*step)
        yaw = _axis_yaw_rad(heading)
        along_x = not edge_towards(heading, yaw).along_x
        width_m = self._width_m(*step)
        edge = self._edge(*step)
        sides = (length_m, width_m) if along_x else (width_m, length_m)
        ahead = edge_towards(self._heading_rad(edge.start, edge.end), yaw)
        return Tile(
            square=square,
            cell=Cell.LANE,
            x_m=round(middle[0], _DIGITS),
            z_m=round(middle[1], _DIGITS),
            width_m=round(sides[0], _DIGITS),
            depth_m=round(sides[1], _DIGITS),
            drivable=(not along_x, not along_x, along_x, along_x),
            stall_mouths=(False, False, False, False),
            way=ahead if edge.one_way else None,
            kind=LaneKind.STRAIGHT,
            clear_m=(sides[0] - 2 * self._setback_m, sides[1] - 2 * self._setback_m),
            yaw_rad=yaw,
        )

    def _join(self, chain: Sequence[Square], turns: Sequence[Edge], way: Sequence[int]) -> None:
        """Record the sequence of the pieces of a lane, the edges between them, and the direction of driving."""
        edge = self._edge(way[0], way[1])
        for number, (one, other) in enumerate(pairwise(chain)):
            self.beside[one, turns[2 * number]] = other
            if 2 * number + 1 < len(turns):
                self.beside[other, turns[2 * number + 1]] = one
            self.steps.append((one, other, edge.one_way) if edge.start == way[0] else (other, one, edge.one_way))


def _axis_yaw_rad(heading_rad: float) -> float:
    """Return the yaw of axes along a heading, within an eighth of a turn; 0 along the axes of the garage."""
    yaw = math.remainder(heading_rad, math.pi / 2)
    return 0.0 if abs(yaw) < AXIS_RAD else round(yaw, 9)


def edge_towards(heading_rad: float, yaw_rad: float) -> Edge:
    """Return the edge of a piece with a yaw that lies towards a heading."""
    turned = math.remainder(heading_rad - yaw_rad, math.tau)
    return tuple(_TURNS_RAD)[round(turned / (math.pi / 2)) % 4]


def _ends_of(piece: Tile, way: Sequence[int], lanes: LaneGraph) -> tuple[Edge, Edge]:
    """Return the edges of a piece of lane towards the start and the end of the stretch."""
    line = shapely.LineString([lanes.nodes[node].position for node in way])
    at = line.project(shapely.Point(piece.middle_m))
    before, after = line.interpolate(max(at - 1.0, 0.0)), line.interpolate(at + 1.0)
    ahead = edge_towards(elementary.arctan2(before.y - after.y, after.x - before.x), piece.yaw_rad)
    if not piece.drivable[ahead]:
        ahead = next(edge for edge in Edge if piece.drivable[edge])
    return ahead.opposite, ahead


def _reach_m(joint: _Joint, away: Floats) -> float:
    """Return the distance from a joint's middle to the edge of its piece towards a way."""
    edge = edge_towards(elementary.arctan2(-float(away[1]), float(away[0])), joint.yaw_rad)
    return joint.sides_m[int(edge.along_x)] / 2
