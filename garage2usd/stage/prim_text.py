"""Prims as USDA text, which for the many prims of a garage takes a third of the time of authoring them in Python."""

from collections.abc import Iterable, Iterator
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from garage2usd.reading.taxonomy import LABELS_SCHEMA, SQUARE_TAXONOMY, labels_name

__all__ = [
    "anchored",
    "group_pieces",
    "group_text",
    "header_text",
    "inherits_text",
    "instance_text",
    "moved_text",
    "place_text",
    "reference_text",
    "rounded_deg",
    "rounded_m",
]

_ORDERS = {
    False: 'uniform token[] xformOpOrder = ["xformOp:translate"]\n',
    True: 'uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateY"]\n',
}


def anchored(path: str) -> str:
    """A relative path that USD takes from the folder of the layer alone, never from a search path."""
    return path if path.partition("/")[0] in {".", ".."} else f"./{path}"


def inherits_text(base: str) -> str:
    """The metadata of a prim that inherits from a class."""
    return f"prepend inherits = <{base}>\n"


def reference_text(asset: str, prim: str = "", *, base: str | None = None) -> str:
    """The metadata of a prim that refers to a root prim of a layer, the default one if left out.

    It may inherit from a class.
    """
    target = f"</{prim}>" if prim else ""
    return f"{inherits_text(base) if base else ''}prepend references = @{asset}@{target}\n"


def header_text(asset: str, prim: str = "", *, look: Iterable[tuple[str, str]] = (), base: str | None = None) -> str:
    """The metadata of an instance of a root prim of a layer, which selects variants by (set, variant) pairs."""
    choices = "".join(f'string {name} = "{choice}"\n' for name, choice in look)
    variants = f"variants = {{\n{choices}}}\n" if choices else ""
    return f"instanceable = true\n{reference_text(asset, prim, base=base)}{variants}"


def instance_text(name: str, header: str, place: str, attributes: str = "") -> str:
    """An instance at its place, with attributes of its own."""
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
    """A group with its children, and its label in the taxonomy of squares."""
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
    """The text of a group piece by piece, so that a large one is put together once."""
    schemas, labels = "", ""
    if label is not None:
        schemas = f'prepend apiSchemas = ["{LABELS_SCHEMA}:{SQUARE_TAXONOMY}"]\n'
        labels = f'token[] {labels_name(SQUARE_TAXONOMY)} = ["{label}"]\n'
    yield f'{specifier} Xform "{name}" (\n{schemas}kind = "group"\n{metadata})\n{{\n{labels}{place}'
    yield from children
    yield "}\n"


def place_text(x: float, y: float, z: float, yaw_deg: float = 0.0) -> str:
    """Translation in metres and a turn about +Y, as `rounded_m` and `rounded_deg` give them."""
    # float3, not double3: three.js cannot read a double3 from a crate file
    move = f"float3 xformOp:translate = ({x}, {y}, {z})\n"
    if not yaw_deg:
        return move + _ORDERS[False]
    return f"{move}float xformOp:rotateY = {yaw_deg}\n{_ORDERS[True]}"


@lru_cache(maxsize=4096)
def moved_text(x: float) -> str:
    """The translation along X of a prim whose prototype has a place of its own; tiles of a column have the same."""
    return f"float3 xformOp:translate = ({x}, 0, 0)\n"


def rounded_m(position_m: NDArray[np.float64]) -> list[Any]:
    """Coordinates to the micrometre, as lists."""
    places: list[Any] = (np.round(position_m, 6) + 0.0).tolist()  # no minus before a zero
    return places


def rounded_deg(yaw_rad: NDArray[np.float64]) -> list[float]:
    """Angles in degrees to 1e-4."""
    angles: list[float] = (np.round(np.degrees(yaw_rad), 4) + 0.0).tolist()
    return angles
