"""JSON in few bytes, which people can still read."""

import json
import re
from collections.abc import Callable, Mapping

__all__ = ["json_text", "short_json"]

_STRING_OR_ZERO = re.compile(r'(?P<string>"(?:[^"\\]|\\.)*")|(?<=\d)(?<!-0)\.0(?![\de])')
"""A string, or what makes a whole number look like others; not that of -0.0, whose sign an integer has not."""


def short_json(value: object) -> str:
    """JSON without blanks, and with whole numbers as such, which it does not tell from others: 2.0 as 2.

    Raises
    ------
    ValueError
        If a number is NaN or infinite, which JSON cannot say.
    """
    text = json.dumps(value, separators=(",", ":"), allow_nan=False)
    return _STRING_OR_ZERO.sub(lambda found: found["string"] or "", text)


def json_text(document: Mapping[str, object]) -> str:
    """A JSON object with a line for each key, for each object of a list, and for each list of an object; else short."""
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
