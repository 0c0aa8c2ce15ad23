"""Drives of the design car from the street to each level and back, judged on the meshes of the stage."""

import numpy as np
import pytest

from garage2usd.as_built.levels import built_levels
from garage2usd.maps.level_drives import LevelsDrivePlanner
from garage2usd.reading.files import open_stage

GROOVE_M, GROOVES, SIDES = 8e-3, 0.22, 0.05
"""Depth of a groove across a ramp, and the greatest shares of a ramp that are grooves, and upright sides of these."""


def cars_drive_to_each_level(path, judge):
    """The first stall of each level is reached from the street and left to it, on the floors and ramps all the way."""
    garage = built_levels(open_stage(path), path)
    planner, ground = LevelsDrivePlanner(garage), judge.ground()
    for number, level in enumerate(garage.levels):
        stall = next(stall for stall in garage.stalls if stall.takes_cars and stall.level == number)
        drive = planner.drive(stall.name)
        states = drive.trajectory
        assert drive.route.stall == stall.name
        assert states.y_m[[0, -1]].min() > 2.0  # on the ramps to and from the street
        assert states.y_m.min() == pytest.approx(level.place.floor_m, abs=1e-4)
        places = np.stack([states.x_m, states.y_m, states.z_m], axis=1)
        heights, _ = ground.nearest(places)
        off = np.abs(heights - places[:, 1])
        is_sloped = (np.abs(places[:, 1, None] - [each.place.floor_m for each in garage.levels]) > 1e-3).all(axis=1)
        assert off[~is_sloped].max() < 1e-3
        is_beside = ~(off[is_sloped] < GROOVE_M + 1e-3)  # nothing lies under a place over the side of a groove
        assert is_beside.mean() < SIDES
        assert (off[is_sloped][~is_beside] > 1e-3).mean() < GROOVES
