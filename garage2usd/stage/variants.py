"""Variant sets of a garage: parked cars, lights, and what hangs overhead."""

from collections.abc import Mapping

from pxr import Sdf

from garage2usd.layout import Layout, ObjectKind
from garage2usd.stage.authoring import attribute, over

__all__ = ["POWER_SET", "author_variants"]

POWER_SET = "power"
"""Variant set of every light's asset: ``on`` or ``off``."""

_OVERHEAD = (ObjectKind.CEILING, ObjectKind.DUCT, ObjectKind.SPRINKLER, ObjectKind.EXIT_SIGN)


def author_variants(root: Sdf.PrimSpec, layout: Layout, paths: Mapping[int, str]) -> None:
    """Author the sets ``occupancy`` (parked, empty), ``lights`` (on, off) and ``ceiling`` (shown, hidden).

    Parameters
    ----------
    root
        The garage's prim.
    layout
        Its objects.
    paths
        Prim path of each placement by its index in ``layout.placements``.
    """
    by_kind: dict[ObjectKind, list[Sdf.Path]] = {}
    for index, placement in enumerate(layout.placements):
        by_kind.setdefault(placement.kind, []).append(Sdf.Path(paths[index]).MakeRelativePath(root.path))

    empty = _choices(root, "occupancy", "parked", "empty")
    for path in by_kind.get(ObjectKind.CAR, []):
        over(empty, path).active = False
    off = _choices(root, "lights", "on", "off")
    for path in by_kind.get(ObjectKind.LIGHT, []):
        over(off, path).variantSelections[POWER_SET] = "off"
    hidden = _choices(root, "ceiling", "shown", "hidden")
    for kind in _OVERHEAD:
        for path in by_kind.get(kind, []):
            attribute(over(hidden, path), "visibility", Sdf.ValueTypeNames.Token, "invisible")


def _choices(root: Sdf.PrimSpec, name: str, usual: str, other: str) -> Sdf.PrimSpec:
    """A variant set with two choices, the first selected; returns the prim spec of the second."""
    variants = Sdf.VariantSetSpec(root, name)
    root.variantSetNameList.prependedItems.append(name)
    root.variantSelections[name] = usual
    Sdf.VariantSpec(variants, usual)
    return Sdf.VariantSpec(variants, other).primSpec
