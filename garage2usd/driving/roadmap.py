"""A roadmap of the lanes and ramps, and smooth paths over it between a stall and the portals, found by A*."""
# Over 300 lines: the poses and paths of the map are what its search goes over.

import heapq
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import count, pairwise
from typing import NamedTuple

import numpy as np

from garage2usd.driving.car import DesignCar, Pose
from garage2usd.driving.network import Network
from garage2usd.driving.obstacles import Obstacles
from garage2usd.driving.path import Path, Piece
from garage2usd.driving.proof import LanePose
from garage2usd.driving.road import DrivenRoad, Portal
from garage2usd.driving.turns import Steering, joining_pieces
from garage2usd.garage import Arc, LaneGraph, Point
from garage2usd.native import elementary

_MOST_EDGES, _MOST_SHORT_EDGES, _TURN_M = 4, 12, 15.0
"""Greatest number of lane edges that a path with two turns may span, and of short ones, up to the length of a turn."""
_SAME_WAY = 0.999
_ROOM_KEPT_M = 0.2
_ROOM_TO_TURN_M = 0.1
_BESIDE_M = 0.8
"""Greatest width of the rectangle of poses from which a car may turn; metres."""
_DOOR_SPOTS_M, _DOOR_SPOT_M = 12.0, 2.0
"""Length inside a door that has roadmap poses, and their spacing; metres."""
_DIGITS = 4
_FAR_COST = 8.0
"""How many times a metre over the middle counts further than a car's length from the turns of a lane."""
_ASIDE_COST_M, _EDGE_COST_M = 2.0, 3.0
"""Cost in metres of a spot off the lane's centre line, and of each further edge, so that paths keep to centre lines."""


Half = tuple[Point, Point, Point, Point, float]
"""Own half of a lane: direction, start, the runs between which it has a middle, the runs of the grounds beside them on
which cars turn, and offset of its line to the right."""


class Spot(NamedTuple):
    """A pose of the roadmap: the middle of a lane node, or a point beside it, in line with a lane edge.

    Attributes
    ----------
    node
        Number of the lane node.
    along
        Direction of driving, a unit vector (x, z).
    aside_m, ahead_m
        Offset from the middle to the right and ahead.
    """

    node: int
    along: Point
    aside_m: float = 0.0
    ahead_m: float = 0.0


@dataclass(frozen=True, slots=True)
class Grain:
    """Density of the roadmap's poses.

    Attributes
    ----------
    asides
        Lateral offsets of poses on a lane, as shares of the room beside a car.
    is_fine
        True to add poses between the middles of squares.
    most_aside_m
        Greatest lateral offset.
    """

    asides: tuple[float, ...]
    is_fine: bool
    most_aside_m: float = 1.2


GRAINS = (
    Grain((0.0,), is_fine=False),
    Grain((0.0, 1.0, -1.0), is_fine=True),
    Grain((0.0, 1.0, -1.0), is_fine=True, most_aside_m=2.4),
)
"""Coarse, fine and wide roadmap: middles of squares only, with lateral and intermediate poses, and with such as far to
the side as cars swing out that turn back into the next aisle."""


