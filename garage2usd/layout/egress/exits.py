"""Exits on foot: fire compartments, and the stair cores that put each stall of one within reach."""

import math
from collections import defaultdict
from collections.abc import Collection, Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.layout.ceiling.beams import ceiling_levels
from garage2usd.layout.egress.cores import Core, obstacle_cores
from garage2usd.layout.egress.shafts import (
    LevelPlan,
    Places,
    Points,
    Shaft,
    chosen_shafts,
    has_doors,
    shaft_candidates,
    squares_of,
)
from garage2usd.layout.placement import point_inside
from garage2usd.profiles import Area, Profile
from garage2usd.structure.grid import Cell, Mask, Structure
from garage2usd.structure.lane_graph import LaneSquares, Square
from garage2usd.structure.squares import pieces_of
from garage2usd.structure.stalls import Edge, StallRow

_MM2_PER_M2 = 1e6
_LEAST_SHARE, _MOST_LINES = 0.3, 24
"""Least share of the floor on each side of a cut; greatest number of candidate cuts along each axis."""
_EXITS = 2
"""Number of exits per compartment if the profile has no clause for it."""
_STALLS_FOR_ONE = 10
"""Cores replace at most one stall in this many, which limits them in small garages."""
_STALL_WORTH_M = 12.0
"""Detour from the best place, in metres, that is accepted to save one stall."""
_OFF_STRAIGHT_M = 8.0
"""Search distance for a straight lane, where a crossing can lead to the door."""
_SLACK_M = 1.0


def compartment_name(number: int) -> str:
    """Return the name of a fire compartment: ``F1``."""
    return f"F{number}"


def compartments_of(structure: Structure, clause: Area | None) -> NDArray[np.int32]:
    """Divide the floor into fire compartments, and return the compartment number of each square.

    Numbers start from 1 in reading order; 0 is outside and on obstacles. int32, shape (rows, cols).


    Parameters
    ----------
    structure
        Layout grid of the garage.
    clause
        Greatest area of a compartment; None for a single compartment.

    Notes
    -----
    Recursive bisection: a part that is too large is cut along a grid line. The best cut needs the fewest compartments;
    among equals, it has the least greatest product of area and aspect ratio of a piece.
    """
    inside = structure.cells != Cell.OBSTACLE
    areas = np.outer(structure.row_depths_mm, structure.column_widths_mm) / _MM2_PER_M2
    limit = math.inf if clause is None else clause.amount
    numbers = np.zeros(structure.shape, dtype=np.int32)
    parts = sorted(_bisected(inside, areas, limit), key=lambda part: int(np.flatnonzero(part)[0]))
    for number, part in enumerate(parts, start=1):
        numbers[part] = number
    return numbers


def _bisected(part: Mask, areas: NDArray[np.float64], limit: float) -> Iterator[Mask]:
    """Yield a part of the floor, or the parts of its recursive bisection."""
    if float(areas[part].sum()) <= limit or int(part.sum()) <= 1:
        yield part
        return
    before = _best_cut(part, areas, limit)
    for piece in (*_pieces(before), *_pieces(part & ~before)):
        yield from _bisected(piece, areas, limit)


def _best_cut(part: Mask, areas: NDArray[np.float64], limit: float) -> Mask:
    """Return the side before the best grid line to cut a part."""
    spans = (np.flatnonzero(part.any(axis=axis)) for axis in (1, 0))
    box = tuple(slice(int(span[0]), int(span[-1]) + 1) for span in spans)
    cropped, floor = part[box], areas[box]
    best: tuple[tuple[float, ...], Mask] | None = None
    for axis in (0, 1):
        for line in _candidate_lines(np.where(cropped, floor, 0.0).sum(axis=1 - axis)):
            before = cropped.copy()
            before[(slice(line, None), slice(None))[:: 1 - 2 * axis]] = False
            pieces = [piece for side in (before, cropped & ~before) for piece in _pieces(side)]
            needed = sum(math.ceil(float(floor[piece].sum()) / limit) for piece in pieces)
            price = needed, max(float(floor[piece].sum()) * _aspect_ratio(piece) for piece in pieces)
            if best is None or price < best[0]:
                best = price, before
    if best is None:  # pragma: no cover - a part of two squares has a line between them
        raise ValueError("a part of one square is not cut")
    result = np.zeros_like(part)
    result[box] = best[1]
    return result


def _candidate_lines(areas: NDArray[np.float64]) -> list[int]:
    """Return the candidate lines with at least 0.3 of the area on both sides; all lines if there is no such line."""
    before = np.cumsum(areas)[:-1] / areas.sum()
    middle = np.flatnonzero((before >= _LEAST_SHARE) & (before <= 1 - _LEAST_SHARE)) + 1
    lines = middle if len(middle) else np.arange(1, len(areas))
    if not len(lines):
        return []
    chosen = np.linspace(0, len(lines) - 1, min(len(lines), _MOST_LINES)).round().astype(int)
    return [int(line) for line in lines[np.unique(chosen)]]


