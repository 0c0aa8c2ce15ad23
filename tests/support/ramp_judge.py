"""Judge of ramps between levels by the meshes of all levels: what a large car meets on its way over them."""

from itertools import pairwise

import numpy as np
import pytest

from support.coil_judge import CoilJudge
from support.level_judge import GROUND, above, belly_m, first_hits

SIDE_M, ROOM_BESIDE_M = 1.4, 0.25
"""Least width on either side of the middle of a straight ramp, and beside a large car on a helix."""
HEIGHTS_M = (0.3, 1.0, 1.8)
GROOVES_M = 0.01
"""Depth of grooves, and a little."""
STEEPEST_PERCENT = {"cn-jgj100": 12.0, "de-garvo": 15.0, "uk-istructe": 10.0, "us-ada": 15.0}
"""Along the inner wall of a helix."""


def a_car_drives_over(ramp, judge, config):
    """Slope, steps, headroom, width and belly along a straight ramp."""
    building = config.building
    runs = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(ramp[:, [0, 2]], axis=0), axis=1))])
    at = np.arange(0.0, runs[-1], 0.1)
    line = np.stack([np.interp(at, runs, ramp[:, axis]) for axis in range(3)], axis=1)
    everything = judge.mesh()
    depth = first_hits(judge.mesh(*GROUND, "speed_bump"), above(line, 0.5), np.tile([0.0, -1.0, 0.0], (len(line), 1)))
    heights = line[:, 1] + 0.5 - depth
    # but for grooves the surface is where the lane graph has it
    assert np.abs(heights - line[:, 1]).max() < GROOVES_M
    assert abs(heights[0] - heights[-1]) == pytest.approx(building.storey_m, abs=GROOVES_M)
    slopes = np.abs(np.diff(line[:, 1])) / 0.1
    assert slopes.max() <= building.ramp_slope_percent / 100 + 1e-6
    assert belly_m(at, line[:, 1]) > 0.03
    assert belly_m(at, line[::-1, 1]) > 0.03
    ahead = (ramp[-1] - ramp[0])[[0, 2]] / runs[-1]
    aside = np.array([ahead[1], 0.0, -ahead[0]])
    over = 0.02 + first_hits(everything, above(line, 0.02), np.tile([0.0, 1.0, 0.0], (len(line), 1)))
    assert over.min() >= config.fittings.clear_height_m - 1e-5  # single precision
    for height_m in HEIGHTS_M:
        for side in (1.0, -1.0):
            clear = first_hits(everything, above(line, height_m), np.tile(side * aside, (len(line), 1)))
            assert clear.min() > SIDE_M


def a_large_car_drives_over(ramp, walls, config):
    """Turn, slope at the inner wall, surface, belly and nose, headroom and swept path on a helix; return the drive.

    `walls` is the `CoilJudge` of the garage.
    """
    assert CoilJudge.turned_deg(ramp) == pytest.approx(270.0, abs=1.0)
    drive = walls.drive(ramp)
    assert abs(ramp[0][1] - ramp[-1][1]) == pytest.approx(config.building.storey_m, abs=1e-4)
    assert np.abs(drive.floor_m - drive.line[:, 1]).max() < GROOVES_M
    assert np.abs([high - low for low, high in pairwise(drive.floor_m)]).max() < 0.02  # no step in 0.1 m
    assert 4.0 < drive.inner_slope_percent <= STEEPEST_PERCENT[config.profile] + 0.1
    assert drive.inner_radius_m >= 6.0 - 0.05
    assert drive.belly_m > 0.05
    assert drive.headroom_m >= config.fittings.clear_height_m - 1e-5  # single precision
    assert drive.beside_m > ROOM_BESIDE_M
    return drive