class Roadmap:
    """Poses on the lanes of a garage and smooth paths between them; results are cached.

    Parameters
    ----------
    road
        The garage.
    standing
        Obstacles.
    car
        The car.
    steerings
        Steerings of the car, the most comfortable first.
    margin_m
        Clearance kept around the car.
    """

    def __init__(
        self, road: DrivenRoad, standing: Obstacles, car: DesignCar, steerings: Sequence[Steering], margin_m: float
    ) -> None:
        self._lanes, self._keeps_left = road.garage.lanes, road.keeps_left
        self._standing, self._car, self.steerings, self._margin_m = standing, car, tuple(steerings), margin_m
        self._known: dict[tuple[Pose, Pose], tuple[Piece, ...] | None] = {}
        self.network = Network(self, road.portals)

    @property
    def lanes(self) -> LaneGraph:
        """The garage's lane graph."""
        return self._lanes

    def edges_at(self, pose: Pose, edges: Iterable[Arc]) -> list[Arc]:
        """Return the lane edges, of some given ones, that a car is on and in line with."""
        x, z = _middle(self._car, pose)
        found = []
        for edge in edges:
            one = self._lanes.nodes[edge[0]].position
            along, length = self._along[edge]
            run = (x - one[0]) * along[0] + (z - one[1]) * along[1]
            aside = abs((x - one[0]) * along[1] - (z - one[1]) * along[0])
            far = length + self._lanes.nodes[edge[1]].reach_m(along)
            same = -elementary.sin(pose.yaw_rad) * along[0] - elementary.cos(pose.yaw_rad) * along[1]
            if same > _SAME_WAY and aside <= self._lanes.arcs[edge].width_m / 2 and -0.01 <= run <= far:  # noqa: PLR2004
                found.append(edge)
        return found

    def roomy_poses(self, edges: Iterable[Arc], *, is_back: bool) -> list[LanePose]:
        """Return rectangles of poses on lane edges with room to turn before the edge's end, or after its start.

        Notes
        -----
        The room is that of the tightest quarter turn; an edge too short for it has no rectangle. The whole edge counts
        where traffic may continue straight, or arrive straight.
        """
        tangent_m = float(abs(self.steerings[-1].chords(np.array([math.pi / 2]))[0])) / math.sqrt(2) + _ROOM_TO_TURN_M
        used = self._lanes.arriving if is_back else self._lanes.leaving
        poses = []
        for edge in edges:
            along, length_m = self._along[edge]
            is_straight = any(self._along[next_][0] == along for next_ in self._joins[is_back][edge] if next_ in used)
            low, high = 0.0, length_m
            if not is_straight:
                low, high = (tangent_m, high) if is_back else (low, high - tangent_m)
            if high < low:
                continue
            x, z = self._lanes.nodes[edge[0]].position
            ahead = (low + high) / 2 + self._car.length_m / 2 - self._car.rear_overhang_m
            room = min(_BESIDE_M, self._lanes.arcs[edge].width_m - self._car.width_m)
            if room >= 0:
                yaw = elementary.arctan2(-along[0] + 0.0, -along[1] + 0.0)
                poses.append(LanePose((x + ahead * along[0], z + ahead * along[1]), yaw, high - low, room))
        return poses

    @cached_property
    def _along(self) -> dict[Arc, tuple[Point, float]]:
        """Direction and length of each lane edge."""
        along = {}
        for edge in self._lanes.arcs:
            (x, z), (to_x, to_z) = (self._lanes.nodes[number].position for number in edge)
            length = math.hypot(to_x - x, to_z - z)
            along[edge] = (round((to_x - x) / length, _DIGITS) + 0.0, round((to_z - z) / length, _DIGITS) + 0.0), length
        return along

    @cached_property
    def _joins(self) -> tuple[dict[Arc, tuple[Arc, ...]], ...]:
        """Successors and predecessors of each lane edge, without U-turns and routes through a portal."""
        entering: dict[int, list[Arc]] = {}
        leaving: dict[int, list[Arc]] = {}
        for edge in self._lanes.arcs:
            leaving.setdefault(edge[0], []).append(edge)
            entering.setdefault(edge[1], []).append(edge)
        lanes = {number for number, node in enumerate(self._lanes.nodes) if not node.is_portal}

        def beside(edge: Arc, square: int, others: dict[int, list[Arc]]) -> tuple[Arc, ...]:
            return tuple(other for other in others.get(square, ()) if set(other) != set(edge) and square in lanes)

        return (
            {edge: beside(edge, edge[1], leaving) for edge in self._lanes.arcs},
            {edge: beside(edge, edge[0], entering) for edge in self._lanes.arcs},
        )

    def walks(self, first: Arc, *, is_back: bool) -> Iterator[list[Arc]]:
        """Yield walks over a few lane edges that begin with one edge, or end with it in a backward search."""
        waiting = [[first]]
        while waiting:
            walk = waiting.pop()
            yield walk
            is_short = len(walk) < _MOST_SHORT_EDGES and sum(self._along[edge][1] for edge in walk) < _TURN_M
            if len(walk) < _MOST_EDGES or is_short:
                waiting += [[*walk, following] for following in self._joins[is_back][walk[-1]]]

    def is_straight(self, walk: Sequence[Arc]) -> bool:
        """Return True if a walk over lane edges has no turn."""
        return len({self._along[edge][0] for edge in walk}) == 1

    def spots(self, edge: Arc, grain: "Grain", *, is_back: bool) -> Iterator[tuple[Spot, Pose]]:
        """Yield the roadmap's poses on a lane edge and at its end, or at its start in a backward search."""
        room_m = min((self._lanes.arcs[edge].width_m - self._car.width_m) / 2 - _ROOM_KEPT_M, grain.most_aside_m)
        along, length_m = self._along[edge]
        for share in grain.asides:
            aside_m = round(share * max(room_m, 0.0), _DIGITS)
            yield self._placed(Spot(edge[0 if is_back else 1], along, aside_m))
            if grain.is_fine:
                yield self._placed(Spot(edge[0], along, aside_m, round(length_m / 2, _DIGITS)))

    def own_side_m(self, arc: Arc) -> float:
        """Return the offset, to the right of the middle, of a car's own half of a two-way lane; 0 on other lanes."""
        lane = self._lanes.arcs[arc]
        if lane.one_way or not has_room_for_two(lane.width_m, self._car):
            return 0.0
        return round((-1 if self._keeps_left else 1) * lane.width_m / 4, _DIGITS)

    @property
    def half_width_m(self) -> float:
        """Half of the car's width."""
        return self._car.width_m / 2

    def room_m(self, arc: Arc) -> float:
        """Return how far the middle of a car may be from that of a lane arc."""
        room_m = self._lanes.arcs[arc].width_m / 2 - self._car.width_m / 2 - _ROOM_KEPT_M
        return round(max(room_m, 0.0), _DIGITS)

    def own_side(self, arc: Arc, run_m: float) -> Pose:
        """Return the pose on the line of a lane arc at a distance from the arc's start."""
        return self._placed(Spot(arc[0], self._along[arc][0], self.own_side_m(arc), run_m))[1]

    def is_one_line(self, arc: Arc, other: Arc) -> bool:
        """Return True if the line of an arc and that of the next are one straight line."""
        return self._along[arc][0] == self._along[other][0] and self.own_side_m(arc) == self.own_side_m(other)

    def onward(self, arc: Arc) -> tuple[Arc, ...]:
        """Return the successors of a lane arc, without U-turns and routes through a portal."""
        return self._joins[0][arc]

    def length_m(self, arc: Arc) -> float:
        """Return the length of a lane arc."""
        return self._along[arc][1]

    def run_m(self, arc: Arc, pose: Pose) -> float:
        """Return the distance of a pose from the start of a lane arc, along it."""
        (x, z), (along_x, along_z) = self._lanes.nodes[arc[0]].position, self._along[arc][0]
        return (pose.x_m - x) * along_x + (pose.z_m - z) * along_z

    def sides(self, walk: Sequence[Arc]) -> "list[Half]":
        """Return the own halves of the two-way lanes of a walk."""
        halves = []
        for arc in walk:
            if arc in self._along and self.own_side_m(arc):
                along, length_m = self._along[arc]
                first_m, last_m = (self.turning_m(node, arc) for node in arc)
                ends = first_m, length_m - last_m
                turns = ends[0] if first_m else -math.inf, ends[1] if last_m else math.inf
                halves.append((along, self._lanes.nodes[arc[0]].position, ends, turns, self.own_side_m(arc)))
        return halves

    def over_middle_m(self, path: Path, halves: "Sequence[Half]") -> float:
        """Return the length of a path on which a car is beyond its own half, far from turns several times."""
        length_m = self._car.length_m
        rows = np.array(
            [
                (*along, *start, *ends, turns[0] + length_m, turns[1] - length_m, own)
                for along, start, ends, turns, own in halves
                if own
            ]
        )
        return path.over_middle_m(self._car, rows, far_cost=_FAR_COST) if len(rows) else 0.0

    def turning_m(self, node: int, arc: Arc) -> float:
        """Return the reach of the ground of a junction or bend along an arc, which has no middle to keep to; else 0."""
        along = self._along[arc][0]
        others = (self._along.get((node, other)) or self._along[other, node] for other in self._lanes.beside[node])
        is_straight = all(abs(way[0] * along[0] + way[1] * along[1]) > _SAME_WAY for way, _ in others)
        return 0.0 if is_straight else self._lanes.nodes[node].reach_m(along)

    def is_clear(self, path: Path) -> bool:
        """Return True if a path keeps the margin from all obstacles."""
        margin_m = self._margin_m
        return path.clearance_m(self._car, self._standing, most_m=margin_m) >= margin_m

    def door_spots(self, portal: Portal) -> Iterator[tuple[Spot, Pose]]:
        """Yield roadmap poses in line with the pose of cars outside a portal, up to the middle of its square."""
        x, z = self._lanes.nodes[portal.node].position
        along = -elementary.sin(portal.pose.yaw_rad), -elementary.cos(portal.pose.yaw_rad)
        length_m = (portal.pose.x_m - x) * along[0] + (portal.pose.z_m - z) * along[1]
        for ahead_m in np.arange(0.0, min(abs(length_m), _DOOR_SPOTS_M), _DOOR_SPOT_M).tolist():
            yield self._placed(Spot(portal.node, along, 0.0, math.copysign(ahead_m, length_m)))

    def _placed(self, spot: Spot) -> tuple[Spot, Pose]:
        x, z = self._lanes.nodes[spot.node].position
        (along_x, along_z), aside_m, ahead_m = spot.along, spot.aside_m, spot.ahead_m
        yaw = elementary.arctan2(-along_x + 0.0, -along_z + 0.0)
        return spot, Pose(x + aside_m * -along_z + ahead_m * along_x, z + aside_m * along_x + ahead_m * along_z, yaw)

    def edges_from(self, spot: Spot, *, is_back: bool) -> list[Arc]:
        """Return the lane edges in line with a spot that start there, or that end there in a backward search."""
        at = 1 if is_back and not spot.ahead_m else 0
        return [edge for edge, (along, _) in self._along.items() if edge[at] == spot.node and along == spot.along]

    def middle_m(self, node: int) -> Point:
        """Return (x, z) of the middle of a lane node."""
        return self._lanes.nodes[node].position

    def joined(self, start: Pose, end: Pose) -> tuple[Piece, ...] | None:
        """Return a collision-free path between two poses with at most two turns."""
        key = (start, end)
        if key not in self._known:
            self._known[key] = next(self._clear(start, end), None)
        return self._known[key]

    def _clear(self, start: Pose, end: Pose) -> Iterator[tuple[Piece, ...]]:
        for steering in self.steerings:
            for pieces in joining_pieces(start, end, steering):
                if pieces and self.is_clear(Path(start, pieces)):
                    yield pieces


