"""A vector drawing in metres, independent of the output format (SVG or raster)."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import lru_cache

from PIL import ImageFont

__all__ = ["Colour", "Disc", "Drawing", "Line", "Point", "Region", "Text", "text_width"]

Colour = tuple[int, int, int]
"""Red, green and blue, 0 to 255."""
Point = tuple[float, float]
"""(x, z): x to the right, z downwards; metres."""
_MEASURED_PX = 100


@dataclass(frozen=True, slots=True)
class Region:
    """A filled polygon; `kind` and `name` classify it, in formats that store that."""

    points: Sequence[Point]
    fill: Colour
    kind: str = ""
    name: str = ""


@dataclass(frozen=True, slots=True)
class Line:
    """A polyline."""

    points: Sequence[Point]
    colour: Colour
    width_m: float
    kind: str = ""


@dataclass(frozen=True, slots=True)
class Disc:
    """A filled circle with a rim."""

    centre: Point
    radius_m: float
    fill: Colour
    rim: Colour
    rim_width_m: float
    kind: str = ""


@dataclass(frozen=True, slots=True)
class Text:
    """A line of text, centred vertically on its position.

    Attributes
    ----------
    at
        Position of the text's centre, or of the centre of its left edge.
    text, height_m, colour
        The text; its line height; its colour.
    is_left
        Whether the text starts at `at`.
    is_turned
        Whether the text runs upwards.
    kind
        Class of the text.
    """

    at: Point
    text: str
    height_m: float
    colour: Colour
    is_left: bool = False
    is_turned: bool = False
    kind: str = ""


@dataclass(frozen=True)
class Drawing:
    """A drawing: elements from back to front.

    Attributes
    ----------
    low, high
        (x, z) of the upper left and the lower right corner, metres.
    px_per_m
        Pixels per metre of a raster image.
    paper
        Background colour.
    title
        Title of the drawing.
    elements
        Elements in drawing order.
    """

    low: Point
    high: Point
    px_per_m: float
    paper: Colour
    title: str
    elements: Iterable[Region | Line | Disc | Text] = field(default_factory=list)


def text_width(text: str, height: float) -> float:
    """Width of a text of a given height, in the height's unit."""
    return _measured(text) / _MEASURED_PX * height


@lru_cache(maxsize=4096)
def _measured(text: str) -> float:
    return float(_font().getlength(text))


@lru_cache(maxsize=1)
def _font() -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    return ImageFont.load_default(size=_MEASURED_PX)
