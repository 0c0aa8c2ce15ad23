"""A garage of a layout without a grid: its maps and stage in programs that are not ours."""

import pytest
from pxr import Usd, UsdValidation
from support.map_judges import HAS_JUDGES, asam_issues
from support.opendrive_judge import MapJudge
from support.sample_files import REPOSITORY

import garage2usd
from garage2usd.imports import import_layout
from garage2usd.survey.reader import read_survey

pytestmark = pytest.mark.client
needs_judges = pytest.mark.skipif(not HAS_JUDGES, reason="no environment with asam-qc-opendrive, CARLA and SUMO")


@pytest.fixture(scope="module")
def exported(tmp_path_factory):
    folder = tmp_path_factory.mktemp("imported")
    made = import_layout(REPOSITORY / "samples/surveys/lot.toml", folder / "lot.usdc")
    return made, *garage2usd.export(made.stage, [folder / "lot.xodr", folder / "lot.osm"])


def test_usd_validation_finds_nothing(exported):
    registry = UsdValidation.ValidationRegistry()
    context = UsdValidation.ValidationContext(registry.GetOrLoadAllValidators())
    stage = Usd.Stage.Open(str(exported[0].stage))
    assert [f"{found.GetName()} {found.GetMessage()}" for found in context.Validate(stage)] == []


@needs_judges
@pytest.mark.soak
def test_asam_s_checker_has_no_issue(exported, tmp_path):
    assert asam_issues(exported[1], tmp_path) == []


@needs_judges
def test_carla_and_sumo_drive_as_the_lane_graph_does(exported, tmp_path):
    judge = MapJudge(exported[0].stage, exported[1], tmp_path)
    assert [*judge.of_carla(), *judge.of_sumo(), *judge.of_objects()] == []


@pytest.mark.parametrize("number", [1, 2], ids=["OpenDRIVE", "Lanelet2"])
def test_the_map_is_read_back_as_the_same_layout(number, exported):
    stalls = exported[0].garage.layout.quads
    found = read_survey(exported[number]).stall_polygons()
    assert len(found) == len(stalls)
    for stall in stalls:
        assert min(stall.polygon.hausdorff_distance(other) for other in found) < 0.01, stall.name
