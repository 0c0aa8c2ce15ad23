"""Measure building, planning and stages, and write the tables of ``benchmarks/results.md``.

Usage: python benchmarks/run.py [SECTION ...], of waiting, building, planning, floor, optimisers, rules, circulation,
scale, stages, levels, drawing, exports, datasets, workers, living, looks, lidar, parking, parking_learnt, unity,
traffic, compiled and binding.

Without names all of it; with some, these sections are measured anew and the others stay. Where two figures are
compared, they are measured in turns and given as a ratio too.
"""

import json
import os
import platform
import re
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from binding import binding
from circulation import circulation
from datasets import datasets, workers
from drawing import drawing
from exports import exports
from floor_use import floor_use
from levels import levels
from lidar import lidar
from living import living
from looks import looks
from optimisers import optimisers
from parking import parking, parking_learnt
from planning import planning
from rules import rules
from scale import scale
from stage import stages
from traffic import traffic
from unity import unity
from waiting import waiting

import garage2usd

HERE = Path(__file__).parent
ROUNDS = 5
PYTHON_EPISODES = 40


def main() -> None:
    """Run what is asked for and write the tables."""
    measures = {
        "waiting": waiting,
        "building": _building,
        "planning": planning,
        "floor": floor_use,
        "optimisers": optimisers,
        "rules": rules,
        "circulation": circulation,
        "scale": scale,
        "stages": stages,
        "levels": levels,
        "drawing": drawing,
        "exports": exports,
        "datasets": datasets,
        "workers": workers,
        "living": living,
        "looks": looks,
        "lidar": lidar,
        "parking": parking,
        "parking_learnt": parking_learnt,
        "unity": unity,
        "traffic": traffic,
        "compiled": _compiled,
        "binding": binding,
    }
    asked = sys.argv[1:] or list(measures)
    if unknown := set(asked) - set(measures):
        sys.exit(f"unknown sections {', '.join(sorted(unknown))}: name some of {', '.join(measures)}")
    results = HERE / "results.md"
    kept = dict(re.findall(r"<!-- (\w+) -->\n(.*?)(?=\n\n<!-- |\Z)", results.read_text(), re.DOTALL))
    for asked_for in asked:
        # written one by one, so that an error in one loses none of the others
        kept[asked_for] = measures[asked_for]()
        marked = [f"<!-- {name} -->\n{kept[name].rstrip()}" for name in measures if name in kept]
        results.write_text("\n\n".join([_heading(), *marked]) + "\n")


def _heading() -> str:
    machine = f"{platform.machine()}, {os.cpu_count()} cores, Python {platform.python_version()}"
    return f"# Benchmarks\n\nWritten by `python benchmarks/run.py` for garage2usd on {machine}."


def _building() -> str:
    """Seconds of a warm build of each sample, and of a fresh process."""
    rows = ["## Building", "", "| sample | stalls | site | plan | layout | stage | total, median of 5 warm builds |"]
    rows.append("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for sample in sorted((HERE.parent / "samples").glob("*.toml")):
            config = garage2usd.load_config(sample)
            if config.building.levels > 1:
                continue
            output = Path(folder) / "garage.usdz"
            garage2usd.build(config, output)
            builds = [garage2usd.build(config, output) for _ in range(ROUNDS)]
            steps = {step: statistics.median(b.seconds[step] for b in builds) for step in builds[0].seconds}
            total = statistics.median(sum(b.seconds.values()) for b in builds)
            figures = " | ".join(f"{value:.3f} s" for value in steps.values())
            rows.append(f"| {sample.stem} | {len(builds[0].garage.layout.stalls)} | {figures} | {total:.2f} s |")
    imports = [_seconds_of("import garage2usd") - _seconds_of("pass") for _ in range(ROUNDS)]
    rows += [
        "",
        f"`import garage2usd` on top of starting Python: {statistics.median(imports):.3f} s, median of {ROUNDS}.",
    ]
    return "\n".join(rows)


def _compiled() -> str:
    """Actions per second of the loop in C over those of plain Python, to which tests hold it."""
    pairs = [(_actions_per_second(_LEARN_IN_C), _actions_per_second(_LEARN_SLOWLY)) for _ in range(3)]
    ratio = statistics.median(fast / slow for fast, slow in pairs)
    fast, slow = (statistics.median(rates) for rates in zip(*pairs, strict=True))
    rows = ["## Sarsa in C against plain Python", "", "| code | actions/s on 7x9, `paper` | ratio |", "|---|---|---|"]
    rows += [
        f"| `native/sarsa.c` | {fast:,.0f} | {ratio:.0f} |",
        f"| `garage2usd/planning/reference_sarsa.py` | {slow:,.0f} | 1 |",
    ]
    return "\n".join(rows)


_SITE = """
import json, time
from garage2usd.config import BayConfig, PlanConfig, SiteConfig
from garage2usd.site import make_site
site = make_site(SiteConfig(entrance_cells=((6, 2),), exit_cells=((6, 6),)), bay=BayConfig(), seed=0)
"""
_LEARN_IN_C = f"""{_SITE}
from garage2usd.planning import plan_lanes
plan = PlanConfig(preset="paper", climb=False, archive_size=10, episodes=5000)
start = time.perf_counter()
steps = plan_lanes(site, plan=plan, bay=BayConfig(), seed=1).steps
print(json.dumps(steps / (time.perf_counter() - start)))
"""
_LEARN_SLOWLY = f"""{_SITE}
from garage2usd.planning.decision import DecisionProcess
from garage2usd.planning.reference_sarsa import ReferenceSarsa, SplitMix64
plan = PlanConfig(preset="paper", climb=False)
slow = ReferenceSarsa(DecisionProcess(site, BayConfig(), plan.resolved()), plan, SplitMix64(1), 10)
start = time.perf_counter()
for _ in range({PYTHON_EPISODES}):
    slow.episode()
print(json.dumps(slow.steps / (time.perf_counter() - start)))
"""


def _actions_per_second(code: str) -> float:
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(map(str, (HERE.parent, HERE.parent / "tests")))}
    run = subprocess.run([sys.executable, "-c", code], env=environment, check=True, capture_output=True)  # noqa: S603
    return float(json.loads(run.stdout))


def _seconds_of(code: str) -> float:
    start = time.perf_counter()
    subprocess.run([sys.executable, "-c", code], check=True)  # noqa: S603
    return time.perf_counter() - start


if __name__ == "__main__":
    main()
