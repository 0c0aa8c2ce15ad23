"""Prototypes of a layout: one asset for each distinct shape."""

from collections import Counter
from collections.abc import Mapping
from functools import lru_cache
from typing import NamedTuple

from garage2usd.assets import Asset, pascal_case
from garage2usd.layout import Layout
from garage2usd.objects.car import CarSpec
from garage2usd.objects.kind import Look, Spec
from garage2usd.stage.baked_meshes import baked_asset

__all__ = ["Prototype", "asset_of", "name_prototypes"]


class Prototype(NamedTuple):
    """The asset of a spec, and its variant choices.

    Attributes
    ----------
    name
        Name of the asset in this garage.
    file
        Name of its file, the same in every garage; empty for an asset in the garage's own layer.
    look
        (variant set, variant) pairs that an instance selects.
    """

    name: str
    file: str
    look: Look = ()

    def place(self, asset_folder: str, own_assets: str) -> tuple[str, str]:
        """Layer of the prototype and the name of its prim there, empty for the layer's default prim.

        Both arguments are paths as used by the referring layer.
        """
        return (f"{asset_folder}/{self.file}", "") if self.file else (own_assets, self.name)


def name_prototypes(layout: Layout, files: Mapping[Spec, str]) -> dict[Spec, Prototype]:
    """Name the distinct shapes of a layout, numbered by kind in the order of their first placement.

    Parameters
    ----------
    layout
        The objects.
    files
        Name of the file of each shape; all other shapes are in the garage's own layer of assets.

    Returns
    -------
    dict
        Prototype by spec; asset names are PascalCase: ``Floor_03``, ``Column_01``, ``Car_02``.
    """
    names: dict[Spec, str] = {}
    prototypes: dict[Spec, Prototype] = {}
    counts: Counter[str] = Counter()
    for spec in layout.placements.specs:
        shape = spec.shape
        if shape not in names:
            kind = pascal_case(spec.kind.name)
            counts[kind] += 1
            names[shape] = f"{kind}_{counts[kind]:02d}"
        prototypes[spec] = Prototype(names[shape], files.get(shape, ""), spec.look)
    return prototypes


def asset_of(spec: Spec) -> Asset:
    """Return the meshes of a spec's shape, precomputed or cached."""
    return _asset_of_shape(spec.shape)


@lru_cache(maxsize=4096)
def _asset_of_shape(shape: Spec) -> Asset:
    asset = baked_asset(shape)
    if asset is None and isinstance(shape, CarSpec) and (plain := baked_asset(shape.plain)) is not None:
        asset = shape.asset_from(plain)  # making the body takes ten times as long
    return asset or shape.asset()