def _pieces(mask: Mask) -> list[Mask]:
    """Return the 4-connected components of a part."""
    numbers, count = pieces_of(mask)
    return [numbers == number for number in range(1, count + 1)]


def _aspect_ratio(piece: Mask) -> float:
    """Return the aspect ratio of a piece's bounding box, long side over short side."""
    rows, cols = (int(np.ptp(indices)) + 1 for indices in np.nonzero(piece))
    return max(rows, cols) / min(rows, cols)


class Egress(NamedTuple):
    """Fire compartments and stair cores of a garage.

    Attributes
    ----------
    compartments
        Number of each square's fire compartment; see `garage2usd.layout.egress.exits.compartments_of`.
    cores
        Stair cores, first the obstacles with doors.
    shafts
        Shafts of the levels below that have no door on this level.
    """

    compartments: NDArray[np.int32]
    cores: tuple[Core, ...]
    shafts: tuple[Core, ...] = ()


def plan_egress(levels: Sequence[LevelPlan], wells: Collection[Square] = ()) -> list[Egress]:
    """Divide the floors into fire compartments, and choose the stair cores of each.

    Parameters
    ----------
    levels
        The plan of each level from the top, with the same R, C and obstacles. Cores stand above one another.
    wells
        (row, col) of the squares of ramps between levels: obstacles that are not cores.

    Returns
    -------
    list of Egress
        Compartments and cores of each level.

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
    exits, reach_m = exits_asked(profile), reach_to_exits_m(profile, sprinklered=sprinklered)
    stalls = [_stalls_by_compartment(level, compartments) for level in levels]
    places = _places_by_compartment(levels, compartments)
    budget = sum(len(points) for own in stalls for points in own.values()) // _STALLS_FOR_ONE
    for compartment in sorted(set().union(*stalls)):
        points = [own.get(compartment, np.empty((0, 2))) for own in stalls]
        fixed = _fixed_doors(cores, compartments, compartment)
        for shaft in chosen_shafts(points, places.get(compartment), fixed, exits, reach_m, budget):
            if _replaced(shaft) <= budget:
                budget -= _replaced(shaft)
                for number, core in enumerate(shaft):
                    if core is not None:
                        (cores if core.has_door else shafts)[number].append(core)
    return [Egress(compartments, tuple(own), tuple(closed)) for own, closed in zip(cores, shafts, strict=True)]


def _fixed_doors(cores: list[list[Core]], compartments: NDArray[np.int32], number: int) -> Points:
    """Doors of obstacles that have one on each level in the compartment; shape (levels, obstacles, 2)."""
    doors = [{core.square: core.door_m for core in own if compartments[core.lane] == number} for own in cores]
    shared = [square for square in doors[0] if all(square in own for own in doors)]
    return np.array([[own[square] for square in shared] for own in doors]).reshape(len(cores), -1, 2)


def exits_asked(profile: Profile) -> int:
    """Return how many exits on foot a fire compartment needs."""
    return int(profile.personnel_exits.amount) if profile.personnel_exits else _EXITS


def reach_to_exits_m(profile: Profile, *, sprinklered: bool) -> float:
    """Return the greatest distance in metres from a stall to an exit on foot; infinite where the profile has none."""
    clause = profile.way_out(sprinklered=sprinklered)
    return np.inf if clause is None else clause.amount - _SLACK_M


def price_off_straight_m(*, is_straight: bool) -> float:
    """Return the price of a door in metres of detour: 0 beside a straight lane, else a constant."""
    return _OFF_STRAIGHT_M * (not is_straight)


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


def _places_by_compartment(levels: Sequence[LevelPlan], compartments: NDArray[np.int32]) -> dict[int, Places]:
    """Candidates of each compartment, by the lanes in front of their doors."""
    found: dict[int, list[Shaft]] = defaultdict(list)
    for shaft in shaft_candidates(levels):
        numbers = {int(compartments[square]) for square in squares_of(shaft)}
        if len(numbers) == 1:
            found[numbers.pop()].append(shaft)
    return {
        number: Places(
            shafts,
            np.array([[_door_m(core) for core in own] for own in zip(*shafts, strict=True)]),
            np.array([_price_m(levels, shaft) for shaft in shafts]),
            np.array([_replaced(shaft) for shaft in shafts]),
            [squares_of(shaft) for shaft in shafts],
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
        + price_off_straight_m(is_straight=not core.has_door or _is_straight(level.graph, core.lane, core.edge))
        for level, core in zip(levels, shaft, strict=True)
        if core is not None
    ]
    return sum(prices) / len(levels)


def _is_straight(graph: LaneSquares, lane: Square, edge: Edge) -> bool:
    """True if cars drive over a lane square parallel to an edge of it, and not across that edge."""
    joined = set(graph.graph[lane])
    return bool(joined) and joined <= {end.beyond(lane) for end in edge.ends}
