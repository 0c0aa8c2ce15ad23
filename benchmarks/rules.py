"""What the rules of circulation cost on plans of 7 x 9 squares: proven optima with and without them."""

import statistics
import time
from typing import NamedTuple

from gates import GATE_BAY, GATES, held_out, site_of

from garage2usd.config import BayConfig, PlanConfig
from garage2usd.planning import Score, find_optimum
from garage2usd.planning.circulation import circulation
from garage2usd.structure.grid import Structure

__all__ = ["DEPTHS", "Proof", "plan_under_rules", "prove", "rules"]

DEPTHS = (0, 1, 2)
"""Rounds of pruning within which dead ends are gone, the N of R1."""


class Proof(NamedTuple):
    """The best structure of a site, and the seconds that its proof took."""

    score: Score
    structure: Structure
    seconds: float


def plan_under_rules(depth: int | None) -> PlanConfig:
    """R1 to R3 with dead ends of up to so many squares; without rules for None."""
    if depth is None:
        return PlanConfig(circulation="allow", dead_ends="allow")
    return PlanConfig(circulation="loops", dead_end_cells=depth)


def prove(site: Structure, bay: BayConfig, depth: int | None) -> Proof:
    """The proven optimum of one site."""
    start = time.perf_counter()
    optimum = find_optimum(site, bay=bay, plan=plan_under_rules(depth))
    return Proof(optimum.score, optimum.structure, time.perf_counter() - start)


def rules() -> str:
    """One table for the gates of tuning, one for those held out."""
    gates = {name: (site_of(*gate, GATE_BAY), GATE_BAY) for name, gate in GATES.items()}
    sections = [
        "## The price of the rules of circulation, 7 x 9 squares",
        (
            "Proven optima: y' / stalls / per cent of the y' without rules. N is how many squares deep a dead end may "
            "be (R1); with each N there is also a loop (R2) and no block of two by two lanes (R3). Without rules: y' / "
            "stalls; how many loops the optimum has, and how many squares deep its deepest dead end is. Seconds are "
            "those of the proof for N = 2."
        ),
        "### The gates that parameters were tuned on, bays of 8.1 m\n\n" + _table(gates),
        "### Held out: gates and bays drawn at random, on which nothing was tuned\n\n" + _table(held_out()),
    ]
    return "\n\n".join(sections)


def _table(cases: dict[str, tuple[Structure, BayConfig]]) -> str:
    headings = [f"N = {depth}" for depth in DEPTHS]
    rows = [
        f"| site | no rules: y' / stalls; loops, dead end | {' | '.join(headings)} | seconds |",
        f"|---|---|{'---|' * len(DEPTHS)}---|",
    ]
    shares: list[list[float]] = [[] for _ in DEPTHS]
    prove(*next(iter(cases.values())), DEPTHS[-1])  # warm
    for case, (site, bay) in cases.items():
        free = prove(site, bay, None)
        found = circulation(free.structure)
        proofs = [prove(site, bay, depth) for depth in DEPTHS]
        percent = [100 * proof.score.value / free.score.value for proof in proofs]
        for share, value in zip(shares, percent, strict=True):
            share.append(value)
        cells = [
            f"{proof.score.value:.4f} / {proof.score.stalls} / {value:.1f}"
            for proof, value in zip(proofs, percent, strict=True)
        ]
        without = f"{free.score.value:.4f} / {free.score.stalls}; {found.loops}, {found.dead_end_squares}"
        rows.append(f"| {case} | {without} | {' | '.join(cells)} | {proofs[-1].seconds:.1f} |")
    rows.append(f"| mean per cent | | {' | '.join(f'{statistics.mean(share):.1f}' for share in shares)} | |")
    return "\n".join(rows)
