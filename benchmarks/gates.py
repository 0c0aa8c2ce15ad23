"""Sites of 7 x 9 squares that planners are measured on."""

import numpy as np

from garage2usd.config import BayConfig, SiteConfig
from garage2usd.grid import Structure
from garage2usd.site import make_site

__all__ = ["GATES", "held_out", "site_of"]

ROWS, COLS = 7, 9
LEAST_PORTAL_DISTANCE = 4
SIDES_M = (5.5, 6.3, 7.2, 7.5, 7.8, 8.1, 8.4, 9.0)

GATES = {"G1": ((6, 2), (6, 6)), "G2": ((6, 4), (0, 4)), "G3": ((3, 0), (3, 8))}
"""Entrance and exit of the gates that the presets were tuned on; every bay is 8.1 m square."""


def site_of(entrance: tuple[int, int], exit_: tuple[int, int], bay: BayConfig) -> Structure:
    """Empty squares with one entrance and one exit, as (row, col)."""
    config = SiteConfig(width_cells=COLS, height_cells=ROWS, entrance_cells=(entrance,), exit_cells=(exit_,))
    return make_site(config, bay=bay, seed=0)


def held_out(count: int = 10, *, seed: int = 20261121) -> dict[str, tuple[Structure, BayConfig]]:
    """Gates and bays drawn at random, on which nothing was tuned; (site, bay) by name."""
    rng = np.random.default_rng(seed)
    border = [(r, c) for r in range(ROWS) for c in range(COLS) if r in (0, ROWS - 1) or c in (0, COLS - 1)]
    drawn = {}
    while len(drawn) < count:
        entrance, exit_ = (border[index] for index in rng.integers(len(border), size=2))
        width, depth = (float(side) for side in rng.choice(SIDES_M, size=2))
        if abs(entrance[0] - exit_[0]) + abs(entrance[1] - exit_[1]) < LEAST_PORTAL_DISTANCE:
            continue
        bay = BayConfig(column_widths_m=width, row_depths_m=depth)
        name = f"H{len(drawn) + 1} E{entrance} X{exit_}, {width} x {depth} m".replace(" ", "")
        drawn[name] = (site_of(entrance, exit_, bay), bay)
    return drawn
