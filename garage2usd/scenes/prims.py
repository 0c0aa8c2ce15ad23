"""Prims of a composed stage: their types, inherited properties and semantic labels, and the objects that they draw."""

from collections.abc import Callable, Collection, Hashable, Sequence
from dataclasses import dataclass, field
from functools import cache
from typing import NamedTuple, Self, TypeVar

import numpy as np
from numpy.typing import NDArray
from pxr import Usd, UsdGeom, UsdLux, UsdShade, Vt

from garage2usd.scenes.values import READ_AT, lacks

_BINDING, _COLLECTION_BINDING = UsdShade.Tokens.materialBinding, f"{UsdShade.Tokens.materialBindingCollection}:"
_PRIMVAR = "primvars:"
_INDICES = ":indices"
OBJECT_TAXONOMY = "class"
"""Instance name of the labels with an object's class."""
SQUARE_TAXONOMY = "square"
"""Instance name of the labels of squares, which are not object classes."""
LABELS = "semantics:labels"
"""Namespace of the label attributes."""
LABELS_SCHEMA = "SemanticsLabelsAPI"
"""The label schema, applied once for each taxonomy."""
FINISH = "garage:material:finish"
"""Attribute of a material with the name of its substance, if it differs from the material's own name."""
_ARRAYS = Vt.TokenArray, Vt.StringArray
_Read = TypeVar("_Read")
Matrix = NDArray[np.float64]
"""A transform for points as row vectors; float64, shape (4, 4)."""


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
                primvars[name.removeprefix(_PRIMVAR)] = _primvar_value(primvar)
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


def _primvar_value(primvar: UsdGeom.Primvar) -> Hashable:
    value = primvar.ComputeFlattened(READ_AT)
    numbers = np.asarray(value)
    return str(primvar.GetTypeName()), repr(value) if numbers.dtype == object else numbers.tobytes()


@cache
def labels_name(taxonomy: str) -> str:
    """Return the name of a taxonomy's label attribute, for example ``semantics:labels:class``."""
    return f"{LABELS}:{taxonomy}"


def label_of(prim: Usd.Prim, taxonomy: str = OBJECT_TAXONOMY) -> str:
    """Return the first label of a prim in a taxonomy; empty without one. Raises as `labels_of`."""
    labels = _label_values(prim, taxonomy)
    return str(labels[0]) if labels else ""


def finish_of(material: Usd.Prim) -> str:
    """Return the name of a material's substance: its finish, else the material's own name."""
    attribute = material.GetAttribute(FINISH)
    finish = attribute.Get(READ_AT) if attribute else None
    return finish if isinstance(finish, str) and finish else material.GetName()


def labels_of(prim: Usd.Prim, taxonomy: str) -> tuple[str, ...]:
    """Return all labels of a prim in a taxonomy.

    Raises
    ------
    StageError
        If the attribute has another type: USD returns the type in the file, not that of the schema.
    """
    return tuple(map(str, _label_values(prim, taxonomy)))


def _label_values(prim: Usd.Prim, taxonomy: str) -> Sequence[str]:
    attribute = prim.GetAttribute(labels_name(taxonomy))
    labels = attribute.Get(READ_AT) if attribute else None
    if labels is None:
        return ()
    if not isinstance(labels, _ARRAYS):
        raise lacks(attribute, "labels")
    found: Sequence[str] = labels
    return found


class DrawnPart(NamedTuple):
    """A prim that draws a part of an object, or a light of it.

    Attributes
    ----------
    prim
        A `UsdGeom.Gprim` or a light. Instances of one prototype share it.
    path
        From the object's path to the prim; empty if the object is the prim.
    matrix
        From the prim's space to the object's.
    inherited
        Inherited materials and primvars, including those from outside its prototype.
    """

    prim: Usd.Prim
    path: str
    matrix: Matrix
    inherited: Inherited = NOTHING


@dataclass(eq=False, slots=True)
class PlacedObject:
    """An object of a stage.

    Attributes
    ----------
    path
        Path of its prim; ``instancer[index]`` for a point of an instancer, with a suffix for an object within one.
    twin
        Path of a prim on the stage that looks like the object: equal to `path` except for points of instancers.
    label
        Semantic class; empty if the stage has none.
    square
        Label of the object's square; empty without one.
    matrix
        From its space to the world.
    parts
        Drawn parts. Instances of one prototype that inherit the same values share one tuple.
    is_twin_whole
        True if `twin` starts at the stage's root although the walk began in a prototype.
    """

    path: str
    twin: str
    label: str
    square: str
    matrix: Matrix
    parts: Sequence[DrawnPart] = field(default_factory=list)
    is_twin_whole: bool = False

    def twin_of(self, part: DrawnPart) -> Usd.Prim:
        """Return the prim on the stage that looks like a part, with the part's inherited values."""
        return part.prim.GetStage().GetPrimAtPath(self.twin + part.path)


def once_for_each_look(read: Callable[[PlacedObject], _Read]) -> Callable[[PlacedObject], _Read]:
    """Cache a function of an object by the object's parts: all objects that share their parts get one result."""
    known: dict[int, tuple[Sequence[DrawnPart], _Read]] = {}  # holds the parts, so that their id is not reused

    def remembered(placed: PlacedObject) -> _Read:
        if id(placed.parts) not in known:
            known[id(placed.parts)] = placed.parts, read(placed)
        return known[id(placed.parts)][1]

    return remembered
