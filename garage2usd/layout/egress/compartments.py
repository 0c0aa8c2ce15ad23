"""Fire compartments: parts of the floor that are each small enough for the standard."""

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from garage2usd.profiles import Area
from garage2usd.structure.grid import Cell, Mask, Structure
from garage2usd.structure.pieces import pieces_of

__all__ = ["compartment_name", "compartments_of"]

_MM2_PER_M2 = 1e6
_LEAST_SHARE, _MOST_LINES = 0.3, 24
"""Least share of the floor on each side of a cut; most lines along each axis that are tried on a large floor."""


def compartment_name(number: int) -> str:
    """Name of a compartment: ``F1``."""
    return f"F{number}"


def compartments_of(structure: Structure, clause: Area | None) -> NDArray[np.int32]:
    """The number of each square's fire compartment, from 1 in reading order; 0 outside and on obstacles.

    Parameters
    ----------
    structure
        The plan.
    clause
        The largest area of one; None for a single compartment.

    Notes
    -----
    Recursive bisection: a part that is too large is cut along a line of squares into two that need as few
    compartments as possible, are each connected, most alike in area and least elongated.
    """
    inside = structure.cells != Cell.OBSTACLE
    areas = np.outer(structure.row_depths_mm, structure.column_widths_mm) / _MM2_PER_M2
    limit = math.inf if clause is None else clause.amount
    numbers = np.zeros(structure.shape, dtype=np.int32)
    parts = sorted(_parts(inside, areas, limit), key=lambda part: int(np.flatnonzero(part)[0]))
    for number, part in enumerate(parts, start=1):
        numbers[part] = number
    return numbers


def _parts(part: Mask, areas: NDArray[np.float64], limit: float) -> Iterator[Mask]:
    """A part of the floor, or what it is cut into."""
    if float(areas[part].sum()) <= limit or int(part.sum()) <= 1:
        yield part
        return
    before = _best_cut(part, areas, limit)
    for piece in (*_pieces(before), *_pieces(part & ~before)):
        yield from _parts(piece, areas, limit)


def _best_cut(part: Mask, areas: NDArray[np.float64], limit: float) -> Mask:
    """What lies before the best line to cut a part along."""
    spans = (np.flatnonzero(part.any(axis=axis)) for axis in (1, 0))
    box = tuple(slice(int(span[0]), int(span[-1]) + 1) for span in spans)
    cropped, floor = part[box], areas[box]
    best: tuple[tuple[float, ...], Mask] | None = None
    for axis in (0, 1):
        for line in _lines(np.where(cropped, floor, 0.0).sum(axis=1 - axis)):
            before = cropped.copy()
            before[(slice(line, None), slice(None))[:: 1 - 2 * axis]] = False
            pieces = [piece for side in (before, cropped & ~before) for piece in _pieces(side)]
            needed = sum(math.ceil(float(floor[piece].sum()) / limit) for piece in pieces)
            price = needed, max(float(floor[piece].sum()) * _stretch(piece) for piece in pieces)
            if best is None or price < best[0]:
                best = price, before
    if best is None:  # pragma: no cover - a part of two squares has a line between them
        raise ValueError("a part of one square is not cut")
    result = np.zeros_like(part)
    result[box] = best[1]
    return result


def _lines(areas: NDArray[np.float64]) -> list[int]:
    """Numbers of the lines that leave at least 0.3 of the area on both sides; of all lines if no line does."""
    before = np.cumsum(areas)[:-1] / areas.sum()
    middle = np.flatnonzero((before >= _LEAST_SHARE) & (before <= 1 - _LEAST_SHARE)) + 1
    lines = middle if len(middle) else np.arange(1, len(areas))
    if not len(lines):
        return []
    chosen = np.linspace(0, len(lines) - 1, min(len(lines), _MOST_LINES)).round().astype(int)
    return [int(line) for line in lines[np.unique(chosen)]]


def _pieces(mask: Mask) -> list[Mask]:
    """The 4-connected pieces of a part."""
    numbers, count = pieces_of(mask)
    return [numbers == number for number in range(1, count + 1)]


def _stretch(piece: Mask) -> float:
    """Elongation of a piece: the long side of its bounding box over the short one."""
    rows, cols = (int(np.ptp(indices)) + 1 for indices in np.nonzero(piece))
    return max(rows, cols) / min(rows, cols)
