"""What a garage of a data set costs, beside one of the loop of the guide, and how much memory a worker takes."""
# ruff: noqa: S603 - Python is run

import json
import os
import re
import resource
import statistics
import subprocess
import sys
import tempfile
import tomllib
from collections import defaultdict
from pathlib import Path
from typing import NamedTuple

from waiting import BEFORE, version_before

__all__ = ["datasets", "workers"]

HERE = Path(__file__).parent
GUIDE = "docs/guides/first_garages.md"
FEW, MANY = 4, 64
"""Garages of a short run and of a long one, whose difference has no starts of processes and no loading of code."""
ROUNDS = 3
LARGE = {"site": {"height_cells": 20, "width_cells": 30, "entrances": 2, "exits": 2, "min_portal_distance_cells": 10}}
LARGE_COUNT = 100
THOUSANDS = 10_000

_SET = """
import json, sys
from pathlib import Path
from garage2usd.datasets import Recipe, make_dataset

if __name__ == "__main__":
    garage = json.loads(sys.argv[1])
    recipe = Recipe(name="small", count=int(sys.argv[2]), distinct="seed", garage=garage, make={"difficulty": False})
    made = make_dataset(recipe, sys.argv[3], worker_count=int(sys.argv[4]))
    print(len(made.rows) - len(made.failed))
"""

_MEMORY = """
import json, sys
from pathlib import Path
import psutil
from garage2usd.datasets import Recipe, make_dataset

peaks = []

def peak_mb(process):
    lines = Path(f"/proc/{process.pid}/status").read_text().splitlines()
    return next(float(line.split()[1]) for line in lines if line.startswith("VmHWM:")) / 1024

def progress(step, done, total):
    if step == "garages" and done:
        peaks.append(max(map(peak_mb, psutil.Process().children(recursive=True))))

if __name__ == "__main__":
    recipe = Recipe(name="large", count=int(sys.argv[2]), garage=json.loads(sys.argv[1]), shards={"garages": 1})
    make_dataset(recipe, sys.argv[3], worker_count=1, progress=progress)
    print(json.dumps(peaks))
"""


class _Cost(NamedTuple):
    """What a run took: garages that it made, processor seconds of all its processes, and bytes written."""

    garages: int
    seconds: float
    bytes_: int
    shared_bytes: int


def datasets() -> str:
    """Garages per core-second and bytes a garage of the loop and of a data set."""
    figures: dict[str, list[tuple[_Cost, _Cost]]] = defaultdict(list)
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        before = version_before(place)
        guide = (before / GUIDE).read_text()
        for name in ("small.toml", "many.py"):
            (place / name).write_text(_block(guide, name))
        (place / "set.py").write_text(_SET)
        ways = {
            f"the loop, {BEFORE}": (before, False),
            "the loop, now": (HERE.parent, False),
            "a data set": (HERE.parent, True),
        }
        for root, is_set in ways.values():  # compiles
            _cost(place, root, FEW, is_set=is_set)
        loads = [os.getloadavg()[0]]
        for turn in range(ROUNDS):
            for way, (root, is_set) in ways.items():
                few, many = (_cost(place, root, count, is_set=is_set) for count in (FEW, MANY))
                figures[way].append((few, many))
                loads.append(os.getloadavg()[0])
                print(f"round {turn + 1} of {ROUNDS}, {way}: {few} {many}", file=sys.stderr, flush=True)
    return "\n".join(_table(figures, loads))


def workers() -> str:
    """The most that was resident of a worker, in the course of a data set of large garages."""
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        (place / "memory.py").write_text(_MEMORY)
        done = subprocess.run(
            [sys.executable, place / "memory.py", json.dumps(LARGE), str(LARGE_COUNT), place / "large"],
            env=os.environ | {"PYTHONPATH": str(HERE.parent)}, stdout=subprocess.PIPE, text=True, check=True,
        )  # fmt: skip
    peaks = [float(peak) for peak in json.loads(done.stdout)]
    return "\n".join(
        [
            "## Memory of a data set's worker",
            "",
            f"The most that was resident of the one worker of a data set of {LARGE_COUNT} garages of 20 x 30 squares.",
            "",
            "| after garage | peak resident |",
            "|---|---|",
            *(f"| {number} | {peaks[number - 1]:.0f} MB |" for number in (1, 5, 10, 20, 40, 70, LARGE_COUNT)),
        ]
    )


