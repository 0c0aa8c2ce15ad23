"""XML files that anybody may have written: without document type declarations, of one root element."""

import codecs
import re
import xml.etree.ElementTree as ET
from pathlib import Path

from garage2usd.common.documents import MAX_REPORT_BYTES, read_bytes
from garage2usd.common.errors import ConfigError

__all__ = ["read_xml"]

_MARKS = {
    codecs.BOM_UTF8: "utf-8",
    codecs.BOM_UTF16_LE: "utf-16",
    codecs.BOM_UTF16_BE: "utf-16",
    b"<\0?\0": "utf-16-le",
    b"\0<\0?": "utf-16-be",
}
"""Encodings by the first bytes of a file."""
_DECLARED = re.compile(rb"""\s*<\?xml[^>]*?\sencoding\s*=\s*["']([A-Za-z0-9._:-]{1,40})["']""")


def read_xml(path: Path, root: str, program: str) -> ET.Element:
    """Read an XML file.

    Parameters
    ----------
    path
        The file.
    root
        Name of its root element.
    program
        What such a file is, for errors.

    Raises
    ------
    ConfigError
        For what cannot be read, is not well formed, has another root, or declares a document type, whose entities
        could grow without end.
    """
    data = read_bytes(path, field="SOURCE", max_bytes=MAX_REPORT_BYTES)
    text = _decoded(data, path)
    if "<!DOCTYPE" in text:
        raise ConfigError("SOURCE", str(path), f"{program} without a document type declaration (<!DOCTYPE)")
    try:
        element = ET.fromstring(text)  # noqa: S314 - no document type, so no entities
    except (ET.ParseError, ValueError, RecursionError) as error:
        raise ConfigError("SOURCE", str(path), f"{program}, which is XML ({error})") from None
    for part in element.iter():
        part.tag = part.tag.rpartition("}")[2]  # OpenDRIVE may have a namespace
    if element.tag != root:
        raise ConfigError(f"{path.name}: root element", element.tag, f"{root}, of {program}")
    return element


def _decoded(data: bytes, path: Path) -> str:
    """Decode XML by its byte order mark, else by the encoding that it declares, else as UTF-8."""
    mark = next((name for signature, name in _MARKS.items() if data.startswith(signature)), None)
    declared = _DECLARED.match(data)
    encoding = mark or (declared[1].decode("ascii") if declared else "utf-8")
    try:
        return data.decode(encoding).removeprefix("\ufeff")
    except LookupError:
        raise ConfigError(f"{path.name}: encoding", encoding, "a known one, such as UTF-8 or ISO-8859-1") from None
    except ValueError as error:
        said = f"{error.reason} at byte {error.start}" if isinstance(error, UnicodeDecodeError) else "no text"
        raise ConfigError("SOURCE", str(path), f"text in {encoding}, as its XML declares ({said})") from None
