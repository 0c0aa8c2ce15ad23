"""Maps of a garage with stalls for motorcycles, as programs of others read them."""

import pytest
from support.lanelet2_judge import Lanelet2Judge
from support.map_judges import HAS_JUDGES, HAS_LANELET2, asam_issues
from support.opendrive_judge import MapJudge

import garage2usd

pytestmark = pytest.mark.client
SETTINGS = {
    "seed": 5,
    "site": {"width_cells": 8, "height_cells": 6},
    "plan": {"episodes": 100, "starts": 1},
    "stalls": {"sizes": {"standard": 0.8, "motorcycle": 0.2}},
}


@pytest.fixture(scope="module")
def stage(tmp_path_factory):
    folder = tmp_path_factory.mktemp("motorcycles")
    return garage2usd.build(garage2usd.GarageConfig(**SETTINGS), folder / "g.usdc").stage


@pytest.mark.soak
@pytest.mark.skipif(not HAS_JUDGES, reason="no environment with asam-qc-opendrive, CARLA and SUMO")
def test_opendrive_s_judges_have_nothing_against_them(stage, tmp_path):
    (path,) = garage2usd.export(stage, [tmp_path / "g.xodr"])
    assert asam_issues(path, tmp_path) == []
    assert list(MapJudge(stage, path, tmp_path).complaints()) == []


@pytest.mark.skipif(not HAS_LANELET2, reason="no environment with lanelet2")
def test_lanelet2_has_them(stage, tmp_path):
    (path,) = garage2usd.export(stage, [tmp_path / "g.osm"])
    assert list(Lanelet2Judge(stage, path, tmp_path).complaints()) == []
