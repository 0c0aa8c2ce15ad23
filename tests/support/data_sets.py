"""Small data sets for tests."""

import hashlib

from garage2usd.datasets import Recipe

SMALL = {
    "name": "small",
    "seed": 3,
    "count": 6,
    "garage": {
        "site": {"width_cells": {"range": [4, 6]}, "height_cells": {"range": [4, 5]}},
        "plan": {"episodes": 60, "climb": False},
        "parking": {"occupancy": {"range": [0.2, 0.9]}},
    },
    "shards": {"garages": 2},
    "splits": {"train": 4, "test": 2},
}


LIDAR = {
    "kind": "solid_state_lidar",
    "name": "front",
    "position_m": [3.0, 0.0, 0.6],
    "horizontal_deg": 100.0,
    "vertical_deg": 20.0,
    "range_m": [0.3, 50.0],
}
"""A LiDAR of a rig, without its columns and rows."""


def small_recipe(**changes):
    """A recipe of six garages of at most 5 x 6 squares, in three shards."""
    return Recipe(**{**SMALL, **changes})


def tree_of(folder):
    """SHA-256 of each file below a folder, by its path."""
    return {
        path.relative_to(folder).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }
