"""A vector drawing in metres, as SVG and as an image."""

import math
from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from xml.etree import ElementTree as ET

from PIL import Image, ImageDraw, ImageFont

Colour = tuple[int, int, int]
"""Red, green and blue, 0 to 255."""
Point = tuple[float, float]
"""(x, z): x to the right, z downwards; metres."""
_MEASURED_PX = 100
_LEAST_LETTERS_PX = 6
_ROOM_PX = 2
"""Padding in pixels around text, which may exceed its nominal width."""
_SHADES = 3
"""Number of shades at the rim of a letter."""
_SHADE_OF = [round(round(share / 255 * (_SHADES - 1)) * 255 / (_SHADES - 1)) for share in range(256)]
_COMPRESSION, _COMPRESSION_OF_LARGE = 8, 7
"""Compression levels of zlib. A plan of 7 x 9 squares takes 35 KB and 32 ms with 8, 43 KB and 17 ms with 7, 34 KB and
74 ms with 9; one of 20 x 30 takes 214 KB and 240 ms with 8, 239 KB and 100 ms with 7, the difference being
1 % of its stage."""
_LARGE_PX = 4_000_000
CM_PER_M = 100
"""Centimetres as the unit of the file, as some programs round text heights below one unit."""
_FONT = "Aileron, Helvetica, Arial, sans-serif"


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
        True if the text starts at `at`.
    is_turned
        True if the text runs upwards.
    kind
        Class of the text.
    font
        Font file of the text in images; empty for the usual one, which has Latin letters without marks only.
    """

    at: Point
    text: str
    height_m: float
    colour: Colour
    is_left: bool = False
    is_turned: bool = False
    kind: str = ""
    font: str = ""


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


def text_width(text: str, height: float, font: str = "") -> float:
    """Width of a text of a given height, in the height's unit; with a font file as in `Text`."""
    return _measured(text, font) / _MEASURED_PX * height


@lru_cache(maxsize=4096)
def _measured(text: str, font: str) -> float:
    return float(_letters_font(_MEASURED_PX, font).getlength(text))


def to_image(drawing: Drawing) -> Image.Image:
    """Rasterise a drawing as RGB; text lower than 6 pixels is left out.

    Notes
    -----
    The same drawing gives the same pixels.
    """
    (left, top), (right, bottom), scale = drawing.low, drawing.high, drawing.px_per_m
    image = Image.new("RGB", (round((right - left) * scale), round((bottom - top) * scale)), drawing.paper)
    draw = ImageDraw.Draw(image)

    def pixel(point: tuple[float, float]) -> tuple[float, float]:
        return (point[0] - left) * scale, (point[1] - top) * scale

    for element in drawing.elements:
        match element:
            case Region():
                draw.polygon([pixel(point) for point in element.points], fill=element.fill)
            case Line():
                width = max(1, round(element.width_m * scale))
                draw.line([pixel(point) for point in element.points], fill=element.colour, width=width, joint="curve")
            case Disc():
                width = max(1, round(element.rim_width_m * scale))
                draw.circle(pixel(element.centre), element.radius_m * scale, element.fill, element.rim, width)
            case Text():
                _write(image, element, pixel(element.at), round(element.height_m * scale))
    return image


