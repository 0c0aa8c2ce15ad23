"""Runs of stalls for motorcycles: parts of other runs, as few stalls of that size fill a square."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from garage2usd.structure.stall_runs import StallRun
from garage2usd.structure.stall_shapes import StallShape

__all__ = ["split_for_motorcycles"]


def split_for_motorcycles(
    runs: Sequence[StallRun],
    shape: StallShape,
    share: float,
    rng: np.random.Generator,
    *,
    count: Callable[[StallRun], int],
    is_whole: Callable[[StallRun], bool],
) -> tuple[list[StallRun], list[StallRun]]:
    """Take squares from runs for motorcycles, from the beginning of one random run after the other.

    Parameters
    ----------
    runs
        Runs of stalls for cars.
    shape
        Shape of the stalls for motorcycles.
    share
        Wanted share of the stalls, from 0 to 1.
    rng
        Decides which runs.
    count
        Number of stalls of a run.
    is_whole
        True for a run that is taken as a whole or not at all.

    Returns
    -------
    tuple
        The runs that are left for cars, and those for motorcycles, whose share is as near as whole squares allow.
    """
    cars, motorcycles = sum(map(count, runs)), 0
    left, taken = list(runs), list[StallRun]()

    def error(more: int, fewer: int) -> float:
        stalls = cars + motorcycles + more - fewer
        return abs((motorcycles + more) / stalls - share) if stalls else share

    for index in rng.permutation(len(runs)).tolist():
        run = runs[index]
        best = error(0, 0), 0, 0, 0
        for length in (len(run.squares),) if is_whole(run) else range(1, len(run.squares) + 1):
            first, _ = _parts(run, length)
            more, fewer = count(replace(first, shape=shape)), count(first)
            best = min(best, (error(more, fewer), length, more, fewer))
        _, length, more, fewer = best
        if not length:
            if taken:
                break
            continue
        first, rest = _parts(run, length)
        taken.append(replace(first, shape=shape))
        left[left.index(run) : left.index(run) + 1] = rest
        cars, motorcycles = cars - fewer, motorcycles + more
        if rest:
            break
    return left, taken


def _parts(run: StallRun, length: int) -> tuple[StallRun, list[StallRun]]:
    """Return the first squares of a run and, if there are more, the run of the others."""
    squares = run.squares
    rest = [replace(run, first=squares[length])] if length < len(squares) else []
    return replace(run, last=squares[length - 1]), rest
