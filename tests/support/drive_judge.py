"""Drives of the design car from the street to each level and back, judged on the meshes of the stage."""

import numpy as np
import pytest

from garage2usd.as_built.garage import garage_of_file
from garage2usd.maps.drives import DrivePlanner

MILLIMETRE = 1e-3
GROOVE_M, GROOVES, SIDES = 8e-3, 0.22, 0.05
"""Depth of a groove for grip across a ramp, and the greatest shares of a ramp that are grooves, and sides of these."""


def assert_on_the_ground(ground, places, floors_m, within_m=MILLIMETRE):
    """All places, (x, y, z) with Y up, lie close to a floor, to a ramp, or to a ramp over a groove."""
    heights, _ = ground.nearest(places)
    off = np.abs(heights - places[:, 1])
    is_sloped = (np.abs(places[:, 1, None] - [*floors_m]) > MILLIMETRE).all(axis=1)
    assert off[~is_sloped].max(initial=0.0) < within_m
    # nothing lies under a place just over the upright side of a groove, but for another level
    over_groove = is_sloped & ~(off < within_m)
    is_beside = np.isnan(off) | (off > 1.0)
    assert off[over_groove & ~is_beside].max(initial=0.0) < GROOVE_M + within_m
    return is_sloped.sum(), over_groove.sum(), is_beside.sum()


def assert_driven_on(ground, places, floors_m, within_m=MILLIMETRE):
    """As `assert_on_the_ground`, of a whole drive, of which few places lie over grooves; return the number on ramps."""
    sloped, over_groove, beside = assert_on_the_ground(ground, places, floors_m, within_m)
    assert over_groove < GROOVES * sloped
    assert beside < SIDES * sloped
    return sloped


def cars_drive_to_each_level(path, judge):
    """The first stall of each level is reached from the street and left to it, on the floors and ramps all the way."""
    garage = garage_of_file(path)
    planner, ground = DrivePlanner(garage), judge.ground()
    floors_m = [level.place.floor_m for level in garage.levels]
    for number, floor_m in enumerate(floors_m):
        stall = next(stall for stall in garage.stalls if stall.takes_cars and stall.level == number)
        drive = planner.drive(stall.name)
        states = drive.trajectory
        assert drive.route.stall == stall.name
        assert states.y_m[[0, -1]].min() > 2.0  # on the ramps to and from the street
        assert states.y_m.min() == pytest.approx(floor_m, abs=1e-4)
        assert_driven_on(ground, np.stack([states.x_m, states.y_m, states.z_m], axis=1), floors_m)
