"""Text of survey files: XML that anybody may have written, numbers, and other programs' words for uses and sides."""

import codecs
import math
import re
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import NoReturn

from garage2usd.common.documents import read_bytes
from garage2usd.common.errors import ConfigError
from garage2usd.config.stalls import SizeClass
from garage2usd.garage import StallUse
from garage2usd.survey.survey import PortalKind

_MOST_BYTES = 32 * 1024 * 1024
"""Size limit of XML, which takes up to thirty times as much memory."""
_MARKS = {
    codecs.BOM_UTF8: "utf-8",
    codecs.BOM_UTF16_LE: "utf-16",
    codecs.BOM_UTF16_BE: "utf-16",
    b"<\0?\0": "utf-16-le",
    b"\0<\0?": "utf-16-be",
}
"""Encodings by the first bytes of a file."""
_DECLARED = re.compile(rb"""\s*<\?xml[^>]*?\sencoding\s*=\s*["']([A-Za-z0-9._:-]{1,40})["']""")
MOST_M = 1e8
"""Greatest coordinate: projections of the whole earth have lower ones."""
_USE_WORDS = {
    StallUse.ACCESSIBLE: ("disabled", "accessible", "handicap", "wheelchair", "barrier-free"),
    StallUse.EV: ("charging", "electric", "ev"),
}
_SIZE_WORDS = {
    SizeClass.COMPACT: ("compact", "small"),
    SizeClass.LARGE: ("large",),
    SizeClass.VAN: ("van",),
}
_PORTAL_WORDS = {
    "entrance": PortalKind.ENTRANCE,
    "entry": PortalKind.ENTRANCE,
    "exit": PortalKind.EXIT,
    "both": PortalKind.BOTH,
    "portal": PortalKind.BOTH,
    "parking_entrance": PortalKind.BOTH,
}
_LENGTH = re.compile(
    r"""\+?(?P<number>\d+(?:[.,]\d*)?|[.,]\d+)(?:e(?P<power>[-+]?\d{1,2}))?\s*(?P<unit>m|cm|ft|feet|'|in|")?\s*"""
    r"""((?<=['t])\s*(?P<inches>\d+(?:\.\d+)?)\s*(?:in|"))?"""
)
_UNITS_M = {"m": 1.0, "cm": 0.01, "ft": 0.3048, "feet": 0.3048, "'": 0.3048, "in": 0.0254, '"': 0.0254}
_LONGEST_M = 1000.0


def read_xml(path: Path, root: str, program: str) -> ET.Element:
    """Read an XML file.

    Parameters
    ----------
    path
        The file.
    root
        Name of its root element.
    program
        Description of such a file, for errors.

    Raises
    ------
    ConfigError
        If the file cannot be read, is not well formed, has another root, or declares a document type, whose entities
        could expand without limit.
    """
    data = read_bytes(path, field="SOURCE", max_bytes=_MOST_BYTES)
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
        why = "as its XML declares" if declared else "as it declares no other encoding"
        raise ConfigError("SOURCE", str(path), f"text in {encoding}, {why} ({said})") from None


def length_of(text: object) -> float | None:
    """Return a length above 0, up to 1000 m, as people write it, such as ``5.5``, ``5,5 m`` or ``8'6"``; else None."""
    if isinstance(text, bool) or not isinstance(text, int | float | str):
        return None
    found = _LENGTH.fullmatch(str(text).strip().lower())
    if found is None:
        return None
    number = float(found["number"].replace(",", ".")) * 10.0 ** int(found["power"] or 0)
    length_m = number * _UNITS_M[found["unit"] or "m"] + float(found["inches"] or 0) * _UNITS_M['"']
    return length_m if 0 < length_m <= _LONGEST_M else None


def unread_length(name: str, text: object) -> str:
    """Explain why a length of a part is not used."""
    return f"the {name} {str(text)!r}, which is no length above 0 m, up to {_LONGEST_M:g} m"


_RUN_OF_LEVELS = re.compile(r"(-?\d{1,4})-(-?\d{1,4})")

_NUMBER, _MOST_LEVELS = re.compile(r"-?\d{1,6}(\.\d*)?"), 50


def levels_of(tags: Mapping[str, str]) -> set[str]:
    """Return the levels of an element as numbers without trailing zeros.

    For example ``-1.0`` is -1, and ``-1;0`` and ``-1-0`` are both -1 and 0. A level that is not a number is its own
    name; without any, the set is empty.
    """
    levels: set[str] = set()
    for part in f"{tags.get('level', '')};{tags.get('repeat_on', '')}".split(";"):
        word = part.strip().replace(",", ".")
        run = _RUN_OF_LEVELS.fullmatch(word)
        if run and 0 <= int(run[2]) - int(run[1]) <= _MOST_LEVELS:
            levels.update(str(number) for number in range(int(run[1]), int(run[2]) + 1))
        elif _NUMBER.fullmatch(word):
            levels.add(f"{float(word) + 0.0:g}")
        elif word:
            levels.add(word)
    return levels


def refuse(place: str, value: object, allowed: str) -> NoReturn:
    """Raise the `ConfigError` of a value in a file."""
    raise ConfigError(place, value, allowed)


def number_of(text: object, place: str, *, most: float = MOST_M, unit: str = "metres") -> float:
    """Return a finite number that a file holds as text or number.

    Raises
    ------
    ConfigError
        If the value is not a number, or its absolute value is above `most`.
    """
    allowed = f"a number of {unit} from -{most:g} to {most:g}"
    if isinstance(text, bool) or not isinstance(text, int | float | str) or (isinstance(text, str) and "_" in text):
        refuse(place, text, allowed)
    try:
        number = float(text)
    except (ValueError, OverflowError):
        refuse(place, text, allowed)
    if not math.isfinite(number) or abs(number) > most:
        refuse(place, text, allowed)
    return number


def positive_of(text: object, place: str, *, most: float = 1000.0) -> float:
    """Return a number of metres above 0; raises `ConfigError` as `number_of`."""
    number = number_of(text, place, most=most)
    if number <= 0:
        refuse(place, text, f"a number of metres above 0, up to {most:g}")
    return number


def use_of(words: Iterable[str]) -> StallUse:
    """Return the use of a stall that words of a file tell, the first that does; standard if none does."""
    for text in words:
        said = text.strip().lower()
        if said in set(StallUse):
            return StallUse(said)
        tokens = set(said.replace("_", " ").replace(";", " ").split())
        for use, known in _USE_WORDS.items():
            if any(word in tokens or (len(word) > 2 and word in said) for word in known):  # noqa: PLR2004 - "ev"
                return use
    return StallUse.STANDARD


def size_of(words: Iterable[str]) -> SizeClass:
    """Return the size class of a stall that words of a file tell; standard if none does."""
    for text in words:
        tokens = set(text.lower().replace("_", " ").replace(";", " ").split())
        for size, known in _SIZE_WORDS.items():
            if tokens.intersection(known):
                return size
    return SizeClass.STANDARD


def portal_kind_of(text: str) -> PortalKind | None:
    """Return the kind of portal that a word tells, or None."""
    return _PORTAL_WORDS.get(text.strip().lower())
