"""Do garages pass their own check? Builds garages of many seeds and checks each against the profile it is designed to.

python benchmarks/reality.py --seeds 500
python benchmarks/reality.py --seeds 100 --rows 12 --cols 16 --rectangles 5 --obstacles 3
python benchmarks/reality.py --seeds 100 --rows 20 --cols 30 --entrances 2 --exits 2
"""

import argparse
import time
from collections import Counter

from garage2usd.as_built.garage import garage_as_made
from garage2usd.checks import Severity, findings_of
from garage2usd.config import GarageConfig
from garage2usd.driving import Limits, prove_stalls
from garage2usd.pipeline import generate
from garage2usd.planning import area_per_stall_m2
from garage2usd.profiles import DEFAULT_PROFILE, PROFILE_NAMES

SITE = {
    "rows": "height_cells",
    "cols": "width_cells",
    "rectangles": "rectangles",
    "obstacles": "obstacles",
    "entrances": "entrances",
    "exits": "exits",
}
_GEAR_CHANGES = 2


def main() -> int:
    """Print what was found by rule, and each seed with an error or a warning; end in 1 if there is one."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=25, help="how many seeds, from --first on")
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--drive", type=int, default=0, help="of how many seeds to drive each stall")
    parser.add_argument("--profile", choices=PROFILE_NAMES, default=DEFAULT_PROFILE)
    for name in SITE:
        parser.add_argument(f"--{name}", type=int)
    asked = parser.parse_args()
    site = {key: value for name, key in SITE.items() if (value := getattr(asked, name)) is not None}
    found: Counter[str] = Counter()
    gave_way: Counter[str] = Counter()
    bad, start = [], time.perf_counter()
    driven: Counter[str] = Counter()
    planned, left, plan_m2, layout_m2 = 0, 0, 0.0, 0.0
    for seed in range(asked.first, asked.first + asked.seeds):
        garage = generate(GarageConfig(seed=seed, profile=asked.profile, site=site))
        subject = garage_as_made(garage, source=f"seed {seed}", kind="report")
        findings = findings_of(subject, garage.config.standard)
        grave = [finding for finding in findings if finding.severity is not Severity.INFO]
        found.update(f"{finding.severity.value} {finding.rule}" for finding in findings)
        gave_way.update(garage.plan.gave_way)
        planned, left = planned + garage.plan.score.stalls, left + len(garage.layout.stalls)
        plan_m2 += area_per_stall_m2(garage.plan.structure, garage.config.bay) / asked.seeds
        layout_m2 += garage.layout.area.per_stall(garage.layout.parking_stalls).net_m2 / asked.seeds
        if seed < asked.first + asked.drive:
            limits = Limits(gear_changes=_GEAR_CHANGES)
            proofs = prove_stalls(garage.layout, limits=limits)
            driven["proven"] += sum(proof.is_proven for proof in proofs)
            driven["stalls"] += len(proofs)
        for rule, reason in garage.plan.gave_way.items():
            print(f"seed {seed}: {rule} gave way: {reason}", flush=True)
        if grave:
            bad.append(seed)
            print(f"seed {seed}: {grave[0].rule} at {grave[0].place}: {grave[0].message}", flush=True)
    for rule, count in sorted(found.items()):
        print(f"{count:7d}  {rule}")
    print(f"rules of circulation that gave way: {dict(sorted(gave_way.items())) or 'none'}")
    print(f"{plan_m2:.2f} m2 a stall in the plans, {layout_m2:.2f} with stair cores; {planned} stalls, {left} left")
    if driven:
        share = 100 * driven["proven"] / driven["stalls"]
        print(f"{share:.2f} % of {driven['stalls']} stalls take a car with {_GEAR_CHANGES} changes of gear at most")
    seconds = time.perf_counter() - start
    print(f"{asked.seeds} seeds, {asked.profile}: {len(bad)} with errors or warnings, {seconds:.0f} s")
    return int(bool(bad))


if __name__ == "__main__":
    raise SystemExit(main())
