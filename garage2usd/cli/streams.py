"""Standard output and error: they accept any text and report a full disk in one line."""

import errno
import io
import os
import sys
from contextlib import suppress
from typing import TYPE_CHECKING, TextIO

from garage2usd.common.errors import OutputError
from garage2usd.common.system import is_console

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer

__all__ = ["open_streams"]

_OUTPUT, _ERROR = 1, 2


def open_streams() -> None:
    """Reopen standard output and standard error, so that they accept any text in any encoding.

    Characters outside the encoding, for example in a file's name, are printed as their code numbers. A standard output
    that accepts no more data raises `OutputError`; data for a failed standard error or for closed streams is lost.
    """
    for number in range(_ERROR + 1):  # else the next file gets the number, and what libraries print goes into it
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)
    sys.stdout = _opened(sys.stdout or os.fdopen(_OUTPUT, "w", closefd=False), is_needed=True)
    sys.stderr = _opened(sys.stderr or os.fdopen(_ERROR, "w", closefd=False), is_needed=False)


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
