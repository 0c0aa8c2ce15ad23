"""The smallest usual garage of two levels."""

from garage2usd import GarageConfig

FLOORS_M = {"U1": 0.0, "U2": -3.6}
SMALL_LEVELS = GarageConfig(
    seed=5,
    building={"levels": 2, "storey_m": 3.6},
    site={"width_cells": 9, "height_cells": 9},
    bay={"square_side_m": 8.1},
    plan={"episodes": 60, "starts": 1},
    parking={"occupancy": 0.1},
)
