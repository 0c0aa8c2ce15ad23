"""DXF drawings as plain shapes and texts of the model space, blocks taken apart, with the part that each name tells."""

import logging
import math
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.errors import ConfigError
from garage2usd.common.package import of_extra
from garage2usd.survey.drawing_words import PartKind, kind_of

with of_extra("a survey as DXF"):
    from ezdxf import path as ezpath
    from ezdxf import recover
    from ezdxf.dynblkhelper import get_dynamic_block_definition
    from ezdxf.filemanagement import readfile
    from ezdxf.lldxf.const import DXFError

Floats = NDArray[np.float64]

_MOST_BYTES = 256 * 1024 * 1024
_MOST_SHAPES = 1_000_000
_MOST_NESTED = 16
_MOST_COORDINATE = 1e12
_FLAT = 1 / 200
"""Greatest distance of an arc from its chords, as a share of the size of its shape."""
_CLOSED = 0.01
"""Gap up to which the ends of a line meet, as a share of its length."""
_METRES = {1: 0.0254, 2: 0.3048, 4: 0.001, 5: 0.01, 6: 1.0, 7: 1000.0, 8: 2.54e-8, 10: 0.9144, 14: 0.1, 21: 0.3048006}
"""Metres of a unit by its number in $INSUNITS."""
_FILLED = {"HATCH", "MPOLYGON", "SOLID", "TRACE", "3DFACE"}
_APART = {"MLINE", "ACAD_PROXY_ENTITY", "LEADER", "MULTILEADER"}
_SILENT = {"DIMENSION", "ARC_DIMENSION", "LARGE_RADIAL_DIMENSION", "VIEWPORT", "IMAGE", "ATTDEF", "LEADER", "OLE2FRAME",
           "MULTILEADER", "WIPEOUT", "RAY", "XLINE", "TOLERANCE", "SUN", "LIGHT"}  # fmt: skip
_FAULTS = (DXFError, OSError, ValueError, LookupError, AttributeError, TypeError, ArithmeticError, RecursionError,
           AssertionError, StopIteration)  # fmt: skip
"""Errors of ezdxf on damaged files."""


class DrawnShape(NamedTuple):
    """A line, a ring or a point of a drawing.

    Attributes
    ----------
    name
        Its kind of entity and handle, or those of its outermost block.
    layer
        Its layer, or that of its block if it lies on layer 0.
    kind
        The part that its layer or block tells; None if they tell none.
    points
        (x, y) in units of the drawing, float64, shape (n, 2); the first is not repeated at the end.
    is_closed, is_filled
        True for rings, and for those of hatches and solids.
    told
        Names of its layer and blocks.
    heights
        Heights of its first and last point.
    width
        Width with which it is drawn, 0 for most.
    """

    name: str
    layer: str
    kind: PartKind | None
    points: Floats
    is_closed: bool
    is_filled: bool
    told: tuple[str, ...]
    heights: tuple[float, float] = (0.0, 0.0)
    width: float = 0.0


class DrawnText(NamedTuple):
    """A text of a drawing: the middle of its first line and its point of insertion, height z, and size of letters."""

    text: str
    places: tuple[tuple[float, float], ...]
    layer: str
    height: float = 0.0
    size: float = 0.0


@dataclass
class Drawing:
    """The model space of a DXF file.

    Attributes
    ----------
    unit_m
        Metres of its unit as declared; None if it declares none.
    shapes, texts
        What is drawn on visible layers.
    left_out
        Number of entities by the reason that they are not read.
    """

    unit_m: float | None
    shapes: list[DrawnShape] = field(default_factory=list)
    texts: list[DrawnText] = field(default_factory=list)
    left_out: Counter[str] = field(default_factory=Counter)


class _Within(NamedTuple):
    """The block of an entity: name of the outermost, layer for those on layer 0, names from within outwards, depth."""

    name: str
    layer: str
    told: tuple[str, ...]
    depth: int


def read_drawing(path: Path) -> Drawing:
    """Read the model space of a DXF file, text or binary, of any version; damaged files are repaired if possible.

    Raises
    ------
    ConfigError
        If the file is not DXF, or is damaged or large beyond reading.
    """
    logging.getLogger("ezdxf").setLevel(logging.CRITICAL)  # each repair would be a line on standard error
    try:
        if path.stat().st_size > _MOST_BYTES:
            raise ConfigError("SOURCE", str(path), f"a drawing of at most {_MOST_BYTES} bytes")
        with path.open("rb") as file:
            if file.read(4) == b"AC10":
                raise ConfigError("SOURCE", str(path), "a DXF, as which CAD programs save this DWG")
        document = _document(path)
        unit_m = _METRES.get(document.header.get("$INSUNITS", 0))
        drawing = Drawing(unit_m)
        hidden = {layer.dxf.name.casefold() for layer in document.layers if layer.is_off() or layer.is_frozen()}
        _Reader(drawing, hidden).add(document.modelspace(), None)
    except _FAULTS as error:
        told = (getattr(error, "strerror", None) or str(error) or type(error).__name__).splitlines()[0][:120]
        raise ConfigError("SOURCE", str(path), f"a DXF drawing ({told})") from None
    return drawing


def _document(path: Path) -> Any:  # noqa: ANN401 - ezdxf's Drawing, of which only a few members are used
    try:
        return readfile(path)
    except _FAULTS:
        return recover.readfile(path)[0]


class _FullError(ValueError):
    """A drawing with more shapes than are read."""


