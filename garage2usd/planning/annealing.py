"""Hill climbing and simulated annealing of lanes, by flips or by labelled moves.

In C: `annealing.c` and `flips.c`; `flip_annealing.c`; `label_annealing.c`, `trial_move.c`, `labels.c` and `moves.c`.
"""

from typing import NamedTuple

import numpy as np

from garage2usd.native import Float64s, Int8s, Int32s, Int64s, Int64Table, UInt64s, in_c
from garage2usd.planning.board import Board, Ground
from garage2usd.planning.dimensions import Sizes

_MOVED = 400
"""Most squares of one move."""


class Workspace(NamedTuple):
    """Workspace of hill climbing and annealing.

    Attributes
    ----------
    cells
        int8, as in `Board.cells`: the best lanes so far.
    kept_mm
        int64, as in `Sizes.kept_mm`: the sides of the best plan so far.
    order
        int64: the free squares, in the order of a pass over them.
    known, hops
        int64, shape (3,), and int32, by square: `Board.tally` and `Board.hops` before the next flip.
    """

    cells: Int8s
    kept_mm: Int64Table
    order: Int64s
    known: Int64s
    hops: Int32s


def new_workspace(ground: Ground, sizes: Sizes) -> Workspace:
    """Allocate the workspace of a ground."""
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
    """Improve the feasible lanes in `board.cells` by flips, each judged by the whole plan; return the best value.

    The best lanes are left in `board.cells`. At first, every line without traffic gets the side with the best value.

    Parameters
    ----------
    ground, board, sizes, room, random
        The site, its lanes, the sides of its squares, the workspace, and the state of the random numbers.
    passes
        Greatest number of passes of hill climbing, by flips of one square or two adjacent ones; it ends at an optimum.
    flips
        Flips of simulated annealing, which follows hill climbing. If sides are chosen, some moves change the side of a
        line without traffic. Plans with fewer faults are better, whatever their value.
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
    """Anneal the feasible lanes in `board.cells` by flips, each judged by the squares around it; return the best value.

    The best lanes are left in `board.cells`; `best_cells` is workspace of the same shape.

    Notes
    -----
    N_S and U_S are exact; T_S is estimated by the distances of the last measurement. The whole plan is measured every
    `refresh` flips, and the best plan is chosen among those measurements. A flip that may split the lanes is measured
    whole, within a share of the time.
    """
    raise NotImplementedError


class TrialMove(NamedTuple):
    """Labels of the lanes on a board, and a trial move that is judged before it is made.

    Attributes
    ----------
    label
        int8, by square: 0 no lane, 1 a lane that cars drive on through, d + 1 a lane d squares deep in a dead end.
    stamp
        int64, shape (3, padded): marks of visited squares, of visited blocks, and of searches.
    marks
        int64, shape (3,): the last marks in use.
    moved, around, queue
        int64: squares of the move, squares around it, queue of searches.
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
        int64, shape (6,): change of these figures by a move.
    """

    label: Int8s
    stamp: Int64Table
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
    lines: Int64Table
    size: Int64s
    lengths: Int64s
    tally: Int64s
    change: Int64s


def new_trial_move(ground: Ground) -> TrialMove:
    """Allocate the labels of a ground."""
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


@in_c
def anneal_labels(
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
    """Anneal the feasible lanes in `board.cells` under the rules by labelled moves; return the best value.

    Parameters
    ----------
    ground, board, move, sizes, room
        The site, its lanes, their labels, the sides of the squares, and the workspace.
    random
        State of the random numbers.
    trials
        Moves to try, and some more where rules are still broken.
    heats
        float64, shape (2,): temperature at first and at last, in stalls.
    prices
        float64, shape (4,): prices of a fault at first and at last, then of a square of excess stretch, in stalls.
    refresh
        Trials between two measurements of the whole.

    Notes
    -----
    Each lane is labelled as driven through or by its depth in a dead end. Where the neighbours of every lane agree with
    its label, pruning ends within the rounds of R1 (a proof labelling scheme, Korman, Kutten and Peleg 2005). So R1
    and R3 are judged around a move, R4 along the stretches that it touches. A promising move is measured whole before
    it is made, as it may redirect traffic far away: stalls, T_S and floor are exact.
    """
    raise NotImplementedError
