"""Fire compartments: parts of the floor within the standard's area limit."""

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
"""Least share of the floor on each side of a cut; greatest number of candidate cuts along each axis."""


def compartment_name(number: int) -> str:
    """Return the name of a fire compartment: ``F1``."""
    return f"F{number}"


def compartments_of(structure: Structure, clause: Area | None) -> NDArray[np.int32]:
    """Divide the floor into fire compartments, and return the compartment number of each square.

    Numbers start from 1 in reading order; 0 is outside and on obstacles. int32, shape (rows, cols).


    Parameters
    ----------
    structure
        Layout grid of the garage.
    clause
        Greatest area of a compartment; None for a single compartment.

    Notes
    -----
    Recursive bisection: a part that is too large is cut along a grid line. The best cut needs the fewest compartments;
    among equals, it has the least greatest product of area and aspect ratio of a piece.
    """
    inside = structure.cells != Cell.OBSTACLE
    areas = np.outer(structure.row_depths_mm, structure.column_widths_mm) / _MM2_PER_M2
    limit = math.inf if clause is None else clause.amount
    numbers = np.zeros(structure.shape, dtype=np.int32)
    parts = sorted(_bisected(inside, areas, limit), key=lambda part: int(np.flatnonzero(part)[0]))
    for number, part in enumerate(parts, start=1):
        numbers[part] = number
    return numbers


def _bisected(part: Mask, areas: NDArray[np.float64], limit: float) -> Iterator[Mask]:
    """Yield a part of the floor, or the parts of its recursive bisection."""
    if float(areas[part].sum()) <= limit or int(part.sum()) <= 1:
        yield part
        return
    before = _best_cut(part, areas, limit)
    for piece in (*_pieces(before), *_pieces(part & ~before)):
        yield from _bisected(piece, areas, limit)


def _best_cut(part: Mask, areas: NDArray[np.float64], limit: float) -> Mask:
    """Return the side before the best grid line to cut a part."""
    spans = (np.flatnonzero(part.any(axis=axis)) for axis in (1, 0))
    box = tuple(slice(int(span[0]), int(span[-1]) + 1) for span in spans)
    cropped, floor = part[box], areas[box]
    best: tuple[tuple[float, ...], Mask] | None = None
    for axis in (0, 1):
        for line in _candidate_lines(np.where(cropped, floor, 0.0).sum(axis=1 - axis)):
            before = cropped.copy()
            before[(slice(line, None), slice(None))[:: 1 - 2 * axis]] = False
            pieces = [piece for side in (before, cropped & ~before) for piece in _pieces(side)]
            needed = sum(math.ceil(float(floor[piece].sum()) / limit) for piece in pieces)
            price = needed, max(float(floor[piece].sum()) * _aspect_ratio(piece) for piece in pieces)
            if best is None or price < best[0]:
                best = price, before
    if best is None:  # pragma: no cover - a part of two squares has a line between them
        raise ValueError("a part of one square is not cut")
    result = np.zeros_like(part)
    result[box] = best[1]
    return result


def _candidate_lines(areas: NDArray[np.float64]) -> list[int]:
    """Return the candidate lines with at least 0.3 of the area on both sides; all lines if there is no such line."""
    before = np.cumsum(areas)[:-1] / areas.sum()
    middle = np.flatnonzero((before >= _LEAST_SHARE) & (before <= 1 - _LEAST_SHARE)) + 1
    lines = middle if len(middle) else np.arange(1, len(areas))
    if not len(lines):
        return []
    chosen = np.linspace(0, len(lines) - 1, min(len(lines), _MOST_LINES)).round().astype(int)
    return [int(line) for line in lines[np.unique(chosen)]]


def _pieces(mask: Mask) -> list[Mask]:
    """Return the 4-connected components of a part."""
    numbers, count = pieces_of(mask)
    return [numbers == number for number in range(1, count + 1)]


def _aspect_ratio(piece: Mask) -> float:
    """Return the aspect ratio of a piece's bounding box, long side over short side."""
    rows, cols = (int(np.ptp(indices)) + 1 for indices in np.nonzero(piece))
    return max(rows, cols) / min(rows, cols)
