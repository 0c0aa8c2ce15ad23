"""Repair and polish of lanes: joining what is apart, and flips of squares that raise the value. Compiled."""
# ruff: noqa: C901 - a search for ways is one loop over squares

import numpy as np
from numpy.typing import NDArray

from garage2usd.compiled import compiled
from garage2usd.planning.archive import next_random, uniform
from garage2usd.planning.board import NO_VALUE, Board, flip, mark_network, measure
from garage2usd.planning.ground import Ground

__all__ = ["anneal", "climb", "close_dead_ends", "connect"]


@compiled
def connect(ground: Ground, board: Board) -> bool:
    """Join all lanes and portals to one network by shortest ways over free squares; False if there is none.

    Starts at the first portal; lanes that no way reaches are taken off.
    """
    cells, reached = board.cells, board.near
    first = _lane_at(ground, board, ground.portals[0])
    if first < 0:
        return False
    cells[first] = 1
    while True:
        mark_network(ground, board, first)
        if not _lay_way(ground, board):
            break
    for q in ground.squares:
        if cells[q] == 1 and reached[q] == 0:
            cells[q] = 0
    joined = True
    for portal in ground.portals:
        joined &= reached[portal] == 1
    return joined


@compiled
def _lane_at(ground: Ground, board: Board, portal: int) -> int:
    """A square beside a portal: the first lane, else a free one from which all portals are reached, or -1."""
    cells, free = board.cells, -1
    for step in (-ground.stride, ground.stride, -1, 1):
        q = portal + step
        if cells[q] == 1:
            return q
        if cells[q] == 0 and (free < 0 or _reaches_all(ground, board, q)):
            free = q
    return free


@compiled
def _lay_way(ground: Ground, board: Board) -> bool:
    """Lay the shortest way over free squares from the marked network to any other lane or portal."""
    cells, reached, came, queue = board.cells, board.near, board.hops, board.queue
    tail = 0
    for q in ground.squares:
        came[q] = -1
        if cells[q] == 1 and reached[q] == 1:
            came[q] = q
            queue[tail] = q
            tail += 1
    head = 0
    while head < tail:
        q = queue[head]
        head += 1
        for step in (-ground.stride, ground.stride, -1, 1):
            p = q + step
            if cells[p] >= 1 and reached[p] == 0:
                while cells[q] == 0:
                    cells[q] = 1
                    q = came[q]
                return True
            if cells[p] == 0 and came[p] == -1:
                came[p] = q
                queue[tail] = p
                tail += 1
    return False


@compiled
def _reaches_all(ground: Ground, board: Board, first: int) -> bool:
    """Whether every portal is reached from a square over squares that are free or lanes."""
    cells, queue = board.cells, board.queue
    seen = np.zeros(len(cells), np.bool_)
    queue[0], seen[first] = first, True
    head, tail = 0, 1
    while head < tail:
        q = queue[head]
        head += 1
        for step in (-ground.stride, ground.stride, -1, 1):
            p = q + step
            if cells[p] >= 0 and not seen[p]:
                seen[p] = True
                if cells[p] <= 1:
                    queue[tail] = p
                    tail += 1
    all_seen = True
    for portal in ground.portals:
        all_seen &= seen[portal]
    return all_seen


@compiled
def close_dead_ends(ground: Ground, board: Board) -> None:
    """Lead each dead end on to the nearest other lane over free squares, or take it off; keeps all joined."""
    cells, stride, queue = board.cells, ground.stride, board.queue
    steps = (-stride, stride, -1, 1)
    came = np.zeros(len(cells), np.int64)
    changed = True
    rounds = 0
    while changed:
        changed = False
        rounds += 1
        for tip in ground.squares:
            if cells[tip] != 1:
                continue
            degree, root = 0, np.int64(-1)
            for step in steps:
                if cells[tip + step] >= 1:
                    degree += 1
                    root = tip + step
            if degree != 1 or cells[root] != 1:
                continue
            changed = True
            came[:] = 0
            came[tip] = tip
            queue[0] = tip
            head, tail, found = 0, 1, np.int64(-1)
            while head < tail and found < 0 and rounds == 1:
                q = queue[head]
                head += 1
                for step in steps:
                    p = q + step
                    if came[p] == 0 and (cells[p] == 0 or (cells[p] == 1 and p != root and q != tip)):
                        came[p] = q
                        if cells[p] == 1:
                            found = q
                            break
                        queue[tail] = p
                        tail += 1
            if found < 0:
                cells[tip] = 0
            while found >= 0 and found != tip:
                cells[found] = 1
                found = came[found]


@compiled
def _beside_lane(ground: Ground, board: Board, square: int) -> bool:
    """Whether a square has a lane beside it: without, no flip of it keeps the lanes joined."""
    beside = False
    for step in (-ground.stride, ground.stride, -1, 1):
        beside |= board.cells[square + step] == 1
    return beside


@compiled
def climb(ground: Ground, board: Board, random: NDArray[np.uint64], passes: int) -> float:
    """Raise the value of the lanes in `board.cells` by flips of one square or of two side by side; returns it."""
    cells = board.cells
    value = measure(ground, board)
    order = ground.squares.copy()
    for _ in range(passes):
        for index in range(len(order) - 1, 0, -1):
            other = int(next_random(random) % np.uint64(index + 1))
            order[index], order[other] = order[other], order[index]
        improved = False
        for q in order:
            for step in (0, ground.stride, 1):
                p = q + step
                if cells[p] != 0 and cells[p] != 1:
                    continue
                if not (_beside_lane(ground, board, q) or (p != q and _beside_lane(ground, board, p))):
                    continue
                flip(cells, q, p)
                tried = measure(ground, board)
                if tried > value + 1e-9:
                    value, improved = tried, True
                else:
                    flip(cells, q, p)
        if not improved:
            break
    return value


@compiled
def anneal(
    ground: Ground, board: Board, random: NDArray[np.uint64], flips: int, hottest: float, coldest: float
) -> float:
    """Anneal the feasible lanes in `board.cells`; leaves the best met there and returns its value."""
    cells = board.cells
    value = measure(ground, board)
    best, best_cells = value, cells.copy()
    cooling = (coldest / hottest) ** (1.0 / max(1, flips))
    heat = hottest
    for _ in range(flips):
        heat *= cooling
        draw = next_random(random)
        q = ground.squares[int((draw >> np.uint64(8)) % np.uint64(len(ground.squares)))]
        step = (0, 0, 1, ground.stride)[int(draw & np.uint64(3))]
        p = q + step
        if cells[p] != 0 and cells[p] != 1:
            continue
        if not (_beside_lane(ground, board, q) or (p != q and _beside_lane(ground, board, p))):
            continue
        flip(cells, q, p)
        tried = measure(ground, board)
        if tried > NO_VALUE and (tried >= value or uniform(random) < np.exp((tried - value) / heat)):
            value = tried
            if value > best + 1e-9:
                best = value
                best_cells[:] = cells
        else:
            flip(cells, q, p)
    cells[:] = best_cells
    return measure(ground, board)
