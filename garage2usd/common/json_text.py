"""Compact, readable JSON output."""

import json
import re
from collections.abc import Callable, Mapping

__all__ = ["json_text", "short_json"]

_STRING_OR_ZERO = re.compile(r'(?P<string>"(?:[^"\\]|\\.)*")|(?<=\d)(?<!-0)\.0(?![\de])')
"""A string, or the ``.0`` of an integral number; that of -0.0 is kept, since integers have no signed zero."""


def short_json(value: object) -> str:
    """Format JSON without blanks, and with integral floats as integers: 2.0 as 2.

    Raises
    ------
    ValueError
        If a number is NaN or infinite, which JSON does not support.
    """
    text = json.dumps(value, separators=(",", ":"), allow_nan=False)
    return _STRING_OR_ZERO.sub(lambda found: found["string"] or "", text)


def json_text(document: Mapping[str, object]) -> str:
    """Format a JSON object with one line per key, per object of a list, and per list of an object; else compact."""
    return _in_lines(document, _inner) + "\n"


def _inner(value: object) -> str:
    match value:
        case [{}, *_]:
            return "[\n" + ",\n".join(map(short_json, value)) + "\n]"
        case dict() if any(isinstance(entry, list | tuple) for entry in value.values()):
            return _in_lines(value, short_json)
    return short_json(value)


def _in_lines(entries: Mapping[str, object], text: Callable[[object], str]) -> str:
    return "{\n" + ",\n".join(f"{short_json(key)}:{text(value)}" for key, value in entries.items()) + "\n}"
