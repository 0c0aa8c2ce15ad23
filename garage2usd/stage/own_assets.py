"""The assets that a garage shares with no other: its floors as they are finished and painted, in one layer.

In a layer each asset takes a third of the bytes that a file of its own would, as their materials are the same.
"""

from collections.abc import Collection, Mapping
from pathlib import Path

from garage2usd.assets import Finish
from garage2usd.config.stage import TextureQuality
from garage2usd.objects import Spec
from garage2usd.stage.authoring import new_layer
from garage2usd.stage.prototype_layer import define_prototype
from garage2usd.stage.prototypes import asset_of

__all__ = ["OWN_ASSETS", "own_shapes", "write_own_assets"]

OWN_ASSETS = "Grounds.usdc"
"""Name of the layer, after what the names of all layers of a garage begin with."""
_GROUNDS = ("floor_", "stall_", "paint_")
"""What the keys of materials begin with whose finishes seldom are those of another garage."""


def own_shapes(shapes: Collection[Spec], finishes: Mapping[str, Finish]) -> list[Spec]:
    """The shapes with a finish that belongs to this garage."""
    keys = {key for key in finishes if key.startswith(_GROUNDS)}
    return [shape for shape in shapes if keys & asset_of(shape).materials] if keys else []


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
        for name, shape in shapes.items():
            define_prototype(
                layer,
                name,
                asset_of(shape),
                kind=shape.kind,
                quality=quality,
                finishes=finishes,
                textures=textures,
            )
