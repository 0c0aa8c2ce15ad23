"""What a look that is drawn costs: garages of a data set with and without one, in turns."""
# ruff: noqa: S603 - Python is run

import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import tomllib
from collections import defaultdict
from pathlib import Path
from typing import NamedTuple

__all__ = ["looks"]

HERE = Path(__file__).parent
RECIPE = "samples/recipes/looks.toml"
FEW, MANY = 6, 54
"""Garages of a short run and of a long one, whose difference has no start of a process and no loading of code."""
ROUNDS = 3
WAYS = {"as usual": False, "drawn": True}

_SET = """
import json, sys
from garage2usd.datasets import Recipe, make_dataset

if __name__ == "__main__":
    made = make_dataset(Recipe(**json.loads(sys.argv[1])), sys.argv[2], worker_count=1)
    print(len(made.rows) - len(made.failed))
"""


class _Cost(NamedTuple):
    """What a data set took: garages that it has, processor seconds of all processes, and bytes of all files."""

    garages: int
    seconds: float
    bytes_: int


def looks() -> str:
    """Garages a core-second and bytes a garage, with looks as usual and drawn."""
    costs: dict[str, list[tuple[_Cost, _Cost]]] = defaultdict(list)
    loads = [os.getloadavg()[0]]
    for turn in range(ROUNDS):
        for way, drawn in WAYS.items():
            few, many = (_cost(count, drawn=drawn) for count in (FEW, MANY))
            costs[way].append((few, many))
            loads.append(os.getloadavg()[0])
            print(f"round {turn + 1} of {ROUNDS}, {way}: {few} {many}", file=sys.stderr, flush=True)
    return "\n".join(_table(costs, loads))


def _cost(count: int, *, drawn: bool) -> _Cost:
    recipe = tomllib.loads((HERE.parent / RECIPE).read_text())
    recipe["garage"]["look"] = {"drawn": drawn}
    with tempfile.TemporaryDirectory() as folder:
        script, made = Path(folder) / "set.py", Path(folder) / "made"
        script.write_text(_SET)
        start = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run(
            [sys.executable, str(script), json.dumps({**recipe, "count": count}), str(made)],
            env=os.environ | {"PYTHONPATH": str(HERE.parent)}, stdout=subprocess.PIPE, text=True, check=True,
        )  # fmt: skip
        end = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds = end.ru_utime + end.ru_stime - start.ru_utime - start.ru_stime
        bytes_ = sum(path.stat().st_size for path in made.rglob("*") if path.is_file())
        return _Cost(int(done.stdout), seconds, bytes_)


def _table(costs: dict[str, list[tuple[_Cost, _Cost]]], loads: list[float]) -> list[str]:
    further = {way: [(many.garages - few.garages, many, few) for few, many in rounds] for way, rounds in costs.items()}
    rates = {
        way: [count / (many.seconds - few.seconds) for count, many, few in rounds] for way, rounds in further.items()
    }
    sizes = {
        way: [(many.bytes_ - few.bytes_) / count / 1e6 for count, many, few in rounds]
        for way, rounds in further.items()
    }
    first = next(iter(costs))
    rows = [
        "## Drawn looks",
        "",
        (
            f"Data sets of `{RECIPE}` with looks as usual and with all axes drawn: the same plans, one worker, stages, "
            f"pictures of plans, reports, labels and difficulty. Medians of {ROUNDS} rounds in turns; a ratio is that "
            "of two runs of a round. A further garage is the difference of data sets of "
            f"{MANY} and {FEW} garages, the shared assets with it. The machine's load average was {min(loads):.1f} to "
            f"{max(loads):.1f} meanwhile."
        ),
        "",
        "| looks | garages a core-second | ratio | MB a garage | ratio |",
        "|---|---|---|---|---|",
    ]
    for way in costs:
        speed = statistics.median(mine / usual for mine, usual in zip(rates[way], rates[first], strict=True))
        size = statistics.median(mine / usual for mine, usual in zip(sizes[way], sizes[first], strict=True))
        rate, mb = statistics.median(rates[way]), statistics.median(sizes[way])
        rows.append(f"| {way} | {rate:.2f} | {speed:.2f} | {mb:.3f} | {size:.2f} |")
    return rows
