"""Measure building, planning and stages, and write the tables of ``benchmarks/results.md``.

Usage: python benchmarks/run.py [SECTION ...], of waiting, building, planning, rules, circulation, scale, stages,
exports, datasets, workers, lidar, unity and compiled.

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

from circulation import circulation
from datasets import datasets, workers
from exports import exports
from lidar import lidar
from planning import planning
from rules import rules
from scale import scale
from stage import stages
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
        "rules": rules,
        "circulation": circulation,
        "scale": scale,
        "stages": stages,
        "exports": exports,
        "datasets": datasets,
        "workers": workers,
        "lidar": lidar,
        "unity": unity,
        "compiled": _compiled,
    }
    asked = sys.argv[1:] or list(measures)
    if unknown := set(asked) - set(measures):
        sys.exit(f"unknown sections {', '.join(sorted(unknown))}: name some of {', '.join(measures)}")
    results = HERE / "results.md"
    kept = dict(re.findall(r"<!-- (\w+) -->\n(.*?)(?=\n\n<!-- |\Z)", results.read_text(), re.DOTALL))
    sections = {
        name: measures[name]() if name in asked else kept[name].rstrip() for name in measures if name in {*asked, *kept}
    }
    marked = [f"<!-- {name} -->\n{section}" for name, section in sections.items()]
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
    """Steps per second of the compiled planner over the same code run by Python itself."""
    pairs = [(_steps_per_second(compiled=True), _steps_per_second(compiled=False)) for _ in range(3)]
    ratio = statistics.median(fast / slow for fast, slow in pairs)
    fast, slow = (statistics.median(rates) for rates in zip(*pairs, strict=True))
    rows = ["## Compiled against pure Python", "", "| code | actions/s on 7x9, `paper` | ratio |", "|---|---|---|"]
    rows += [f"| numba | {fast:,.0f} | {ratio:.0f} |", f"| the same, `NUMBA_DISABLE_JIT=1` | {slow:,.0f} | 1 |"]
    return "\n".join(rows)


def _steps_per_second(*, compiled: bool) -> float:
    episodes = 5000 if compiled else PYTHON_EPISODES
    code = f"""
import json, time
from garage2usd.config import BayConfig, PlanConfig, SiteConfig
from garage2usd.planning import plan_lanes
from garage2usd.site import make_site
site = make_site(SiteConfig(entrance_cells=((6, 2),), exit_cells=((6, 6),)), bay=BayConfig(), seed=0)
def run(episodes):
    plan = PlanConfig(preset="paper", climb=False, archive_size=10, episodes=episodes)
    return plan_lanes(site, plan=plan, bay=BayConfig(), seed=1).steps
run(5)
start = time.perf_counter()
steps = run({episodes})
print(json.dumps(steps / (time.perf_counter() - start)))
"""
    environment = {**os.environ, "NUMBA_DISABLE_JIT": "0" if compiled else "1"}
    run = subprocess.run([sys.executable, "-W", "ignore", "-c", code], env=environment, check=True, capture_output=True)  # noqa: S603
    return float(json.loads(run.stdout))


def _seconds_of(code: str) -> float:
    start = time.perf_counter()
    subprocess.run([sys.executable, "-c", code], check=True)  # noqa: S603
    return time.perf_counter() - start


if __name__ == "__main__":
    main()
