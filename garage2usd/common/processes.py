"""The process itself: its collector, and copies of it that do parts of its work at the same time."""

import gc
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from multiprocessing import get_context
from typing import TypeVar, cast

from garage2usd.common.system import can_be_copied

__all__ = ["each_in_a_copy", "without_collector"]

_Outcome = TypeVar("_Outcome")


@contextmanager
def without_collector() -> Iterator[None]:
    """Python's collector of cycles waits: of the millions of small values that are made, hardly one is in a cycle."""
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()


def each_in_a_copy(tasks: Sequence[Callable[[], _Outcome]], workers: int) -> Iterator[_Outcome]:
    """Do tasks in copies of this process, which have all that it has in memory.

    Parameters
    ----------
    tasks
        What is done; what they return, or raise, is pickled.
    workers
        How many copies there are at most.

    Yields
    ------
    object
        What the tasks return, in their order.

    Raises
    ------
    Exception
        What the first of them raises that fails; those that have not begun are given up.

    Notes
    -----
    A copy has only the thread that made it. So where this process has several, as libraries start them, where it cannot
    be copied, or where there is one worker or one task, they are done here in turn. So is what is left when a copy
    crashes, by which this process ends as it would without copies. Only Linux tells how many threads there are.
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
    """Keep the tasks, of which a copy is sent only the numbers."""
    global _held  # noqa: PLW0603 - of a process that does nothing else
    _held = tasks


def _do(number: int) -> object:
    return _held[number]()