def write_png(image: Image.Image, path: Path) -> None:
    """Write an image as a PNG with a palette of 256 colours, at half the bytes and time of true colour.

    The colour of an area changes by at most one step of 255, and that of a letter's rim by few more.
    """
    few = image.quantize(256, method=Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
    if few.width * few.height > _LARGE_PX:
        few.save(path, format="PNG", compress_level=_COMPRESSION_OF_LARGE)
        return
    # only the used entries: a full palette takes 0.6 KB more
    used = [colour for colour, pixels in enumerate(few.histogram()) if pixels]
    few.remap_palette(used).save(path, format="PNG", compress_level=_COMPRESSION)


def _write(image: Image.Image, text: Text, at: tuple[float, float], size_px: int) -> None:
    """Draw text in few shades at whole pixels, since the rims of letters make up most of a plan's bytes."""
    if size_px < _LEAST_LETTERS_PX:
        return
    font = _letters_font(size_px, text.font)
    width = math.ceil(font.getlength(text.text)) + 2 * _ROOM_PX
    letters = Image.new("L", (width, 2 * size_px))
    ImageDraw.Draw(letters).text((_ROOM_PX, size_px), text.text, fill=255, font=font, anchor="lm")
    letters = letters.point(_SHADE_OF)
    if text.is_turned:
        letters = letters.transpose(Image.Transpose.ROTATE_90)
    left = at[0] - (_ROOM_PX if text.is_left and not text.is_turned else letters.width / 2)
    image.paste(text.colour, (round(left), round(at[1] - letters.height / 2)), letters)


@lru_cache(maxsize=64)
def _letters_font(size_px: int, file: str) -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    with suppress(OSError):  # a font that FreeType does not take
        if file:
            return ImageFont.truetype(file, size_px)
    return ImageFont.load_default(size=size_px)


def to_svg(drawing: Drawing, *, is_inline: bool = False) -> str:
    """Write a drawing as an SVG document with the centimetre as its unit.

    Parameters
    ----------
    drawing
        The drawing.
    is_inline
        True for a part of a page with other drawings: it is never wider than the page, and the names and kinds of
        regions are their tooltips, in place of ids, which could occur twice on the page.

    Notes
    -----
    The kind of an element is written as its ``class``, and the name of a region as its ``id``. The same drawing gives
    the same text.
    """
    (left, top), (right, bottom) = drawing.low, drawing.high
    root = ET.Element(
        "svg",
        {
            "xmlns": "http://www.w3.org/2000/svg",
            "width": _number((right - left) * drawing.px_per_m),
            "height": _number((bottom - top) * drawing.px_per_m),
            "viewBox": " ".join(_length(value) for value in (left, top, right - left, bottom - top)),
            "font-family": _FONT,
            "text-anchor": "middle",
            "stroke-linejoin": "round",
            **({"style": "max-width:100%;height:auto"} if is_inline else {}),
        },
    )
    ET.SubElement(root, "title").text = drawing.title
    _add(root, Region([(left, top), (right, top), (right, bottom), (left, bottom)], drawing.paper, "paper"))
    for element in drawing.elements:
        _add(root, element, is_inline=is_inline)
    ET.indent(root, space="")
    return ET.tostring(root, encoding="unicode") + "\n"


def _add(root: ET.Element, element: Region | Line | Disc | Text, *, is_inline: bool = False) -> None:
    about = {"class": element.kind} if element.kind else {}
    match element:
        case Region():
            if element.name and not is_inline:
                about["id"] = element.name
            shape = {"points": _points(element.points), "fill": _colour(element.fill)}
            polygon = ET.SubElement(root, "polygon", {**about, **shape})
            if is_inline and (words := f"{element.name} {element.kind}".strip()):
                ET.SubElement(polygon, "title").text = words
        case Line():
            stroke = {"stroke": _colour(element.colour), "stroke-width": _length(element.width_m), "fill": "none"}
            ET.SubElement(root, "polyline", {**about, "points": _points(element.points), **stroke})
        case Disc():
            x, z = element.centre
            place = {"cx": _length(x), "cy": _length(z), "r": _length(element.radius_m)}
            rim = {"stroke": _colour(element.rim), "stroke-width": _length(element.rim_width_m)}
            ET.SubElement(root, "circle", {**about, **place, "fill": _colour(element.fill), **rim})
        case Text():
            across, down = (_length(value) for value in element.at)
            style = {"font-size": _length(element.height_m), "fill": _colour(element.colour)}
            if element.is_left:
                style["text-anchor"] = "start"
            if element.is_turned:
                style["transform"] = f"rotate(-90 {across} {down})"
            place = {"x": across, "y": down, "dominant-baseline": "central"}
            ET.SubElement(root, "text", {**about, **place, **style}).text = element.text


def _points(points: Sequence[Point]) -> str:
    return " ".join(f"{_length(x)},{_length(z)}" for x, z in points)


def _length(metres: float) -> str:
    return _number(metres * CM_PER_M)


def _number(value: float) -> str:
    return f"{round(value, 2) + 0.0:.2f}".rstrip("0").rstrip(".")


def _colour(colour: Colour) -> str:
    return "#{:02x}{:02x}{:02x}".format(*colour)
