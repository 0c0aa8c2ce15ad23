"""Choice of stair cores: enough exits on foot in each fire compartment, within reach of every stall."""

from collections import defaultdict
from collections.abc import Collection
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.config import GarageConfig
from garage2usd.layout.egress.compartments import compartments_of
from garage2usd.layout.egress.cores import Core, core_candidates, obstacle_cores
from garage2usd.layout.placement import point_inside
from garage2usd.native import elementary
from garage2usd.profiles import Length
from garage2usd.structure.grid import Structure
from garage2usd.structure.lane_graph import LaneSquares, Square
from garage2usd.structure.stalls import Edge, StallRow

__all__ = ["Egress", "plan_egress"]

Points = NDArray[np.float64]

_EXITS = 2
"""Number of exits per compartment if the profile has no clause for it."""
_STALLS_FOR_ONE = 10
"""Cores replace at most one stall in this many, which limits them in small garages."""
_STALL_WORTH_M = 12.0
"""Detour from the best place, in metres, that is accepted to save one stall."""
_OFF_STRAIGHT_M = 8.0
"""Search distance for a straight lane, where a crossing can lead to the door."""
_SLACK_M = 1.0
_ROUNDS = 6


class Egress(NamedTuple):
    """Fire compartments and stair cores of a garage.

    Attributes
    ----------
    compartments
        Number of each square's fire compartment; see `garage2usd.layout.egress.compartments.compartments_of`.
    cores
        Stair cores, first the obstacles with doors.
    """

    compartments: NDArray[np.int32]
    cores: list[Core]


class _Places(NamedTuple):
    """Candidates of one compartment, with the positions of their doors and their costs in metres."""

    cores: list[Core]
    doors: Points
    price_m: NDArray[np.float64]


def plan_egress(
    structure: Structure,
    graph: LaneSquares,
    config: GarageConfig,
    *,
    sprinklered: bool,
    wells: Collection[Square] = (),
) -> Egress:
    """Divide the floor into fire compartments, and choose the stair cores of each.

    Parameters
    ----------
    structure, graph
        The plan.
    config
        Settings with the profile and the switch of stair cores.
    sprinklered
        Whether the clauses for sprinklered garages apply.
    wells
        (row, col) of the squares of ramps between levels: obstacles that are no cores.

    Notes
    -----
    Obstacles beside lanes are cores already. For an increasing number of further cores, places are spread over the
    stalls of a compartment by Lloyd's algorithm (1982) from farthest-first seeds (Gonzalez 1985). Each place is moved
    to the nearest candidate, with a cost of twelve metres for every replaced stall. The least number of cores with a
    door within reach of all stalls is used.
    """
    profile = config.standard
    compartments = compartments_of(structure, profile.compartment_area(sprinklered=sprinklered))
    cores = obstacle_cores(structure, wells)
    if not config.fittings.stair_cores:
        return Egress(compartments, cores)
    exits = profile.personnel_exits.amount if profile.personnel_exits else _EXITS
    reach = profile.way_out(sprinklered=sprinklered)
    stalls = _stalls_by_compartment(structure, graph, compartments)
    places = _places_by_compartment(structure, graph, config, compartments)
    budget = sum(len(points) for points in stalls.values()) // _STALLS_FOR_ONE
    for number, points in sorted(stalls.items()):
        fixed = np.array([core.door_m for core in cores if compartments[core.lane] == number]).reshape(-1, 2)
        for core in _chosen(points, places.get(number), fixed, int(exits), _reach_m(reach)):
            if len(core.stalls) <= budget:
                budget -= len(core.stalls)
                cores.append(core)
    return Egress(compartments, cores)


def _chosen(points: Points, places: _Places | None, fixed: Points, exits: int, reach_m: float) -> list[Core]:
    """Least set of cores for a compartment that has enough exits and one within reach of each stall."""
    chosen: list[int] = []
    if places is None:
        return []
    for count in range(max(exits - len(fixed), 0), len(places.cores) + 1):
        chosen = _snapped(places, _spread(points, fixed, count))
        doors = np.concatenate([fixed, places.doors[chosen]])
        if len(doors) and float(_distances(points, doors).min(axis=1).max()) <= reach_m:
            break
    return [places.cores[index] for index in chosen]


def _spread(points: Points, fixed: Points, count: int) -> Points:
    """Spread `count` places over points, in addition to fixed places."""
    centres = fixed
    for _ in range(count):
        if len(centres):
            nearest = _distances(points, centres).min(axis=1)
            centres = np.concatenate([centres, points[[int(np.argmax(nearest.round(6)))]]])
        else:
            centres = points[[int(np.argmin(points.sum(axis=1).round(6)))]]
    moving = centres[len(fixed) :].copy()
    for _ in range(_ROUNDS):
        owner = _distances(points, np.concatenate([fixed, moving])).round(6).argmin(axis=1) - len(fixed)
        for index in range(count):
            own = points[owner == index]
            if len(own):
                moving[index] = (own.min(axis=0) + own.max(axis=0)) / 2
    return moving


def _snapped(places: _Places, centres: Points) -> list[int]:
    """Indices of the candidates nearest to the places, at most one on each square."""
    chosen: list[int] = []
    for centre in centres:
        taken = {square for index in chosen for square in (places.cores[index].square, places.cores[index].lane)}
        far = np.array([core.square in taken or core.lane in taken for core in places.cores])
        if far.all():
            break
        price = _distances(places.doors, centre[None])[:, 0] + places.price_m
        chosen.append(int(np.argmin(np.where(far, np.inf, price.round(6)))))
    return chosen


def _distances(points: Points, others: Points) -> Points:
    off = points[:, None] - others[None]
    return elementary.hypot(off[..., 0], off[..., 1])


def _reach_m(clause: Length | None) -> float:
    return np.inf if clause is None else clause.amount - _SLACK_M


def _stalls_by_compartment(
    structure: Structure, graph: LaneSquares, compartments: NDArray[np.int32]
) -> dict[int, Points]:
    """Centres of the stalls in each compartment."""
    points: dict[int, list[tuple[float, float]]] = defaultdict(list)
    for row in graph.stall_rows:
        points[int(compartments[row.square])] += _middles(structure, row)
    return {number: np.array(middles) for number, middles in points.items()}


def _middles(structure: Structure, row: StallRow) -> list[tuple[float, float]]:
    return [
        point_inside(structure, row.square, row.edge, start + row.shape.pitch_m / 2, row.shape.depth_m / 2)
        for start in row.starts_m
    ]


def _places_by_compartment(
    structure: Structure, graph: LaneSquares, config: GarageConfig, compartments: NDArray[np.int32]
) -> dict[int, _Places]:
    """Candidates of each compartment, by the lanes in front of their doors."""
    found: dict[int, list[Core]] = defaultdict(list)
    for core in core_candidates(structure, graph, config):
        if compartments[core.square] == compartments[core.lane]:
            found[int(compartments[core.lane])].append(core)
    return {
        number: _Places(
            cores,
            np.array([core.door_m for core in cores]),
            np.array(
                [
                    _STALL_WORTH_M * len(core.stalls)
                    + _OFF_STRAIGHT_M * (not _is_straight(graph, core.lane, core.edge))
                    for core in cores
                ]
            ),
        )
        for number, cores in found.items()
    }


def _is_straight(graph: LaneSquares, lane: Square, edge: Edge) -> bool:
    """True if cars drive over a lane square parallel to an edge of it, and not across that edge."""
    joined = set(graph.graph[lane])
    return bool(joined) and joined <= {end.beyond(lane) for end in edge.ends}
