"""Forms of a stage's files: a flat layer without references, and a USDZ package aligned to 64 bytes."""

import shutil
import zipfile
from collections.abc import Mapping
from pathlib import Path

from pxr import Sdf, Usd, UsdUtils

_ALIGNMENT_BYTES = 64
_LOCAL_HEADER_BYTES = 30
_EXTRA_HEADER_BYTES = 4
_EXTRA_ID = 0x1986
_EPOCH = (1980, 1, 1, 0, 0, 0)


def flatten_stage(source: Path, target: Path) -> None:
    """Flatten a composed stage into one layer beside it, with relative texture paths.

    Parameters
    ----------
    source
        The instanced stage.
    target
        The layer to write, in the same folder.
    """
    stage = Usd.Stage.Open(str(source))
    stage.SetEditTarget(stage.GetSessionLayer())
    # instances are not nested, so that one pass finds them all
    for prim in list(stage.Traverse()):
        if prim.IsInstance():
            prim.SetInstanceable(False)
    flat = stage.Flatten(addSourceFileComment=False)
    folder = source.parent.resolve()

    def relative(path: str) -> str:
        place = Path(path)
        return f"./{place.resolve().relative_to(folder).as_posix()}" if place.is_absolute() else path

    UsdUtils.ModifyAssetPaths(flat, relative)
    for prim in _prims(flat.pseudoRoot):
        prim.ClearInfo("instanceable")
    flat.Export(str(target))


def make_flat(layer_path: Path, folder: Path) -> None:
    """Replace an instanced layer and its assets by one flat layer; the textures stay."""
    flat = layer_path.with_stem(f"{layer_path.stem}_flat")
    flatten_stage(layer_path, flat)
    flat.replace(layer_path)
    for asset in folder.glob("*.usdc"):
        asset.unlink()


def _prims(parent: Sdf.PrimSpec) -> list[Sdf.PrimSpec]:
    found = []
    for child in parent.nameChildren:
        found += [child, *_prims(child)]
    return found


def pack(path: Path, layer_path: Path, folder: Path, more: Mapping[Path, bytes] | None = None) -> None:
    """Move a root layer and the folder beside it into a USDZ package.

    Parameters
    ----------
    path
        The package.
    layer_path, folder
        The root layer, which comes first, and the folder.
    more
        Contents of further files in the folder, by their path in it.

    Notes
    -----
    ``Sdf.ZipFileWriter`` is not used, because it stores the local time of each file, which makes packages
    irreproducible. ``zipfile`` allows a fixed time; the required padding goes into the extra field, as there.
    """
    inner = {file.relative_to(folder): file.read_bytes() for file in folder.rglob("*") if file.is_file()}
    inner |= more or {}
    named = [(f"{folder.name}/{name.as_posix()}", inner[name]) for name in sorted(inner)]
    with zipfile.ZipFile(path, "w", zipfile.ZIP_STORED) as package:
        for name, data in [(layer_path.name, layer_path.read_bytes()), *named]:
            entry = zipfile.ZipInfo(name, _EPOCH)
            entry.create_system = 0
            start = package.start_dir + _LOCAL_HEADER_BYTES + len(name.encode()) + _EXTRA_HEADER_BYTES
            padding = -start % _ALIGNMENT_BYTES
            entry.extra = _EXTRA_ID.to_bytes(2, "little") + padding.to_bytes(2, "little") + bytes(padding)
            package.writestr(entry, data)
    shutil.rmtree(folder)
    layer_path.unlink()
