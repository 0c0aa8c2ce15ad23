"""The survey of circulation on lanes: pruning of dead ends, loops, blocks, stretches. In C, `survey.c`."""

from typing import NamedTuple

import numpy as np

from garage2usd.native import Int8s, Int32s, Int64s, in_c

__all__ = ["STRETCH", "Survey", "survey"]

STRETCH = 4
"""States above it are stretches: so much more than the squares that they have."""


class Survey(NamedTuple):
    """Figures of the lanes of a site.

    Attributes
    ----------
    deep
        Lanes that pruning takes off after the allowed rounds (R1).
    loops
        Independent circuits of lanes that form one piece, ``E - V + 1``, less the blocks (R2).
    blocks
        Blocks of two by two lanes (R3).
    excess
        Squares by which stretches without a junction exceed the allowed length, summed (R4).
    """

    deep: int
    loops: int
    blocks: int
    excess: int


def survey(
    squares: Int64s,
    stride: int,
    cells: Int8s,
    state: Int32s,
    dead_end_squares: int,
    stretch_squares: int,
) -> Survey:
    """Count where lanes break the rules of circulation.

    Parameters
    ----------
    squares
        int64: the squares that may be lanes.
    stride
        Step from a square to the one below.
    cells
        int8: the padded structure matrix.
    state
        int32, shape of `cells`, set on all lanes: minus the round in which a dead end is pruned; the number of
        neighbours of a junction, 3 or 4; or `STRETCH` and the squares of the stretch that the lane belongs to.
    dead_end_squares
        R1: rounds of pruning that are free.
    stretch_squares
        R4: squares of a stretch that are free; below 1 stretches are not looked at.

    Notes
    -----
    A round of pruning takes off all lanes with at most one neighbour, portals being neighbours that stay (k-core
    decomposition, Seidman 1983, for k = 2 with the portals held). Without stretches, those lanes keep the state 2.
    """
    queue, found = np.empty(len(cells), np.int64), np.zeros(4, np.int64)
    _survey(squares, len(squares), stride, cells, state, queue, dead_end_squares, stretch_squares, found)
    return Survey(*found.tolist())


@in_c
def _survey(
    squares: Int64s,
    count: int,
    stride: int,
    cells: Int8s,
    state: Int32s,
    queue: Int64s,
    dead_end_squares: int,
    stretch_squares: int,
    found: Int64s,
) -> None:
    """`survey` of the first `count` squares, with room for as many in `queue`; `found` takes the figures."""
    raise NotImplementedError
