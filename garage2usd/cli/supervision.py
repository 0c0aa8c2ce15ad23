"""Child processes for commands that read USD, since a damaged stage can crash the USD library."""

import signal
import sys
from collections.abc import Callable
from typing import NoReturn

from garage2usd.cli.termination import ENDING
from garage2usd.common.limits import enforce
from garage2usd.common.system import OUT_OF_TIME, run_in_child

__all__ = ["CRASHES", "SUPERVISED", "supervise"]

SUPERVISED = frozenset({"check", "drive", "export", "plan", "render", "view"})
"""The commands that open stages from unknown sources."""
CRASHES = {
    getattr(signal, name)
    for name in ("SIGSEGV", "SIGABRT", "SIGBUS", "SIGFPE", "SIGILL", "SIGKILL")
    if hasattr(signal, name)
}
_FAILED = 1


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
