"""Labels of lanes: driven through, or so many squares deep in a dead end. Compiled."""
# ruff: noqa: C901, PLR2004 - pruning in loops; numbers of neighbours

import numpy as np
from numpy.typing import NDArray

from garage2usd.compiled import compiled_inlined, compiled_inner
from garage2usd.planning.board import Board
from garage2usd.planning.draft import Draft
from garage2usd.planning.ground import Ground
from garage2usd.planning.survey import STRETCH, survey

__all__ = ["fault", "find_faults", "is_long", "label_lanes", "through", "trim"]


@compiled_inner
def label_lanes(ground: Ground, board: Board, draft: Draft) -> None:
    """Label the lanes on the board: short dead ends by their depth, all else as driven through."""
    cells, label, state, queue = board.cells, draft.label, board.state, draft.queue
    deepest = ground.rules.dead_end_squares
    survey(ground.squares, ground.stride, cells, state, board.queue, deepest, np.int64(0))
    for q in range(len(label)):
        label[q] = 0
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


@compiled_inner
def through(cells: NDArray[np.int8], label: NDArray[np.int8], stride: int, q: int) -> int:
    """How many neighbours of a square are portals or lanes that cars drive on through."""
    count = 0
    for step in (-stride, stride, -1, 1):
        count += cells[q + step] > 1 or label[q + step] == 1
    return count


@compiled_inner
def fault(cells: NDArray[np.int8], label: NDArray[np.int8], stride: int, q: int) -> int:
    """How far a lane is from what its label says."""
    passing = through(cells, label, stride, q)
    if label[q] == 1:
        return max(0, 2 - passing)
    if passing > 1:
        return 1  # cars drive on through it
    for step in (-stride, stride, -1, 1):
        p = q + step
        if 0 < label[p] < label[q] or cells[p] > 1:
            return 0
    return 1


@compiled_inner
def find_faults(ground: Ground, board: Board, draft: Draft) -> None:
    """List the lanes around which rules are broken, by the last survey and the labels."""
    cells, state, stride, rules = board.cells, board.state, ground.stride, ground.rules
    count = 0
    for q in ground.squares:
        if cells[q] == 1 and (
            state[q] < -rules.dead_end_squares
            or is_long(board, rules.stretch_squares, q)
            or fault(cells, draft.label, stride, q) > 0
            or (cells[q + 1] == 1 and cells[q + stride] == 1 and cells[q + stride + 1] == 1)
        ):
            draft.faulty[count] = q
            count += 1
    draft.size[3] = count


@compiled_inner
def is_long(board: Board, stretch_squares: int, q: int) -> bool:
    """Whether a square lay on a stretch that is too long at the last survey."""
    return bool(stretch_squares > 0 and board.state[q] > STRETCH + stretch_squares)


@compiled_inlined
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
