"""Maps of a garage of several levels, as CARLA, SUMO, ASAM's checker and Lanelet2 read them."""

import xml.etree.ElementTree as ET

import networkx as nx
import numpy as np
import pytest
import shapely
from support.level_judge import LevelJudge
from support.map_judges import HAS_JUDGES, HAS_LANELET2, asam_issues, carla_map, lanelet2_map, sumo_spaces
from support.sample_files import LEVELS_SAMPLE

import garage2usd
from garage2usd.buildings import build_levels

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(not (HAS_JUDGES and HAS_LANELET2), reason="no environment with the programs that judge maps"),
]
SAMPLE = LEVELS_SAMPLE
STOREY_M, NEAR_M = 3.6, 6.0


@pytest.fixture(scope="module")
def exported(tmp_path_factory):
    folder = tmp_path_factory.mktemp("levels")
    config = garage2usd.load_config(SAMPLE)
    smaller = config.site.model_copy(update={"width_cells": 8, "height_cells": 9})  # ASAM's checker is slow
    stage = build_levels(config.model_copy(update={"site": smaller}), folder / "garage.usdc").stage
    garage2usd.export(stage, [folder / "garage.xodr", folder / "garage.osm"])
    return LevelJudge(stage), folder / "garage.xodr", folder / "garage.osm"


def test_carla_keeps_the_levels_apart_and_drives_from_the_lowest_to_the_street(exported, tmp_path):
    judge, path, _ = exported
    points, ways = carla_map(path, tmp_path)
    heights = points[:, 4]
    on_floors = np.isclose(heights[:, None], [0.0, -STOREY_M], atol=1e-3).any(axis=1)
    # all others lie on the ramps of the lane graph, or on those to the street, above
    ramps = judge.ramps()
    off = (heights < -1e-3) & ~on_floors
    assert off.sum() > 100
    for x, z, height in points[off][:, [2, 3, 4]]:
        found = [
            np.interp(_along(ramp, (x, z)), _runs(ramp), ramp[:, 1]) for ramp in ramps if _aside_m(ramp, (x, z)) < 2.0
        ]
        assert np.abs(np.array(found) - height).min() < 1e-3
    roads = nx.DiGraph(ways)
    street = {(int(row[0]), int(row[1])) for row in points if row[4] > 3.0}  # at the top of a ramp to the street
    out = set().union(*(nx.ancestors(roads, lane) for lane in street if lane in roads))
    into = set().union(*(nx.descendants(roads, lane) for lane in street if lane in roads))
    low = points[np.abs(heights + STOREY_M) < 1e-3]
    names = [(int(row[0]), int(row[1])) for row in low]
    leads_out, is_led_to = (np.array([name in lanes for name in names]) for lanes in (out, into))
    for mouth in _mouths(judge, level=1):
        is_near = np.linalg.norm(low[:, 2:4] - mouth, axis=1) < NEAR_M
        assert (is_near & leads_out).any()
        assert (is_near & is_led_to).any()


def test_asam_s_checker_has_no_issue_and_sumo_places_every_space(exported, tmp_path):
    judge, path, _ = exported
    assert asam_issues(path, tmp_path) == []
    spaces = sumo_spaces(path, tmp_path)
    names = {
        int(thing.get("id")): thing.get("name")
        for thing in ET.parse(path).getroot().iter("object")
        if thing.get("type") == "parkingSpace"
    }
    assert spaces.keys() == names.keys()
    outlines = dict(zip(judge.stall_ids, judge.outlines, strict=True))
    for number, name in names.items():
        placed, stall = shapely.Polygon(spaces[number]), shapely.Polygon(outlines[name][:, [0, 2]])
        assert placed.hausdorff_distance(stall) < 1e-3


def test_lanelet2_routes_from_every_stall_of_the_lowest_level_to_the_street(exported, tmp_path):
    judge, _, path = exported
    found = lanelet2_map(path, tmp_path, 49.0, 9.0)
    assert found["errors"] == []
    lanelets = {lanelet["id"]: lanelet for lanelet in found["lanelets"]}
    heights = {
        number: np.array([place[2] for side in ("left", "right") for place in lanelet[side]["places"]])
        for number, lanelet in lanelets.items()
    }
    street = {number for number, height in heights.items() if height.max() > 3.0}
    assert len(street) == 2
    routes = nx.DiGraph((number, other) for number, lanelet in lanelets.items() for other in lanelet["following"])
    out = set().union(*(nx.ancestors(routes, number) for number in street))
    into = set().union(*(nx.descendants(routes, number) for number in street))
    low = {
        number: shapely.Polygon(
            [place[:2] for place in (*lanelet["left"]["places"], *reversed(lanelet["right"]["places"]))]
        )
        for number, lanelet in lanelets.items()
        if np.abs(heights[number] + STOREY_M).max() < 2e-3
    }
    for x, z in _mouths(judge, level=1):
        near = {number for number, ground in low.items() if ground.distance(shapely.Point(x, -z)) < NEAR_M}
        assert near & out
        assert near & into
    # a level's lanelets never touch those of another but over ramps
    for number, lanelet in lanelets.items():
        for other in lanelet["following"]:
            assert abs(heights[number].mean() - heights[other].mean()) < STOREY_M / 2 + 1e-3
    assert sorted(set(judge.names)) == ["U1", "U2"]


def _mouths(judge, *, level):
    """Middles (x, z) of the mouths of a level's stalls."""
    is_here = np.array(judge.stall_levels) == level
    return judge.outlines[is_here][:, :2][..., [0, 2]].mean(axis=1)


def _runs(ramp):
    return np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(ramp[:, [0, 2]], axis=0), axis=1))])


def _along(ramp, place):
    way = (ramp[-1] - ramp[0])[[0, 2]]
    return (np.array(place) - ramp[0, [0, 2]]) @ way / np.linalg.norm(way)


def _aside_m(ramp, place):
    way = (ramp[-1] - ramp[0])[[0, 2]] / np.linalg.norm((ramp[-1] - ramp[0])[[0, 2]])
    away = np.array(place) - ramp[0, [0, 2]]
    return abs(away[0] * way[1] - away[1] * way[0])
