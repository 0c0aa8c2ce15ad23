"""Progress callbacks of long steps; only ``cli`` prints."""

from typing import Protocol

_TEN_S, _MINUTE_S = 10, 60


class Progress(Protocol):
    """Callback of a long step with the number of finished units."""

    def __call__(self, step: str, done: int, total: int) -> None:
        """Report that `done` of `total` units of `step` are finished."""


def silent(step: str, done: int, total: int) -> None:
    """Ignore progress; the default of every step."""


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
