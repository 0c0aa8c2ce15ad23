"""Authoring helpers for prims, attributes and layers as Sdf specs, without an open USD stage."""

import re
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import Sdf, Tf, UsdGeom, UsdPhysics, Vt

from garage2usd.common.errors import OutputError
from garage2usd.scenes.taxonomy import LABELS_SCHEMA, OBJECT_TAXONOMY, labels_name

__all__ = [
    "apply_schemas",
    "attribute",
    "connect",
    "define",
    "new_layer",
    "numbers",
    "operation",
    "order_operations",
    "relationship",
    "save",
    "save_file",
    "set_units",
    "words",
]

_NOT_WRITTEN = re.compile(r"Error occurred writing file: (.*?)'")


@contextmanager
def new_layer(path: Path, *, default_prim: str) -> Iterator[Sdf.Layer]:
    """Open a change block in a layer that is written to a new file at the end of the block."""
    layer = _unwritten(path)
    with Sdf.ChangeBlock():
        set_units(layer)
        layer.defaultPrim = default_prim
        yield layer
    save_file(layer, path)


def set_units(layer: Sdf.Layer) -> None:
    """Set a layer's units to metres and kilograms, and its up axis to Y."""
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
) -> Sdf.PrimSpec:
    """Define a prim, with its model kind and semantic class."""
    prim = Sdf.CreatePrimInLayer(layer, path)
    prim.specifier = Sdf.SpecifierDef
    prim.typeName = type_name
    if kind is not None:
        prim.kind = kind
    if label is not None:
        apply_schemas(prim, f"{LABELS_SCHEMA}:{OBJECT_TAXONOMY}")
        attribute(prim, labels_name(OBJECT_TAXONOMY), Sdf.ValueTypeNames.TokenArray, Vt.TokenArray([label]))
    return prim


def apply_schemas(prim: Sdf.PrimSpec, *schemas: str) -> None:
    """Apply API schemas by their names, strongest first."""
    prim.SetInfo("apiSchemas", Sdf.TokenListOp.Create(prependedItems=schemas))


def attribute(
    prim: Sdf.PrimSpec, name: str, type_name: Sdf.ValueTypeName, value: object = None, *, uniform: bool = False
) -> Sdf.AttributeSpec:
    """Author an attribute with an optional default; an attribute in the namespace ``garage`` is custom."""
    variability = Sdf.VariabilityUniform if uniform else Sdf.VariabilityVarying
    spec = Sdf.AttributeSpec(prim, name, type_name, variability)
    if value is not None:
        spec.default = value
    if name.startswith("garage:"):
        spec.custom = True
    return spec


def connect(
    prim: Sdf.PrimSpec, name: str, type_name: Sdf.ValueTypeName, source: Sdf.AttributeSpec
) -> Sdf.AttributeSpec:
    """Author an attribute connected to another attribute."""
    spec = attribute(prim, name, type_name)
    spec.connectionPathList.explicitItems = [source.path]
    return spec


def relationship(prim: Sdf.PrimSpec, name: str, targets: Iterable[Sdf.Path]) -> None:
    """Author a relationship from a prim to target prims."""
    spec = Sdf.RelationshipSpec(prim, name, custom=False)
    spec.targetPathList.explicitItems = list(targets)


def words(prim: Sdf.PrimSpec, name: str, values: Iterable[str]) -> None:
    """Author an attribute that holds an array of tokens."""
    attribute(prim, name, Sdf.ValueTypeNames.TokenArray, Vt.TokenArray(list(values)))


def numbers(prim: Sdf.PrimSpec, name: str, values: NDArray[Any]) -> None:
    """Author an array attribute: int for integer values, else float."""
    if values.dtype.kind in "iu":
        array, type_name = Vt.IntArray.FromNumpy(np.ascontiguousarray(values, np.int32)), Sdf.ValueTypeNames.IntArray
    else:
        array = Vt.FloatArray.FromNumpy(np.ascontiguousarray(values, np.float32))
        type_name = Sdf.ValueTypeNames.FloatArray
    attribute(prim, name, type_name, array)


def operation(prim: Sdf.PrimSpec, name: str, type_name: Sdf.ValueTypeName, value: object) -> Sdf.AttributeSpec:
    """Author a transform operation; `order_operations` activates it."""
    return attribute(prim, f"xformOp:{name}", type_name, value)


def order_operations(prim: Sdf.PrimSpec, names: Iterable[str]) -> None:
    """Set the order of a prim's transform operations, outermost first."""
    order = Vt.TokenArray([f"xformOp:{name}" for name in names])
    attribute(prim, "xformOpOrder", Sdf.ValueTypeNames.TokenArray, order, uniform=True)


def save(layer: Sdf.Layer, path: Path) -> None:
    """Write an anonymous layer to a new file, like `Sdf.Layer.Export` but without a second copy in memory."""
    file = _unwritten(path)
    file.TransferContent(layer)
    save_file(file, path)


def save_file(layer: Sdf.Layer, path: Path) -> None:
    """Save a layer that has a file.

    Raises
    ------
    OutputError
        If the file cannot be written, for example to a full disk, which USD reports only as a general error.
    """
    try:
        layer.Save()
    except Tf.ErrorException as error:
        said = str(error)
        reason = _NOT_WRITTEN.search(said)
        raise OutputError(path, reason[1] if reason else " ".join(said.split())) from None


def _unwritten(path: Path) -> Sdf.Layer:
    """Create a layer for a new file without writing it, as `Sdf.Layer.CreateNew` would."""
    return Sdf.Layer.New(Sdf.FileFormat.FindByExtension(path.suffix), str(path))
