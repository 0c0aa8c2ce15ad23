"""Polish of lanes: flips of squares that raise the value, in climbing and in annealing. In C, `local_search.c`."""

from typing import NamedTuple

import numpy as np

from garage2usd.native import Int8s, Int32s, Int64s, UInt64s, in_c
from garage2usd.planning.board import Board
from garage2usd.planning.ground import Ground
from garage2usd.planning.sizes import Sizes

__all__ = ["Room", "improve", "new_room"]


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

    cells: Int8s
    kept_mm: Int64s
    order: Int64s
    known: Int64s
    hops: Int32s


def new_room(ground: Ground, sizes: Sizes) -> Room:
    """Room for the plans of a ground."""
    return Room(
        ground.cells.copy(),
        sizes.kept_mm.copy(),
        ground.squares.copy(),
        np.zeros(3, np.int64),
        np.zeros(len(ground.cells), np.int32),
    )


@in_c
def improve(
    ground: Ground,
    board: Board,
    sizes: Sizes,
    room: Room,
    random: UInt64s,
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
    raise NotImplementedError
