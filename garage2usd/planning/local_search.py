"""Local search from the best plans of learning: hill climbing and simulated annealing, in squares or in metres."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray

from garage2usd.config import BayConfig, PlanConfig
from garage2usd.planning.annealing import (
    Workspace,
    anneal_flips,
    anneal_labels,
    improve,
    new_trial_move,
    new_workspace,
)
from garage2usd.planning.board import Board, Ground, Lanes, cells_of, faults_of, lanes_on, put_lanes
from garage2usd.planning.circulation import circulation
from garage2usd.planning.dimensions import Sizes, area_per_stall_m2, dimensioned, sizes_of
from garage2usd.planning.learner import uses_aisles
from garage2usd.structure.grid import Structure

Ranked = tuple[float, Lanes]
"""A plan with its value."""

_FINALISTS, _MOSTLY_COMMON = 12, 0.9
"""Plans that are dimensioned to be compared in metres, which takes time; common share of lanes of plans too alike."""

_FULL_EPISODES = 5000
"""The default, and the paper's; fewer episodes shorten local search in proportion."""

_STALL_M2 = 25.0
"""About the floor that a stall takes in a good plan: the price of floor in metres."""

_SMALL_SQUARES, _WHOLE_SQUARES, _LARGE_SQUARES = 120, 250, 1000
"""Free squares up to which a site is small, up to which annealing that judges each flip by the whole plan still gains
on what labels reach, and from which on it is large."""

# Hill climbing ends at a local optimum, or after this many passes over all squares. A plan of n squares takes about
# 20 n^2 measurements of squares, whose number bounds the time on larger sites.
_CLIMB_PASSES, _CLIMB_SQUARES = 40, 40_000_000

# Annealing of whole plans: number of plans, flips times squares (which bounds the time on any site), and first and last
# temperature in stalls. Measured on 40 sites of 12x16 equal squares, where most flips are judged by their surroundings:
# the 24 middle ones have 244.4 stalls in the mean (243.5 with half the flips at 3.0 to 0.6; 243.6 with half the flips
# at these temperatures), the 16 small ones 187.7 (186.8 with a third of the flips at 3.0 to 0.3; 187.3 with all flips).
_ANNEALED, _ANNEALED_MIDDLE = (12, 15_000_000, (1.5, 0.4)), (6, 96_000_000, (1.5, 0.5))

# The same with R and C chosen, where each flip takes longer. 80 sites of 7x9 have 29.00 m2 per stall; 29.03 with five
# plans; 29.18 with the three best plans at 3.0 to 0.5 and sizes from the shortest stalls alone.
_ANNEALED_SIZED, _ANNEALED_SIZED_MIDDLE = (6, 5_000_000, (3.0, 0.3)), (3, 16_000_000, (3.0, 0.6))

# Flips per square after which annealing has converged on the smallest sites. With this bound and a tenth of the
# episodes, planning 300 sites of 5x5 to 7x7 squares takes 0.6 of the time; the floor per stall changes on ten of them,
# and falls on seven.
_SIZED_FLIPS_A_SQUARE = 2000

# Annealing under the rules of circulation: number of runs (more until a plan keeps the rules), and of moves in each.
# Large sites have fewer runs and at most 800,000 moves, so that planning takes at most twice as long as without rules.
# On 4 sites of 40x60 the rules R1 to R3 cost 3.2 % of the stalls, and 3.3 % with half the moves.
_LABELLED, _LABELLED_LARGE, _MOST_LABELLED = 6, 3, 10
_LABEL_TRIALS_A_SQUARE, _LABEL_TRIALS, _LABEL_REFRESH_ROUNDS = 600, (250_000, 800_000), 4
_LABEL_HEATS, _LABEL_PRICES = (0.6, 0.1), ((8.0, 40.0, 8.0, 30.0), (4.0, 40.0, 5.0, 20.0))
"""Temperatures, as in the prototype, and prices of faults, which alternate from run to run, because the better ones
differ from site to site."""

# Annealing without rules: flips are judged by the distances of the last measurement, which is repeated after this many
# rounds over the squares. Large sites, whose plans are closer to the bound, start at a lower temperature.
_FLIPPED, _FLIPS, _REFRESH_ROUNDS = 2, 1_600_000, 20
_FLIP_HOTTEST, _FLIP_HOTTEST_LARGE, _FLIP_COLDEST = 0.6, 0.3, 0.1


