"""Planning without learning, as a control."""

from collections.abc import Iterable, Iterator

import numpy as np

from garage2usd.common.errors import GenerationError
from garage2usd.common.randomness import Step, generator
from garage2usd.config import BayConfig, PlanConfig
from garage2usd.planning import Plan, evaluate
from garage2usd.planning.board import (
    NO_VALUE,
    Board,
    Ground,
    Lanes,
    cells_of,
    connect,
    ground_of,
    lanes_of,
    lanes_on,
    measure,
    new_board,
    put_lanes,
)
from garage2usd.planning.local_search import Ranked, local_search, ranked_plans
from garage2usd.structure.grid import Structure

__all__ = ["anneal_alone"]


def anneal_alone(
    site: Structure, *, plan: PlanConfig, bay: BayConfig, seed: int, starts: Iterable[Structure] = ()
) -> Plan:
    """Repair, climb and anneal given lanes, or shortest paths between the portals.

    Parameters
    ----------
    site, plan, bay, seed
        As for `garage2usd.planning.plan_lanes`; without ``climb`` the given lanes are repaired only.
    starts
        Structures on the site, feasible or not.

    Raises
    ------
    GenerationError
        If no lanes can join the portals.
    """
    ground = ground_of(site, bay=bay, plan=plan)
    board = new_board(ground)
    random = generator(seed, Step.PLAN).integers(1, 2**63, size=1, dtype=np.uint64)
    given = [lanes_of(structure, ground) for structure in starts] or [np.zeros(len(ground.squares), dtype=np.bool_)]
    ranked = ranked_plans(_repaired(ground, board, given))
    if not ranked:
        raise GenerationError("plan", "no way joins all portals", seed=seed, attempts=len(given))
    if plan.polishes:
        ranked = local_search(site, ground, board, ranked, plan, bay, random)
    structure = site.with_cells(cells_of(ground, ranked[0][1]))
    return Plan(structure, evaluate(structure, bay=bay, plan=plan))


def _repaired(ground: Ground, board: Board, given: list[Lanes]) -> Iterator[Ranked]:
    """Lanes connected with each other and the portals by shortest paths, where there are any."""
    for lanes in given:
        put_lanes(ground, board, lanes)
        if connect(ground, board):
            value = max(measure(ground, board, -np.inf), NO_VALUE)  # without stalls it has no value, but stands
            yield value, lanes_on(ground, board)
