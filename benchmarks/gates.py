"""Sites of 7 x 9 squares that planners are measured on."""

import numpy as np

from garage2usd.config import BayConfig, SiteConfig
from garage2usd.site import make_site
from garage2usd.structure.grid import Cell, Structure

__all__ = ["GATES", "GATE_BAY", "held_out", "site_of"]

ROWS, COLS = 7, 9
SIDES_M = (5.5, 6.3, 7.2, 7.5, 7.8, 8.1, 8.4, 9.0)

GATES = {"G1": ((6, 2), (6, 6)), "G2": ((6, 4), (0, 4)), "G3": ((3, 0), (3, 8))}
"""Entrance and exit of the gates that the presets were tuned on."""
GATE_BAY = BayConfig(dimensioned=False)
"""Every bay of these gates is 8.1 m square and stays so: y' of other R and C cannot be compared."""


def site_of(entrance: tuple[int, int], exit_: tuple[int, int], bay: BayConfig) -> Structure:
    """Empty squares with one entrance and one exit, as (row, col)."""
    config = SiteConfig(width_cells=COLS, height_cells=ROWS, entrance_cells=(entrance,), exit_cells=(exit_,))
    return make_site(config, bay=bay, seed=0)


def held_out(count: int = 10, *, seed: int = 20261121) -> dict[str, tuple[Structure, BayConfig]]:
    """Portals placed by the paper's rules and bays, both drawn at random, on which nothing was tuned; by name."""
    rng = np.random.default_rng(seed)
    drawn = {}
    for index in range(count):
        width, depth = (float(side) for side in rng.choice(SIDES_M, size=2))
        bay = BayConfig(column_widths_m=width, row_depths_m=depth)
        site = make_site(SiteConfig(width_cells=COLS, height_cells=ROWS), bay=bay, seed=seed + index)
        (entrance,), (exit_,) = site.where(Cell.ENTRANCE), site.where(Cell.EXIT)
        name = f"H{index + 1} E{entrance} X{exit_}, {width} x {depth} m"
        drawn[name] = (site, bay)
    return drawn
