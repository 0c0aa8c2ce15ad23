"""Connecting paths over the lanes, each on its own side of the road: found once for a garage and a car, then reused.

A two-way lane with room for two cars has one line per direction, in the middle of that direction's half; any other has
one line in its middle. Turns lead from line to line. A tree of shortest paths from the entrances, or to the exits,
grows as far as drives need it; a drive adds the way between a line and the start of its manoeuvre.
"""

import heapq
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import chain, count, pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from garage2usd.driving.car import Pose
from garage2usd.driving.path import Path, Piece
from garage2usd.driving.road import Portal
from garage2usd.garage import Arc, LaneKind

if TYPE_CHECKING:
    from garage2usd.driving.roadmap import Roadmap

_OUTSIDE = -1
"""Stands for the outer end of a door's arc, which is no lane node."""
_SHARES = (0.0, 0.5, 1.0)
"""Places of the stops on a lane's line, as shares of its length."""
_MOST_ARCS, _TURN_M = 4, 9.0
"""Greatest number of arcs up to the start of a manoeuvre; length of the arcs after a turn over which it may end."""
_CHANGES_M = tuple(np.arange(4.0, 16.0, 0.75).tolist())
"""Distances over which a car may change between a line and the start of its manoeuvre, in metres."""
_OVER_COST = 3.0
"""Cost of a metre over the middle of a two-way lane, in metres driven."""

_SAME_M = 1e-6

_Walk = tuple[Arc, ...]
_LastWay = tuple[tuple[Pose, ...], _Walk]


class Stop(NamedTuple):
    """A pose of the network, by its number along an arc: of the lanes, or through a door."""

    arc: Arc
    number: int


