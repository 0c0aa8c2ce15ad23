"""Aisles that end in nothing, and which of them are too long to back out of."""

from dataclasses import dataclass

import numpy as np

from garage2usd.structure.grid import NEIGHBOUR_STEPS, Cell, Structure

__all__ = ["DEAD_END_LIMIT_MM", "DeadEnd", "dead_ends"]

DEAD_END_LIMIT_MM = 26_000
"""A dead-end aisle longer than this keeps a turning stall free."""
_MM_PER_M = 1000
Square = tuple[int, int]


@dataclass(frozen=True)
class DeadEnd:
    """An aisle that ends in nothing.

    Attributes
    ----------
    squares
        (row, col) of its lanes from the last one on, walking back to the next junction or portal.
    length_m
        From its end to the next junction or portal.
    needs_turning_stall
        Whether it is longer than the standard's 26 m.
    """

    squares: tuple[Square, ...]
    length_m: float
    needs_turning_stall: bool

    @property
    def tip(self) -> Square:
        """(row, col) of its last lane."""
        return self.squares[0]


def dead_ends(structure: Structure) -> tuple[DeadEnd, ...]:
    """All dead ends of a structure in reading order, by walking from each tip to the next junction or portal."""
    drivable = {(int(row), int(col)) for row, col in np.argwhere(structure.cells >= Cell.LANE)}
    beside = {
        square: [other for other in _around(square) if other in drivable] for square in structure.where(Cell.LANE)
    }
    found = []
    for tip, neighbours in beside.items():
        if len(neighbours) > 1:
            continue
        length_mm, previous, square = 0, tip, tip
        squares = []
        while square in beside and (square == tip or len(beside[square]) == 2):  # noqa: PLR2004 - neither tip nor junction
            squares.append(square)
            onward = [other for other in beside[square] if other != previous]
            ahead = onward[0] if onward else previous
            side = (
                structure.row_depths_mm[square[0]] if ahead[0] != square[0] else structure.column_widths_mm[square[1]]
            )
            length_mm += int(side)
            if not onward:
                break
            previous, square = square, ahead
        found.append(DeadEnd(tuple(squares), length_mm / _MM_PER_M, length_mm > DEAD_END_LIMIT_MM))
    return tuple(found)


def _around(square: Square) -> list[Square]:
    return [(square[0] + dr, square[1] + dc) for dr, dc in NEIGHBOUR_STEPS]
