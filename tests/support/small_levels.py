"""The smallest usual garages of several levels."""

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
SMALL_HELICES = GarageConfig(
    **{
        **SMALL_LEVELS.model_dump(mode="json"),
        "seed": 2,
        "building": {"levels": 3, "storey_m": 3.6, "ramps": "helix"},
        "site": {"width_cells": 10, "height_cells": 9},
    }
)
"""Three levels with helices."""
LIDAR = {
    "kind": "spinning_lidar",
    "name": "top",
    "position_m": [0.6, 0.0, 1.8],
    "channels": 24,
    "lowest_deg": -30.0,
    "highest_deg": 10.0,
    "azimuth_steps": 512,
    "range_m": [0.5, 100.0],
    "range_noise_m": 0.0,
}
"""A LiDAR on the roof of a car that drives there."""
