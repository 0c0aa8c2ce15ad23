"""Annealing of large plans that circulate: every rule is judged around a move, by labels of the lanes.

In C, `label_annealing.c`, `labels.c` and `moves.c`.
"""

import numpy as np

from garage2usd.native import Float64s, UInt64s, in_c
from garage2usd.planning.board import Board
from garage2usd.planning.draft import Draft
from garage2usd.planning.ground import Ground
from garage2usd.planning.polish import Room
from garage2usd.planning.sizes import Sizes

__all__ = ["anneal_labels"]


def anneal_labels(
    ground: Ground,
    board: Board,
    draft: Draft,
    sizes: Sizes,
    room: Room,
    random: UInt64s,
    trials: int,
    heats: tuple[float, float],
    prices: tuple[float, float, float, float],
    refresh: int,
) -> float:
    """Anneal the feasible lanes in `board.cells` under the rules; leaves the best that keeps them, returns its value.

    Parameters
    ----------
    ground, board, draft, sizes, room
        The site, its lanes, room for labels, the sides of the squares, and room for the best plan room.
    random
        State of the random numbers.
    trials
        Moves to try, and some more where rules are broken still.
    heats
        Temperature at first and at last, in stalls.
    prices
        What a fault costs at first and at last, and a square that a stretch is too long, in stalls.
    refresh
        Trials between two measurements of the whole.

    Notes
    -----
    Each lane is labelled as driven through or as so many squares deep in a dead end; where every lane has what its
    label asks for around it, pruning ends within the rounds of R1. So R1 and R3 are judged around a move, R4 along
    the stretches that it touches. A move that seems worth it by what is around it is measured whole before it is made,
    as it may lead cars another way far around: stalls, T_S and floor are exact.
    """
    return _anneal_labels(
        ground, board, draft, sizes, room, random, trials, np.array(heats, np.float64), np.array(prices, np.float64),
        refresh,
    )  # fmt: skip


@in_c
def _anneal_labels(
    ground: Ground,
    board: Board,
    draft: Draft,
    sizes: Sizes,
    room: Room,
    random: UInt64s,
    trials: int,
    heats: Float64s,
    prices: Float64s,
    refresh: int,
) -> float:
    """`anneal_labels`."""
    raise NotImplementedError
