"""Time and bytes of usual garages against those of another version, in turns.

    git archive COMMIT | tar -x -C other; (cd other && PYTHONPATH=. python hatch_build.py)
    python benchmarks/against.py other --rounds 10

``other`` is a folder with another version and its compiled loops. Each round plans and builds the same garages, of the
default settings, with either version in a fresh process, first one and then the other by turns. The table has the
median of the seconds of the processor and of the ratios of each round; a garage that is another one is named.
"""

import argparse
import json
import statistics
import subprocess
import sys
from pathlib import Path

OWN = Path(__file__).parents[1]
SITES = {"7 x 9": (9, 7), "12 x 16": (16, 12), "20 x 30": (30, 20)}
RUN = """
import hashlib, json, sys, tempfile, time
from pathlib import Path
from garage2usd import GarageConfig, build, generate
found = {}
for name, (width, height) in json.loads(sys.argv[1]).items():
    config = GarageConfig(seed=1, site={"width_cells": width, "height_cells": height})
    generate(config)
    start = time.process_time()
    for seed in range(2):
        garage = generate(config, seed=seed)
    planned = time.process_time() - start
    with tempfile.TemporaryDirectory() as folder:
        stage = Path(folder) / "a.usda"
        start = time.process_time()
        build(config, stage)
        built = time.process_time() - start
    counts = sorted((str(kind), count) for kind, count in garage.layout.counts().items() if count)
    of = garage.plan.structure.digest() + repr(counts)
    found[name] = {"plan and lay out": planned / 2, "build": built, "garage": hashlib.sha256(of.encode()).hexdigest()}
print(json.dumps(found))
"""

Figures = dict[str, dict[str, float | str]]


def measured(folder: Path) -> Figures:
    """Return the seconds and the digests of all garages with the version in a folder."""
    command = [sys.executable, "-c", RUN, json.dumps(SITES)]
    done = subprocess.run(  # noqa: S603 - this module's own text
        command, env={"PYTHONPATH": str(folder)}, cwd=folder, check=True, capture_output=True
    )
    found: Figures = json.loads(done.stdout)
    return found


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("other", type=Path, help="folder of the other version")
    parser.add_argument("--rounds", type=int, default=10)
    arguments = parser.parse_args()
    versions = {"this": OWN, "other": arguments.other.resolve()}
    rounds = []
    for number in range(arguments.rounds):
        order = list(versions) if number % 2 else list(versions)[::-1]
        rounds.append({name: measured(versions[name]) for name in order})
    print("| | other, s | this, s | ratio, median | least | most |\n|---|---|---|---|---|---|")
    for site in SITES:
        for step in ("plan and lay out", "build"):
            pairs = [(float(each["other"][site][step]), float(each["this"][site][step])) for each in rounds]
            ratios = sorted(now / before for before, now in pairs)
            before, now = (statistics.median(side) for side in zip(*pairs, strict=True))
            print(
                f"| {site}, {step} | {before:.3f} | {now:.3f} | {statistics.median(ratios):.3f} "
                f"| {ratios[0]:.3f} | {ratios[-1]:.3f} |"
            )
    for site in SITES:
        garages = {each[version][site]["garage"] for each in rounds for version in versions}
        if len(garages) > 1:
            print(f"{site}: not the same garage")


if __name__ == "__main__":
    main()
