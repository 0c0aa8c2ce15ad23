"""Limits of processor time, memory and threads for a process that reads untrusted files.

Limits of time and memory apply only to a process that calls `enforce`, as the commands that read stages do: a few lines
of USD can refer to each other in exponentially many ways, and composition cannot be interrupted. Windows has no such
limits.
"""

from garage2usd.common.system import limit_memory, limit_processor_s

ONE_THREAD = {"PXR_WORK_THREAD_LIMIT": "1", "TF_ENV_SETTING_ALERTS_ENABLED": "0", "OPENBLAS_NUM_THREADS": "1"}
"""Environment variables that restrict libraries to the calling thread, set before they are loaded.

Otherwise the threads of USD and OpenBLAS poll for work between a garage's short tasks, a quarter of the processor time
of a check. `Work.SetConcurrencyLimit` of USD leaves one polling thread. The second variable silences USD's message
about the first.
"""

_MAX_MEMORY_BYTES = 8 * 1024**3
_enforced = False


def enforce() -> None:
    """Limit this process to 8 GB of memory, disable core dumps, and enable `allow_seconds`."""
    global _enforced  # noqa: PLW0603 - limits are the process's own
    _enforced = True
    limit_memory(_MAX_MEMORY_BYTES)


def allow_seconds(seconds: float) -> None:
    """Limit the processor time of this process to so many seconds from now; SIGXCPU ends it afterwards."""
    if _enforced:
        limit_processor_s(seconds)


def lift() -> None:
    """Remove the limits of time and memory for this process and its child processes."""
    if _enforced:
        limit_processor_s(None)
        limit_memory(None)