def has_room_for_two(width_m: float, car: DesignCar) -> bool:
    """Return True if a two-way lane is wide enough for two cars side by side, each on its own half."""
    return width_m >= 2 * (car.width_m + 2 * _ROOM_KEPT_M)


def _middle(car: DesignCar, pose: Pose) -> Point:
    """Return (x, z) of the middle of a car's footprint."""
    ahead = car.length_m / 2 - car.rear_overhang_m
    return pose.x_m - elementary.sin(pose.yaw_rad) * ahead, pose.z_m - elementary.cos(pose.yaw_rad) * ahead


_Place = Spot | int | None
"""Node of the A* search: a spot, a portal by its square, or the start pose."""


def path_to_exit(roadmap: Roadmap, start: Pose, exits: Sequence[Portal], grain: Grain) -> tuple[Path, Portal] | None:
    """Return the shortest path found from a pose in line with a lane to the pose outside one of some exits."""
    edges = roadmap.edges_at(start, roadmap.lanes.leaving)
    return _Growth(roadmap, start, exits, grain, is_back=False).grown(edges)


def path_from_entrance(
    roadmap: Roadmap, end: Pose, entrances: Sequence[Portal], grain: Grain
) -> tuple[Path, Portal] | None:
    """Return the shortest path found from the pose outside one of some entrances to a pose in line with a lane."""
    edges = roadmap.edges_at(end, roadmap.lanes.arriving)
    return _Growth(roadmap, end, entrances, grain, is_back=True).grown(edges)


