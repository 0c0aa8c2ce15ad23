"""Static objects: contour, portals and obstacles, drawn by the paper's rules or given by the user."""

import numpy as np

from garage2usd.common.errors import ConfigError, GenerationError
from garage2usd.config import BayConfig, FittingsConfig, SiteConfig
from garage2usd.site.contour import (
    check_structure,
    draw_contour,
    draw_obstacles,
    given_contour,
    place_obstacles,
    place_portals,
)
from garage2usd.site.portals import check_ramps, draw_portals, ramp_squares
from garage2usd.structure.grid import Cell, CellArray, Structure, cells_from_text, sides_mm

__all__ = ["make_site", "with_sides"]

_CONTOUR_ATTEMPTS = 64


def make_site(site: SiteConfig, *, bay: BayConfig, seed: int, fittings: FittingsConfig | None = None) -> Structure:
    """Make the structure matrix S with contour, portals and obstacles, and with the sizes of its squares.

    Parameters
    ----------
    site, bay
        The settings; parts that they give are used, the others are drawn.
    seed
        Seed of the random steps for contour, portals and obstacles.
    fittings
        Settings with the presence and length of ramps; if left out, portals need no space outside.

    Returns
    -------
    Structure
        S with portals and obstacles; it has lanes only if the user gave a complete structure.

    Raises
    ------
    ConfigError
        If given parts contradict each other.
    GenerationError
        If a step finds no valid result within its attempts.
    """
    for field, file in (
        ("site.structure_file", site.structure_file),
        ("bay.column_widths_file", bay.column_widths_file),
        ("bay.row_depths_file", bay.row_depths_file),
    ):
        if file is not None:
            raise ConfigError(field, str(file), "a file read by load_config")
    ramps = ramp_squares(bay, fittings) if fittings else 0
    if site.structure is not None:
        cells = cells_from_text(site.structure, field="site.structure")
        check_structure(cells)
    else:
        cells = _static_cells(site, seed=seed, ramps=ramps)
    _check_size(site, cells)
    check_ramps(cells, site, ramps)
    return with_sides(cells, bay)


def with_sides(cells: CellArray, bay: BayConfig) -> Structure:
    """Combine a structure matrix with R and C from the settings; equal squares if they give none.

    Raises
    ------
    ConfigError
        If R or C does not have one value for each column or row.
    """
    widths, depths = (
        sides_mm(bay.square_side_m if sides_m is None else sides_m, field=field, shape=cells.shape, axis=axis)
        for sides_m, field, axis in (
            (bay.column_widths_m, "bay.column_widths_m", 1),
            (bay.row_depths_m, "bay.row_depths_m", 0),
        )
    )
    return Structure(cells, widths, depths)


def _static_cells(site: SiteConfig, *, seed: int, ramps: int) -> CellArray:
    """Draw contour, portals and obstacles that are not given, with `ramps` squares kept free before each door.

    A random contour that leaves no place for portals or obstacles is drawn again.
    """
    random_contour = site.contour is None and site.rectangles > 0
    attempts = _CONTOUR_ATTEMPTS if random_contour else 1
    failure: GenerationError | None = None
    for attempt in range(attempts):
        inside = given_contour(site) if site.contour is not None else draw_contour(site, seed=seed, attempt=attempt)
        cells = np.where(inside, Cell.FREE, Cell.OBSTACLE).astype(np.int8)
        try:
            if site.entrance_cells is not None or site.exit_cells is not None:
                cells = place_portals(cells, site)
            cells = draw_portals(cells, site, seed=seed, attempt=attempt, ramp_squares=ramps)
            if site.obstacle_cells is not None:
                return place_obstacles(cells, site)
            return draw_obstacles(cells, site, seed=seed, attempt=attempt)
        except GenerationError as error:
            failure = error
    if failure is None:  # pragma: no cover - the loop runs at least once
        raise GenerationError("site", "no attempt was made", seed=seed, attempts=0)
    raise GenerationError(failure.step, failure.reason, seed=seed, attempts=attempts * failure.attempts) from failure


def _check_size(site: SiteConfig, cells: CellArray) -> None:
    for axis, field in ((0, "height_cells"), (1, "width_cells")):
        if getattr(site, field) not in {None, cells.shape[axis]}:
            raise ConfigError(
                f"site.{field}", getattr(site, field), f"{cells.shape[axis]}, as the drawing has, or no key"
            )
