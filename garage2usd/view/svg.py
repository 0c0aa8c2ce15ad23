"""SVG output of a drawing."""

from collections.abc import Sequence
from xml.etree import ElementTree as ET

from garage2usd.view.drawing import Colour, Disc, Drawing, Line, Point, Region, Text

__all__ = ["CM_PER_M", "to_svg"]

CM_PER_M = 100
"""Centimetres as the unit of the file, as some programs round text heights below one unit."""
_FONT = "Aileron, Helvetica, Arial, sans-serif"


def to_svg(drawing: Drawing) -> str:
    """Write a drawing as an SVG document with the centimetre as its unit.

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
        },
    )
    ET.SubElement(root, "title").text = drawing.title
    _add(root, Region([(left, top), (right, top), (right, bottom), (left, bottom)], drawing.paper, "paper"))
    for element in drawing.elements:
        _add(root, element)
    ET.indent(root, space="")
    return ET.tostring(root, encoding="unicode") + "\n"


def _add(root: ET.Element, element: Region | Line | Disc | Text) -> None:
    about = {"class": element.kind} if element.kind else {}
    match element:
        case Region():
            if element.name:
                about["id"] = element.name
            ET.SubElement(root, "polygon", {**about, "points": _points(element.points), "fill": _colour(element.fill)})
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
