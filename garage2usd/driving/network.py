"""Connecting paths over the lanes, each on its own side of the road: found once for a garage and a car, then reused.

A two-way lane with room for two cars has one line per direction, in the middle of that direction's half; any other has
one line in its middle. Turns lead from line to line. A tree of shortest paths from the entrances, or to the exits,
grows as far as drives need it; a drive adds the way between a line and the start of its manoeuvre.
"""
# Over 300 lines: the turns, and the trees of paths that are made of them.

import heapq
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import chain, count, product
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from garage2usd.driving.car import Pose
from garage2usd.driving.manoeuvre import Gear
from garage2usd.driving.path import Path, Piece
from garage2usd.driving.road import Portal
from garage2usd.driving.turns import Steering, joining_pieces
from garage2usd.garage import Arc, LaneKind
from garage2usd.native import elementary

if TYPE_CHECKING:
    from garage2usd.driving.roadmap import Half, Roadmap

_OUTSIDE = -1
"""Stands for the outer end of a door's arc, which is no lane node."""
_BESIDE_NODE_M = tuple(np.arange(0.0, 10.5, 1.0).tolist())
"""Distances before a node at which a turn may begin, and after it at which it may end; metres."""
_HALF_STEPS_M = tuple(np.arange(0.0, 10.1, 0.5).tolist())
"""Such distances of a lane before or after a short line and a door."""
_SLIGHT_RAD, _SLIGHT_M = math.radians(20.0), (0.0, 1.0, 2.0, 4.0, 7.0)
"""Greatest angle of a slight bend, and such distances for it."""
_SHORT_M = 14.0
"""Greatest length of a line that may be too short for a turn at each of its ends."""
_MOST_TESTS = 1000
"""Greatest number of ways of a turn that are tested for collisions."""
_MOST_ARCS = 4
"""Greatest number of arcs between a line and the start of a manoeuvre."""
_CHANGES_M = tuple(np.arange(2.5, 16.0, 0.5).tolist())
"""Distances over which a car may change to another line, or between a line and the start of its manoeuvre; metres."""
_BESIDE_MIDDLE_M, _SWINGS_M = (0.1, -0.25, -0.6), (-0.3, 0.0, 0.2)
"""Gaps between a car and the middle of its lane before any turn, and before one that leads back to a line; metres."""
_SWUNG_M, _SWUNG_BACK_M, _DOOR_M = (
    tuple(np.arange(*each).tolist()) for each in ((3.0, 8.1, 0.75), (5.0, 12.1, 1.0), (0.0, 8.1, 2.0))
)
"""Distances from a node at which such a turn is beside its line and on the other line, of lane or door."""
_DOOR_ROOM_M = 1.0
"""Greatest offset from the middle of a door within which a car turns; metres."""
_MORE_COST_M = 200.0
"""How much more a further way of a turn may cost than the first that is clear, for the room that it saves; metres."""
_OVER_COST = 3.0
"""Cost of a metre over the middle of a two-way lane, in metres driven."""
_QUARTER, _SAME, _DIGITS = math.pi / 2, 1e-9, 9


class Stop(NamedTuple):
    """A pose on the line of an arc, of the lanes or through a door, at a distance from the line's start."""

    arc: Arc
    run_m: float


class _Turn(NamedTuple):
    """A clear turn from the line of an arc to that of the next, or of arcs in line with them."""

    start: Stop
    end: Stop
    pieces: tuple[Piece, ...]
    cost_m: float


class _Shape(NamedTuple):
    """A turn as seen from a node: distances before and after the node, cost beyond these distances, and pieces."""

    gain_m: float
    before_m: float
    after_m: float
    cost_m: float
    pieces: tuple[Piece, ...]


class _Swing(NamedTuple):
    """A pose beside a line, the way between it and a stop on the line, and how far off the stop is from a node.

    `saved_m` is that distance less the length of the way.
    """

    stop: Stop
    pose: Pose
    pieces: tuple[Piece, ...]
    away_m: float
    saved_m: float


class _Side(NamedTuple):
    """A line at a node.

    Attributes
    ----------
    own_m, room_m
        Offset to the right of the lane's middle, and the greatest one to either side.
    reach_m
        Reach of the node's ground along it.
    far_m
        Length of a door's line.
    is_door
        True if it leads through a door.
    """

    own_m: float
    room_m: float
    reach_m: float
    far_m: float
    is_door: bool


