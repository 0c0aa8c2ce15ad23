"""Progress callbacks of long steps; only ``cli`` prints."""

from collections.abc import Iterable, Iterator
from typing import Protocol, TypeVar

_TEN_S, _MINUTE_S = 10, 60
_Unit = TypeVar("_Unit")


class Progress(Protocol):
    """Callback of a long step with the number of finished units."""

    def __call__(self, step: str, done: int, total: int) -> None:
        """Report that `done` of `total` units of `step` are finished."""


def silent(step: str, done: int, total: int) -> None:
    """Ignore progress; the default of every step."""


def counted(step: str, units: Iterable[_Unit], total: int, progress: Progress) -> Iterator[_Unit]:
    """Yield the units of a step, and report each as finished once the next one is asked for."""
    progress(step, 0, total)
    for done, unit in enumerate(units, 1):
        yield unit
        progress(step, done, total)


class Announce(Protocol):
    """Callback of a long step with an announcement in one line."""

    def __call__(self, text: str) -> None:
        """Report an announcement."""


def unheard(text: str) -> None:
    """Ignore announcements; the default of every step."""


def time_in_words(seconds: float) -> str:
    """Format a duration, as ``8.4 s``, ``2 min 10 s`` or ``1 h 5 min``."""
    if round(seconds, 1) < _TEN_S:
        return f"{seconds:.1f} s"
    minutes, rest = divmod(round(seconds), _MINUTE_S)
    if not minutes:
        return f"{rest} s"
    hours, minutes = divmod(minutes, _MINUTE_S)
    return f"{hours} h {minutes} min" if hours else f"{minutes} min {rest} s"
