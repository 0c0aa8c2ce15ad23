"""The archive: the best distinct plans met, each with the way that led to it. Compiled."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.compiled import Whole, compiled, compiled_inner, copy_row
from garage2usd.planning.ground import Ground

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
        bool, shape (size, squares).
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


def new_archive(size: int, *, squares: int, steps: int) -> Archive:
    """An empty archive."""
    return Archive(
        np.full(size, -np.inf),
        np.zeros(size, np.uint64),
        np.zeros((size, squares), np.bool_),
        np.zeros((size, steps), np.int8),
        np.zeros(size, np.int64),
        np.zeros(size, np.int64),
        np.zeros(2, np.int64),
    )


def ranked_lanes(archive: Archive) -> tuple[tuple[float, NDArray[np.bool_]], ...]:
    """(value, lanes) of all entries, best first."""
    order = np.argsort(-archive.values[: archive.in_use[0]], kind="stable")
    return tuple((float(archive.values[entry]), archive.lanes[entry]) for entry in order)


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


@compiled_inner
def keep(
    ground: Ground, archive: Archive, laid: NDArray[np.int64], value: float, tape: NDArray[np.int8], start: int
) -> None:
    """Keep a plan if it is new and better than the worst kept.

    Parameters
    ----------
    ground, archive
        Where.
    laid
        Its lanes.
    value
        Its value.
    tape, start
        The actions that lead to it, and from where.
    """
    count, size = archive.in_use, len(archive.values)
    full = count[0] == size
    if full and value <= archive.values[count[1]]:
        return
    key = np.uint64(0)
    for q in laid:
        key ^= _square_key(q)
    for index in range(count[0]):
        if archive.keys[index] == key:
            return
    place = count[1] if full else count[0]
    count[0] = min(count[0] + 1, size)
    archive.values[place], archive.keys[place] = value, key
    archive.lanes[place] = False
    for q in laid:
        archive.lanes[place, np.searchsorted(ground.squares, q)] = True
    archive.starts[place], archive.lengths[place] = start, len(tape)
    copy_row(archive.tapes[place], tape)
    if count[0] == size:
        count[1] = np.argmin(archive.values)
