"""How long steps tell the command line how far they are; nothing below ``cli`` prints."""

from collections.abc import Callable
from typing import Protocol

__all__ = ["Progress", "compiling", "silent", "when_compiling"]

_told: dict[str, Callable[[str], None]] = {}


class Progress(Protocol):
    """Called now and then by a long step with how much of it is done."""

    def __call__(self, step: str, done: int, total: int) -> None:
        """Say that `done` of `total` units of `step` are finished."""


def silent(step: str, done: int, total: int) -> None:
    """Ignore progress: the default of every step."""


def when_compiling(room: str, tell: Callable[[str], None] | None) -> None:
    """Have `tell` called with a room's name, once, when functions of that room have to be compiled; None for nobody."""
    _told.pop(room, None)
    if tell is not None:
        _told[room] = tell


def compiling(module: str) -> None:
    """Tell who asked to be told that a function of a module is being compiled."""
    for room in [room for room in _told if module.startswith(f"{room}.")]:
        _told.pop(room)(room)
