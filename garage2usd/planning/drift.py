"""Annealing of large plans: a flip is judged by the squares around it, the whole only now and then. In C, `flip_annealing.c`."""

from garage2usd.native import Int8s, UInt64s, in_c
from garage2usd.planning.board import Board
from garage2usd.planning.ground import Ground

__all__ = ["drift"]


@in_c
def drift(
    ground: Ground,
    board: Board,
    best_cells: Int8s,
    random: UInt64s,
    flips: int,
    hottest: float,
    coldest: float,
    refresh: int,
) -> float:
    """Anneal the feasible lanes in `board.cells`; leaves the best measured there and returns its value.

    `best_cells` is room for as many.

    Notes
    -----
    N_S and U_S change exactly; T_S is followed by the distances as of the last measurement, one every `refresh`
    flips, by which alone the best is chosen. A flip that may part the lanes is measured whole, as long as such
    measurements take no more than a share of the time.
    """
    raise NotImplementedError
