"""Garages with helices between levels, judged on their written stages by pxr, networkx and numpy."""

import networkx as nx
import numpy as np
import pytest
from support.coil_judge import CoilJudge
from support.drive_judge import cars_drive_to_each_level
from support.level_judge import built_and_judged
from support.ramp_judge import a_large_car_drives_over
from support.sign_judge import signs_are_right

from garage2usd import GarageConfig
from garage2usd.as_built.contents import read_contents
from garage2usd.as_built.driven_road import DrivenFloor
from garage2usd.config.site import BuildingConfig
from garage2usd.pipeline import generate
from garage2usd.profiles import PROFILE_NAMES
from garage2usd.reading.labels import read_labels
from garage2usd.reading.lanes import read_lanes
from garage2usd.reading.levels import levels_of
from garage2usd.sensors.rays.driven_surface import DrivenSurface


def settings(number):
    return GarageConfig(
        seed=number,
        profile=PROFILE_NAMES[number],
        site={"width_cells": 10, "height_cells": 9, "obstacles": number % 2},
        building={"levels": (2, 2, 3, 2)[number], "ramps": "helix", "storey_m": 3.6 + 0.15 * (number % 2)},
        plan={"episodes": 40, "starts": 1},
        parking={"occupancy": 0.0},
        fittings={"floor_stain_rate": 0.0, **dict.fromkeys(("beams", "ducts", "cable_trays", "sprinklers"), False)},
        bay={"dimensioned": True} if number == 1 else {"square_side_m": 8.1},
    )


@pytest.mark.soak
@pytest.mark.parametrize("number", range(4))
def test_helices_are_reached_and_a_large_car_drives_over_them(number, tmp_path):
    config = settings(number)
    made, judge = built_and_judged(config, tmp_path / "garage.usdc")
    ramps = judge.ramps()
    assert len(ramps) == 2 * (config.building.levels - 1)
    signs_are_right(judge, config)
    walls = CoilJudge(judge)
    for ramp in ramps[-2:]:
        drive = a_large_car_drives_over(ramp, walls, config)
        _free_space_covers(drive, judge.stage)
    cars_drive_to_each_level(made.stage, judge)


def test_four_levels_have_a_helix_down_and_one_up_between_each_two():
    config = settings(0).model_copy(update={"building": BuildingConfig(levels=4, ramps="helix")})
    lanes = generate(config).joined.lane_graph
    for lower in (1, 2, 3):
        between = [
            number
            for number, node in enumerate(lanes.nodes)
            if -3.6 * lower + 0.01 < node.height_m < -3.6 * (lower - 1) - 0.01
        ]
        parts = [*nx.weakly_connected_components(lanes.graph.subgraph(between))]
        assert len(parts) == 2
        rises = [
            [lanes.nodes[number].height_m for number in nx.topological_sort(lanes.graph.subgraph(p))] for p in parts
        ]
        assert {tuple(heights) == tuple(sorted(heights)) for heights in rises} == {True, False}


def _free_space_covers(drive, stage):
    """The middle of the lane is free on the surface that the triangles have, above and below it nothing is."""
    floors = DrivenFloor.of_levels(levels_of(stage), read_lanes(stage).graph, read_contents(stage).things)
    surface = DrivenSurface(stage, floors, read_labels(stage, None))
    lane = np.column_stack([drive.line[:, 0], drive.floor_m, drive.line[:, 2]])
    assert surface.is_free(lane).all()
    sloped = lane[np.abs(lane[:, 1] - lane[[0], 1]) > 0.5]
    sloped = sloped[np.abs(sloped[:, 1] - lane[[-1], 1]) > 0.5]
    assert not surface.is_free(sloped + np.array([0.0, 0.3, 0.0])).any()
    assert not surface.is_free(sloped - np.array([0.0, 0.3, 0.0])).any()
