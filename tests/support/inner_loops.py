"""Functions in C that only C calls, within reach of tests."""

from garage2usd.native import Int8s, Int32s, Int64s, in_c
from garage2usd.planning.board import Board, Ground
from garage2usd.planning.dimensions import Sizes

REFUSED, FLIPPED, TALLIED = 0, 1, 2
"""What became of a flip."""


@in_c
def clear(ground: Ground, board: Board) -> None:
    """Take all lanes off."""


@in_c
def lay(ground: Ground, board: Board, square: int) -> None:
    """Make a free square a lane, beside an entrance or a lane; keeps the tally."""


@in_c
def dead_ends(ground: Ground, cells: Int8s) -> int:
    """Dead-end aisles over the ground's limit, from the tip to the next junction or portal."""


@in_c
def trim(ground: Ground, board: Board) -> None:
    """Take off the tips of all dead ends that are too deep, until none is."""


@in_c
def weigh(ground: Ground, board: Board, sizes: Sizes, axis: int, line: int, side_mm: int) -> float:
    """Set `Sizes.change` to what another side of a line would add; returns the floor that it would add, in m2."""


@in_c
def resize(ground: Ground, sizes: Sizes, axis: int, line: int, side_mm: int) -> None:
    """Give a line another side."""


@in_c
def sync_sides(ground: Ground, board: Board, sizes: Sizes) -> None:
    """Count anew where cars drive, and give every line the side that follows."""


@in_c
def settle(ground: Ground, board: Board, sizes: Sizes, passes: int) -> None:
    """Choose the side of every line without traffic, for most stalls less the price of the floor."""


@in_c
def flip_within(
    ground: Ground,
    board: Board,
    known: Int64s,
    hops: Int32s,
    q: int,
    p: int,
    enough: float,
) -> int:
    """Flip one square, or two side by side, unless the lanes cannot be worth so much with that."""
