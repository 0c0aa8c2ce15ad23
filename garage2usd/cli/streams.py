"""Standard output and error: they accept any text, show control characters and report a full disk in one line."""

import errno
import io
import os
import re
import sys
from contextlib import suppress
from typing import TYPE_CHECKING, Any, TextIO, cast

from garage2usd.common.errors import OutputError
from garage2usd.common.system import is_console

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer

__all__ = ["ShownText", "drawn_on", "open_streams"]

_OUTPUT, _ERROR = 1, 2
_CONTROL = re.compile("[\0-\b\v-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]")
"""Characters that move the cursor, ring, colour or reverse text, except tabs and ends of lines."""


def open_streams() -> None:
    """Reopen standard output and standard error, so that they accept any text in any encoding.

    Control characters, and those outside the encoding, for example in a file's name, are printed as their code numbers.
    A standard output that accepts no more data raises `OutputError`; data for a failed standard error or for closed
    streams is lost.
    """
    for number in range(_ERROR + 1):  # else the next file gets the number, and what libraries print goes into it
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
        Of the file, which stays open.
    is_needed
        Whether it is an error if it takes no more.
    """

    def __init__(self, descriptor: int, *, is_needed: bool) -> None:
        super().__init__(descriptor, "w", closefd=False)
        self._is_needed = is_needed

    def write(self, data: "ReadableBuffer", /) -> int:
        """Write bytes; after an error, discard them and all buffered ones."""
        size = memoryview(data).nbytes
        try:
            return super().write(data) if size else 0  # click tries with nothing whether a stream takes text
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
