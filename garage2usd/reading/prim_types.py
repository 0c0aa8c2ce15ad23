"""What prims are by their types, and what they say of being seen."""

from typing import NamedTuple

from pxr import Usd, UsdGeom, UsdLux, UsdShade

from garage2usd.reading.values import READ_AT

__all__ = ["PrimType", "PrimTypes", "is_imageable", "is_visible", "purpose_of"]


class PrimType(NamedTuple):
    """What prims of a type are.

    Attributes
    ----------
    is_material, is_instancer
        Whether they are materials, or instancers of points.
    is_drawn
        Whether they draw something or shine.
    """

    is_material: bool
    is_instancer: bool
    is_drawn: bool

    def draws(self, prim: Usd.Prim) -> bool:
        """Whether a prim of this type draws something or shines, by its type or as one that is made a light."""
        return self.is_drawn or bool(prim.HasAPI(UsdLux.LightAPI))


class PrimTypes:
    """The types of prims, of which a stage has few; each is looked at once."""

    def __init__(self) -> None:
        self._known: dict[str, PrimType] = {}

    def of(self, prim: Usd.Prim) -> PrimType:
        """What a prim is by its type."""
        name = prim.GetTypeName()
        if name not in self._known:
            drawn = UsdGeom.Gprim, UsdLux.BoundableLightBase, UsdLux.NonboundableLightBase
            self._known[name] = PrimType(
                prim.IsA(UsdShade.Material), prim.IsA(UsdGeom.PointInstancer), any(map(prim.IsA, drawn))
            )
        return self._known[name]


def is_imageable(prim: Usd.Prim) -> bool:
    """Whether a prim can be seen at all."""
    return bool(prim.IsA(UsdGeom.Imageable))


def is_visible(prim: Usd.Prim) -> bool:
    """Whether a prim whose parents are visible is."""
    if not is_imageable(prim):
        return True
    return bool(UsdGeom.Imageable(prim).GetVisibilityAttr().Get(READ_AT) != UsdGeom.Tokens.invisible)


def purpose_of(prim: Usd.Prim, inherited: str) -> str:
    """A prim's purpose: its own where it has one, else its parent's."""
    if is_imageable(prim):
        own = UsdGeom.Imageable(prim).GetPurposeAttr()
        if own.HasAuthoredValue():
            return str(own.Get())
    return inherited
