"""Dead-end aisles of a structure, and those too long to back out of."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from garage2usd.garage import DEAD_END_LIMIT_M
from garage2usd.structure.grid import Cell, Structure, squares_beside

__all__ = ["DEAD_END_LIMIT_MM", "DeadEnd", "dead_ends"]

_MM_PER_M = 1000
DEAD_END_LIMIT_MM = round(DEAD_END_LIMIT_M * _MM_PER_M)
Square = tuple[int, int]


@dataclass(frozen=True)
class DeadEnd:
    """A dead-end aisle of lane squares.

    Attributes
    ----------
    squares
        (row, col) of its lanes from the tip back to the next junction or portal.
    length_m
        Length from its tip to the next junction or portal.
    needs_turning_stall
        True if the aisle is too long to back out of.
    """

    squares: tuple[Square, ...]
    length_m: float
    needs_turning_stall: bool

    @property
    def tip(self) -> Square:
        """(row, col) of the last lane of the dead end."""
        return self.squares[0]


def dead_ends(structure: Structure, limit_mm: int = DEAD_END_LIMIT_MM) -> tuple[DeadEnd, ...]:
    """Find all dead ends of a structure, in reading order, by walking from each tip to the next junction or portal.

    A dead end longer than `limit_mm` needs a turning stall.
    """
    drivable = {(int(row), int(col)) for row, col in np.argwhere(structure.cells >= Cell.LANE)}
    beside = {
        square: [other for other in squares_beside(square) if other in drivable]
        for square in structure.where(Cell.LANE)
    }
    found = []
    for tip, neighbours in beside.items():
        if len(neighbours) > 1:
            continue
        squares, end = _walk_back(tip, beside)
        length_mm = sum(
            int(structure.row_depths_mm[row] if ahead[0] != row else structure.column_widths_mm[col])
            for (row, col), ahead in pairwise((*squares, end or tip))
        )
        found.append(DeadEnd(tuple(squares), length_mm / _MM_PER_M, length_mm > limit_mm))
    return tuple(found)


def _walk_back(tip: Square, beside: Mapping[Square, Sequence[Square]]) -> tuple[list[Square], Square | None]:
    """Return the lanes of a dead end from its tip, and the junction or portal at its mouth, if any."""
    lanes, ahead = [tip], [*beside[tip]]
    while ahead and len(beside.get(ahead[0], ())) == 2:  # noqa: PLR2004 - neither a junction nor a portal
        lanes.append(ahead[0])
        ahead = [other for other in beside[lanes[-1]] if other != lanes[-2]]
    return lanes, ahead[0] if ahead else None
