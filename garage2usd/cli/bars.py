"""Progress on a terminal."""

from types import TracebackType
from typing import TYPE_CHECKING, Self, TextIO

import click

from garage2usd.cli.termination import TERMINATION
from garage2usd.progress import when_compiling

if TYPE_CHECKING:
    from click._termui_impl import ProgressBar

__all__ = ["Bars"]

_COMPILED = {"garage2usd.planning": ("the planner", 10), "garage2usd.driving": ("the search for paths", 5)}
"""Rooms with compiled functions, what they are to a reader, and about how many seconds a machine of 2020 takes."""


class Bars:
    """One progress bar for each step that reports, and a line where the compiler has to run; on a terminal only.

    Parameters
    ----------
    stream
        The terminal, or what stands in its place.
    unit
        What is counted, in steps that take long enough for a rate to be told.
    """

    def __init__(self, stream: TextIO, *, unit: str | None = None) -> None:
        self._stream = stream
        self._unit = unit
        self._step = ""
        self._bar: ProgressBar[int] | None = None

    def __enter__(self) -> Self:
        """Start without a bar."""
        for room in _COMPILED:
            when_compiling(room, self._announce)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """End the last bar."""
        self._end()
        for room in _COMPILED:
            when_compiling(room, None)

    def __call__(self, step: str, done: int, total: int) -> None:
        """Show that `done` of `total` units of `step` are finished."""
        TERMINATION.insist()
        if not self._stream.isatty():
            return
        if step != self._step or self._bar is None:
            self._end()
            self._step = step
            self._bar = click.progressbar(
                length=total,
                label=f"{step:>10}",
                file=self._stream,
                show_pos=self._unit is not None,
                item_show_func=self._rate,
            )
            self._bar.__enter__()
        self._bar.update(done - self._bar.pos, 0)

    def _rate(self, item: int | None) -> str | None:
        """How fast it goes, beside the time that is left."""
        if self._unit is None or item is None or self._bar is None or not self._bar.time_per_iteration:
            return None
        return f"{1 / self._bar.time_per_iteration:.2g} {self._unit}/s"

    def _announce(self, room: str) -> None:
        """Say what is compiled; the bar begins anew after it, as its rate is not that of compiling."""
        if self._stream.isatty():
            what, seconds = _COMPILED[room]
            self._leave()
            click.echo(f"compiling {what}, once after installing: about {seconds} s", file=self._stream)

    def _end(self) -> None:
        if self._bar is not None:
            self._bar.update((self._bar.length or 0) - self._bar.pos)
            self._leave()

    def _leave(self) -> None:
        if self._bar is not None:
            self._bar.__exit__(None, None, None)
            self._bar = None
