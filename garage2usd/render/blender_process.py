"""Blender in a separate process: the Python module `bpy` or an installed program."""

import functools
import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from garage2usd.common.errors import ConfigError, RenderError
from garage2usd.common.package import BLENDER, PICTURES, is_there
from garage2usd.common.system import blender_places, temporary_in

_SCRIPT = Path(__file__).with_name("blender.py")
_PATIENCE_S = 5.0
_ANSWER_S = 120.0
"""Timeout in seconds for an installed Blender to print its version; its first start reads a gigabyte."""
_TOLD_LINES = 3
_HEARTBEAT_S = 1.0
_LOOK_S = 0.05
_OLDEST = (5, 0)
_OLDEST_WORDS = ".".join(map(str, _OLDEST))
INSTALLED = f"or a Blender {_OLDEST_WORDS} or later that is installed"
"""Hint at an alternative to the Python module, where installed programs are looked for."""
WITHOUT_MODULE = f"{INSTALLED}: --blender names its program"
"""The same hint for commands with the option ``--blender``."""
_REPORT = "report.txt"
_VERSION = re.compile(r"^Blender (\d+)\.(\d+)", re.MULTILINE)


@dataclass(frozen=True)
class Blender:
    """A Blender that runs scripts.

    Attributes
    ----------
    program
        The installed program; None for the Python module `bpy`.
    """

    program: Path | None = None

    def command(self, script: Path, *arguments: str) -> list[str]:
        """Return the command line that runs a script in Blender with arguments."""
        if self.program is None:
            # no file beside the script may take the place of a module
            return [sys.executable, "-P", str(script), *arguments]
        quiet = ("--background", "--factory-startup", "--disable-autoexec", "--python-exit-code", "1")
        return [str(self.program), *quiet, "--python", str(script), "--", *arguments]


BLENDER_MODULE = Blender()
"""The Python module `bpy`."""


def find_blender(asked: str | Path | None = None) -> Blender:
    """Find the Blender for rendering: the requested one, else the module `bpy`, else an installed program.

    Parameters
    ----------
    asked
        A program, or the folder or application that contains it. If None, the program is looked for on the path and
        where the system usually has it, of version 5.0 or later.

    Raises
    ------
    ConfigError
        If the requested program is not a Blender of version 5.0 or later.

    Notes
    -----
    If no Blender is found, the module is returned; `modules_of` then names the missing packages.
    """
    if asked is not None:
        program = _program_in(Path(asked))
        if fault := _fault(program):
            raise ConfigError("blender", str(asked), f"the program of Blender {_OLDEST_WORDS} or later; {fault}")
        return Blender(program)
    if not is_there("bpy"):
        on_path = shutil.which("blender")
        for program in [*([Path(on_path)] if on_path else []), *blender_places(os.environ)]:
            if not _fault(program):
                return Blender(program)
    return BLENDER_MODULE


def modules_of(blender: Blender) -> tuple[str, ...]:
    """Return the names of the Python modules that rendering with a Blender requires."""
    return BLENDER if blender.program is None else PICTURES


def _program_in(path: Path) -> Path:
    """Return the Blender program of a path to the program, its folder or its application."""
    inner = (path / "blender", path / "blender.exe", path / "Contents" / "MacOS" / "Blender")
    return next((place for place in inner if place.is_file()), path).absolute()


@functools.cache
def _fault(program: Path) -> str | None:
    """Explain why a file is not a usable Blender; None if it is one."""
    if not program.is_file():
        return "there is no such file"
    try:
        told = subprocess.run(  # noqa: S603 - what the user names
            [str(program), "--background", "--version"],
            capture_output=True,
            text=True,
            encoding="utf-8",
            errors="replace",
            stdin=subprocess.DEVNULL,
            timeout=_ANSWER_S,
            check=False,
        )
    except OSError as error:
        return f"it does not start ({error.strerror})"
    except subprocess.TimeoutExpired:
        return f"it does not say its version within {_ANSWER_S:.0f} s"
    version = _VERSION.search(told.stdout)
    if version is None:
        return "it does not say that it is Blender"
    found = int(version[1]), int(version[2])
    return None if found >= _OLDEST else f"this is {found[0]}.{found[1]}"


def run_blender(
    job: Mapping[str, Any],
    folder: Path,
    done: Callable[[int], None],
    blender: Blender = BLENDER_MODULE,
    *,
    script: Path = _SCRIPT,
) -> None:
    """Run a job in a Blender process; by default render its pictures (see ``blender.py``).

    Parameters
    ----------
    job
        The job as plain values.
    folder
        Folder for the job file and Blender's output.
    done
        Called with the number of finished samples: 0 when the scene is read, then at least once a second.
    blender
        The Blender to run.
    script
        The program, which takes the path of the job file.

    Raises
    ------
    RenderError
        If Blender fails. The Blender process has always ended when this function returns or raises.
    """
    path, log, report = folder / "job.json", folder / "blender.log", folder / _REPORT
    path.write_text(json.dumps({**job, "report": str(report)}), encoding="utf-8", newline="\n")
    report.write_bytes(b"")
    with log.open("wb") as output:
        process = subprocess.Popen(  # noqa: S603 - our own script
            blender.command(script, str(path)),
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
            cwd=folder,
            env={**os.environ, **temporary_in(folder)},
        )
        try:
            for samples in _numbers(report, lambda: _ends_within(process, _LOOK_S)):
                done(samples)
            code = process.wait()
        finally:
            _end(process)
    if code != 0:
        said = [line for line in log.read_text(encoding="utf-8", errors="replace").splitlines() if line.strip()]
        raise RenderError(code, " | ".join(said[-_TOLD_LINES:]))


def _numbers(report: Path, has_ended: Callable[[], bool]) -> Iterator[int]:
    """Yield the numbers written line by line to a file, repeating the last one while none is written.

    A file works on every system; Windows can neither wait for a pipe nor pass its descriptor to a child.
    """
    text, last, silent_s = b"", None, 0.0
    with report.open("rb") as reports:
        is_over = False
        while not is_over:
            is_over = has_ended()
            *lines, text = (text + reports.read()).split(b"\n")
            for line in lines:
                last, silent_s = int(line), 0.0
                yield last
            silent_s += _LOOK_S
            if silent_s >= _HEARTBEAT_S and last is not None and not is_over:
                silent_s = 0.0
                yield last


def _ends_within(process: "subprocess.Popen[bytes]", seconds: float) -> bool:
    try:
        process.wait(seconds)
    except subprocess.TimeoutExpired:
        return False
    return True


def _end(process: "subprocess.Popen[bytes]") -> None:
    if process.poll() is None:
        process.terminate()
        try:
            process.wait(_PATIENCE_S)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
