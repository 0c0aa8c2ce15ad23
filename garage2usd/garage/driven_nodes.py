"""The lane nodes that a car reaches in forward gear, between levels and the street."""

import math
from collections import deque
from collections.abc import Iterator
from typing import NamedTuple

from garage2usd.garage.lanes import LaneGraph, LaneKind

__all__ = ["LEAST_TURN_BACK_M", "driven_nodes"]

LEAST_TURN_BACK_M = 7.3
"""Least distance in metres between the middle lines of two aisles from one of which a car turns into the other at once:
twice the radius of the design car's rear axle with steering, less what it moves to the sides of both aisles."""
_TURN_SIN = 0.5


class _Going(NamedTuple):
    """A car on an arc.

    Attributes
    ----------
    start, end
        Nodes of the arc.
    turned
        Side of its last turn, 1 or -1; 0 if it no longer limits the next turn.
    since_m
        Distance from that turn to the end of the arc.
    """

    start: int
    end: int
    turned: int = 0
    since_m: float = 0.0


def driven_nodes(lanes: LaneGraph, kind: LaneKind) -> frozenset[int]:
    """Return the nodes that a car reaches from the entrances, or those from which it reaches the exits.

    Parameters
    ----------
    lanes
        Lane graph, also of several levels.
    kind
        ``entrance`` or ``exit``.

    Notes
    -----
    A car drives forwards and through no other portal. Two turns to the same side are `LEAST_TURN_BACK_M` or more apart;
    where they are closer, it depends on the room around whether a car turns back, which a search for its path tells.
    """
    ways = lanes.onward if kind == LaneKind.ENTRANCE else lanes.backward
    portals = lanes.portals(kind)
    going = {_Going(portal, other) for portal in portals for other in ways[portal]}
    waiting = deque(sorted(going))
    while waiting:
        for following in _following(lanes, ways, waiting.popleft()):
            if following not in going:
                going.add(following)
                waiting.append(following)
    return frozenset(each.end for each in going).union(portals)


def _following(lanes: LaneGraph, ways: tuple[tuple[int, ...], ...], going: _Going) -> Iterator[_Going]:
    start, end, turned, since_m = going
    if lanes.nodes[end].is_portal:
        return
    (from_x, from_z), (x, z) = lanes.nodes[start].position, lanes.nodes[end].position
    for other in ways[end]:
        to_x, to_z = lanes.nodes[other].position
        length_m = math.hypot(to_x - x, to_z - z)
        cross = (x - from_x) * (to_z - z) - (z - from_z) * (to_x - x)
        sine = cross / (math.hypot(x - from_x, z - from_z) * length_m)
        side = 0 if abs(sine) < _TURN_SIN else int(math.copysign(1, sine))
        if other == start or (side and side == turned):
            continue
        run_m = length_m if side else since_m + length_m
        is_free = run_m >= LEAST_TURN_BACK_M
        yield _Going(end, other, 0 if is_free else side or turned, 0.0 if is_free else round(run_m, 3))
