"""Progress on a terminal."""

from types import TracebackType
from typing import TYPE_CHECKING, Self, TextIO

import click

from garage2usd.cli.termination import TERMINATION

if TYPE_CHECKING:
    from click._termui_impl import ProgressBar

__all__ = ["Bars"]


class Bars:
    """One progress bar for each step that reports; on a terminal only.

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
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """End the last bar."""
        self._end()

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

    def _end(self) -> None:
        if self._bar is not None:
            self._bar.update((self._bar.length or 0) - self._bar.pos)
            self._bar.__exit__(None, None, None)
            self._bar = None
