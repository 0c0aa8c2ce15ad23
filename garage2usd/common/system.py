"""Differences between Windows, macOS and Linux: limits, child processes, locks, moves and file names.

All other modules import these functions instead of modules that one of the systems lacks. Windows has neither limits
nor `fork`: a command that reads a stage runs in the main process there.
"""

import errno
import math
import os
import platform
import re
import shutil
import signal
import sys
import time
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from pathlib import Path
from types import FrameType
from typing import IO, TypeVar

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl
    import resource

_T = TypeVar("_T")

LIBRARY_SUFFIX = {"win32": ".dll", "darwin": ".dylib"}.get(sys.platform, ".so")
"""File extension of the library of compiled loops."""
HAS_EMBREE = platform.machine() != "aarch64"
"""True if Embree's Python package exists for this machine: everywhere except Linux on 64-bit Arm."""
KEEPS_OPEN_FILES = sys.platform == "win32"
"""True if a file cannot be removed while a program has it open."""
OUT_OF_TIME = getattr(signal, "SIGXCPU", None)
"""Signal that ends a process at its limit of processor time; None on systems without a limit."""
LONGEST_PATH = 240 if sys.platform == "win32" else None
"""Longest path in characters: Windows allows 259, of which derived names need some; None for no limit."""

_RESERVED = re.compile(r"(con|prn|aux|nul|com[1-9¹²³]|lpt[1-9¹²³])", re.IGNORECASE)
_FORBIDDEN = '<>:"|?*/\\'
_BUSY = {errno.EACCES, errno.EPERM, errno.EBUSY}
_FIRST_WAIT_S, _PATIENCE_S = 0.05, 5.0
_THREADS = Path("/proc/self/task")
"""Folder with an entry for each thread of this process; Linux only."""


def cores() -> int:
    """Return the number of CPU cores available to this process."""
    if sys.platform == "linux":
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def in_words() -> str:
    """Describe the system: name, version and machine type."""
    libc = " ".join(platform.libc_ver()) if sys.platform == "linux" else ""
    return " ".join(word for word in (platform.system(), platform.release(), platform.machine(), libc) if word)


def can_be_copied() -> bool:
    """True if this process can be forked, which requires a single thread; known on Linux only."""
    return sys.platform == "linux" and _THREADS.is_dir() and len(list(_THREADS.iterdir())) == 1


def is_console(descriptor: int) -> bool:
    """True if text for this descriptor goes to a Windows console, which does not accept UTF-8 bytes."""
    return sys.platform == "win32" and os.isatty(descriptor)


def temporary_in(folder: Path) -> dict[str, str]:
    """Environment variables of a process that makes its temporary files in `folder`."""
    return dict.fromkeys(("TMPDIR", "TEMP", "TMP"), str(folder))


def name_fault(name: str) -> str | None:
    """Describe the allowed file names if the system rejects this name; None if it is allowed."""
    if sys.platform != "win32":
        return None
    if any(sign in _FORBIDDEN or sign < " " for sign in name):
        return f"a file name that Windows takes: without {' '.join(_FORBIDDEN)}"
    if _RESERVED.fullmatch(name.partition(".")[0].rstrip(" ")):
        return "a file name that Windows takes: not that of a device, such as CON, NUL or COM1"
    return "a file name that Windows takes: without a dot or a space at its end" if name.endswith((".", " ")) else None


def persistently(move: Callable[[], _T]) -> _T:
    """Retry a move while another program holds a file open; on Windows up to five seconds.

    Raises
    ------
    OSError
        As raised by the last attempt; if a program holds the file, the message says so.
    """
    wait_s, waited_s = _FIRST_WAIT_S, 0.0
    while True:
        try:
            return move()
        except OSError as error:
            if sys.platform != "win32" or error.errno not in _BUSY:
                raise
            if waited_s >= _PATIENCE_S:
                error.strerror = f"{error.strerror}; close the program that has it open"
                raise
        time.sleep(wait_s)
        waited_s += wait_s
        wait_s *= 2


def link_folder(place: Path, folder: Path) -> None:
    """Link a folder to `place`, or copy it if links require a privilege.

    Raises
    ------
    OSError
        If neither is possible.
    """
    try:
        place.symlink_to(folder, target_is_directory=True)
    except (OSError, NotImplementedError):
        shutil.copytree(folder, place)


