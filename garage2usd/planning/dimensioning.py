"""Sizes of the squares of a plan: widths of columns and depths of rows that park most cars on least floor."""

import numpy as np
from numpy.typing import NDArray

from garage2usd.config import BayConfig
from garage2usd.grid import Cell, Mask, Structure
from garage2usd.stalls import square_capacity

__all__ = ["area_per_stall_m2", "dimension"]

_MM_PER_M = 1000
_PASSES = 8
_STALLS_BETWEEN_COLUMNS = (2, 3)


def area_per_stall_m2(structure: Structure, bay: BayConfig) -> float:
    """Floor inside the contour, obstacles apart, over the number of stalls; infinite without stalls."""
    areas = np.outer(structure.row_depths_mm, structure.column_widths_mm)[structure.cells != Cell.OBSTACLE]
    stalls = int(square_capacity(structure, bay).sum())
    return float(areas.sum()) / _MM_PER_M**2 / stalls if stalls else float("inf")


def dimension(structure: Structure, *, bay: BayConfig, rows: bool = True, columns: bool = True) -> Structure:
    """Choose R and C of a complete structure.

    Parameters
    ----------
    structure
        With lanes; the sizes that it has are kept on an axis that is not to be chosen.
    bay
        Stall size, column size and ``aisle_width_m``.
    rows, columns
        Which of C and R to choose.

    Returns
    -------
    Structure
        The same S; every aisle is ``aisle_width_m`` wide between columns, every other line of squares as deep as a
        stall is long or as wide as two or three stalls between columns, whichever gives least floor a stall.

    Notes
    -----
    A line of squares is an aisle's if cars drive along it on one of its squares. From aisles and shortest stalls on,
    one line after the other takes the size that lowers the area per stall, until none does.
    """
    aisle = round((bay.aisle_width_m + 2 * bay.carriageway_setback_m) * _MM_PER_M)
    length, width, column = (
        round(side * _MM_PER_M) for side in (bay.stall_length_m, bay.stall_width_m, bay.column_size_m)
    )
    free_sizes = sorted({length, *(max(count * width + column, length) for count in _STALLS_BETWEEN_COLUMNS)})
    along_x, along_z = _driven(structure.cells)
    depths, widths = structure.row_depths_mm.copy(), structure.column_widths_mm.copy()
    lines: list[tuple[NDArray[np.int64], int, list[int]]] = []
    if rows:
        lines += [(depths, row, [aisle] if along_x[row].any() else free_sizes) for row in range(len(depths))]
    if columns:
        lines += [(widths, col, [aisle] if along_z[:, col].any() else free_sizes) for col in range(len(widths))]
    for sizes, line, allowed in lines:
        sizes[line] = allowed[0]

    def area() -> float:
        return area_per_stall_m2(Structure(structure.cells, widths, depths), bay)

    best = area()
    for _ in range(_PASSES):
        before = best
        for sizes, line, allowed in lines:
            kept = int(sizes[line])
            for size in allowed:
                sizes[line] = size
                tried = area()
                if tried < best - 1e-9:
                    best, kept = tried, size
            sizes[line] = kept
        if best == before:
            break
    return Structure(structure.cells, widths, depths)


def _driven(cells: NDArray[np.int8]) -> tuple[Mask, Mask]:
    """On which lanes and portals cars drive along X, and on which along Z; a portal counts beside its lane."""
    lane, drivable = np.pad(cells == Cell.LANE, 1), np.pad(cells >= Cell.LANE, 1)
    here, here_lane = drivable[1:-1, 1:-1], lane[1:-1, 1:-1]

    def driven(one: Mask, other: Mask, one_lane: Mask, other_lane: Mask) -> Mask:
        joined: Mask = here & np.where(here_lane, one | other, one_lane | other_lane)
        return joined

    along_x = driven(drivable[1:-1, :-2], drivable[1:-1, 2:], lane[1:-1, :-2], lane[1:-1, 2:])
    along_z = driven(drivable[:-2, 1:-1], drivable[2:, 1:-1], lane[:-2, 1:-1], lane[2:, 1:-1])
    return along_x, along_z
