"""Work on many processes by Dask: on this machine, or on a cluster that is there."""

import logging
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from itertools import islice
from typing import Any, TypeVar

import dask
import dask.system
from distributed import Client, KilledWorker, LocalCluster, as_completed

from garage2usd.common.errors import ConfigError, DataSetError, Garage2UsdError
from garage2usd.common.limits import ONE_THREAD
from garage2usd.common.version import VERSION

__all__ = ["Workers", "workers"]

Task = TypeVar("Task")
Outcome = TypeVar("Outcome")

_TRIES = 10
"""How often a task is given anew that was given up as its workers were lost, which Dask does when four were."""
_AT_ONCE = 4
"""How many tasks a core is given ahead, so that none waits and what they return is taken up as it comes."""
_LEAST_CORES = 4
"""For how many tasks are given ahead while workers still start."""
_START_S = 180
"""A worker takes a few seconds to start, on a machine that is very busy a minute."""
_CONNECT_S = 10.0


class Workers:
    """Processes that work on tasks.

    Parameters
    ----------
    client
        Their scheduler's.
    """

    def __init__(self, client: Client) -> None:
        self._client = client

    def each(
        self, function: Callable[..., Outcome], tasks: Sequence[Task], *shared: object
    ) -> Iterator[tuple[Task, Outcome]]:
        """Work on tasks.

        Parameters
        ----------
        function
            Takes the shared values and a task; a function that any process can import, which gives the same for a task
            each time, as a task whose worker is lost is done again.
        tasks
            The tasks.
        shared
            What the function takes before the task; small, as it is sent with each.

        Yields
        ------
        tuple
            A task and what the function gave for it, in the order in which they are done.

        Raises
        ------
        Exception
            The first that the function raises, or `DataSetError` for a task that crashes every worker; what was begun
            is given up.
        """
        if not tasks:
            return
        client = self._client
        left = iter(range(len(tasks)))
        running: dict[Any, int] = {}  # futures, whose type says nothing of what they hold
        lost: Counter[int] = Counter()
        done = as_completed([], with_results=False)

        def start(number: int) -> None:
            future = client.submit(_run, function, *shared, tasks[number], pure=False, retries=0)
            running[future] = number
            done.add(future)

        for number in islice(left, _AT_ONCE * max(sum(client.nthreads().values()), _LEAST_CORES)):
            start(number)
        try:
            for future in done:
                number = running.pop(future)
                try:
                    outcome, error = future.result()
                except KilledWorker:
                    lost[number] += 1
                    if lost[number] >= _TRIES:
                        raise DataSetError(function.__name__, f"lost its workers {_TRIES} times over") from None
                    start(number)
                    continue
                if error is not None:
                    raise error
                for following in islice(left, 1):
                    start(following)
                yield tasks[number], outcome
        finally:
            client.cancel(list(running))


@contextmanager
def workers(*, count: int | None = None, scheduler: str | None = None) -> Iterator[Workers]:
    """Workers on this machine, or those of a scheduler.

    Parameters
    ----------
    count
        How many processes, where they are started here; left out, one a core.
    scheduler
        Address of the scheduler of a cluster (``tcp://host:8786``), whose workers have the same version of garage2usd
        and see the same files.

    Raises
    ------
    ConfigError
        If there is no such scheduler, or its workers have another version.
    DataSetError
        If no worker starts here.
    """
    if scheduler is not None:
        with _connected(scheduler) as client:
            yield Workers(client)
        return
    settings = {
        "distributed.worker.daemon": True,
        # a worker of ours needs a gigabyte for 20 x 30 squares; without limits none is stopped for what others take
        "distributed.worker.memory.terminate": False,
        "distributed.worker.memory.pause": False,
        # what Dask measures for a dashboard, up to a hundred times a second in each process
        "distributed.worker.profile.enabled": False,
        "distributed.admin.system-monitor.interval": "10s",
        "distributed.admin.tick.interval": "1s",
        "distributed.nanny.pre-spawn-environ": dask.config.get("distributed.nanny.pre-spawn-environ") | ONE_THREAD,
    }
    with (
        dask.config.set(settings),
        LocalCluster(
            n_workers=0,
            threads_per_worker=1,
            processes=True,
            dashboard_address=":0",  # any port that is free, as other clusters may run here
            scheduler_kwargs={"dashboard": False},
            silence_logs=logging.CRITICAL,
        ) as cluster,
        Client(cluster) as client,
    ):
        wanted = count or dask.system.CPU_COUNT
        cluster.scale(wanted)
        # which also replaces workers that are lost while they start, but looks for the first time after a second
        cluster.adapt(minimum=wanted, maximum=wanted)
        try:
            client.wait_for_workers(1, timeout=_START_S)
        except TimeoutError:
            reason = f'none started in {_START_S} s; a script has to start them below `if __name__ == "__main__":`'
            raise DataSetError("workers", reason) from None
        yield Workers(client)


@contextmanager
def _connected(scheduler: str) -> Iterator[Client]:
    try:
        client = Client(scheduler, timeout=_CONNECT_S)
    except (OSError, ValueError, TimeoutError) as error:
        allowed = "the address of a Dask scheduler that can be reached, such as tcp://host:8786"
        raise ConfigError("scheduler", scheduler, f"{allowed} ({error})") from None
    with client:
        try:
            versions = client.run(_version)
        except ModuleNotFoundError:
            raise ConfigError("scheduler", scheduler, f"workers that have garage2usd {VERSION}") from None
        others = sorted({version for version in versions.values() if version != VERSION})
        if others:
            raise ConfigError("scheduler", scheduler, f"workers with garage2usd {VERSION}, and not {', '.join(others)}")
        yield client


def _run(function: Callable[..., Outcome], *arguments: object) -> tuple[Outcome | None, Garage2UsdError | None]:
    """What a function gives, or the error of ours that it raises, without the worker's stack."""
    try:
        return function(*arguments), None
    except Garage2UsdError as error:
        return None, error.with_traceback(None)


def _version() -> str:
    return VERSION
