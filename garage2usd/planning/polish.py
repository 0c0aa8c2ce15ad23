"""Repair and polish of lanes: joining what is apart, and flips of squares that raise the value. Compiled."""
# Over 300 lines: Numba caches by file, and an edited callee in another one leaves its callers stale.
# ruff: noqa: C901, PLR0912, PLR0915 - climbing and annealing in one function, as each is compiled with all it calls

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.compiled import compiled, compiled_inlined, compiled_inner, copy_row
from garage2usd.planning.archive import next_random, uniform
from garage2usd.planning.board import FAULTS, NO_VALUE, Board, faults_cost, flip, mark_network, measure, value_now
from garage2usd.planning.flips import FLIPPED, REFUSED, flip_within
from garage2usd.planning.ground import Ground
from garage2usd.planning.sizes import Sizes, copy_sides, floor_cost, settle, side_now, sync

__all__ = ["Room", "connect", "improve", "new_room"]

_RESIZED_EVERY = 40
"""One move in so many is of a side, of which there are far fewer than squares."""
_SETTLING_PASSES = 2
"""Over all lines, and more than one, as the side that pays best depends on the others."""


@compiled
def connect(ground: Ground, board: Board) -> bool:
    """Connect all lanes and portals by shortest paths over free squares; False if there are none.

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


@compiled_inlined
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


@compiled_inlined
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


@compiled_inlined
def _reaches_all(ground: Ground, board: Board, first: int) -> bool:
    """Whether every portal is reached from a square over squares that are free or lanes; takes `near` for marks."""
    cells, queue, seen = board.cells, board.queue, board.near
    for q in range(len(cells)):
        seen[q] = 0
    queue[0], seen[first] = first, 1
    head, tail = 0, 1
    while head < tail:
        q = queue[head]
        head += 1
        for step in (-ground.stride, ground.stride, -1, 1):
            p = q + step
            if cells[p] >= 0 and seen[p] == 0:
                seen[p] = 1
                if cells[p] <= 1:
                    queue[tail] = p
                    tail += 1
    all_seen = True
    for portal in ground.portals:
        all_seen &= seen[portal] == 1
    return all_seen


@compiled_inner
def _beside_lane(ground: Ground, board: Board, square: int) -> bool:
    """Whether a square has a lane beside it: without, no flip of it keeps the lanes joined."""
    beside = False
    for step in (-ground.stride, ground.stride, -1, 1):
        beside |= board.cells[square + step] == 1
    return beside


@compiled_inner
def _worth(ground: Ground, board: Board, sizes: Sizes, least: float) -> float:
    """Value of the lanes on the board less the price of the floor, in the sides that they ask for, or NO_VALUE.

    Below `least` faults may be left out of it.
    """
    if not (sizes.is_chosen[0] or sizes.is_chosen[1]):
        return measure(ground, board, least)
    sync(ground, board, sizes)
    floor = floor_cost(sizes)
    value = measure(ground, board, least + floor)
    return value if value == NO_VALUE else value - floor


class Room(NamedTuple):
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

    cells: NDArray[np.int8]
    kept_mm: NDArray[np.int64]
    order: NDArray[np.int64]
    known: NDArray[np.int64]
    hops: NDArray[np.int32]


def new_room(ground: Ground, sizes: Sizes) -> Room:
    """Room for the plans of a ground."""
    return Room(
        ground.cells.copy(),
        sizes.kept_mm.copy(),
        ground.squares.copy(),
        np.zeros(3, np.int64),
        np.zeros(len(ground.cells), np.int32),
    )


@compiled_inner
def _remember(board: Board, room: Room) -> None:
    """Keep what the board has of the lanes that were measured last."""
    for figure in range(len(room.known)):
        room.known[figure] = board.tally[figure]
    copy_row(room.hops, board.hops)


@compiled_inner
def _flipped(ground: Ground, board: Board, sizes: Sizes, room: Room, q: int, p: int, least: float) -> float:
    """Flip one square, or two side by side; what the lanes are worth then; at most NO_VALUE where it was not done.

    Below `least` faults may be left out of it.
    """
    if sizes.is_chosen[0] or sizes.is_chosen[1]:
        flip(board.cells, q, p)
        value = _worth(ground, board, sizes, least)
    else:
        fate = flip_within(ground, board, room.known, room.hops, q, p, least)
        if fate == REFUSED:
            return NO_VALUE
        if fate == FLIPPED:
            value = measure(ground, board, least)
        else:
            value = value_now(ground, board)
            if value >= least:
                value -= faults_cost(ground, board)
                copy_row(board.hops, room.hops)
    if value <= NO_VALUE:
        flip(board.cells, q, p)
    return value


@compiled
def improve(
    ground: Ground,
    board: Board,
    sizes: Sizes,
    room: Room,
    random: NDArray[np.uint64],
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
    cells, order = board.cells, room.order
    is_sized = sizes.is_chosen[0] or sizes.is_chosen[1]
    value = NO_VALUE
    if is_sized:
        sync(ground, board, sizes)
    if not is_sized or measure(ground, board, np.inf) != NO_VALUE:
        if is_sized:
            settle(ground, board, sizes, _SETTLING_PASSES)
        value = _worth(ground, board, sizes, -np.inf)
        _remember(board, room)
    copy_row(order, ground.squares)
    for _ in range(passes):
        for index in range(len(order) - 1, 0, -1):
            other = np.int64(next_random(random) % np.uint64(index + 1))
            order[index], order[other] = order[other], order[index]
        improved = False
        for q in order:
            for step in (0, ground.stride, 1):
                p = q + step
                if cells[p] != 0 and cells[p] != 1:
                    continue
                if not (_beside_lane(ground, board, q) or (p != q and _beside_lane(ground, board, p))):
                    continue
                tried = _flipped(ground, board, sizes, room, q, p, value)
                if tried <= NO_VALUE:
                    continue
                if tried > value + 1e-9:
                    value, improved = tried, True
                    _remember(board, room)
                else:
                    flip(cells, q, p)
        if not improved:
            break
    if flips == 0:
        return _worth(ground, board, sizes, -np.inf)
    best, best_faults = value, board.tally[FAULTS]
    copy_row(room.cells, cells)
    copy_sides(room.kept_mm, sizes.kept_mm)
    cooling = (coldest / hottest) ** (1.0 / flips)
    heat = hottest
    for _ in range(flips):
        heat *= cooling
        draw = next_random(random)
        threshold = value + heat * np.log(max(uniform(random), 1e-300))
        if is_sized and (draw >> np.uint64(40)) % np.uint64(_RESIZED_EVERY) == 0:
            axis = np.int64((draw >> np.uint64(4)) & np.uint64(1))
            count = len(cells) // ground.stride if axis == 0 else ground.stride
            line = np.int64((draw >> np.uint64(8)) % np.uint64(count))
            if not sizes.is_chosen[axis] or sizes.driven[axis, line] > 0:
                continue
            kept = sizes.kept_mm[axis, line]
            sizes.kept_mm[axis, line] = sizes.free_mm[np.int64((draw >> np.uint64(20)) % np.uint64(len(sizes.free_mm)))]
            if side_now(sizes, axis, line) == sizes.actual_mm[axis, line]:
                continue
            tried = _worth(ground, board, sizes, threshold)
            if tried >= threshold:
                value = tried
            else:
                sizes.kept_mm[axis, line] = kept
            continue
        q = ground.squares[np.int64((draw >> np.uint64(8)) % np.uint64(len(ground.squares)))]
        step = (0, 0, 1, ground.stride)[np.int64(draw & np.uint64(3))]
        p = q + step
        if cells[p] != 0 and cells[p] != 1:
            continue
        if not (_beside_lane(ground, board, q) or (p != q and _beside_lane(ground, board, p))):
            continue
        tried = _flipped(ground, board, sizes, room, q, p, threshold)
        if tried <= NO_VALUE:
            continue
        if tried >= threshold:
            value = tried
            _remember(board, room)
            faults = board.tally[FAULTS]
            if faults < best_faults or (faults == best_faults and value > best + 1e-9):
                best, best_faults = value, faults
                copy_row(room.cells, cells)
                copy_sides(room.kept_mm, sizes.kept_mm)
        else:
            flip(cells, q, p)
    copy_row(cells, room.cells)
    copy_sides(sizes.kept_mm, room.kept_mm)
    return _worth(ground, board, sizes, -np.inf)
