"""Assets as files whose names say what they hold: authored once a process, and the same for every garage."""

import secrets
import tempfile
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

from garage2usd.assets import MATERIALS, pascal_case
from garage2usd.config.stage import TextureQuality
from garage2usd.objects import Spec
from garage2usd.output import HIDDEN_PREFIX
from garage2usd.stage.prototype_layer import write_prototype
from garage2usd.stage.prototypes import asset_of
from garage2usd.stage.texture_files import NamedFile, content_name, texture_file

__all__ = ["AssetFile", "asset_file"]


class AssetFile(NamedTuple):
    """The layer of an asset.

    Attributes
    ----------
    layer
        Named by the kind of object and the beginning of the layer's SHA-256: ``Column_0f3a9c5e7b1d2846.usdc``.
    textures
        Its textures, which stand in the folder ``textures`` beside it.
    """

    layer: NamedFile
    textures: tuple[NamedFile, ...]


@lru_cache(maxsize=4096)
def asset_file(shape: Spec, quality: TextureQuality) -> AssetFile:
    """The layer of a shape whose textures have a quality.

    Notes
    -----
    What is authored is kept for the next garage of the process: the 4096 assets that were used last. Twenty garages of
    7 x 9 squares need 346, which take 2.6 MB; the largest is a car of at most 150 KB. The bytes depend on the shape and
    the quality alone, so that a stage is the same whatever was built before it.
    """
    asset = asset_of(shape)
    # of many small files a folder for each would take a third of the time
    path = Path(tempfile.gettempdir()) / f"{HIDDEN_PREFIX}{secrets.token_hex(8)}.usdc"
    try:
        write_prototype(asset, path, kind=shape.kind, quality=quality)
        data = path.read_bytes()
    finally:
        path.unlink(missing_ok=True)
    textures = {texture for part in asset.parts for texture in MATERIALS[part.material].textures()}
    return AssetFile(
        NamedFile(content_name(pascal_case(shape.kind.name), data, ".usdc"), data),
        tuple(texture_file(texture, quality) for texture in sorted(textures)),
    )
