"""Annealing of large plans that circulate: every rule is judged around a move, by labels of the lanes. Compiled."""
# Over 300 lines: Numba caches by file, and an edited callee in another one leaves its callers stale.
# ruff: noqa: C901, PLR0915, PLR2004 - moves are judged in loops over shared counters

import numpy as np
from numpy.typing import NDArray

from garage2usd.compiled import Whole, compiled, compiled_inlined, compiled_inner, copy_row
from garage2usd.planning.archive import below, uniform
from garage2usd.planning.board import FAR, FAULTS, NO_VALUE, Board, measure, stalls_at
from garage2usd.planning.draft import Draft, apply, gather, revert
from garage2usd.planning.ground import Ground
from garage2usd.planning.labels import fault, find_faults, is_long, label_lanes, through, trim
from garage2usd.planning.moves import propose
from garage2usd.planning.polish import Room
from garage2usd.planning.sizes import (
    Sizes,
    copy_sides,
    driven_ways,
    floor_cost,
    foresee,
    resize,
    settle,
    side_now,
    sync,
    weigh,
)

__all__ = ["anneal_labels"]

# shares of the moves that are of a side, and that start at what is broken
_RESIZED, _FAULTY_SHARE = 0.02, 0.25

# what a fault weighs, in stalls, in the choice of the best plan: while annealing, and where faults are mended
_FAULT_PRICE, _FAULT_PRICE_AT_LAST = 30.0, 1.0e5

# what is broken still at last is mended where it is, by moves that may cost stalls before they pay
_MENDING_TRIALS, _MENDING_REFRESH, _MENDING_HEAT, _MENDING_FAULTY_SHARE = 60_000, 2000, 2.0, 1.0

_N, _TIME, _UNUSED, _BAD, _BLOCKS, _EXCESS = 0, 1, 2, 3, 4, 5
_TAKEN_OFF, _PUT_ON = np.int64(-1), np.int64(1)


@compiled_inner
def _blocks_at(cells: NDArray[np.int8], draft: Draft, stride: int) -> int:
    """Blocks of two by two lanes that touch the moved squares."""
    draft.marks[1] += 1
    mark, stamp, count = draft.marks[1], draft.stamp, 0
    for index in range(draft.size[0]):
        q = draft.moved[index]
        for corner in (q, q - 1, q - stride, q - stride - 1):
            if stamp[1, corner] != mark:
                stamp[1, corner] = mark
                count += (
                    cells[corner] == 1
                    and cells[corner + 1] == 1
                    and cells[corner + stride] == 1
                    and cells[corner + stride + 1] == 1
                )
    return count


@compiled_inner
def _count(ground: Ground, board: Board, draft: Draft, sign: Whole) -> None:
    """Add what the squares around a move hold, or take it off."""
    cells, change, stride = board.cells, draft.change, ground.stride
    for index in range(draft.size[1]):
        x = draft.around[index]
        if cells[x] == 0:
            count, near = stalls_at(ground, board, x)
            change[_N] += sign * count
            change[_UNUSED] += sign * (count == 0)
            if count > 0:
                change[_TIME] += sign * count * (1 + near)
        elif cells[x] == 1:
            change[_BAD] += sign * fault(cells, draft.label, stride, x)
    change[_BLOCKS] += sign * _blocks_at(cells, draft, stride)


@compiled_inner
def _excess_around(ground: Ground, board: Board, draft: Draft) -> int:
    """Squares by which the stretches around a move are too long."""
    cells, label, stride, queue = board.cells, draft.label, ground.stride, draft.queue
    limit, excess = ground.rules.stretch_squares, 0
    draft.marks[2] += 1
    mark, stamp = draft.marks[2], draft.stamp
    for index in range(draft.size[1]):
        first = draft.around[index]
        if label[first] != 1 or stamp[2, first] == mark or through(cells, label, stride, first) != 2:
            continue
        stamp[2, first] = mark
        queue[0] = first
        head, tail = 0, 1
        while head < tail:
            q = queue[head]
            head += 1
            for step in (-stride, stride, -1, 1):
                p = q + step
                if label[p] == 1 and stamp[2, p] != mark and through(cells, label, stride, p) == 2:
                    stamp[2, p] = mark
                    queue[tail] = p
                    tail += 1
        excess += max(0, tail - limit)
    return excess


