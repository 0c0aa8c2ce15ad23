"""Garbage collection of the process, and parallel tasks in forked copies of it."""

import gc
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from multiprocessing import get_context
from typing import TypeVar, cast

from garage2usd.common.system import can_be_copied

_Outcome = TypeVar("_Outcome")


@contextmanager
def without_collector() -> Iterator[None]:
    """Disable Python's cyclic garbage collector, as hardly any of the millions of small values are in a cycle."""
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()


def run_in_forks(tasks: Sequence[Callable[[], _Outcome]], workers: int) -> Iterator[_Outcome]:
    """Run tasks in forked copies of this process, which share its memory.

    Parameters
    ----------
    tasks
        Functions to call; their results and exceptions are pickled.
    workers
        Maximum number of copies.

    Yields
    ------
    object
        Results of the tasks, in order.

    Raises
    ------
    Exception
        The exception of the first task that fails; tasks that have not started are cancelled.

    Notes
    -----
    A fork has only the calling thread. Tasks therefore run here in turn if this process has several threads, as
    libraries may start them, if the system cannot fork, or for a single worker or task. The remaining tasks run here
    too if a copy crashes, so that this process ends as it would without copies. The number of threads is known on Linux
    only.
    """
    workers, done = min(workers, len(tasks)), 0
    if workers > 1 and can_be_copied():
        with (
            suppress(BrokenProcessPool),
            ProcessPoolExecutor(workers, get_context("fork"), initializer=_hold, initargs=(tasks,)) as pool,
        ):
            for outcome in cast("Iterator[_Outcome]", pool.map(_do, range(len(tasks)))):
                done += 1
                yield outcome
    yield from (task() for task in tasks[done:])


_held: Sequence[Callable[[], object]] = ()


def _hold(tasks: Sequence[Callable[[], object]]) -> None:
    """Store the tasks in the process, so that only their indices are sent to a copy."""
    global _held  # noqa: PLW0603 - of a process that does nothing else
    _held = tasks


def _do(number: int) -> object:
    return _held[number]()
