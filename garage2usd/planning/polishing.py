"""Polish of the best plans that learning met: climbing and annealing, on equal squares or in metres."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from garage2usd.config import BayConfig, PlanConfig
from garage2usd.grid import Structure
from garage2usd.planning.ground import Ground
from garage2usd.planning.learner import uses_aisles
from garage2usd.planning.ranking import (
    Ranked,
    apart,
    faults_of,
    keeping_rules_first,
    lanes_on,
    least_floor_first,
    put_lanes,
    ranked_plans,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from garage2usd.planning.board import Board
    from garage2usd.planning.sizes import Sizes

__all__ = ["polish"]

_FULL_EPISODES = 5000
"""With fewer episodes there is less polish in proportion."""

_STALL_M2 = 25.0
"""About the floor that a stall takes in a good plan: the price of floor in metres."""

_SMALL_SQUARES, _WHOLE_SQUARES, _LARGE_SQUARES = 120, 250, 1000
"""Free squares up to which a site is small, up to which annealing that judges each flip by the whole plan still gains
on what labels reach, and from which on it is large."""

# hill climbing: passes over all squares, and the measured squares that one plan may take
_CLIMB_PASSES, _CLIMB_SQUARES = 40, 40_000_000

# annealing of whole plans: how many plans, and their flips times squares; heats are in stalls
_ANNEALED, _ANNEAL_SQUARES = 6, 6_000_000
_ANNEALED_MIDDLE, _ANNEAL_SQUARES_MIDDLE = 4, 48_000_000
_HOTTEST, _COLDEST = 3.0, 0.5

# annealing under rules: how many plans, more while none keeps the rules, and how many moves; large plans stay cooler
_LABELLED, _LABELLED_LARGE, _MOST_LABELLED = 3, 1, 5
_LABEL_TRIALS, _LABEL_TRIALS_A_SQUARE, _LABEL_TRIALS_LARGE, _LABEL_REFRESH_ROUNDS = 500_000, 1200, 1_800_000, 4
_LABEL_HEATS, _LABEL_HEATS_LARGE = (0.6, 0.1), (0.2, 0.08)
_LABEL_PRICES, _LABEL_PRICES_LARGE = (4.0, 40.0, 5.0, 20.0), (8.0, 40.0, 8.0, 30.0)

# annealing without rules
_DRIFTED, _DRIFT_FLIPS, _REFRESH_ROUNDS = 2, 1_600_000, 20
_DRIFT_HOTTEST, _DRIFT_HOTTEST_LARGE, _DRIFT_COLDEST = 0.6, 0.3, 0.1


def polish(
    site: Structure,
    ground: Ground,
    board: "Board",
    ranked: list[Ranked],
    plan: PlanConfig,
    bay: BayConfig,
    random: NDArray[np.uint64],
) -> list[Ranked]:
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
    polished = keeping_rules_first(ground, board, polished)
    return polished if not is_sized else least_floor_first(site, ground, polished, bay)


def _polished(
    ground: Ground,
    board: "Board",
    sizes: "Sizes",
    ranked: list[Ranked],
    plan: PlanConfig,
    random: NDArray[np.uint64],
) -> list[Ranked]:
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
    ranked: list[Ranked],
    plan: PlanConfig,
    random: NDArray[np.uint64],
) -> list[Ranked]:
    """The best annealed, each flip judged by the whole plan, and the rest as they were; best first."""
    from garage2usd.planning.polish import anneal  # noqa: PLC0415

    squares = len(ground.squares)
    is_small = squares <= _SMALL_SQUARES
    count = _ANNEALED if is_small else _ANNEALED_MIDDLE
    if sizes.is_chosen.any():
        count //= 2
    work = _ANNEAL_SQUARES if is_small else _ANNEAL_SQUARES_MIDDLE
    flips = int(work * min(1.0, plan.episodes / _FULL_EPISODES)) // squares
    starts = ranked[:count] if is_small else apart(ranked, count)
    return _improved(
        ground, board, ranked, starts, lambda: anneal(ground, board, sizes, random, flips, _HOTTEST, _COLDEST)
    )


def _improved(
    ground: Ground,
    board: "Board",
    ranked: list[Ranked],
    starts: list[Ranked],
    polish: "Callable[[], float]",
) -> list[Ranked]:
    """What polish makes of some plans, and all plans as they were; best first."""
    best = {lanes.tobytes(): (value, lanes) for value, lanes in ranked}
    for _, lanes in starts:
        put_lanes(ground, board, lanes)
        value = polish()
        improved = lanes_on(ground, board)
        best.setdefault(improved.tobytes(), (value, improved))
    return ranked_plans(best.values())


def _valued(ground: Ground, board: "Board", sizes: "Sizes", ranked: list[Ranked]) -> list[Ranked]:
    """The same with their values in the sides that suit each; best first."""
    from garage2usd.planning.polish import settled_worth  # noqa: PLC0415

    valued = []
    for _, lanes in ranked:
        put_lanes(ground, board, lanes)
        valued.append((settled_worth(ground, board, sizes), lanes))
    return ranked_plans(valued)


def _labelled(
    ground: Ground,
    board: "Board",
    sizes: "Sizes",
    ranked: list[Ranked],
    plan: PlanConfig,
    random: NDArray[np.uint64],
) -> list[Ranked]:
    """The best annealed under the rules of circulation, and the rest as they were; best first."""
    from garage2usd.planning.circuit import anneal_labels  # noqa: PLC0415
    from garage2usd.planning.draft import new_draft  # noqa: PLC0415

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
    for number, start in enumerate(apart(ranked, _MOST_LABELLED)):
        # more starts only where none has come to keep the rules
        if number >= count and not min(faults_of(ground, board, lanes) for _, lanes in polished):
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
    return ranked_plans([*polished, *_annealed(ground, board, sizes, ranked, plan, random)])


def _drifted(
    ground: Ground, board: "Board", ranked: list[Ranked], plan: PlanConfig, random: NDArray[np.uint64]
) -> list[Ranked]:
    """The best annealed with flips judged by what is around them, and the rest as they were; best first."""
    from garage2usd.planning.drift import drift  # noqa: PLC0415

    best = {lanes.tobytes(): (value, lanes) for value, lanes in ranked}
    flips = int(_DRIFT_FLIPS * min(1.0, plan.episodes / _FULL_EPISODES))
    refresh = _REFRESH_ROUNDS * len(ground.squares)
    hottest = _DRIFT_HOTTEST if len(ground.squares) < _LARGE_SQUARES else _DRIFT_HOTTEST_LARGE
    for _, lanes in ranked[:_DRIFTED]:
        put_lanes(ground, board, lanes)
        value = drift(ground, board, random, flips, hottest, _DRIFT_COLDEST, refresh)
        improved = lanes_on(ground, board)
        best.setdefault(improved.tobytes(), (value, improved))
    return ranked_plans(best.values())
