"""Authoring, opening and traversing stages of growing size, beside naive authoring and the floor of a plain export.

Usage: python benchmarks/stage.py STEP ROWS COLS FORM FOLDER   (one measurement, in a process of its own)
"""

import json
import pickle
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from memory import peak_mb, resident_mb
from pxr import Gf, Kind, Sdf, Usd, UsdGeom, UsdSemantics

from garage2usd.config import GarageConfig
from garage2usd.config.outputs import StageForm
from garage2usd.layout import Layout, lay_out
from garage2usd.objects import KINDS, Spec
from garage2usd.stage import arrangement_of
from garage2usd.stage.arrangement import arrange
from garage2usd.stage.asset_files import asset_file
from garage2usd.stage.curves import LANE_GRAPH_FILE
from garage2usd.stage.garage_layer import write_garage_layer
from garage2usd.stage.labels import OBJECT_LABELS
from garage2usd.stage.level_stage import write_level_stage
from garage2usd.stage.prototypes import Prototype, name_prototypes
from garage2usd.structure.grid import Cell, Structure
from garage2usd.structure.lane_graph import LaneSquares, build_lane_graph

__all__ = ["stages"]

ASSETS = "garage_assets"
_LAYOUT_FILE = "layout.pickle"

FORMS = ((7, 9, "instanced"), (40, 60, "instanced"), (40, 60, "nested"), (200, 300, "nested"))
ROUNDS = {7: 5, 40: 3, 200: 5}
STEPS = ("lay_out", "naive", "author", "export", "open", "traverse", "blender")
_HUGE_ROWS = 200
"""From here on neither the naive way, which takes more than ten minutes, nor Blender, which makes an object of each
instance, is measured."""


def stages() -> str:
    """A table of seconds and peak memory for each size and form."""
    rows = [
        "## Stages",
        "",
        (
            "The garage's own layers (`.usdc`, assets apart) of combs of aisles, 60 % of the stalls with a car. Naive: "
            "the same objects by `UsdGeom` on an open stage, instanced, without lane graph, stall attributes and "
            "variants. Floor: `Layer.Export` of the authored layers. Open: `Usd.Stage.Open` with all assets. Blender: "
            "`usd_import` of the whole stage. Peak memory of the whole process: naive and authored read the finished "
            "layout from a file; own is what authoring adds to the libraries and the layout. "
            "Seconds are the fastest of the rounds, as what disturbs a run only adds to it; memory the largest. "
            "Neither the naive way, which takes more than ten minutes, nor Blender, which makes an object of "
            "each instance, is measured at 200 x 300."
        ),
        "",
        (
            "| squares | form | objects | laid out | peak | files | naive | authored | naive / authored | floor "
            "| authored / floor | peak: naive / authored | own | open | peak | traverse | Blender |"
        ),
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|",
    ]
    rows += [_row(*form) for form in FORMS]
    return "\n".join(rows)


def _row(rows: int, cols: int, form: str) -> str:
    figures: dict[str, dict[str, list[float]]] = {step: {} for step in STEPS}
    with tempfile.TemporaryDirectory() as folder:
        for round_ in range(ROUNDS[rows]):
            for step in STEPS:
                if round_ and step == "lay_out":
                    continue
                if step in {"naive", "blender"} and rows >= _HUGE_ROWS:
                    continue
                command = [sys.executable, __file__, step, str(rows), str(cols), form, folder]
                run = subprocess.run(command, check=True, capture_output=True)  # noqa: S603
                # Blender talks on the same stream
                for name, value in json.loads(run.stdout.splitlines()[-1]).items():
                    figures[step].setdefault(name, []).append(value)
    largest = {step: {name: max(values) for name, values in of.items()} for step, of in figures.items()}
    seconds = {step: min(of["seconds"]) for step, of in figures.items() if of}
    blender = f"{seconds['blender']:.2f} s" if "blender" in seconds else "-"
    naive, times, naive_peak = "-", "-", "-"
    if "naive" in seconds:
        naive, times = f"{seconds['naive']:.2f} s", f"{seconds['naive'] / seconds['author']:.1f}"
        naive_peak = f"{largest['naive']['peak_mb']:.0f}"
    return (
        f"| {rows} x {cols} | {form} | {largest['lay_out']['objects']:,.0f} | {seconds['lay_out']:.1f} s "
        f"| {largest['lay_out']['peak_mb']:.0f} MB | {largest['author']['megabytes']:.2f} MB "
        f"| {naive} | {seconds['author']:.2f} s | {times} "
        f"| {seconds['export']:.2f} s | {seconds['author'] / seconds['export']:.2f} "
        f"| {naive_peak} / {largest['author']['peak_mb']:.0f} MB "
        f"| {largest['author']['own_mb']:.0f} MB "
        f"| {seconds['open']:.2f} s | {largest['open']['peak_mb']:.0f} MB | {seconds['traverse']:.2f} s | {blender} |"
    )


def _garage(rows: int, cols: int, form: str) -> tuple[Layout, LaneSquares, GarageConfig]:
    cells = np.full((rows, cols), Cell.FREE, dtype=np.int8)
    cells[:-1, 1::3] = Cell.LANE
    cells[-2, 1:-1] = Cell.LANE
    cells[-1, 1], cells[-1, cols - 2] = Cell.ENTRANCE, Cell.EXIT
    structure = Structure.from_arrays(cells, 8.1, 8.1)
    config = GarageConfig(stage={"form": form})
    graph = build_lane_graph(structure, config.bay)
    return lay_out(structure, graph, config), graph, config


