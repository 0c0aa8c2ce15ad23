"""The one assembly of a garage that is driven in, from the plain values that a layout and a checked file give."""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

import shapely

from garage2usd.driving.car import Point
from garage2usd.driving.garage import DrivenGarage, DrivenStall
from garage2usd.driving.lane_poses import DirectedEdge, LaneDirections, LaneSquare, SquareUse
from garage2usd.driving.obstacles import Obstacles
from garage2usd.structure.dead_ends import DEAD_END_LIMIT_MM
from garage2usd.structure.lane_graph import LaneEdge, LaneKind

__all__ = ["BELONGINGS", "StandingThing", "assembled"]

_PORTALS = {LaneKind.ENTRANCE.value: SquareUse.ENTRANCE, LaneKind.EXIT.value: SquareUse.EXIT}
_CAR = "car"
BELONGINGS = frozenset({_CAR, "wheel_stop", "traffic_cone"})
"""Classes of what is not in the way of the car whose stall it stands in."""


class StandingThing(NamedTuple):
    """Something on the floor that a car could touch.

    Attributes
    ----------
    name
        A name that nothing else there has.
    label
        Its semantic class.
    ground
        What it covers of the floor, (x, z) in metres.
    home
        Name of the stall that it stands in, if it stands in one; counts for `BELONGINGS` alone.
    """

    name: str
    label: str
    ground: shapely.Geometry
    home: str | None = None


def assembled(
    stalls: Iterable[tuple[str, Point, float, int]],
    squares: Iterable[tuple[Sequence[float], Sequence[float], str]],
    edges: Iterable[LaneEdge],
    dead_ends: Iterable[tuple[Sequence[int], float]],
    standing: Iterable[StandingThing],
) -> DrivenGarage:
    """Assemble the garage that cars are driven in.

    Parameters
    ----------
    stalls
        Name, middle (x, z), yaw in radians and access square of each stall that takes cars, as in `DrivenStall`.
    squares
        Middle (x, z), extents along X and Z in metres and kind (`LaneKind`) of each lane and portal.
    edges
        The pairs of squares that join, by their numbers.
    dead_ends
        The numbers of the squares of each dead end, from its tip back to the junction, and its length in metres.
    standing
        What a car could touch, the parked cars included.
    """
    edges = list(edges)
    # the proof names what is in the way in the order of the obstacles, and cars last
    things = sorted(standing, key=lambda thing: thing.label == _CAR)
    own: dict[str | None, list[str]] = defaultdict(list)
    for thing in things:
        if thing.label in BELONGINGS:
            own[thing.home].append(thing.name)
    taken = {thing.home for thing in things if thing.label == _CAR}
    return DrivenGarage(
        tuple(
            DrivenStall(
                name, centre_m, yaw_rad, access, None if name in taken else f"a car in {name}", tuple(own[name])
            )
            for name, centre_m, yaw_rad, access in stalls
        ),
        LaneDirections(
            tuple(
                LaneSquare((x, z), (width, depth), _PORTALS.get(kind, SquareUse.LANE))
                for (x, z), (width, depth), kind in squares
            ),
            {way: edge.width_m for edge in edges for way in edge.ways},
            frozenset(_backed_out_of(dead_ends, edges)),
        ),
        Obstacles.of((thing.name, thing.ground) for thing in things),
    )


def _backed_out_of(
    dead_ends: Iterable[tuple[Sequence[int], float]], edges: Iterable[LaneEdge]
) -> Iterator[DirectedEdge]:
    """The edges that lead into a dead end that is short enough to be backed out of, up to its tip."""
    beside = defaultdict(set)
    for edge in edges:
        beside[edge.start].add(edge.end)
        beside[edge.end].add(edge.start)
    for squares, length_m in dead_ends:
        if length_m <= DEAD_END_LIMIT_MM / 1000:
            yield from ((outside, squares[-1]) for outside in beside[squares[-1]].difference(squares))
            yield from pairwise(reversed(squares))