class _Reader:
    """Collects the shapes of entities."""

    def __init__(self, drawing: Drawing, hidden: set[str]) -> None:
        self._drawing, self._hidden = drawing, hidden

    def add(self, entities: Iterable[Any], within: _Within | None) -> None:
        for entity in entities:
            if len(self._drawing.shapes) + len(self._drawing.texts) > _MOST_SHAPES:
                raise _FullError(f"more than {_MOST_SHAPES} shapes")
            try:
                own = str(entity.dxf.get("layer", "0"))
                layer = within.layer if within and own == "0" else own
                if own.casefold() in self._hidden or layer.casefold() in self._hidden:
                    self._drawing.left_out[f"on the layer {layer}, which is off or frozen"] += 1
                elif not entity.dxf.get("invisible", 0):
                    self._add(entity, layer, within)
            except _FullError:
                raise
            except _FAULTS:
                self._drawing.left_out[f"{entity.dxftype()} entities that are damaged"] += 1

    def _add(self, entity: Any, layer: str, within: _Within | None) -> None:  # noqa: ANN401 - any entity of ezdxf
        kind = entity.dxftype()
        name = within.name if within else f"{kind} {entity.dxf.get('handle') or ''}".strip()
        told = (layer, *(within.told if within else ()))
        if kind == "INSERT":
            self._add_block(entity, _Within(name, layer, told, within.depth if within else 0))
        elif kind in {"TEXT", "ATTRIB", "MTEXT"}:
            self._drawing.texts.extend(_text(entity, layer))
        elif kind in _APART and kind not in _SILENT:
            self.add(entity.virtual_entities(), _Within(name, layer, told, (within.depth if within else 0) + 1))
        elif kind not in _SILENT:
            part = next((part for part in map(kind_of, told) if part is not None), None)
            lines = list(_lines(entity))
            if not lines:
                self._drawing.left_out[f"{kind} entities, which have no outline that is read"] += 1
            width = float(entity.dxf.get("const_width", 0.0) or 0.0) if kind == "LWPOLYLINE" else 0.0
            self._drawing.shapes.extend(
                DrawnShape(name, layer, part, points, is_closed, kind in _FILLED, told, heights, width)
                for points, heights, is_closed in lines
            )

    def _add_block(self, entity: Any, within: _Within) -> None:  # noqa: ANN401 - an INSERT of ezdxf
        if within.depth > _MOST_NESTED or entity.mcount > _MOST_SHAPES:
            raise ValueError("blocks within blocks without end")
        record = get_dynamic_block_definition(entity, entity.doc) if entity.doc else None
        title = str(record.dxf.name if record else entity.dxf.name)
        inner = within._replace(told=(title, *within.told), depth=within.depth + 1)
        for insert in entity.multi_insert() if entity.mcount > 1 else (entity,):
            self.add(insert.attribs, within)
            self.add(insert.virtual_entities(), inner)


def _text(entity: Any, layer: str) -> Iterator[DrawnText]:  # noqa: ANN401 - a text of ezdxf
    text = " ".join(entity.plain_text().split())
    if not text:
        return
    is_long = entity.dxftype() == "MTEXT"
    x, y, z = entity.dxf.insert if is_long else entity.ocs().to_wcs(entity.dxf.insert)
    height = float(entity.dxf.get("char_height" if is_long else "height", 0.0) or 0.0)
    places = [(float(x), float(y))]
    if is_long:
        across, down = (entity.dxf.attachment_point - 1) % 3, (entity.dxf.attachment_point - 1) // 3
        turn_rad = math.radians(entity.get_rotation())
    else:
        across, down, turn_rad = 0, 2, math.radians(entity.dxf.get("rotation", 0.0))
        if entity.dxf.hasattr("align_point") and entity.dxf.get("halign", 0) in {1, 4}:  # centred
            x, y, z = entity.ocs().to_wcs(entity.dxf.align_point)
            across, down = 1, 2 if entity.dxf.halign == 1 else 1
    right, up = (1 - across) * 0.35 * height * len(text), (down - 1) * height / 2
    cos, sin = math.cos(turn_rad), math.sin(turn_rad)
    places.insert(0, (float(x) + right * cos - up * sin, float(y) + right * sin + up * cos))
    if all(math.isfinite(value) and abs(value) < _MOST_COORDINATE for place in places for value in place):
        yield DrawnText(text, tuple(places), layer, float(z), height)


def _lines(entity: Any) -> Iterator[tuple[Floats, tuple[float, float], bool]]:  # noqa: ANN401 - an entity of ezdxf
    """Yield the lines of an entity, with arcs as chords, the heights of their ends, and True for rings."""
    kind = entity.dxftype()
    if kind == "POINT":
        found: list[Any] = [[entity.dxf.location]]
    elif kind == "LINE":
        found = [[entity.dxf.start, entity.dxf.end]]
    else:
        try:
            paths = ezpath.from_hatch(entity) if kind in {"HATCH", "MPOLYGON"} else [ezpath.make_path(entity)]
            found = [list(_flat(path)) for single in paths for path in single.sub_paths()]
        except TypeError:  # of kinds without a path
            return
    for line in found:
        places = np.array([(point.x, point.y, point.z) for point in line], np.float64).reshape(-1, 3)
        if len(places) == 0 or not (np.abs(places) < _MOST_COORDINATE).all():
            continue
        points, heights = places[:, :2], (float(places[0, 2]), float(places[-1, 2]))
        length = float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
        is_closed = len(points) > 3 and math.dist(points[0], points[-1]) <= _CLOSED * length  # noqa: PLR2004 - a triangle
        yield (points[:-1] if is_closed else points), heights, is_closed


def _flat(path: Any) -> Iterable[Any]:  # noqa: ANN401 - a path of ezdxf
    if not path.has_curves:
        return path.control_vertices()  # type: ignore[no-any-return]
    extent = max(ezpath.bbox([path], fast=True).size)
    return path.flattening(max(extent * _FLAT, 1e-9))  # type: ignore[no-any-return]
