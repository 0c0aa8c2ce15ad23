"""What differs between Windows, macOS and Linux: limits, child processes, locks, moves and names of files.

All other modules ask this one, and import nothing that one of the systems lacks. Windows has neither limits nor `fork`
here: a command that reads a stage runs there in the process of the program itself.
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

__all__ = [
    "HAS_EMBREE",
    "KEEPS_OPEN_FILES",
    "LIBRARY_SUFFIX",
    "LONGEST_PATH",
    "OUT_OF_TIME",
    "blender_places",
    "can_be_copied",
    "cores",
    "end_with",
    "in_words",
    "is_console",
    "limit_memory",
    "limit_processor_s",
    "link_folder",
    "lock",
    "name_fault",
    "persistently",
    "run_in_child",
    "temporary_in",
]

_T = TypeVar("_T")

LIBRARY_SUFFIX = {"win32": ".dll", "darwin": ".dylib"}.get(sys.platform, ".so")
"""File extension of the library of compiled loops."""
HAS_EMBREE = platform.machine() != "aarch64"
"""True if Embree's Python package exists for this machine: everywhere except Linux on 64-bit Arm."""
KEEPS_OPEN_FILES = sys.platform == "win32"
"""True if a file cannot be removed while a program has it open."""
OUT_OF_TIME = getattr(signal, "SIGXCPU", None)
"""The signal that ends a process without processor time left; None where no system limits it."""
LONGEST_PATH = 240 if sys.platform == "win32" else None
"""Characters of a whole path: Windows takes 259, of which files beside it take some. None where paths may be longer."""

_RESERVED = re.compile(r"(con|prn|aux|nul|com[1-9¹²³]|lpt[1-9¹²³])", re.IGNORECASE)
_FORBIDDEN = '<>:"|?*/\\'
_BUSY = {errno.EACCES, errno.EPERM, errno.EBUSY}
_FIRST_WAIT_S, _PATIENCE_S = 0.05, 5.0
_THREADS = Path("/proc/self/task")
"""A folder for each thread of this process, where the system is Linux."""


def cores() -> int:
    """Return the number of CPU cores available to this process."""
    if sys.platform == "linux":
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def in_words() -> str:
    """Name the system, its version and its kind of machine."""
    libc = " ".join(platform.libc_ver()) if sys.platform == "linux" else ""
    return " ".join(word for word in (platform.system(), platform.release(), platform.machine(), libc) if word)


def can_be_copied() -> bool:
    """Whether this process can go on twice: it has one thread, which only Linux tells."""
    return sys.platform == "linux" and _THREADS.is_dir() and len(list(_THREADS.iterdir())) == 1


def is_console(descriptor: int) -> bool:
    """Whether text for this descriptor goes to a window of Windows, which takes no bytes in UTF-8."""
    return sys.platform == "win32" and os.isatty(descriptor)


def temporary_in(folder: Path) -> dict[str, str]:
    """Environment of a process that makes its temporary files in `folder`."""
    return dict.fromkeys(("TMPDIR", "TEMP", "TMP"), str(folder))


def name_fault(name: str) -> str | None:
    """Say why the system takes no file of this name, in words for what is allowed; None if it takes one."""
    if sys.platform != "win32":
        return None
    if any(sign in _FORBIDDEN or sign < " " for sign in name):
        return f"a file name that Windows takes: without {' '.join(_FORBIDDEN)}"
    if _RESERVED.fullmatch(name.partition(".")[0].rstrip(" ")):
        return "a file name that Windows takes: not that of a device, such as CON, NUL or COM1"
    return "a file name that Windows takes: without a dot or a space at its end" if name.endswith((".", " ")) else None


def persistently(move: Callable[[], _T]) -> _T:
    """Do what fails as long as another program holds a file open, and on Windows again until five seconds are over.

    Raises
    ------
    OSError
        As the last attempt raises it; if a program holds the file, with that in its message.
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
    """Have a folder stand at `place` too: as a link, or as a copy where links need a privilege.

    Raises
    ------
    OSError
        If neither can be made.
    """
    try:
        place.symlink_to(folder, target_is_directory=True)
    except (OSError, NotImplementedError):
        shutil.copytree(folder, place)


def blender_places(environment: Mapping[str, str]) -> list[Path]:
    """List where Blender is usually installed: its programs that are there, the newest version first."""
    if sys.platform == "win32":
        roots = [environment.get(name) for name in ("ProgramFiles", "ProgramW6432")]
        found = [path for root in roots if root for path in Path(root).glob("Blender Foundation/*/blender.exe")]
    elif sys.platform == "darwin":
        roots = ["/Applications", f"{environment.get('HOME', '')}/Applications"]
        found = [path for root in roots if root for path in Path(root).glob("Blender*.app/Contents/MacOS/Blender")]
    else:
        patterns = ("/opt/blender*/blender", "/usr/local/blender*/blender", "/snap/bin/blender", "/usr/bin/blender")
        found = [path for pattern in patterns for path in Path("/").glob(pattern[1:])]
    return sorted(dict.fromkeys(found), key=lambda path: (_numbers(str(path)), str(path)), reverse=True)


def _numbers(text: str) -> list[int]:
    return [int(digits) for digits in re.findall(r"\d+", text)]


def run_in_child(command: Callable[[], object], *, passed_on: Iterable[int], begin: Callable[[], None]) -> int:
    """Run a command in a child process, if the system has `fork`, else here.

    Parameters
    ----------
    command
        What is run.
    passed_on
        Signals that the child gets when this process does.
    begin
        Called in the child first; not where there is none.

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
    """Have this process get a signal when its parent ends, even if that is killed; only Linux does it."""
    if sys.platform == "linux":
        import ctypes  # noqa: PLC0415 - most commands need none

        parent_death_signal = 1
        ctypes.CDLL(None).prctl(parent_death_signal, number)
        if os.getppid() != parent:  # it was gone before
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
        """Let this process take any memory, as Windows limits none."""

    def limit_processor_s(seconds: float | None) -> None:
        """Let this process take any processor time, as Windows limits none."""

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
