"""Limits of processor time and memory for a process that reads what anybody may have written, and of threads.

Those of time and memory hold only in a process that `enforce`s them, as the commands do that read stages: USD composes
without an end in sight where a few lines refer to each other in doubling numbers, and nothing in it can be told to
stop.
"""

import math
import resource

__all__ = ["ONE_THREAD", "allow_seconds", "enforce", "lift"]

ONE_THREAD = {"PXR_WORK_THREAD_LIMIT": "1", "TF_ENV_SETTING_ALERTS_ENABLED": "0", "OPENBLAS_NUM_THREADS": "1"}
"""Environment of a process in which libraries keep to the thread that calls them, set before they are loaded.

Threads of USD and OpenBLAS look for work in a loop between the short pieces that a garage has for them: a quarter of
the processor time of a check. USD's own `Work.SetConcurrencyLimit` leaves one that does so for ever; and it prints such
settings if it is not told otherwise.
"""

_MAX_MEMORY_BYTES = 8 * 1024**3
_enforced = False


def enforce() -> None:
    """Let this process take 8 GB of memory, leave no core file, and heed `allow_seconds` from now on."""
    global _enforced  # noqa: PLW0603 - limits are the process's own
    _enforced = True
    most = resource.getrlimit(resource.RLIMIT_DATA)[1]
    resource.setrlimit(resource.RLIMIT_DATA, (_lower(_MAX_MEMORY_BYTES, most), most))
    resource.setrlimit(resource.RLIMIT_CORE, (0, resource.getrlimit(resource.RLIMIT_CORE)[1]))


def allow_seconds(seconds: float) -> None:
    """End this process by SIGXCPU if it takes more seconds of processor time than so many from now on."""
    if _enforced:
        used = resource.getrusage(resource.RUSAGE_SELF)
        _set_seconds(math.ceil(used.ru_utime + used.ru_stime + seconds))


def lift() -> None:
    """Let this process, and those that it starts, take any time and memory."""
    if _enforced:
        _set_seconds(resource.RLIM_INFINITY)
        most = resource.getrlimit(resource.RLIMIT_DATA)[1]
        resource.setrlimit(resource.RLIMIT_DATA, (most, most))


def _set_seconds(limit: int) -> None:
    most = resource.getrlimit(resource.RLIMIT_CPU)[1]
    resource.setrlimit(resource.RLIMIT_CPU, (_lower(limit, most), most))


def _lower(limit: int, most: int) -> int:
    """The lower of two limits; infinity is a negative number."""
    return min((value for value in (limit, most) if value != resource.RLIM_INFINITY), default=resource.RLIM_INFINITY)
