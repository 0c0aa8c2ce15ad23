"""Garages of several levels, judged on their written stages by pxr, networkx and trimesh."""

import pytest
from support.drive_judge import cars_drive_to_each_level
from support.level_judge import (
    a_ray_down_each_stall_meets_one_floor,
    built_and_judged,
    columns_stand_above_one_another,
    levels_keep_apart,
    stairs_lead_up_to_the_street,
)
from support.ramp_judge import a_car_drives_over
from support.sign_judge import signs_are_right

from garage2usd import GarageConfig
from garage2usd.profiles import PROFILE_NAMES


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


@pytest.mark.soak
@pytest.mark.parametrize("seed", range(5))
def test_a_garage_of_several_levels_stands_is_reached_and_is_driven(seed, tmp_path):
    config = settings(seed)
    made, judge = built_and_judged(config, tmp_path / "garage.usda")
    assert judge.names == [f"U{number + 1}" for number in range(config.building.levels)]
    assert len(set(judge.numbers) - {""}) == sum(number != "" for number in judge.numbers)
    columns_stand_above_one_another(judge, made.garage)
    levels_keep_apart(judge, config)
    stairs_lead_up_to_the_street(judge)
    assert any(judge.shafts[judge.names[-1]]) or config.site.obstacles
    a_ray_down_each_stall_meets_one_floor(judge, config)
    ramps = judge.ramps()
    assert len(ramps) == 2 * (config.building.levels - 1)
    signs_are_right(judge, config)
    for ramp in ramps:
        a_car_drives_over(ramp, judge, config)
    cars_drive_to_each_level(made.stage, judge)
