"""How near to the proven optimum plans of 7 x 9 squares come."""

import statistics
import time
from collections.abc import Callable

import numpy as np
from gates import GATES, held_out, site_of

from garage2usd.config import BayConfig, PlanConfig
from garage2usd.grid import Structure
from garage2usd.planning import plan_lanes
from garage2usd.planning.optimum import find_optimum
from garage2usd.planning.planner import anneal_alone

__all__ = ["planning"]

SEEDS = 10
RANDOM = {"epsilon_start": 1.0, "epsilon_min": 1.0, "epsilon_decay": 1.0, "epsilon_refresh": 1.0, "revisit_rate": 0.0}
PAPER_BEST = 62.18

Planner = Callable[[Structure, BayConfig, int], tuple[float, str]]


def planning() -> str:
    """One table for the gates of tuning, one for those held out."""
    tuned_on = {name: (site_of(*gate, BayConfig()), BayConfig()) for name, gate in GATES.items()}
    sections = [
        f"## Planning 7 x 9 squares, 5000 episodes, {SEEDS} seeds",
        (
            "Per cent of the proven optimum, mean / min over the seeds; distinct best plans; mean seconds, warm. Dead "
            "ends are allowed. `tuned` learns 5000 episodes from each of four starts, the column before it from one. "
            "Random draws masked actions and never learns; annealing is given as much and no learning."
        ),
        "### The gates that parameters were tuned on, bays of 8.1 m\n\n" + _table(tuned_on),
        "### Held out: gates and bays drawn at random, on which nothing was tuned\n\n" + _table(held_out()),
    ]
    return "\n\n".join(sections)


def _learner(**settings: object) -> Planner:
    plan = PlanConfig(dead_ends="allow", **settings)

    def run(site: Structure, bay: BayConfig, seed: int) -> tuple[float, str]:
        made = plan_lanes(site, plan=plan, bay=bay, seed=seed)
        return made.score.value, made.structure.digest()

    return run


def _annealer(site: Structure, bay: BayConfig, seed: int) -> tuple[float, str]:
    made = anneal_alone(site, plan=PlanConfig(dead_ends="allow"), bay=bay, seed=seed)
    return made.score.value, made.structure.digest()


PLANNERS: dict[str, Planner] = {
    "random": _learner(climb=False, starts=1, **RANDOM),
    "`paper`": _learner(preset="paper", climb=False),
    "`tuned`, one start": _learner(climb=False, starts=1),
    "`tuned`": _learner(climb=False),
    "`tuned` + climb": _learner(),
    "random + climb": _learner(starts=1, **RANDOM),
    "annealing": _annealer,
}


def _table(cases: dict[str, tuple[Structure, BayConfig]]) -> str:
    rows = [f"| site | optimum y' | {' | '.join(PLANNERS)} |", f"|---|---|{'---|' * len(PLANNERS)}"]
    shares: dict[str, list[float]] = {name: [] for name in PLANNERS}
    paper, worst = [], np.inf
    for case, (site, bay) in cases.items():
        optimum = find_optimum(site, bay=bay).score.value
        cells = []
        for name, planner in PLANNERS.items():
            planner(site, bay, SEEDS)  # warm
            start = time.perf_counter()
            made = [planner(site, bay, seed) for seed in range(SEEDS)]
            seconds = (time.perf_counter() - start) / SEEDS
            values = [value for value, _ in made]
            percent = [100 * value / optimum for value in values]
            shares[name] += percent
            distinct = len({digest for _, digest in made})
            cells.append(f"{statistics.mean(percent):.1f} / {min(percent):.1f}; {distinct}; {seconds:.2f} s")
            if name == "`paper`":
                paper.append(f"{case.split()[0]} {statistics.mean(values):.1f} / {min(values):.1f}")
            if name == "`tuned` + climb" and bay == BayConfig():
                worst = min(worst, *values)
        rows.append(f"| {case} | {optimum:.4f} | {' | '.join(cells)} |")
    whole = (f"{statistics.mean(values):.1f} / {min(values):.1f}" for values in shares.values())
    rows.append(f"| all | | {' | '.join(whole)} |")
    rows += ["", f"y' of `paper`, mean / min: {', '.join(paper)}."]
    if np.isfinite(worst):
        rows.append(f"Least best y' of `tuned` + climb: {worst:.2f}; the paper's best plan has {PAPER_BEST}.")
    return "\n".join(rows)
