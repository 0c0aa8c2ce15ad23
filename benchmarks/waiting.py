"""How long people wait: first, second and warm builds, checks and starts, beside an earlier version in the same run."""
# ruff: noqa: S603, S607 - git and Python are run

import importlib.util
import json
import os
import resource
import statistics
import subprocess
import sys
import tarfile
import tempfile
from collections import defaultdict
from io import BytesIO
from pathlib import Path

__all__ = ["BEFORE", "version_before", "waiting"]

HERE = Path(__file__).parent
BEFORE = "3211d42"
"""The version from before assets were shared; it compiles its loops by Numba, which has to be installed for it."""
ROUNDS = 3
LARGE_ROUNDS = 5

CONFIGS = {
    "7 x 9": "seed = 0\n",
    "20 x 30": """seed = 0
[site]
height_cells = 20
width_cells = 30
entrances = 2
exits = 2
min_portal_distance_cells = 10
""",
}

_WARM = """
import json, sys, time
from pathlib import Path
import garage2usd
config = garage2usd.load_config(Path(sys.argv[1]))
folder = Path(sys.argv[2])
garage2usd.build(config, folder / "warm.usdz")
seconds = []
for seed in range(1, 1 + int(sys.argv[3])):
    start = time.process_time()
    garage2usd.build(config, folder / f"warm_{seed}.usdz", seed=seed)
    seconds.append(time.process_time() - start)
print(json.dumps(seconds))
"""


def version_before(folder: Path) -> Path:
    """Unpack the package of the version before into a folder."""
    if importlib.util.find_spec("numba") is None:
        sys.exit(f"{BEFORE} compiles its loops by Numba: pip install numba")
    root = folder / "before"
    archive = subprocess.run(["git", "-C", HERE.parent, "archive", BEFORE], stdout=subprocess.PIPE, check=True).stdout
    with tarfile.open(fileobj=BytesIO(archive)) as files:
        files.extractall(root, filter="data")
    return root


def waiting() -> str:
    """One row for each wait: processor seconds before and now, and their ratio."""
    figures: dict[str, dict[str, list[float]]] = defaultdict(lambda: defaultdict(list))
    with tempfile.TemporaryDirectory() as folder:
        before = version_before(Path(folder))
        loads = [os.getloadavg()[0]]
        for turn in range(ROUNDS):
            for version, root in (("before", before), ("now", HERE.parent)):
                with tempfile.TemporaryDirectory(dir=folder) as room:
                    for wait, seconds in _waits(root, Path(room)).items():
                        figures[wait][version].append(seconds)
                loads.append(os.getloadavg()[0])
                print(f"round {turn + 1} of {ROUNDS}, {version}", file=sys.stderr, flush=True)
        large = _large_stages({"before": before, "now": HERE.parent}, Path(folder))
    rows = [
        "## Waiting",
        "",
        (
            f"Processor seconds, medians of {ROUNDS} rounds in turns, of this version and of {BEFORE}, from which it "
            "departed. First: as after installing, when the version before has compiled nothing yet; the first 20 x 30 "
            "comes after the first 7 x 9. Second: a command after those. Warm: a build after the first of its process, "
            "each of another seed. This version's defaults do more: plans circulate and are dimensioned, garages have "
            "stair cores and fire equipment, and each build is checked. The machine's load average was "
            f"{min(loads):.1f} to {max(loads):.1f} meanwhile, which adds to the seconds of both alike."
        ),
        "",
        "| wait | before | now | now / before |",
        "|---|---|---|---|",
    ]
    for wait, seconds in figures.items():
        old, new = (statistics.median(seconds[version]) for version in ("before", "now"))
        rows.append(f"| {wait} | {old:.2f} s | {new:.2f} s | {new / old:.2f} |")
    rows += ["", "### Garages a core-second", "", "| site | before | now | now / before |", "|---|---|---|---|"]
    for size in CONFIGS:
        seconds = figures[f"warm build of {size}"]
        old, new = (1 / statistics.median(seconds[version]) for version in ("before", "now"))
        rows.append(f"| {size} | {old:.2f} | {new:.2f} | {new / old:.2f} |")
    rows += [
        "",
        "### A stage of 200 x 300 squares",
        "",
        (
            "Authored and opened (`Usd.Stage.Open`) by each version's own `benchmarks/stage.py`, in processes of their "
            f"own: seconds, the fastest of {LARGE_ROUNDS} rounds in turns."
        ),
        "",
        "| step | before | now | now / before |",
        "|---|---|---|---|",
    ]
    for step, seconds in large.items():
        old, new = (min(seconds[version]) for version in ("before", "now"))
        rows.append(f"| {step} | {old:.2f} s | {new:.2f} s | {new / old:.2f} |")
    return "\n".join(rows)


def _large_stages(roots: dict[str, Path], folder: Path) -> dict[str, dict[str, list[float]]]:
    """Seconds of authoring and opening a large stage, by the step and the version."""
    figures: dict[str, dict[str, list[float]]] = {step: defaultdict(list) for step in ("author", "open")}

    def seconds(version: str, step: str) -> float:
        root, room = roots[version], folder / f"large_{version}"
        room.mkdir(exist_ok=True)
        done = subprocess.run(
            [sys.executable, root / "benchmarks" / "stage.py", step, "200", "300", "nested", room],
            env=os.environ | {"PYTHONPATH": str(root)}, stdout=subprocess.PIPE, check=True,
        )  # fmt: skip
        return float(json.loads(done.stdout.splitlines()[-1])["seconds"])

    for version in roots:
        seconds(version, "lay_out")
    for _ in range(LARGE_ROUNDS):
        for step, of_version in figures.items():
            for version in roots:
                of_version[version].append(seconds(version, step))
    return figures


def _waits(root: Path, room: Path) -> dict[str, float]:
    """Processor seconds of each wait with the package that lies in a folder."""
    configs = {}
    for size, text in CONFIGS.items():
        configs[size] = room / f"{size.replace(' ', '')}.toml"
        configs[size].write_text(text)
    environment = os.environ | {"PYTHONPATH": str(root), "NUMBA_CACHE_DIR": str(room / "cache")}
    environment.pop("PYTHONDONTWRITEBYTECODE", None)
    # as installing does, which also compiles the loops in C
    subprocess.run([sys.executable, "-m", "compileall", "-q", root / "garage2usd"], env=environment, check=True)

    def command(*arguments: object) -> float:
        return _seconds(["-m", "garage2usd", *map(str, arguments)], environment, room)

    waits = {}
    for when in ("first", "second"):
        for size, config in configs.items():
            waits[f"{when} `garage2usd build`, {size}"] = command("build", config, "-o", room / f"{config.stem}.usdz")
    for when in ("first", "second"):
        waits[f"{when} `garage2usd check` of a 7 x 9 .usdz"] = command("check", room / "7x9.usdz")
    for size, config in configs.items():
        done = subprocess.run(
            [sys.executable, "-c", _WARM, config, room, "4"],
            env=environment, cwd=room, stdout=subprocess.PIPE, check=True,
        )  # fmt: skip
        waits[f"warm build of {size}"] = statistics.mean(json.loads(done.stdout))
    waits["`garage2usd --help`"] = statistics.median(command("--help") for _ in range(5))
    waits["`import garage2usd`"] = statistics.median(
        _seconds(["-c", "import garage2usd"], environment, room) for _ in range(5)
    )
    return waits


def _seconds(arguments: list[str], environment: dict[str, str], room: Path) -> float:
    """Processor seconds of a Python process and its children, those of the interpreter included."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, *arguments], env=environment, cwd=room, capture_output=True, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