def _naive(path: Path) -> dict[str, float]:
    layout, _, config = _read(path.parent)
    names = {spec: prototype.file for spec, prototype in _prototypes(layout, config).items()}
    start = time.perf_counter()
    _author_naively(layout, names, path.with_stem("naive"))
    return {"seconds": time.perf_counter() - start, "peak_mb": peak_mb()}


def _export(path: Path) -> dict[str, float]:
    layers = [Sdf.Layer.FindOrOpen(str(file)) for file in _own_layers(path)]
    start = time.perf_counter()
    for layer in layers:
        layer.Export(str(path.with_stem("exported")))
    return {"seconds": time.perf_counter() - start}


def _open(path: Path) -> dict[str, float]:
    start = time.perf_counter()
    stage = Usd.Stage.Open(str(path))
    return {"seconds": time.perf_counter() - start, "peak_mb": peak_mb(), "layers": len(stage.GetUsedLayers())}


def _traverse(path: Path) -> dict[str, float]:
    stage = Usd.Stage.Open(str(path))
    start = time.perf_counter()
    count = sum(1 for _ in stage.Traverse())
    return {"seconds": time.perf_counter() - start, "prims": count}


def _blender(path: Path) -> dict[str, float]:
    import bpy  # noqa: PLC0415 - it brings a USD of its own, and is needed by this step alone

    bpy.ops.wm.read_factory_settings(use_empty=True)
    start = time.perf_counter()
    bpy.ops.wm.usd_import(filepath=str(path))
    return {"seconds": time.perf_counter() - start, "objects": len(bpy.data.objects)}


def _lay_out(rows: int, cols: int, form: str, path: Path) -> dict[str, float]:
    """Lay a garage out, keep the layout for the other steps, and write its stage with all assets."""
    start = time.perf_counter()
    layout, graph, config = _garage(rows, cols, form)
    figures = {"seconds": time.perf_counter() - start, "peak_mb": peak_mb(), "objects": len(layout.placements)}
    (path.parent / _LAYOUT_FILE).write_bytes(pickle.dumps((layout, graph, config)))
    arrangement = arrangement_of(layout, config.stage)
    write_level_stage(layout, path, arrangement=arrangement, metadata={}, config=config.stage)
    return figures


def _read(folder: Path) -> tuple[Layout, LaneSquares, GarageConfig]:
    with (folder / _LAYOUT_FILE).open("rb") as file:
        read: tuple[Layout, LaneSquares, GarageConfig] = pickle.load(file)  # noqa: S301 - our own
    return read


def _prototypes(layout: Layout, config: GarageConfig) -> dict[Spec, Prototype]:
    shapes = {spec.shape for spec in layout.placements.specs}
    return name_prototypes(
        layout, {shape: asset_file(shape, config.stage.texture_quality).layer.name for shape in shapes}
    )


def _own_layers(path: Path) -> list[Path]:
    """The layers that are authored for one garage alone."""
    names = (LANE_GRAPH_FILE, *(f"{kind.scattered}.usdc" for kind in KINDS if kind.scattered))
    return [file for file in (path, *(path.parent / ASSETS / name for name in names)) if file.exists()]


def _author(path: Path) -> dict[str, float]:
    layout, _, config = _read(path.parent)
    prototypes = _prototypes(layout, config)
    before_mb = resident_mb()
    start = time.perf_counter()
    write_garage_layer(
        layout,
        arrangement=arrange(layout, nested=config.stage.form is StageForm.NESTED),
        prototypes=prototypes,
        own=f"{ASSETS}/",
        asset_folder=ASSETS,
        metadata={},
        last_frame=0,
        path=path,
    )
    seconds = time.perf_counter() - start
    size = sum(file.stat().st_size for file in _own_layers(path)) / 1e6
    return {"seconds": seconds, "peak_mb": peak_mb(), "own_mb": peak_mb() - before_mb, "megabytes": size}


def _author_naively(layout: Layout, names: dict[object, str], path: Path) -> None:
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    root = UsdGeom.Xform.Define(stage, "/Garage")
    stage.SetDefaultPrim(root.GetPrim())
    Usd.ModelAPI(root).SetKind(Kind.Tokens.assembly)
    paths = arrange(layout, nested=False).paths()
    for prim_path, placement in zip(paths, layout.placements, strict=True):
        xform = UsdGeom.Xform.Define(stage, prim_path)
        prim = xform.GetPrim()
        prim.GetReferences().AddReference(f"./{ASSETS}/{names[placement.spec]}")
        prim.SetInstanceable(True)
        UsdSemantics.LabelsAPI.Apply(prim, "class").CreateLabelsAttr([OBJECT_LABELS[placement.kind]])
        xform.AddTranslateOp(UsdGeom.XformOp.PrecisionFloat).Set(Gf.Vec3f(*placement.position_m))
        if placement.yaw_rad:
            xform.AddRotateYOp().Set(float(np.degrees(placement.yaw_rad)))
    stage.GetRootLayer().Save()


_MEASURES = {
    "naive": _naive,
    "author": _author,
    "export": _export,
    "open": _open,
    "traverse": _traverse,
    "blender": _blender,
}


if __name__ == "__main__":
    step, rows, cols, form, folder = sys.argv[1:]
    path = Path(folder) / "garage.usdc"
    print(json.dumps(_lay_out(int(rows), int(cols), form, path) if step == "lay_out" else _MEASURES[step](path)))