class _LastWay(NamedTuple):
    """A way between a pose on the line of an arc and the start of a manoeuvre, over some arcs in order of driving."""

    run_m: float
    pose: Pose
    walk: tuple[Arc, ...]


class _Link(NamedTuple):
    """A way between two stops, or, with a last way, to the start of a manoeuvre; its order is that of a queue.

    Attributes
    ----------
    cost_m
        Cost from the root up to its end: at least, or exactly once it has pieces.
    number
        Sequence number.
    origin, target
        Its ends in the order of the search; None before a root and at the start of a manoeuvre.
    pieces
        Its pieces in the order of driving.
    last
        The last way.
    """

    cost_m: float
    number: int
    origin: Stop | None
    target: Stop | None
    pieces: tuple[Piece, ...] | None
    last: _LastWay | None = None


class Network:
    """The lines of the lanes, and the turns between them.

    Parameters
    ----------
    roadmap
        Roadmap of the garage, for its lanes and the collision tests.
    portals
        Entrances and exits.
    """

    def __init__(self, roadmap: "Roadmap", portals: Sequence[Portal]) -> None:
        self.roadmap = roadmap
        self._portals = {portal.node: portal for portal in portals}
        self._trees: dict[tuple[int, ...], _Tree] = {}
        self._shapes: dict[tuple[float, _Side, _Side, bool], list[_Shape]] = {}
        self._known: dict[tuple[Arc, Arc], list[_Turn]] = {}
        self._singles: dict[tuple[Arc, Arc], list[_Turn]] = {}
        self._clear: dict[tuple[Arc, float, float], bool] = {}

    def led(self, pose: Pose, portals: Sequence[Portal], *, is_back: bool) -> tuple[Path, Portal] | None:
        """Return the path from a pose in line with a lane to one of some exits, or from one of some entrances to it."""
        lanes = self.roadmap.lanes
        edges = self.roadmap.edges_at(pose, lanes.arriving if is_back else lanes.leaving)
        wanted: dict[Arc, list[_LastWay]] = {}
        for edge in edges:
            for arc, way in self._last_ways(pose, edge, is_back=is_back):
                wanted.setdefault(arc, []).append(way)
        return self._tree(portals, is_forward=is_back).led(wanted, pose)

    def through(self, entrance: Portal, exits: Sequence[Portal]) -> tuple[Path, Portal] | None:
        """Return the path from outside an entrance to outside one of some exits."""
        return self._tree([entrance], is_forward=True).led_to({self._outside(portal): portal for portal in exits})

    def _tree(self, portals: Sequence[Portal], *, is_forward: bool) -> "_Tree":
        key = tuple(portal.node for portal in portals)
        if key not in self._trees:
            roots = {self._outside(portal): portal for portal in portals}
            self._trees[key] = _Tree(self, roots, is_forward=is_forward)
        return self._trees[key]

    def _outside(self, portal: Portal) -> Stop:
        """Return the stop outside a portal, where drives begin or end."""
        if portal.kind is LaneKind.ENTRANCE:
            return Stop((_OUTSIDE, portal.node), 0.0)
        arc = portal.node, _OUTSIDE
        return Stop(arc, self.length_m(arc))

    def length_m(self, arc: Arc) -> float:
        """Return the length of an arc; of a door's, between the node's middle and the pose outside."""
        if _OUTSIDE not in arc:
            return self.roadmap.length_m(arc)
        portal = self._portals[max(arc)]
        (x, z), pose = self.roadmap.middle_m(portal.node), portal.pose
        ahead_m = (x - pose.x_m) * elementary.sin(pose.yaw_rad) + (z - pose.z_m) * elementary.cos(pose.yaw_rad)
        return round(-ahead_m if portal.kind is LaneKind.ENTRANCE else ahead_m, _DIGITS)

    def pose(self, stop: Stop) -> Pose:
        """Return the pose of a stop."""
        if _OUTSIDE not in stop.arc:
            return self.roadmap.own_side(*stop)
        portal = self._portals[max(stop.arc)]
        moved_m = stop.run_m - (0.0 if portal.kind is LaneKind.ENTRANCE else self.length_m(stop.arc))
        return portal.pose.moved(moved_m) if moved_m else portal.pose

    @cached_property
    def onward(self) -> dict[Arc, list[Arc]]:
        """Successors of each arc."""
        lanes = self.roadmap.lanes
        onward = {arc: list(self.roadmap.onward(arc)) for arc in lanes.arcs}
        for node, portal in self._portals.items():
            if portal.kind is LaneKind.ENTRANCE:
                onward[_OUTSIDE, node] = [(node, other) for other in lanes.onward[node]]
            else:
                onward[node, _OUTSIDE] = []
                for arc in lanes.arcs:
                    if arc[1] == node:
                        onward[arc].append((node, _OUTSIDE))
        return onward

    @cached_property
    def backward(self) -> dict[Arc, list[Arc]]:
        """Predecessors of each arc."""
        backward: dict[Arc, list[Arc]] = {arc: [] for arc in self.onward}
        for arc, others in self.onward.items():
            for other in others:
                backward[other].append(arc)
        return backward

    def _beyond(self, arc: Arc, *, is_forward: bool) -> Arc | None:
        """Return the arc after, or before, another on whose line that one's line goes on."""
        others = (self.onward if is_forward else self.backward)[arc]
        if _OUTSIDE in arc:
            return None
        lines = (other for other in others if _OUTSIDE not in other and self.roadmap.is_one_line(arc, other))
        return next(lines, None)

    def _line(self, arc: Arc, *, is_forward: bool) -> Iterator[tuple[Arc, float]]:
        """Yield an arc and those that its line goes on over, within reach of a turn, and how far off each begins."""
        away_m, at = 0.0, arc
        while True:
            yield at, away_m
            away_m += self.length_m(at)
            other = self._beyond(at, is_forward=is_forward)
            if other is None or away_m >= _BESIDE_NODE_M[-1]:
                return
            at = other

    def _turns(self, arc: Arc, other: Arc) -> list[_Turn]:
        """Return the clear turns from the line of an arc to that of the next."""
        if (arc, other) not in self._known:
            self._known[arc, other] = [*self._single_turns(arc, other), *self._double_turns(arc, other)]
        return self._known[arc, other]

    def _single_turns(self, arc: Arc, other: Arc) -> list[_Turn]:
        if (arc, other) not in self._singles:
            self._singles[arc, other] = list(self._found_turns(arc, other))
        return self._singles[arc, other]

    def _found_turns(self, arc: Arc, other: Arc) -> Iterator[_Turn]:
        before = list(self._line(arc, is_forward=False))
        after = list(self._line(other, is_forward=True))
        for is_plain in (True, False):
            kept: list[_Shape] = []
            tests = 0
            for shape in self._shaped(arc, other, is_plain=is_plain):
                start = self._stop_at(before, shape.before_m, is_forward=False)
                end = self._stop_at(after, shape.after_m, is_forward=True)
                is_worse = any(one.before_m <= shape.before_m and one.after_m <= shape.after_m for one in kept)
                if is_worse or start is None or end is None:
                    continue
                if kept and shape.gain_m > kept[0].gain_m + _MORE_COST_M:
                    break
                tests += 1
                if self.roadmap.is_clear(Path(self.pose(start), shape.pieces)):
                    kept.append(shape)
                    yield _Turn(start, end, shape.pieces, shape.cost_m)
                if tests >= _MOST_TESTS:
                    break
            if kept:
                return

    def _double_turns(self, arc: Arc, short: Arc) -> Iterator[_Turn]:
        """Yield clear turns from an arc's line over the next line, too short for a turn at each end, to another."""
        over: list[tuple[Arc, float]] = []
        for last, away_m in () if _OUTSIDE in short else self._line(short, is_forward=True):
            if away_m + self.length_m(last) > _SHORT_M:
                return
            over.append((last, away_m))
            for other in self.onward[last]:
                if other != self._beyond(last, is_forward=True) and not self._is_chained(arc, over, other):
                    is_fine = _OUTSIDE in arc or _OUTSIDE in other
                    starts = list(self._swung(arc, arc[1], is_forward=False, is_fine=is_fine))
                    ends = list(self._swung(other, other[0], is_forward=True, is_fine=is_fine))
                    lines = [*self._line(arc, is_forward=False), *over, *self._line(other, is_forward=True)]
                    yield from self._best_turns(starts, ends, self.roadmap.sides([each for each, _ in lines]))

    def _best_turns(
        self, starts: "Sequence[_Swing]", ends: "Sequence[_Swing]", sides: "Sequence[Half]"
    ) -> Iterator[_Turn]:
        """Yield the clear turns between some poses by cost, each with less room before or after it than those of less.

        A cost is that of the distance at first, then of the way, then of the way with its share over the middle.
        """
        numbers = count()
        waiting: list[tuple[float, int, _Swing, _Swing, tuple[Piece, ...], bool]] = []
        for start, end in product(starts, ends):
            apart_m = math.hypot(end.pose.x_m - start.pose.x_m, end.pose.z_m - start.pose.z_m)
            waiting.append((apart_m - start.saved_m - end.saved_m, next(numbers), start, end, (), False))
        heapq.heapify(waiting)
        kept: list[_Turn] = []
        rooms: list[tuple[float, float]] = []
        while waiting and (not kept or waiting[0][0] <= kept[0].cost_m - sum(rooms[0]) + _MORE_COST_M):
            gain_m, _, start, end, pieces, is_known = heapq.heappop(waiting)
            if any(one <= start.away_m and two <= end.away_m for one, two in rooms):
                continue
            if not pieces:
                pieces = next(joining_pieces(start.pose, end.pose, self.roadmap.steerings[-1]), ())
                gain_m = sum(piece.length_m for piece in pieces) - start.saved_m - end.saved_m
                if pieces:
                    heapq.heappush(waiting, (gain_m, next(numbers), start, end, pieces, False))
                continue
            path = Path(self.pose(start.stop), (*start.pieces, *pieces, *end.pieces))
            if not is_known:
                gain_m += _OVER_COST * self.roadmap.over_middle_m(path, sides)
                heapq.heappush(waiting, (gain_m, next(numbers), start, end, pieces, True))
            elif self.roadmap.is_clear(path):
                rooms.append((start.away_m, end.away_m))
                kept.append(_Turn(start.stop, end.stop, path.pieces, gain_m + sum(rooms[-1])))
                yield kept[-1]

    def _is_chained(self, arc: Arc, over: Sequence[tuple[Arc, float]], other: Arc) -> bool:
        """Return True if a turn to a short line between lanes ends before one from it begins."""
        if _OUTSIDE in arc or _OUTSIDE in other:
            return False
        away_m = dict(over)
        ends = [turn.end for turn in self._single_turns(arc, over[0][0]) if turn.end.arc in away_m]
        starts = [turn.start for turn in self._single_turns(over[-1][0], other) if turn.start.arc in away_m]
        runs_m = [[away_m[stop.arc] + stop.run_m for stop in stops] for stops in (ends, starts)]
        return all(runs_m) and min(runs_m[0]) <= max(runs_m[1])

    def _swung(self, arc: Arc, node: int, *, is_forward: bool, is_fine: bool) -> "Iterator[_Swing]":
        """Yield poses on and beside the line of an arc near its node, with the changes of line between."""
        side, steering = self._side(arc, node), self.roadmap.steerings[-1]
        steps_m = _HALF_STEPS_M if is_fine and not side.is_door else _BESIDE_NODE_M[::2]
        line = list(self._line(arc, is_forward=is_forward))
        for aside_m in self._asides(side):
            right_m = aside_m - side.own_m
            changed_m, pieces = self._change(-right_m if is_forward else right_m, steering)
            for away_m in steps_m:
                near = self._stop_at(line, away_m, is_forward=is_forward)
                stop = self._stop_at(line, away_m + changed_m, is_forward=is_forward)
                if near is not None and stop is not None:
                    pose = self.pose(near)
                    sin, cos = elementary.sin(pose.yaw_rad), elementary.cos(pose.yaw_rad)
                    swung = Pose(pose.x_m + right_m * cos, pose.z_m - right_m * sin, pose.yaw_rad)
                    length_m = sum(piece.length_m for piece in pieces)
                    yield _Swing(stop, swung, pieces, away_m + changed_m, away_m + changed_m - length_m)

    def _stop_at(self, line: Sequence[tuple[Arc, float]], away_m: float, *, is_forward: bool) -> Stop | None:
        """Return the stop at a distance from a node on a line; None beyond the line's end."""
        for arc, off_m in line:
            length_m = self.length_m(arc)
            if away_m <= off_m + length_m + _SAME:
                run_m = away_m - off_m
                return Stop(arc, round(run_m if is_forward else length_m - run_m, _DIGITS))
        return None

    def _shaped(self, arc: Arc, other: Arc, *, is_plain: bool) -> list[_Shape]:
        """Return the possible turns from an arc to the next, the best first, whether they are clear or not."""
        turned = math.remainder(self.pose(Stop(other, 0.0)).yaw_rad - self.pose(Stop(arc, 0.0)).yaw_rad, math.tau)
        quarters = round(turned / _QUARTER)
        turned = quarters * _QUARTER if abs(turned - quarters * _QUARTER) < _SAME else round(turned, _DIGITS)
        is_plain &= abs(turned) > _SLIGHT_RAD
        key = turned, self._side(arc, arc[1]), self._side(other, other[0]), is_plain
        if key not in self._shapes:
            self._shapes[key] = sorted(self._every_shape(*key))
        return self._shapes[key]

    def _side(self, arc: Arc, node: int) -> _Side:
        if _OUTSIDE in arc:
            return _Side(0.0, _DOOR_ROOM_M, 0.0, self.length_m(arc), is_door=True)
        return _Side(
            self.roadmap.own_side_m(arc),
            self.roadmap.room_m(arc),
            self.roadmap.turning_m(node, arc),
            _BESIDE_NODE_M[-1],
            is_door=False,
        )

    def _every_shape(self, turned: float, one: _Side, two: _Side, is_plain: bool) -> Iterator[_Shape]:  # noqa: FBT001
        turn = turned, one, two
        ways = chain(self._plain_turns(*turn), self._swung_turns(*turn)) if is_plain else self._joined_ways(*turn)
        sin, cos = elementary.sin(turned), elementary.cos(turned)
        halves: list[Half] = [
            ((0.0, -1.0), (0.0, 0.0), (-math.inf, -one.reach_m), (-math.inf, -one.reach_m), one.own_m),
            ((-sin, -cos), (0.0, 0.0), (two.reach_m, math.inf), (two.reach_m, math.inf), two.own_m),
        ]
        for before_m, after_m, pieces in ways:
            path = Path(Pose(one.own_m, before_m, 0.0), pieces)
            cost_m = path.length_m + _OVER_COST * self.roadmap.over_middle_m(path, halves)
            yield _Shape(cost_m - before_m - after_m, before_m, after_m, cost_m, pieces)

    def _plain_turns(self, turned: float, one: _Side, two: _Side) -> Iterator[tuple[float, float, tuple[Piece, ...]]]:
        """Yield turns by one circle, from and to some offset from the lines, with changes to that offset and back."""
        sin, cos = elementary.sin(turned), elementary.cos(turned)
        for steering in self.roadmap.steerings:
            pieces = steering.turn(turned)
            end = Path(Pose(0.0, 0.0, 0.0), pieces).end
            after_m = end.x_m / -sin
            before_m = -end.z_m - after_m * cos
            for aside_m in self._asides(one):
                in_m, changed_in = self._change(aside_m - one.own_m, steering)
                for other_m in self._asides(two):
                    out_m, changed_out = self._change(two.own_m - other_m, steering)
                    # where the two lines meet, along each of them from the node
                    met_after_m = (other_m * cos - aside_m) / sin
                    met_before_m = other_m * sin + met_after_m * cos
                    first_m, last_m = before_m - met_before_m, after_m + met_after_m
                    if first_m >= 0 and last_m >= 0:
                        yield (
                            round(first_m + in_m, _DIGITS),
                            round(last_m + out_m, _DIGITS),
                            (*changed_in, *pieces, *changed_out),
                        )

    def _swung_turns(self, turned: float, one: _Side, two: _Side) -> Iterator[tuple[float, float, tuple[Piece, ...]]]:
        """Yield turns between an offset from a line and the other line, with a change to that offset and back.

        A car swings out before a turn; behind a door, where it cannot, after it.
        """
        steering, sin, cos = self.roadmap.steerings[-1], elementary.sin(turned), elementary.cos(turned)
        side, other = (two, one) if one.is_door else (one, two)
        half_m = self.roadmap.half_width_m * math.copysign(1.0, side.own_m)
        swings = [half_m + math.copysign(each, half_m) for each in _SWINGS_M]
        asides = self._asides(side) if other.is_door else dict.fromkeys([side.own_m, *swings])
        backs = self._asides(other) if other.is_door else [other.own_m]
        for aside_m, back_m in product(asides, backs):
            if abs(aside_m) > max(side.room_m, abs(side.own_m)) or side.is_door:
                continue
            sign = -1 if one.is_door else 1
            changes = [(sign * (aside_m - side.own_m)), sign * (other.own_m - back_m)]
            (changed_m, changed), (more_m, more) = (self._change(right_m, steering) for right_m in changes)
            for near_m, far_m in product(_SWUNG_M, _DOOR_M if other.is_door else _SWUNG_BACK_M):
                if other.is_door and far_m + more_m > other.far_m:
                    continue
                at, to = (near_m, aside_m, changed_m, changed), (far_m, back_m, more_m, more)
                (before_m, in_m, first_m, first), (after_m, out_m, last_m, last) = (to, at) if one.is_door else (at, to)
                end = Pose(out_m * cos - after_m * sin, -out_m * sin - after_m * cos, turned)
                pieces = next(joining_pieces(Pose(in_m, before_m, 0.0), end, steering), None)
                if pieces:
                    yield before_m + first_m, after_m + last_m, (*first, *pieces, *last)

    def _asides(self, side: _Side) -> list[float]:
        """Return the offsets to the right of a lane's middle between which a car may turn, the line's first."""
        if side.is_door:
            return [share * side.room_m for share in (0.0, 1.0, -1.0, 0.65, 0.3)]
        most_m, sign = max(side.room_m, abs(side.own_m)), math.copysign(1.0, side.own_m)
        beside = [sign * (self.roadmap.half_width_m + each) for each in _BESIDE_MIDDLE_M]
        asides = [side.own_m, *beside, 0.0, -sign, most_m, -most_m]
        return [each for each in dict.fromkeys(asides) if abs(each) <= most_m]

    def _change(self, right_m: float, steering: Steering) -> tuple[float, tuple[Piece, ...]]:
        """Return the length along a line and the pieces of the shortest change to another line to the right."""
        if not right_m:
            return 0.0, ()
        for along_m in _CHANGES_M:
            pieces = next(joining_pieces(Pose(0.0, 0.0, 0.0), Pose(right_m, -along_m, 0.0), steering), None)
            if pieces is not None:
                return along_m, pieces
        return math.inf, ()

    def _joined_ways(self, turned: float, one: _Side, two: _Side) -> Iterator[tuple[float, float, tuple[Piece, ...]]]:
        """Yield ways of slight bends and changes of line from places before a node to places after it."""
        is_slight = abs(turned) <= _SLIGHT_RAD
        sides = [
            {each for each in (_SLIGHT_M if is_slight and not side.is_door else _BESIDE_NODE_M) if each < side.far_m}
            | ({side.far_m} if side.is_door else set())
            for side in (one, two)
        ]
        sin, cos = elementary.sin(turned), elementary.cos(turned)
        for before_m in sorted(sides[0]):
            start = Pose(one.own_m, before_m, 0.0)
            for after_m in sorted(sides[1]):
                end = Pose(two.own_m * cos - after_m * sin, -two.own_m * sin - after_m * cos, turned)
                for steering in self.roadmap.steerings:
                    for pieces in joining_pieces(start, end, steering):
                        if pieces:
                            yield before_m, after_m, pieces

    def ways(self, stop: Stop, *, is_forward: bool) -> Iterator[tuple[Stop, float, tuple[Piece, ...]]]:
        """Yield the ways from a stop to the next ones, or back: the stop, the cost, and the pieces as driven."""
        arc, run_m = stop
        far_m = self.length_m(arc) if is_forward else 0.0
        if _OUTSIDE in arc and (arc[1] == _OUTSIDE) == is_forward:
            straight = self.straight(arc, run_m, far_m)
            if straight is not None and run_m != far_m:
                yield Stop(arc, far_m), abs(far_m - run_m), straight
            return
        beyond = self._beyond(arc, is_forward=is_forward)
        straight = None if beyond is None else self.straight(arc, run_m, far_m)
        if beyond is not None and straight is not None:
            yield Stop(beyond, 0.0 if is_forward else self.length_m(beyond)), abs(far_m - run_m), straight
        for near, _ in self._line(arc, is_forward=is_forward):
            for one, other in self._pairs(near, is_forward=is_forward):
                for turn in self._turns(one, other):
                    at, to = (turn.start, turn.end) if is_forward else (turn.end, turn.start)
                    if at.arc == arc and (at.run_m >= run_m - _SAME if is_forward else at.run_m <= run_m + _SAME):
                        straight = self.straight(arc, run_m, at.run_m)
                        if straight is not None:
                            pieces = (*straight, *turn.pieces) if is_forward else (*turn.pieces, *straight)
                            yield to, abs(at.run_m - run_m) + turn.cost_m, pieces

    def _pairs(self, arc: Arc, *, is_forward: bool) -> Iterator[tuple[Arc, Arc]]:
        """Yield the pairs of arcs whose turns may begin on the line of an arc, or end there."""
        for other in (self.onward if is_forward else self.backward)[arc]:
            if other != self._beyond(arc, is_forward=is_forward):
                yield (arc, other) if is_forward else (other, arc)
                if not is_forward:
                    for near, _ in self._line(other, is_forward=False):
                        before = self._beyond(near, is_forward=False)
                        yield from ((each, near) for each in self.backward[near] if each != before)

    def straight(self, arc: Arc, one_m: float, other_m: float) -> tuple[Piece, ...] | None:
        """Return the straight between two distances along an arc's line; None if it is not clear."""
        low, high = min(one_m, other_m), max(one_m, other_m)
        if high - low < _SAME:
            return ()
        length_m = self.length_m(arc)
        if not (
            (low >= 0 and high <= length_m and self._is_clear(arc, 0.0, length_m)) or self._is_clear(arc, low, high)
        ):
            return None
        return (Piece(Gear.FORWARD, high - low),)

    def _is_clear(self, arc: Arc, low_m: float, high_m: float) -> bool:
        key = arc, low_m, high_m
        if key not in self._clear:
            straight = Path(self.pose(Stop(arc, low_m)), (Piece(Gear.FORWARD, high_m - low_m),))
            self._clear[key] = self.roadmap.is_clear(straight)
        return self._clear[key]

    def _last_ways(self, pose: Pose, edge: Arc, *, is_back: bool) -> Iterator[tuple[Arc, _LastWay]]:
        """Yield the ways from the lines before a pose on a lane edge to it, or from it to those after."""
        sign = -1 if is_back else 1
        run_m = self.roadmap.run_m(edge, pose)
        waiting: list[tuple[tuple[Arc, ...], float, bool]] = [((edge,), 0.0, True)]
        for walk, offset_m, is_line in waiting:
            far = walk[0 if is_back else -1]
            length_m = self.length_m(far)
            if is_line:
                runs = [run_m + sign * change_m - offset_m for change_m in _CHANGES_M]
            else:
                runs = [length_m - each if is_back else each for each in _BESIDE_NODE_M]
            for at_m in runs:
                if 0 <= at_m <= length_m:
                    yield far, _LastWay(at_m, self.pose(Stop(far, at_m)), walk)
            if len(walk) < _MOST_ARCS:
                for other in (self.backward if is_back else self.onward)[far]:
                    is_smooth = is_line and other == self._beyond(far, is_forward=not is_back)
                    moved_m = offset_m + (-self.length_m(other) if is_back else length_m)
                    waiting.append(((other, *walk) if is_back else (*walk, other), moved_m, is_smooth))


