"""Parallel work by Dask, on this machine or on an existing cluster."""

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
from garage2usd.common.package import VERSION

Task = TypeVar("Task")
Outcome = TypeVar("Outcome")

_TRIES = 10
"""Number of retries of a task that Dask gave up after it had lost four workers."""
_AT_ONCE = 4
"""Number of tasks queued per core."""
_LEAST_CORES = 4
"""Least number of cores for which tasks are queued while workers start."""
_START_S = 180
"""Timeout in seconds for workers to start: some seconds usually, a minute on a busy machine."""
_CONNECT_S = 10.0


class Workers:
    """Dask worker processes that run tasks.

    Parameters
    ----------
    client
        Client of the workers' scheduler.
    """

    def __init__(self, client: Client) -> None:
        self._client = client

    def each(
        self, function: Callable[..., Outcome], tasks: Sequence[Task], *shared: object
    ) -> Iterator[tuple[Task, Outcome]]:
        """Run a function on each task, and yield results as they finish.

        Parameters
        ----------
        function
            Function of the shared values and a task, importable by any process and deterministic, since the task of a
            lost worker is repeated.
        tasks
            The tasks.
        shared
            Leading arguments of the function; small, since they are sent with each task.

        Yields
        ------
        tuple
            A task and its result, in order of completion.

        Raises
        ------
        Exception
            The first exception of the function, or `DataSetError` for a task that crashes every worker; pending tasks
            are cancelled.
        """
        if not tasks:
            return
        client = self._client
        left = iter(range(len(tasks)))
        running: dict[Any, int] = {}  # futures are not generic in the type of their result
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
    """Start Dask workers on this machine, or connect to those of a scheduler.

    Parameters
    ----------
    count
        Number of local processes; one per core if left out.
    scheduler
        Address of the scheduler of a cluster (``tcp://host:8786``), whose workers have the same version of garage2usd
        and see the same files.

    Raises
    ------
    ConfigError
        If the scheduler is unreachable, or its workers have another version.
    DataSetError
        If no local worker starts.
    """
    if scheduler is not None:
        with _connected(scheduler) as client:
            yield Workers(client)
        return
    settings = {
        "distributed.worker.daemon": True,
        # no memory limit: a worker needs 1 GB for 20 x 30 squares, and must not be stopped because others use memory
        "distributed.worker.memory.terminate": False,
        "distributed.worker.memory.pause": False,
        # intervals of Dask's measurements for its dashboard, up to a hundred per second in each process
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
        # also replaces workers that are lost while they start; its first look is after a second
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
    """Call a function and return its result or its Garage2UsdError, without the worker's stack."""
    try:
        return function(*arguments), None
    except Garage2UsdError as error:
        return None, error.with_traceback(None)


def _version() -> str:
    return VERSION
