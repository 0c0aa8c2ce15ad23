"""How fast the Unity package's C# readers read the layers of a stage, beside USD's own.

Usage: python benchmarks/unity.py   (this part alone, to the standard output)
"""

import json
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from pxr import Sdf

__all__ = ["unity"]

HERE = Path(__file__).parent
PACKAGE = HERE.parent / "unity_importer"
ROWS, COLS = 40, 60
ROUNDS = 5
SECONDS = 0.5
"""Of processor time that the C# readers spend on a layer in each round; they read it once before, uncounted."""

LAYERS = {
    "garage, nested": ("nested", "garage.usdc"),
    "garage, instanced": ("instanced", "garage.usdc"),
    "lane graph": ("nested", "garage_assets/LaneGraph.usdc"),
    "a car": ("nested", "garage_assets/Car_01.usdc"),
}


def unity() -> str:
    """A table of the speed of both readers on layers of a stage, as text and as crate."""
    rows = [
        "## Reading layers in Unity's C#",
        "",
        (
            f"Layers of a stage of {ROWS} x {COLS} squares, as `.usda` and as `.usdc`: whole files in memory to all "
            "opinions and values, by the package's core under Mono, warm; beside it `Sdf.Layer.OpenAsAnonymous`, which "
            "leaves values of crates in the file until they are asked for. Processor seconds, medians of "
            f"{ROUNDS} rounds in turns. As text: megabytes of the same layer as `.usda` a second, as crates of garages "
            "are compressed and share equal values."
        ),
        "",
        "| layer | format | file | C# | as text | pxr | pxr / C# |",
        "|---|---|---|---|---|---|---|",
    ]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        program = _compiled(folder)
        for layer, (form, file) in LAYERS.items():
            crate = _stage(folder, form) / file
            text = crate.with_suffix(".usda")
            Sdf.Layer.FindOrOpen(str(crate)).Export(str(text))
            rows += [_row(layer, path, text.stat().st_size / 1e6, program) for path in (text, crate)]
    return "\n".join(rows)


def _compiled(folder: Path) -> Path:
    program = folder / "UsdDump.exe"
    sources = [*(PACKAGE / "Core").rglob("*.cs"), *(PACKAGE / "Tools~" / "UsdDump").rglob("*.cs")]
    command = ["mcs", "-langversion:7.2", "-optimize+", "-r:System.Core", f"-out:{program}", *map(str, sources)]
    subprocess.run(command, check=True)  # noqa: S603
    return program


def _stage(folder: Path, form: str) -> Path:
    """The folder of a stage in a form, written once."""
    stage = folder / form
    if not stage.exists():
        stage.mkdir()
        command = [sys.executable, str(HERE / "stage.py"), "lay_out", str(ROWS), str(COLS), form, str(stage)]
        subprocess.run(command, check=True, capture_output=True)  # noqa: S603
    return stage


def _row(layer: str, path: Path, text_mb: float, program: Path) -> str:
    pairs = [(_seconds_of_core(path, program), _seconds_of_pxr(path)) for _ in range(ROUNDS)]
    ratio = statistics.median(theirs / ours for ours, theirs in pairs)
    ours, theirs = (statistics.median(seconds) for seconds in zip(*pairs, strict=True))
    megabytes = path.stat().st_size / 1e6
    return (
        f"| {layer} | `{path.suffix}` | {megabytes:.2f} MB | {megabytes / ours:.0f} MB/s | {text_mb / ours:.0f} MB/s "
        f"| {megabytes / theirs:.0f} MB/s | {ratio:.2f} |"
    )


def _seconds_of_core(path: Path, program: Path) -> float:
    command = ["mono", str(program), "time", str(SECONDS), str(path)]
    run = subprocess.run(command, check=True, capture_output=True)  # noqa: S603
    return float(json.loads(run.stdout)["seconds"])


def _seconds_of_pxr(path: Path) -> float:
    """Of one opening among as many as fill the time."""
    count, start = 0, time.process_time()
    while time.process_time() - start < SECONDS:
        Sdf.Layer.OpenAsAnonymous(str(path))
        count += 1
    return (time.process_time() - start) / count


if __name__ == "__main__":
    print(unity())