def local_search(
    site: Structure,
    ground: Ground,
    board: Board,
    ranked: list[Ranked],
    plan: PlanConfig,
    bay: BayConfig,
    random: NDArray[np.uint64],
) -> list[Ranked]:
    """Improve the best plans; returns all plans, as they were and improved.

    Plans with the fewest broken rules come first, then the least floor for a stall where R and C are chosen, else the
    highest value.
    """
    sizes = sizes_of(ground, bay)
    is_sized = bool(sizes.is_chosen.any())
    if is_sized:
        # the capacity of squares changes with their sides
        ground = ground._replace(capacity=ground.capacity.copy())
        sizes.price[0] = ground.weights[0] / _STALL_M2
    search = LocalSearch(ground, board, sizes, random, min(1.0, plan.episodes / _FULL_EPISODES))
    if not uses_aisles(ground, plan):
        ranked = search.annealed_whole(search.climbed(search.valued(ranked), plan.climb_top))
    elif not ground.rules.is_asked and not is_sized:
        ranked = search.annealed_by_flips(ranked)
    else:
        is_middle = len(ground.squares) <= _WHOLE_SQUARES
        ranked = search.valued(ranked)
        if is_middle:
            ranked = search.valued(search.annealed_whole(ranked))
        if not is_middle or is_sized or faults_of(ground, board, ranked[0][1]):
            ranked = search.annealed_by_labels(ranked)
    ranked = keeping_rules_first(ground, board, ranked)
    return least_floor_first(site, ground, ranked, bay) if is_sized else ranked


