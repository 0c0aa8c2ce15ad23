"""Annealing of large plans that circulate: lanes carry labels, so that every rule is judged around a move. Compiled."""
# ruff: noqa: C901, PLR0911, PLR0912, PLR0915, PLR2004 - moves are judged in loops over shared counters

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.compiled import compiled
from garage2usd.planning.archive import below, uniform
from garage2usd.planning.board import FAR, FAULTS, NO_VALUE, Board, measure, stalls_at
from garage2usd.planning.ground import Ground
from garage2usd.planning.sizes import Sizes, driven_ways, floor_cost, foresee, resize, settle, side_now, sync, weigh
from garage2usd.planning.survey import STRETCH, survey

__all__ = ["Draft", "anneal_labels", "new_draft", "trim"]

_MOVED = 400
_SEARCHED = 800
_CONNECTOR, _BENT_SHARE, _PATH, _RUN = 6, 0.3, 20, 40
_RESIZED, _FAULTY_SHARE, _FAULTY_SHARE_AT_LAST, _LAST_PRICES = 0.02, 0.25, 0.9, 10.0
_N, _TIME, _UNUSED, _BAD, _BLOCKS, _EXCESS = 0, 1, 2, 3, 4, 5


class Draft(NamedTuple):
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
    lines
        int64, shape (K, 2): axis and number of the lines that get another side by a move.
    size
        int64, shape (4,): how many squares are moved, how many are around, how many lines get another side, and how
        many squares are faulty.
    tally
        int64, shape (6,): stalls, time, unused squares, faults of labels, blocks, squares too long.
    change
        int64, shape (6,): what a move adds to them.
    """

    label: NDArray[np.int8]
    stamp: NDArray[np.int64]
    marks: NDArray[np.int64]
    moved: NDArray[np.int64]
    around: NDArray[np.int64]
    queue: NDArray[np.int64]
    faulty: NDArray[np.int64]
    fresh: NDArray[np.int8]
    old: NDArray[np.int8]
    old_hops: NDArray[np.int32]
    lines: NDArray[np.int64]
    size: NDArray[np.int64]
    tally: NDArray[np.int64]
    change: NDArray[np.int64]


def new_draft(ground: Ground) -> Draft:
    """Room for labels on a ground."""
    size = len(ground.cells)
    return Draft(
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
        np.zeros((10 * _MOVED, 2), np.int64),
        np.zeros(4, np.int64),
        np.zeros(6, np.int64),
        np.zeros(6, np.int64),
    )


@compiled
def _label_lanes(ground: Ground, board: Board, draft: Draft) -> None:
    """Label the lanes on the board: short dead ends by their depth, all else as driven through."""
    cells, label, state, queue = board.cells, draft.label, board.state, draft.queue
    deepest = ground.rules.dead_end_squares
    survey(ground.squares, ground.stride, cells, state, board.queue, deepest, 0)
    label[:] = 0
    for q in ground.squares:
        if cells[q] == 1:
            label[q] = 1
    tail = 0
    for q in ground.squares:
        if cells[q] == 1 and -deepest <= state[q] < 0:
            for step in (-ground.stride, ground.stride, -1, 1):
                p = q + step
                if cells[p] > 1 or (cells[p] == 1 and (state[p] >= 2 or state[p] < -deepest)):
                    label[q] = 2
            if label[q] == 2:
                queue[tail] = q
                tail += 1
    head = 0
    while head < tail:
        q = queue[head]
        head += 1
        for step in (-ground.stride, ground.stride, -1, 1):
            p = q + step
            if cells[p] == 1 and label[p] == 1 and state[p] < 0 and state[p] > state[q]:
                label[p] = label[q] + 1
                queue[tail] = p
                tail += 1


@compiled
def _through(cells: NDArray[np.int8], label: NDArray[np.int8], stride: int, q: int) -> int:
    """How many neighbours of a square are portals or lanes that cars drive on through."""
    count = 0
    for step in (-stride, stride, -1, 1):
        count += cells[q + step] > 1 or label[q + step] == 1
    return count


@compiled
def _fault(cells: NDArray[np.int8], label: NDArray[np.int8], stride: int, q: int) -> int:
    """How far a lane is from what its label says."""
    through = _through(cells, label, stride, q)
    if label[q] == 1:
        return max(0, 2 - through)
    if through > 1:
        return 1  # cars drive on through it
    for step in (-stride, stride, -1, 1):
        p = q + step
        if 0 < label[p] < label[q] or cells[p] > 1:
            return 0
    return 1


@compiled
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


@compiled
def _count(ground: Ground, board: Board, draft: Draft, sign: int) -> None:
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
            change[_BAD] += sign * _fault(cells, draft.label, stride, x)
    change[_BLOCKS] += sign * _blocks_at(cells, draft, stride)


@compiled
def _excess_around(ground: Ground, board: Board, draft: Draft) -> int:
    """Squares by which the stretches around a move are too long."""
    cells, label, stride, queue = board.cells, draft.label, ground.stride, draft.queue
    limit, excess = ground.rules.stretch_squares, 0
    draft.marks[2] += 1
    mark, stamp = draft.marks[2], draft.stamp
    for index in range(draft.size[1]):
        first = draft.around[index]
        if label[first] != 1 or stamp[2, first] == mark or _through(cells, label, stride, first) != 2:
            continue
        stamp[2, first] = mark
        queue[0] = first
        head, tail = 0, 1
        while head < tail:
            q = queue[head]
            head += 1
            for step in (-stride, stride, -1, 1):
                p = q + step
                if label[p] == 1 and stamp[2, p] != mark and _through(cells, label, stride, p) == 2:
                    stamp[2, p] = mark
                    queue[tail] = p
                    tail += 1
        excess += max(0, tail - limit)
    return excess


@compiled
def _add(draft: Draft, q: int, label: int) -> bool:
    """Have a square in the move; False if there is no room for it."""
    if draft.size[0] >= _MOVED:
        return False
    draft.moved[draft.size[0]] = q
    draft.fresh[draft.size[0]] = label
    draft.size[0] += 1
    return True


@compiled
def _gather(draft: Draft, stride: int) -> None:
    """Find the squares that a move may touch."""
    draft.marks[0] += 1
    mark, stamp, size = draft.marks[0], draft.stamp, 0
    for index in range(draft.size[0]):
        q = draft.moved[index]
        for step in (0, -stride, stride, -1, 1):
            if stamp[0, q + step] != mark:
                stamp[0, q + step] = mark
                draft.around[size] = q + step
                size += 1
    draft.size[1] = size


@compiled
def _apply(ground: Ground, board: Board, draft: Draft) -> None:
    """Make the move; new lanes get their hops from what is around."""
    cells, hops, label, stride = board.cells, board.hops, draft.label, ground.stride
    for index in range(draft.size[0]):
        q = draft.moved[index]
        draft.old[index], draft.old_hops[index] = label[q], hops[q]
        label[q] = draft.fresh[index]
        was_lane = cells[q] == 1
        cells[q] = 1 if draft.fresh[index] > 0 else 0
        if not was_lane or cells[q] == 0:
            hops[q] = FAR
    for turn in range(2):
        for place in range(draft.size[0]):
            index = place if turn == 0 else draft.size[0] - 1 - place
            q = draft.moved[index]
            if cells[q] == 1 and draft.old[index] == 0:
                for step in (-stride, stride, -1, 1):
                    p = q + step
                    if cells[p] == 1:
                        hops[q] = min(hops[q], hops[p] + 1)
                    elif cells[p] == 2:
                        hops[q] = 1


@compiled
def _revert(board: Board, draft: Draft) -> None:
    """Take the move back."""
    for index in range(draft.size[0] - 1, -1, -1):
        q = draft.moved[index]
        draft.label[q], board.hops[q] = draft.old[index], draft.old_hops[index]
        board.cells[q] = 1 if draft.old[index] > 0 else 0


@compiled
def _drive(board: Board, draft: Draft, sizes: Sizes, stride: int, sign: int) -> None:
    """Count where cars drive around a move into the lines, or take it off."""
    for index in range(draft.size[1]):
        q = draft.around[index]
        if board.cells[q] >= 1:
            ways = driven_ways(board.cells, stride, q)
            sizes.driven[0, q // stride] += sign * (ways & 1)
            sizes.driven[1, q % stride] += sign * (ways >> 1)


@compiled
def _weigh_lines(ground: Ground, board: Board, draft: Draft, sizes: Sizes) -> float:
    """Find the lines around a move that get another side by it, and what that changes; returns the floor added in m2.

    Each line is weighed alone; where two of them cross, the next measurement of the whole sets it right.
    """
    draft.size[2] = 0
    area = 0.0
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
                area += weigh(ground, board, sizes, axis, line, side_now(sizes, axis, line), draft.change)
    return area


@compiled
def _resize_lines(ground: Ground, draft: Draft, sizes: Sizes) -> None:
    """Give the lines that a move has weighed their new sides."""
    for place in range(draft.size[2]):
        axis, line = draft.lines[place]
        resize(ground, sizes, axis, line, side_now(sizes, axis, line))


@compiled
def _joined(ground: Ground, board: Board, draft: Draft) -> int:
    """Whether the lanes still form one piece after the move: 1 yes, 0 no, -1 if the search would take too long."""
    cells, stride, queue = board.cells, ground.stride, draft.queue
    draft.marks[2] += 1
    wanted = draft.marks[2]
    draft.marks[2] += 1
    seen, stamp = draft.marks[2], draft.stamp
    removed, count, first = False, 0, -1
    for index in range(draft.size[0]):
        q = draft.moved[index]
        if cells[q] == 1:
            if draft.old[index] == 0 and stamp[2, q] != wanted:
                stamp[2, q] = wanted
                count += 1
                first = q
            continue
        if draft.old[index] > 0:
            removed = True
            for step in (-stride, stride, -1, 1):
                p = q + step
                if cells[p] == 1 and stamp[2, p] != wanted:
                    stamp[2, p] = wanted
                    count += 1
                    first = p
                elif cells[p] > 1:
                    touched = False
                    for other in (-stride, stride, -1, 1):
                        touched |= cells[p + other] == 1
                    if not touched:
                        return 0
    if first < 0:
        return 0 if removed else 1
    if not removed:
        # new lanes alone: one that is old must touch them
        is_new_alone = True
        for index in range(draft.size[0]):
            q = draft.moved[index]
            for step in (-stride, stride, -1, 1):
                p = q + step
                if cells[p] == 1 and stamp[2, p] != wanted:
                    stamp[2, p] = wanted
                    count += 1
                    first = p
                    is_new_alone = False
                    break
        if is_new_alone:
            return 0
    stamp[2, first] = seen
    queue[0] = first
    head, tail, found = 0, 1, 1
    while head < tail and found < count:
        if head >= _SEARCHED:
            return -1
        q = queue[head]
        head += 1
        for step in (-stride, stride, -1, 1):
            p = q + step
            if cells[p] == 1 and stamp[2, p] != seen:
                found += stamp[2, p] == wanted
                stamp[2, p] = seen
                queue[tail] = p
                tail += 1
    if found < count:
        return 0
    return 1 if removed or tail > 1 else 0


@compiled
def _new_label(ground: Ground, board: Board, draft: Draft, random: NDArray[np.uint64], q: int) -> int:
    """A label that suits a new lane on a square, mostly."""
    cells, label, stride = board.cells, draft.label, ground.stride
    deepest = ground.rules.dead_end_squares
    through = _through(cells, label, stride, q)
    if through >= 2 or deepest == 0:
        return 1
    if uniform(random) < 0.3:
        return 1
    if through == 1:
        return 2
    least = 100
    for step in (-stride, stride, -1, 1):
        if label[q + step] > 0:
            least = min(least, label[q + step])
    return least + 1 if least <= deepest else 1


@compiled
def _propose(ground: Ground, board: Board, draft: Draft, random: NDArray[np.uint64], faulty_share: float) -> int:
    """Draw a move into the draft, some of them where rules are broken; its kind, or -1 if what was drawn is no move."""
    cells, label, stride = board.cells, draft.label, ground.stride
    deepest = ground.rules.dead_end_squares
    draft.size[0] = 0
    q = ground.squares[below(random, len(ground.squares))]
    step = (-stride, stride, -1, 1)[below(random, 4)]
    if draft.size[3] > 0 and uniform(random) < faulty_share:
        q = draft.faulty[below(random, draft.size[3])]
        for _ in range(below(random, 3)):
            q += (-stride, stride, -1, 1)[below(random, 4)]
            if cells[q] != 0 and cells[q] != 1:
                return -1
    draw = uniform(random)
    if draw < 0.38:  # one square
        if cells[q] == 1:
            _add(draft, q, 0)
        else:
            if _through(cells, label, stride, q) == 0:
                touched = False
                for other in (-stride, stride, -1, 1):
                    touched |= label[q + other] > 0
                if not touched:
                    return -1
            _add(draft, q, _new_label(ground, board, draft, random, q))
        return 0
    if draw < 0.50:  # another label
        if cells[q] != 1 or deepest == 0:
            return -1
        fresh = 1 + below(random, deepest + 1)
        if fresh == label[q]:
            return -1
        _add(draft, q, fresh)
        return 1
    if draw < 0.68:  # a lane moves to the square beside it
        p = q + step
        if cells[q] != 1 or cells[p] != 0:
            return -1
        _add(draft, q, 0)
        _add(draft, p, label[q])
        return 2
    if draw < 0.78:  # two squares at once
        p = q + step
        if cells[q] == 1 and cells[p] == 1:
            _add(draft, q, 0)
            _add(draft, p, 0)
            return 3
        if cells[q] == 0 and cells[p] == 0 and _through(cells, label, stride, q) > 0:
            kind = 1 if uniform(random) < 0.5 or deepest < 2 else 2
            _add(draft, q, kind)
            _add(draft, p, 1 if kind == 1 else 3)
            return 3
        return -1
    if draw < 0.88:  # a connector to the next lane straight on
        if cells[q] != 1:
            return -1
        return _connect(ground, board, draft, random, q, step)
    if draw < 0.94:  # a path between two junctions goes, but for dead ends
        if label[q] != 1 or _through(cells, label, stride, q) != 2:
            return -1
        ends = np.zeros(2, np.int64)
        _add(draft, q, 0)
        for side in range(2):
            previous, here, found = q, q, 0
            for other in (-stride, stride, -1, 1):
                p = q + other
                if label[p] == 1 or cells[p] > 1:
                    if found == side:
                        here = p
                    found += 1
            length = 0
            first = draft.size[0]
            while label[here] == 1 and _through(cells, label, stride, here) == 2 and here != q and length < _PATH:
                _add(draft, here, 0)
                onward = here
                for other in (-stride, stride, -1, 1):
                    p = here + other
                    if p != previous and (label[p] == 1 or cells[p] > 1):
                        onward = p
                previous, here = here, onward
                length += 1
            if length >= _PATH or here == q or cells[here] > 1:
                return -1
            ends[side] = draft.size[0] - first
        if deepest > 0:
            # the last squares before the junctions may stay as dead ends
            end = draft.size[0]
            for side in range(2):
                stay = min(below(random, deepest + 1), ends[side])
                last = end - 1 if side == 1 else ends[0]
                for place in range(stay):
                    draft.fresh[last - place] = place + 2
        # dead ends that hang on the path go with it
        for index in range(draft.size[0]):
            if draft.fresh[index] == 0:
                for other in (-stride, stride, -1, 1):
                    p = draft.moved[index] + other
                    if label[p] > 1 and not _drop(ground, draft, p):
                        return -1
        return 5
    if draw < 0.97:
        return _shift_line(ground, board, draft, random, q, step)
    # a straight run shifts to the side
    if label[q] != 1:
        return -1
    side = 1 if step in (-stride, stride) else stride
    first, length = q, 0
    while label[first - side] == 1 and length < _RUN and _is_run(cells, label, stride, first - side, side):
        first -= side
        length += 1
    if not _is_run(cells, label, stride, q, side):
        return -1
    last = q
    while label[last + side] == 1 and length < _RUN and _is_run(cells, label, stride, last + side, side):
        last += side
        length += 1
    if length < 1 or 2 * (length + 1) > _MOVED:
        return -1
    p = first
    while p != last + side:
        if cells[p + step] != 0:
            return -1
        _add(draft, p, 0)
        p += side
    p = first
    while p != last + side:
        _add(draft, p + step, 1)
        p += side
    return 6


@compiled
def _connect(ground: Ground, board: Board, draft: Draft, random: NDArray[np.uint64], start: int, step: int) -> int:
    """Lead a new lane from one on over free squares to the next lane, straight or with one bend."""
    cells, label, stride = board.cells, draft.label, ground.stride
    p, length = start + step, 0
    turn = 1 + below(random, _CONNECTOR) if uniform(random) < _BENT_SHARE else 0
    while cells[p] == 0 and length <= 2 * _CONNECTOR:
        if not _add(draft, p, 1):
            return -1
        length += 1
        if length == turn:
            sign = 1 if uniform(random) < 0.5 else -1
            step = sign * (stride if step in (-1, 1) else 1)
        p += step
    if length == 0 or length > 2 * _CONNECTOR or cells[p] != 1:
        return -1
    for end in (start, p):
        if label[end] > 1 and not _add(draft, end, 1):
            return -1
    return 4


@compiled
def _shift_line(ground: Ground, board: Board, draft: Draft, random: NDArray[np.uint64], start: int, step: int) -> int:
    """Shift all lanes of a line along which cars drive to the side, with the ends of what they join."""
    cells, label, stride = board.cells, draft.label, ground.stride
    along = 1 if step in (-stride, stride) else stride
    if label[start] != 1 or not (label[start - along] == 1 or label[start + along] == 1):
        return -1
    keeps_ends = ground.rules.dead_end_squares > 0 and uniform(random) < 0.3
    first, last = start, start
    while cells[first - along] >= 0 and cells[first - along] < 2:
        first -= along
    while cells[last + along] >= 0 and cells[last + along] < 2:
        last += along
    p = first
    while p != last + along:
        if label[p] == 1 and (label[p - along] == 1 or label[p + along] == 1):
            fresh = p + step
            if cells[fresh] == 0 and not _add(draft, fresh, 1):
                return -1
            if cells[fresh] < 0 or cells[fresh] > 1:
                p += along
                continue
            behind = p - step
            if label[behind] == 0 and cells[behind] <= 0:
                if cells[fresh] == 1 and keeps_ends:
                    if not _add(draft, p, 2):
                        return -1
                elif not _add(draft, p, 0):
                    return -1
        p += along
    return 7 if draft.size[0] > 0 else -1


@compiled
def _is_run(cells: NDArray[np.int8], label: NDArray[np.int8], stride: int, q: int, side: int) -> bool:
    """Whether a lane has no lane or portal beside it across the direction `side`."""
    across = stride if side == 1 else 1
    return bool(label[q] == 1 and cells[q - across] <= 0 and cells[q + across] <= 0)


@compiled
def _drop(ground: Ground, draft: Draft, q: int) -> bool:
    """Have a dead end and all that hangs on it go with the move."""
    for index in range(draft.size[0]):
        if draft.moved[index] == q:
            return True
    if not _add(draft, q, 0):
        return False
    for step in (-ground.stride, ground.stride, -1, 1):
        if draft.label[q + step] > draft.label[q] and not _drop_leaf(draft, q + step):
            return False
    return True


@compiled
def _drop_leaf(draft: Draft, q: int) -> bool:
    for index in range(draft.size[0]):
        if draft.moved[index] == q:
            return True
    return _add(draft, q, 0)


@compiled
def trim(ground: Ground, board: Board) -> None:
    """Take off the tips of all dead ends that are too deep, until none is."""
    cells, rules = board.cells, ground.rules
    while True:
        found = survey(
            ground.squares,
            ground.stride,
            cells,
            board.state,
            board.queue,
            rules.dead_end_squares,
            rules.stretch_squares,
        )
        if found.deep == 0:
            return
        # tips of the trees that have deep lanes: those from which a walk to the root meets one
        for q in ground.squares:
            if cells[q] == 1 and board.state[q] == -1:
                here, depth = q, 1
                onward = True
                while onward and depth <= rules.dead_end_squares:
                    onward = False
                    for step in (-ground.stride, ground.stride, -1, 1):
                        p = here + step
                        if cells[p] == 1 and board.state[p] < board.state[here]:
                            here = p
                            depth += 1
                            onward = True
                            break
                if board.state[here] < -rules.dead_end_squares:
                    cells[q] = 0


@compiled
def _find_faults(ground: Ground, board: Board, draft: Draft) -> None:
    """List the lanes around which rules are broken, by the last survey and the labels."""
    cells, state, stride, rules = board.cells, board.state, ground.stride, ground.rules
    count = 0
    for q in ground.squares:
        if cells[q] == 1 and (
            state[q] < -rules.dead_end_squares
            or _is_long(board, rules.stretch_squares, q)
            or _fault(cells, draft.label, stride, q) > 0
            or (cells[q + 1] == 1 and cells[q + stride] == 1 and cells[q + stride + 1] == 1)
        ):
            draft.faulty[count] = q
            count += 1
    draft.size[3] = count


@compiled
def _is_long(board: Board, stretch_squares: int, q: int) -> bool:
    """Whether a square lay on a stretch that is too long at the last survey."""
    return bool(stretch_squares > 0 and board.state[q] > STRETCH + stretch_squares)


@compiled
def _touches_long(board: Board, draft: Draft, stretch_squares: int) -> bool:
    """Whether there is such a square around a move."""
    for index in range(draft.size[1]):
        if draft.label[draft.around[index]] > 0 and _is_long(board, stretch_squares, draft.around[index]):
            return True
    return False


@compiled
def _tally(ground: Ground, board: Board, draft: Draft, sizes: Sizes) -> float:
    """Measure the whole board into the draft's tally; its value less that of the floor, NO_VALUE if infeasible."""
    sync(ground, board, sizes)
    exact = measure(ground, board)
    if exact == NO_VALUE:
        return NO_VALUE
    tally = draft.tally
    tally[_N], tally[_TIME], tally[_UNUSED] = board.tally[0], board.tally[1], board.tally[2]
    if sizes.is_chosen[0] or sizes.is_chosen[1]:
        foresee(ground, board, sizes)
    return exact - floor_cost(sizes)


