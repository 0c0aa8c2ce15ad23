"""Moves of the annealing under rules, drawn at random: squares, connectors, paths, runs and whole lines. Compiled."""
# ruff: noqa: C901, PLR0911, PLR0912, PLR2004, SIM110 - walks over squares; numbers of neighbours

import numpy as np
from numpy.typing import NDArray

from garage2usd.compiled import compiled_inlined, compiled_inner
from garage2usd.planning.archive import below, uniform
from garage2usd.planning.board import Board
from garage2usd.planning.draft import Draft, add_square
from garage2usd.planning.ground import Ground
from garage2usd.planning.labels import through

__all__ = ["propose"]

_OFF, _THROUGH, _TIP = np.int64(0), np.int64(1), np.int64(2)
"""Labels of squares: free, a lane that is driven through, the first lane of a dead end."""
# longest leg of a connector, share of bent ones, longest path taken out and longest run shifted: moves stay small, so
# that each is judged in a short time
_CONNECTOR, _BENT_SHARE, _PATH, _RUN = np.int64(6), 0.3, 20, 40
_FLIP, _RELABEL, _EXCHANGE, _PAIR, _CONNECT, _TAKE, _LINE = 0.38, 0.50, 0.68, 0.78, 0.88, 0.94, 0.97
"""Shares of the moves, each added to those before it; the rest are runs that shift. They hardly matter: the plans of
six sites of 20 x 30 have 1014.2 points on average with them, 1014.1 with equal shares, and 1012.0 without connectors,
paths, lines and runs."""
_THROUGH_SHARE, _ENDS_STAY_SHARE = 0.3, 0.3
"""How often a lane that could end is driven through, and a line that shifts leaves dead ends where it was: often enough
that both are tried. Not measured."""


@compiled_inner
def propose(ground: Ground, board: Board, draft: Draft, random: NDArray[np.uint64], faulty_share: float) -> bool:
    """Draw a move into the draft, some of them where rules are broken; False where what is drawn is not a move."""
    cells, stride = board.cells, ground.stride
    draft.size[0] = 0
    q = ground.squares[below(random, len(ground.squares))]
    step = (-stride, stride, -1, 1)[below(random, np.int64(4))]
    if draft.size[3] > 0 and uniform(random) < faulty_share:
        q = draft.faulty[below(random, draft.size[3])]
        for _ in range(below(random, np.int64(3))):
            q += (-stride, stride, -1, 1)[below(random, np.int64(4))]
            if cells[q] != 0 and cells[q] != 1:
                return False
    draw = uniform(random)
    if draw < _FLIP:
        return _flip(ground, board, draft, random, q)
    if draw < _RELABEL:
        return _relabel(ground, board, draft, random, q)
    if draw < _EXCHANGE:
        return _exchange(board, draft, q, q + step)
    if draw < _PAIR:
        return _flip_pair(ground, board, draft, random, q, q + step)
    if draw < _CONNECT:
        return bool(cells[q] == 1 and _connect(ground, board, draft, random, q, step))
    if draw < _TAKE:
        return _take_path(ground, board, draft, random, q)
    if draw < _LINE:
        return _shift_line(ground, board, draft, random, q, step)
    return _shift_run(ground, board, draft, q, step)


@compiled_inlined
def _new_label(ground: Ground, board: Board, draft: Draft, random: NDArray[np.uint64], q: int) -> int:
    """A label that suits a new lane on a square, mostly."""
    label, deepest = draft.label, ground.rules.dead_end_squares
    passing = through(board.cells, label, ground.stride, q)
    if passing >= 2 or deepest == 0 or uniform(random) < _THROUGH_SHARE:
        return 1
    if passing == 1:
        return 2
    least = 100
    for step in (-ground.stride, ground.stride, -1, 1):
        if label[q + step] > 0:
            least = min(least, label[q + step])
    return least + 1 if least <= deepest else 1


