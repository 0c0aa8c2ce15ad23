"""Tabular Sarsa over squares: an agent drives over the site and colours lanes. In C, `sarsa.c`.

`garage2usd.planning.reference_sarsa` is the same in plain Python.
"""

from typing import NamedTuple

import numpy as np

from garage2usd.config.plan import SarsaParameters
from garage2usd.native import Bools, Float32Table, Float64s, Int8s, Int64s, UInt64s, in_c
from garage2usd.planning.board import Archive, Board, Ground

STAY = 4
ACTIONS = 5
"""Up, down, left, right, stay; the first four as `garage2usd.structure.grid.NEIGHBOUR_STEPS`."""


class Memory(NamedTuple):
    """Hash table of Sarsa from states to the values of the five actions.

    Attributes
    ----------
    keys
        uint64, shape (2^k,): hash of the state, 0 where unused.
    q
        float32, shape (2^k, 5).
    used
        int64, shape (1,): rows in use.
    course
        float64, shape (2,): epsilon, and episodes that ended in the same plan.
    last
        uint64, shape (1,): hash of the last episode's plan.
    """

    keys: UInt64s
    q: Float32Table
    used: Int64s
    course: Float64s
    last: UInt64s


def new_memory(parameters: SarsaParameters, *, bits: int) -> Memory:
    """Allocate an empty table."""
    return Memory(
        np.zeros(1 << bits, np.uint64),
        np.zeros((1 << bits, ACTIONS), np.float32),
        np.zeros(1, np.int64),
        np.array([parameters.epsilon_start, 0.0]),
        np.zeros(1, np.uint64),
    )


class Room(NamedTuple):
    """Workspace of an episode.

    Attributes
    ----------
    moves
        int64, shape (5,): the step of each action, from a square to the next.
    allowed
        bool, shape (5,): actions that the mask allows.
    tape
        int8: the actions so far.
    laid
        int64: the lanes laid so far.
    """

    moves: Int64s
    allowed: Bools
    tape: Int8s
    laid: Int64s


def new_room(ground: Ground, archive: Archive) -> Room:
    """Allocate the workspace of episodes as long as the tapes of an archive."""
    stride = ground.stride
    return Room(
        np.array([-stride, stride, -1, 1, 0]),
        np.ones(ACTIONS, np.bool_),
        np.zeros(archive.tapes.shape[1], np.int8),
        np.zeros(len(ground.squares), np.int64),
    )


def grown(memory: Memory) -> Memory:
    """Copy a table into one of twice the size."""
    size = 2 * len(memory.keys)
    larger = memory._replace(keys=np.zeros(size, np.uint64), q=np.zeros((size, ACTIONS), memory.q.dtype))
    memory.used[0] = 0
    _carry_over(memory, larger)
    return larger


@in_c
def _carry_over(memory: Memory, larger: Memory) -> None:
    """Copy all entries of a table into an empty one."""
    raise NotImplementedError


@in_c
def observe(ground: Ground, board: Board, parameters: SarsaParameters, square: int, previous: int) -> np.uint64:
    """Hash of the state S_t = (D, M, A_{t-1})."""
    raise NotImplementedError


@in_c
def learn(
    ground: Ground,
    board: Board,
    parameters: SarsaParameters,
    memory: Memory,
    archive: Archive,
    room: Room,
    random: UInt64s,
    curve: Float64s,
    first: int,
    last: int,
    taken: Int64s,
) -> int:
    """Run the episodes from `first` to below `last`, or fewer when the table fills up.

    Returns
    -------
    int
        The first episode that was not run.

    Notes
    -----
    ``q(S_t, A_t) += alpha (R_{t+1} + gamma q(S_{t+1}, A_{t+1}) - q(S_t, A_t))``. `curve` takes the paper's
    ``E = sum_{t=1}^{T-1} R_t`` of each episode, without the R_T of a failure. The number of actions that were taken is
    added to `taken`, shape (1,).
    """
    raise NotImplementedError
