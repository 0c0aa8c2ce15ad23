"""The survey of circulation on lanes: pruning of dead ends, loops, blocks, stretches. Compiled."""
# ruff: noqa: C901, PLR0912 - pruning and flooding are loops over the same squares, kept in one for speed

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.compiled import Whole, compiled

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


@compiled
def survey(
    squares: NDArray[np.int64],
    stride: int,
    cells: NDArray[np.int8],
    state: NDArray[np.int32],
    queue: NDArray[np.int64],
    dead_end_squares: int,
    stretch_squares: Whole,
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
    queue
        int64: room for as many squares.
    dead_end_squares
        R1: rounds of pruning that are free.
    stretch_squares
        R4: squares of a stretch that are free; below 1 stretches are not looked at.

    Notes
    -----
    A round of pruning takes off all lanes with at most one neighbour, portals being neighbours that stay (k-core
    decomposition, Seidman 1983, for k = 2 with the portals held). Without stretches, those lanes keep the state 2.
    """
    steps = (-stride, stride, -1, 1)
    lanes = edges = blocks = tail = 0
    for q in squares:
        if cells[q] != 1:
            continue
        lanes += 1
        right, below = cells[q + 1] == 1, cells[q + stride] == 1
        edges += right + below
        blocks += right and below and cells[q + stride + 1] == 1
        count = 0
        for step in steps:
            count += cells[q + step] >= 1
        state[q] = count
        if count < 2:  # noqa: PLR2004 - neighbours
            queue[tail] = q
            tail += 1
    head = rounds = deep = 0
    while head < tail:
        rounds += 1
        last = tail
        while head < last:
            q = queue[head]
            head += 1
            state[q] = -rounds
            deep += rounds > dead_end_squares
            for step in steps:
                p = q + step
                if cells[p] == 1 and state[p] > 1:
                    state[p] -= 1
                    if state[p] == 1:
                        queue[tail] = p
                        tail += 1
    excess = 0
    if stretch_squares > 0:
        for first in squares:
            if cells[first] != 1 or state[first] != 2:  # noqa: PLR2004
                continue
            queue[0], state[first] = first, STRETCH
            head, tail = 0, 1
            while head < tail:
                q = queue[head]
                head += 1
                for step in steps:
                    p = q + step
                    if cells[p] == 1 and state[p] == 2:  # noqa: PLR2004
                        state[p] = STRETCH
                        queue[tail] = p
                        tail += 1
            for index in range(tail):
                state[queue[index]] = STRETCH + tail
            excess += int(max(0, tail - stretch_squares))
    return Survey(deep, edges - lanes + 1 - blocks, blocks, excess)
