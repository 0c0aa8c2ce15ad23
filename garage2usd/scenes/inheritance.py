"""Inherited properties of prims, also through instances: bound materials and constant primvars."""

from collections.abc import Collection, Hashable
from typing import NamedTuple, Self

import numpy as np
from pxr import Usd, UsdGeom, UsdShade

from garage2usd.scenes.values import READ_AT

__all__ = ["NOTHING", "Inherited", "handed_down"]

_BINDING, _COLLECTION_BINDING = UsdShade.Tokens.materialBinding, f"{UsdShade.Tokens.materialBindingCollection}:"
_PRIMVAR = "primvars:"
_INDICES = ":indices"


class Inherited(NamedTuple):
    """Inherited appearance of a prim; equal if prims of one prototype look the same.

    Attributes
    ----------
    bindings
        Material bindings, from the outermost prim inwards, each with its strength.
    primvars
        Names and values.
    is_by_path
        True if bindings depend on the path of each prim, as with bound collections.
    """

    bindings: tuple[Hashable, ...] = ()
    primvars: tuple[tuple[str, Hashable], ...] = ()
    is_by_path: bool = False

    def by_instance(self, path: str) -> Self:
        """Restrict the inherited appearance to the prims of one instance, if bindings depend on their paths."""
        return self._replace(bindings=(*self.bindings, path)) if self.is_by_path else self

    def of(self, names: Collection[str]) -> tuple[tuple[str, Hashable], ...]:
        """Return the inherited primvars of some names."""
        return tuple(pair for pair in self.primvars if pair[0] in names)


NOTHING = Inherited()


def handed_down(prim: Usd.Prim, said: Collection[str], above: Inherited) -> Inherited:
    """Return the appearance that the prims below a prim inherit.

    Parameters
    ----------
    prim
        The prim.
    said
        Names of its authored properties.
    above
        Appearance that the prim itself inherits.
    """
    bindings = [_binding(prim, name) for name in said if name.startswith(_BINDING)]
    primvars = {}
    for name in said:
        if name.startswith(_PRIMVAR) and not name.endswith(_INDICES):
            primvar = UsdGeom.Primvar(prim.GetAttribute(name))
            if primvar and primvar.GetInterpolation() == UsdGeom.Tokens.constant and primvar.HasValue():
                primvars[name.removeprefix(_PRIMVAR)] = _value(primvar)
    if not bindings and not primvars:
        return above
    merged = {**dict(above.primvars), **primvars}
    is_by_path = above.is_by_path or any(name.startswith(_COLLECTION_BINDING) for name in said)
    return Inherited((*above.bindings, *bindings), tuple(sorted(merged.items())), is_by_path)


def _binding(prim: Usd.Prim, name: str) -> tuple[str, ...]:
    """Return a material binding as name, strength and targets."""
    relationship = prim.GetRelationship(name)
    strength = UsdShade.MaterialBindingAPI.GetMaterialBindingStrength(relationship)
    return name, str(strength), *(str(target) for target in relationship.GetTargets())


def _value(primvar: UsdGeom.Primvar) -> Hashable:
    value = primvar.ComputeFlattened(READ_AT)
    numbers = np.asarray(value)
    return str(primvar.GetTypeName()), repr(value) if numbers.dtype == object else numbers.tobytes()
