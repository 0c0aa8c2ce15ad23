"""The stage of one level: its layout as a root layer, with its own layers, assets and textures."""

import os
import posixpath
import re
from collections.abc import Iterable, Mapping, Sequence
from enum import StrEnum
from pathlib import Path
from typing import NamedTuple

from garage2usd.assets import Finish
from garage2usd.common.errors import ConfigError
from garage2usd.common.output import store
from garage2usd.common.progress import Progress, silent
from garage2usd.config.outputs import AssetPlace, StageConfig, StageForm
from garage2usd.layout import Layout
from garage2usd.look import finishes_of
from garage2usd.objects import Spec
from garage2usd.stage.arrangement import Arrangement, arrange
from garage2usd.stage.asset_files import OWN_ASSETS, AssetFile, asset_file, own_shapes, write_own_assets
from garage2usd.stage.cameras import DRIVE_NAME, write_drive
from garage2usd.stage.forms import make_flat, pack
from garage2usd.stage.garage_layer import write_garage_layer
from garage2usd.stage.looks import TEXTURE_FOLDER, NamedFile, textures_of
from garage2usd.stage.prototypes import asset_of, name_prototypes
from garage2usd.structure.grid import Cell


class StageFormat(StrEnum):
    """File formats of a stage, by extension."""

    USDA = ".usda"
    USDC = ".usdc"
    USDZ = ".usdz"


def asset_folder_name(stage_path: Path) -> str:
    """Name of the folder beside a ``.usda`` or ``.usdc`` for its layers, and for its assets if they are not shared."""
    return f"{stage_path.stem}_assets"


def shared_folder(path: Path, config: StageConfig) -> Path | None:
    """Resolve the folder of shared assets for a stage at `path`; None if the stage has its own assets.

    Raises
    ------
    ConfigError
        If the stage is a ``.usdz``, which embeds its assets, or the folder lies within the stage's own folder, which
        each build replaces.
    """
    if config.assets is AssetPlace.OWN:
        return None
    if path.suffix.lower() == StageFormat.USDZ:
        raise ConfigError("stage.assets", str(config.assets), "'own' for a .usdz, which holds its assets itself")
    # joined as USD joins paths, without resolving symbolic links
    folder = Path(os.path.normpath(path.parent.absolute() / config.asset_folder))
    own = Path(os.path.normpath(path.parent.absolute() / asset_folder_name(path)))
    if folder == own or own in folder.parents:
        raise ConfigError("stage.asset_folder", config.asset_folder, f"a folder outside of {own.name}")
    return folder


class StageFiles(NamedTuple):
    """A written USD stage.

    Attributes
    ----------
    stage
        The stage itself.
    assets
        Folder of its assets; None where it embeds them or has only shared ones.
    last_frame
        Last frame of its driving camera.
    """

    stage: Path
    assets: Path | None
    last_frame: int


def arrangement_of(layout: Layout, config: StageConfig) -> Arrangement:
    """Assign each object of a layout to its prim in the USD stage, according to the settings of the stage."""
    return arrange(layout, nested=config.is_nested(int((layout.structure.cells != Cell.OBSTACLE).sum())))


