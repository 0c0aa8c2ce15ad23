"""The process of a command: its standard streams, its end by a signal, and a child process that reads USD."""

import errno
import io
import os
import re
import signal
import sys
from collections.abc import Callable
from contextlib import suppress
from types import FrameType
from typing import TYPE_CHECKING, Any, NoReturn, TextIO, cast

from garage2usd.common.errors import OutputError
from garage2usd.common.limits import enforce
from garage2usd.common.system import OUT_OF_TIME, is_console, run_in_child

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer

_OUTPUT, _ERROR = 1, 2
_CONTROL = re.compile("[\0-\b\v-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]")
"""Characters that move the cursor, ring, colour or reverse text, except tabs and ends of lines."""
ENDING = tuple(getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name))
"""Signals that ask a process to end: `kill` sends the first, a terminal that closes the second."""
SUPERVISED = frozenset({"check", "drive", "export", "plan", "render", "traffic", "view"})
"""The commands that open stages from unknown sources."""
CRASHES = {
    getattr(signal, name)
    for name in ("SIGSEGV", "SIGABRT", "SIGBUS", "SIGFPE", "SIGILL", "SIGKILL")
    if hasattr(signal, name)
}
_FAILED = 1


def open_streams() -> None:
    """Reopen standard output and standard error, so that they accept any text in any encoding.

    Control characters, and those outside the encoding, for example in a file's name, are printed as their code numbers.
    A standard output that accepts no more data raises `OutputError`; data for a failed standard error or for closed
    streams is lost.
    """
    for number in range(_ERROR + 1):  # else the next opened file would receive what libraries print
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)
    output, error = (
        sys.stdout or os.fdopen(_OUTPUT, "w", closefd=False),
        sys.stderr or os.fdopen(_ERROR, "w", closefd=False),
    )
    sys.stdout = cast("TextIO", ShownText(_opened(output, is_needed=True)))
    sys.stderr = cast("TextIO", ShownText(_opened(error, is_needed=False)))


def drawn_on(stream: TextIO) -> TextIO:
    """Return the stream below a `ShownText`, on which progress bars move the cursor; else the stream itself."""
    return stream.below if isinstance(stream, ShownText) else stream


class ShownText:
    """A text stream that writes control characters as escapes: names and messages in files cannot drive a terminal.

    It has no attribute `buffer`, through which click would write past it.

    Parameters
    ----------
    below
        The stream that gets the text.
    """

    def __init__(self, below: TextIO) -> None:
        self.below = below

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401 - of the stream below
        """Return an attribute of the stream below."""
        if name in {"below", "buffer"}:
            raise AttributeError(name)
        return getattr(self.below, name)

    def write(self, text: str | bytes) -> int:
        """Write text, or bytes of UTF-8, in which click writes completions for shells.

        Raises
        ------
        TypeError
            For no bytes at all, with which click finds out whether a stream takes bytes in place of text.
        """
        if text == b"":
            raise TypeError("a stream of text takes bytes as completions only")
        told = text.decode() if isinstance(text, bytes) else text
        self.below.write(_CONTROL.sub(lambda found: ascii(found[0])[1:-1], told))
        return len(text)


def _opened(stream: TextIO, *, is_needed: bool) -> TextIO:
    if is_console(stream.fileno()) and isinstance(stream, io.TextIOWrapper):
        stream.reconfigure(errors="backslashreplace")
        return stream
    file = _File(stream.fileno(), is_needed=is_needed)
    is_unbuffered = isinstance(stream.buffer, io.RawIOBase)
    return io.TextIOWrapper(
        file if is_unbuffered else io.BufferedWriter(file),
        encoding=stream.encoding,
        errors="backslashreplace",
        line_buffering=bool(stream.line_buffering),
        write_through=is_unbuffered,
    )


class _File(io.FileIO):
    """The file of a standard stream.

    Parameters
    ----------
    descriptor
        Descriptor of the file, which stays open.
    is_needed
        True to raise an error if the file accepts no more data.
    """

    def __init__(self, descriptor: int, *, is_needed: bool) -> None:
        super().__init__(descriptor, "w", closefd=False)
        self._is_needed = is_needed

    def write(self, data: "ReadableBuffer", /) -> int:
        """Write bytes; after an error, discard them and all buffered ones."""
        size = memoryview(data).nbytes
        try:
            return super().write(data) if size else 0  # click writes nothing to test if a stream takes text
        except OSError as error:
            with suppress(OSError):
                nothing = os.open(os.devnull, os.O_WRONLY)
                os.dup2(nothing, self.fileno())
                os.close(nothing)
            if not self._is_needed:
                return size
            if error.errno == errno.EPIPE:  # whoever reads it has read enough
                raise
            raise OutputError("standard output", error.strerror or str(error)) from None


class Termination:
    """The signals in `ENDING`, and Ctrl-C, unwind like an exception, so that temporary files go."""

    def __init__(self) -> None:
        self._asked = 0

    def install(self) -> None:
        """Handle the signals, except those that the caller made this process ignore, as `nohup` does."""
        self._asked = 0
        for number in (*ENDING, signal.SIGINT):
            if signal.getsignal(number) is not signal.SIG_IGN:
                signal.signal(number, self)

    def __call__(self, number: int, _frame: FrameType | None) -> None:
        """Handle a signal."""
        self._asked = number
        self.insist()

    def insist(self) -> None:
        """Raise the exception again, if the interrupted code swallowed it, as callbacks from C do.

        USD's modules do so, too, while they are imported.
        """
        if self._asked == signal.SIGINT:
            raise KeyboardInterrupt
        if self._asked:
            sys.exit(128 + self._asked)


TERMINATION = Termination()
"""Of this process."""


def supervise(command: Callable[[], object], *, name: str) -> NoReturn:
    """Run a command in a child process and end as it ends; if it crashes, that is an error in one line and exit code 1.

    The child has the limits of `garage2usd.common.limits`, and gets the signals that ask this process to end. It is
    forked before any library is loaded, so nothing is loaded twice and no thread is lost. Windows has no `fork`: there
    the command runs in this process, without limits.
    """
    for stream in (sys.stdout, sys.stderr):
        stream.flush()
    code = run_in_child(command, passed_on=(*ENDING, signal.SIGINT), begin=enforce)
    if code >= 0:
        sys.exit(code)
    number = -code
    if number == OUT_OF_TIME:
        sys.stderr.write(f"Error: {name} takes too long for so small a stage: its composition does not seem to end\n")
        sys.exit(_FAILED)
    if number in CRASHES:
        said = signal.strsignal(number) or f"signal {number}"
        sys.stderr.write(
            f"Error: {name} crashed ({said.lower()}): the stage is damaged, or too large for this machine\n"
        )
        sys.exit(_FAILED)
    sys.exit(128 + number)
