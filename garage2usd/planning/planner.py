"""The planner and its plans: Sarsa on a site, then local search from the best plans."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.errors import GenerationError
from garage2usd.common.package import drawn_by
from garage2usd.common.progress import Progress, silent
from garage2usd.common.randomness import Step, generator
from garage2usd.config import BayConfig, GarageConfig, PlanConfig
from garage2usd.config.plan import Choice
from garage2usd.planning.board import (
    NO_VALUE,
    Board,
    Ground,
    Lanes,
    cells_of,
    connect,
    faults_of,
    ground_of,
    lanes_of,
    lanes_on,
    measure,
    new_board,
    put_lanes,
    value_now,
)
from garage2usd.planning.circulation import circulation, rules_of
from garage2usd.planning.dimensions import dimensioned
from garage2usd.planning.learner import learn_aisles, learn_squares, uses_aisles
from garage2usd.planning.local_search import (
    Ranked,
    keeping_rules_first,
    least_floor_first,
    local_search,
    ranked_plans,
)
from garage2usd.planning.score import Score, evaluate
from garage2usd.structure.grid import Cell, Structure
from garage2usd.structure.lanes import BOTH_WAYS, LaneDirections, stretches_of
from garage2usd.structure.stall_runs import StallRun


@dataclass(frozen=True, eq=False)
class ArchivedPlan:
    """One of the best plans found.

    Attributes
    ----------
    structure, score
        The plan and its figures, on the squares' sides that it was learnt with.
    is_polished
        True if local search found it, rather than learning.
    """

    structure: Structure
    score: Score
    is_polished: bool = False


@dataclass(frozen=True, eq=False)
class Plan:
    """A complete structure with its score and the record of its planning.

    Attributes
    ----------
    structure
        S with lanes; every portal touches them and they form one piece, unless the user gave it otherwise.
    score
        Its figures.
    archive
        Best distinct plans, best first; empty for a given structure.
    learning_curve
        float64, shape (episodes,): G, the sum of the rewards of each episode without R_T; read-only.
    learnt
        Best plan of learning alone; None for a given structure.
    steps
        Actions taken while learning.
    gave_way
        Broken rules of circulation by name, each with place and amount.
    runs
        Kinds and sizes of the stalls, run by run; empty if all are perpendicular and of the standard size.
    directions
        One-way lanes.
    """

    structure: Structure
    score: Score
    archive: tuple[ArchivedPlan, ...] = ()
    learning_curve: NDArray[np.float64] = field(default_factory=lambda: np.zeros(0))
    learnt: ArchivedPlan | None = None
    steps: int = 0
    gave_way: Mapping[str, str] = field(default_factory=dict)
    runs: tuple[StallRun, ...] = ()
    directions: LaneDirections = BOTH_WAYS

    _repr_svg_ = drawn_by("garage2usd.view.notebook", "plan_svg")

    @property
    def stretches(self) -> tuple[tuple[tuple[int, int], ...], ...]:
        """Squares of each stretch of lane from one junction or dead end to the next, in reading order."""
        return stretches_of(self.structure)

    @property
    def one_way_stretches(self) -> tuple[tuple[tuple[int, int], ...], ...]:
        """Squares of each one-way stretch in the direction of driving, in reading order."""
        return self.directions.stretches(self.structure)

    def __repr__(self) -> str:
        """Return the size, the number of stalls and the score."""
        rows, cols = self.structure.shape
        return f"<Plan of {rows} x {cols} squares with {self.score.stalls} stalls, score {self.score.value:.2f}>"

    def __post_init__(self) -> None:
        """Keep read-only copies of the curve and of the rules that gave way."""
        curve = np.array(self.learning_curve, dtype=np.float64)
        curve.setflags(write=False)
        object.__setattr__(self, "learning_curve", curve)
        object.__setattr__(self, "gave_way", MappingProxyType(dict(self.gave_way)))

    def __reduce__(self) -> tuple[object, ...]:
        """Pickle the fields: read-only mappings cannot be pickled, and arrays forget that they are read-only."""
        fields = self.structure, self.score, self.archive, self.learning_curve, self.learnt, self.steps
        return type(self), (*fields, dict(self.gave_way), self.runs, self.directions)


def given_plan(structure: Structure, *, bay: BayConfig, plan: PlanConfig | None = None) -> Plan:
    """Wrap a complete structure as a plan; `plan` gives the weights of its score.

    R and C are chosen for them where the settings say so and give none.
    """
    sized = dimensioned(structure, bay)
    return Plan(sized, evaluate(sized, bay=bay, plan=plan))


def plan_lanes(
    site: Structure,
    *,
    plan: PlanConfig,
    bay: BayConfig,
    seed: int,
    start: Structure | None = None,
    progress: Progress = silent,
) -> Plan:
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
    start
        Lanes on as many squares, for example of the level above, from which local search begins as well.
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
    down, left, right, stay; on large sites over whole aisles. Deviation: in the paper text and formula of epsilon
    differ; the formula is used. Deviation: by default the agent has the preset ``tuned``: it sees less, cannot bump,
    continues from earlier good episodes and starts several times, which finds better plans; ``paper`` is the paper's
    agent. Deviation: local search polishes the best plans after learning, unless ``climb`` is false.
    Deviation: where no episode joined all portals, shortest paths between them are the lanes. Deviation: plans keep
    rules of circulation (``circulation``): broken rules cost stalls when plans are compared, and plans that keep the
    rules come first; the reported score has no such term. Deviation: where R and C are chosen, plans are compared by
    their floor per stall.
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
    if start is not None and plan.polishes:
        ranked = ranked_plans([*ranked, *_repaired(ground, board, lanes_of(start, ground))])
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


def alternatives(plan: Plan, config: GarageConfig) -> Iterator[Plan]:
    """Yield a plan of lanes, and the others of its archive that break no more rules of circulation.

    With a choice other than the best plan there are none but the plan itself.
    """
    yield plan
    if config.plan.choice is not Choice.BEST:
        return
    free = (plan.structure.cells == Cell.FREE) | (plan.structure.cells == Cell.LANE)
    rules = rules_of(config.plan, squares=int(free.sum()))
    for archived in plan.archive[1:]:
        structure = dimensioned(archived.structure, config.bay)
        gave_way = circulation(structure).faults(rules)
        if len(gave_way) <= len(plan.gave_way):
            score = evaluate(structure, bay=config.bay, plan=config.plan)
            yield replace(plan, structure=structure, score=score, gave_way=gave_way)


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
    value = max(measure(ground, board, -np.inf), NO_VALUE)  # a plan without stalls is kept although it has no value
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
