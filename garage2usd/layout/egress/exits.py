"""Choice of stair cores: enough exits on foot in each fire compartment, within reach of every stall."""

from collections import defaultdict
from collections.abc import Collection, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.layout.ceiling.beams import ceiling_levels
from garage2usd.layout.egress.compartments import compartments_of
from garage2usd.layout.egress.cores import Core, obstacle_cores
from garage2usd.layout.egress.shafts import LevelPlan, Shaft, has_doors, shaft_candidates
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
_EXIT_WORTH_STALLS = 20
"""A missing exit counts as much as this number of stalls out of reach."""
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
    shafts
        Shafts of the levels below that have no door on this level.
    """

    compartments: NDArray[np.int32]
    cores: tuple[Core, ...]
    shafts: tuple[Core, ...] = ()


class _Places(NamedTuple):
    """Candidates of one compartment.

    Attributes
    ----------
    shafts
        The core of each level, of each candidate.
    doors
        Positions (x, z) of their doors, infinite on levels without one; shape (levels, candidates, 2).
    price_m
        Their costs in metres, as the mean of all levels; shape (candidates,).
    stalls
        Numbers of stalls that they replace on all levels; shape (candidates,).
    through
        Numbers of the candidates with a door on each level; shape (n,).
    """

    shafts: list[Shaft]
    doors: Points
    price_m: NDArray[np.float64]
    stalls: NDArray[np.intp]
    through: NDArray[np.intp]


def plan_egress(levels: Sequence[LevelPlan], wells: Collection[Square] = ()) -> list[Egress]:
    """Divide the floors into fire compartments, and choose the stair cores of each.

    Parameters
    ----------
    levels
        The plan of each level from the top, with the same R, C and obstacles. Cores stand above one another.
    wells
        (row, col) of the squares of ramps between levels: obstacles that are no cores.

    Returns
    -------
    list of Egress
        That of each level.

    Notes
    -----
    Obstacles beside lanes are cores already. For an increasing number of further cores, places are spread over the
    stalls of a compartment by Lloyd's algorithm (1982) from farthest-first seeds (Gonzalez 1985). Each place is moved
    to the nearest candidate, with a cost of twelve metres for every replaced stall. The least number of cores with a
    door within reach of all stalls is used. Stalls of all levels count, and cores have a door on each level. Where too
    few places have one, shafts with doors on some of the levels are chosen by greedy set cover (Chvatal 1979).
    """
    structure, _, config = levels[0]
    profile, sprinklered = config.standard, ceiling_levels(config.fittings).pipe_drop_m is not None
    compartments = compartments_of(structure, profile.compartment_area(sprinklered=sprinklered))
    cores = [obstacle_cores(level.structure, wells) for level in levels]
    shafts: list[list[Core]] = [[] for _ in levels]
    if not config.fittings.stair_cores:
        return [Egress(compartments, tuple(own)) for own in cores]
    exits = profile.personnel_exits.amount if profile.personnel_exits else _EXITS
    reach = profile.way_out(sprinklered=sprinklered)
    stalls = [_stalls_by_compartment(level, compartments) for level in levels]
    places = _places_by_compartment(levels, compartments)
    budget = sum(len(points) for own in stalls for points in own.values()) // _STALLS_FOR_ONE
    for compartment in sorted(set().union(*stalls)):
        points = [own.get(compartment, np.empty((0, 2))) for own in stalls]
        fixed = _fixed_doors(cores, compartments, compartment)
        for shaft in _chosen(points, places.get(compartment), fixed, int(exits), _reach_m(reach), budget):
            if _replaced(shaft) <= budget:
                budget -= _replaced(shaft)
                for number, core in enumerate(shaft):
                    if core is not None:
                        (cores if core.has_door else shafts)[number].append(core)
    return [Egress(compartments, tuple(own), tuple(closed)) for own, closed in zip(cores, shafts, strict=True)]


def _fixed_doors(cores: list[list[Core]], compartments: NDArray[np.int32], number: int) -> Points:
    """Doors of the obstacles that have one in a compartment on each level; shape (levels, obstacles, 2)."""
    doors = [{core.square: core.door_m for core in own if compartments[core.lane] == number} for own in cores]
    shared = [square for square in doors[0] if all(square in own for own in doors)]
    return np.array([[own[square] for square in shared] for own in doors]).reshape(len(cores), -1, 2)


def _chosen(
    points: list[Points], places: _Places | None, fixed: Points, exits: int, reach_m: float, budget: int
) -> list[Shaft]:
    """Least set of cores for a compartment that has enough exits and one within reach of each stall, on each level."""
    chosen: list[int] = []
    if places is None:
        return []
    doors = fixed
    for count in range(max(exits - fixed.shape[1], 0), len(places.through) + 1):
        chosen = _snapped(places, _spread(np.concatenate(points), fixed[0], count))
        doors = np.concatenate([fixed, places.doors[:, chosen]], axis=1)
        if doors.shape[1] and _are_reached(points, doors, reach_m):
            break
    if len(points) > 1 and not (
        doors.shape[1] >= exits
        and _are_reached(points, doors, reach_m)
        and sum(places.stalls[index] for index in chosen) <= budget
    ):
        chosen = _covering(points, places, fixed, exits, reach_m)
    return [places.shafts[index] for index in chosen]


def _are_reached(points: list[Points], doors: Points, reach_m: float) -> bool:
    """True if a door is within reach of each stall, on each level."""
    return all(
        float(_distances(own, near).min(axis=1).max(initial=0.0)) <= reach_m
        for own, near in zip(points, doors, strict=True)
    )


def _covering(points: list[Points], places: _Places, fixed: Points, exits: int, reach_m: float) -> list[int]:
    """Choose shafts until all stalls that can be reached are, and all levels that can have enough exits have them.

    In each step the shaft is added that adds the most for the stalls that it replaces, among equals the one farthest
    from the others.
    """
    has_door = np.isfinite(places.doors[..., 0])
    near = [
        (_distances(own, doors) <= reach_m) & there
        for own, doors, there in zip(points, places.doors, has_door, strict=True)
    ]
    left = [~(_distances(own, doors) <= reach_m).any(axis=1) for own, doors in zip(points, fixed, strict=True)]
    missing = np.full(len(points), exits - fixed.shape[1])
    free = np.ones(len(places.shafts), dtype=bool)
    chosen: list[int] = []
    while True:
        gains = sum(reached[still].sum(axis=0) for reached, still in zip(near, left, strict=True))
        gains = gains + _EXIT_WORTH_STALLS * (np.maximum(missing, 0) @ has_door)
        worth = np.where(free, gains / (1 + places.stalls), 0.0).round(9)
        if worth.max() <= 0:
            return chosen
        equal = np.flatnonzero(worth == worth.max())
        best = int(equal[np.argmax(_far_m(places, fixed, chosen)[equal])])
        chosen.append(best)
        squares = _squares_of(places.shafts[best])
        free &= [not squares & _squares_of(shaft) for shaft in places.shafts]
        missing -= has_door[:, best]
        left = [still & ~reached[:, best] for reached, still in zip(near, left, strict=True)]


def _far_m(places: _Places, fixed: Points, chosen: list[int]) -> NDArray[np.float64]:
    """Distance of each candidate's doors to the nearest door that is there, on any level; shape (candidates,)."""
    doors = np.concatenate([fixed, places.doors[:, chosen]], axis=1)
    if not doors.shape[1]:
        return np.zeros(len(places.shafts))
    with np.errstate(invalid="ignore"):
        nearest = [_distances(own, there).min(axis=1) for own, there in zip(places.doors, doors, strict=True)]
    far: NDArray[np.float64] = np.nan_to_num(nearest, nan=np.inf, posinf=np.inf).min(axis=0).round(6)
    return far


