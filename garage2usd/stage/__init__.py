"""The only authoring of USD: a layout becomes a stage with its assets and textures."""

import json
import shutil
from collections.abc import Mapping
from enum import StrEnum
from pathlib import Path
from typing import NamedTuple

from garage2usd.assets import MATERIALS
from garage2usd.assets.textures import texture_folder
from garage2usd.config.stage import StageConfig, StageForm
from garage2usd.layout import Layout
from garage2usd.progress import Progress, silent
from garage2usd.stage.arrangement import Arrangement, arrange
from garage2usd.stage.cameras import DRIVE_NAME, write_drive
from garage2usd.stage.flat import flatten_stage
from garage2usd.stage.garage_layer import write_garage_layer
from garage2usd.stage.labels import label_table
from garage2usd.stage.looks import TEXTURE_FOLDER
from garage2usd.stage.prototype_layer import write_prototype
from garage2usd.stage.prototypes import asset_of, name_prototypes
from garage2usd.stage.usdz import write_usdz
from garage2usd.structure.grid import Cell
from garage2usd.structure.lane_graph import LaneGraph

__all__ = ["StageFiles", "StageFormat", "arrangement_of", "asset_folder_name", "write_labels", "write_stage"]


class StageFormat(StrEnum):
    """The file formats of a stage, by extension."""

    USDA = ".usda"
    USDC = ".usdc"
    USDZ = ".usdz"


def asset_folder_name(stage_path: Path) -> str:
    """Name of the folder beside a ``.usda`` or ``.usdc`` that holds its assets."""
    return f"{stage_path.stem}_assets"


class StageFiles(NamedTuple):
    """What a stage consists of: its file, and the folder of its assets where it does not hold them itself."""

    stage: Path
    assets: Path | None


def arrangement_of(layout: Layout, config: StageConfig) -> Arrangement:
    """Which prim each object of a layout is in a stage of the form that the settings ask for."""
    return arrange(layout, nested=config.is_nested(int((layout.structure.cells != Cell.OBSTACLE).sum())))


def write_labels(layout: Layout, path: Path, *, arrangement: Arrangement) -> None:
    """Write the table of all labelled objects of the stage as JSON (see `garage2usd.reading.label_table`)."""
    table = label_table(layout, arrangement.paths()).model_dump(by_alias=True)
    lists = (f' "{name}": [\n  ' + ",\n  ".join(map(json.dumps, entries)) + "\n ]" for name, entries in table.items())
    path.write_text("{\n" + ",\n".join(lists) + "\n}\n", encoding="utf-8")


def write_stage(
    layout: Layout,
    graph: LaneGraph,
    path: Path,
    *,
    arrangement: Arrangement,
    metadata: Mapping[str, str | int],
    config: StageConfig,
    progress: Progress = silent,
) -> StageFiles:
    """Write a stage into a folder of its own.

    Parameters
    ----------
    layout, graph
        What to write.
    path
        The stage's file in an existing, empty folder; its extension decides the format.
    arrangement
        Which prim each object is, by `arrangement_of`.
    metadata
        Written into the root's customData.
    config
        Texture quality and form.
    progress
        Called with each prototype that is written.

    Returns
    -------
    StageFiles
        What now stands in the folder.
    """
    packed = path.suffix == StageFormat.USDZ
    folder = path.parent / ("assets" if packed else asset_folder_name(path))
    textures = folder / TEXTURE_FOLDER
    textures.mkdir(parents=True)
    prototypes = name_prototypes(layout)
    used: set[str] = set()
    shapes = {prototype.name: spec for spec, prototype in reversed(prototypes.items())}
    for done, (name, spec) in enumerate(sorted(shapes.items())):
        progress("assets", done, len(shapes))
        asset = asset_of(spec)
        write_prototype(asset, folder / f"{name}.usdc", label=spec.kind.label)
        used.update(texture for part in asset.parts for texture in MATERIALS[part.material].textures())
    for texture in sorted(used):
        shutil.copyfile(texture_folder(config.texture_quality) / texture, textures / texture)

    # a browser reads a package only if its root layer is text
    layer_path = path.with_suffix(".usda") if packed else path
    progress("stage", 0, 1)
    write_garage_layer(
        layout,
        graph,
        arrangement=arrangement,
        prototypes=prototypes,
        asset_folder=folder.name,
        metadata=metadata,
        last_frame=write_drive(folder / f"{DRIVE_NAME}.usdc", layout, graph),
        path=layer_path,
    )
    if config.form is StageForm.FLAT:
        _make_flat(layer_path, folder)
    if not packed:
        return StageFiles(path, folder)
    inner = sorted(file for file in folder.rglob("*") if file.is_file())
    write_usdz(path, [(file.relative_to(path.parent).as_posix(), file) for file in (layer_path, *inner)])
    shutil.rmtree(folder)
    layer_path.unlink()
    return StageFiles(path, None)


def _make_flat(layer_path: Path, folder: Path) -> None:
    """Put one flat layer in the place of an instanced one and its assets; the textures stay."""
    flat = layer_path.with_stem(f"{layer_path.stem}_flat")
    flatten_stage(layer_path, flat)
    flat.replace(layer_path)
    for asset in folder.glob("*.usdc"):
        asset.unlink()
