"""Words of survey files: numbers, and what other programs call uses, sizes, portals and directions."""

import math
import re
from collections.abc import Iterable, Mapping
from typing import NoReturn

from garage2usd.common.errors import ConfigError
from garage2usd.config.stalls import SizeClass
from garage2usd.garage import StallUse
from garage2usd.survey.survey import PortalKind

__all__ = [
    "MOST_M",
    "length_of",
    "levels_of",
    "number_of",
    "portal_kind_of",
    "positive_of",
    "refuse",
    "size_of",
    "unread_length",
    "use_of",
]

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
    """Return the reason for which a length of a part is not read."""
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
        If it is none, or its absolute value is above `most`.
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