def _squares_of(shaft: Shaft) -> set[Square]:
    """Squares of a shaft, and of the lanes before its doors."""
    cores = [core for core in shaft if core is not None]
    return {core.square for core in cores} | {core.lane for core in cores if core.has_door}


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
    """Numbers of the candidates nearest to the places, at most one on each square."""
    chosen: list[int] = []
    middles, price_m = places.doors[:, places.through].mean(axis=0), places.price_m[places.through]
    squares = [_squares_of(places.shafts[index]) for index in places.through.tolist()]
    taken: set[Square] = set()
    for centre in centres:
        far = np.array([bool(own & taken) for own in squares])
        if far.all():
            break
        price = _distances(middles, centre[None])[:, 0] + price_m
        at = int(np.argmin(np.where(far, np.inf, price.round(6))))
        taken |= squares[at]
        chosen.append(int(places.through[at]))
    return chosen


def _distances(points: Points, others: Points) -> Points:
    off = points[:, None] - others[None]
    return elementary.hypot(off[..., 0], off[..., 1])


def _reach_m(clause: Length | None) -> float:
    return np.inf if clause is None else clause.amount - _SLACK_M


def _stalls_by_compartment(level: LevelPlan, compartments: NDArray[np.int32]) -> dict[int, Points]:
    """Centres of the stalls of a level in each compartment."""
    points: dict[int, list[tuple[float, float]]] = defaultdict(list)
    for row in level.graph.stall_rows:
        points[int(compartments[row.square])] += _middles(level.structure, row)
    return {number: np.array(middles) for number, middles in points.items()}


