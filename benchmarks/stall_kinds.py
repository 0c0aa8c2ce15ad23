"""Floor per stall by the kind of stall, and what one-way aisles cost in driving.

    python benchmarks/stall_kinds.py modules
    python benchmarks/stall_kinds.py sites --count 40

``modules`` lays out endless rows on both sides of an aisle of the width that a profile asks for, with columns at the
corners of squares, for squares of 8.1 m and for the best side. ``sites`` plans the same sites with perpendicular stalls
and two-way aisles, with one-way aisles, and with angled stalls on these.
"""

import argparse
import math
import statistics

import numpy as np

from garage2usd import GarageConfig, generate
from garage2usd.config import BayConfig
from garage2usd.garage import StallKind
from garage2usd.planning import driven_lengths
from garage2usd.profiles import PROFILE_NAMES, Profile, load_profile
from garage2usd.structure.grid import Cell, Structure
from garage2usd.structure.packing import depth_needed_m
from garage2usd.structure.stall_runs import StallRun, capacity_of_runs
from garage2usd.structure.stalls import Edge, StallShape

ANGLES_DEG = (90.0, 75.0, 60.0, 45.0, 0.0)
USUAL_SIDE_M = 8.1
SIDES_M = [round(float(side), 2) for side in np.arange(5.0, 12.01, 0.05)]
SQUARES = 12
SITES = {
    "two-way, perpendicular": {},
    "one-way, perpendicular": {"plan": {"aisles": "one-way"}},
    "one-way, 75 degrees": {"plan": {"aisles": "one-way"}, "stalls": {"kinds": {"angled": 1}, "angles_deg": [75]}},
    "one-way, 60 degrees": {"plan": {"aisles": "one-way"}, "stalls": {"kinds": {"angled": 1}, "angles_deg": [60]}},
}


def shape_of(profile: Profile, bay: BayConfig, angle_deg: float) -> StallShape:
    """Return the stall of a profile at an angle."""
    length_m = bay.stall_length_m
    if angle_deg == 0:
        length_m = profile.parallel_stall_length.amount if profile.parallel_stall_length else 6.0
    return StallShape(bay.stall_width_m, length_m, angle_deg)


def aisle_m(profile: Profile, shape: StallShape) -> float | None:
    """Return the least width of the aisle for a stall; None where the profile has none."""
    if shape.kind is StallKind.ANGLED:
        angled, upright = profile.angled_aisle_widths, profile.aisle_width
        return angled.amount_at(shape.angle_deg, upright.amount if upright else None) if angled else None
    clause = profile.aisle_width if shape.kind is StallKind.PERPENDICULAR else profile.parallel_aisle_width
    return clause.amount if clause else None


def floor_per_stall_m2(shape: StallShape, bay: BayConfig, side_m: float, clear_aisle_m: float) -> float:
    """Return the floor of an endless module of two rows and their aisle per stall, with columns at mouths and rears."""
    cells = np.array([[Cell.FREE], [Cell.LANE], [Cell.FREE], [Cell.FREE]], dtype=np.int8).repeat(SQUARES, axis=1)
    aisle_side_m = clear_aisle_m + bay.column_size_m
    deep_m = [depth_needed_m(shape, bay), depth_needed_m(shape, bay) + bay.column_size_m / 2]
    found = []
    for depth_m in deep_m:
        structure = Structure.from_arrays(cells, side_m, [depth_m, aisle_side_m, depth_m, depth_m])
        run = StallRun((2, 0), (2, SQUARES - 1), Edge.UP, shape)
        # squares in the middle, where the ends of the run cost nothing
        stalls = int(capacity_of_runs(structure, bay, [run])[2, 3:-3].sum()) / (SQUARES - 6)
        if stalls:
            found.append(side_m * (2 * depth_m + aisle_side_m) / (2 * stalls))
    return min(found, default=np.inf)


def best_modules(profile: Profile, bay: BayConfig) -> dict[StallShape, tuple[float, float]]:
    """Return the least floor per stall of each stall of a profile, and the side of the squares that has it."""
    found = {}
    for angle_deg in ANGLES_DEG:
        shape = shape_of(profile, bay, angle_deg)
        clear_m = aisle_m(profile, shape)
        if clear_m is not None:
            found[shape] = min((floor_per_stall_m2(shape, bay, side, clear_m), side) for side in SIDES_M)
    return found


def modules() -> None:
    """Print the floor per stall of endless modules."""
    print("| profile | stall | aisle (m) | m2 a stall at 8.1 m | best m2 a stall | at (m) |\n|---|---|---|---|---|---|")
    for name in PROFILE_NAMES:
        profile = load_profile(name)
        bay = GarageConfig(profile=name).bay
        for shape, (least_m2, best_m) in best_modules(profile, bay).items():
            clear_m = aisle_m(profile, shape) or math.nan
            usual_m2 = floor_per_stall_m2(shape, bay, USUAL_SIDE_M, clear_m)
            kind = shape.kind.value if shape.kind is not StallKind.ANGLED else f"{shape.angle_deg:.0f} degrees"
            print(
                f"| {name} | {kind} {shape.width_m:.2f} x {shape.length_m:.2f} | {clear_m:.2f} "
                f"| {usual_m2:.1f} | {least_m2:.1f} | {best_m:.2f} |"
            )


def sites(count: int, profile: str) -> None:
    """Print stalls, floor and drives of the same sites with other aisles and stalls."""
    print("| | stalls | m2 a stall | mean drive in and out (m) | detour, median | worst |\n|---|---|---|---|---|---|")
    for name, settings in SITES.items():
        rows = []
        for seed in range(count):
            config = GarageConfig(seed=seed, profile=profile, site={"width_cells": 16, "height_cells": 12}, **settings)
            garage = generate(config)
            lengths = driven_lengths(garage.plan, config, garage.plan.directions)
            stalls = garage.plan.score.stalls
            rows.append((stalls, garage.plan.structure.floor_m2 / stalls, lengths.directed_m, lengths.detour))
        stalls, floor, drive, detour = zip(*rows, strict=True)
        print(
            f"| {name} | {statistics.mean(stalls):.0f} | {statistics.mean(floor):.1f} | {statistics.mean(drive):.0f} "
            f"| {statistics.median(detour):.2f} | {max(detour):.2f} |"
        )


def main() -> None:
    """Print one of the tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("table", choices=("modules", "sites"))
    parser.add_argument("--count", type=int, default=40, help="number of sites")
    parser.add_argument("--profile", choices=PROFILE_NAMES, default=PROFILE_NAMES[0])
    arguments = parser.parse_args()
    if arguments.table == "modules":
        modules()
    else:
        sites(arguments.count, arguments.profile)


if __name__ == "__main__":
    main()