@compiled_inlined
def _flip(ground: Ground, board: Board, draft: Draft, random: NDArray[np.uint64], q: int) -> bool:
    """A lane goes, or a free square beside a lane becomes one."""
    if board.cells[q] == 1:
        return add_square(draft, q, _OFF)
    touched = False
    for step in (-ground.stride, ground.stride, -1, 1):
        touched |= board.cells[q + step] >= 1
    return touched and add_square(draft, q, _new_label(ground, board, draft, random, q))


@compiled_inlined
def _relabel(ground: Ground, board: Board, draft: Draft, random: NDArray[np.uint64], q: int) -> bool:
    """A lane gets another label."""
    if board.cells[q] != 1:
        return False
    fresh = 1 + below(random, ground.rules.dead_end_squares + 1)
    return fresh != draft.label[q] and add_square(draft, q, fresh)


@compiled_inlined
def _exchange(board: Board, draft: Draft, q: int, p: int) -> bool:
    """A lane moves to the free square beside it."""
    if board.cells[q] != 1 or board.cells[p] != 0:
        return False
    return add_square(draft, q, _OFF) and add_square(draft, p, np.int64(draft.label[q]))


@compiled_inlined
def _flip_pair(ground: Ground, board: Board, draft: Draft, random: NDArray[np.uint64], q: int, p: int) -> bool:
    """Two lanes side by side go, or two free squares become lanes that lead on or end."""
    cells, deepest = board.cells, ground.rules.dead_end_squares
    if cells[q] == 1 and cells[p] == 1:
        return add_square(draft, q, _OFF) and add_square(draft, p, _OFF)
    if cells[q] != 0 or cells[p] != 0 or through(cells, draft.label, ground.stride, q) == 0:
        return False
    ends = deepest >= 2 and uniform(random) < 0.5
    return add_square(draft, q, np.int64(2 if ends else 1)) and add_square(draft, p, np.int64(3 if ends else 1))


@compiled_inlined
def _take_path(ground: Ground, board: Board, draft: Draft, random: NDArray[np.uint64], q: int) -> bool:
    """The path between two junctions goes, but for dead ends beside these."""
    cells, label, stride, deepest = board.cells, draft.label, ground.stride, ground.rules.dead_end_squares
    if label[q] != 1 or through(cells, label, stride, q) != 2:
        return False
    add_square(draft, q, _OFF)
    lengths = draft.lengths
    lengths[0] = lengths[1] = 0
    for side in range(2):
        previous, here, found = q, q, 0
        for step in (-stride, stride, -1, 1):
            p = q + step
            if label[p] == 1 or cells[p] > 1:
                if found == side:
                    here = p
                found += 1
        while label[here] == 1 and through(cells, label, stride, here) == 2 and here != q and lengths[side] < _PATH:
            add_square(draft, here, _OFF)
            onward = here
            for step in (-stride, stride, -1, 1):
                p = here + step
                if p != previous and (label[p] == 1 or cells[p] > 1):
                    onward = p
            previous, here = here, onward
            lengths[side] += 1
        if lengths[side] >= _PATH or here == q or cells[here] > 1:
            return False
    last = draft.size[0] - 1
    for side in range(2):
        for place in range(min(below(random, deepest + 1), lengths[side])):
            draft.fresh[(last if side == 1 else lengths[0]) - place] = place + 2
    # dead ends that hang on the path go with it
    for index in range(draft.size[0]):
        if draft.fresh[index] == 0:
            for step in (-stride, stride, -1, 1):
                p = draft.moved[index] + step
                if label[p] > 1 and not _drop(ground, draft, p):
                    return False
    return True