def _middles(structure: Structure, row: StallRow) -> list[tuple[float, float]]:
    return [
        point_inside(structure, row.square, row.edge, start + row.shape.pitch_m / 2, row.shape.depth_m / 2)
        for start in row.starts_m
    ]


def _places_by_compartment(levels: Sequence[LevelPlan], compartments: NDArray[np.int32]) -> dict[int, _Places]:
    """Candidates of each compartment, by the lanes in front of their doors."""
    found: dict[int, list[Shaft]] = defaultdict(list)
    for shaft in shaft_candidates(levels):
        numbers = {int(compartments[square]) for square in _squares_of(shaft)}
        if len(numbers) == 1:
            found[numbers.pop()].append(shaft)
    return {
        number: _Places(
            shafts,
            np.array([[_door_m(core) for core in own] for own in zip(*shafts, strict=True)]),
            np.array([_price_m(levels, shaft) for shaft in shafts]),
            np.array([_replaced(shaft) for shaft in shafts]),
            np.flatnonzero([has_doors(shaft) for shaft in shafts]),
        )
        for number, shafts in found.items()
    }


def _door_m(core: Core | None) -> tuple[float, float]:
    return core.door_m if core is not None and core.has_door else (np.inf, np.inf)


def _replaced(shaft: Shaft) -> int:
    """Number of stalls that a shaft replaces on all levels."""
    return sum(len(core.stalls) for core in shaft if core is not None)


def _price_m(levels: Sequence[LevelPlan], shaft: Shaft) -> float:
    """Detour that a cheaper shaft is worth, as the mean of all levels."""
    prices = [
        _STALL_WORTH_M * len(core.stalls)
        + _OFF_STRAIGHT_M * (core.has_door and not _is_straight(level.graph, core.lane, core.edge))
        for level, core in zip(levels, shaft, strict=True)
        if core is not None
    ]
    return sum(prices) / len(levels)


def _is_straight(graph: LaneSquares, lane: Square, edge: Edge) -> bool:
    """True if cars drive over a lane square parallel to an edge of it, and not across that edge."""
    joined = set(graph.graph[lane])
    return bool(joined) and joined <= {end.beyond(lane) for end in edge.ends}
