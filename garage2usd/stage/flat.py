"""The flat form of a stage: one layer without references, variants or instances."""

from pathlib import Path

from pxr import Sdf, Usd, UsdUtils

__all__ = ["flatten_stage"]


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


def _prims(parent: Sdf.PrimSpec) -> list[Sdf.PrimSpec]:
    found = []
    for child in parent.nameChildren:
        found += [child, *_prims(child)]
    return found
