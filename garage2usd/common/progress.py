"""How long steps tell the command line what they make and how far they are; nothing below ``cli`` prints."""

from typing import Protocol

__all__ = ["Announce", "Progress", "silent", "time_in_words", "unheard"]

_TEN_S, _MINUTE_S = 10, 60


class Progress(Protocol):
    """Called now and then by a long step with how much of it is done."""

    def __call__(self, step: str, done: int, total: int) -> None:
        """Say that `done` of `total` units of `step` are finished."""


def silent(step: str, done: int, total: int) -> None:
    """Ignore progress: the default of every step."""


class Announce(Protocol):
    """Called by a long step with a line that says what it will make, or how long that takes."""

    def __call__(self, text: str) -> None:
        """Say it."""


def unheard(text: str) -> None:
    """Ignore what is said: the default of every step."""


def time_in_words(seconds: float) -> str:
    """How long something takes, as ``8.4 s``, ``2 min 10 s`` or ``1 h 5 min``."""
    if round(seconds, 1) < _TEN_S:
        return f"{seconds:.1f} s"
    minutes, rest = divmod(round(seconds), _MINUTE_S)
    if not minutes:
        return f"{rest} s"
    hours, minutes = divmod(minutes, _MINUTE_S)
    return f"{hours} h {minutes} min" if hours else f"{minutes} min {rest} s"
