"""What the rules of circulation cost: stalls and floor a stall with and without them, beside combs of aisles."""

import statistics
import time

from annealing import anneal_alone
from scale import combs

from garage2usd.config import BayConfig, GarageConfig, PlanConfig
from garage2usd.planning import area_per_stall_m2, dimensioned, plan_lanes
from garage2usd.site import make_site
from garage2usd.structure.grid import Structure

__all__ = ["circulation"]

EQUAL, METRES = BayConfig(dimensioned=False), BayConfig()
IRREGULAR = {"rectangles": 5, "min_portal_distance_cells": 10}
TWO = {"entrances": 2, "exits": 2}
SIZES: dict[str, tuple[int, dict[str, object]]] = {
    "7 x 9": (40, {}),
    "12 x 16 irregular": (
        40,
        {
            "height_cells": 12,
            "width_cells": 16,
            "rectangles": 5,
            "min_fill": 0.55,
            "obstacles": 3,
            "min_obstacle_distance_cells": 4,
            "min_portal_distance_cells": 8,
        },
    ),
    "20 x 30": (8, {"height_cells": 20, "width_cells": 30, "min_portal_distance_cells": 10, **TWO}),
    "40 x 60 irregular": (4, {"height_cells": 40, "width_cells": 60, "obstacles": 8, **IRREGULAR, **TWO}),
    "100 x 100 irregular": (3, {"height_cells": 100, "width_cells": 100, "obstacles": 30, **IRREGULAR, **TWO}),
}
FREE = PlanConfig(circulation="allow")
LOOPS = PlanConfig(longest_stretch_cells=0)
CROSSED = PlanConfig()


def circulation() -> str:
    """One row a size: stalls on equal squares, floor a stall in metres, and seconds, of each set of rules."""
    rows = [
        "## The rules of circulation on sites of all sizes",
        "",
        (
            "Means over the seeds; the same seeds in every column. Stalls are those on squares of 8.1 m; m2 a stall "
            "are of plans whose R and C are chosen, before stair cores. R4 is asked for from 400 free squares on. "
            "Comb: the best of combs of parallel aisles with one across, joined and given R and C, which keeps no rule."
        ),
        "",
        (
            "| site | seeds | stalls, free | R1-R3 | R1-R4 | m2 a stall, free | R1-R3 | R1-R4 | comb | seconds, free "
            "| R1-R4 | in metres | rules that gave way |"
        ),
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|",
    ]
    for bay in (EQUAL, METRES):
        for plan in (FREE, CROSSED):  # compiles
            plan_lanes(_site("20 x 30", 0), plan=plan, bay=bay, seed=0)
            plan_lanes(_site("7 x 9", 0), plan=plan, bay=bay, seed=0)
    return "\n".join([*rows, *(_row(name) for name in SIZES)])


def _site(name: str, seed: int) -> Structure:
    config = GarageConfig(seed=seed, site=SIZES[name][1])
    return make_site(config.site, bay=config.bay, seed=seed)


def _row(name: str) -> str:
    figures: dict[str, list[float]] = {}
    broken = 0
    for seed in range(SIZES[name][0]):
        site = _site(name, seed)
        for rules, plan in (("free", FREE), ("R1-R3", LOOPS), ("R1-R4", CROSSED)):
            for unit, bay in (("stalls", EQUAL), ("m2", METRES)):
                start = time.process_time()
                made = plan_lanes(site, plan=plan, bay=bay, seed=seed)
                seconds = time.process_time() - start
                broken += bool(made.gave_way)
                stalls = made.score.stalls if unit == "stalls" else area_per_stall_m2(made.structure, bay)
                figures.setdefault(f"{unit} {rules}", []).append(stalls)
                figures.setdefault(f"seconds {unit} {rules}", []).append(seconds)
        comb = anneal_alone(
            site, plan=PlanConfig(circulation="allow", climb=False), bay=EQUAL, seed=seed, starts=combs(site)
        )
        figures.setdefault("comb", []).append(area_per_stall_m2(dimensioned(comb.structure, METRES), METRES))
    mean = {key: statistics.mean(values) for key, values in figures.items()}

    def against_free(rules: str) -> str:
        return f"{mean[f'stalls {rules}']:.1f} ({100 * (mean[f'stalls {rules}'] / mean['stalls free'] - 1):+.1f} %)"

    return (
        f"| {name} | {SIZES[name][0]} | {mean['stalls free']:.1f} | {against_free('R1-R3')} | {against_free('R1-R4')} "
        f"| {mean['m2 free']:.1f} | {mean['m2 R1-R3']:.1f} | {mean['m2 R1-R4']:.1f} | {mean['comb']:.1f} "
        f"| {mean['seconds stalls free']:.1f} | {mean['seconds stalls R1-R4']:.1f} | {mean['seconds m2 R1-R4']:.1f} "
        f"| {broken} |"
    )
