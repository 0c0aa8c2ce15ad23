"""The planner: Sarsa on a site, then repair and polish of the best that it met."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from garage2usd.config import BayConfig, PlanConfig
from garage2usd.config.plan import Choice
from garage2usd.errors import GenerationError
from garage2usd.grid import Cell, Structure
from garage2usd.planning.circulation import circulation
from garage2usd.planning.dimensioning import area_per_stall_m2, dimensioned
from garage2usd.planning.ground import Ground, Lanes, cells_of, ground_of, lanes_of
from garage2usd.planning.learner import learn_aisles, learn_squares, uses_aisles
from garage2usd.planning.plan import ArchivedPlan, Plan
from garage2usd.planning.score import Score, evaluate
from garage2usd.progress import Progress, silent
from garage2usd.randomness import Step, generator

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from garage2usd.planning.board import Board
    from garage2usd.planning.sizes import Sizes

__all__ = ["anneal_alone", "plan_lanes"]

_CLIMB_PASSES = 40
_ANNEALED = 6
_ANNEAL_SQUARES, _FULL_EPISODES = 6_000_000, 5000
_SMALL_SQUARES, _ANNEALED_MIDDLE, _ANNEAL_SQUARES_MIDDLE = 120, 4, 48_000_000
_HOTTEST, _COLDEST = 3.0, 0.5
_CLIMB_SQUARES = 40_000_000
_DRIFTED, _DRIFT_FLIPS, _REFRESH_ROUNDS = 2, 1_600_000, 20
_DRIFT_HOTTEST, _DRIFT_HOTTEST_LARGE, _DRIFT_COLDEST = 0.6, 0.3, 0.1
_LARGE_SQUARES = 1000
_LABELLED, _LABELLED_LARGE, _MOST_LABELLED, _LABEL_REFRESH_ROUNDS = 3, 1, 5, 4
_LABEL_TRIALS, _LABEL_TRIALS_A_SQUARE, _LABEL_TRIALS_LARGE = 500_000, 1200, 1_800_000
_LABEL_HEATS, _LABEL_HEATS_LARGE = (0.6, 0.1), (0.2, 0.08)
_LABEL_PRICES, _LABEL_PRICES_LARGE = (4.0, 40.0, 5.0, 20.0), (8.0, 40.0, 8.0, 30.0)
_WHOLE_SQUARES = 250
"""Up to so many squares annealing that judges each flip by the whole plan still gains on what labels reach."""
_FINALISTS, _MOSTLY_COMMON = 12, 0.9
_STALL_M2 = 25.0
"""About the floor that a stall takes in a good plan: the price of floor while plans are polished in metres."""


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
        Told how many episodes are done.

    Returns
    -------
    Plan
        Always feasible: the lanes form one piece and touch every portal.

    Raises
    ------
    GenerationError
        If no lanes can join the portals.

    Notes
    -----
    ``q(S_t, A_t) += alpha (R_{t+1} + gamma q(S_{t+1}, A_{t+1}) - q(S_t, A_t))`` with an epsilon-greedy policy over up,
    down, left, right, stay; on large sites over what becomes of a whole aisle. Deviation: the paper words epsilon
    opposite to its formula; the formula stands. Deviation: by default the agent has the preset ``tuned``: it sees less,
    cannot bump, goes on from what was good before and starts several times, as it finds better plans so; ``paper`` is
    the paper's agent. Deviation: the best plans are polished after learning, unless ``climb`` is false. Deviation:
    where no episode joined all portals, shortest ways between them are the lanes. Deviation: a dead end that is too
    long counts as one stall less when plans are compared (``dead_ends``); the reported score has no such term.
    """
    from garage2usd.planning.board import new_board  # noqa: PLC0415 - only planning pays for the compiler

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
    best_learnt = _archived(site, ground, board, _keeping_rules_first(ground, board, ranked)[0][1])
    met = {lanes.tobytes() for _, lanes in ranked}
    if plan.polishes:
        ranked = _better(site, ground, board, ranked, plan, bay, random)
    elif any(bay.chosen_sides):
        ranked = _by_floor(site, ground, _keeping_rules_first(ground, board, ranked), bay)
    else:
        ranked = _keeping_rules_first(ground, board, ranked)
    archive = tuple(
        _archived(site, ground, board, lanes, is_polished=lanes.tobytes() not in met)
        for _, lanes in ranked[: plan.archive_size]
    )
    chosen = archive[_draw(ranked[: len(archive)], plan, rng)]
    gave_way = _check_rules(chosen.structure, ground, plan, seed=seed)
    structure = dimensioned(chosen.structure, bay)
    score = chosen.score if structure is chosen.structure else evaluate(structure, bay=bay, plan=plan)
    return Plan(structure, score, archive, learnt.curve, best_learnt, learnt.steps, gave_way)