def path_between_portals(
    roadmap: Roadmap, entrance: Portal, exits: Sequence[Portal], grain: Grain
) -> tuple[Path, Portal] | None:
    """Return the shortest path found from the pose outside an entrance to the pose outside one of some exits."""
    edges = [(entrance.node, other) for other in roadmap.lanes.onward[entrance.node]]
    return _Growth(roadmap, entrance.pose, exits, grain, is_back=False).grown(edges, door=entrance)


@dataclass(order=True, slots=True)
class _Candidate:
    """A candidate edge in the queue of the A* search over lanes.

    Attributes
    ----------
    estimate_m
        Lower bound of the path from the root through the candidate to the nearest portal.
    number
        Sequence number.
    target, origin
        Places at its end and start.
    driven_m
        Length of the path up to its target.
    """

    estimate_m: float
    number: int
    target: "_Place" = field(compare=False)
    origin: "_Place" = field(compare=False)
    driven_m: float = field(compare=False)


class _Growth:
    """A* search between a pose at a stall and a portal; collisions are tested only when a node is expanded."""

    def __init__(self, roadmap: Roadmap, root: Pose, portals: Sequence[Portal], grain: Grain, *, is_back: bool) -> None:
        self._roadmap, self._grain, self._is_back = roadmap, grain, is_back
        self._portals = {portal.node: portal for portal in portals}
        self._poses: dict[_Place, Pose] = {None: root, **{portal.node: portal.pose for portal in portals}}
        self._done: dict[_Place, tuple[Piece, ...]] = {}
        self._waiting: list[_Candidate] = []
        self._numbers = count()

    def grown(self, edges: Sequence[Arc], *, door: Portal | None = None) -> tuple[Path, Portal] | None:
        """Run the search over some first edges; return the path and the portal at its end or start.

        A car that starts outside a door may turn as soon as it is in line with some place before the door's square.
        """
        if not self._portals:
            return None
        self._done[None] = ()
        self._grow_from(None, edges, 0.0)
        before = dict(self._roadmap.door_spots(door)) if door is not None else {}
        for spot, pose in before.items():
            self._poses[spot] = pose
            self._offer(spot, None, 0.0)
        while self._waiting:
            candidate = heapq.heappop(self._waiting)
            target = candidate.target
            pieces = None if target in self._done else self._pieces(candidate)
            if pieces is None:
                continue
            self._done[target] = pieces
            if isinstance(target, int):
                portal = self._portals[target]
                return Path(portal.pose if self._is_back else self._poses[None], pieces), portal
            if target is not None:
                if target.node in self._portals:
                    self._offer(target.node, target, candidate.driven_m)
                onward = edges if target in before else self._roadmap.edges_from(target, is_back=self._is_back)
                self._grow_from(target, onward, candidate.driven_m)
        return None

    def _pieces(self, candidate: _Candidate) -> tuple[Piece, ...] | None:
        """Return the path from the root to a candidate's target; None if its last part collides."""
        there = self._done[candidate.origin]
        ends = self._poses[candidate.origin], self._poses[candidate.target]
        pieces = self._roadmap.joined(*(reversed(ends) if self._is_back else ends))
        if pieces is None:
            return None
        return (*pieces, *there) if self._is_back else (*there, *pieces)

    def _grow_from(self, origin: "_Place", edges: Iterable[Arc], driven_m: float) -> None:
        usual = 2 if origin is None else 1
        for first in edges:
            for walk in self._roadmap.walks(first, is_back=self._is_back):
                over_m = driven_m + _EDGE_COST_M * max(len(walk) - usual, 0)
                places = list(self._roadmap.spots(walk[-1], self._grain, is_back=self._is_back))
                portal = walk[-1][0 if self._is_back else 1]
                if portal in self._portals:
                    # prefer to drive straight through the door, over a spot in line with it
                    self._offer(portal, origin, over_m + _EDGE_COST_M, walk[:-1])
                    places += self._roadmap.door_spots(self._portals[portal])
                # short straights between spots make up this long one
                if origin is not None and len(walk) > 1 and self._roadmap.is_straight(walk):
                    continue
                for spot, pose in places:
                    self._poses.setdefault(spot, pose)
                    self._offer(spot, origin, over_m, walk[:-1])

    def _offer(self, target: "_Place", origin: "_Place", driven_m: float, over: Sequence[Arc] = ()) -> None:
        """Queue a candidate path to a target over lane edges that are driven in full."""
        if target in self._done:
            return
        driven_m += max(_apart_m(self._poses[origin], self._poses[target]), self._over_m(origin, target, over))
        driven_m += _ASIDE_COST_M if isinstance(target, Spot) and target.aside_m else 0.0
        estimate_m = driven_m + self._left_m(target)
        heapq.heappush(self._waiting, _Candidate(estimate_m, next(self._numbers), target, origin, driven_m))

    def _over_m(self, origin: "_Place", target: "_Place", over: Sequence[Arc]) -> float:
        """Return the length along the lanes' centre lines, from turn to turn."""
        turns = [self._roadmap.middle_m(edge[0 if self._is_back else 1]) for edge in over]
        ends = [(pose.x_m, pose.z_m) for pose in (self._poses[origin], self._poses[target])]
        return sum(math.dist(one, other) for one, other in pairwise([ends[0], *turns, ends[1]]))

    def _left_m(self, place: "_Place") -> float:
        return min(_apart_m(self._poses[place], portal.pose) for portal in self._portals.values())


def _apart_m(one: Pose, other: Pose) -> float:
    return math.hypot(other.x_m - one.x_m, other.z_m - one.z_m)
