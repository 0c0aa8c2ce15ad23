"""What ``pxr`` says of values and layers, in the form of the C# dump."""

import struct
import zlib
from functools import cache

import numpy as np
from pxr import Gf, Sdf, Tf, Vt

SCALARS = {
    "bool": ("Bool", "B"), "uchar": ("UChar", "B"), "int": ("Int", "i"), "uint": ("UInt", "I"), "int64": ("Int64", "q"),
    "uint64": ("UInt64", "Q"), "half": ("Half", "f"), "float": ("Float", "f"), "double": ("Double", "d"),
    "timecode": ("TimeCode", "d"), "string": ("String", None), "token": ("Token", None), "asset": ("Asset", None),
    "pathExpression": ("PathExpression", None),
}  # fmt: skip
SHAPES = {
    "GfVec2": "2", "GfVec3": "3", "GfVec4": "4", "GfMatrix2": "Matrix2", "GfMatrix3": "Matrix3", "GfMatrix4": "Matrix4",
    "GfQuat": "Quat",
}  # fmt: skip
LETTERS = {"d": ("Double", "d"), "f": ("Float", "f"), "h": ("Half", "f"), "i": ("Int", "i")}


@cache
def type_of(name: Sdf.ValueTypeName) -> tuple[str, str | None] | None:
    """Name of the type in C#, and the struct letter of its numbers (None for texts)."""
    if name.type == Tf.Type.Unknown:
        return None  # pxr too has such a value as a text alone
    scalar = name.scalarType
    if str(scalar) in SCALARS:
        return SCALARS[str(scalar)]
    cpp = scalar.cppTypeName
    for prefix, label in SHAPES.items():
        if cpp.startswith(prefix):
            letter = cpp[len(prefix) :][0]
            if prefix.startswith("GfVec"):
                return f"{LETTERS[letter][0]}{label}", LETTERS[letter][1]
            return f"{label}{letter}", LETTERS[letter][1]
    return None


def numbers(value) -> list:
    """All numbers of one value, a quaternion real part first."""
    if isinstance(value, Gf.Quatd | Gf.Quatf | Gf.Quath):
        return [value.real, *value.imaginary]
    if isinstance(value, Gf.Matrix2d | Gf.Matrix3d | Gf.Matrix4d):
        return np.array(value).ravel().tolist()
    if isinstance(value, Sdf.TimeCode):
        return [value.GetValue()]
    if hasattr(value, "__len__"):
        return list(value)
    return [value]


def packed(values, letter: str) -> bytes:
    return struct.pack(f"<{len(values)}{letter}", *values)


def dumped(name: Sdf.ValueTypeName, value):
    """As ``JsonText.Value`` writes it; None where the type is not known to it."""
    if value is None or isinstance(value, Sdf.AnimationBlock):
        return None
    if isinstance(value, Sdf.ValueBlock):
        return "blocked"
    known = type_of(name)
    if known is None:
        return None
    label, letter = known
    if name.isArray:
        label += "[]"
    items = list(value) if name.isArray and (letter is None or not len(value)) else value if name.isArray else [value]
    if letter is None:
        return [label, [text(item) for item in items]]
    if not len(items):
        return [label, ""]
    if name.isArray and not isinstance(items[0], Gf.Quatd | Gf.Quatf | Gf.Quath | Sdf.TimeCode):
        data = np.array(value).astype(np.dtype(letter).newbyteorder("<")).tobytes()
    else:
        data = packed([number for item in items for number in numbers(item)], letter)
    size = struct.calcsize(letter)
    return [label, data.hex() if len(data) <= 64 else f"{len(data) // size}:{zlib.crc32(data):08x}"]


def text(item) -> str:
    if isinstance(item, Sdf.PathExpression):
        return item.GetText()
    return item.path if isinstance(item, Sdf.AssetPath) else str(item)


def anything(value):
    """A value of metadata as plain JSON, or None where the dump has no like."""
    if isinstance(value, bool):
        return 1 if value else 0
    if isinstance(value, int | float):
        return special(float(value))
    if isinstance(value, str):
        return value
    if isinstance(value, Sdf.AssetPath):
        return value.path
    if isinstance(value, dict):
        return {key: anything(item) for key, item in value.items()}
    if isinstance(value, list | tuple) or type(value).__module__.startswith(("pxr.Vt", "pxr.Gf")):
        flat = []
        for item in value:
            plain = anything(item)
            flat += plain if isinstance(plain, list) else [plain]
        return flat
    return None


def special(number: float):
    if np.isnan(number):
        return "nan"
    return ("inf" if number > 0 else "-inf") if np.isinf(number) else number


def list_op(op, item=str) -> dict | None:
    if op is None:
        return None
    if op.isExplicit:
        return {"explicit": [item(one) for one in op.explicitItems]}
    parts = {
        "added": op.addedItems,
        "prepended": op.prependedItems,
        "appended": op.appendedItems,
        "deleted": op.deletedItems,
        "ordered": op.orderedItems,
    }
    return {key: [item(one) for one in items] for key, items in parts.items() if len(items)}


def arc(one) -> list:
    return [one.assetPath, str(one.primPath), one.layerOffset.offset, one.layerOffset.scale]


