"""XML files that anybody may have written: without document type declarations, of one root element."""

import xml.etree.ElementTree as ET
from pathlib import Path

from garage2usd.common.documents import MAX_REPORT_BYTES, read_text
from garage2usd.common.errors import ConfigError

__all__ = ["read_xml"]


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
    text = read_text(path, field="SOURCE", max_bytes=MAX_REPORT_BYTES)
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
