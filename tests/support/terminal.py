"""Commands on a pseudo-terminal, as a person sees them, and in pipes."""

import os
import pty
import re
import subprocess
import sys

# click tells the time left a second after a step began; a clock that runs faster lets short steps have it too
_LAUNCH = """
import sys, time, types
import click._termui_impl as bars
bars.time = types.SimpleNamespace(time=lambda: {speed} * time.time())
from garage2usd.cli import run
sys.argv[0] = "garage2usd"
sys.exit(run())
"""
_ESCAPE = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]")
_SPEED = 100_000


def on_terminal(arguments, *, folder, columns=120):
    """Run a command whose standard error is a terminal: exit code and what it showed, a text for each state of a line.

    Its clock of bars is a hundred thousand times as fast.
    """
    ours, its = pty.openpty()
    environment = {**os.environ, "TERM": "xterm", "COLUMNS": str(columns)}
    command = [sys.executable, "-c", _LAUNCH.format(speed=_SPEED), *map(str, arguments)]
    with subprocess.Popen(command, cwd=folder, env=environment, stdout=subprocess.DEVNULL, stderr=its) as process:
        os.close(its)
        seen = b""
        try:
            while data := os.read(ours, 65536):
                seen += data
        except OSError:  # of Linux, where the other end is closed
            pass
        os.close(ours)
    text = _ESCAPE.sub("", seen.decode())
    return process.returncode, [line.rstrip() for line in re.split(r"[\r\n]+", text) if line.strip()]


def in_pipe(arguments, *, folder):
    """Run a command with standard error in a pipe: exit code and its text."""
    command = [sys.executable, "-m", "garage2usd", *map(str, arguments)]
    run = subprocess.run(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=False)
    return run.returncode, run.stderr.decode()