KNOWN = {
    "specifier", "typeName", "active", "instanceable", "references", "payload", "inheritPaths", "specializes",
    "variantSetNames", "variantSelection", "apiSchemas", "primChildren", "properties", "variantSetChildren",
    "primOrder", "propertyOrder", "default", "timeSamples", "custom", "variability", "targetPaths", "connectionPaths",
    "subLayers", "subLayerOffsets", "targetChildren", "connectionChildren", "spline", "variantChildren",
}  # fmt: skip


def metadata(spec) -> dict:
    """Whatever other fields a spec has."""
    return {key: anything(spec.GetInfo(key)) for key in spec.ListInfoKeys() if key not in KNOWN}


def layer_dump(layer: Sdf.Layer) -> dict:
    """As ``LayerDump`` writes it."""
    offsets = layer.subLayerOffsets
    return {
        "subLayers": [[str(p), o.offset, o.scale] for p, o in zip(layer.subLayerPaths, offsets, strict=True)],
        "root": prim_dump(layer.pseudoRoot, ""),
    }


def prim_dump(prim: Sdf.PrimSpec, name: str) -> dict:
    out = {"name": name, "specifier": prim.specifier.displayName, "type": prim.typeName}
    keys = set(prim.ListInfoKeys())
    for key in ("active", "instanceable"):
        if key in keys:
            out[key] = prim.GetInfo(key)
    for key, label, item in (
        ("references", "references", arc),
        ("payload", "payloads", arc),
        ("inheritPaths", "inherits", str),
        ("specializes", "specializes", str),
        ("variantSetNames", "variantSetNames", str),
        ("apiSchemas", "apiSchemas", str),
    ):
        if key in keys:
            out[label] = list_op(prim.GetInfo(key), item)
    if "variantSelection" in keys:
        out["selections"] = dict(prim.variantSelections)
    if len(prim.nameChildrenOrder):
        out["childOrder"] = list(prim.nameChildrenOrder)
    if "propertyOrder" in keys:
        out["propertyOrder"] = list(prim.propertyOrder)
    out["metadata"] = metadata(prim)
    out["properties"] = [property_dump(one) for one in prim.properties]
    out["sets"] = {
        set_name: [prim_dump(variant.primSpec, variant.name) for variant in variant_set.variants.values()]
        for set_name, variant_set in prim.variantSets.items()
    }
    out["children"] = [prim_dump(child, child.name) for child in prim.nameChildren]
    return out


def property_dump(spec) -> dict:
    relationship = isinstance(spec, Sdf.RelationshipSpec)
    out = {
        "name": spec.name,
        "relationship": relationship,
        "type": "" if relationship else str(spec.typeName),
        "custom": spec.custom,
        "uniform": spec.variability == Sdf.VariabilityUniform and not relationship,
    }
    keys = set(spec.ListInfoKeys())
    if not relationship:
        default = dumped(spec.typeName, spec.default) if "default" in keys else None
        if default is not None:
            out["default"] = default
        if "timeSamples" in keys:
            times = spec.layer.ListTimeSamplesForPath(spec.path)
            samples = [[time, spec.layer.QueryTimeSample(spec.path, time)] for time in times]
            out["samples"] = [[time, dumped(spec.typeName, value)] for time, value in samples]
    key = "targetPaths" if relationship else "connectionPaths"
    if key in keys:
        out["targets"] = list_op(spec.GetInfo(key))
    out["metadata"] = metadata(spec)
    return out


def differences(wanted, found, place="") -> list[str]:
    """Where two structures of JSON differ, as lines for people."""
    if isinstance(wanted, dict) and isinstance(found, dict):
        lines = []
        for key in sorted(wanted.keys() | found.keys()):
            if key not in found or key not in wanted:
                there = wanted.get(key, found.get(key))
                lines.append(f"{place}/{key}: only in {'pxr' if key in wanted else 'C#'}: {str(there)[:200]}")
            else:
                lines += differences(wanted[key], found[key], f"{place}/{key}")
        return lines
    if isinstance(wanted, list) and isinstance(found, list) and len(wanted) == len(found):
        lines = []
        for index, (one, other) in enumerate(zip(wanted, found, strict=True)):
            label = one.get("name", index) if isinstance(one, dict) else index
            lines += differences(one, other, f"{place}/{label}")
        return lines
    return [] if wanted == found else [f"{place}: pxr {str(wanted)[:200]}, C# {str(found)[:200]}"]


def agreed(wanted: dict, found: dict) -> None:
    """Take out of both dumps of a prim what they need not agree on: the order of properties, unregistered metadata."""
    for one in wanted, found:
        sorted_names(one)
    _known_metadata(wanted, found)


def _known_metadata(wanted, found) -> None:
    # pxr keeps no plugin's metadata that is a bare true or false
    if isinstance(wanted, dict) and isinstance(found, dict):
        if "metadata" in wanted and "metadata" in found:
            found["metadata"] = {key: value for key, value in found["metadata"].items() if key in wanted["metadata"]}
        for key in wanted.keys() & found.keys():
            _known_metadata(wanted[key], found[key])
    elif isinstance(wanted, list) and isinstance(found, list):
        for one, other in zip(wanted, found, strict=False):
            _known_metadata(one, other)


def sorted_names(dump: dict) -> dict:
    """The dump of a prim with its properties in the order of names, as layers keep them in orders of their own."""
    dump["properties"].sort(key=lambda one: one["name"])
    for variants in dump["sets"].values():
        variants.sort(key=lambda one: one["name"])
        for variant in variants:
            sorted_names(variant)
    for child in dump["children"]:
        sorted_names(child)
    return dump


assert Vt  # registers the conversions of arrays