@dataclass(frozen=True, eq=False)
class LocalSearch:
    """Optimisers of the plans of one site.

    Attributes
    ----------
    ground, board, sizes, random
        The site, a board for its lanes, the sides of its squares, and the state of the random numbers.
    effort
        Share of the full number of moves.
    """

    ground: Ground
    board: Board
    sizes: Sizes
    random: NDArray[np.uint64]
    effort: float

    @cached_property
    def squares(self) -> int:
        """Number of free squares."""
        return len(self.ground.squares)

    @cached_property
    def room(self) -> Workspace:
        """Workspace of the loops in C."""
        return new_workspace(self.ground, self.sizes)

    @cached_property
    def is_sized(self) -> bool:
        """True if R or C is chosen with the plan."""
        return bool(self.sizes.is_chosen.any())

    def valued(self, ranked: list[Ranked]) -> list[Ranked]:
        """Value each plan with the sides that suit it best; best first."""

        def value(lanes: Lanes) -> float:
            put_lanes(self.ground, self.board, lanes)
            return self._improve()

        return ranked_plans([(value(lanes), lanes) for _, lanes in ranked])

    def climbed(self, ranked: list[Ranked], count: int) -> list[Ranked]:
        """Climb from the best plans by flips, as many as are affordable; best first."""
        affordable = max(1, _CLIMB_SQUARES // (20 * self.squares**2))
        climbing = partial(self._improve, passes=_CLIMB_PASSES)
        return self._improved(ranked, ranked[: min(count, affordable)], climbing)

    def annealed_whole(self, ranked: list[Ranked]) -> list[Ranked]:
        """Anneal the best plans by flips, each judged by the whole plan; best first."""
        is_small = self.squares <= _SMALL_SQUARES
        small, middle = (_ANNEALED_SIZED, _ANNEALED_SIZED_MIDDLE) if self.is_sized else (_ANNEALED, _ANNEALED_MIDDLE)
        count, work, heats = small if is_small else middle
        flips = int(work * self.effort) // self.squares
        if self.is_sized:
            flips = min(flips, int(_SIZED_FLIPS_A_SQUARE * self.effort * self.squares))
        annealing = partial(self._improve, flips=flips, heats=heats)
        return self._improved(ranked, distinct_plans(ranked, count), annealing)

    def _improve(self, *, passes: int = 0, flips: int = 0, heats: tuple[float, float] = (1.0, 1.0)) -> float:
        """Climb and anneal from the lanes on the board; return the value."""
        return improve(self.ground, self.board, self.sizes, self.room, self.random, passes, flips, *heats)

    def annealed_by_labels(self, ranked: list[Ranked]) -> list[Ranked]:
        """Anneal the best plans under the rules of circulation by labelled moves; best first."""
        move = new_trial_move(self.ground)
        trials = int(np.clip(_LABEL_TRIALS_A_SQUARE * self.squares, *_LABEL_TRIALS) * self.effort)
        if self.is_sized:  # a trial then takes longer
            trials //= 2
        refresh = _LABEL_REFRESH_ROUNDS * self.squares
        count = _LABELLED_LARGE if self.squares >= _LARGE_SQUARES else _LABELLED
        starts = distinct_plans(ranked, count)
        for number in range(_MOST_LABELLED):
            # go on only if no plan keeps the rules yet
            if number >= count and not min(faults_of(self.ground, self.board, lanes) for _, lanes in ranked):
                break
            prices = _LABEL_PRICES[number % len(_LABEL_PRICES)]
            annealing = partial(
                anneal_labels, self.ground, self.board, move, self.sizes, self.room, self.random,
                trials, np.array(_LABEL_HEATS), np.array(prices), refresh,
            )  # fmt: skip
            ranked = self._improved(ranked, [starts[number % len(starts)]], annealing)
        return ranked

    def annealed_by_flips(self, ranked: list[Ranked]) -> list[Ranked]:
        """Anneal the best plans by flips, each judged by the squares around it; best first."""
        hottest = _FLIP_HOTTEST if self.squares < _LARGE_SQUARES else _FLIP_HOTTEST_LARGE
        flips, refresh = int(_FLIPS * self.effort), _REFRESH_ROUNDS * self.squares
        annealing = partial(
            anneal_flips, self.ground, self.board, self.room.cells, self.random, flips, hottest, _FLIP_COLDEST, refresh
        )
        return self._improved(ranked, ranked[:_FLIPPED], annealing)

    def _improved(self, ranked: list[Ranked], starts: list[Ranked], improve: Callable[[], float]) -> list[Ranked]:
        """Improve some plans, and keep all as they were; best first."""
        best = {lanes.tobytes(): (value, lanes) for value, lanes in ranked}
        for _, lanes in starts:
            put_lanes(self.ground, self.board, lanes)
            value = improve()
            improved = lanes_on(self.ground, self.board)
            best.setdefault(improved.tobytes(), (value, improved))
        return ranked_plans(best.values())


def ranked_plans(plans: Iterable[Ranked]) -> list[Ranked]:
    """Rank distinct plans, best first; ties by their lanes, so that the order of discovery does not matter."""
    return sorted(
        {lanes.tobytes(): (value, lanes) for value, lanes in plans}.values(),
        key=lambda entry: (-entry[0], entry[1].tobytes()),
    )


def keeping_rules_first(ground: Ground, board: Board, ranked: list[Ranked]) -> list[Ranked]:
    """Sort plans by their faults against the rules of circulation; the order within stays."""
    return sorted(ranked, key=lambda entry: faults_of(ground, board, entry[1])) if ground.rules.is_asked else ranked


def least_floor_first(site: Structure, ground: Ground, ranked: list[Ranked], bay: BayConfig) -> list[Ranked]:
    """Sort the first few plans by broken rules, then by floor for a stall; the rest stay."""

    def key(entry: Ranked) -> tuple[int, float, bytes]:
        structure = dimensioned(site.with_cells(cells_of(ground, entry[1])), bay)
        broken = circulation(structure).faults(ground.rules)
        return len(broken), area_per_stall_m2(structure, bay), entry[1].tobytes()

    return [*sorted(ranked[:_FINALISTS], key=key), *ranked[_FINALISTS:]]


def distinct_plans(ranked: list[Ranked], count: int) -> list[Ranked]:
    """Pick the best few plans of which no two have most lanes in common."""
    chosen: list[Ranked] = []
    for entry in ranked:
        common = max((int((entry[1] & lanes).sum()) / max(1, int(lanes.sum())) for _, lanes in chosen), default=0.0)
        if common < _MOSTLY_COMMON:
            chosen.append(entry)
        if len(chosen) == count:
            break
    return chosen
