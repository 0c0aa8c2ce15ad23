"""Asset layers with content-based file names: authored once per process and equal in every garage."""

import secrets
import tempfile
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

from garage2usd.assets import Finish, pascal_case
from garage2usd.common.output import HIDDEN_PREFIX
from garage2usd.config.stage import TextureQuality
from garage2usd.objects import Spec
from garage2usd.stage.prototype_layer import write_prototype
from garage2usd.stage.prototypes import asset_of
from garage2usd.stage.texture_files import NamedFile, content_name, textures_of

__all__ = ["AssetFile", "asset_file"]


class AssetFile(NamedTuple):
    """The layer of an asset.

    Attributes
    ----------
    layer
        File named by the kind of object and the beginning of its SHA-256: ``Column_0f3a9c5e7b1d2846.usdc``.
    textures
        Its textures, stored in the folder ``textures`` beside the layer.
    """

    layer: NamedFile
    textures: tuple[NamedFile, ...]


def asset_file(shape: Spec, quality: TextureQuality, finishes: Mapping[str, Finish]) -> AssetFile:
    """Author the asset layer of a shape.

    Parameters
    ----------
    shape
        The shape.
    quality
        Quality of its textures.
    finishes
        Finishes that replace materials, by the materials' keys.

    Notes
    -----
    The 4096 most recently used assets are cached for the next garages of the process. Twenty garages of 7 x 9 squares
    need 346 assets with 2.6 MB in all; the largest asset, a car, has at most 150 KB. The bytes depend only on the
    shape, the quality and the shape's own finishes, so that a stage is independent of earlier builds.
    """
    own = asset_of(shape).materials & finishes.keys()
    return _asset_file(shape, quality, tuple((key, finishes[key]) for key in sorted(own)))


@lru_cache(maxsize=4096)
def _asset_file(shape: Spec, quality: TextureQuality, own: tuple[tuple[str, Finish], ...]) -> AssetFile:
    asset = asset_of(shape)
    finishes = {**dict(own), **asset.finishes}
    # one temporary folder for all: a folder for each of many small files would take a third of the time
    path = Path(tempfile.gettempdir()) / f"{HIDDEN_PREFIX}{secrets.token_hex(8)}.usdc"
    try:
        write_prototype(asset, path, kind=shape.kind, quality=quality, finishes=finishes, mass_kg=shape.mass_kg)
        data = path.read_bytes()
    finally:
        path.unlink(missing_ok=True)
    return AssetFile(
        NamedFile(content_name(pascal_case(shape.kind.name), data, ".usdc"), data),
        textures_of(asset.materials, finishes, quality),
    )
