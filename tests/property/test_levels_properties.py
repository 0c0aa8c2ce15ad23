"""Garages of several levels, judged on their written stages by pxr, networkx and trimesh."""

from itertools import pairwise

import numpy as np
import pytest
from support.drive_judge import cars_drive_to_each_level
from support.level_judge import above, belly_m, built_and_judged, first_hits, floors_under
from support.sign_judge import signs_are_right

from garage2usd import GarageConfig
from garage2usd.profiles import PROFILE_NAMES

FLOORS = ("floor", "parking_stall", "ramp", "hatching", "crossing", "stall_symbol", "stall_line", "stall_number")
"""Classes of what lies on floors: paint is cut out of them."""


def settings(seed):
    bay = {"square_side_m": 8.1} if seed % 3 else {}
    return GarageConfig(
        seed=seed,
        profile=PROFILE_NAMES[seed % len(PROFILE_NAMES)],
        site={"width_cells": 10 + seed % 3, "height_cells": 11 + seed % 2, "obstacles": seed % 2},
        building={"levels": 2 + seed % 2, "storey_m": 3.6 + 0.3 * (seed % 2)},
        plan={"episodes": 100, "starts": 1, "aisles": ("two-way", "mixed")[seed % 2]},
        parking={"occupancy": 0.2},
        bay=bay,
    )


@pytest.mark.parametrize("seed", range(5))
def test_a_garage_of_several_levels_stands_is_reached_and_is_driven(seed, tmp_path):
    config = settings(seed)
    made, judge = built_and_judged(config, tmp_path / "garage.usda")
    assert judge.names == [f"U{number + 1}" for number in range(config.building.levels)]
    assert len(set(judge.numbers) - {""}) == sum(number != "" for number in judge.numbers)
    _columns_stand_above_one_another(judge, made.garage)
    _stairs_lead_up_to_the_street(judge)
    assert any(judge.shafts[judge.names[-1]]) or config.site.obstacles
    _a_ray_down_each_stall_meets_one_floor(judge, config)
    ramps = judge.ramps()
    assert len(ramps) == 2 * (config.building.levels - 1)
    signs_are_right(judge, config)
    for ramp in ramps:
        _a_car_drives_over(ramp, judge, config)
    cars_drive_to_each_level(made.stage, judge)


def _columns_stand_above_one_another(judge, garage):
    grids = []
    for structure in garage.building.levels:
        grids.append((structure.column_edges_m, structure.row_edges_m))
        assert np.array_equal(grids[0][0], grids[-1][0])
        assert np.array_equal(grids[0][1], grids[-1][1])
    corners = np.stack(np.meshgrid(*grids[0]), axis=-1).reshape(-1, 2)
    stands = []
    for name in judge.names:
        places = np.array(judge.columns[name])[:, [0, 2]]
        far = np.linalg.norm(places[:, None] - corners[None], axis=2)
        assert far.min(axis=1).max() < 1e-3
        stands.append(set(far.argmin(axis=1).tolist()))
    for structure, own in zip(garage.building.levels, stands, strict=True):
        for missing in set().union(*stands) - own:
            # a column that another level has is only missing where four lanes meet
            col = np.argmin(abs(structure.column_edges_m - corners[missing][0]))
            row = np.argmin(abs(structure.row_edges_m - corners[missing][1]))
            assert (structure.cells[row - 1 : row + 1, col - 1 : col + 1] > 0).all()


def _stairs_lead_up_to_the_street(judge):
    """Each core stands below one of the level above, on the same ground, with or without a door there."""
    for upper, lower in pairwise(judge.names):
        above_it = np.array([*judge.shafts[upper].values()])
        for ground in judge.shafts[lower].values():
            assert np.abs(above_it - ground).max(axis=1).min() < 1e-3
    assert not any(name.startswith("Shaft_") for name in judge.shafts[judge.names[-1]])


def _a_ray_down_each_stall_meets_one_floor(judge, config):
    floors = judge.mesh(*FLOORS)
    for outline, level in zip(judge.outlines, judge.stall_levels, strict=True):
        middle = outline.mean(axis=0)
        assert middle[1] == pytest.approx(-level * config.building.storey_m, abs=1e-4)
        found = floors_under(floors, middle)
        assert len(found) == 1
        assert found[0] == pytest.approx(middle[1], abs=0.06)


def _a_car_drives_over(ramp, judge, config):
    """Slope, steps, headroom, width and belly along a ramp, measured on the meshes of all levels."""
    building = config.building
    runs = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(ramp[:, [0, 2]], axis=0), axis=1))])
    at = np.arange(0.0, runs[-1], 0.1)
    line = np.stack([np.interp(at, runs, ramp[:, axis]) for axis in range(3)], axis=1)
    floors, everything = judge.mesh("ramp", "lane_arrow", "lane_line", "speed_bump", *FLOORS), judge.mesh()
    depth = first_hits(floors, above(line, 0.5), np.tile([0.0, -1.0, 0.0], (len(line), 1)))
    heights = line[:, 1] + 0.5 - depth
    # but for grooves of 8 mm the surface is where the lane graph has it
    assert np.abs(heights - line[:, 1]).max() < 0.01
    assert abs(heights[0] - heights[-1]) == pytest.approx(building.storey_m, abs=0.01)
    slopes = np.abs(np.diff(line[:, 1])) / 0.1
    assert slopes.max() <= building.ramp_slope_percent / 100 + 1e-6
    assert belly_m(at, line[:, 1]) > 0.03
    assert belly_m(at, line[::-1, 1]) > 0.03
    ahead = (ramp[-1] - ramp[0])[[0, 2]] / runs[-1]
    aside = np.array([ahead[1], 0.0, -ahead[0]])
    over = 0.02 + first_hits(everything, above(line, 0.02), np.tile([0.0, 1.0, 0.0], (len(line), 1)))
    assert over.min() >= config.fittings.clear_height_m - 1e-5  # single precision
    for height_m in (0.3, 1.0, 1.8):
        for side in (1.0, -1.0):
            clear = first_hits(everything, above(line, height_m), np.tile(side * aside, (len(line), 1)))
            assert clear.min() > 1.4
