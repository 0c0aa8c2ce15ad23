"""Authoring of prims, attributes and layers without an open USD stage: as Sdf specs, and many as USDA text."""

import re
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import Sdf, Tf, UsdGeom, UsdPhysics, Vt

from garage2usd.common.errors import OutputError
from garage2usd.config.outputs import UpAxis
from garage2usd.scenes.prims import LABELS_SCHEMA, OBJECT_TAXONOMY, SQUARE_TAXONOMY, labels_name

_NOT_WRITTEN = re.compile(r"Error occurred writing file: (.*?)'")
_TURN = "xformOp:rotateX:unitsResolve"
_ORDER = 'uniform token[] xformOpOrder = ["xformOp:translate"]\n'


@contextmanager
def new_layer(path: Path, *, default_prim: str) -> Iterator[Sdf.Layer]:
    """Open a change block in a layer that is written to a new file at the end of the block."""
    layer = _unwritten(path)
    with Sdf.ChangeBlock():
        set_units(layer)
        layer.defaultPrim = default_prim
        yield layer
    save_file(layer, path)


def set_units(layer: Sdf.Layer, up_axis: UpAxis = UpAxis.Y) -> None:
    """Set a layer's units to metres and kilograms, and its up axis."""
    pseudo_root = layer.pseudoRoot
    pseudo_root.SetInfo(UsdGeom.Tokens.upAxis, up_axis.value)
    pseudo_root.SetInfo(UsdGeom.Tokens.metersPerUnit, 1.0)
    pseudo_root.SetInfo(UsdPhysics.Tokens.kilogramsPerUnit, 1.0)


def turn_text(up_axis: UpAxis) -> str:
    """Return the operations that turn the root of a garage, whose own axes have Y up, so that `up_axis` points up."""
    if up_axis is UpAxis.Y:
        return ""
    return f'float {_TURN} = 90\nuniform token[] xformOpOrder = ["{_TURN}"]\n'


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


def anchored(path: str) -> str:
    """Anchor a relative path to the layer's folder, so that USD never resolves it on a search path."""
    return path if path.partition("/")[0] in {".", ".."} else f"./{path}"


def inherits_text(base: str) -> str:
    """Metadata of a prim that inherits from a class."""
    return f"inherits = <{base}>\n"


def reference_text(asset: str, prim: str = "", *, base: str | None = None) -> str:
    """Metadata of a prim that refers to a root prim of a layer, by default the layer's default prim.

    The prim may also inherit from a class.
    """
    target = f"</{prim}>" if prim else ""
    return f"{inherits_text(base) if base else ''}prepend references = @{asset}@{target}\n"


def header_text(asset: str, prim: str = "", *, look: Iterable[tuple[str, str]] = (), base: str | None = None) -> str:
    """Metadata of an instance of a layer's root prim, with its variant selections as (set, variant) pairs."""
    choices = "".join(f'string {name} = "{choice}"\n' for name, choice in look)
    variants = f"variants = {{\n{choices}}}\n" if choices else ""
    return f"instanceable = true\n{reference_text(asset, prim, base=base)}{variants}"


def instance_text(name: str, header: str, place: str, attributes: str = "") -> str:
    """Text of an instance with its transform and attributes."""
    return f'def Xform "{name}" (\n{header})\n{{\n{place}{attributes}}}\n'


def group_text(
    name: str,
    children: Iterable[str],
    *,
    specifier: str = "def",
    label: str | None = None,
    metadata: str = "",
    place: str = "",
) -> str:
    """Text of a group with its children, and its label in the taxonomy of squares."""
    pieces = group_pieces(name, children, specifier=specifier, label=label, metadata=metadata, place=place)
    return "".join(pieces)


def group_pieces(
    name: str,
    children: Iterable[str],
    *,
    specifier: str = "def",
    label: str | None = None,
    metadata: str = "",
    place: str = "",
) -> Iterator[str]:
    """Yield the text of a group in pieces, so that a large one is concatenated only once."""
    schemas, labels = "", ""
    if label is not None:
        schemas = f'prepend apiSchemas = ["{LABELS_SCHEMA}:{SQUARE_TAXONOMY}"]\n'
        labels = f'token[] {labels_name(SQUARE_TAXONOMY)} = ["{label}"]\n'
    yield f'{specifier} Xform "{name}" (\n{schemas}kind = "group"\n{metadata})\n{{\n{labels}{place}'
    yield from children
    yield "}\n"


def place_text(x: float, y: float, z: float) -> str:
    """Text of a translation in metres from `rounded_m`."""
    # float3, not double3: three.js cannot read a double3 from a crate file
    return f"float3 xformOp:translate = ({x}, {y}, {z})\n{_ORDER}"


def pose_text(x: float, y: float, z: float, yaw_deg: float) -> str:
    """Text of the translation and the rotation about +Y of an instance, from `rounded_m` and `rounded_deg`.

    The order of the operations, and their values of 0, are those of the asset's root prim (`define_prototype`). Without
    an order, three.js ignores a rotateY.
    """
    # ten digits resolve micrometres up to ten kilometres; `g` drops trailing zeros
    move = f"float3 xformOp:translate = ({x:.10g},{y:.10g},{z:.10g})\n" if x or y or z else ""
    return f"{move}float3 xformOp:rotateXYZ = (0,{yaw_deg:.10g},0)\n" if yaw_deg else move


@lru_cache(maxsize=4096)
def moved_text(x: float) -> str:
    """Text of the translation along X of a prim whose prototype has a transform; equal for the tiles of a column."""
    return f"float3 xformOp:translate = ({x}, 0, 0)\n"


def rounded_m(position_m: NDArray[np.float64]) -> list[Any]:
    """Round coordinates to the micrometre, as lists."""
    places: list[Any] = (np.round(position_m, 6) + 0.0).tolist()  # avoids -0
    return places


def rounded_deg(yaw_rad: NDArray[np.float64]) -> list[float]:
    """Convert radians to degrees rounded to 1e-4."""
    angles: list[float] = (np.round(np.degrees(yaw_rad), 4) + 0.0).tolist()
    return angles
