"""Classification of prims by type, and their visibility and purpose."""

from typing import NamedTuple

from pxr import Usd, UsdGeom, UsdLux, UsdShade

from garage2usd.scenes.values import READ_AT

__all__ = ["PrimType", "PrimTypes", "is_imageable", "is_visible", "purpose_of"]


class PrimType(NamedTuple):
    """Classification of a type of prim.

    Attributes
    ----------
    is_material, is_instancer
        True for materials, and for point instancers.
    is_drawn
        True for geometry and lights.
    """

    is_material: bool
    is_instancer: bool
    is_drawn: bool

    def draws(self, prim: Usd.Prim) -> bool:
        """Return True if a prim of this type is geometry or a light, by its type or by the light API."""
        return self.is_drawn or bool(prim.HasAPI(UsdLux.LightAPI))


class PrimTypes:
    """Cache of the few prim types of a stage."""

    def __init__(self) -> None:
        self._known: dict[str, PrimType] = {}

    def of(self, prim: Usd.Prim) -> PrimType:
        """Return the classification of a prim by its type."""
        name = prim.GetTypeName()
        if name not in self._known:
            drawn = UsdGeom.Gprim, UsdLux.BoundableLightBase, UsdLux.NonboundableLightBase
            self._known[name] = PrimType(
                prim.IsA(UsdShade.Material), prim.IsA(UsdGeom.PointInstancer), any(map(prim.IsA, drawn))
            )
        return self._known[name]


def is_imageable(prim: Usd.Prim) -> bool:
    """Return True if a prim is imageable."""
    return bool(prim.IsA(UsdGeom.Imageable))


def is_visible(prim: Usd.Prim) -> bool:
    """Return True if a prim with visible parents is visible."""
    if not is_imageable(prim):
        return True
    return bool(UsdGeom.Imageable(prim).GetVisibilityAttr().Get(READ_AT) != UsdGeom.Tokens.invisible)


def purpose_of(prim: Usd.Prim, inherited: str) -> str:
    """Return a prim's purpose: its own if authored, else its parent's."""
    if is_imageable(prim):
        own = UsdGeom.Imageable(prim).GetPurposeAttr()
        if own.HasAuthoredValue():
            return str(own.Get())
    return inherited
