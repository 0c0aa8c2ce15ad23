"""A board of lanes with its score: laid square by square, or measured whole. Compiled."""
# Over 300 lines: Numba caches by file, and an edited callee in another one leaves its callers stale.
# ruff: noqa: C901, PLR0912 - a search or a walk is one loop over squares

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.compiled import compiled, compiled_inlined, compiled_inner
from garage2usd.planning.ground import Ground
from garage2usd.planning.survey import survey

__all__ = [
    "FAR",
    "FAULTS",
    "NO_VALUE",
    "Board",
    "clear",
    "dead_ends",
    "faults_cost",
    "flip",
    "lay",
    "mark_network",
    "measure",
    "new_board",
    "stalls_at",
    "value_now",
]

FAR = 1 << 28
NO_VALUE = -1.0e9

_ENTRANCE = 2
_STALLS, _TIME, _UNUSED, _UNTOUCHED, _LAID = 0, 1, 2, 3, 4
FAULTS = 5
"""Where `Board.tally` holds how often the rules of circulation are broken."""


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

    cells: NDArray[np.int8]
    edges: NDArray[np.int8]
    hops: NDArray[np.int32]
    near: NDArray[np.int32]
    state: NDArray[np.int32]
    queue: NDArray[np.int64]
    tally: NDArray[np.int64]


def new_board(ground: Ground) -> Board:
    """Room for a board; `clear` it before use."""
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


@compiled_inlined
def clear(ground: Ground, board: Board) -> None:
    """Take all lanes off."""
    for q in range(len(ground.cells)):
        board.cells[q] = ground.cells[q]
        board.edges[q] = 0
        board.hops[q] = FAR
        board.near[q] = FAR
    board.tally[_STALLS] = 0
    board.tally[_TIME] = 0
    board.tally[_UNUSED] = len(ground.squares)
    board.tally[_UNTOUCHED] = len(ground.portals)
    board.tally[_LAID] = 0


@compiled_inner
def lay(ground: Ground, board: Board, square: int) -> None:
    """Make a free square a lane, beside an entrance or a lane; keeps the tally."""
    cells, edges, hops, near, _, queue, tally = board
    stride = ground.stride
    stalls = ground.capacity[square, edges[square]]
    if stalls > 0:
        tally[_STALLS] -= stalls
        tally[_TIME] -= stalls * (1 + near[square])
    else:
        tally[_UNUSED] -= 1
    cells[square] = 1
    tally[_LAID] += 1
    nearest = FAR
    for way in range(4):
        p = square + (-stride, stride, -1, 1)[way]
        kind = cells[p]
        if kind == 1:
            nearest = min(nearest, hops[p] + 1)
        elif kind == 0:
            before = ground.capacity[p, edges[p]]
            edges[p] |= (2, 1, 8, 4)[way]
            after = ground.capacity[p, edges[p]]
            if after > before:
                tally[_UNUSED] -= before == 0
                tally[_STALLS] += after - before
                tally[_TIME] += (after - before) * (1 + near[p])
        elif kind >= _ENTRANCE:
            if kind == _ENTRANCE:
                nearest = 1
            if near[p] == FAR:
                near[p] = 0
                tally[_UNTOUCHED] -= 1
    hops[square] = nearest
    queue[0] = square
    head, tail = 0, 1
    while head < tail:
        q = queue[head]
        head += 1
        for step in (-stride, stride, -1, 1):
            p = q + step
            if cells[p] == 1:
                if hops[p] > hops[q] + 1:
                    hops[p] = hops[q] + 1
                    queue[tail] = p
                    tail += 1
            elif cells[p] == 0 and near[p] > hops[q]:
                tally[_TIME] -= ground.capacity[p, edges[p]] * (near[p] - hops[q])
                near[p] = hops[q]


@compiled_inner
def flip(cells: NDArray[np.int8], q: int, p: int) -> None:
    """Exchange lane and free square on one square, or on two if they differ; keeps no tally."""
    cells[q] = 1 - cells[q]
    if p != q:
        cells[p] = 1 - cells[p]


@compiled
def value_now(ground: Ground, board: Board) -> float:
    """Score y' of the board as its tally has it, whether or not all portals are touched."""
    stalls = board.tally[_STALLS]
    if stalls == 0:
        return NO_VALUE
    weights = ground.weights
    mean_time = board.tally[_TIME] / stalls
    return float(weights[0] * stalls + weights[1] * mean_time + weights[2] * board.tally[_UNUSED])


