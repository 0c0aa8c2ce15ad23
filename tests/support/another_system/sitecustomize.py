"""Shows the modules of garage2usd another system than the one they run on: with this folder on the path of modules, and
``AS_ON=win32`` or ``AS_ON=darwin`` in the environment, Python loads it in every process before all else.

Other packages see the system that is there. Modules, functions and signals that the other system lacks are gone for
garage2usd, and on Windows files that this process has open, or USD mapped into memory, cannot be moved or removed.
"""

import builtins
import errno
import fcntl
import os
import re
import signal
import subprocess
import sys
import types
from pathlib import Path

AS_ON = os.environ.get("AS_ON")
_LACKS = {
    "darwin": {
        "modules": {"msvcrt", "winreg"},
        "os": {"sched_getaffinity", "sched_setaffinity", "memfd_create", "sendfile"},
        "signal": {"SIGRTMIN", "SIGRTMAX", "SIGPWR", "SIGSTKFLT"},
    },
    "win32": {
        "modules": {"curses", "fcntl", "grp", "posix", "pty", "pwd", "readline", "resource", "syslog", "termios"},
        "os": {
            name
            for name in dir(os)
            if re.match(r"(W[A-Z]|fork|sched_|set|getuid|geteuid|sysconf|killpg|mkfifo|statvfs|chown|pipe2)", name)
        },
        "signal": {
            name for name in dir(signal) if re.match("(SIG|sig|pthread|pause|alarm|setitimer)", name)
        } - {"SIGABRT", "SIGFPE", "SIGILL", "SIGINT", "SIGSEGV", "SIGTERM", "SIG_DFL", "SIG_IGN", "signal"},
    },
}  # fmt: skip


class _View(types.ModuleType):
    """A module without some of its names, and with others in their place."""

    def __init__(self, real, lacks=(), **others):
        super().__init__(real.__name__)
        self.__dict__.update(others)
        self.__dict__["_real"], self.__dict__["_lacks"] = real, frozenset(lacks)

    def __getattr__(self, name):
        if name in self._lacks:
            raise AttributeError(f"module {self.__name__!r} has no attribute {name!r} on {AS_ON}")
        return getattr(self._real, name)

    def __setattr__(self, name, value):  # such as sys.stdout
        setattr(self._real, name, value)


class _WindowsPopen(subprocess.Popen):
    def __init__(self, *arguments, **named):
        refused = sorted(
            {"pass_fds", "preexec_fn", "start_new_session"} & {name for name, value in named.items() if value}
        )
        if refused:
            raise ValueError(f"{refused} are not supported on Windows platforms")
        super().__init__(*arguments, **named)


def _locking(descriptor, mode, _count):
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB if mode else fcntl.LOCK_UN)
    except OSError as error:
        raise PermissionError(errno.EACCES, "Permission denied") from error


def _as_on_windows(name):
    """A function of `os` that moves or removes files, and refuses what Windows does."""
    real = getattr(os, name)

    def act(*places, **named):
        folder = named.get("dir_fd")
        for place in places:
            path = os.fspath(place)
            path = path.decode() if isinstance(path, bytes) else path
            if folder is not None:
                path = os.path.join(os.readlink(f"/proc/self/fd/{folder}"), path)
            if _is_open(os.path.realpath(path)):
                raise PermissionError(errno.EACCES, "The process cannot access the file", path)
        if name == "rename" and os.path.exists(places[1]):
            raise FileExistsError(errno.EEXIST, "Cannot create a file when that file already exists", places[1])
        return real(*places, **named)

    return act


def _is_open(path):
    """Whether this process has a file open or mapped, or one in a folder."""
    held = set(re.findall(r"(/\S+)$", Path("/proc/self/maps").read_text(), flags=re.MULTILINE))
    for descriptor in Path("/proc/self/fd").iterdir():
        try:
            held.add(os.readlink(descriptor))
        except OSError:  # that of the folder itself, which is closed
            continue
    return any(one == path or (one.startswith(f"{path}/") and os.path.isfile(one)) for one in held)


def _no_link(source, target, *_arguments, **_named):
    raise OSError(errno.EPERM, "A required privilege is not held by the client", source, None, target)


def _install():
    lacks = _LACKS[AS_ON]
    views = {
        "sys": _View(sys, platform=AS_ON),
        "os": _View(os, lacks["os"]),
        "signal": _View(signal, lacks["signal"]),
    }
    if AS_ON == "win32":
        views["subprocess"] = _View(subprocess, Popen=_WindowsPopen)
        views["msvcrt"] = types.ModuleType("msvcrt")
        views["msvcrt"].locking, views["msvcrt"].LK_NBLCK, views["msvcrt"].LK_UNLCK = _locking, 2, 0
        for name in ("unlink", "remove", "rename", "replace"):
            setattr(os, name, _as_on_windows(name))
        os.symlink = _no_link
    else:
        views["resource"] = _limits_of_macos()
    real = builtins.__import__

    def import_(name, globals=None, locals=None, fromlist=(), level=0):  # noqa: A002 - Python's own names
        if level == 0 and globals and str(globals.get("__name__")).startswith("garage2usd"):
            if name.partition(".")[0] in lacks["modules"]:
                raise ModuleNotFoundError(f"No module named {name!r} on {AS_ON}", name=name)
            if name in views:
                return views[name]
        found = real(name, globals, locals, fromlist, level)
        if name == "garage2usd.common.system":  # whose library of loops is compiled for the system that is there
            sys.modules[name].LIBRARY_SUFFIX = ".so"
        return found

    builtins.__import__ = import_


def _limits_of_macos():
    """Macs refuse a limit of data that is lower than what a process has mapped."""
    import resource

    def setrlimit(kind, limits):
        if kind == resource.RLIMIT_DATA:
            raise ValueError("current limit exceeds maximum limit")
        resource.setrlimit(kind, limits)

    return _View(resource, setrlimit=setrlimit)


if AS_ON:
    _install()
