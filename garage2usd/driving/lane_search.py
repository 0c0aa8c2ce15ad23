"""Smooth paths over lanes between a stall's manoeuvre and the portals: A* over the poses of a roadmap."""

import heapq
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from itertools import count, pairwise

from garage2usd.driving.car import Pose
from garage2usd.driving.path import Path, Piece
from garage2usd.driving.road import Portal
from garage2usd.driving.roadmap import Grain, Roadmap, Spot
from garage2usd.garage import Arc

__all__ = ["path_between_portals", "path_from_entrance", "path_to_exit"]

_ASIDE_COST_M, _EDGE_COST_M = 2.0, 3.0
"""Cost in metres of a spot off the lane's centre line, and of each further edge, so that paths keep to centre lines."""

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
                    # rather straight through the door, by a place in line with it
                    self._offer(portal, origin, over_m + _EDGE_COST_M, walk[:-1])
                    places += self._roadmap.door_spots(self._portals[portal])
                # a long straight between spots is put together of short ones
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
