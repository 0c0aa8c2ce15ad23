"""What each optimiser of the planner is worth: plans of held-out sites with all of them, and with each left out."""

import statistics
import time
from collections.abc import Callable, Iterator
from typing import NamedTuple
from unittest.mock import patch

from annealing import anneal_alone

from garage2usd.config import BayConfig, PlanConfig, SiteConfig
from garage2usd.planning import Plan, area_per_stall_m2, find_optimum, given_plan, plan_lanes
from garage2usd.planning.local_search import LocalSearch, Ranked
from garage2usd.site import make_site
from garage2usd.structure.grid import Structure

__all__ = ["optimisers"]

FIRST_SEED = 71_125_000
"""Seeds from it on are held out: nothing was tuned on them."""
WORTH_PERCENT, TIME_PERCENT = 0.2, 10.0
"""An optimiser does not pay that gains less than this share of the stalls for more than this share of the time."""
ROUNDING = 1e-6

IRREGULAR = {"min_fill": 0.55, "min_obstacle_distance_cells": 4, "min_portal_distance_cells": 8}
SIZES: dict[str, tuple[int, dict[str, object]]] = {
    "7 x 9": (24, {"height_cells": 7, "width_cells": 9}),
    "12 x 16": (8, {"height_cells": 12, "width_cells": 16, "rectangles": 5, "obstacles": 3, **IRREGULAR}),
    "24 x 32": (8, {"height_cells": 24, "width_cells": 32, "rectangles": 5, "obstacles": 6, **IRREGULAR}),
}
"""How many sites of each size, and their settings."""
EQUAL = BayConfig(dimensioned=False)
SETTINGS: dict[str, tuple[PlanConfig, BayConfig]] = {
    "rules, equal squares": (PlanConfig(), EQUAL),
    "rules, R and C chosen": (PlanConfig(), BayConfig()),
    "no rules, equal squares": (PlanConfig(circulation="allow", dead_ends="allow"), EQUAL),
}
STEPS = {
    "hill climbing": "climbed",
    "annealing by whole plans": "annealed_whole",
    "annealing of flips": "annealed_by_flips",
    "annealing by labels": "annealed_by_labels",
}
"""The methods of `LocalSearch`."""

Planner = Callable[[Structure, PlanConfig, BayConfig, int], Plan]


class Figures(NamedTuple):
    """Stalls, floor for a stall and y' of a plan, and seconds of CPU that it took."""

    stalls: float
    m2_per_stall: float
    score: float
    seconds: float


def optimisers() -> str:
    """One row for each optimiser that takes part in plans of a size under some settings."""
    rows = [
        f"## Optimisers on {sum(count for count, _ in SIZES.values())} held-out sites, with and without",
        "",
        (
            "Means over the sites of plans with all optimisers, and of plans with one left out; its gain in stalls, or "
            "in floor for a stall where R and C are chosen; its share of the seconds of CPU. Without learning, local "
            "search starts from shortest paths between the portals; without local search, the best plan learnt is "
            f"taken. An optimiser pays that gains {WORTH_PERCENT} % or takes at most {TIME_PERCENT:.0f} % of the time. "
            "Beside the gain: the numbers of sites with a gain and with a loss."
        ),
        "",
        (
            "| site | settings | left out | stalls, with | without | m2 a stall, with | without | y', with | without "
            "| gain; sites + / - | seconds, with | without | share of time | pays |"
        ),
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|",
    ]
    for size in SIZES:
        for setting in SETTINGS:
            rows += _rows(size, setting)
    return "\n".join([*rows, "", *_exact()])


def _rows(size: str, setting: str) -> Iterator[str]:
    used: set[str] = set()
    whole = _made(size, setting, _noting(used))
    all_in = _mean(whole)
    left_out = {name: _without(step) for name, step in STEPS.items() if step in used}
    for name, planner in {"learning": _unlearnt, **left_out, "local search": _unimproved}.items():
        made = _made(size, setting, planner)
        less = _mean(made)
        is_sized = setting == "rules, R and C chosen"
        gain = less.m2_per_stall / all_in.m2_per_stall - 1 if is_sized else all_in.stalls / less.stalls - 1
        share = 100 * (1 - less.seconds / all_in.seconds)
        pays = 100 * gain >= WORTH_PERCENT or share <= TIME_PERCENT
        gains = [
            without.m2_per_stall - one.m2_per_stall if is_sized else one.stalls - without.stalls
            for one, without in zip(whole, made, strict=True)
        ]
        sites = f"{sum(one > ROUNDING for one in gains)} / {sum(one < -ROUNDING for one in gains)}"
        yield (
            f"| {size} | {setting} | {name} | {all_in.stalls:.1f} | {less.stalls:.1f} | {all_in.m2_per_stall:.2f} "
            f"| {less.m2_per_stall:.2f} | {all_in.score:.1f} | {less.score:.1f} | {100 * gain:+.2f} %; {sites} "
            f"| {all_in.seconds:.2f} | {less.seconds:.2f} | {share:.0f} % | {'yes' if pays else '**no**'} |"
        )


