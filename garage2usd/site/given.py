"""Contour, portals and obstacles that the user gives, and their validation."""

import numpy as np

from garage2usd.common.errors import ConfigError
from garage2usd.config import SiteConfig
from garage2usd.site.portals import free_squares_connected, outer_squares
from garage2usd.structure.grid import (
    NEIGHBOUR_STEPS,
    Cell,
    CellArray,
    Mask,
    cells_from_text,
    cells_to_text,
    edge_neighbour_count,
)
from garage2usd.structure.pieces import pieces_of

__all__ = ["check_structure", "given_contour", "place_obstacles", "place_portals"]


def given_contour(site: SiteConfig) -> Mask:
    """Read the given contour; bool, shape (rows, cols).

    Raises
    ------
    ConfigError
        If it has symbols other than those of outside and inside, or its inside is not one piece.
    """
    cells = cells_from_text(site.contour or "", field="site.contour")
    if not ((cells == Cell.OBSTACLE) | (cells == Cell.FREE)).all():
        raise ConfigError("site.contour", cells_to_text(cells), "only '#' outside and '.' inside")
    if not free_squares_connected(cells):
        raise ConfigError("site.contour", cells_to_text(cells), "one connected piece of '.' squares")
    inside: Mask = cells == Cell.FREE
    return inside


def place_portals(cells: CellArray, site: SiteConfig) -> CellArray:
    """Write the given entrances and exits on a contour.

    Raises
    ------
    ConfigError
        If a square is off the matrix, outside, not on the contour's edge, or taken.
    """
    result = cells.copy()
    on_edge = outer_squares(cells)
    for field, squares, kind in (
        ("site.entrance_cells", site.entrance_cells, Cell.ENTRANCE),
        ("site.exit_cells", site.exit_cells, Cell.EXIT),
    ):
        if squares is not None and not squares:
            raise ConfigError(field, [], "at least one [row, col]")
        for square in squares or ():
            if not _is_free(result, square) or not on_edge[square]:
                raise ConfigError(field, list(square), "free squares on the edge of the contour, each once")
            result[square] = kind
    if not free_squares_connected(result):
        raise ConfigError("site.entrance_cells, site.exit_cells", cells_to_text(result), "portals that part no squares")
    return result


def place_obstacles(cells: CellArray, site: SiteConfig) -> CellArray:
    """Write the given obstacles on a contour with portals.

    Raises
    ------
    ConfigError
        If a square is off the matrix or taken, or the obstacles disconnect the free squares.
    """
    result = cells.copy()
    for square in site.obstacle_cells or ():
        if not _is_free(result, square):
            raise ConfigError("site.obstacle_cells", list(square), "free squares inside the contour, each once")
        result[square] = Cell.OBSTACLE
    if not free_squares_connected(result):
        raise ConfigError(
            "site.obstacle_cells", cells_to_text(result), "obstacles that leave the free squares connected"
        )
    return result


def check_structure(cells: CellArray) -> None:
    """Validate a given structure matrix.

    Raises
    ------
    ConfigError
        If it has no entrance or no exit, a portal that is not on the contour's edge or touches no free square, an
        entrance without a path to an exit, or an exit without a path from an entrance.
    """
    drawing = cells_to_text(cells)
    for kind, name in ((Cell.ENTRANCE, "entrance 'E' (2)"), (Cell.EXIT, "exit 'X' (3)")):
        if not (cells == kind).any():
            raise ConfigError("site.structure", drawing, f"at least one {name}")
    has_lanes = (cells == Cell.LANE).any()
    open_to = (cells == Cell.LANE) if has_lanes else (cells == Cell.FREE)
    portal = (cells == Cell.ENTRANCE) | (cells == Cell.EXIT)
    if (portal & ~outer_squares(cells)).any():
        raise ConfigError("site.structure", drawing, "every portal on the contour's edge, where its door opens")
    if (portal & (edge_neighbour_count(open_to) == 0)).any():
        raise ConfigError(
            "site.structure", drawing, "every portal beside a lane" if has_lanes else "portals beside free squares"
        )
    if not has_lanes and not free_squares_connected(cells):
        raise ConfigError("site.structure", drawing, "free squares in one connected piece, or lanes")
    if has_lanes:
        _check_ways(cells)


def _check_ways(cells: CellArray) -> None:
    """Check on the lane squares that every entrance has a path to an exit, and every exit a path from an entrance."""
    pieces, _ = pieces_of(cells == Cell.LANE)
    around = np.pad(pieces, 1)
    touched = {
        (row, col): {int(around[row + 1 + dr, col + 1 + dc]) for dr, dc in NEIGHBOUR_STEPS} - {0}
        for row, col in np.argwhere(cells >= Cell.ENTRANCE).tolist()
    }
    for kind, other, way in (
        (Cell.ENTRANCE, Cell.EXIT, "lanes from each entrance to an exit"),
        (Cell.EXIT, Cell.ENTRANCE, "lanes to each exit from an entrance"),
    ):
        joined = set().union(*(there for square, there in touched.items() if cells[square] == other))
        for square, there in touched.items():
            if cells[square] == kind and not there & joined:
                raise ConfigError("site.structure", cells_to_text(cells), f"{way}; {list(square)} has none")


def _is_free(cells: CellArray, square: tuple[int, int]) -> bool:
    return square[0] < cells.shape[0] and square[1] < cells.shape[1] and bool(cells[square] == Cell.FREE)
