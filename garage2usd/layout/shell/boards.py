"""Mounting boards behind equipment on columns with a section smaller than their square."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np

from garage2usd.layout.placement import Placement, edge_yaw_rad
from garage2usd.objects import Spec
from garage2usd.objects.column import Board, ColumnSpec
from garage2usd.structure.stalls import Edge

__all__ = ["with_boards"]

_SIDES = (Edge.DOWN, Edge.RIGHT, Edge.UP, Edge.LEFT)
"""Edges that the sides of a column face, in the order of `Board.side`."""
_BACK_M = 0.02
"""Greatest distance of an equipment's back face from the wall plane."""
_MARGIN_M = 0.03
"""Margin of a board around the equipment, on each side."""
_TOUCH_M = 1e-4


def with_boards(pillars: Iterable[Placement], hung: Sequence[Placement]) -> list[Placement]:
    """Add a board to the columns behind each mounted object with a gap to the column.

    Parameters
    ----------
    pillars
        All columns.
    hung
        Equipment on columns and walls.
    """
    found: list[Placement] = []
    for pillar in pillars:
        spec = pillar.spec
        if isinstance(spec, ColumnSpec) and not spec.fills_square:
            boards = [board for each in hung if (board := _board(pillar, spec, each)) is not None]
            pillar = replace(pillar, spec=replace(spec, boards=tuple(sorted(boards))))  # noqa: PLW2901
        found.append(pillar)
    return found


def _board(pillar: Placement, column: ColumnSpec, hung: Placement) -> Board | None:
    """Return the board behind an object on the column; None for other objects and without a gap."""
    x, z = hung.position_m[0] - pillar.position_m[0], hung.position_m[2] - pillar.position_m[2]
    half = column.size_m / 2
    if max(abs(x), abs(z)) > half + _TOUCH_M:
        return None
    side = next(number for number, edge in enumerate(_SIDES) if edge_yaw_rad(edge) == hung.yaw_rad)
    if not column.is_round and half - column.side_m(side) < _TOUCH_M:
        return None
    across = (x, -z, -x, z)[side]
    left, right, low, high = _back_extent_m(hung.spec)
    left, right = max(across + left - _MARGIN_M, -half), min(across + right + _MARGIN_M, half)
    return Board(side, *(round(value, 4) for value in (left, right, low - _MARGIN_M, high + _MARGIN_M)))


@lru_cache(maxsize=16)
def _back_extent_m(spec: Spec) -> tuple[float, float, float, float]:
    """Return left, right, low and high of an object's back face."""
    points = np.concatenate([part.points for part in spec.asset().parts])
    x, y, _ = points[points[:, 2] < _BACK_M].T
    return float(x.min()), float(x.max()), float(y.min()), float(y.max())