class _Link(NamedTuple):
    """A possible way between two stops, or between a stop and the start of a manoeuvre; its order is that of a queue.

    Attributes
    ----------
    cost_m
        Cost up to its end: at least, or exactly if its pieces are known.
    number
        Sequence number.
    base_m
        Cost up to its origin.
    origin, target
        Its ends, in the order of the search; None before a root and at the start of a manoeuvre.
    poses
        Its poses from the origin on.
    walk
        Its arcs, in the order of driving; empty for a way along a line.
    pieces
        Its pieces in the order of driving, once known.
    """

    cost_m: float
    number: int
    base_m: float
    origin: Stop | None
    target: Stop | None
    poses: tuple[Pose, ...]
    walk: _Walk
    pieces: tuple[Piece, ...] | None = None


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
        self._stops: dict[Arc, list[Pose]] = {}
        self._trees: dict[tuple[int, ...], _Tree] = {}

    def led(self, pose: Pose, portals: Sequence[Portal], *, is_back: bool) -> tuple[Path, Portal] | None:
        """Return the path from a pose in line with a lane to one of some exits, or from one of some entrances to it."""
        lanes = self.roadmap.lanes
        edges = self.roadmap.edges_at(pose, lanes.arriving if is_back else lanes.leaving)
        wanted: dict[Stop, list[_LastWay]] = {}
        for edge in edges:
            for stop, way in self._last_ways(pose, edge, is_back=is_back):
                wanted.setdefault(stop, []).append(way)
        return self._tree(portals, is_forward=is_back).led(wanted)

    def through(self, entrance: Portal, exits: Sequence[Portal]) -> tuple[Path, Portal] | None:
        """Return the path from outside an entrance to outside one of some exits."""
        ends = {self._outside(portal): portal for portal in exits}
        return self._tree([entrance], is_forward=True).led_to(ends)

    def _tree(self, portals: Sequence[Portal], *, is_forward: bool) -> "_Tree":
        key = tuple(portal.node for portal in portals)
        if key not in self._trees:
            roots = {self._outside(portal): portal for portal in portals}
            self._trees[key] = _Tree(self, roots, is_forward=is_forward)
        return self._trees[key]

    def _outside(self, portal: Portal) -> Stop:
        """Return the stop outside a portal, where drives begin and end."""
        if portal.kind is LaneKind.ENTRANCE:
            return Stop((_OUTSIDE, portal.node), 0)
        arc = portal.node, _OUTSIDE
        return Stop(arc, len(self.poses(arc)) - 1)

    def poses(self, arc: Arc) -> list[Pose]:
        """Return the poses of the stops on an arc, in the order of driving."""
        if arc not in self._stops:
            if _OUTSIDE in arc:
                portal = self._portals[max(arc)]
                inside = [pose for _, pose in self.roadmap.door_spots(portal)]
                found = [*inside, portal.pose]
                self._stops[arc] = found[::-1] if portal.kind is LaneKind.ENTRANCE else found
            else:
                self._stops[arc] = [self.roadmap.own_side(arc, share * self.roadmap.length_m(arc)) for share in _SHARES]
        return self._stops[arc]

    @cached_property
    def _onward(self) -> dict[Arc, list[Arc]]:
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
    def _backward(self) -> dict[Arc, list[Arc]]:
        """Predecessors of each arc."""
        backward: dict[Arc, list[Arc]] = {arc: [] for arc in self._onward}
        for arc, others in self._onward.items():
            for other in others:
                backward[other].append(arc)
        return backward

    def _is_smooth(self, arc: Arc, other: Arc) -> bool:
        """Return True if the line of an arc goes on as that of the next."""
        return _OUTSIDE not in (*arc, *other) and self.roadmap.is_one_line(arc, other)

    @cached_property
    def _turns(self) -> tuple[dict[Arc, list[_Walk]], dict[Arc, list[_Walk]]]:
        """Walks over which a car may turn, by their first and by their last arc."""
        first: dict[Arc, list[_Walk]] = {arc: [] for arc in self._onward}
        last: dict[Arc, list[_Walk]] = {arc: [] for arc in self._onward}
        for arc, others in self._onward.items():
            waiting = [(arc, other) for other in others if not self._is_smooth(arc, other)]
            for walk in waiting:
                first[arc].append(walk)
                last[walk[-1]].append(walk)
                after_m = sum(self.roadmap.length_m(each) for each in walk[1:] if _OUTSIDE not in each)
                if after_m < _TURN_M:
                    waiting += [(*walk, other) for other in self._onward[walk[-1]] if other not in walk]
        return first, last

    def ways(self, stop: Stop, *, is_forward: bool) -> Iterator[tuple[Stop, tuple[Pose, ...], _Walk]]:
        """Yield the ways from a stop to the next ones, or backwards: the stop, the poses from the first, the walk."""
        step = 1 if is_forward else -1
        own = self.poses(stop.arc)
        here = own[stop.number]
        if 0 <= stop.number + step < len(own):
            yield Stop(stop.arc, stop.number + step), (here, own[stop.number + step]), ()
        else:
            for other in (self._onward if is_forward else self._backward)[stop.arc]:
                if self._is_smooth(*((stop.arc, other) if is_forward else (other, stop.arc))):
                    yield Stop(other, 0 if is_forward else len(_SHARES) - 1), (here,), ()
        for walk in self._turns[not is_forward][stop.arc]:
            other = walk[-1 if is_forward else 0]
            for number, pose in enumerate(self.poses(other)):
                ends = (stop, Stop(other, number)) if is_forward else (Stop(other, number), stop)
                # the same pose as at the end of the line before
                if ends[1].number or len(walk) == 2 or not self._is_smooth(walk[-2], walk[-1]):  # noqa: PLR2004
                    yield Stop(other, number), (here, pose), walk

    def _last_ways(self, pose: Pose, edge: Arc, *, is_back: bool) -> Iterator[tuple[Stop, _LastWay]]:
        """Yield the ways from the stops before a pose on a lane edge to it, or from it to those after."""
        sign = -1 if is_back else 1
        run_m = self.roadmap.run_m(edge, pose)
        waiting: list[tuple[_Walk, float, bool]] = [((edge,), 0.0, True)]
        for walk, offset_m, is_line in waiting:
            far = walk[0 if is_back else -1]
            poses = self.poses(far)
            length_m = 0.0 if _OUTSIDE in far else self.roadmap.length_m(far)
            if is_line:
                for change_m in _CHANGES_M:
                    at_m = run_m + sign * change_m - offset_m
                    if 0 <= at_m <= length_m:
                        share = at_m / length_m * (len(_SHARES) - 1)
                        stop = Stop(far, math.floor(share) if is_back else math.ceil(share))
                        yield stop, ((poses[stop.number], self.roadmap.own_side(far, at_m), pose), walk)
            else:
                for number, place in enumerate(poses):
                    yield Stop(far, number), ((place, pose), walk)
            if len(walk) < _MOST_ARCS:
                for other in (self._backward if is_back else self._onward)[far]:
                    ends = (other, far) if is_back else (far, other)
                    is_smooth = is_line and self._is_smooth(*ends)
                    if is_smooth:
                        moved_m = offset_m + (-self.roadmap.length_m(other) if is_back else length_m)
                    else:
                        moved_m = 0.0
                    waiting.append(((other, *walk) if is_back else (*walk, other), moved_m, is_smooth))

    def known(self, link: _Link, *, is_forward: bool) -> _Link | None:
        """Return a link with its pieces and its cost; None if no clear path is found."""
        if link.pieces is not None:
            return link
        poses = link.poses if is_forward else link.poses[::-1]
        pieces: list[Piece] = []
        for start, end in pairwise(poses):
            is_same = math.hypot(end.x_m - start.x_m, end.z_m - start.z_m) < _SAME_M and start.yaw_rad == end.yaw_rad
            joining = () if is_same else self.roadmap.joined(start, end)
            if joining is None:
                return None
            pieces += joining
        path = Path(poses[0], tuple(pieces))
        over_m = self.roadmap.over_middle_m(path, link.walk) if link.walk and pieces else 0.0
        return link._replace(cost_m=link.base_m + path.length_m + _OVER_COST * over_m, pieces=path.pieces)


