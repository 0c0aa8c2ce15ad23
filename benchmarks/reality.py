"""Do garages pass their own check? Builds garages of many seeds and checks each against the profile it is designed to.

python benchmarks/reality.py --seeds 500
python benchmarks/reality.py --seeds 40 --profile us-ada --rows 12 --cols 16 --rectangles 5
"""

import argparse
import time
from collections import Counter

from garage2usd.checks import Severity, check
from garage2usd.checks.layout_reader import layout_subject
from garage2usd.config import GarageConfig
from garage2usd.pipeline import generate
from garage2usd.profiles import DEFAULT_PROFILE, PROFILE_NAMES


def main() -> int:
    """Print what was found by rule, and each seed with an error; end in 1 if there is one."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=25, help="how many seeds, from --first on")
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--profile", choices=PROFILE_NAMES, default=DEFAULT_PROFILE)
    parser.add_argument("--rows", type=int)
    parser.add_argument("--cols", type=int)
    parser.add_argument("--rectangles", type=int)
    parser.add_argument("--obstacles", type=int)
    asked = parser.parse_args()
    site = {
        "height_cells": asked.rows,
        "width_cells": asked.cols,
        "rectangles": asked.rectangles,
        "obstacles": asked.obstacles,
    }
    settings = {"profile": asked.profile, "site": {key: value for key, value in site.items() if value is not None}}
    found: Counter[str] = Counter()
    bad, stalls, start = [], 0, time.perf_counter()
    for seed in range(asked.first, asked.first + asked.seeds):
        garage = generate(GarageConfig(**settings, seed=seed))
        subject = layout_subject(garage.layout, garage.graph, garage.config, source=f"seed {seed}", kind="report")
        findings = check(subject, garage.config.standard)
        errors = [finding for finding in findings if finding.severity is Severity.ERROR]
        found.update(f"{finding.severity.value} {finding.rule}" for finding in findings)
        stalls += len(subject.parking_stalls)
        if errors:
            bad.append(seed)
            print(f"seed {seed}: {errors[0].rule} at {errors[0].place}: {errors[0].message}", flush=True)
    for rule, count in sorted(found.items()):
        print(f"{count:7d}  {rule}")
    seconds = time.perf_counter() - start
    print(f"{asked.seeds} seeds, {stalls} stalls, {asked.profile}: {len(bad)} with errors, {seconds:.0f} s")
    return int(bool(bad))


if __name__ == "__main__":
    raise SystemExit(main())