@compiled
def _gain(ground: Ground, draft: Draft, price: float, stretch_price: float) -> float:
    """What a move adds to the value, less the price of the faults that it adds; very little if no stall is left."""
    change, tally, weights = draft.change, draft.tally, ground.weights
    stalls = tally[_N] + change[_N]
    if stalls <= 0:
        return NO_VALUE
    gain = weights[0] * change[_N] + weights[2] * change[_UNUSED]
    gain += weights[1] * ((tally[_TIME] + change[_TIME]) / stalls - tally[_TIME] / max(1, tally[_N]))
    return float(gain - price * (change[_BAD] + change[_BLOCKS]) - stretch_price * change[_EXCESS])


@compiled
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


@compiled
def anneal_labels(
    ground: Ground,
    board: Board,
    draft: Draft,
    sizes: Sizes,
    random: NDArray[np.uint64],
    trials: int,
    heats: tuple[float, float],
    prices: tuple[float, float, float, float],
    refresh: int,
) -> float:
    """Anneal the feasible lanes in `board.cells` under the rules; leaves the best that keeps them, returns its value.

    Parameters
    ----------
    ground, board, draft, sizes
        The site, its lanes, room for labels, and the sides of the squares.
    random
        State of the random numbers.
    trials
        Moves to try, and as many more as it takes to keep the rules, at most the same again.
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
    the stretches that it touches. T_S is followed by the distances of the last measurement.
    """
    cells, tally, change, rules = board.cells, draft.tally, draft.change, ground.rules
    best_faults = np.int64(1 << 30)
    best, best_cells, copy = NO_VALUE, cells.copy(), cells.copy()
    cooling = (heats[1] / heats[0]) ** (1.0 / max(1, trials))
    pricing = (prices[1] / prices[0]) ** (1.0 / max(1, trials))
    heat, price, stretch_price = heats[0], prices[0], prices[2]
    stretch_pricing = (prices[3] / prices[2]) ** (1.0 / max(1, trials))
    is_sized = sizes.is_chosen[0] or sizes.is_chosen[1]
    _label_lanes(ground, board, draft)
    if is_sized:
        sync(ground, board, sizes)
        measure(ground, board)
        settle(ground, board, sizes, 2)
    _tally(ground, board, draft, sizes)
    _find_faults(ground, board, draft)
    changed = 1
    faulty_share = _FAULTY_SHARE
    for trial in range(2 * trials + 1):
        if trial == trials:
            faulty_share, refresh = _FAULTY_SHARE_AT_LAST, max(1, refresh // 8)
            price, stretch_price = _LAST_PRICES * price, _LAST_PRICES * stretch_price
        if trial == trials or (trial % refresh == refresh - 1 and changed > 0):
            changed = 0
            copy[:] = cells
            if rules.is_asked:
                trim(ground, board)
            measured = _tally(ground, board, draft, sizes)
            faults = board.tally[FAULTS]
            if faults < best_faults or (faults == best_faults and measured > best):
                best, best_faults = measured, faults
                best_cells[:] = cells
            cells[:] = copy
            # moves leave labels that are sound but not what pruning says: loops of dead ends
            _label_lanes(ground, board, draft)
            _tally(ground, board, draft, sizes)
            _find_faults(ground, board, draft)
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
        kind = _propose(ground, board, draft, random, faulty_share)
        if kind < 0:
            continue
        _gather(draft, ground.stride)
        change[:] = 0
        _count(ground, board, draft, -1)
        if _touches_long(board, draft, rules.stretch_squares):
            change[_EXCESS] -= _excess_around(ground, board, draft)
        floor = 0.0
        if is_sized:
            _drive(board, draft, sizes, ground.stride, -1)
        _apply(ground, board, draft)
        _count(ground, board, draft, 1)
        if is_sized:
            _drive(board, draft, sizes, ground.stride, 1)
        accepted = False
        threshold = heat * np.log(max(uniform(random), 1e-300))
        draft.size[2] = 0
        # what costs least time to know first: most moves end here
        hope = _hope(ground, draft, sizes) if is_sized else 0.0
        if _gain(ground, draft, price, stretch_price) + hope >= threshold:
            if rules.stretch_squares > 0:
                change[_EXCESS] += _excess_around(ground, board, draft)
            if is_sized:
                floor = _weigh_lines(ground, board, draft, sizes)
            gain = _gain(ground, draft, price, stretch_price) - sizes.price[0] * floor
            accepted = gain >= threshold and _joined(ground, board, draft) == 1
        if accepted:
            changed += 1
            if is_sized:
                _resize_lines(ground, draft, sizes)
            tally[:3] += change[:3]
            if kind >= 5:  # distances change far around
                changed = 0
                _tally(ground, board, draft, sizes)
        else:
            if is_sized:
                _drive(board, draft, sizes, ground.stride, -1)
            _revert(board, draft)
            if is_sized:
                _drive(board, draft, sizes, ground.stride, 1)
    cells[:] = best_cells
    return _tally(ground, board, draft, sizes)


@compiled
def _try_side(
    ground: Ground, board: Board, draft: Draft, sizes: Sizes, random: NDArray[np.uint64], heat: float
) -> None:
    """Give a line along which no car drives another side, if that pays."""
    axis = below(random, 2)
    line = below(random, len(board.cells) // ground.stride if axis == 0 else ground.stride)
    side = sizes.free_mm[below(random, len(sizes.free_mm))]
    if not sizes.is_chosen[axis] or sizes.driven[axis, line] > 0 or side == sizes.kept_mm[axis, line]:
        return
    change, tally = draft.change, draft.tally
    change[:] = 0
    fitted = max(side, sizes.least_mm[axis, line])
    area = weigh(ground, board, sizes, axis, line, fitted, change)
    if _gain(ground, draft, 0.0, 0.0) - sizes.price[0] * area >= heat * np.log(max(uniform(random), 1e-300)):
        sizes.kept_mm[axis, line] = side
        resize(ground, sizes, axis, line, fitted)
        tally[:3] += change[:3]
