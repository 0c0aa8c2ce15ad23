"""The broken profile between squares that are decided and squares to come, and its step by one square. Compiled.

What the squares decided so far mean for the rest is kept for the last square of each column only, the frontier: a few
bits each, in one number. Under the rules of circulation each lane is labelled: core, on which one drives on through,
or stub of a depth, in a dead end so many squares from the core.
"""
# ruff: noqa: C901, PLR0911, PLR0912, PLR0915, PLR2004 - bit fields and loops that numba flattens

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.compiled import compiled

__all__ = ["FORBIDDEN", "SquareTable", "column_bits", "complete", "first_frontier", "step"]

FORBIDDEN = -1.0e18

# codes of a column: 0 nothing to come, 1 a portal that touches no lane yet, 2 + edges a free square, edges being the
# sum of 1 up, 2 left, 4 right that are open, from 10 on a lane, by its piece and within a piece by its type
_PORTAL, _FREE, _LANE = 1, 2, 10
# columns share 60 bits of a frontier; above them: the lanes are complete; they have a loop, or need none; the square up
# and left of the next one is a lane in a corner that may become a block
_ALL_BITS = 60
_FINISHED, _LOOPED, _CORNER = 1 << 60, 1 << 61, 1 << 62


class SquareTable(NamedTuple):
    """What a square is and what it brings.

    Attributes
    ----------
    cols
        Columns; square ``i`` is in row ``i // cols``.
    bits
        Bits of a column in a frontier.
    depth
        R1: deepest stub; -1 where no rule is asked for.
    kinds
        int8, shape (rows * cols,): values of `garage2usd.structure.grid.Cell`.
    portals
        int64, shape (rows * cols,): portals beside the square.
    worth
        float64, shape (rows * cols, 16): relaxed contribution of a free square by its open edges (`Ground.capacity`).
    asks_loop
        R2: whether there is to be a loop.
    """

    cols: int
    bits: int
    depth: int
    kinds: NDArray[np.int8]
    portals: NDArray[np.int64]
    worth: NDArray[np.float64]
    asks_loop: bool


