"""Plans in order: by their value, by the rules that they break, by the floor that a stall takes."""

from collections.abc import Iterable

import numpy as np

from garage2usd.config import BayConfig
from garage2usd.planning.board import FAULTS, Board, measure
from garage2usd.planning.circulation import circulation
from garage2usd.planning.dimensions import area_per_stall_m2, dimensioned
from garage2usd.planning.ground import Ground, Lanes, cells_of
from garage2usd.structure.grid import Cell, Structure

__all__ = [
    "Ranked",
    "apart",
    "faults_of",
    "keeping_rules_first",
    "lanes_on",
    "least_floor_first",
    "put_lanes",
    "ranked_plans",
]

Ranked = tuple[float, Lanes]
"""A plan with its value."""

_FINALISTS, _MOSTLY_COMMON = 12, 0.9
"""Plans that are dimensioned to be compared in metres, which takes time; common share of lanes of plans too alike."""


def ranked_plans(plans: Iterable[Ranked]) -> list[Ranked]:
    """Each once, best first; equal values by their lanes, so that no order of meeting matters."""
    return sorted(
        {lanes.tobytes(): (value, lanes) for value, lanes in plans}.values(),
        key=lambda entry: (-entry[0], entry[1].tobytes()),
    )


def keeping_rules_first(ground: Ground, board: Board, ranked: list[Ranked]) -> list[Ranked]:
    """The same, those that break the rules of circulation least often first."""
    return sorted(ranked, key=lambda entry: faults_of(ground, board, entry[1])) if ground.rules.is_asked else ranked


def faults_of(ground: Ground, board: Board, lanes: Lanes) -> int:
    """How often lanes break the rules of circulation."""
    put_lanes(ground, board, lanes)
    measure(ground, board, -np.inf)
    return int(board.tally[FAULTS])


def least_floor_first(site: Structure, ground: Ground, ranked: list[Ranked], bay: BayConfig) -> list[Ranked]:
    """The first few by the rules that they break and their floor for a stall, the rest as they are."""

    def key(entry: Ranked) -> tuple[int, float, bytes]:
        structure = dimensioned(site.with_cells(cells_of(ground, entry[1])), bay)
        broken = circulation(structure).faults(ground.rules)
        return len(broken), area_per_stall_m2(structure, bay), entry[1].tobytes()

    return [*sorted(ranked[:_FINALISTS], key=key), *ranked[_FINALISTS:]]


def apart(ranked: list[Ranked], count: int) -> list[Ranked]:
    """The best few plans of which no two have most lanes in common; fewer where there are no more."""
    chosen: list[Ranked] = []
    for entry in ranked:
        common = max((int((entry[1] & lanes).sum()) / max(1, int(lanes.sum())) for _, lanes in chosen), default=0.0)
        if common < _MOSTLY_COMMON:
            chosen.append(entry)
        if len(chosen) == count:
            break
    return chosen


def lanes_on(ground: Ground, board: Board) -> Lanes:
    """The lanes on the board."""
    lanes: Lanes = board.cells[ground.squares] == Cell.LANE
    return lanes


def put_lanes(ground: Ground, board: Board, lanes: Lanes) -> None:
    """Have these lanes on the board and no others; keeps no tally."""
    board.cells[:] = ground.cells
    board.cells[ground.squares[lanes]] = Cell.LANE
