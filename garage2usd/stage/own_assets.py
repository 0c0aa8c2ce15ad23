"""Assets that a garage with its own look rarely shares with another: floors, columns, walls and lamps.

In one layer each asset takes a third of the bytes of a separate file, as all refer to the same materials.
"""

from collections.abc import Collection, Mapping
from pathlib import Path

from pxr import Sdf

from garage2usd.assets import Finish
from garage2usd.config.stage import TextureQuality
from garage2usd.objects import Spec
from garage2usd.stage.authoring import define, new_layer
from garage2usd.stage.prototype_layer import define_prototype
from garage2usd.stage.prototypes import asset_of

__all__ = ["OWN_ASSETS", "own_shapes", "write_own_assets"]

OWN_ASSETS = "Grounds.usdc"
"""Suffix of the layer's name, after the common prefix of a garage's layers."""
_OWN_MATERIALS = ("floor_", "stall_", "paint_", "column_", "wall_")
"""Key prefixes of materials whose finishes are rarely equal in two garages."""
_OWN_KINDS = ("light",)
"""Kinds whose shapes are rarely equal in two garages with drawn looks, although their materials are standard."""
_LOOKS = Sdf.Path("/Looks")
"""Class of the materials of all assets of the layer."""


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
