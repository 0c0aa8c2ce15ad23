"""Termination by signals: unwinding and removal of temporary files."""

import signal
import sys
from types import FrameType

__all__ = ["ENDING", "TERMINATION"]

ENDING = tuple(getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name))
"""Signals that ask a process to end: `kill` sends the first, a terminal that closes the second."""


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
