"""The archive: the best distinct plans met, each with the way that led to it. Compiled."""
# ruff: noqa: C901 - an entry is written in loops over its numbers

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.compiled import Whole, compiled, compiled_inlined, compiled_inner
from garage2usd.planning.ground import Ground, Lanes

__all__ = ["Archive", "below", "keep", "new_archive", "next_random", "ranked_lanes", "uniform"]


class Archive(NamedTuple):
    """Entries in no order; `in_use[0]` of them are in use.

    Attributes
    ----------
    values
        float64, shape (size,).
    keys
        uint64, shape (size,): the lanes' hash.
    lanes
        bool, shape (size, padded): by square of the padded matrix.
    tapes
        int8, shape (size, steps): actions from the square `starts`, `lengths` of them; of an agent over aisles what
        became of each run, with the choice of direction and spine as `starts`.
    starts, lengths
        int64, shape (size,).
    in_use
        int64, shape (2,): entries in use, and the one of least value once all are.
    """

    values: NDArray[np.float64]
    keys: NDArray[np.uint64]
    lanes: NDArray[np.bool_]
    tapes: NDArray[np.int8]
    starts: NDArray[np.int64]
    lengths: NDArray[np.int64]
    in_use: NDArray[np.int64]


def new_archive(size: int, *, padded: int, steps: int) -> Archive:
    """An empty archive of plans on a padded matrix with so many squares, for ways of at most so many steps."""
    return Archive(
        np.full(size, -np.inf),
        np.zeros(size, np.uint64),
        np.zeros((size, padded), np.bool_),
        np.zeros((size, steps), np.int8),
        np.zeros(size, np.int64),
        np.zeros(size, np.int64),
        np.zeros(2, np.int64),
    )


def ranked_lanes(archive: Archive, ground: Ground) -> tuple[tuple[float, Lanes], ...]:
    """(value, lanes) of all entries, best first."""
    order = np.argsort(-archive.values[: archive.in_use[0]], kind="stable")
    return tuple((float(archive.values[entry]), archive.lanes[entry, ground.squares]) for entry in order)


@compiled_inner
def _mixed(z: np.uint64) -> np.uint64:
    """The last steps of splitmix64, in which every bit of a number comes to touch every other."""
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return np.uint64(z ^ (z >> np.uint64(31)))


@compiled
def next_random(random: NDArray[np.uint64]) -> np.uint64:
    """Draw by splitmix64: the same numbers on every machine."""
    random[0] += np.uint64(0x9E3779B97F4A7C15)
    return _mixed(random[0])


@compiled_inner
def uniform(random: NDArray[np.uint64]) -> float:
    """A number from 0 to below 1."""
    return float(next_random(random) >> np.uint64(11)) * (1.0 / 9007199254740992.0)


@compiled_inner
def below(random: NDArray[np.uint64], count: Whole) -> int:
    """A whole number from 0 to below `count`."""
    return int(uniform(random) * count)


@compiled_inner
def _square_key(square: int) -> np.uint64:
    """Hash of one square; a set of squares has the exclusive or of its members'."""
    return _mixed(np.uint64(square + 1) * np.uint64(0x9E3779B97F4A7C15))


@compiled_inlined
def keep(
    archive: Archive,
    laid: NDArray[np.int64],
    lanes: int,
    value: float,
    tape: NDArray[np.int8],
    steps: Whole,
    start: int,
) -> None:
    """Keep a plan if it is new and better than the worst kept.

    Parameters
    ----------
    archive
        Where.
    laid, lanes
        Its lanes, and how many there are.
    value
        Its value.
    tape, steps, start
        The actions that lead to it, how many there are, and from where.
    """
    count, size = archive.in_use, len(archive.values)
    full = count[0] == size
    if full and value <= archive.values[count[1]]:
        return
    key = np.uint64(0)
    for index in range(lanes):
        key ^= _square_key(laid[index])
    for index in range(count[0]):
        if archive.keys[index] == key:
            return
    place = count[1] if full else count[0]
    count[0] = min(count[0] + 1, size)
    archive.values[place], archive.keys[place] = value, key
    for q in range(archive.lanes.shape[1]):
        archive.lanes[place, q] = False
    for index in range(lanes):
        archive.lanes[place, laid[index]] = True
    archive.starts[place], archive.lengths[place] = start, steps
    for index in range(steps):
        archive.tapes[place, index] = tape[index]
    if count[0] == size:
        count[1] = 0
        for entry in range(size):
            if archive.values[entry] < archive.values[count[1]]:
                count[1] = entry