class _Tree:
    """The tree of shortest paths from some entrances on, or back from some exits; it grows as far as it is asked."""

    def __init__(self, network: Network, roots: Mapping[Stop, Portal], *, is_forward: bool) -> None:
        self._network, self._roots, self._is_forward = network, roots, is_forward
        self._done: dict[Stop, _Link] = {}
        self._numbers = count()
        self._waiting: list[_Link] = []
        for root in roots:
            pose = network.poses(root.arc)[root.number]
            heapq.heappush(self._waiting, _Link(0.0, next(self._numbers), 0.0, None, root, (pose,), (), ()))

    def led(self, wanted: Mapping[Stop, Sequence[_LastWay]]) -> tuple[Path, Portal] | None:
        """Return the path of least cost over the last ways at some stops, to or from a pose."""
        queue: list[_Link] = []

        def offer(stops: Iterable[Stop]) -> None:
            for stop in stops:
                for poses, walk in wanted.get(stop, ()):
                    heapq.heappush(queue, self._link(stop, None, poses, walk))

        offer(stop for stop in wanted if stop in self._done)
        while queue or self._waiting:
            if not queue or (self._waiting and self._waiting[0].cost_m < queue[0].cost_m):
                grown = self._grow()
                offer([grown] if grown is not None else [])
                continue
            link = heapq.heappop(queue)
            known = self._network.known(link, is_forward=self._is_forward)
            if known is not None and known is not link:
                heapq.heappush(queue, known)
            elif known is not None:
                return self._path(known)
        return None

    def led_to(self, ends: Mapping[Stop, Portal]) -> tuple[Path, Portal] | None:
        """Return the path to the nearest of some stops outside exits, and that exit."""
        while not any(end in self._done for end in ends):
            if self._grow() is None:
                return None
        end = min((end for end in ends if end in self._done), key=lambda end: self._done[end].cost_m)
        return self._path(self._done[end])[0], ends[end]

    def _link(self, origin: Stop, target: Stop | None, poses: tuple[Pose, ...], walk: _Walk) -> _Link:
        base_m = self._done[origin].cost_m
        least_m = sum(math.hypot(two.x_m - one.x_m, two.z_m - one.z_m) for one, two in pairwise(poses))
        return _Link(base_m + least_m, next(self._numbers), base_m, origin, target, poses, walk)

    def _grow(self) -> Stop | None:
        """Settle the next stop."""
        while self._waiting:
            link = heapq.heappop(self._waiting)
            assert link.target is not None
            known = None if link.target in self._done else self._network.known(link, is_forward=self._is_forward)
            if known is not None and known is not link:
                heapq.heappush(self._waiting, known)
            elif known is not None:
                self._done[link.target] = link
                for stop, poses, walk in self._network.ways(link.target, is_forward=self._is_forward):
                    if stop not in self._done:
                        heapq.heappush(self._waiting, self._link(link.target, stop, poses, walk))
                return link.target
        return None

    def _path(self, link: _Link) -> tuple[Path, Portal]:
        """Return the path between a root and a link's end, and the root's portal."""
        links = [link]
        while (origin := links[-1].origin) is not None:
            links.append(self._done[origin])
        root = links[-1].target
        assert root is not None
        driven = links[::-1] if self._is_forward else links
        start = links[-1].poses[0] if self._is_forward else links[0].poses[-1]
        pieces = chain.from_iterable(each.pieces or () for each in driven)
        return Path(start, pieces_joined(pieces)), self._roots[root]


def pieces_joined(pieces: Iterable[Piece]) -> tuple[Piece, ...]:
    """Return pieces with consecutive straights made one."""
    joined: list[Piece] = []
    for piece in pieces:
        last = joined[-1] if joined else None
        if last is not None and {last.start_per_m, last.end_per_m, piece.start_per_m, piece.end_per_m} == {0.0}:
            joined[-1] = replace(last, length_m=last.length_m + piece.length_m)
        else:
            joined.append(piece)
    return tuple(joined)