def column_bits(cols: int, depth: int) -> int:
    """Bits that a column of a frontier has; 0 if these are too few for its codes."""
    types = 1 if depth < 0 else 3 + 2 * depth
    bits = min(_ALL_BITS // max(cols, 1), 16)
    return bits if _LANE + types * ((cols + 1) // 2) <= 1 << bits else 0


@compiled
def _mask(edges: int) -> int:
    """Edges of a code as in `Ground.capacity`."""
    return (edges & 1) | ((edges & 2) << 1) | ((edges & 4) << 1)


@compiled
def _is_free(table: SquareTable, index: int) -> bool:
    return index < len(table.kinds) and table.kinds[index] == 0


@compiled
def _settled(table: SquareTable, index: int, edges: int) -> int:
    """Code of a free square of which only the lower edge is still to come; one for all that gain the same."""
    if not _is_free(table, index + table.cols):
        return 0
    gain = table.worth[index, _mask(edges) | 2] - table.worth[index, _mask(edges)]
    if abs(gain) < 1e-12:
        return 0
    for other in range(edges):
        if abs(table.worth[index, _mask(other) | 2] - table.worth[index, _mask(other)] - gain) < 1e-12:
            return _FREE + other
    return _FREE + edges


# types of a lane: 0, 1, 2 core that needs so many more neighbours of the core; 1 + 2 d a stub of depth d that has met
# no lane of depth d - 1 yet, 2 + 2 d one that has; the core has depth 0
@compiled
def _depth_of(kind: int) -> int:
    return 0 if kind < 3 else (kind - 1) // 2


@compiled
def _needs(kind: int) -> int:
    """How many more neighbours a lane needs."""
    return kind if kind < 3 else kind & 1


@compiled
def _met(kind: int, depth: int) -> int:
    """The type of a lane after it has met one of a depth; -1 if such may not be neighbours."""
    own = _depth_of(kind)
    if depth == own + 1:
        return kind
    if own == 0:
        return max(0, kind - 1) if depth == 0 else -1
    return kind + 1 if depth == own - 1 and kind & 1 else -1


def first_frontier(table: SquareTable) -> int:
    """The frontier before the first square."""
    return 0 if table.asks_loop else _LOOPED


@compiled
def step(
    table: SquareTable,
    index: int,
    key: int,
    choice: int,
    room: NDArray[np.int64],
) -> tuple[int, float]:
    """The frontier after one more square, and what it adds; `FORBIDDEN` if no feasible layout goes that way.

    Parameters
    ----------
    table
        The site.
    index
        The square.
    key
        The frontier before it.
    choice
        0 not a lane, 1 a lane of the core, 1 + d a stub of depth d.
    room
        int64, shape (3, 2 + columns): for codes, pieces and names of pieces.

    Notes
    -----
    The labels are sound where each lane of the core has two neighbours that are core or portals, and each stub of
    depth d one neighbour of depth d - 1, no portal, and else neighbours of depth d + 1. Then pruning takes off the
    stubs and nothing else, so that each layout that keeps R1 has exactly one labelling, and others have none. A lane
    that joins two of the same piece closes a loop (R2); one that fills a block of two by two is forbidden (R3).
    """
    cols, bits = table.cols, table.bits
    typed = table.depth >= 0
    types = 3 + 2 * table.depth if typed else 1
    col, lane, depth = index % cols, choice > 0, choice - 1
    flags = key & (_FINISHED | _LOOPED)
    if lane and (table.kinds[index] != 0 or flags & _FINISHED != 0):
        return 0, FORBIDDEN
    codes, pieces, names = room[0], room[1], room[2]
    full = (1 << bits) - 1
    for c in range(cols):
        code = (key >> (bits * c)) & full
        piece = 0
        if code >= _LANE:
            piece = 1 + (code - _LANE) // types
            code = _LANE + (code - _LANE) % types
        codes[c], pieces[c] = code, piece
    up, up_piece, left, left_piece = codes[col], pieces[col], 0, 0
    if col > 0:
        left, left_piece = codes[col - 1], pieces[col - 1]
    if lane and typed and up_piece > 0 and left_piece > 0 and key & _CORNER != 0:
        return 0, FORBIDDEN
    kind = 0
    if lane and typed:
        kind = max(0, 2 - table.portals[index]) if depth == 0 else 1 + 2 * depth
        if depth > 0 and table.portals[index] > 0:
            return 0, FORBIDDEN
    gain = 0.0
    # the square above is complete
    if up == _PORTAL and not lane:
        return 0, FORBIDDEN
    if lane and _FREE <= up < _LANE:
        mask = _mask(up - _FREE)
        gain += table.worth[index - cols, mask | 2] - table.worth[index - cols, mask]
    if up_piece > 0:
        other = up - _LANE
        if lane:
            kind, other = _met(kind, _depth_of(other)), _met(other, depth)
            if kind < 0 or other < 0:
                return 0, FORBIDDEN
        if _needs(other) > 0:
            return 0, FORBIDDEN
        if not lane:
            codes[col], pieces[col] = 0, 0
            alone, others = True, False
            for c in range(cols):
                alone &= pieces[c] != up_piece
                others |= pieces[c] > 0 and pieces[c] != up_piece
            if alone:
                if others or flags & _LOOPED == 0:
                    return 0, FORBIDDEN
                flags |= _FINISHED
    # the right edge of the square to the left is decided
    if left == _PORTAL and lane:
        codes[col - 1] = 0
    elif left_piece > 0:
        other = left - _LANE
        if lane:
            kind, other = _met(kind, _depth_of(other)), _met(other, depth)
            if kind < 0 or other < 0:
                return 0, FORBIDDEN
        if _needs(other) > int(_is_free(table, index - 1 + cols)):
            return 0, FORBIDDEN
        codes[col - 1] = _LANE + other
    elif left >= _FREE:
        edges = left - _FREE
        if lane:
            gain += table.worth[index - 1, _mask(edges | 4)] - table.worth[index - 1, _mask(edges)]
            edges |= 4
        codes[col - 1] = _settled(table, index - 1, edges)
    # this square
    has_right = col < cols - 1 and table.kinds[index + 1] == 0
    corner = 0
    if lane:
        if _needs(kind) > int(has_right) + int(_is_free(table, index + cols)):
            return 0, FORBIDDEN
        piece = cols + 1
        if up_piece > 0:
            piece = up_piece
            if left_piece == up_piece:
                flags |= _LOOPED
            elif left_piece > 0:
                for c in range(cols):
                    if pieces[c] == left_piece:
                        pieces[c] = up_piece
            if typed and has_right and pieces[col + 1] > 0:
                corner = _CORNER
        elif left_piece > 0:
            piece = left_piece
        codes[col], pieces[col] = _LANE + kind, piece
    elif table.kinds[index] >= 2:
        codes[col] = 0 if up_piece > 0 or left_piece > 0 else _PORTAL
    elif table.kinds[index] == 0:
        edges = int(up_piece > 0) + 2 * int(left_piece > 0)
        gain += table.worth[index, _mask(edges)]
        codes[col] = _FREE + edges if has_right else _settled(table, index, edges)
    else:
        codes[col] = 0
    # number the pieces by their first column
    result, used = flags | corner, 0
    names[:] = 0
    for c in range(cols):
        code, piece = codes[c], pieces[c]
        if piece > 0:
            if names[piece] == 0:
                used += 1
                names[piece] = used
            code += (names[piece] - 1) * types
        result |= code << (bits * c)
    return result, gain


@compiled
def complete(table: SquareTable, key: int) -> bool:
    """Whether a frontier below the last square is that of a feasible layout."""
    types = 3 + 2 * table.depth if table.depth >= 0 else 1
    lanes = False
    for c in range(table.cols):
        code = (key >> (table.bits * c)) & ((1 << table.bits) - 1)
        if code == _PORTAL or code >= _LANE + types:
            return False
        lanes |= code >= _LANE
        if code >= _LANE and _needs(code - _LANE) > 0:
            return False
    return key & _LOOPED != 0 and lanes == (key & _FINISHED == 0)
