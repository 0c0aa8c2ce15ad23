"""Prims as USDA text, which takes a third of the time of authoring the many prims of a garage in Python."""

from collections.abc import Iterable, Iterator
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from garage2usd.scenes.taxonomy import LABELS_SCHEMA, SQUARE_TAXONOMY, labels_name

__all__ = [
    "anchored",
    "group_pieces",
    "group_text",
    "header_text",
    "inherits_text",
    "instance_text",
    "moved_text",
    "place_text",
    "pose_text",
    "reference_text",
    "rounded_deg",
    "rounded_m",
]

_ORDER = 'uniform token[] xformOpOrder = ["xformOp:translate"]\n'


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
    # ten digits are micrometres up to ten kilometres, and none is a point and a zero
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
