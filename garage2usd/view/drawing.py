"""A drawing in metres: what is drawn, said once for pictures of pixels and of vectors."""

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
    """A filled polygon; `kind` and `name` say what it is, where a format has a place for that."""

    points: Sequence[Point]
    fill: Colour
    kind: str = ""
    name: str = ""


@dataclass(frozen=True, slots=True)
class Line:
    """A line through points."""

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
    """A line of text around the middle of its height.

    Attributes
    ----------
    at
        Its middle, or the middle of its left end.
    text, height_m, colour
        What it says; size of the letters from line to line.
    is_left
        Whether it starts at `at`.
    is_turned
        Whether it runs upwards.
    kind
        What it is.
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
    """Everything that is drawn, from back to front.

    Attributes
    ----------
    low, high
        (x, z) of the upper left and the lower right corner, metres.
    px_per_m
        How large a picture of pixels is.
    paper
        Colour of what nothing covers.
    title
        What it shows.
    elements
        Drawn one after the other.
    """

    low: Point
    high: Point
    px_per_m: float
    paper: Colour
    title: str
    elements: Iterable[Region | Line | Disc | Text] = field(default_factory=list)


def text_width(text: str, height: float) -> float:
    """How wide a text of a height runs, in the height's unit."""
    return _measured(text) / _MEASURED_PX * height


@lru_cache(maxsize=4096)
def _measured(text: str) -> float:
    return float(_font().getlength(text))


@lru_cache(maxsize=1)
def _font() -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    return ImageFont.load_default(size=_MEASURED_PX)
