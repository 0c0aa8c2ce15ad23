"""How plans of large irregular sites compare with the counting bound and with a comb of aisles."""

import json
import statistics
import subprocess
import sys
import time

import numpy as np
from annealing import anneal_alone
from memory import peak_mb

from garage2usd.config import BayConfig, PlanConfig, SiteConfig
from garage2usd.planning import counting_bound, evaluate, find_optimum, is_feasible, plan_lanes
from garage2usd.site import make_site
from garage2usd.structure.grid import Cell, Structure

__all__ = ["combs", "scale"]

SIZES = ((20, 30), (40, 60), (100, 100))
SITES = 8
BAY = BayConfig(dimensioned=False)
FREE = PlanConfig(circulation="allow")
"""The bound is of plans without rules of circulation."""
FAMILIES = {
    "4 rectangles, an obstacle every 250 squares": (4, 250),
    "6 rectangles, an obstacle every 100 squares": (6, 100),
}
PITCH = 3
SMALL = {"height_cells": 9, "width_cells": 9, "rectangles": 3, "obstacles": 1}
SMALL_SITES = 8


def large_site(rows: int, cols: int, seed: int, *, rectangles: int, squares_per_obstacle: int) -> Structure:
    """An irregular contour with obstacles, two entrances and two exits."""
    config = SiteConfig(
        height_cells=rows,
        width_cells=cols,
        rectangles=rectangles,
        obstacles=rows * cols // squares_per_obstacle,
        entrances=2,
        exits=2,
        min_portal_distance_cells=5,
    )
    return make_site(config, bay=BAY, seed=seed)


def scale() -> str:
    """A table for each family of sites, and how loose the bound is where the optimum is known."""
    rows = [
        f"## Large sites, {SITES} of each size, without rules of circulation",
        "",
        (
            "Per cent of the counting bound, mean / min; one core. Learnt: Sarsa over aisles with repair; planned: "
            "that and polish. Comb: the best of combs of parallel aisles in both directions with repair, "
            "then annealed with the planner's effort. Memory: the peak of a process that plans the last site."
        ),
        "",
        "| sites | size | free squares | learnt | planned | seconds, mean / max | comb | comb + annealing | memory |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    plan_lanes(large_site(20, 30, SITES, rectangles=1, squares_per_obstacle=600), plan=FREE, bay=BAY, seed=0)
    rows += [_row(family, size, *numbers) for family, numbers in FAMILIES.items() for size in SIZES]
    rows += ["", f"A plan of 7 x 9 squares peaks at {_peak_mb((7, 9), 1, 250):.0f} MB.", "", _looseness()]
    return "\n".join(rows)


def _row(family: str, size: tuple[int, int], rectangles: int, per_obstacle: int) -> str:
    figures: dict[str, list[float]] = {name: [] for name in ("learnt", "planned", "seconds", "comb", "annealed")}
    squares = []
    for seed in range(SITES):
        site = large_site(*size, seed, rectangles=rectangles, squares_per_obstacle=per_obstacle)
        bound = counting_bound(site, bay=BAY)
        start = time.perf_counter()
        made = plan_lanes(site, plan=FREE, bay=BAY, seed=seed)
        figures["seconds"].append(time.perf_counter() - start)
        if not is_feasible(made.structure):
            raise SystemExit(f"{family}, {size}, seed {seed}: not feasible")
        comb = anneal_alone(
            site, plan=PlanConfig(circulation="allow", climb=False), bay=BAY, seed=seed, starts=combs(site)
        )
        annealed = anneal_alone(site, plan=FREE, bay=BAY, seed=seed, starts=[comb.structure])
        figures["learnt"].append(100 * made.learnt.score.value / bound)
        figures["planned"].append(100 * made.score.value / bound)
        figures["comb"].append(100 * comb.score.value / bound)
        figures["annealed"].append(100 * annealed.score.value / bound)
        squares.append(int((site.cells == Cell.FREE).sum()))
    shares = {name: f"{statistics.mean(values):.1f} / {min(values):.1f}" for name, values in figures.items()}
    seconds = f"{statistics.mean(figures['seconds']):.2f} / {max(figures['seconds']):.2f}"
    memory = _peak_mb(size, rectangles, per_obstacle)
    return (
        f"| {family} | {size[0]} x {size[1]} | {min(squares)} to {max(squares)} | {shares['learnt']} "
        f"| {shares['planned']} | {seconds} | {shares['comb']} | {shares['annealed']} | {memory:.0f} MB |"
    )


def combs(site: Structure) -> list[Structure]:
    """Parallel aisles at every third line with one across, for each direction, offset and some places of the one."""
    combs = []
    for turned in (False, True):
        static = site.cells.T if turned else site.cells
        for offset in range(PITCH):
            for across in np.linspace(1, static.shape[1] - 2, min(12, static.shape[1] - 2)).astype(int):
                lanes = np.zeros(static.shape, dtype=bool)
                lanes[offset::PITCH] = True
                lanes[:, across] = True
                cells = np.where(lanes & (static == Cell.FREE), Cell.LANE, static).astype(np.int8)
                combs.append(site.with_cells(cells.T if turned else cells))
    return combs


def _looseness() -> str:
    """The proven optimum as a share of the counting bound, on irregular sites small enough for it."""
    shares = []
    for seed in range(SMALL_SITES):
        site = make_site(SiteConfig(**SMALL, min_portal_distance_cells=3), bay=BAY, seed=seed)
        best = evaluate(find_optimum(site, bay=BAY).structure, bay=BAY).value
        shares.append(100 * best / counting_bound(site, bay=BAY))
    return (
        f"The bound is loose: on {SMALL_SITES} irregular contours in 9 x 9 squares the proven optimum itself is "
        f"{statistics.mean(shares):.1f} % of it in the mean, {min(shares):.1f} to {max(shares):.1f} %."
    )


def _peak_mb(size: tuple[int, int], rectangles: int, per_obstacle: int) -> float:
    arguments = json.dumps([*size, SITES - 1, rectangles, per_obstacle])
    run = subprocess.run([sys.executable, __file__, arguments], check=True, capture_output=True)  # noqa: S603
    return float(run.stdout)


if __name__ == "__main__":
    rows, cols, seed, rectangles, per_obstacle = json.loads(sys.argv[1])
    site = large_site(rows, cols, seed, rectangles=rectangles, squares_per_obstacle=per_obstacle)
    plan_lanes(site, plan=FREE, bay=BAY, seed=0)
    print(peak_mb())
