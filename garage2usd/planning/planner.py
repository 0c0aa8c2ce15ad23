"""The planner: Sarsa on a site, then local search from the best plans."""

import numpy as np

from garage2usd.common.errors import GenerationError
from garage2usd.common.progress import Progress, silent
from garage2usd.common.randomness import Step, generator
from garage2usd.config import BayConfig, PlanConfig
from garage2usd.config.plan import Choice
from garage2usd.planning.board import (
    NO_VALUE,
    Board,
    connect,
    faults_of,
    lanes_on,
    measure,
    new_board,
    put_lanes,
    value_now,
)
from garage2usd.planning.circulation import circulation
from garage2usd.planning.dimensions import dimensioned
from garage2usd.planning.ground import Ground, Lanes, cells_of, ground_of
from garage2usd.planning.learner import learn_aisles, learn_squares, uses_aisles
from garage2usd.planning.local_search import Ranked, keeping_rules_first, least_floor_first, local_search
from garage2usd.planning.plan import ArchivedPlan, Plan
from garage2usd.planning.score import Score, evaluate
from garage2usd.structure.grid import Structure

__all__ = ["plan_lanes"]


def plan_lanes(site: Structure, *, plan: PlanConfig, bay: BayConfig, seed: int, progress: Progress = silent) -> Plan:
    """Plan the lanes of a site by tabular Sarsa.

    Parameters
    ----------
    site
        Static objects without lanes.
    plan
        Preset and parameters.
    bay
        Size of the stalls.
    seed
        Seed of the step.
    progress
        Called with the number of finished episodes.

    Returns
    -------
    Plan
        Feasible: the lanes form one piece and touch every portal.

    Raises
    ------
    GenerationError
        If no lanes can join the portals.

    Notes
    -----
    ``q(S_t, A_t) += alpha (R_{t+1} + gamma q(S_{t+1}, A_{t+1}) - q(S_t, A_t))`` with an epsilon-greedy policy over up,
    down, left, right, stay; on large sites over whole aisles. Deviation: the paper words epsilon
    opposite to its formula; the formula stands. Deviation: by default the agent has the preset ``tuned``: it sees less,
    cannot bump, goes on from what was good before and starts several times, as it finds better plans so; ``paper`` is
    the paper's agent. Deviation: local search polishes the best plans after learning, unless ``climb`` is false.
    Deviation: where no episode joined all portals, shortest paths between them are the lanes. Deviation: plans keep
    rules of circulation (``circulation``): broken rules cost stalls when plans are compared, and plans that keep the
    rules come first; the reported score has no such term. Deviation: where R and C are chosen, plans
    are compared by the floor that a stall takes.
    """
    ground = ground_of(site, bay=bay, plan=plan)
    rng = generator(seed, Step.PLAN)
    if not len(ground.squares) or not len(ground.entrances):
        raise GenerationError("plan", "a site without entrance or free squares", seed=seed, attempts=0)
    board = new_board(ground)
    random = rng.integers(1, 2**63, size=1, dtype=np.uint64)
    by_aisles = uses_aisles(ground, plan)
    learn = learn_aisles if by_aisles else learn_squares
    learnt = learn(ground, board, plan, random, progress)
    ranked = list(learnt.ranked) or _repaired(ground, board, np.zeros(len(ground.squares), dtype=np.bool_))
    if not ranked:
        reason = f"no way over the {len(ground.squares)} free squares joins all {len(ground.portals)} portals"
        raise GenerationError("plan", reason, seed=seed, attempts=plan.episodes)
    best_learnt = _archived(site, ground, board, keeping_rules_first(ground, board, ranked)[0][1])
    met = {lanes.tobytes() for _, lanes in ranked}
    if plan.polishes:
        ranked = local_search(site, ground, board, ranked, plan, bay, random)
    elif any(bay.chosen_sides):
        ranked = least_floor_first(site, ground, keeping_rules_first(ground, board, ranked), bay)
    else:
        ranked = keeping_rules_first(ground, board, ranked)
    archive = tuple(
        _archived(site, ground, board, lanes, is_polished=lanes.tobytes() not in met)
        for _, lanes in ranked[: plan.archive_size]
    )
    chosen = archive[_draw(ground, board, ranked[: len(archive)], plan, rng)]
    gave_way = _check_rules(chosen.structure, ground, plan, seed=seed)
    structure = dimensioned(chosen.structure, bay)
    score = chosen.score if structure is chosen.structure else evaluate(structure, bay=bay, plan=plan)
    return Plan(structure, score, archive, learnt.curve, best_learnt, learnt.steps, gave_way)


def _check_rules(structure: Structure, ground: Ground, plan: PlanConfig, *, seed: int) -> dict[str, str]:
    """List the broken rules of circulation; raise with ``strict``."""
    gave_way = circulation(structure).faults(ground.rules)
    if gave_way and plan.strict:
        reason = f"no plan met keeps the rules of circulation: {'; '.join(gave_way.values())}"
        raise GenerationError("plan", reason, seed=seed, attempts=plan.episodes)
    return gave_way


def _archived(
    site: Structure, ground: Ground, board: Board, lanes: Lanes, *, is_polished: bool = False
) -> ArchivedPlan:
    return ArchivedPlan(site.with_cells(cells_of(ground, lanes)), _score(ground, board, lanes), is_polished)


def _repaired(ground: Ground, board: Board, lanes: Lanes) -> list[Ranked]:
    """Connect lanes and portals by shortest paths; empty if there are none."""
    put_lanes(ground, board, lanes)
    if not connect(ground, board):
        return []
    value = max(measure(ground, board, -np.inf), NO_VALUE)  # without stalls it has no value, but stands
    return [(value, lanes_on(ground, board))]


def _score(ground: Ground, board: Board, lanes: Lanes) -> Score:
    """Score one layout by the compiled loops; `evaluate` gives the same from the structure."""
    put_lanes(ground, board, lanes)
    measure(ground, board, -np.inf)
    stalls, time, unused = board.tally[:3].tolist()
    if stalls == 0:
        return Score(float(ground.weights[2] * unused), 0, 0.0, unused)
    return Score(float(value_now(ground, board)), stalls, time / stalls, unused)


def _draw(ground: Ground, board: Board, ranked: list[Ranked], plan: PlanConfig, rng: np.random.Generator) -> int:
    """Draw a plan of the archive: the first, or any above the quality floor with no more faults."""
    if plan.choice is Choice.BEST:
        return 0
    best = ranked[0][0]
    floor = best - (1 - plan.quality_floor) * abs(best)
    faults = faults_of(ground, board, ranked[0][1])
    eligible = [
        place
        for place, (value, lanes) in enumerate(ranked)
        if value >= floor and faults_of(ground, board, lanes) <= faults
    ]
    return int(rng.choice(eligible))
