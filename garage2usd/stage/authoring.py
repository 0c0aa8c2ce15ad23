"""Small steps of authoring Sdf specs, with no stage open."""

import math
from collections.abc import Iterable

from pxr import Gf, Sdf, UsdGeom, UsdPhysics, Vt

__all__ = ["LABEL_TAXONOMY", "attribute", "define", "operation", "order_operations", "over", "place", "set_units"]

LABEL_TAXONOMY = "class"
"""Instance name of the semantic labels: ``semantics:labels:class``."""


def set_units(layer: Sdf.Layer) -> None:
    """Metres, kilograms, Y up."""
    pseudo_root = layer.pseudoRoot
    pseudo_root.SetInfo(UsdGeom.Tokens.upAxis, UsdGeom.Tokens.y)
    pseudo_root.SetInfo(UsdGeom.Tokens.metersPerUnit, 1.0)
    pseudo_root.SetInfo(UsdPhysics.Tokens.kilogramsPerUnit, 1.0)


def define(
    layer: Sdf.Layer,
    path: Sdf.Path,
    type_name: str,
    *,
    kind: str | None = None,
    label: str | None = None,
    schemas: Iterable[str] = (),
) -> Sdf.PrimSpec:
    """Define a prim, with its model kind, semantic class and further API schemas."""
    prim = Sdf.CreatePrimInLayer(layer, path)
    prim.specifier = Sdf.SpecifierDef
    prim.typeName = type_name
    if kind is not None:
        prim.kind = kind
    applied = list(schemas)
    if label is not None:
        applied.append(f"SemanticsLabelsAPI:{LABEL_TAXONOMY}")
        name = f"semantics:labels:{LABEL_TAXONOMY}"
        attribute(prim, name, Sdf.ValueTypeNames.TokenArray, Vt.TokenArray([label]))
    if applied:
        prim.SetInfo("apiSchemas", Sdf.TokenListOp.Create(prependedItems=applied))
    return prim


def over(parent: Sdf.PrimSpec, relative: Sdf.Path) -> Sdf.PrimSpec:
    """An over of a prim below a prim spec, which may be that of a variant."""
    prim = parent
    for name in str(relative).split("/"):
        prim = prim.nameChildren.get(name) or Sdf.PrimSpec(prim, name, Sdf.SpecifierOver)
    return prim


def attribute(
    prim: Sdf.PrimSpec, name: str, type_name: Sdf.ValueTypeName, value: object, *, uniform: bool = False
) -> Sdf.AttributeSpec:
    """An attribute with its default; in the namespace ``garage`` a custom one."""
    variability = Sdf.VariabilityUniform if uniform else Sdf.VariabilityVarying
    spec = Sdf.AttributeSpec(prim, name, type_name, variability)
    spec.default = value
    if name.startswith("garage:"):
        spec.custom = True
    return spec


def place(prim: Sdf.PrimSpec, position_m: tuple[float, float, float], yaw_rad: float = 0.0) -> None:
    """Translate a prim and turn it about +Y."""
    # float3, not double3: three.js cannot read a double3 from a crate file
    operation(prim, "translate", Sdf.ValueTypeNames.Float3, Gf.Vec3f(*position_m))
    names = ["translate"]
    if yaw_rad:
        operation(prim, "rotateY", Sdf.ValueTypeNames.Float, round(math.degrees(yaw_rad), 4))
        names.append("rotateY")
    order_operations(prim, names)


def operation(prim: Sdf.PrimSpec, name: str, type_name: Sdf.ValueTypeName, value: object) -> Sdf.AttributeSpec:
    """One transform operation; `order_operations` makes it count."""
    return attribute(prim, f"xformOp:{name}", type_name, value)


def order_operations(prim: Sdf.PrimSpec, names: Iterable[str]) -> None:
    """Say which transform operations apply, outermost first."""
    order = Vt.TokenArray([f"xformOp:{name}" for name in names])
    attribute(prim, "xformOpOrder", Sdf.ValueTypeNames.TokenArray, order, uniform=True)
