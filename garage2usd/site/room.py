"""The site of a garage before planning, with squares large enough for a stall."""

from garage2usd.common.errors import ConfigError
from garage2usd.config import BayConfig, GarageConfig
from garage2usd.site import make_site
from garage2usd.structure.grid import Cell, Structure
from garage2usd.structure.stalls import capacity_table

__all__ = ["make_roomy_site"]


def make_roomy_site(config: GarageConfig) -> Structure:
    """Make the site of a garage, of several levels the top one without ramps, and check its squares.

    Raises
    ------
    ConfigError
        If given parts contradict each other, or no square holds a stall.
    GenerationError
        If a step finds no valid result within its attempts.
    """
    site = make_site(config.site, bay=config.bay, seed=config.seed, fittings=config.fittings)
    _check_room(site, config.bay)
    return site


def _check_room(site: Structure, bay: BayConfig) -> None:
    """Check that some squares can hold a stall, unless their size is chosen later.

    Raises
    ------
    ConfigError
        If none can; names the setting of the squares' size, and the size that a stall needs.
    """
    chosen_later = bay.dimensioned and (bay.column_widths_m is None or bay.row_depths_m is None)
    table = capacity_table(site, bay)
    open_to_stalls = site.cells == Cell.FREE
    if chosen_later or not open_to_stalls.any() or (table.along_x + table.along_z)[open_to_stalls].any():
        return
    across_m, along_m = bay.stall_width_m + bay.column_size_m, bay.stall_length_m
    stall = f"a stall of {bay.stall_width_m:g} x {bay.stall_length_m:g} m beside a column of {bay.column_size_m:g} m"
    smaller = "or a smaller bay.stall_width_m, bay.stall_length_m or bay.column_size_m"
    if bay.column_widths_m is None and bay.row_depths_m is None:
        least_m = max(across_m, along_m)
        raise ConfigError("bay.square_side_m", bay.square_side_m, f"at least {least_m:g} m for {stall}; {smaller}")
    sizes = (site.column_widths_mm / 1000).tolist(), (site.row_depths_mm / 1000).tolist()
    least = f"a column and a row of at least {across_m:g} and {along_m:g} m, either way round"
    raise ConfigError("bay.column_widths_m, bay.row_depths_m", sizes, f"{least}, for {stall}; {smaller}")
