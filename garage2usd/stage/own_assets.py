"""The assets that a garage with a look of its own seldom shares with another: floors, columns, walls and lamps.

In one layer each asset takes a third of the bytes that a file of its own would, as all refer to the same materials.
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
"""Name of the layer, after what the names of all layers of a garage begin with."""
_OWN_MATERIALS = ("floor_", "stall_", "paint_", "column_", "wall_")
"""What the keys of materials begin with whose finishes seldom are those of another garage, on shapes like these."""
_OWN_KINDS = ("light",)
"""Kinds whose shapes seldom are those of another garage where looks are drawn, though their materials are as usual."""
_LOOKS = Sdf.Path("/Looks")
"""The class that holds the materials of all assets of the layer."""


def own_shapes(shapes: Collection[Spec], finishes: Mapping[str, Finish]) -> list[Spec]:
    """The shapes with a finish that belongs to this garage; where there are such, those of some kinds too."""
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
    """Write the layer: a root prim for each shape, by its name.

    Parameters
    ----------
    path
        The file.
    shapes
        By the names of their prims.
    finishes
        What the garage has in the place of materials, by their keys.
    quality, textures
        Of the textures, and their folder as the layer refers to it.
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
