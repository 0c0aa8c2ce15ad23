"""A process of its own for commands that read USD: a damaged stage can crash the library, not the command."""

import os
import signal
import sys
from collections.abc import Callable
from contextlib import suppress
from types import FrameType
from typing import NoReturn

from garage2usd.cli.termination import ENDING
from garage2usd.limits import enforce

__all__ = ["CRASHES", "SUPERVISED", "supervise"]

SUPERVISED = frozenset({"check", "drive", "export", "plan", "render", "view"})
"""The commands that open stages from unknown sources."""
CRASHES = {signal.SIGSEGV, signal.SIGABRT, signal.SIGBUS, signal.SIGFPE, signal.SIGILL, signal.SIGKILL}
_FAILED = 1


def supervise(command: Callable[[], object], *, name: str) -> NoReturn:
    """Run a command in a child process and end as it ends; if it crashes, that is an error in one line and exit code 1.

    The child has the limits of `garage2usd.limits`, and gets the signals that ask this process to end. It is forked
    before any library is loaded, so nothing is loaded twice and no thread is lost.
    """
    for stream in (sys.stdout, sys.stderr):
        stream.flush()
    supervisor = os.getpid()
    child = os.fork()
    if child == 0:
        _become_child(supervisor)
        command()
        sys.exit(0)

    def pass_on(number: int, _frame: FrameType | None) -> None:
        with suppress(ProcessLookupError):
            os.kill(child, number)

    for asked in (*ENDING, signal.SIGINT):
        if signal.getsignal(asked) is not signal.SIG_IGN:
            signal.signal(asked, pass_on)
    _, status = os.waitpid(child, 0)
    if not os.WIFSIGNALED(status):
        sys.exit(os.waitstatus_to_exitcode(status))
    number = os.WTERMSIG(status)
    if number == signal.SIGXCPU:
        sys.stderr.write(f"Error: {name} takes too long for so small a stage: its composition does not seem to end\n")
        sys.exit(_FAILED)
    if number in CRASHES:
        said = signal.strsignal(number) or f"signal {number}"
        sys.stderr.write(
            f"Error: {name} crashed ({said.lower()}): the stage is damaged, or too large for this machine\n"
        )
        sys.exit(_FAILED)
    sys.exit(128 + number)


def _become_child(supervisor: int) -> None:
    """Set limits, leave the terminal's signals to the supervisor, and end with it, even where that is killed."""
    os.setpgid(0, 0)
    enforce()
    if sys.platform == "linux":
        import ctypes  # noqa: PLC0415 - no other command needs it

        parent_death_signal = 1
        ctypes.CDLL(None).prctl(parent_death_signal, signal.SIGTERM)
        if os.getppid() != supervisor:  # it was gone before
            sys.exit(_FAILED)