def blender_places(environment: Mapping[str, str]) -> list[Path]:
    """List installed Blender executables at their usual paths, newest version first."""
    if sys.platform == "win32":
        roots = [environment.get(name) for name in ("ProgramFiles", "ProgramW6432")]
        found = [path for root in roots if root for path in Path(root).glob("Blender Foundation/*/blender.exe")]
    elif sys.platform == "darwin":
        roots = ["/Applications", f"{environment.get('HOME', '')}/Applications"]
        found = [path for root in roots if root for path in Path(root).glob("Blender*.app/Contents/MacOS/Blender")]
    else:
        patterns = ("/opt/blender*/blender", "/usr/local/blender*/blender", "/snap/bin/blender", "/usr/bin/blender")
        found = [path for pattern in patterns for path in Path("/").glob(pattern[1:])]
    versions = {path: [int(digits) for digits in re.findall(r"\d+", str(path))] for path in found}
    return sorted(versions, key=lambda path: (versions[path], str(path)), reverse=True)


def run_in_child(command: Callable[[], object], *, passed_on: Iterable[int], begin: Callable[[], None]) -> int:
    """Run a command in a child process if the system has `fork`, else in this process.

    Parameters
    ----------
    command
        Function to run.
    passed_on
        Signals that are forwarded to the child.
    begin
        Called first in the child; not called without a child.

    Returns
    -------
    int
        Exit code of the child, or the negative number of the signal that ended it.
    """
    if sys.platform == "win32":
        command()
        return 0
    supervisor = os.getpid()
    child = os.fork()
    if child == 0:
        os.setpgid(0, 0)
        end_with(supervisor, signal.SIGTERM)
        begin()
        command()
        sys.exit(0)

    def pass_on(number: int, _frame: FrameType | None) -> None:
        with suppress(ProcessLookupError):
            os.kill(child, number)

    for asked in passed_on:
        if signal.getsignal(asked) is not signal.SIG_IGN:
            signal.signal(asked, pass_on)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def end_with(parent: int, number: int) -> None:
    """Make Linux send this process a signal when its parent ends, even if the parent is killed; no-op elsewhere."""
    if sys.platform == "linux":
        import ctypes  # noqa: PLC0415 - most commands need none

        parent_death_signal = 1
        ctypes.CDLL(None).prctl(parent_death_signal, number)
        if os.getppid() != parent:  # the parent ended earlier
            sys.exit(1)


if sys.platform == "win32":

    def lock(file: IO[bytes]) -> None:
        """Lock an open file until it is closed.

        Raises
        ------
        BlockingIOError
            If another process has locked it.
        """
        try:
            file.seek(0)
            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
        except OSError as error:
            if error.errno in {errno.EACCES, errno.EAGAIN, errno.EDEADLK}:
                raise BlockingIOError(error.errno, error.strerror) from None

    def limit_memory(most_bytes: int | None) -> None:
        """No-op: Windows has no limit of memory."""

    def limit_processor_s(seconds: float | None) -> None:
        """No-op: Windows has no limit of processor time."""

else:

    def lock(file: IO[bytes]) -> None:
        """Lock an open file until it is closed; where a file system has no locks, nothing is done.

        Raises
        ------
        BlockingIOError
            If another process has locked it.
        """
        try:
            fcntl.flock(file.fileno(), fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            if error.errno in {errno.EACCES, errno.EAGAIN, errno.EDEADLK}:
                raise BlockingIOError(error.errno, error.strerror) from None

    def limit_memory(most_bytes: int | None) -> None:
        """Let this process take so much memory and write no core file, or any memory if it is None."""
        _limit(resource.RLIMIT_DATA, most_bytes)
        if most_bytes is not None:
            _limit(resource.RLIMIT_CORE, 0)

    def limit_processor_s(seconds: float | None) -> None:
        """Let this process take so much more processor time, and end by `OUT_OF_TIME` then, or any if it is None."""
        used = resource.getrusage(resource.RUSAGE_SELF)
        _limit(resource.RLIMIT_CPU, None if seconds is None else math.ceil(used.ru_utime + used.ru_stime + seconds))

    def _limit(kind: int, limit: int | None) -> None:
        """Set a limit, or the highest there may be; macOS takes not every kind."""
        most = resource.getrlimit(kind)[1]
        allowed = [value for value in (limit, most) if value is not None and value != resource.RLIM_INFINITY]
        with suppress(ValueError, OSError):
            resource.setrlimit(kind, (min(allowed, default=resource.RLIM_INFINITY), most))
