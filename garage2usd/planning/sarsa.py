"""Episodes of tabular Sarsa: an agent drives over the site and colours lanes. Compiled."""
# Over 300 lines: Numba caches by file, and an edited callee in another one leaves its callers stale.
# ruff: noqa: C901, PLR0912, PLR0915, PLR1714 - an episode is one loop; calls that share its state halve the speed

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.compiled import Whole, compiled, compiled_inlined, compiled_inner
from garage2usd.config.plan import SarsaParameters
from garage2usd.planning.archive import Archive, keep, next_random, uniform
from garage2usd.planning.board import NO_VALUE, Board, clear, faults_cost, lay, value_now
from garage2usd.planning.ground import Ground

__all__ = ["ACTIONS", "STAY", "Memory", "Room", "grown", "learn", "new_memory", "new_room", "observe"]

STAY = 4
ACTIONS = 5
"""Up, down, left, right, stay; the first four as `garage2usd.structure.grid.NEIGHBOUR_STEPS`."""

_UNTOUCHED = 3


class Memory(NamedTuple):
    """What Sarsa has learnt: a hash table from state to the values of the five actions.

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

    keys: NDArray[np.uint64]
    q: NDArray[np.float32]
    used: NDArray[np.int64]
    course: NDArray[np.float64]
    last: NDArray[np.uint64]


def new_memory(parameters: SarsaParameters, *, bits: int) -> Memory:
    """Nothing learnt yet."""
    return Memory(
        np.zeros(1 << bits, np.uint64),
        np.zeros((1 << bits, ACTIONS), np.float32),
        np.zeros(1, np.int64),
        np.array([parameters.epsilon_start, 0.0]),
        np.zeros(1, np.uint64),
    )


class Room(NamedTuple):
    """Room for an episode.

    Attributes
    ----------
    moves
        int64, shape (5,): the step of each action, from a square to the next.
    allowed
        bool, shape (5,): which actions a mask leaves.
    tape
        int8: the actions so far.
    laid
        int64: the lanes laid so far.
    """

    moves: NDArray[np.int64]
    allowed: NDArray[np.bool_]
    tape: NDArray[np.int8]
    laid: NDArray[np.int64]


def new_room(ground: Ground, archive: Archive) -> Room:
    """Room for episodes on a ground, as long as an archive has room for."""
    stride = ground.stride
    return Room(
        np.array([-stride, stride, -1, 1, 0]),
        np.ones(ACTIONS, np.bool_),
        np.zeros(archive.tapes.shape[1], np.int8),
        np.zeros(len(ground.squares), np.int64),
    )


def grown(memory: Memory) -> Memory:
    """The same in a table twice the size."""
    size = 2 * len(memory.keys)
    larger = memory._replace(keys=np.zeros(size, np.uint64), q=np.zeros((size, ACTIONS), memory.q.dtype))
    memory.used[0] = 0
    _carry_over(memory, larger)
    return larger


@compiled
def _carry_over(memory: Memory, larger: Memory) -> None:
    """Put all that a table holds into an empty one."""
    for row in range(len(memory.keys)):
        if memory.keys[row] != 0:
            place = _row(larger, memory.keys[row])
            for action in range(ACTIONS):
                larger.q[place, action] = memory.q[row, action]


@compiled_inner
def _row(memory: Memory, key: np.uint64) -> int:
    """Row of a state, a new one if it was never met."""
    mask = np.uint64(len(memory.keys) - 1)
    place = (key ^ (key >> np.uint64(32))) & mask
    while memory.keys[place] != key:
        if memory.keys[place] == 0:
            memory.keys[place] = key
            memory.used[0] += 1
            break
        place = (place + np.uint64(1)) & mask
    return int(np.int64(place))  # numba mixes unsigned and signed to float


@compiled
def observe(ground: Ground, board: Board, parameters: SarsaParameters, square: int, previous: Whole) -> np.uint64:
    """Hash of the state S_t = (D, M, A_{t-1})."""
    cells, stride, radius = board.cells, ground.stride, parameters.window_radius_squares
    prime = np.uint64(0x9E3779B97F4A7C15)
    key = np.uint64(previous + 1) << np.uint64(32)  # above the squares of any row of M
    packed = np.uint64(0)
    for row in range(-radius, radius + 1):
        first = square + row * stride - radius
        for q in range(first, first + 2 * radius + 1):
            packed = (packed << np.uint64(3)) | np.uint64(cells[q] + 1)
        key = (key ^ packed) * prime
        key ^= key >> np.uint64(29)
        packed = np.uint64(0)
    if parameters.sees_distances:
        for step in (-stride, stride, -1, 1):
            q, far = square + step, 0
            while cells[q] == 0 or cells[q] == 1:
                q += step
                far += 1
            packed = (packed << np.uint64(12)) | np.uint64(far)
        key = (key ^ packed) * prime
        key ^= key >> np.uint64(31)
    return key | np.uint64(1)


@compiled_inlined
def _choose(memory: Memory, row: int, allowed: NDArray[np.bool_], epsilon: float, random: NDArray[np.uint64]) -> Whole:
    """An epsilon-greedy action: greedy with probability 1 - epsilon + epsilon / |A|."""
    count = 0
    for action in range(ACTIONS):
        count += allowed[action]
    if uniform(random) < epsilon:
        nth = np.int64(uniform(random) * count)
        for action in range(ACTIONS):
            if allowed[action]:
                if nth == 0:
                    return action
                nth -= 1
    first = np.int64(next_random(random) % np.uint64(ACTIONS))
    best: Whole = -1
    top = -np.inf
    for offset in range(ACTIONS):
        place = (first + offset) % ACTIONS
        if allowed[place] and memory.q[row, place] > top:
            best, top = place, memory.q[row, place]
    return best


@compiled
def learn(
    ground: Ground,
    board: Board,
    parameters: SarsaParameters,
    memory: Memory,
    archive: Archive,
    room: Room,
    random: NDArray[np.uint64],
    curve: NDArray[np.float64],
    first: int,
    last: int,
) -> tuple[int, int]:
    """Run the episodes from `first` to below `last`, or fewer when the table fills up.

    Returns
    -------
    tuple[int, int]
        The first episode that was not run, and how many actions were taken.

    Notes
    -----
    ``q(S_t, A_t) += alpha (R_{t+1} + gamma q(S_{t+1}, A_{t+1}) - q(S_t, A_t))``. `curve` takes the paper's
    ``E = sum_{t=1}^{T-1} R_t`` of each episode, without the R_T of a failure.
    """
    p = parameters
    cells = board.cells
    moves, allowed, tape, laid = room
    max_steps = min(p.max_steps_per_square * len(ground.squares), len(tape))
    action: Whole = STAY
    epsilon, unchanged, steps_taken = memory.course[0], memory.course[1], 0
    for episode in range(first, last):
        if 2 * (memory.used[0] + max_steps) > len(memory.keys):
            memory.course[0], memory.course[1] = epsilon, unchanged
            return episode, steps_taken
        clear(ground, board)
        start = ground.entrances[np.int64(next_random(random) % np.uint64(len(ground.entrances)))]
        position, run, lanes = start, 0, 0
        step: Whole = 0
        previous: Whole = np.int64(STAY)
        # go on from part of an archived episode
        if archive.in_use[0] > 0 and uniform(random) < p.revisit_rate:
            entry = np.int64(next_random(random) % np.uint64(archive.in_use[0]))
            rival = np.int64(next_random(random) % np.uint64(archive.in_use[0]))
            if archive.values[rival] > archive.values[entry]:
                entry = rival
            start = archive.starts[entry]
            position = start
            share = uniform(random)
            step = np.int64(share * archive.lengths[entry])
            for index in range(step):
                action = archive.tapes[entry, index]
                tape[index] = action
                position += moves[action]
                if cells[position] == 0:
                    lay(ground, board, position)
                    laid[lanes] = position
                    lanes += 1
                run = run + 1 if action == previous else 1
                previous = action
        best_value, best_lanes = NO_VALUE, 0
        best_step: Whole = 0
        earned, reward = float(board.tally[0]), 0.0
        row, old_row, action = -1, -1, STAY
        old_action: Whole = STAY
        done = False
        while step < max_steps and not done:
            if p.masks_actions:
                ways = 0
                for way in range(4):
                    kind = cells[position + moves[way]]
                    allowed[way] = kind == 0 or kind == 1
                    ways += allowed[way]
                allowed[STAY] = False
                if ways == 0:  # walled in
                    break
            row = _row(memory, observe(ground, board, p, position, previous))
            action = _choose(memory, row, allowed, epsilon, random)
            if old_row >= 0:
                target = reward + p.gamma * memory.q[row, action]
                memory.q[old_row, old_action] += p.alpha * (target - memory.q[old_row, old_action])
            target_square = position + moves[action]
            kind = cells[target_square]
            reward = -p.step_penalty
            failed = False
            if action == STAY:
                done = position == start
                reward -= p.step_penalty
            elif position == start and previous != STAY:
                failed = True  # having come back to the start, only staying is left
            elif kind == 0 or kind == 1 or target_square == start:
                if previous != STAY and previous == (action ^ 1):
                    reward -= p.turn_back_penalty
                elif previous != STAY and previous != action and run < p.min_run_squares:
                    reward -= p.interval_penalty
                if kind == 0:
                    beside = 0
                    for way in range(4):
                        beside += cells[target_square + moves[way]] == 1
                    reward -= p.wheeling_penalty * max(0, beside - 1)
                    reward += p.loop_reward * (beside > 1)
                    stalls = board.tally[0]
                    lay(ground, board, target_square)
                    laid[lanes] = target_square
                    lanes += 1
                    reward += board.tally[0] - stalls
                run = run + 1 if action == previous else 1
                position = target_square
            else:
                failed = True
            steps_taken += 1
            if failed:
                memory.q[row, action] += p.alpha * (-p.failure_penalty - memory.q[row, action])
                row = -1
                break
            tape[step] = action
            step += 1
            previous = action
            earned += reward
            old_row, old_action = row, action
            if p.archives_prefixes and kind == 0 and board.tally[_UNTOUCHED] == 0:
                value = value_now(ground, board)
                if value > best_value:
                    value -= faults_cost(ground, board)
                    if value > best_value:
                        best_value, best_lanes, best_step = value, lanes, step
        if row >= 0:
            memory.q[row, action] += p.alpha * (reward - memory.q[row, action])
        if not p.archives_prefixes and board.tally[_UNTOUCHED] == 0:
            best_value = value_now(ground, board) - faults_cost(ground, board)
            best_lanes, best_step = lanes, step
        if best_value > NO_VALUE:
            keep(archive, laid, best_lanes, best_value, tape, best_step, start)
        curve[episode] = earned
        key = np.uint64(0)
        for index in range(lanes):
            key ^= np.uint64(laid[index] * laid[index] + 1) * np.uint64(0xBF58476D1CE4E5B9)
        unchanged = unchanged + 1 if key == memory.last[0] else 0.0
        memory.last[0] = key
        epsilon = max(epsilon * p.epsilon_decay, p.epsilon_min)
        if unchanged >= p.patience_episodes:
            epsilon, unchanged = p.epsilon_refresh, 0.0
    memory.course[0], memory.course[1] = epsilon, unchanged
    return last, steps_taken