def write_level_stage(
    layout: Layout,
    path: Path,
    *,
    arrangement: Arrangement,
    metadata: Mapping[str, str | int],
    config: StageConfig,
    shared: Path | None = None,
    own: str | None = None,
    progress: Progress = silent,
) -> StageFiles:
    """Write the stage of a level, or of a garage that is this level alone, into an empty folder.

    Parameters
    ----------
    layout
        The layout to write.
    path
        The stage's file in an existing, empty folder; its extension selects the format.
    arrangement
        Prim of each object, from `arrangement_of`.
    metadata
        Entries of the root's customData.
    config
        Texture quality and form of the stage.
    shared
        Folder of the shared assets, from `shared_folder` for the final path of the stage. Missing assets are added,
        damaged ones are written again.
    own
        Prefix of the names of this garage's own layers, beside a stage with shared assets; if left out, the layers
        stand in a folder named by `asset_folder_name`.
    progress
        Called after each prototype.

    Returns
    -------
    StageFiles
        The files in the folder.

    Raises
    ------
    OutputError
        If the shared assets cannot be written.
    """
    packed = path.suffix == StageFormat.USDZ
    folder = path.parent / ("assets" if packed else asset_folder_name(path))
    if own is None or shared is None:
        folder.mkdir()
        own = f"{folder.name}/"
    finishes = finishes_of(layout.look)
    shapes = list(dict.fromkeys(spec.shape for spec in layout.placements.specs))
    grounds = own_shapes(shapes, finishes) if shared is not None else []
    of_garage = frozenset(grounds)
    of_store = [shape for shape in shapes if shape not in of_garage]
    assets = _asset_files(of_store, finishes, config, progress)
    prototypes = name_prototypes(layout, {shape: made.layer.name for shape, made in assets.items()})
    contents = _contents(assets.values())
    materials = {key for shape in grounds for key in asset_of(shape).materials}
    contents |= _textures(textures_of(materials, finishes, config.texture_quality))
    is_flat = config.form is StageForm.FLAT
    is_compact = packed and not is_flat
    if shared is not None:
        for name, data in contents.items():
            store(shared / name, data)
    elif not is_compact:
        _write(contents, folder)

    if grounds:
        write_own_assets(
            path.parent / f"{own}{OWN_ASSETS}",
            {prototypes[shape].name: shape for shape in grounds},
            finishes,
            quality=config.texture_quality,
            textures=posixpath.join(
                posixpath.relpath(config.asset_folder, posixpath.dirname(own) or "."), TEXTURE_FOLDER
            ),
        )
    # viewers in a browser need a text root layer in a package
    layer_path = path.with_suffix(".usda") if packed else path
    progress("stage", 0, 1)
    last_frame = write_drive(path.parent / f"{own}{DRIVE_NAME}.usdc", layout.lane_graph)
    write_garage_layer(
        layout,
        arrangement=arrangement,
        prototypes=prototypes,
        own=own,
        asset_folder=folder.name if shared is None else config.asset_folder,
        metadata=metadata,
        last_frame=last_frame,
        path=layer_path,
        is_compact=is_compact,
        up_axis=config.up_axis,
    )
    if is_flat:
        make_flat(layer_path, folder)
    if not packed:
        return StageFiles(path, folder if folder.exists() else None, last_frame)
    if not is_compact:
        _remove_indents(layer_path)
    pack(path, layer_path, folder, {Path(name): data for name, data in contents.items()} if is_compact else {})
    return StageFiles(path, None, last_frame)


def _asset_files(
    shapes: Sequence[Spec], finishes: Mapping[str, Finish], config: StageConfig, progress: Progress
) -> dict[Spec, AssetFile]:
    """Author the asset files of shapes."""
    files = {}
    for done, shape in enumerate(shapes):
        progress("assets", done, len(shapes))
        files[shape] = asset_file(shape, config.texture_quality, finishes)
    return files


def _contents(assets: Iterable[AssetFile]) -> dict[str, bytes]:
    """Return the contents of asset files and their textures, by name in the stage's asset folder."""
    contents: dict[str, bytes] = {}
    for asset in assets:
        contents[asset.layer.name] = asset.layer.data
        contents |= _textures(asset.textures)
    return contents


def _textures(textures: Iterable[NamedFile]) -> dict[str, bytes]:
    return {f"{TEXTURE_FOLDER}/{texture.name}": texture.data for texture in textures}


def _remove_indents(layer_path: Path) -> None:
    """Remove the indentation of a text layer; no line of its strings begins with a blank."""
    text = layer_path.read_text(encoding="utf-8")
    layer_path.write_text(re.sub(r"^ +", "", text, flags=re.MULTILINE), encoding="utf-8", newline="\n")


def _write(contents: Mapping[str, bytes], folder: Path) -> None:
    for name, data in contents.items():
        place = folder / name
        place.parent.mkdir(exist_ok=True)
        place.write_bytes(data)
