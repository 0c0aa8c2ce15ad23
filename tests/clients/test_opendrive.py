"""OpenDRIVE maps of the samples, judged by ASAM's checker, CARLA, SUMO and the equations of the standard."""

import pytest
from support.map_faults import Fault, first_complaint, planted
from support.map_judges import HAS_JUDGES, asam_issues
from support.opendrive_judge import MapJudge
from support.sample_files import REPOSITORY, SAMPLES, each_sample
from support.soak import soak_but

import garage2usd
from garage2usd.config.outputs import MapsConfig
from garage2usd.garage_sources import read_built
from garage2usd.maps.opendrive import write_opendrive

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(not HAS_JUDGES, reason="no environment with asam-qc-opendrive, CARLA and SUMO"),
]
# its time grows with the square of the objects: two minutes and more for the largest sample; a command checks them all
QUICK = [sample for sample in SAMPLES if sample.stem in {"irregular", "mixed_stalls", "paper_7x9"}]
MIXED = [sample for sample in QUICK if sample.stem == "mixed_stalls"]
FAULTY = REPOSITORY / "samples/hand_drawn.toml"


@pytest.fixture(scope="module")
def exported(builds, tmp_path_factory):
    maps = {}

    def export(sample):
        if sample not in maps:
            stage = builds(sample, "usdc").stage
            (maps[sample],) = garage2usd.export(stage, [tmp_path_factory.mktemp(sample.stem) / "garage.xodr"])
        return builds(sample, "usdc").stage, maps[sample]

    return export


@pytest.mark.parametrize("sample", soak_but(MIXED, QUICK), ids=lambda path: path.stem)
def test_asam_s_checker_has_no_issue(sample, exported, tmp_path):
    assert asam_issues(exported(sample)[1], tmp_path) == []


@each_sample
def test_carla_drives_as_the_lane_graph_does(sample, exported, tmp_path):
    assert list(MapJudge(*exported(sample), tmp_path).of_carla()) == []


@each_sample
def test_sumo_places_every_space(sample, exported, tmp_path):
    assert list(MapJudge(*exported(sample), tmp_path).of_sumo()) == []


@each_sample
def test_the_map_holds_what_the_stage_does(sample, exported, tmp_path):
    assert list(MapJudge(*exported(sample), tmp_path).of_objects()) == []


FAULTS = [
    Fault("lanes of the wrong sign", "network", "LEFT, RIGHT = 1, -1", "LEFT, RIGHT = -1, 1"),
    Fault("corners in another order", "opendrive_objects", "_turned(away, -heading)", "_turned(away[::-1], -heading)"),
    Fault("objects turned by pi", "opendrive_objects", "hdg=_about_road(", "hdg=math.pi + _about_road("),
    Fault("mirrored y", "frame", "(1.0, -1.0)", "(1.0, 1.0)"),
    Fault("no predecessor", "opendrive", '("predecessor", road.predecessor)', '("predecessor", None)'),
    Fault("the other end of a successor", "opendrive", '"start" if neighbour.at_start', '"end" if neighbour.at_start'),
    Fault("lanes linked to the other side", "road_builder", "lane: sign * lane", "lane: -sign * lane"),
    Fault(
        "lane into the junction",
        "road_builder",
        "(LEFT if comes_at_start else RIGHT)",
        "(RIGHT if comes_at_start else LEFT)",
    ),
    Fault(
        "lane out of the junction",
        "road_builder",
        "(RIGHT if goes_at_start else LEFT)",
        "(LEFT if goes_at_start else RIGHT)",
    ),
    Fault(
        "a turn that is left out",
        "road_builder",
        "entered is not left and entered",
        "entered.towards < left.towards and entered",
    ),
    Fault("arcs to the other side", "opendrive", "curvature=arc.curvature_per_m", "curvature=-arc.curvature_per_m"),
    Fault(
        "lanes as wide as the aisle",
        "road_builder",
        "width_m / 2 * against, width_m / 2 * along",
        "width_m * against, width_m * along",
    ),
    Fault("ramps upside down", "road_builder", "(top_m - run, height)", "(run, height)"),
    Fault("level ramps", "opendrive", "a=height + road.floor_m, b=(next_height", "a=0.0, b=0 * (next_height"),
    Fault("ways of portals turned round", "road_builder", "if is_turned or path", "if not is_turned or path"),
    Fault(
        "headings off by pi",
        "road_nodes",
        "elementary.arctan2(end[1] - start[1]",
        "math.pi + elementary.arctan2(end[1] - start[1]",
    ),
    Fault("stalls on the other side of the road", "road_nodes", "dy * cos - dx * sin", "dx * sin - dy * cos"),
    Fault("heading of objects in the map", "opendrive_objects", "heading - road.line.at(s_m)[2]", "heading"),
    Fault(
        "every stall for cars of all kinds",
        "opendrive_objects",
        'access=_ACCESS.get(thing.stall.use, "car")',
        'access="car"',
    ),
    Fault("stalls that are always free", "opendrive_objects", '"true" if stall in taken', '"false" if stall in taken'),
    Fault("offsets of lanes left out", "opendrive", "if road.start.middle_m or", "if 0 * road.start.middle_m and"),
    Fault("walls joined over gaps", "opendrive_objects", "_APART_M = 0.01", "_APART_M = 100.0"),
    Fault(
        "signs that look back",
        "opendrive_objects",
        "math.atan2(-front[0], -front[1])",
        "math.atan2(front[0], front[1])",
    ),
    Fault("junctions numbered as roads", "road_builder", "len(self._roads) + 1):", "1):"),
]


@pytest.fixture(scope="module")
def subject(builds):
    return read_built(builds(FAULTY, "usdc").stage).garage


@pytest.mark.parametrize("fault", soak_but(3, FAULTS), ids=lambda fault: fault.name)
def test_a_planted_fault_is_found(fault, subject, builds, tmp_path):
    path = tmp_path / "garage.xodr"
    with planted(fault, "opendrive") as module:
        module.write_opendrive(subject, path, MapsConfig())
    assert found_in(builds(FAULTY, "usdc").stage, path, tmp_path)


def test_the_judges_have_nothing_against_the_same_garage_without_a_fault(subject, builds, tmp_path):
    path = tmp_path / "garage.xodr"
    write_opendrive(subject, path, MapsConfig())
    assert not found_in(builds(FAULTY, "usdc").stage, path, tmp_path)


def found_in(stage, path, folder):
    """The first complaint, the quick judges first."""
    judge = MapJudge(stage, path, folder)
    return first_complaint(judge.of_objects, judge.of_carla, judge.of_sumo, lambda: asam_issues(path, folder))
