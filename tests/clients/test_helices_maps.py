"""Maps of a garage with helices between its levels, as CARLA, SUMO and Lanelet2 read them."""

import xml.etree.ElementTree as ET

import networkx as nx
import numpy as np
import pytest
from support.coil_judge import CoilJudge
from support.level_judge import LevelJudge
from support.map_judges import HAS_JUDGES, HAS_LANELET2, carla_map, lanelet2_map, sumo_spaces
from support.sample_files import HELIX_SAMPLE

import garage2usd
from garage2usd.buildings import build_levels

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(not (HAS_JUDGES and HAS_LANELET2), reason="no environment with the programs that judge maps"),
]
FLOORS_M = (0.0, -3.6, -7.2)
NEAR_M = 6.0


@pytest.fixture(scope="module")
def exported(tmp_path_factory):
    folder = tmp_path_factory.mktemp("helices")
    stage = build_levels(garage2usd.load_config(HELIX_SAMPLE), folder / "garage.usdc").stage
    garage2usd.export(stage, [folder / "garage.xodr", folder / "garage.osm"])
    return LevelJudge(stage), folder / "garage.xodr", folder / "garage.osm"


def test_carla_drives_over_the_helices_surface_from_the_lowest_level_to_the_street(exported, tmp_path):
    judge, path, _ = exported
    points, ways = carla_map(path, tmp_path)
    heights = points[:, 4]
    off = points[(heights < -1e-3) & ~np.isclose(heights[:, None], FLOORS_M, atol=1e-3).any(axis=1)]
    assert len(off) > 100
    surface = CoilJudge(judge).floor_m(off[:, [2, 4, 3]] + [0, 0.5, 0])
    assert np.abs(surface - off[:, 4]).max() < 0.01
    roads = nx.DiGraph(ways)
    street = {(int(row[0]), int(row[1])) for row in points if row[4] > 3.0}  # at the top of a ramp to the street
    out, into = _led(roads, street)
    low = points[np.abs(heights - FLOORS_M[-1]) < 1e-3]
    names = [(int(row[0]), int(row[1])) for row in low]
    for lanes in (out, into):
        leads = np.array([name in lanes for name in names])
        for mouth in _mouths(judge, level=2):
            assert (leads & (np.linalg.norm(low[:, 2:4] - mouth, axis=1) < NEAR_M)).any()


def test_sumo_places_every_space(exported, tmp_path):
    _, path, _ = exported
    things = ET.parse(path).getroot().iter("object")
    spaces = {int(thing.get("id")) for thing in things if thing.get("type") == "parkingSpace"}
    assert len(spaces) > 300
    assert sumo_spaces(path, tmp_path).keys() == spaces


def test_lanelet2_routes_from_the_lowest_level_to_the_street_over_lanelets_that_turn(exported, tmp_path):
    _, _, path = exported
    found = lanelet2_map(path, tmp_path, 49.0, 9.0)
    assert found["errors"] == []
    heights = {
        lanelet["id"]: np.array([place[2] for side in ("left", "right") for place in lanelet[side]["places"]])
        for lanelet in found["lanelets"]
    }
    routes = nx.DiGraph((lanelet["id"], other) for lanelet in found["lanelets"] for other in lanelet["following"])
    out, into = _led(routes, {number for number, height in heights.items() if height.max() > 3.0})
    helices = {number for number, height in heights.items() if np.ptp(height) == pytest.approx(3.6, abs=2e-3)}
    assert len(helices & {number for number, height in heights.items() if height.max() < 1e-3}) == 4
    assert helices <= out | into
    low = {number for number, height in heights.items() if np.abs(height - FLOORS_M[-1]).max() < 2e-3}
    assert low & out
    assert low & into


def _led(ways, street):
    """What leads to the street, and what the street leads to."""
    out = set().union(*(nx.ancestors(ways, lane) for lane in street if lane in ways))
    return out, set().union(*(nx.descendants(ways, lane) for lane in street if lane in ways))


def _mouths(judge, *, level):
    """Middles (x, z) of the mouths of a level's stalls."""
    is_here = np.array(judge.stall_levels) == level
    return judge.outlines[is_here][:, :2][..., [0, 2]].mean(axis=1)
