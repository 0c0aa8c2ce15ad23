"""The end that a signal asks for."""

import signal
import sys
from types import FrameType

__all__ = ["TERMINATION"]

_TERMINATED = 128 + signal.SIGTERM


class Termination:
    """SIGTERM unwinds like an exception, so that temporary files go."""

    def __init__(self) -> None:
        self._asked = False

    def __call__(self, _signal: int, _frame: FrameType | None) -> None:
        """Handle the signal."""
        self._asked = True
        sys.exit(_TERMINATED)

    def insist(self) -> None:
        """Unwind now, if whatever was running when the signal came swallowed the exception, as callbacks from C do."""
        if self._asked:
            sys.exit(_TERMINATED)


TERMINATION = Termination()
"""Of this process."""