@compiled_inlined
def dead_ends(ground: Ground, cells: NDArray[np.int8]) -> int:
    """Dead-end aisles over the ground's limit, from the tip to the next junction or portal."""
    stride, count = ground.stride, 0
    for tip in ground.squares:
        if cells[tip] != 1:
            continue
        degree = 0
        for step in (-stride, stride, -1, 1):
            degree += cells[tip + step] >= 1
        if degree > 1:
            continue
        q, previous, length = tip, 0, 0
        while True:
            onward, degree, step_on = 0, 0, 0
            for step in (-stride, stride, -1, 1):
                p = q + step
                if cells[p] >= 1:
                    degree += 1
                    if p != previous:
                        onward, step_on = p, step
            along_x = abs(step_on) == 1 if step_on != 0 else abs(previous - q) == 1
            if degree > 2 or (q != tip and degree == 1):  # noqa: PLR2004
                break
            length += ground.sides_mm[q, 1 if along_x else 0]
            if length > ground.dead_end_limit_mm:
                count += 1
                break
            if onward == 0 or cells[onward] != 1:
                break
            previous, q = q, onward
    return count


@compiled_inner
def stalls_at(ground: Ground, board: Board, square: int) -> tuple[int, int]:
    """Stalls on a free square by the lanes beside it, and the least `hops` of these."""
    edges, near = 0, FAR
    for way in range(4):
        p = square + (-ground.stride, ground.stride, -1, 1)[way]
        if board.cells[p] == 1:
            edges |= 1 << way
            near = min(near, board.hops[p])
    return ground.capacity[square, edges], near


@compiled
def measure(ground: Ground, board: Board, least: float) -> float:
    """Score y' less the cost of faults of the lanes in `board.cells`, NO_VALUE if infeasible; sets hops and tally.

    A score below `least` is returned as it is, without a look at the faults.

    Unlike `lay` it keeps neither `edges` nor `near`.

    Feasible: every portal touches a lane and the lanes form one network that does not pass through portals.
    """
    cells, hops, queue, tally = board.cells, board.hops, board.queue, board.tally
    stride = ground.stride
    tally[FAULTS] = FAR
    for portal in ground.portals:
        touched = False
        for step in (-stride, stride, -1, 1):
            touched |= cells[portal + step] == 1
        if not touched:
            return NO_VALUE
    lanes = 0
    for q in ground.squares:
        hops[q] = FAR
        lanes += cells[q]
    tail = 0
    for entrance in ground.entrances:
        for step in (-stride, stride, -1, 1):
            q = entrance + step
            if cells[q] == 1 and hops[q] == FAR:
                hops[q] = 1
                queue[tail] = q
                tail += 1
    starts = tail
    if starts == 0:
        return NO_VALUE
    head = 0
    while head < tail:
        q = queue[head]
        head += 1
        for step in (-stride, stride, -1, 1):
            p = q + step
            if cells[p] == 1 and hops[p] == FAR:
                hops[p] = hops[q] + 1
                queue[tail] = p
                tail += 1
    if tail != lanes:
        return NO_VALUE
    if starts > 1 and mark_network(ground, board, queue[0]) != lanes:
        return NO_VALUE
    stalls, time, unused = 0, 0, 0
    for q in ground.squares:
        if cells[q] != 0:
            continue
        count, near = stalls_at(ground, board, q)
        stalls += count
        time += count * (1 + near)
        unused += count == 0
    tally[_STALLS], tally[_TIME], tally[_UNUSED] = stalls, time, unused
    tally[_UNTOUCHED], tally[_LAID] = 0, lanes
    value = value_now(ground, board)
    if value < least:
        return value
    return value - faults_cost(ground, board)


@compiled_inner
def faults_cost(ground: Ground, board: Board) -> float:
    """What the faults of the circulation on the lanes in `board.cells` cost beside the score; uses `state`, `queue`."""
    cost, rules = 0.0, ground.rules
    board.tally[FAULTS] = 0
    if ground.dead_end_cost > 0:
        cost += ground.dead_end_cost * dead_ends(ground, board.cells)
    if rules.is_asked:
        found = survey(
            ground.squares,
            ground.stride,
            board.cells,
            board.state,
            board.queue,
            rules.dead_end_squares,
            rules.stretch_squares,
        )
        cost += rules.deep_cost * found.deep + rules.block_cost * found.blocks + rules.stretch_cost * found.excess
        board.tally[FAULTS] = found.deep + found.blocks + found.excess
        if rules.asks_loop and found.loops < 1:
            cost += rules.loopless_cost
            board.tally[FAULTS] += 1
    return cost


@compiled_inner
def mark_network(ground: Ground, board: Board, first: int) -> int:
    """Set `near` to 1 on all lanes and portals that are connected to a lane, to 0 elsewhere; returns how many lanes."""
    cells, reached, queue = board.cells, board.near, board.queue
    for q in range(len(reached)):
        reached[q] = 0
    queue[0], reached[first] = first, 1
    head, tail = 0, 1
    while head < tail:
        q = queue[head]
        head += 1
        for step in (-ground.stride, ground.stride, -1, 1):
            p = q + step
            if cells[p] >= 1 and reached[p] == 0:
                reached[p] = 1
                if cells[p] == 1:
                    queue[tail] = p
                    tail += 1
    return tail