def _check_rules(structure: Structure, ground: Ground, plan: PlanConfig, *, seed: int) -> dict[str, str]:
    """The rules of circulation that a plan breaks, with where; an error with ``strict``."""
    gave_way = circulation(structure).faults(ground.rules)
    if gave_way and plan.strict:
        reason = f"no plan met keeps the rules of circulation: {'; '.join(gave_way.values())}"
        raise GenerationError("plan", reason, seed=seed, attempts=plan.episodes)
    return gave_way


def _better(
    site: Structure,
    ground: Ground,
    board: "Board",
    ranked: list[tuple[float, Lanes]],
    plan: PlanConfig,
    bay: BayConfig,
    random: NDArray[np.uint64],
) -> list[tuple[float, Lanes]]:
    """The plans and what polish makes of the best of them.

    Those that break fewest rules come first, then those with the least floor for a stall where R and C are chosen,
    else those of the highest value.
    """
    from garage2usd.planning.sizes import sizes_of  # noqa: PLC0415

    sizes = sizes_of(ground, bay)
    is_sized = bool(sizes.is_chosen.any())
    if is_sized:
        # polish writes what squares hold by their sides
        ground = ground._replace(capacity=ground.capacity.copy())
        sizes.price[0] = ground.weights[0] / _STALL_M2
    if not uses_aisles(ground, plan):
        polished = _polished(ground, board, sizes, ranked, plan, random)
    elif ground.rules.is_asked or is_sized:
        polished = _labelled(ground, board, sizes, ranked, plan, random)
    else:
        polished = _drifted(ground, board, ranked, plan, random)
    polished = _keeping_rules_first(ground, board, polished)
    return polished if not is_sized else _by_floor(site, ground, polished, bay)


def _keeping_rules_first(
    ground: Ground, board: "Board", ranked: list[tuple[float, Lanes]]
) -> list[tuple[float, Lanes]]:
    """The same, those that break the rules of circulation least often first."""
    return sorted(ranked, key=lambda entry: _faults(ground, board, entry[1])) if ground.rules.is_asked else ranked


def _faults(ground: Ground, board: "Board", lanes: Lanes) -> int:
    """How often lanes break the rules of circulation."""
    from garage2usd.planning.board import FAULTS, measure  # noqa: PLC0415

    _put(ground, board, lanes)
    measure(ground, board)
    return int(board.tally[FAULTS])


def _by_floor(
    site: Structure, ground: Ground, ranked: list[tuple[float, Lanes]], bay: BayConfig
) -> list[tuple[float, Lanes]]:
    """The first few by the rules that they break and their floor for a stall, the rest as they are."""

    def key(entry: tuple[float, Lanes]) -> tuple[int, float, bytes]:
        structure = dimensioned(site.with_cells(cells_of(ground, entry[1])), bay)
        broken = circulation(structure).faults(ground.rules)
        return len(broken), area_per_stall_m2(structure, bay), entry[1].tobytes()

    return [*sorted(ranked[:_FINALISTS], key=key), *ranked[_FINALISTS:]]


def anneal_alone(
    site: Structure, *, plan: PlanConfig, bay: BayConfig, seed: int, starts: "Iterable[Structure]" = ()
) -> Plan:
    """Plan without learning, as a control: repair, climb and anneal given lanes, or shortest ways between the portals.

    Parameters
    ----------
    site, plan, bay, seed
        As for `plan_lanes`; without ``climb`` the given lanes are repaired only.
    starts
        Structures on the site, feasible or not.

    Raises
    ------
    GenerationError
        If no lanes can join the portals.
    """
    from garage2usd.planning.board import new_board  # noqa: PLC0415

    ground = ground_of(site, bay=bay, plan=plan)
    board = new_board(ground)
    random = generator(seed, Step.PLAN).integers(1, 2**63, size=1, dtype=np.uint64)
    empty = np.zeros(len(ground.squares), dtype=np.bool_)
    given = [lanes_of(structure, ground) for structure in starts] or [empty]
    ranked = _ranked(entry for lanes in given for entry in _repaired(ground, board, lanes))
    if not ranked:
        raise GenerationError("plan", "no way joins all portals", seed=seed, attempts=len(given))
    if plan.polishes:
        ranked = _better(site, ground, board, ranked, plan, bay, random)
    archive = tuple(_archived(site, ground, board, lanes) for _, lanes in ranked[: plan.archive_size])
    return Plan(archive[0].structure, archive[0].score, archive)


