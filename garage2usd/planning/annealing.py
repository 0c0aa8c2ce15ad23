"""Hill climbing and simulated annealing of lanes, by flips or by labelled moves.

In C: `annealing.c` and `flips.c`; `flip_annealing.c`; `label_annealing.c`, `trial_move.c`, `labels.c` and `moves.c`.
"""

from typing import NamedTuple

import numpy as np

from garage2usd.native import Float64s, Int8s, Int32s, Int64s, UInt64s, in_c
from garage2usd.planning.board import Board
from garage2usd.planning.dimensions import Sizes
from garage2usd.planning.ground import Ground

__all__ = [
    "TrialMove",
    "Workspace",
    "anneal_flips",
    "anneal_labels",
    "improve",
    "new_trial_move",
    "new_workspace",
]

_MOVED = 400
"""Room for the squares of one move; what needs more is not a move."""


class Workspace(NamedTuple):
    """Room to polish plans.

    Attributes
    ----------
    cells
        int8, as in `Board.cells`: the best lanes met.
    kept_mm
        int64, as in `Sizes.kept_mm`: the sides of the best plan met.
    order
        int64: the free squares, in the order of a pass over them.
    known, hops
        int64, shape (3,), and int32, by square: what `Board.tally` and `Board.hops` have of the lanes that the next
        flip changes.
    """

    cells: Int8s
    kept_mm: Int64s
    order: Int64s
    known: Int64s
    hops: Int32s


def new_workspace(ground: Ground, sizes: Sizes) -> Workspace:
    """Room for the plans of a ground."""
    return Workspace(
        ground.cells.copy(),
        sizes.kept_mm.copy(),
        ground.squares.copy(),
        np.zeros(3, np.int64),
        np.zeros(len(ground.cells), np.int32),
    )


@in_c
def improve(
    ground: Ground,
    board: Board,
    sizes: Sizes,
    room: Workspace,
    random: UInt64s,
    passes: int,
    flips: int,
    hottest: float,
    coldest: float,
) -> float:
    """Improve the feasible lanes in `board.cells`; leaves the best met there and returns its value.

    First every line along which no car drives gets the side that pays best.

    Parameters
    ----------
    ground, board, sizes, room, random
        The site, its lanes, the sides of its squares, room for plans, and the state of the random numbers.
    passes
        Of hill climbing, by flips of one square or of two side by side; it ends where none improves.
    flips
        Of annealing, which follows. Lines along which no car drives take other sides now and then, where sides are
        chosen. Plans that break fewer rules of circulation are better than others, whatever their value.
    hottest, coldest
        Temperature of annealing at first and at last, in stalls.
    """
    raise NotImplementedError


@in_c
def anneal_flips(
    ground: Ground,
    board: Board,
    best_cells: Int8s,
    random: UInt64s,
    flips: int,
    hottest: float,
    coldest: float,
    refresh: int,
) -> float:
    """Anneal the feasible lanes in `board.cells`; leaves the best measured there and returns its value.

    `best_cells` is room for as many.

    Notes
    -----
    N_S and U_S change exactly; T_S is followed by the distances as of the last measurement, one every `refresh`
    flips, by which alone the best is chosen. A flip that may part the lanes is measured whole, as long as such
    measurements take no more than a share of the time.
    """
    raise NotImplementedError


class TrialMove(NamedTuple):
    """Labels of the lanes on a board, and room to judge moves.

    Attributes
    ----------
    label
        int8, by square: 0 no lane, 1 a lane that cars drive on through, d + 1 a lane d squares deep in a dead end.
    stamp
        int64, shape (3, padded): marks of squares met, of blocks met, and of searches.
    marks
        int64, shape (3,): the marks last used.
    moved, around, queue
        int64: squares of a move, squares that it may touch, room for searches.
    faulty
        int64: the squares around which rules were broken at the last measurement.
    fresh, old
        int8: labels after and before the move.
    old_hops
        int32: hops of the moved squares before it.
    cells, hops
        int8 and int32, by square: cells before the dead ends are trimmed, and hops of the lanes before a move.
    lines
        int64, shape (K, 2): axis and number of the lines that get another side by a move.
    size
        int64, shape (4,): how many squares are moved, how many are around, how many lines get another side, and how
        many squares are faulty.
    lengths
        int64, shape (2,): squares of a path on either side of where it is met.
    tally
        int64, shape (6,): stalls, time, unused squares, faults of labels, blocks, squares too long.
    change
        int64, shape (6,): what a move adds to them.
    """

    label: Int8s
    stamp: Int64s
    marks: Int64s
    moved: Int64s
    around: Int64s
    queue: Int64s
    faulty: Int64s
    fresh: Int8s
    old: Int8s
    old_hops: Int32s
    cells: Int8s
    hops: Int32s
    lines: Int64s
    size: Int64s
    lengths: Int64s
    tally: Int64s
    change: Int64s


def new_trial_move(ground: Ground) -> TrialMove:
    """Room for labels on a ground."""
    size = len(ground.cells)
    return TrialMove(
        np.zeros(size, np.int8),
        np.zeros((3, size), np.int64),
        np.zeros(3, np.int64),
        np.zeros(_MOVED, np.int64),
        np.zeros(5 * _MOVED, np.int64),
        np.zeros(size, np.int64),
        np.zeros(size, np.int64),
        np.zeros(_MOVED, np.int8),
        np.zeros(_MOVED, np.int8),
        np.zeros(_MOVED, np.int32),
        np.zeros(size, np.int8),
        np.zeros(size, np.int32),
        np.zeros((10 * _MOVED, 2), np.int64),
        np.zeros(4, np.int64),
        np.zeros(2, np.int64),
        np.zeros(6, np.int64),
        np.zeros(6, np.int64),
    )


def anneal_labels(
    ground: Ground,
    board: Board,
    move: TrialMove,
    sizes: Sizes,
    room: Workspace,
    random: UInt64s,
    trials: int,
    heats: tuple[float, float],
    prices: tuple[float, float, float, float],
    refresh: int,
) -> float:
    """Anneal the feasible lanes in `board.cells` under the rules; leaves the best that keeps them, returns its value.

    Parameters
    ----------
    ground, board, move, sizes, room
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
        ground, board, move, sizes, room, random, trials, np.array(heats, np.float64), np.array(prices, np.float64),
        refresh,
    )  # fmt: skip


@in_c
def _anneal_labels(
    ground: Ground,
    board: Board,
    move: TrialMove,
    sizes: Sizes,
    room: Workspace,
    random: UInt64s,
    trials: int,
    heats: Float64s,
    prices: Float64s,
    refresh: int,
) -> float:
    """`anneal_labels`."""
    raise NotImplementedError
