"""Entrances and exits on straight edges of the contour, and the space outside for the ramps behind them."""

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.errors import ConfigError, GenerationError
from garage2usd.common.randomness import Step, generator
from garage2usd.config import BayConfig, FittingsConfig, SiteConfig
from garage2usd.structure.grid import NEIGHBOUR_STEPS, Cell, CellArray, Mask, edge_neighbour_count, outside_squares
from garage2usd.structure.squares import pieces_of
from garage2usd.structure.stalls import door_edges

Square = tuple[int, int]
_RESTARTS = 400


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
        rows, cols = cells.shape
        inside = [(row, col) for row, col in ray if 0 <= row < rows and 0 <= col < cols and not outside[row, col]]
        if inside or taken & set(ray):
            where = f"{squares} squares of the outside before each door for its ramp, or fittings.ramps = false"
            raise ConfigError(field, list(portal), where)
        taken |= set(ray)


def _ray(cells: CellArray, portal: Square, squares: int) -> Iterator[Square]:
    """Yield the squares before a portal's door that its ramp covers."""
    dr, dc = NEIGHBOUR_STEPS[door_edges(cells)[portal]]
    return ((portal[0] + ahead * dr, portal[1] + ahead * dc) for ahead in range(1, squares + 1))


def straight_frontier(inside: Mask) -> Mask:
    """Find the squares on a straight edge of the contour, which are the only ones that may hold a portal.

    Parameters
    ----------
    inside
        bool, shape (rows, cols): the contour before portals and obstacles are written.

    Returns
    -------
    Mask
        bool, same shape.

    Notes
    -----
    The paper requires that the eight squares rho sum to -3. Deviation: 52 of the 56 neighbourhoods with that sum
    are not a straight edge; instead, the three squares of one side must be outside and the five others inside. The
    border is padded with -1.
    """
    outside = np.pad(~inside, 1, constant_values=True)
    rows, cols = inside.shape
    rho = {
        (dr, dc): outside[1 + dr : 1 + dr + rows, 1 + dc : 1 + dc + cols]
        for dr in (-1, 0, 1)
        for dc in (-1, 0, 1)
        if (dr, dc) != (0, 0)
    }
    three_outside = sum(square.astype(np.int8) for square in rho.values()) == 3  # noqa: PLR2004
    sides = (
        [(-1, -1), (-1, 0), (-1, 1)],
        [(1, -1), (1, 0), (1, 1)],
        [(-1, -1), (0, -1), (1, -1)],
        [(-1, 1), (0, 1), (1, 1)],
    )
    straight = np.zeros_like(inside)
    for side in sides:
        straight |= np.logical_and.reduce([rho[step] for step in side])
    return inside & three_outside & straight


def outer_squares(cells: CellArray) -> Mask:
    """Find the squares inside the contour with an edge to the outside, where a door can open; courts do not count."""
    outside = outside_squares(cells)
    beside = edge_neighbour_count(outside) > 0
    beside[[0, -1]] = beside[:, [0, -1]] = True
    return beside & ~outside


def free_squares_connected(cells: CellArray) -> bool:
    """True if the free squares form one 4-connected piece and every portal touches it."""
    free = cells == Cell.FREE
    _, count = pieces_of(free)
    portal = (cells == Cell.ENTRANCE) | (cells == Cell.EXIT)
    return count == 1 and bool((edge_neighbour_count(free)[portal] > 0).all())


def draw_portals(
    cells: CellArray, site: SiteConfig, *, seed: int, attempt: int = 0, ramp_squares: int = 0
) -> CellArray:
    """Draw the entrances and exits that are not given.

    Parameters
    ----------
    cells
        int8, shape (rows, cols): contour with the portals that were given.
    site
        Its ``entrances``, ``exits``, ``min_portal_distance_cells`` (sigma_1); a kind that was given is not drawn.
    seed, attempt
        Seed and number of the restart.
    ramp_squares
        Number of squares before each door that are kept free for its ramp.

    Returns
    -------
    CellArray
        A new matrix with the portals.

    Raises
    ------
    GenerationError
        If no draw keeps the distance and leaves the free squares connected; gives the number of eligible squares and
        the best distance.

    Notes
    -----
    ``M(e_i, e_j) >= sigma_1`` for all pairs of portals, drawn and given. Deviation: portals open to the outside
    and not to a court, so that a ramp has space; a draw that disconnects the free squares or makes ramps cross is
    repeated.
    """
    kinds: list[Cell] = []
    if site.entrance_cells is None:
        kinds += [Cell.ENTRANCE] * site.entrances
    if site.exit_cells is None:
        kinds += [Cell.EXIT] * site.exits
    if not kinds:
        return cells
    rng = generator(seed, Step.PORTALS, attempt)
    given = np.argwhere((cells == Cell.ENTRANCE) | (cells == Cell.EXIT))
    frontier = straight_frontier(cells != Cell.OBSTACLE) & outer_squares(cells)
    frontier &= with_room_for_ramps(cells, ramp_squares)
    eligible = np.argwhere(frontier & (cells == Cell.FREE))
    best = 0
    for _ in range(_RESTARTS):
        chosen = _take_spaced(
            rng.permutation(eligible), given, count=len(kinds), distance=site.min_portal_distance_cells
        )
        best = max(best, len(chosen))
        if len(chosen) == len(kinds):
            result = cells.copy()
            for (row, col), kind in zip(chosen, kinds, strict=True):
                result[row, col] = kind
            if free_squares_connected(result) and are_apart(result, ramp_squares):
                return result
    reason = (
        f"{len(kinds)} portals at least {site.min_portal_distance_cells} squares apart found no place: "
        f"{len(eligible)} eligible squares, {best} placed at best, {_span(eligible)} squares between the farthest two"
    )
    raise GenerationError("portals", reason, seed=seed, attempts=_RESTARTS)


def _take_spaced(
    candidates: NDArray[np.int64], given: NDArray[np.int64], *, count: int, distance: int
) -> list[tuple[int, int]]:
    """Select candidates in order that keep the Manhattan distance from all given and selected squares."""
    taken: list[tuple[int, int]] = [(row, col) for row, col in given.tolist()]
    chosen: list[tuple[int, int]] = []
    for row, col in candidates.tolist():
        if all(abs(row - r) + abs(col - c) >= distance for r, c in taken):
            taken.append((row, col))
            chosen.append((row, col))
            if len(chosen) == count:
                break
    return chosen


def _span(squares: NDArray[np.int64]) -> int:
    """Largest Manhattan distance between two squares: the spread of row + col or of row - col."""
    if len(squares) == 0:
        return 0
    rows, cols = squares[:, 0], squares[:, 1]
    return int(max(np.ptp(rows + cols), np.ptp(rows - cols)))
