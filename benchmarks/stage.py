"""Authoring, opening and traversing stages of growing size, beside naive authoring and the floor of a plain export.

Usage: python benchmarks/stage.py STEP ROWS COLS FOLDER   (one measurement, in a process of its own)
"""

import json
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from pxr import Gf, Kind, Sdf, Usd, UsdGeom, UsdSemantics

from garage2usd.config import GarageConfig
from garage2usd.grid import Cell, Structure
from garage2usd.lanes import LaneGraph, build_lane_graph
from garage2usd.layout import Layout, lay_out
from garage2usd.stage.garage_layer import prim_paths, write_garage_layer
from garage2usd.stage.labels import OBJECT_LABELS
from garage2usd.stage.prototypes import name_prototypes

__all__ = ["stages"]

SIZES = ((7, 9), (40, 60), (200, 300))
ROUNDS = {7: 5, 40: 3, 200: 1}
STEPS = ("naive", "author", "export", "open", "traverse")


def stages() -> str:
    """A table of seconds and peak memory for each size and step."""
    rows = [
        "## Stages",
        "",
        (
            "The garage's own layer (`.usdc`, assets apart) of combs of aisles, 60 % of the stalls with a car. Naive: "
            "the same prims by `UsdGeom` on an open stage, without lane graph, stall attributes and variants. Floor: "
            "`Layer.Export` of the authored layer. Peak memory over that of the same process before the step; medians."
        ),
        "",
        "| squares | objects | file | naive | authored | ratio | floor | open | traverse | peak: naive / authored |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    rows += [_row(rows_, cols) for rows_, cols in SIZES]
    return "\n".join(rows)


def _row(rows: int, cols: int) -> str:
    figures: dict[str, dict[str, float]] = {}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(ROUNDS[rows]):
            for step in STEPS:
                command = [sys.executable, __file__, step, str(rows), str(cols), folder]
                run = subprocess.run(command, check=True, capture_output=True)  # noqa: S603
                for name, value in json.loads(run.stdout).items():
                    figures.setdefault(step, {}).setdefault(name, []).append(value)  # type: ignore[attr-defined]
    middle = {step: {name: statistics.median(values) for name, values in of.items()} for step, of in figures.items()}  # type: ignore[call-overload]
    seconds = {step: middle[step]["seconds"] for step in STEPS}
    return (
        f"| {rows} x {cols} | {middle['author']['objects']:,.0f} | {middle['author']['megabytes']:.2f} MB "
        f"| {seconds['naive']:.2f} s | {seconds['author']:.2f} s | {seconds['naive'] / seconds['author']:.1f} "
        f"| {seconds['export']:.3f} s | {seconds['open']:.2f} s | {seconds['traverse']:.2f} s "
        f"| {middle['naive']['peak_mb']:.0f} / {middle['author']['peak_mb']:.0f} MB |"
    )


def _garage(rows: int, cols: int) -> tuple[Layout, LaneGraph, GarageConfig]:
    cells = np.full((rows, cols), Cell.FREE, dtype=np.int8)
    cells[:-1, 1::3] = Cell.LANE
    cells[-2, 1:-1] = Cell.LANE
    cells[-1, 1], cells[-1, cols - 2] = Cell.ENTRANCE, Cell.EXIT
    structure = Structure.from_arrays(cells, 8.1, 8.1)
    config = GarageConfig()
    graph = build_lane_graph(structure, config.bay)
    return lay_out(structure, graph, config), graph, config


def _measure(step: str, rows: int, cols: int, folder: Path) -> dict[str, float]:
    path, naive = folder / "garage.usdc", folder / "naive.usdc"
    if step in {"author", "naive"}:
        (path if step == "author" else naive).unlink(missing_ok=True)
        layout, graph, config = _garage(rows, cols)
        prototypes = name_prototypes(layout.placements)
        for prototype in prototypes.values():  # what is referred to, but empty
            asset = folder / "assets" / f"{prototype.name}.usdc"
            if not asset.exists():
                asset.parent.mkdir(exist_ok=True)
                _empty_asset(asset)
        before = _peak_mb()
        start = time.perf_counter()
        if step == "author":
            write_garage_layer(
                layout,
                graph,
                prototypes=prototypes,
                asset_folder="assets",
                metadata={},
                setback_m=config.bay.carriageway_setback_m,
                last_frame=0,
                path=path,
            )
        else:
            _author_naively(layout, {spec: prototype.name for spec, prototype in prototypes.items()}, naive)
        seconds = time.perf_counter() - start
        size = (path if step == "author" else naive).stat().st_size / 1e6
        return {
            "seconds": seconds,
            "peak_mb": _peak_mb() - before,
            "objects": len(layout.placements),
            "megabytes": size,
        }
    if step == "export":
        layer = Sdf.Layer.FindOrOpen(str(path))
        start = time.perf_counter()
        layer.Export(str(folder / "exported.usdc"))
        return {"seconds": time.perf_counter() - start}
    start = time.perf_counter()
    stage = Usd.Stage.Open(str(path))
    opened = time.perf_counter()
    if step == "open":
        return {"seconds": opened - start}
    count = sum(1 for _ in stage.Traverse())
    return {"seconds": time.perf_counter() - opened, "prims": count}


def _author_naively(layout: Layout, names: dict[object, str], path: Path) -> None:
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    root = UsdGeom.Xform.Define(stage, "/Garage")
    stage.SetDefaultPrim(root.GetPrim())
    Usd.ModelAPI(root).SetKind(Kind.Tokens.assembly)
    paths = prim_paths(layout)
    for index, placement in enumerate(layout.placements):
        xform = UsdGeom.Xform.Define(stage, paths[index])
        prim = xform.GetPrim()
        prim.GetReferences().AddReference(f"./assets/{names[placement.spec]}.usdc")
        prim.SetInstanceable(True)
        UsdSemantics.LabelsAPI.Apply(prim, "class").CreateLabelsAttr([OBJECT_LABELS[placement.kind]])
        xform.AddTranslateOp(UsdGeom.XformOp.PrecisionFloat).Set(Gf.Vec3f(*placement.position_m))
        if placement.yaw_rad:
            xform.AddRotateYOp().Set(float(np.degrees(placement.yaw_rad)))
    stage.GetRootLayer().Save()


def _empty_asset(path: Path) -> None:
    layer = Sdf.Layer.CreateNew(str(path))
    Sdf.CreatePrimInLayer(layer, f"/{path.stem}").specifier = Sdf.SpecifierDef
    layer.defaultPrim = path.stem
    layer.Save()


def _peak_mb() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


if __name__ == "__main__":
    step, rows, cols, folder = sys.argv[1:]
    print(json.dumps(_measure(step, int(rows), int(cols), Path(folder))))
