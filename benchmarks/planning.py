"""How near to the proven optimum plans of 7 x 9 squares come."""

import statistics
import time
from collections.abc import Callable

import numpy as np
from annealing import anneal_alone
from gates import GATE_BAY, GATES, held_out, site_of

from garage2usd.config import BayConfig, PlanConfig
from garage2usd.planning import evaluate, find_optimum, plan_lanes
from garage2usd.planning.circulation import circulation, rules_of
from garage2usd.structure.grid import Structure

__all__ = ["planning"]

SEEDS = 10
RANDOM = {"epsilon_start": 1.0, "epsilon_min": 1.0, "epsilon_decay": 1.0, "epsilon_refresh": 1.0, "revisit_rate": 0.0}
PAPER_BEST = 62.18

Asked = dict[str, str]
FREE: Asked = {"circulation": "allow", "dead_ends": "allow"}
RULES: Asked = {"circulation": "loops", "dead_ends": "allow"}

Planner = Callable[[Structure, BayConfig, Asked, int], Structure]


def planning() -> str:
    """One table for the gates of tuning, one for those held out."""
    tuned_on = {name: (site_of(*gate, GATE_BAY), GATE_BAY) for name, gate in GATES.items()}
    sections = [
        f"## Planning 7 x 9 squares, 5000 episodes, {SEEDS} seeds",
        (
            "Per cent of the proven optimum, mean / min over the seeds; distinct best plans; mean seconds, warm. "
            "`tuned` learns 5000 episodes from each of four starts, the column before it from one. Random draws masked "
            "actions and never learns; annealing is given as much and no learning. Under the rules of circulation R1 "
            "(N = 2), R2 and R3 the optimum keeps them too, the figures are of the plans that keep them, and the last "
            "one is how many do."
        ),
        "### The gates that parameters were tuned on, bays of 8.1 m\n\n" + _table(tuned_on, FREE),
        "### Held out: gates and bays drawn at random, on which nothing was tuned\n\n" + _table(held_out(), FREE),
        "### The gates that parameters were tuned on, under the rules\n\n" + _table(tuned_on, RULES),
        "### Held out, under the rules\n\n" + _table(held_out(), RULES),
    ]
    return "\n\n".join(sections)


def _learner(**settings: object) -> Planner:
    def run(site: Structure, bay: BayConfig, asked: Asked, seed: int) -> Structure:
        return plan_lanes(site, plan=PlanConfig(**asked, **settings), bay=bay, seed=seed).structure

    return run


def _annealer(site: Structure, bay: BayConfig, asked: Asked, seed: int) -> Structure:
    return anneal_alone(site, plan=PlanConfig(**asked), bay=bay, seed=seed).structure


PLANNERS: dict[str, Planner] = {
    "random": _learner(climb=False, starts=1, **RANDOM),
    "`paper`": _learner(preset="paper", climb=False),
    "`tuned`, one start": _learner(climb=False, starts=1),
    "`tuned`": _learner(climb=False),
    "`tuned` + climb": _learner(),
    "random + climb": _learner(starts=1, **RANDOM),
    "annealing": _annealer,
}


def _table(cases: dict[str, tuple[Structure, BayConfig]], asked: Asked) -> str:
    plan = PlanConfig(**asked)
    rules = rules_of(plan, squares=0)
    rows = [f"| site | optimum y' | {' | '.join(PLANNERS)} |", f"|---|---|{'---|' * len(PLANNERS)}"]
    shares: dict[str, list[float]] = {name: [] for name in PLANNERS}
    kept: dict[str, int] = dict.fromkeys(PLANNERS, 0)
    paper, worst = [], np.inf
    for case, (site, bay) in cases.items():
        optimum = find_optimum(site, bay=bay, plan=plan).score.value
        cells = []
        for name, planner in PLANNERS.items():
            planner(site, bay, asked, SEEDS)  # warm
            start = time.perf_counter()
            made = [planner(site, bay, asked, seed) for seed in range(SEEDS)]
            seconds = (time.perf_counter() - start) / SEEDS
            sound = [structure for structure in made if not circulation(structure).faults(rules)]
            values = [evaluate(structure, bay=bay).value for structure in sound]
            percent = [100 * value / optimum for value in values]
            shares[name] += percent
            kept[name] += len(sound)
            distinct = len({structure.digest() for structure in made})
            cells.append(f"{_mean_and_least(percent)}; {distinct}; {seconds:.2f} s{_of(len(sound), SEEDS, asked)}")
            if name == "`paper`":
                paper.append(f"{case.split()[0]} {_mean_and_least(values)}")
            if name == "`tuned` + climb" and bay == GATE_BAY:
                worst = min([worst, *values])
        rows.append(f"| {case} | {optimum:.4f} | {' | '.join(cells)} |")
    runs = SEEDS * len(cases)
    whole = (f"{_mean_and_least(values)}{_of(kept[name], runs, asked)}" for name, values in shares.items())
    rows.append(f"| all | | {' | '.join(whole)} |")
    rows += ["", f"y' of `paper`, mean / min: {', '.join(paper)}."]
    if np.isfinite(worst):
        rows.append(f"Least best y' of `tuned` + climb: {worst:.2f}; the paper's best plan has {PAPER_BEST}.")
    return "\n".join(rows)


def _mean_and_least(values: list[float]) -> str:
    return f"{statistics.mean(values):.1f} / {min(values):.1f}" if values else "none"


def _of(kept: int, runs: int, asked: Asked) -> str:
    return f"; {kept} of {runs}" if asked is RULES else ""
