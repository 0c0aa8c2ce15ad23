"""Reproducible XML files of maps."""

import re
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping
from functools import lru_cache
from pathlib import Path

_DIGITS = 9
_DECLARATION = "<?xml version='1.0' encoding='utf-8'?>"
_INDENT, _END = "  ", " />"
_SPECIAL = re.compile(r"[&<>\r\n\t]")
_NOT_OF_XML = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")
_REPLACEMENT = "\ufffd"
_ESCAPES = str.maketrans(
    {"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;", "\r": "&#13;", "\n": "&#10;", "\t": "&#09;"}
)
_TEXT_ESCAPES = str.maketrans({"&": "&amp;", "<": "&lt;", ">": "&gt;"})


@lru_cache(maxsize=2**16)
def number_text(value: float) -> str:
    """Format a number to the nanometre, as short as possible."""
    rounded = round(float(value), _DIGITS) + 0.0
    return str(int(rounded)) if rounded == int(rounded) else repr(rounded)


def child(parent: ET.Element, tag: str, /, **attributes: float | str) -> ET.Element:
    """Add a child element; Python keywords as attribute names end in an underscore."""
    texts = {
        name.rstrip("_"): value if isinstance(value, str) else number_text(value) for name, value in attributes.items()
    }
    return ET.SubElement(parent, tag, texts)


def tag_text(tag: str, attributes: Mapping[str, str]) -> str:
    """Format a tag with its attributes, without the closing bracket."""
    text = "".join([f' {name}="{value}"' for name, value in attributes.items()])
    if _SPECIAL.search(text) or text.count('"') != 2 * len(attributes):
        text = "".join([f' {name}="{value.translate(_ESCAPES)}"' for name, value in attributes.items()])
    return f"<{tag}{text}"


def element_lines(element: ET.Element, *, indent: str = _INDENT, end: str = _END) -> list[str]:
    """Format an element without namespaces, and its descendants, as lines.

    Parameters
    ----------
    element
        Element with either text or children.
    indent
        Indentation of a child.
    end
        End of an empty element.
    """
    lines: list[str] = []
    _add_lines(lines, element, "", indent, end)
    return lines


def _add_lines(lines: list[str], element: ET.Element, before: str, indent: str, end: str) -> None:
    text = before + tag_text(element.tag, element.attrib)
    if len(element):
        lines.append(f"{text}>")
        for inner in element:
            _add_lines(lines, inner, before + indent, indent, end)
        lines.append(f"{before}</{element.tag}>")
    elif element.text:
        lines.append(f"{text}>{element.text.translate(_TEXT_ESCAPES)}</{element.tag}>")
    else:
        lines.append(text + end)


def write_xml(root: ET.Element, path: Path) -> None:
    """Write an XML file in the form of `write_lines`."""
    write_lines(element_lines(root), path)


def write_lines(lines: Iterable[str], path: Path) -> None:
    """Write the lines of an XML file in UTF-8 with line feeds; characters invalid in XML are replaced."""
    path.write_bytes(_NOT_OF_XML.sub(_REPLACEMENT, "\n".join([_DECLARATION, *lines, ""])).encode())
