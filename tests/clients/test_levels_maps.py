"""Maps of a garage of several levels, as CARLA, SUMO, ASAM's checker and Lanelet2 read them."""

import pytest
from support.level_judge import LevelJudge
from support.level_map_judge import LevelMapJudge
from support.map_judges import HAS_JUDGES, HAS_LANELET2, asam_issues
from support.sample_files import HELIX_SAMPLE, LEVELS_SAMPLE
from support.soak import soak_but

import garage2usd
from garage2usd.pipeline import build

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(not (HAS_JUDGES and HAS_LANELET2), reason="no environment with the programs that judge maps"),
]
SITES = {LEVELS_SAMPLE: {"width_cells": 8, "height_cells": 9}, HELIX_SAMPLE: {}}
"""Changes of the samples' sites: ASAM's checker is slow."""


@pytest.fixture(scope="module", params=soak_but([HELIX_SAMPLE], SITES), ids=lambda path: path.stem)
def exported(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp("levels")
    config = garage2usd.load_config(request.param)
    smaller = config.site.model_copy(update=SITES[request.param])
    stage = build(config.model_copy(update={"site": smaller}), folder / "garage.usdc").stage
    garage2usd.export(stage, [folder / "garage.xodr", folder / "garage.osm"])
    judge = LevelMapJudge(LevelJudge(stage), config.building.storey_m, folder)
    return judge, folder / "garage.xodr", folder / "garage.osm"


def test_carla_drives_on_floors_and_ramps_from_the_lowest_level_to_the_street_and_back(exported):
    judge, path, _ = exported
    assert [*judge.of_carla(path)] == []


def test_sumo_places_every_space(exported):
    judge, path, _ = exported
    assert [*judge.of_sumo(path)] == []


def test_lanelet2_routes_from_every_stall_of_the_lowest_level_to_the_street_and_back(exported):
    judge, _, path = exported
    assert [*judge.of_lanelet2(path)] == []


@pytest.mark.soak
def test_asam_s_checker_has_no_issue(exported, tmp_path):
    _, path, _ = exported
    assert asam_issues(path, tmp_path) == []
