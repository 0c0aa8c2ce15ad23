"""Which texture files a stage shows, read from the stage itself."""

from pathlib import PurePosixPath

from pxr import Sdf, Usd


def texture_names(stage):
    """Names of the image files that the stage's texture readers show, instances included."""
    files = set()
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        attribute = prim.GetAttribute("inputs:file")
        if prim.GetTypeName() == "Shader" and attribute and isinstance(attribute.Get(), Sdf.AssetPath):
            files.add(PurePosixPath(attribute.Get().path).name)
    return files
