"""Archive of the best distinct plans, each with its episode. In C, `archive.c`."""

from typing import NamedTuple

import numpy as np

from garage2usd.native import BoolTable, Float64s, Int8Table, Int64s, UInt64s, in_c
from garage2usd.planning.ground import Ground, Lanes

__all__ = ["Archive", "new_archive", "next_random", "ranked_lanes"]


class Archive(NamedTuple):
    """Archived plans in no order; the first `in_use[0]` entries are in use.

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

    values: Float64s
    keys: UInt64s
    lanes: BoolTable
    tapes: Int8Table
    starts: Int64s
    lengths: Int64s
    in_use: Int64s


def new_archive(size: int, *, padded: int, steps: int) -> Archive:
    """Allocate an archive of plans on a padded matrix, for tapes of at most so many steps."""
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
    """List (value, lanes) of all entries, best first."""
    order = np.argsort(-archive.values[: archive.in_use[0]], kind="stable")
    return tuple((float(archive.values[entry]), archive.lanes[entry, ground.squares]) for entry in order)


@in_c
def next_random(random: UInt64s) -> np.uint64:
    """Draw by splitmix64 (Steele, Lea and Flood 2014): the same numbers on every machine."""
    raise NotImplementedError
