"""Floor per stall of garages of every kind, beside one level of perpendicular stalls and the floor of endless rows."""

import math
import statistics
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from stall_kinds import aisle_m, floor_per_stall_m2, shape_of

from garage2usd import GarageConfig, generate, load_config
from garage2usd.planning import driven_lengths
from garage2usd.profiles import load_profile

__all__ = ["floor_use"]

SAMPLES = Path(__file__).parents[1] / "samples"
SEEDS = range(30, 40)
"""Seeds on which nothing was tuned."""
ONE_WAY = {"aisles": "one-way"}
MIXED = {"kinds": {"perpendicular": 0.4, "angled": 0.4, "parallel": 0.2}}
AT_75, AT_60 = ({"kinds": {"angled": 1}, "angles_deg": [angle_deg]} for angle_deg in (75, 60))
SITES = {
    "13 x 11, one level": (13, 11, {}),
    "13 x 11, three levels, straight ramps": (13, 11, {"building": {"levels": 3}}),
    "13 x 11, three levels, helices": (13, 11, {"building": {"levels": 3, "ramps": "helix"}}),
    "16 x 12, one level": (16, 12, {}),
    "16 x 12, three levels, straight ramps": (16, 12, {"building": {"levels": 3}}),
    "16 x 12, three levels, helices": (16, 12, {"building": {"levels": 3, "ramps": "helix"}}),
    "16 x 12, one-way": (16, 12, {"plan": ONE_WAY}),
    "16 x 12, one-way, 75 degrees": (16, 12, {"plan": ONE_WAY, "stalls": AT_75}),
    "16 x 12, one-way, 60 degrees": (16, 12, {"plan": ONE_WAY, "stalls": AT_60}),
    "14 x 11, one-way, 0.4 perpendicular, 0.4 angled, 0.2 parallel": (14, 11, {"plan": ONE_WAY, "stalls": MIXED}),
}
NAMES = ("mixed_stalls", "two_levels", "three_levels")


def floor_use() -> str:
    """A table of the floor per stall of sites of all kinds, and one of endless rows on squares of 8.1 m."""
    lines = [
        "## Floor per stall",
        "",
        (
            "Gross is the ground inside the outline, ramps included, over the stalls that cars park in; net leaves "
            f"ramps out. Means over the seeds {SEEDS[0]} to {SEEDS[-1]}, profile cn-jgj100; samples have their own. "
            "Detour: drives along the one-way aisles over those if all were two-way, median and worst."
        ),
        "",
        "| garage | stalls | m2 a stall, gross | net | least to most, gross | detour |",
        "|---|---|---|---|---|---|",
    ]
    with ProcessPoolExecutor() as pool:
        for name, (columns, rows, settings) in SITES.items():
            site = {"width_cells": columns, "height_cells": rows}
            configs = [GarageConfig(seed=seed, site=site, **settings) for seed in SEEDS]
            lines.append(_row(name, list(pool.map(_measured, configs))))
    samples = {name: load_config(SAMPLES / f"{name}.toml") for name in NAMES}
    lines += [_row(f"`samples/{name}.toml`", [_measured(config)]) for name, config in samples.items()]
    profile, bay = load_profile("cn-jgj100"), GarageConfig(profile="cn-jgj100").bay
    lines += [
        "",
        "Endless rows on squares of 8.1 m, which no plan can beat:",
        "",
        "| stall | m2 a stall |",
        "|---|---|",
    ]
    for angle_deg in (90.0, 75.0, 60.0, 45.0, 0.0):
        shape = shape_of(profile, bay, angle_deg)
        clear_m = aisle_m(profile, shape) or math.nan
        lines.append(
            f"| {shape.kind.value}, {angle_deg:.0f} degrees | {floor_per_stall_m2(shape, bay, 8.1, clear_m):.1f} |"
        )
    return "\n".join(lines)


def _measured(config: GarageConfig) -> tuple[int, float, float, float]:
    """Stalls, net and gross floor per stall, and the detour of a garage."""
    garage = generate(config)
    net_m2, gross_m2 = (math.fsum(areas) for areas in zip(*(level.layout.area for level in garage.levels), strict=True))
    stalls = garage.parking_stalls
    plans = [level.plan for level in garage.levels]
    detour = max(driven_lengths(plan, config, plan.directions).detour for plan in plans)
    return stalls, net_m2 / stalls, gross_m2 / stalls, detour


def _row(name: str, garages: list[tuple[int, float, float, float]]) -> str:
    stalls, net_m2, gross_m2, detours = zip(*garages, strict=True)
    detour = f"{statistics.median(detours):.2f}, {max(detours):.2f}" if max(detours) > 1 else ""
    return (
        f"| {name} | {statistics.mean(stalls):.0f} | {statistics.mean(gross_m2):.1f} | {statistics.mean(net_m2):.1f} "
        f"| {min(gross_m2):.1f} to {max(gross_m2):.1f} | {detour} |"
    )