def _cost(place: Path, root: Path, count: int, *, is_set: bool) -> _Cost:
    """What the loop costs with the package in a folder, or a data set."""
    environment = os.environ | {"PYTHONPATH": str(root), "NUMBA_CACHE_DIR": str(place / f"cache_of_{root.name}")}
    with tempfile.TemporaryDirectory(dir=place) as name:
        room = Path(name)
        (room / "small.toml").write_text((place / "small.toml").read_text())
        settings = tomllib.loads((place / "small.toml").read_text())
        del settings["seed"]
        command: list[object] = [place / "many.py", count]
        if is_set:
            command = [place / "set.py", json.dumps(settings), count, room / "made", os.cpu_count()]
        start = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run(
            [sys.executable, *map(str, command)],
            env=environment, cwd=room, stdout=subprocess.PIPE, text=True, check=True,
        )  # fmt: skip
        end = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds = end.ru_utime + end.ru_stime - start.ru_utime - start.ru_stime
        if not is_set:
            made = len(list((room / "garages").glob("*.usdz")))
            return _Cost(made, seconds, _bytes_below(room / "garages"), 0)
        return _Cost(int(done.stdout), seconds, _bytes_below(room / "made"), _bytes_below(room / "made" / "assets"))


def _table(figures: dict[str, list[tuple[_Cost, _Cost]]], loads: list[float]) -> list[str]:
    count = min(map(len, figures.values()))
    rows = [
        "## Data sets",
        "",
        (
            f"Garages by `many.py` and `small.toml` of the guide of {BEFORE}, with the package of then and of now, and "
            "a data set of the same settings and files (stage, picture, report, labels), plans that are equal allowed. "
            f"Medians of {count} round{'s' * (count > 1)} in turns, machine code in the cache; processor seconds of "
            "all processes, of which there are as many as cores. A further garage is the difference of runs of "
            f"{MANY} and {FEW}, in "
            "which there are no starts of processes; of a whole run of "
            f"{MANY} they are a part. Bytes are of all files, a data set's shared assets and manifest with them; for "
            f"{THOUSANDS:,} garages these are taken to share as much as {MANY} do. The machine's load average was "
            f"{min(loads):.1f} to {max(loads):.1f} meanwhile."
        ),
        "",
        "| garages of | a core-second, further | ratio | a core-second, whole run | ratio |",
        "|---|---|---|---|---|",
    ]
    each = {
        way: statistics.median((many.garages - few.garages) / (many.seconds - few.seconds) for few, many in rounds)
        for way, rounds in figures.items()
    }
    whole = {
        way: statistics.median(many.garages / many.seconds for _, many in rounds) for way, rounds in figures.items()
    }
    first = next(iter(figures))
    rows += [
        f"| {way} | {each[way]:.2f} | {each[way] / each[first]:.2f} | {whole[way]:.2f} | "
        f"{whole[way] / whole[first]:.2f} |"
        for way in figures
    ]
    rows += [
        "",
        f"| garages of | bytes each, {MANY} | ratio | bytes each, {THOUSANDS:,} | ratio |",
        "|---|---|---|---|---|",
    ]
    sizes = {way: rounds[-1][1] for way, rounds in figures.items()}
    least = sizes[first].bytes_ / sizes[first].garages
    for way, size in sizes.items():
        now = size.bytes_ / size.garages
        far = (size.bytes_ - size.shared_bytes) / size.garages + size.shared_bytes / THOUSANDS
        rows.append(f"| {way} | {now:,.0f} | {now / least:.3f} | {far:,.0f} | {far / least:.3f} |")
    return rows


def _block(guide: str, name: str) -> str:
    """A block of a page that its first line names."""
    found = re.search(rf"^```\w+\n(# {re.escape(name)}\n.*?)^```", guide, re.DOTALL | re.MULTILINE)
    if found is None:
        sys.exit(f"{GUIDE} has no {name}")
    return found[1]


def _bytes_below(folder: Path) -> int:
    return sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())
