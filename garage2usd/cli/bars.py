"""Progress bars with the time left on a terminal with a cursor; elsewhere a line of text every ten seconds."""

import os
import time
from types import TracebackType
from typing import TYPE_CHECKING, Self, TextIO

import click

from garage2usd.cli.process import TERMINATION, drawn_on
from garage2usd.common.progress import time_in_words

if TYPE_CHECKING:
    from click._termui_impl import ProgressBar

_EVERY_S = 10.0
"""Interval between two lines without a cursor; shorter steps print nothing."""
_BAR, _NAME = "%(label)s  [%(bar)s]  %(info)s", "%(label)s ..."


class Bars:
    """Progress bars, one for each step; without a cursor to move, lines with the progress.

    A step of a single unit, whose time nobody knows, is its name alone. The time left is shown after a second.

    Parameters
    ----------
    stream
        The terminal, or its replacement.
    unit
        Unit of the counts, for steps that are long enough to show a rate.
    """

    def __init__(self, stream: TextIO, *, unit: str | None = None) -> None:
        self._stream, self._screen = stream, drawn_on(stream)
        self._has_cursor = stream.isatty() and os.environ.get("TERM") != "dumb"
        self._unit = unit
        self._step = ""
        self._bar: ProgressBar[int] | None = None
        self._begun_s, self._begun_at, self._said_s = 0.0, 0, time.monotonic()

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
        if not self._has_cursor:
            self._say(step, done, total)
            return
        if self._bar is None or (step, total) != (self._step, self._bar.length) or done < self._bar.pos:
            self._end()
            self._step = step
            self._bar = click.progressbar(
                length=total,
                label=f"{step:>10}",
                bar_template=_BAR if total > 1 else _NAME,
                file=self._screen,
                show_pos=self._unit is not None,
                item_show_func=self._rate,
            )
            self._bar.__enter__()
        self._bar.update(done - self._bar.pos, 0)

    def announce(self, text: str) -> None:
        """Print a line above the current bar."""
        if self._bar is not None and self._has_cursor:
            click.echo("\r\033[K", file=self._screen, nl=False)
        click.echo(text, file=self._stream)

    def _say(self, step: str, done: int, total: int) -> None:
        """Print the progress of a step, unless the last line was printed recently."""
        now_s = time.monotonic()
        if step != self._step:
            self._step, self._begun_s, self._begun_at = step, now_s, done
        if now_s - self._said_s < _EVERY_S:
            return
        self._said_s = now_s
        counted = f"{done} of {total} {self._unit}, " if self._unit else ""
        made = done - self._begun_at
        left_s = (total - done) * (now_s - self._begun_s) / made if made > 0 and done < total else None
        left = "" if left_s is None else f", about {time_in_words(left_s)} left"
        click.echo(f"{step}: {counted}{100 * done // max(total, 1)} %{left}", file=self._stream)

    def _rate(self, item: int | None) -> str | None:
        """Format the speed, which is shown beside the remaining time."""
        if self._unit is None or item is None or self._bar is None or not self._bar.time_per_iteration:
            return None
        return f"{1 / self._bar.time_per_iteration:.2g} {self._unit}/s"

    def _end(self) -> None:
        if self._bar is not None:
            self._bar.update((self._bar.length or 0) - self._bar.pos)
            self._bar.__exit__(None, None, None)
            self._bar = None
