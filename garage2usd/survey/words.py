"""Words of survey files: numbers, and what other programs call uses, sizes, portals and directions."""

import math
from collections.abc import Iterable
from typing import NoReturn

from garage2usd.common.errors import ConfigError
from garage2usd.config.stalls import SizeClass
from garage2usd.garage import StallUse
from garage2usd.survey.survey import PortalKind

__all__ = ["MOST_M", "number_of", "portal_kind_of", "positive_of", "refuse", "size_of", "use_of"]

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