@compiled_inlined
def _shift_run(ground: Ground, board: Board, draft: Draft, q: int, step: int) -> bool:
    """A straight run between two junctions shifts to the side."""
    cells, label, stride = board.cells, draft.label, ground.stride
    along = 1 if step in (-stride, stride) else stride
    if not _is_run(cells, label, stride, q, along):
        return False
    first, last, length = q, q, 1
    while length < _RUN and _is_run(cells, label, stride, first - along, along):
        first -= along
        length += 1
    while length < _RUN and _is_run(cells, label, stride, last + along, along):
        last += along
        length += 1
    if length < 2:
        return False
    for place in range(length):
        p = first + place * along
        if cells[p + step] != 0:
            return False
        add_square(draft, p, _OFF)
        add_square(draft, p + step, _THROUGH)
    return True


@compiled_inlined
def _connect(ground: Ground, board: Board, draft: Draft, random: NDArray[np.uint64], start: int, step: int) -> bool:
    """Lead a new lane from one on over free squares to the next lane, straight or with one bend."""
    cells, label, stride = board.cells, draft.label, ground.stride
    p, length = start + step, 0
    turn = 1 + below(random, _CONNECTOR) if uniform(random) < _BENT_SHARE else 0
    while cells[p] == 0 and length <= 2 * _CONNECTOR:
        if not add_square(draft, p, _THROUGH):
            return False
        length += 1
        if length == turn:
            sign = 1 if uniform(random) < 0.5 else -1
            step = sign * (stride if step in (-1, 1) else 1)
        p += step
    if length == 0 or length > 2 * _CONNECTOR or cells[p] != 1:
        return False
    for end in (start, p):
        if label[end] > 1 and not add_square(draft, end, _THROUGH):
            return False
    return True


@compiled_inlined
def _shift_line(ground: Ground, board: Board, draft: Draft, random: NDArray[np.uint64], start: int, step: int) -> bool:
    """Shift all lanes of a line along which cars drive to the side, with the ends of what they join."""
    cells, label, stride = board.cells, draft.label, ground.stride
    along = 1 if step in (-stride, stride) else stride
    if label[start] != 1 or not (label[start - along] == 1 or label[start + along] == 1):
        return False
    keeps_ends = ground.rules.dead_end_squares > 0 and uniform(random) < _ENDS_STAY_SHARE
    first, last = start, start
    while cells[first - along] >= 0 and cells[first - along] < 2:
        first -= along
    while cells[last + along] >= 0 and cells[last + along] < 2:
        last += along
    p = first
    while p != last + along:
        if label[p] == 1 and (label[p - along] == 1 or label[p + along] == 1):
            fresh = p + step
            if cells[fresh] == 0 and not add_square(draft, fresh, _THROUGH):
                return False
            if cells[fresh] < 0 or cells[fresh] > 1:
                p += along
                continue
            behind = p - step
            if label[behind] == 0 and cells[behind] <= 0:
                if cells[fresh] == 1 and keeps_ends:
                    if not add_square(draft, p, _TIP):
                        return False
                elif not add_square(draft, p, _OFF):
                    return False
        p += along
    return bool(draft.size[0] > 0)


@compiled_inner
def _is_run(cells: NDArray[np.int8], label: NDArray[np.int8], stride: int, q: int, side: int) -> bool:
    """Whether a lane has no lane or portal beside it across the direction `side`."""
    across = stride if side == 1 else 1
    return bool(label[q] == 1 and cells[q - across] <= 0 and cells[q + across] <= 0)


@compiled_inner
def _drop(ground: Ground, draft: Draft, q: int) -> bool:
    """Have a dead end and all that hangs on it go with the move."""
    for index in range(draft.size[0]):
        if draft.moved[index] == q:
            return True
    if not add_square(draft, q, _OFF):
        return False
    for step in (-ground.stride, ground.stride, -1, 1):
        if draft.label[q + step] > draft.label[q] and not _drop_leaf(draft, q + step):
            return False
    return True


@compiled_inner
def _drop_leaf(draft: Draft, q: int) -> bool:
    for index in range(draft.size[0]):
        if draft.moved[index] == q:
            return True
    return add_square(draft, q, _OFF)
