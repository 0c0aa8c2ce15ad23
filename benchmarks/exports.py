"""What exports cost: each format of the largest sample, beside building it in the same process and as commands."""

import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections import defaultdict
from pathlib import Path

import garage2usd
from garage2usd.common.system import cores

__all__ = ["exports"]

HERE = Path(__file__).parent
SAMPLE = "large_20x30"
FORMATS = ("glb", "osm", "xodr", "xosc", "yaml")
ROUNDS = 3
CORES = cores()


def exports() -> str:
    """Processor seconds and bytes of each format, and of all together, over those of a warm build."""
    config = garage2usd.load_config(HERE.parent / "samples" / f"{SAMPLE}.toml")
    seconds: dict[str, list[float]] = defaultdict(list)
    sizes = {}
    loads = [os.getloadavg()[0]]
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        for round_ in range(1 + ROUNDS):
            start = time.process_time()
            built = garage2usd.build(config, place / "garage.usdc")
            taken = {"building the stage": time.process_time() - start}
            for name, formats in {**{name: (name,) for name in FORMATS}, "all at once": FORMATS}.items():
                start = time.process_time()
                outputs = [place / name / f"garage.{suffix}" for suffix in formats]
                garage2usd.export(built.stage, outputs, settings=config.maps)
                taken[name] = time.process_time() - start
                sizes[name] = sum(output.stat().st_size for output in outputs)
            if round_:  # the first one compiles and loads
                for name, value in taken.items():
                    seconds[name].append(value)
            loads.append(os.getloadavg()[0])
        commands = {workers: [_commands(place, workers) for _ in range(ROUNDS)] for workers in (1, CORES)}
    building = statistics.median(seconds["building the stage"])
    rows = [
        "## Exports",
        "",
        f"Sample {SAMPLE}, warm, median of {ROUNDS} rounds in turns; together the formats read the stage once.",
        "",
        "| what | processor seconds | over building | bytes |",
        "|---|---|---|---|",
    ]
    for name, values in seconds.items():
        median = statistics.median(values)
        size = f"{sizes[name]:,}" if name in sizes else ""
        rows.append(f"| {name} | {median:.2f} | {median / building:.2f} | {size} |")
    exporting = statistics.median(seconds["all at once"])
    rows += [
        "",
        (
            f"Exporting to all formats against building: in a process the medians above, and of {ROUNDS} pairs of "
            "commands, with what each imports: the time until they end and the processor seconds. `export` writes as "
            "many files at a time as the machine has cores. The load average was "
            f"{min(loads):.1f} to {max(loads):.1f} meanwhile, which adds to the seconds of both alike."
        ),
        "",
        "| how | building | exporting to all | exporting / building |",
        "|---|---|---|---|",
        _row("in a process, warm, processor seconds", building, exporting),
    ]
    for workers, pairs in commands.items():
        name = "as commands" if workers == CORES else f"as commands, `--workers {workers}`"
        for number, what in enumerate(("time", "processor seconds")):
            building, exporting = (
                statistics.median(taken[number] for taken in column) for column in zip(*pairs, strict=True)
            )
            rows.append(_row(f"{name}, {what}", building, exporting))
    return "\n".join(rows)


def _row(how: str, build_s: float, export_s: float) -> str:
    return f"| {how} | {build_s:.2f} s | {export_s:.2f} s | {export_s / build_s:.2f} |"


def _commands(place: Path, workers: int) -> tuple[tuple[float, float], tuple[float, float]]:
    """What a command that builds takes, and one that exports, each with what it imports."""
    stage = place / "commands" / "garage.usdc"
    outputs = [part for suffix in FORMATS for part in ("-o", stage.with_suffix(f".{suffix}"))]
    build = "build", HERE.parent / "samples" / f"{SAMPLE}.toml", "-o", stage
    return _seconds_of(*build), _seconds_of("export", stage, "--workers", str(workers), *outputs)


def _seconds_of(*arguments: str | Path) -> tuple[float, float]:
    """Seconds until a command ends, and those of processors."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    command = [sys.executable, "-c", "from garage2usd.cli import run; run()", *map(str, arguments)]
    subprocess.run(command, check=True, capture_output=True)  # noqa: S603
    after, end = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    return end - start, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
