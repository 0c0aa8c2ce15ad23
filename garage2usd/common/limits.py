"""Limits of processor time and memory for a process that reads what anybody may have written, and of threads.

Those of time and memory hold only in a process that `enforce`s them, as the commands do that read stages: USD composes
without an end in sight where a few lines refer to each other in doubling numbers, and nothing in it can be told to
stop. Windows has none.
"""

from garage2usd.common.system import limit_memory, limit_processor_s

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
    limit_memory(_MAX_MEMORY_BYTES)


def allow_seconds(seconds: float) -> None:
    """End this process by SIGXCPU if it takes more seconds of processor time than so many from now on."""
    if _enforced:
        limit_processor_s(seconds)


def lift() -> None:
    """Let this process, and those that it starts, take any time and memory."""
    if _enforced:
        limit_processor_s(None)
        limit_memory(None)
