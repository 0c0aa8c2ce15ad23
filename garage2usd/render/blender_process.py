"""Blender in a process of its own."""

import json
import os
import selectors
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping
from io import RawIOBase
from pathlib import Path
from typing import Any

from garage2usd.errors import RenderError
from garage2usd.extras import BLENDER, require

__all__ = ["check_blender", "run_blender"]

_SCRIPT = Path(__file__).with_name("blender.py")
_PATIENCE_S = 5.0
_TOLD_LINES = 3
_HEARTBEAT_S = 1.0
_READ_BYTES = 65536


def check_blender() -> None:
    """Find out whether Blender's Python module is there.

    Raises
    ------
    MissingExtraError
        If not, or if what reads its pictures is not.
    """
    require("render", BLENDER)


def run_blender(job: Mapping[str, Any], folder: Path, done: Callable[[int], None]) -> None:
    """Draw the pictures of a job (see ``blender.py``).

    Parameters
    ----------
    job
        Plain values.
    folder
        Where the job and what Blender says are kept.
    done
        Called with the number of samples that are done: 0 when the scene is read, and at least once a second from then
        on.

    Raises
    ------
    RenderError
        If Blender fails. However this function ends, Blender has ended before.
    """
    reader, writer = os.pipe()
    path, log = folder / "job.json", folder / "blender.log"
    path.write_text(json.dumps({**job, "report_fd": writer}), encoding="utf-8")
    with os.fdopen(reader, "rb", buffering=0) as reports, log.open("wb") as output:
        try:
            # no file beside the script may take the place of a module
            process = subprocess.Popen(  # noqa: S603 - our own script
                [sys.executable, "-P", str(_SCRIPT), str(path)],
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                pass_fds=[writer],
                cwd=folder,
                env={**os.environ, "TMPDIR": str(folder)},
            )
        finally:
            os.close(writer)
        try:
            for samples in _numbers(reports):
                done(samples)
            code = process.wait()
        finally:
            _end(process)
    if code != 0:
        said = [line for line in log.read_text(encoding="utf-8", errors="replace").splitlines() if line.strip()]
        raise RenderError(code, " | ".join(said[-_TOLD_LINES:]))


def _numbers(reports: RawIOBase) -> Iterator[int]:
    """The numbers that are written line by line, and the last one again as long as nothing is written."""
    text, last = b"", None
    with selectors.DefaultSelector() as ready:
        ready.register(reports, selectors.EVENT_READ)
        while True:
            if ready.select(_HEARTBEAT_S):
                found = reports.read(_READ_BYTES)
                if not found:
                    return
                *lines, text = (text + found).split(b"\n")
                for line in lines:
                    last = int(line)
                    yield last
            elif last is not None:
                yield last


def _end(process: "subprocess.Popen[bytes]") -> None:
    if process.poll() is None:
        process.terminate()
        try:
            process.wait(_PATIENCE_S)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
