"""A layout and its lane graph as a garage that is driven in."""

from collections import defaultdict
from itertools import pairwise

from garage2usd.config import GarageConfig
from garage2usd.driving.car import DesignCar
from garage2usd.driving.garage import DrivenGarage, DrivenStall, StallProof, prove_garage
from garage2usd.driving.lane_poses import DirectedEdge, LaneDirections, LaneSquare, SquareUse
from garage2usd.driving.proof import Limits
from garage2usd.driving.surroundings import fixed_objects, object_name, parked_cars
from garage2usd.layout import Layout, Stall, lay_out
from garage2usd.progress import Progress, silent
from garage2usd.structure.dead_ends import dead_ends
from garage2usd.structure.lane_graph import LaneGraph, LaneKind

__all__ = ["layout_garage", "prove_stalls", "square_directions", "without_unreachable"]

_PORTALS = {LaneKind.ENTRANCE: SquareUse.ENTRANCE, LaneKind.EXIT: SquareUse.EXIT}


def prove_stalls(
    layout: Layout,
    graph: LaneGraph,
    *,
    car: DesignCar | None = None,
    limits: Limits | None = None,
    progress: Progress = silent,
) -> tuple[StallProof, ...]:
    """Drive a car into each stall of a layout that takes one and out again.

    Parameters
    ----------
    layout, graph
        The garage.
    car, limits, progress
        As for `garage2usd.driving.prove_garage`.

    Returns
    -------
    tuple of StallProof
        One for each stall that takes cars, in the order of the stalls.
    """
    return prove_garage(layout_garage(layout, graph), car=car, limits=limits, progress=progress)


def without_unreachable(
    layout: Layout, graph: LaneGraph, config: GarageConfig, *, progress: Progress = silent
) -> Layout:
    """The layout anew, with the stalls marked or left out that cars do not get into and out of.

    Parameters
    ----------
    layout, graph, config
        The garage, and whether ``plan.unreachable_stalls`` marks them or leaves them out.
    progress
        As for `garage2usd.driving.prove_garage`.

    Raises
    ------
    ConfigError
        If none is left, or the configuration names a stall that is left out.
    """
    unreachable: set[str] = set()
    while True:
        proofs = prove_stalls(layout, graph, progress=progress)
        found = {proof.stall for proof in proofs if not proof.is_proven}
        if not found:
            return layout
        # a charger, an access aisle or a car that went elsewhere may stand in another's way
        unreachable |= found
        layout = lay_out(layout.structure, graph, config, unreachable=unreachable)


def layout_garage(layout: Layout, graph: LaneGraph) -> DrivenGarage:
    """The stalls that take cars, the lanes, and what stands on the floor, each by its `object_name`."""
    present = {object_name(place) for place in layout.of_kind("car")}
    cones = defaultdict(list)
    for place in layout.of_kind("cone"):
        cones[object_name(place).rpartition("_")[0]].append(object_name(place))
    stalls = []
    for stall in layout.stalls:
        if stall.use.takes_cars:
            car = _on_square("Car", stall)
            own = (car, _on_square("WheelStop", stall), *cones[_on_square("Cone", stall)])
            absent = None if car in present else car
            access = graph.number_of[stall.access_square]
            stalls.append(DrivenStall(stall.name, stall.centre_m, stall.yaw_rad, access, absent, own))
    standing = fixed_objects(layout).joined(parked_cars(layout))
    return DrivenGarage(tuple(stalls), square_directions(graph), standing)


def square_directions(graph: LaneGraph) -> LaneDirections:
    """The lanes of a graph by direction; both directions of each edge."""
    squares = tuple(
        LaneSquare((x, z), (width, depth), _PORTALS.get(graph.kind(square), SquareUse.LANE))
        for square, (x, z), (width, depth) in zip(
            graph.number_of, graph.middles_m.tolist(), graph.sides_m.tolist(), strict=True
        )
    )
    carriageways: dict[DirectedEdge, float] = {}
    for (one, other), width_m in zip(graph.edges.ends.tolist(), graph.edges.width_m.tolist(), strict=True):
        carriageways[one, other] = carriageways[other, one] = width_m
    carriageways = dict(sorted(carriageways.items()))
    backing: set[DirectedEdge] = set()
    for end in dead_ends(graph.structure):
        if not end.needs_turning_stall:
            towards = [*reversed(end.squares)]
            outside = [square for square in graph.graph[towards[0]] if square not in end.squares]
            ways = [(square, towards[0]) for square in outside] + list(pairwise(towards))
            backing.update((graph.number_of[one], graph.number_of[other]) for one, other in ways)
    return LaneDirections(squares, carriageways, frozenset(backing))


def _on_square(kind: str, stall: Stall) -> str:
    row, col = stall.square
    return f"r{row:02d}_c{col:02d}/{stall.named(kind)}"
