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
from garage2usd.structure.grid import Cell, Structure
from garage2usd.structure.lane_graph import LaneGraph, Square

__all__ = ["layout_garage", "numbered_squares", "prove_stalls", "square_directions", "without_unreachable"]

_USES = {Cell.LANE: SquareUse.LANE, Cell.ENTRANCE: SquareUse.ENTRANCE, Cell.EXIT: SquareUse.EXIT}


def prove_stalls(
    layout: Layout,
    graph: LaneGraph,
    *,
    setback_m: float,
    car: DesignCar | None = None,
    limits: Limits | None = None,
    progress: Progress = silent,
) -> tuple[StallProof, ...]:
    """Drive a car into each stall of a layout that takes one and out again.

    Parameters
    ----------
    layout, graph
        The garage.
    setback_m
        How far the carriageway stays from squares that are no lane.
    car, limits, progress
        As for `garage2usd.driving.prove_garage`.

    Returns
    -------
    tuple of StallProof
        One for each stall that takes cars, in the order of the stalls.
    """
    return prove_garage(layout_garage(layout, graph, setback_m), car=car, limits=limits, progress=progress)


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
        proofs = prove_stalls(layout, graph, setback_m=config.bay.carriageway_setback_m, progress=progress)
        found = {proof.stall for proof in proofs if not proof.is_proven}
        if not found:
            return layout
        # a charger, an access aisle or a car that went elsewhere may stand in another's way
        unreachable |= found
        layout = lay_out(layout.structure, graph, config, unreachable=unreachable)


def layout_garage(layout: Layout, graph: LaneGraph, setback_m: float) -> DrivenGarage:
    """The stalls that take cars, the lanes, and what stands on the floor, each by its `object_name`."""
    number = numbered_squares(graph)
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
            access = number[stall.access_square]
            stalls.append(DrivenStall(stall.name, stall.centre_m, stall.yaw_rad, access, absent, own))
    standing = fixed_objects(layout).joined(parked_cars(layout))
    return DrivenGarage(tuple(stalls), square_directions(layout.structure, graph, setback_m), standing)


def numbered_squares(graph: LaneGraph) -> dict[Square, int]:
    """The number of each lane and portal, in reading order."""
    return {square: number for number, square in enumerate(sorted(graph.graph.nodes))}


def square_directions(structure: Structure, graph: LaneGraph, setback_m: float) -> LaneDirections:
    """The lanes of a structure by direction; both directions of each edge."""
    number = numbered_squares(graph)
    widths_m, depths_m = structure.column_widths_mm / 1000, structure.row_depths_mm / 1000
    squares = tuple(
        LaneSquare(
            (graph.graph.nodes[row, col]["x_m"], graph.graph.nodes[row, col]["z_m"]),
            (float(widths_m[col]), float(depths_m[row])),
            _USES[Cell(structure.cells[row, col])],
        )
        for row, col in number
    )
    carriageways: dict[DirectedEdge, float] = {}
    for one in number:
        for other in sorted(graph.graph[one]):
            side_m = float(depths_m[one[0]] if one[0] == other[0] else widths_m[one[1]])
            carriageways[number[one], number[other]] = side_m - 2 * setback_m
    backing: set[DirectedEdge] = set()
    for end in dead_ends(structure):
        if not end.needs_turning_stall:
            towards = [*reversed(end.squares)]
            outside = [square for square in graph.graph[towards[0]] if square not in end.squares]
            ways = [(square, towards[0]) for square in outside] + list(pairwise(towards))
            backing.update((number[one], number[other]) for one, other in ways)
    return LaneDirections(squares, carriageways, frozenset(backing))


def _on_square(kind: str, stall: Stall) -> str:
    row, col = stall.square
    return f"r{row:02d}_c{col:02d}/{stall.named(kind)}"
