"""Obstacles on inner squares."""

import numpy as np

from garage2usd.common.errors import GenerationError
from garage2usd.common.randomness import Step, generator
from garage2usd.config import SiteConfig
from garage2usd.site.portals import free_squares_connected
from garage2usd.structure.grid import Cell, CellArray, Mask

__all__ = ["draw_obstacles", "inner_squares"]

_RESTARTS = 50


def inner_squares(inside: Mask) -> Mask:
    """Squares with all eight neighbours rho inside the contour: the paper's eta, sum(S(rho)) = 0."""
    padded = np.pad(inside, 1)
    rows, cols = inside.shape
    shifted = [padded[dr : dr + rows, dc : dc + cols] for dr in range(3) for dc in range(3)]
    return np.asarray(np.logical_and.reduce(shifted), dtype=np.bool_)


def draw_obstacles(cells: CellArray, site: SiteConfig, *, seed: int, attempt: int = 0) -> CellArray:
    """Draw obstacles that keep their distance and leave the free squares connected.

    Parameters
    ----------
    cells
        int8, shape (rows, cols): contour with portals.
    site
        Its ``obstacles`` and ``min_obstacle_distance_cells`` (sigma_2).
    seed, attempt
        Seed and number of the restart.

    Returns
    -------
    CellArray
        A new matrix with the obstacles.

    Raises
    ------
    GenerationError
        If fewer obstacles than required can be placed; gives the number of eligible squares and the best count.

    Notes
    -----
    ``o in eta`` and ``M(o_i, o_j) >= sigma_2``. Deviation: eta is computed before portals are written, and
    squares beside a portal are left free, so that an obstacle never blocks a portal. Deviation: an obstacle that would
    disconnect the free squares is rejected, as no lanes could join them.
    """
    if site.obstacles == 0:
        return cells
    rng = generator(seed, Step.OBSTACLES, attempt)
    portal = (cells == Cell.ENTRANCE) | (cells == Cell.EXIT)
    beside_portal = ~inner_squares(~portal)
    eligible = np.argwhere(inner_squares(cells != Cell.OBSTACLE) & ~beside_portal)
    best = 0
    for _ in range(_RESTARTS):
        result = cells.copy()
        taken: list[tuple[int, int]] = []
        for row, col in rng.permutation(eligible).tolist():
            if any(abs(row - r) + abs(col - c) < site.min_obstacle_distance_cells for r, c in taken):
                continue
            result[row, col] = Cell.OBSTACLE
            if not free_squares_connected(result):
                result[row, col] = Cell.FREE
                continue
            taken.append((row, col))
            if len(taken) == site.obstacles:
                return result
        best = max(best, len(taken))
    reason = (
        f"{site.obstacles} obstacles at least {site.min_obstacle_distance_cells} squares apart found no place: "
        f"{len(eligible)} eligible squares, {best} placed at best"
    )
    raise GenerationError("obstacles", reason, seed=seed, attempts=_RESTARTS)