class _Tree:
    """The tree of shortest paths from some entrances on, or back from some exits; it grows as far as it is asked."""

    def __init__(self, network: Network, roots: Mapping[Stop, Portal], *, is_forward: bool) -> None:
        self._network, self._roots, self._is_forward = network, roots, is_forward
        self._done: dict[Stop, _Link] = {}
        self._at: dict[Arc, list[Stop]] = {}
        self._numbers = count()
        self._waiting = [_Link(0.0, next(self._numbers), None, root, ()) for root in roots]

    def led(self, wanted: Mapping[Arc, Sequence[_LastWay]], pose: Pose) -> tuple[Path, Portal] | None:
        """Return the path of least cost over one of the last ways from some arcs, to or from a pose."""
        queue: list[_Link] = []

        def offer(stops: Iterable[Stop]) -> None:
            for stop in stops:
                base_m = self._done[stop].cost_m
                for last in wanted.get(stop.arc, ()):
                    ahead_m = (last.run_m - stop.run_m) * (1 if self._is_forward else -1)
                    if ahead_m >= 0:
                        least_m = ahead_m + math.hypot(last.pose.x_m - pose.x_m, last.pose.z_m - pose.z_m)
                        heapq.heappush(queue, _Link(base_m + least_m, next(self._numbers), stop, None, None, last))

        offer(chain.from_iterable(self._at.get(arc, ()) for arc in wanted))
        while queue or self._waiting:
            if not queue or (self._waiting and self._waiting[0].cost_m < queue[0].cost_m):
                grown = self._grow()
                offer([grown] if grown is not None else [])
                continue
            link = heapq.heappop(queue)
            if link.pieces is not None:
                return self._path(link, pose)
            known = self._known(link, pose)
            if known is not None:
                heapq.heappush(queue, known)
        return None

    def _known(self, link: _Link, pose: Pose) -> _Link | None:
        """Return the link of a last way with its pieces and cost; None if it is not clear."""
        assert link.origin is not None
        assert link.last is not None
        roadmap, last, stop = self._network.roadmap, link.last, link.origin
        ends = (last.pose, pose) if self._is_forward else (pose, last.pose)
        joining, straight = roadmap.joined(*ends), self._network.straight(stop.arc, stop.run_m, last.run_m)
        if joining is None or straight is None:
            return None
        path = Path(ends[0], joining)
        over_m = roadmap.over_middle_m(path, roadmap.sides(last.walk))
        cost_m = self._done[stop].cost_m + abs(last.run_m - stop.run_m) + path.length_m + _OVER_COST * over_m
        return link._replace(cost_m=cost_m, pieces=(*straight, *joining) if self._is_forward else (*joining, *straight))

    def led_to(self, ends: Mapping[Stop, Portal]) -> tuple[Path, Portal] | None:
        """Return the path to the nearest of some stops outside exits, and that exit."""
        while not any(end in self._done for end in ends):
            if self._grow() is None:
                return None
        end = min((end for end in ends if end in self._done), key=lambda end: self._done[end].cost_m)
        return self._path(self._done[end], None)[0], ends[end]

    def _grow(self) -> Stop | None:
        """Settle the next stop."""
        while self._waiting:
            link = heapq.heappop(self._waiting)
            stop = link.target
            if stop is None or stop in self._done:
                continue
            self._done[stop] = link
            self._at.setdefault(stop.arc, []).append(stop)
            for to, cost_m, pieces in self._network.ways(stop, is_forward=self._is_forward):
                if to not in self._done:
                    heapq.heappush(self._waiting, _Link(link.cost_m + cost_m, next(self._numbers), stop, to, pieces))
            return stop
        return None

    def _path(self, link: _Link, pose: Pose | None) -> tuple[Path, Portal]:
        """Return the path between a root and a link's end, where a pose is, and the root's portal."""
        links = [link]
        while (origin := links[-1].origin) is not None:
            links.append(self._done[origin])
        root = links[-1].target
        assert root is not None
        driven = links[::-1] if self._is_forward else links
        portal = self._roots[root]
        start = portal.pose if self._is_forward or pose is None else pose
        return Path(start, _straightened(chain.from_iterable(each.pieces or () for each in driven))), portal


def _straightened(pieces: Iterable[Piece]) -> tuple[Piece, ...]:
    """Return pieces with consecutive straights made one."""
    joined: list[Piece] = []
    for piece in pieces:
        last = joined[-1] if joined else None
        if last is not None and {last.start_per_m, last.end_per_m, piece.start_per_m, piece.end_per_m} == {0.0}:
            joined[-1] = replace(last, length_m=last.length_m + piece.length_m)
        else:
            joined.append(piece)
    return tuple(joined)
