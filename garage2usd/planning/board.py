"""A board of lanes: its score, and the repair of lanes that are not joined. In C, `board.c` and `repair.c`."""

from typing import NamedTuple

import numpy as np

from garage2usd.native import Int8s, Int32s, Int64s, in_c
from garage2usd.planning.ground import Ground, Lanes
from garage2usd.structure.grid import Cell

__all__ = [
    "FAR",
    "FAULTS",
    "NO_VALUE",
    "Board",
    "connect",
    "faults_of",
    "lanes_on",
    "measure",
    "new_board",
    "put_lanes",
    "value_now",
]

FAR = 1 << 28
NO_VALUE = -1.0e9

FAULTS = 5
"""Index in `Board.tally` of the number of violations of the rules of circulation."""


class Board(NamedTuple):
    """Lanes laid so far; arrays by square of the padded matrix.

    Attributes
    ----------
    cells
        int8: the structure matrix.
    edges
        int8: edges of the square open to lanes, as in `Ground.capacity`.
    hops
        int32: squares driven from the nearest entrance to a lane.
    near
        int32: least `hops` of the lanes beside a free square, 0 at a portal that touches a lane; `mark_network` takes
        it for marks.
    state
        int32: what `survey` last told of each lane.
    queue
        int64: room for breadth-first searches.
    tally
        int64, shape (6,): stalls N_S, sum over stalls of (1 + hops), free squares without stalls U_S, portals that
        touch no lane, lanes, and how often `faults_cost` last found a rule of circulation broken, `FAR` for
        infeasible lanes.
    """

    cells: Int8s
    edges: Int8s
    hops: Int32s
    near: Int32s
    state: Int32s
    queue: Int64s
    tally: Int64s


def new_board(ground: Ground) -> Board:
    """Allocate a board; `clear` it before use."""
    size = len(ground.cells)
    return Board(
        ground.cells.copy(),
        np.zeros(size, np.int8),
        np.zeros(size, np.int32),
        np.zeros(size, np.int32),
        np.zeros(size, np.int32),
        np.zeros(size, np.int64),
        np.zeros(6, np.int64),
    )


@in_c
def value_now(ground: Ground, board: Board) -> float:
    """Score y' by the tally of the board, whether or not all portals are touched."""
    raise NotImplementedError


@in_c
def measure(ground: Ground, board: Board, enough: float) -> float:
    """Measure y' less the cost of faults of the lanes in `board.cells`, NO_VALUE if infeasible; sets hops and tally.

    A score below `enough` is returned without the cost of faults.

    Feasible: every portal touches a lane and the lanes form one network that does not pass through portals.
    """
    raise NotImplementedError


def faults_of(ground: Ground, board: Board, lanes: Lanes) -> int:
    """Count the faults of lanes against the rules of circulation."""
    put_lanes(ground, board, lanes)
    measure(ground, board, -np.inf)
    return int(board.tally[FAULTS])


def lanes_on(ground: Ground, board: Board) -> Lanes:
    """Read the lanes off the board."""
    lanes: Lanes = board.cells[ground.squares] == Cell.LANE
    return lanes


def put_lanes(ground: Ground, board: Board, lanes: Lanes) -> None:
    """Replace the lanes on the board; the tally is not updated."""
    board.cells[:] = ground.cells
    board.cells[ground.squares[lanes]] = Cell.LANE


def connect(ground: Ground, board: Board) -> bool:
    """Connect all lanes and portals by shortest paths over free squares; False if there are none.

    The network grows from the first portal by the shortest path to the nearest piece (Takahashi and Matsuyama 1980).
    Unreachable lanes are removed.
    """
    return _connect_lanes(ground, board)


@in_c
def _connect_lanes(ground: Ground, board: Board) -> bool:
    """`connect`, a name that the C library has taken."""
    raise NotImplementedError
