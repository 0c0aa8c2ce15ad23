"""Space outside the contour for the ramp behind each portal."""

import math
from collections.abc import Iterator

import numpy as np

from garage2usd.common.errors import ConfigError
from garage2usd.config import BayConfig, FittingsConfig, SiteConfig
from garage2usd.structure.doors import door_edges
from garage2usd.structure.grid import NEIGHBOUR_STEPS, Cell, CellArray, Mask, outside_squares

__all__ = ["are_apart", "check_ramps", "ramp_squares", "with_room_for_ramps"]

Square = tuple[int, int]


def ramp_squares(bay: BayConfig, fittings: FittingsConfig) -> int:
    """Number of squares that a ramp covers beyond its portal, for the shortest possible side; 0 without ramps."""
    if not fittings.ramps:
        return 0
    given = [np.min(sides) for sides in (bay.column_widths_m, bay.row_depths_m) if sides is not None]
    chosen = [bay.stall_length_m if bay.dimensioned else bay.square_side_m] * (2 - len(given))
    return math.ceil(fittings.ramp_profile[-1][0] / float(min(given + chosen)) - 1e-9)


def with_room_for_ramps(cells: CellArray, squares: int) -> Mask:
    """Find the squares with room for a ramp: `squares` outside squares before an edge, and more on both sides of these.

    Squares beyond the matrix are outside.
    """
    rows, cols = cells.shape
    reach = max(squares, 1)
    outside = np.pad(outside_squares(cells), reach + 1, constant_values=True)
    room = np.zeros(cells.shape, dtype=np.bool_)
    for dr, dc in NEIGHBOUR_STEPS:
        free = np.ones(cells.shape, dtype=np.bool_)
        for ahead in range(1, squares + 1):
            for aside in (-1, 0, 1):
                row, col = reach + 1 + ahead * dr + aside * dc, reach + 1 + ahead * dc + aside * dr
                free &= outside[row : row + rows, col : col + cols]
        room |= free
    return room


def are_apart(cells: CellArray, squares: int) -> bool:
    """True if no two ramps of a matrix share a square."""
    taken: set[Square] = set()
    for portal in door_edges(cells):
        ray = set(_ray(cells, portal, squares))
        if taken & ray:
            return False
        taken |= ray
    return True


def check_ramps(cells: CellArray, site: SiteConfig, squares: int) -> None:
    """Reject given portals without space for a ramp over `squares` squares.

    Raises
    ------
    ConfigError
        If a portal has too little space; names the portal.
    """
    outside = outside_squares(cells)
    taken: set[Square] = set()
    for portal in door_edges(cells) if squares else ():
        is_entrance = cells[portal] == Cell.ENTRANCE
        field = "site.structure"
        if site.structure is None:
            field = "site.entrance_cells" if is_entrance else "site.exit_cells"
            if (site.entrance_cells if is_entrance else site.exit_cells) is None:
                continue
        ray = list(_ray(cells, portal, squares))
        inside = [square for square in ray if _is_on(cells, square) and not outside[square]]
        if inside or taken & set(ray):
            where = f"{squares} squares of the outside before each door for its ramp, or fittings.ramps = false"
            raise ConfigError(field, list(portal), where)
        taken |= set(ray)


def _ray(cells: CellArray, portal: Square, squares: int) -> Iterator[Square]:
    """Yield the squares before a portal's door that its ramp covers."""
    dr, dc = NEIGHBOUR_STEPS[door_edges(cells)[portal]]
    return ((portal[0] + ahead * dr, portal[1] + ahead * dc) for ahead in range(1, squares + 1))


def _is_on(cells: CellArray, square: Square) -> bool:
    return 0 <= square[0] < cells.shape[0] and 0 <= square[1] < cells.shape[1]
