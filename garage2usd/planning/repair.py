"""Repair of lanes: joining what is apart. In C, `repair.c`."""

from garage2usd.native import in_c
from garage2usd.planning.board import Board
from garage2usd.planning.ground import Ground

__all__ = ["connect"]


def connect(ground: Ground, board: Board) -> bool:
    """Connect all lanes and portals by shortest paths over free squares; False if there are none.

    Starts at the first portal; lanes that no way reaches are taken off.
    """
    return _connect_lanes(ground, board)


@in_c
def _connect_lanes(ground: Ground, board: Board) -> bool:
    """`connect`, whose own name is one of the C library."""
    raise NotImplementedError