def _made(size: str, setting: str, planner: Planner) -> list[Figures]:
    plan, bay = SETTINGS[setting]
    made = []
    for seed, site in _sites(size, bay):
        start = time.process_time()
        found = planner(site, plan, bay, seed)
        seconds = time.process_time() - start
        floor = area_per_stall_m2(found.structure, bay)
        made.append(Figures(found.score.stalls, floor, found.score.value, seconds))
    return made


def _sites(size: str, bay: BayConfig) -> Iterator[tuple[int, Structure]]:
    """Each seed of a size with its site."""
    count, settings = SIZES[size]
    for seed in range(FIRST_SEED, FIRST_SEED + count):
        yield seed, make_site(SiteConfig(**settings), bay=bay, seed=seed)


def _mean(made: list[Figures]) -> Figures:
    return Figures(*(statistics.mean(values) for values in zip(*made, strict=True)))


def _planned(site: Structure, plan: PlanConfig, bay: BayConfig, seed: int) -> Plan:
    return plan_lanes(site, plan=plan, bay=bay, seed=seed)


def _unlearnt(site: Structure, plan: PlanConfig, bay: BayConfig, seed: int) -> Plan:
    return given_plan(anneal_alone(site, plan=plan, bay=bay, seed=seed).structure, bay=bay, plan=plan)


def _unimproved(site: Structure, plan: PlanConfig, bay: BayConfig, seed: int) -> Plan:
    # as many starts as with local search
    unimproved = plan.model_copy(update={"climb": False, "starts": plan.resolved().starts})
    return plan_lanes(site, plan=unimproved, bay=bay, seed=seed)


def _without(step: str) -> Planner:
    def kept(_: LocalSearch, ranked: list[Ranked], *_settings: int) -> list[Ranked]:
        return ranked

    def run(site: Structure, plan: PlanConfig, bay: BayConfig, seed: int) -> Plan:
        with patch.object(LocalSearch, step, kept):
            return _planned(site, plan, bay, seed)

    return run


def _noting(used: set[str]) -> Planner:
    """Plan with all optimisers, and note those that take part."""

    def noting(step: str) -> Callable[..., list[Ranked]]:
        method = getattr(LocalSearch, step)

        def run(search: LocalSearch, ranked: list[Ranked], *settings: int) -> list[Ranked]:
            used.add(step)
            improved: list[Ranked] = method(search, ranked, *settings)
            return improved

        return run

    noted = {step: noting(step) for step in STEPS.values()}

    def plan_all(site: Structure, plan: PlanConfig, bay: BayConfig, seed: int) -> Plan:
        with patch.multiple(LocalSearch, **noted):
            return _planned(site, plan, bay, seed)

    return plan_all


def _exact() -> Iterator[str]:
    """The exact programme, which plans take no part of, beside the planner on the smallest sites."""
    yield "The exact programme (`find_optimum`) beside the planner, on the sites of 7 x 9 squares of equal size:"
    yield ""
    headings = "stalls, optimum | planned | y', optimum | planned | planned the optimum | seconds, optimum | planned"
    yield f"| settings | {headings} |"
    yield "|---|---|---|---|---|---|---|---|"
    for setting in ("rules, equal squares", "no rules, equal squares"):
        plan, bay = SETTINGS[setting]
        pairs = []
        for seed, site in _sites("7 x 9", bay):
            start = time.process_time()
            made = _planned(site, plan, bay, seed)
            middle = time.process_time()
            best = find_optimum(site, bay=bay, plan=plan, known=made.structure)
            pairs.append((best.score, made.score, time.process_time() - middle, middle - start))
        optimal = sum(best.value - made.value < ROUNDING for best, made, _, _ in pairs)
        best_stalls, made_stalls, best_value, made_value, best_s, made_s = (
            statistics.mean(values)
            for values in zip(
                *((best.stalls, made.stalls, best.value, made.value, *seconds) for best, made, *seconds in pairs),
                strict=True,
            )
        )
        yield (
            f"| {setting} | {best_stalls:.1f} | {made_stalls:.1f} | {best_value:.2f} | {made_value:.2f} "
            f"| {optimal} of {len(pairs)} | {best_s:.2f} | {made_s:.2f} |"
        )