def _archived(
    site: Structure, ground: Ground, board: "Board", lanes: Lanes, *, is_polished: bool = False
) -> ArchivedPlan:
    return ArchivedPlan(site.with_cells(cells_of(ground, lanes)), _score(ground, board, lanes), is_polished)


def _repaired(ground: Ground, board: "Board", lanes: Lanes) -> list[tuple[float, Lanes]]:
    """Lanes with shortest ways between what is apart, and the portals; empty if there are none."""
    from garage2usd.planning.board import NO_VALUE, measure  # noqa: PLC0415
    from garage2usd.planning.polish import connect  # noqa: PLC0415

    _put(ground, board, lanes)
    if not connect(ground, board):
        return []
    value = max(measure(ground, board), NO_VALUE)  # without stalls it has no value, but stands
    return [(value, _taken(ground, board))]


def _polished(
    ground: Ground,
    board: "Board",
    sizes: "Sizes",
    ranked: list[tuple[float, Lanes]],
    plan: PlanConfig,
    random: NDArray[np.uint64],
) -> list[tuple[float, Lanes]]:
    """The best climbed by flips, the best of those annealed, and the rest as they were; best first."""
    from garage2usd.planning.polish import climb  # noqa: PLC0415

    ranked = _valued(ground, board, sizes, ranked)
    affordable = max(1, _CLIMB_SQUARES // (20 * len(ground.squares) ** 2))
    count = min(plan.climb_top, affordable)
    ranked = _improved(
        ground, board, ranked, ranked[:count], lambda: climb(ground, board, sizes, random, _CLIMB_PASSES)
    )
    return _annealed(ground, board, sizes, ranked, plan, random)


def _annealed(
    ground: Ground,
    board: "Board",
    sizes: "Sizes",
    ranked: list[tuple[float, Lanes]],
    plan: PlanConfig,
    random: NDArray[np.uint64],
) -> list[tuple[float, Lanes]]:
    """The best annealed, each flip judged by the whole plan, and the rest as they were; best first."""
    from garage2usd.planning.polish import anneal  # noqa: PLC0415

    squares = len(ground.squares)
    is_small = squares <= _SMALL_SQUARES
    count = _ANNEALED if is_small else _ANNEALED_MIDDLE
    if sizes.is_chosen.any():
        count //= 2
    work = _ANNEAL_SQUARES if is_small else _ANNEAL_SQUARES_MIDDLE
    flips = int(work * min(1.0, plan.episodes / _FULL_EPISODES)) // squares
    starts = ranked[:count] if is_small else _apart(ranked, count)
    return _improved(
        ground, board, ranked, starts, lambda: anneal(ground, board, sizes, random, flips, _HOTTEST, _COLDEST)
    )


def _improved(
    ground: Ground,
    board: "Board",
    ranked: list[tuple[float, Lanes]],
    starts: list[tuple[float, Lanes]],
    polish: "Callable[[], float]",
) -> list[tuple[float, Lanes]]:
    """What polish makes of some plans, and all plans as they were; best first."""
    best = {lanes.tobytes(): (value, lanes) for value, lanes in ranked}
    for _, lanes in starts:
        _put(ground, board, lanes)
        value = polish()
        improved = _taken(ground, board)
        best.setdefault(improved.tobytes(), (value, improved))
    return _ranked(best.values())


def _valued(
    ground: Ground, board: "Board", sizes: "Sizes", ranked: list[tuple[float, Lanes]]
) -> list[tuple[float, Lanes]]:
    """The same with their values in the sides that suit each; best first."""
    from garage2usd.planning.polish import settled_worth  # noqa: PLC0415

    valued = []
    for _, lanes in ranked:
        _put(ground, board, lanes)
        valued.append((settled_worth(ground, board, sizes), lanes))
    return _ranked(valued)


def _labelled(
    ground: Ground,
    board: "Board",
    sizes: "Sizes",
    ranked: list[tuple[float, Lanes]],
    plan: PlanConfig,
    random: NDArray[np.uint64],
) -> list[tuple[float, Lanes]]:
    """The best annealed under the rules of circulation, and the rest as they were; best first."""
    from garage2usd.planning.circuit import anneal_labels, new_draft  # noqa: PLC0415

    draft = new_draft(ground)
    ranked = _valued(ground, board, sizes, ranked)
    squares = len(ground.squares)
    trials = min(max(_LABEL_TRIALS, _LABEL_TRIALS_A_SQUARE * squares), _LABEL_TRIALS_LARGE)
    trials = int(trials * min(1.0, plan.episodes / _FULL_EPISODES))
    is_large = squares >= _LARGE_SQUARES
    count = _LABELLED_LARGE if is_large else _LABELLED
    heats = _LABEL_HEATS_LARGE if is_large else _LABEL_HEATS
    prices = _LABEL_PRICES_LARGE if is_large else _LABEL_PRICES
    refresh = _LABEL_REFRESH_ROUNDS * squares
    polished = ranked
    for number, start in enumerate(_apart(ranked, _MOST_LABELLED)):
        # more starts only where none has come to keep the rules
        if number >= count and not min(_faults(ground, board, lanes) for _, lanes in polished):
            break
        polished = _improved(
            ground,
            board,
            polished,
            [start],
            lambda: anneal_labels(ground, board, draft, sizes, random, trials, heats, prices, refresh),
        )
    if squares > _WHOLE_SQUARES or sizes.is_chosen.any():
        return polished
    return _ranked([*polished, *_annealed(ground, board, sizes, ranked, plan, random)])


def _apart(ranked: list[tuple[float, Lanes]], count: int) -> list[tuple[float, Lanes]]:
    """The best few plans of which no two have most lanes in common, then the best of the rest."""
    chosen: list[tuple[float, Lanes]] = []
    for entry in ranked:
        common = max((int((entry[1] & lanes).sum()) / max(1, int(lanes.sum())) for _, lanes in chosen), default=0.0)
        if common < _MOSTLY_COMMON:
            chosen.append(entry)
        if len(chosen) == count:
            break
    return chosen


def _drifted(
    ground: Ground, board: "Board", ranked: list[tuple[float, Lanes]], plan: PlanConfig, random: NDArray[np.uint64]
) -> list[tuple[float, Lanes]]:
    """The best annealed with flips judged by what is around them, and the rest as they were; best first."""
    from garage2usd.planning.drift import drift  # noqa: PLC0415

    best = {lanes.tobytes(): (value, lanes) for value, lanes in ranked}
    flips = int(_DRIFT_FLIPS * min(1.0, plan.episodes / _FULL_EPISODES))
    refresh = _REFRESH_ROUNDS * len(ground.squares)
    hottest = _DRIFT_HOTTEST if len(ground.squares) < _LARGE_SQUARES else _DRIFT_HOTTEST_LARGE
    for _, lanes in ranked[:_DRIFTED]:
        _put(ground, board, lanes)
        value = drift(ground, board, random, flips, hottest, _DRIFT_COLDEST, refresh)
        improved = _taken(ground, board)
        best.setdefault(improved.tobytes(), (value, improved))
    return _ranked(best.values())


def _ranked(plans: "Iterable[tuple[float, Lanes]]") -> list[tuple[float, Lanes]]:
    """Each once, best first; equal values by their lanes, so that no order of meeting matters."""
    return sorted(
        {lanes.tobytes(): (value, lanes) for value, lanes in plans}.values(),
        key=lambda entry: (-entry[0], entry[1].tobytes()),
    )


def _taken(ground: Ground, board: "Board") -> Lanes:
    """The lanes on the board."""
    lanes: Lanes = board.cells[ground.squares] == Cell.LANE
    return lanes


def _put(ground: Ground, board: "Board", lanes: Lanes) -> None:
    """Have these lanes on the board and no others; keeps no tally."""
    board.cells[:] = ground.cells
    board.cells[ground.squares[lanes]] = Cell.LANE


def _score(ground: Ground, board: "Board", lanes: Lanes) -> Score:
    """The compiled score of one layout; `evaluate` gives the same from the structure."""
    from garage2usd.planning.board import measure, value_now  # noqa: PLC0415

    _put(ground, board, lanes)
    measure(ground, board)
    stalls, time, unused = board.tally[:3].tolist()
    if stalls == 0:
        return Score(float(ground.weights[2] * unused), 0, 0.0, unused)
    return Score(float(value_now(ground, board)), stalls, time / stalls, unused)


def _draw(ranked: list[tuple[float, Lanes]], plan: PlanConfig, rng: np.random.Generator) -> int:
    """Which plan of the archive is taken: the best, or any above the quality floor."""
    if plan.choice is Choice.BEST:
        return 0
    best = ranked[0][0]
    floor = best - (1 - plan.quality_floor) * abs(best)
    return int(rng.integers(sum(value >= floor for value, _ in ranked)))
