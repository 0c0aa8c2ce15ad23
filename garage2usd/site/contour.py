"""The contour and the obstacles: drawn by the paper's rules, or given by the user and validated."""

import numpy as np

from garage2usd.common.errors import ConfigError, GenerationError
from garage2usd.common.randomness import Step, generator
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
from garage2usd.structure.squares import pieces_of

_ATTEMPTS = 2000
_MIN_SIDE_CELLS = 3
_MIN_OVERLAP_CELLS = 2
_RESTARTS = 50


def draw_contour(site: SiteConfig, *, seed: int, attempt: int = 0) -> Mask:
    """Draw a random contour: the squares inside the garage.

    Parameters
    ----------
    site
        Its ``width_cells``, ``height_cells``, ``rectangles`` and ``min_fill``.
    seed, attempt
        Seed and number of the restart.

    Returns
    -------
    Mask
        bool, shape (height_cells, width_cells): the paper's zeta; 4-connected.

    Raises
    ------
    GenerationError
        If no union of rectangles covers ``min_fill`` of the squares.

    Notes
    -----
    Algorithm 1. Deviation: the paper requires that rectangles overlap, without saying which; requiring all pairs fails
    for almost every draw of many rectangles. A rectangle is accepted if it overlaps an accepted one by 2 x 2 squares,
    so that the union is connected and at least two squares wide. Deviation: sides are at least three squares, so that a
    portal has a lane and a stall behind it. Deviation: a union that covers less than ``min_fill`` of the squares is
    drawn again, as small ones hold few stalls.
    """
    height, width = site.shape
    if site.rectangles == 0:
        return np.ones((height, width), dtype=np.bool_)
    rng = generator(seed, Step.CONTOUR, attempt)
    best = 0.0
    for _ in range(_ATTEMPTS):
        inside = _union(rng, height=height, width=width, count=site.rectangles)
        fill = float(inside.mean())
        if fill >= site.min_fill:
            return inside
        best = max(best, fill)
    reason = f"{site.rectangles} rectangles covered at most {best:.2f} of the squares, min_fill is {site.min_fill}"
    raise GenerationError("contour", reason, seed=seed, attempts=_ATTEMPTS)


def _union(rng: np.random.Generator, *, height: int, width: int, count: int) -> Mask:
    inside = np.zeros((height, width), dtype=np.bool_)
    accepted: list[tuple[int, int, int, int]] = []
    for _ in range(_ATTEMPTS * count):
        top, bottom = _span(rng, height)
        left, right = _span(rng, width)
        overlaps = not accepted or any(
            min(bottom, b) - max(top, t) >= _MIN_OVERLAP_CELLS and min(right, r) - max(left, x) >= _MIN_OVERLAP_CELLS
            for t, b, x, r in accepted
        )
        if overlaps:
            accepted.append((top, bottom, left, right))
            inside[top:bottom, left:right] = True
            if len(accepted) == count:
                break
    return inside


def _span(rng: np.random.Generator, side: int) -> tuple[int, int]:
    """Draw a half-open range of squares, at least three long, from 0 to `side`."""
    while True:
        first, last = sorted(rng.integers(0, side, size=2).tolist())
        if last + 1 - first >= _MIN_SIDE_CELLS:
            return first, last + 1


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
