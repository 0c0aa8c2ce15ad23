"""How fast the Unity package reads layers, beside USD's own reader, and makes prefabs.

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

HERE = Path(__file__).parent
sys.path.append(str(HERE.parent / "tests"))

from support.unity.layer import compile_prefab_dump  # noqa: E402
from support.unity.reader import compile_program  # noqa: E402

__all__ = ["unity"]

ROWS, COLS = 40, 60
ROUNDS = 5
SECONDS = 0.5
"""Of processor time that the C# readers spend on a layer in each round; they read it once before, uncounted."""

LAYERS = {
    "lane graph": ("nested", "garage_assets/LaneGraph.usdc"),
    "a car": ("nested", "garage_assets/Car_*.usdc"),
    "garage, nested": ("nested", "garage.usdc"),
    "garage, instanced": ("instanced", "garage.usdc"),
}
WHOLE = {"all layers, nested": "nested", "all layers, instanced": "instanced"}
"""Everything that is read for a stage but its textures."""
FORMS = ("nested", "instanced")
"""The first is what ``form = "auto"`` makes of a garage of this size."""


def unity() -> str:
    """Two tables: layers as text and as crate through both readers, and stages to prefabs."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        return "\n".join([*_reading(folder), "", *_prefabs(folder)])


def _reading(folder: Path) -> list[str]:
    rows = [
        "## Reading layers in Unity's C#",
        "",
        (
            f"Layers of a stage of {ROWS} x {COLS} squares, as `.usda` and as `.usdc`: whole files in memory to all "
            "opinions and values, by the package's core under Mono, warm; beside it `Sdf.Layer.OpenAsAnonymous`, which "
            "leaves values of crates in the file until they are asked for. Processor seconds, medians of "
            f"{ROUNDS} rounds in turns. Lane graph and car are arrays of numbers, which a crate holds nearly as they "
            "are. The garages are very many small opinions, of which a crate packs each into a few bytes, so that "
            "bytes of the file say little there; hence the column as text: megabytes of the same layer as `.usda` a "
            "second. All layers are the garage's with those of its assets, one after the other. Prims and lines that "
            "repeat, as they do in a garage, are read once from text."
        ),
        "",
        "| layer | format | file | specs | C# | as text | pxr | pxr / C# |",
        "|---|---|---|---|---|---|---|---|",
    ]
    program = compile_program(folder)
    for layer, (form, file) in LAYERS.items():
        crate = min(_stage(folder, form).glob(file))
        text = crate.with_suffix(".usda")
        opened = Sdf.Layer.FindOrOpen(str(crate))
        opened.Export(str(text))
        rows += [_row(layer, [path], _spec_count(opened), _megabytes([text]), program) for path in (text, crate)]
    for layer, form in WHOLE.items():
        crates = sorted(_stage(folder, form).rglob("*.usdc"))
        texts = [crate.with_suffix(".usda") for crate in crates]
        opened_layers = [Sdf.Layer.FindOrOpen(str(crate)) for crate in crates]
        for opened, text in zip(opened_layers, texts, strict=True):
            opened.Export(str(text))
        specs = sum(_spec_count(opened) for opened in opened_layers)
        rows += [_row(layer, paths, specs, _megabytes(texts), program) for paths in (texts, crates)]
    return rows


def _megabytes(paths: list[Path]) -> float:
    return sum(path.stat().st_size for path in paths) / 1e6


def _spec_count(layer: Sdf.Layer) -> int:
    paths: list[Sdf.Path] = []
    layer.Traverse(Sdf.Path.absoluteRootPath, paths.append)
    return len(paths)


def _prefabs(folder: Path) -> list[str]:
    """Rows of what a whole import costs on the fakes."""
    rows = [
        "## Prefabs in Unity's C#",
        "",
        (
            f"A garage of {ROWS} x {COLS} squares from its files to the prefab on the fakes of Unity's classes, as the "
            "importer makes it: reading all layers and textures, composing, triangles, one Mesh for all equal "
            "ones, GameObjects, components, labels and lane graph. Processor seconds under Mono, medians of "
            f"{ROUNDS} imports in one process after a first. Unity's own objects cost what Unity takes for them, which "
            "is not measured."
        ),
        "",
        "| form | read and compose | make | whole | GameObjects | with a mesh | assets |",
        "|---|---|---|---|---|---|---|",
    ]
    program = compile_prefab_dump(folder)
    for form in FORMS:
        stage = _stage(folder, form) / "garage.usdc"
        command = ["mono", str(program), "time", str(stage), str(ROUNDS + 1)]
        run = subprocess.run(command, check=True, capture_output=True)  # noqa: S603
        imports = json.loads(run.stdout)["imports"][1:]
        read, make, total = (statistics.median(one[key] for one in imports) for key in ("read_s", "make_s", "total_s"))
        counts = " | ".join(f"{imports[0][key]:,}" for key in ("objects", "renderers", "assets"))
        rows.append(f"| {form} | {read:.2f} s | {make:.2f} s | {total:.2f} s | {counts} |")
    return rows


def _stage(folder: Path, form: str) -> Path:
    """The folder of a stage in a form, written once."""
    stage = folder / form
    if not stage.exists():
        stage.mkdir()
        command = [sys.executable, str(HERE / "stage.py"), "lay_out", str(ROWS), str(COLS), form, str(stage)]
        subprocess.run(command, check=True, capture_output=True)  # noqa: S603
    return stage


def _row(layer: str, paths: list[Path], specs: int, text_mb: float, program: Path) -> str:
    pairs = [(_seconds_of_core(paths, program), _seconds_of_pxr(paths)) for _ in range(ROUNDS)]
    ratio = statistics.median(theirs / ours for ours, theirs in pairs)
    ours, theirs = (statistics.median(seconds) for seconds in zip(*pairs, strict=True))
    megabytes = _megabytes(paths)
    return (
        f"| {layer} | `{paths[0].suffix}` | {megabytes:.2f} MB | {specs:,} | {megabytes / ours:.0f} MB/s "
        f"| {text_mb / ours:.0f} MB/s | {megabytes / theirs:.0f} MB/s | {ratio:.2f} |"
    )


def _seconds_of_core(paths: list[Path], program: Path) -> float:
    command = ["mono", str(program), "time", str(SECONDS), *map(str, paths)]
    run = subprocess.run(command, check=True, capture_output=True)  # noqa: S603
    return float(json.loads(run.stdout)["seconds"])


def _seconds_of_pxr(paths: list[Path]) -> float:
    """Of opening all of them, once among as many times as fill the time."""
    count, start = 0, time.process_time()
    while time.process_time() - start < SECONDS:
        for path in paths:
            Sdf.Layer.OpenAsAnonymous(str(path))
        count += 1
    return (time.process_time() - start) / count


if __name__ == "__main__":
    print(unity())
