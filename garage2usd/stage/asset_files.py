"""Asset layers with content-based file names, and a layer of the assets that only a garage with its own look has.

In one layer each asset takes a third of the bytes of a separate file, as all refer to the same materials.
"""

import secrets
import tempfile
from collections.abc import Collection, Mapping
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

from pxr import Sdf

from garage2usd.assets import Finish, pascal_case
from garage2usd.common.output import HIDDEN_PREFIX
from garage2usd.config.outputs import TextureQuality
from garage2usd.objects import Spec
from garage2usd.stage.authoring import define, new_layer
from garage2usd.stage.looks import NamedFile, content_name, textures_of
from garage2usd.stage.prototype_layer import define_prototype, write_prototype
from garage2usd.stage.prototypes import asset_of

OWN_ASSETS = "Grounds.usdc"
"""Suffix of the layer's name, after the common prefix of a garage's layers."""
_OWN_MATERIALS = ("floor_", "stall_", "paint_", "column_", "wall_")
"""Key prefixes of materials whose finishes are rarely equal in two garages."""
_OWN_KINDS = ("light",)
"""Kinds whose shapes are rarely equal in two garages with drawn looks, although their materials are standard."""
_LOOKS = Sdf.Path("/Looks")
"""Class of the materials of all assets of the layer."""


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


def own_shapes(shapes: Collection[Spec], finishes: Mapping[str, Finish]) -> list[Spec]:
    """Select the shapes with finishes of this garage; if there are any, also those of `_OWN_KINDS`."""
    keys = {key for key in finishes if key.startswith(_OWN_MATERIALS)}
    own = {shape for shape in shapes if keys & asset_of(shape).materials} if keys else set()
    return [shape for shape in shapes if shape in own or (own and shape.kind.name in _OWN_KINDS)]


def write_own_assets(
    path: Path,
    shapes: Mapping[str, Spec],
    finishes: Mapping[str, Finish],
    *,
    quality: TextureQuality,
    textures: str,
) -> None:
    """Write the layer, with a root prim for each shape under its name.

    Parameters
    ----------
    path
        The file.
    shapes
        Shapes by the names of their prims.
    finishes
        Finishes that replace materials, by the materials' keys.
    quality, textures
        Quality of the textures, and their folder relative to the layer.
    """
    with new_layer(path, default_prim=next(iter(shapes))) as layer:
        define(layer, _LOOKS, "Scope").specifier = Sdf.SpecifierClass
        for name, shape in shapes.items():
            define_prototype(
                layer,
                name,
                asset_of(shape),
                kind=shape.kind,
                quality=quality,
                finishes=finishes,
                textures=textures,
                shared=_LOOKS,
                mass_kg=shape.mass_kg,
            )