@compiled_inner
def _drive(board: Board, draft: Draft, sizes: Sizes, stride: int, sign: Whole) -> None:
    """Count where cars drive around a move into the lines, or take it off."""
    for index in range(draft.size[1]):
        q = draft.around[index]
        if board.cells[q] >= 1:
            ways = driven_ways(board.cells, stride, q)
            sizes.driven[0, q // stride] += sign * (ways & 1)
            sizes.driven[1, q % stride] += sign * (ways >> 1)


@compiled_inlined
def _find_lines(ground: Ground, draft: Draft, sizes: Sizes) -> None:
    """Find the lines around a move that get another side by it."""
    draft.size[2] = 0
    for index in range(draft.size[1]):
        q = draft.around[index]
        for axis in range(2):
            line = q // ground.stride if axis == 0 else q % ground.stride
            if not sizes.is_chosen[axis] or side_now(sizes, axis, line) == sizes.actual_mm[axis, line]:
                continue
            is_new = True
            for place in range(draft.size[2]):
                is_new &= draft.lines[place, 0] != axis or draft.lines[place, 1] != line
            if is_new:
                draft.lines[draft.size[2], 0], draft.lines[draft.size[2], 1] = axis, line
                draft.size[2] += 1


@compiled_inner
def _resize_lines(ground: Ground, draft: Draft, sizes: Sizes) -> None:
    """Give the lines that a move touches the sides that they are to have now."""
    for place in range(draft.size[2]):
        axis, line = draft.lines[place]
        resize(ground, sizes, axis, line, side_now(sizes, axis, line))


@compiled_inlined
def _touches_long(board: Board, draft: Draft, stretch_squares: int) -> bool:
    """Whether there is such a square around a move."""
    for index in range(draft.size[1]):
        if draft.label[draft.around[index]] > 0 and is_long(board, stretch_squares, draft.around[index]):
            return True
    return False


@compiled_inner
def _tally(ground: Ground, board: Board, draft: Draft, sizes: Sizes) -> float:
    """Measure the whole board into the draft's tally; its value less that of the floor, NO_VALUE if infeasible."""
    sync(ground, board, sizes)
    exact = measure(ground, board, -np.inf)
    if exact == NO_VALUE:
        return NO_VALUE
    tally = draft.tally
    tally[_N], tally[_TIME], tally[_UNUSED] = board.tally[0], board.tally[1], board.tally[2]
    if sizes.is_chosen[0] or sizes.is_chosen[1]:
        foresee(ground, board, sizes)
    return exact - floor_cost(sizes)


@compiled_inner
def _gain(ground: Ground, draft: Draft, price: float, stretch_price: float) -> float:
    """What a move adds to the value, less the price of the faults that it adds; very little if no stall is left."""
    change, tally, weights = draft.change, draft.tally, ground.weights
    stalls = tally[_N] + change[_N]
    if stalls <= 0:
        return NO_VALUE
    gain = weights[0] * change[_N] + weights[2] * change[_UNUSED]
    gain += weights[1] * ((tally[_TIME] + change[_TIME]) / stalls - tally[_TIME] / max(1, tally[_N]))
    return float(gain - price * (change[_BAD] + change[_BLOCKS]) - stretch_price * change[_EXCESS])


@compiled_inlined
def _shortcut(board: Board, draft: Draft, stride: int) -> int:
    """Squares by which the new lanes of a move bring a lane beside them nearer to the entrances, at most."""
    cells, hops, most = board.cells, board.hops, 0
    for index in range(draft.size[0]):
        q = draft.moved[index]
        if cells[q] == 1 and draft.old[index] == 0 and hops[q] < FAR:
            for step in (-stride, stride, -1, 1):
                if cells[q + step] == 1 and hops[q + step] < FAR:
                    most = max(most, hops[q + step] - hops[q] - 1)
    return most


@compiled_inlined
def _hope(ground: Ground, draft: Draft, sizes: Sizes) -> float:
    """More than the lines around a move are likely to gain by other sides, to leave most of them unweighed."""
    hope = 0.0
    for index in range(draft.size[1]):
        q = draft.around[index]
        for axis in range(2):
            line = q // ground.stride if axis == 0 else q % ground.stride
            if sizes.is_chosen[axis] and side_now(sizes, axis, line) != sizes.actual_mm[axis, line]:
                hint = sizes.hint[axis, line]
                # squares around a move lie on a line more than once: what is feared counts but for one of them
                hope += hint + 0.2 * abs(hint) + 2.0 if hint > 0 else (0.8 * hint + 2.0) / draft.size[1]
    return hope


@compiled_inner
def _book(draft: Draft) -> None:
    """Add what a move that is made changes to the draft's tally."""
    for figure in range(3):
        draft.tally[figure] += draft.change[figure]


@compiled
def anneal_labels(
    ground: Ground,
    board: Board,
    draft: Draft,
    sizes: Sizes,
    room: Room,
    random: NDArray[np.uint64],
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
    cells, rules = board.cells, ground.rules
    best, best_faults, fault_price = NO_VALUE, np.int64(0), _FAULT_PRICE
    copy_row(room.cells, cells)
    copy_sides(room.kept_mm, sizes.kept_mm)
    cooling = (heats[1] / heats[0]) ** (1.0 / max(1, trials))
    pricing = (prices[1] / prices[0]) ** (1.0 / max(1, trials))
    heat, price, stretch_price = heats[0], prices[0], prices[2]
    stretch_pricing = (prices[3] / prices[2]) ** (1.0 / max(1, trials))
    is_sized = sizes.is_chosen[0] or sizes.is_chosen[1]
    label_lanes(ground, board, draft)
    if is_sized:
        sync(ground, board, sizes)
        measure(ground, board, -np.inf)
        settle(ground, board, sizes, 2)
    _tally(ground, board, draft, sizes)
    find_faults(ground, board, draft)
    copy_row(draft.hops, board.hops)
    changed = 1
    faulty_share = _FAULTY_SHARE
    for trial in range(trials + _MENDING_TRIALS + 1):
        if trial == trials:
            heat, faulty_share, refresh = _MENDING_HEAT, _MENDING_FAULTY_SHARE, _MENDING_REFRESH
        if trial == trials or (trial % refresh == refresh - 1 and changed > 0):
            changed = 0
            copy_row(draft.cells, cells)
            if rules.is_asked:
                trim(ground, board)
            measured = _tally(ground, board, draft, sizes)
            faults = board.tally[FAULTS]
            if measured - fault_price * faults > best - fault_price * best_faults:
                best, best_faults = measured, faults
                copy_row(room.cells, cells)
                copy_sides(room.kept_mm, sizes.kept_mm)
            copy_row(cells, draft.cells)
            if trial >= trials:
                # what is broken still is mended on the best, from its trimmed lanes
                fault_price = _FAULT_PRICE_AT_LAST
                copy_row(cells, room.cells)
                copy_sides(sizes.kept_mm, room.kept_mm)
            # moves leave labels that are sound but not what pruning says: loops of dead ends
            label_lanes(ground, board, draft)
            _tally(ground, board, draft, sizes)
            find_faults(ground, board, draft)
            copy_row(draft.hops, board.hops)
            # beyond the last trial only to mend what is broken still
            if trial >= trials and best_faults == 0:
                break
        if trial < trials:
            heat *= cooling
            price *= pricing
            stretch_price *= stretch_pricing
        if is_sized and uniform(random) < _RESIZED:
            _try_side(ground, board, draft, sizes, random, heat)
            continue
        if not propose(ground, board, draft, random, faulty_share):
            continue
        threshold = heat * np.log(max(uniform(random), 1e-300))
        changed += _try_move(ground, board, draft, sizes, threshold, price, stretch_price)
    copy_row(cells, room.cells)
    copy_sides(sizes.kept_mm, room.kept_mm)
    return _tally(ground, board, draft, sizes)


@compiled_inner
def _try_move(
    ground: Ground,
    board: Board,
    draft: Draft,
    sizes: Sizes,
    threshold: float,
    price: float,
    stretch_price: float,
) -> bool:
    """Make the move of the draft if it gains as much as the threshold."""
    tally, change, stride = draft.tally, draft.change, ground.stride
    is_sized = sizes.is_chosen[0] or sizes.is_chosen[1]
    gather(draft, stride)
    for figure in range(len(change)):
        change[figure] = 0
    draft.size[2] = 0
    _count(ground, board, draft, _TAKEN_OFF)
    if _touches_long(board, draft, ground.rules.stretch_squares):
        change[_EXCESS] -= _excess_around(ground, board, draft)
    if is_sized:
        _drive(board, draft, sizes, stride, _TAKEN_OFF)
    apply(ground, board, draft)
    _count(ground, board, draft, _PUT_ON)
    if is_sized:
        _drive(board, draft, sizes, stride, _PUT_ON)
    # most moves end here: the whole is measured only where what is around promises enough
    hope = _hope(ground, draft, sizes) if is_sized else 0.0
    hope -= ground.weights[1] * _shortcut(board, draft, stride)
    if _gain(ground, draft, price, stretch_price) + hope >= threshold:
        if ground.rules.stretch_squares > 0:
            change[_EXCESS] += _excess_around(ground, board, draft)
        floor = sizes.area_m2[0]
        if is_sized:
            _find_lines(ground, draft, sizes)
            _resize_lines(ground, draft, sizes)
        if measure(ground, board, np.inf) > NO_VALUE:
            for figure in range(3):
                change[figure] = board.tally[figure] - tally[figure]
            gain = _gain(ground, draft, price, stretch_price) - sizes.price[0] * (sizes.area_m2[0] - floor)
            if gain >= threshold:
                copy_row(draft.hops, board.hops)
                _book(draft)
                return True
        copy_row(board.hops, draft.hops)
    if is_sized:
        _drive(board, draft, sizes, stride, _TAKEN_OFF)
    revert(board, draft)
    if is_sized:
        _drive(board, draft, sizes, stride, _PUT_ON)
        _resize_lines(ground, draft, sizes)
    return False


@compiled_inlined
def _try_side(
    ground: Ground, board: Board, draft: Draft, sizes: Sizes, random: NDArray[np.uint64], heat: float
) -> None:
    """Give a line along which no car drives another side, if that pays."""
    axis = below(random, np.int64(2))
    line = below(random, len(board.cells) // ground.stride if axis == 0 else ground.stride)
    side = sizes.free_mm[below(random, len(sizes.free_mm))]
    if not sizes.is_chosen[axis] or sizes.driven[axis, line] > 0 or side == sizes.kept_mm[axis, line]:
        return
    change = draft.change
    fitted = max(side, sizes.least_mm[axis, line])
    area = weigh(ground, board, sizes, axis, line, fitted)
    for figure in range(len(change)):
        change[figure] = sizes.change[figure] if figure < len(sizes.change) else 0
    if _gain(ground, draft, 0.0, 0.0) - sizes.price[0] * area >= heat * np.log(max(uniform(random), 1e-300)):
        sizes.kept_mm[axis, line] = side
        resize(ground, sizes, axis, line, fitted)
        _book(draft)
