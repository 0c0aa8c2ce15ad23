"""Building three levels beside one of the same size, and authoring their stage beside a plain export of its layers.

Usage: python benchmarks/levels.py STEP   (one measurement, in a process of its own)
"""

import json
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from pxr import Sdf

import garage2usd
from garage2usd.config import GarageConfig
from garage2usd.stage import write_stage

__all__ = ["levels"]

SAMPLE = Path(__file__).parents[1] / "samples" / "large_20x30.toml"
STEPS = ("one", "three", "stage")
ROUNDS = 3


def levels() -> str:
    """A table of processor time for one and for three levels, and of the stage's layers beside their export."""
    figures: dict[str, list[dict[str, float]]] = {step: [] for step in STEPS}
    for _ in range(ROUNDS):
        for step in STEPS:
            run = subprocess.run([sys.executable, __file__, step], check=True, capture_output=True)  # noqa: S603
            figures[step].append(json.loads(run.stdout.splitlines()[-1]))
    one, three = (min(round_["cpu_s"] for round_ in figures[step]) for step in ("one", "three"))
    authored, exported = (min(round_[name] for round_ in figures["stage"]) for name in ("authored_s", "exported_s"))
    stalls = [figures[step][0]["stalls"] for step in ("one", "three")]
    return "\n".join(
        [
            "## Levels",
            "",
            (
                f"`samples/large_20x30.toml` with one level ({stalls[0]:.0f} stalls) and with three ({stalls[1]:.0f}), "
                "built with all files, with what child processes take. Authored: all layers of the "
                "three levels, assets apart, which are there already. Floor: `Layer.Export` of these layers. All "
                f"are processor time, the least of {ROUNDS} rounds in turns."
            ),
            "",
            "| one level | three levels | three / one | authored | floor | authored / floor |",
            "|---|---|---|---|---|---|",
            (
                f"| {one:.1f} s | {three:.1f} s | {three / one:.2f} | {authored:.2f} s | {exported:.2f} s "
                f"| {authored / exported:.2f} |"
            ),
        ]
    )


def _config(count: int) -> GarageConfig:
    config = garage2usd.load_config(SAMPLE)
    return config.model_copy(update={"building": config.building.model_copy(update={"levels": count})})


def _built(count: int, folder: Path) -> dict[str, float]:
    config, path = _config(count), folder / "garage.usdc"
    stalls = garage2usd.build(config, path).garage.parking_stalls
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return {"cpu_s": sum(own.ru_utime + own.ru_stime for own in used), "stalls": stalls}


def _stage(folder: Path) -> dict[str, float]:
    garage = garage2usd.generate(_config(3))
    shared = folder / "assets"
    shared.mkdir()

    def author(name: str) -> Path:
        path = folder / name / "garage.usdc"
        path.parent.mkdir()
        write_stage(garage, path, shared=shared)
        return path.parent

    author("first")
    start = time.process_time()
    written = author("second")
    authored = time.process_time() - start
    layers = [Sdf.Layer.FindOrOpen(str(file)) for file in sorted(written.rglob("*.usd*"))]
    start = time.process_time()
    for layer in layers:
        layer.Export(str(folder / "exported.usdc"))
    return {"authored_s": authored, "exported_s": time.process_time() - start}


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        step = sys.argv[1]
        print(json.dumps(_stage(Path(name)) if step == "stage" else _built(1 if step == "one" else 3, Path(name))))
