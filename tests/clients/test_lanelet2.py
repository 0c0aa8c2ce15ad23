"""Lanelet2 loads the maps of all samples, drives as their lane graphs do, and has the stalls where the stages do."""

import pytest
from support.documentation import blocks
from support.lanelet2_judge import Lanelet2Judge
from support.map_faults import Fault, first_complaint, planted
from support.map_judges import HAS_LANELET2, run_python
from support.sample_files import REPOSITORY, each_sample
from support.soak import soak_but
from support.stage_lanes import read_stage

import garage2usd
from garage2usd.config.outputs import MapsConfig
from garage2usd.garage_sources import read_built
from garage2usd.maps.lanelet2 import write_lanelet2

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(not HAS_LANELET2, reason="no environment with lanelet2"),
]
GUIDE = REPOSITORY / "docs/guides/lanelet2.md"
FAULTY = REPOSITORY / "samples/hand_drawn.toml"


@each_sample
def test_lanelet2_has_the_garage(sample, builds, tmp_path):
    stage = builds(sample, "usdc").stage
    (path,) = garage2usd.export(stage, [tmp_path / "garage.osm"])
    assert list(Lanelet2Judge(stage, path, tmp_path).complaints()) == []


@pytest.mark.soak
def test_lanelet2_has_the_default_garage_anywhere_on_the_earth(tmp_path):
    stage = garage2usd.build(garage2usd.GarageConfig(), tmp_path / "garage.usdc").stage
    for latitude, longitude in ((49.0, 9.0), (-33.8568, 151.2153), (78.2232, 15.6267), (0.0, -180.0)):
        settings = MapsConfig(latitude_deg=latitude, longitude_deg=longitude, speed_limit_km_h=7.5)
        (path,) = garage2usd.export(stage, [tmp_path / "garage.osm"], settings=settings)
        judge = Lanelet2Judge(stage, path, tmp_path, origin=(latitude, longitude), limit_km_h=7.5)
        assert list(judge.complaints()) == []


def test_the_guide_finds_a_way_to_a_free_stall(builds, tmp_path):
    stage = builds(FAULTY, "usdc").stage
    garage2usd.export(stage, [tmp_path / "garage.osm"])
    (program,) = [block.text for block in blocks(GUIDE) if block.language == "python"]
    number, length_m = run_python(program, tmp_path).split()
    assert number in {stall["number"] for stall in read_stage(stage).stalls.values()}
    assert float(length_m) > 10.0


FAULTS = [
    Fault(
        "left and right bounds swapped",
        "lanelet2",
        'Member("way", ways[lane.left], "left"), Member("way", ways[lane.right], "right")',
        'Member("way", ways[lane.right], "left"), Member("way", ways[lane.left], "right")',
    ),
    Fault(
        "right bounds on the left", "lane_bounds", "lanes.middle_m - lanes.right_m", "lanes.middle_m + lanes.right_m"
    ),
    Fault(
        "left lanes in the direction of their roads",
        "lane_bounds",
        "(outer, middle) if road.keeps_left",
        "(outer, middle) if lane == LEFT",
    ),
    Fault("points of ways not shared", "osm_file", "min(found)[1] if found else None", "None"),
    Fault(
        "latitudes mirrored",
        "osm_file",
        "transform(places[:, 0], places[:, 1])",
        "transform(places[:, 0], -places[:, 1])",
    ),
    Fault("longitude before latitude", "osm_file", "always_xy=True", "always_xy=False"),
    Fault("mirrored y", "frame", "(1.0, -1.0)", "(1.0, 1.0)"),
    Fault("degrees of a tenth of a metre", "osm_file", "_DEGREE_DIGITS = 11", "_DEGREE_DIGITS = 6"),
    Fault("heights left out", "osm_file", 'k="ele" v="{number_text(z)}"', 'k="ele" v="0"'),
    Fault("bends cut", "lane_bounds", "_SAG_M = 1e-3", "_SAG_M = 1e-2"),
    Fault("tapers cut", "lane_bounds", "+ 2 * bend * slope + eased", "* (bend > 0)"),
    Fault("turns to the other side", "lanelet2", '"left" if turned_rad > 0', '"left" if turned_rad < 0'),
    Fault("lanes of aisles that may be changed", "lanelet2", '"lane_change": "no"', '"lane_change": "yes"'),
    Fault("speed limit in another unit", "lanelet2", "number_text(settings.speed_limit_km_h)", '"10 mph"'),
    Fault("lanelets driven both ways", "lanelet2", '"one_way": "yes"', '"one_way": "no"'),
    Fault(
        "corners in another order",
        "lanelet2_parking",
        ".reshape(-1, 4, 2)",
        ".reshape(-1, 4, 2)[:, [0, 2, 1, 3]]",
    ),
    Fault("spaces from rear to mouth", "lanelet2_parking", "mean(axis=2)", "mean(axis=2)[:, ::-1]"),
    Fault("width of the side", "lanelet2_parking", "number_text(stall.width_m)", "number_text(stall.length_m)"),
    Fault("occupied stalls free", "lanelet2_parking", '"yes" if is_taken else "no"', '"no" if is_taken else "yes"'),
    Fault("a gap before the lane", "lanelet2_parking", "point.x, point.y, 0.0", "point.x + 0.05, point.y + 0.05, 0.0"),
    Fault("lots without lanes", "lanelet2_parking", "[shapely.union_all(_valid(level)), stalls]", "[stalls, stalls]"),
    Fault("lines behind what they are before", "lanelet2", "_BEFORE_M = 1.0", "_BEFORE_M = -1.0"),
    Fault(
        "lines across the lane that comes towards",
        "lanelet2",
        "lanes.left_m if is_left",
        "lanes.left_m if not is_left",
    ),
    Fault(
        "a turn that is left out",
        "road_builder",
        "entered is not left and entered",
        "entered.towards < left.towards and entered",
    ),
]


@pytest.fixture(scope="module")
def subject(builds):
    return read_built(builds(FAULTY, "usdc").stage).garage


@pytest.mark.parametrize("fault", soak_but(3, FAULTS), ids=lambda fault: fault.name)
def test_a_planted_fault_is_found(fault, subject, builds, tmp_path):
    path = tmp_path / "garage.osm"
    with planted(fault, "lanelet2") as module:
        module.write_lanelet2(subject, path, MapsConfig())
    assert found_in(builds(FAULTY, "usdc").stage, path, tmp_path)


def test_nothing_is_found_without_a_fault(subject, builds, tmp_path):
    path = tmp_path / "garage.osm"
    write_lanelet2(subject, path, MapsConfig())
    assert not found_in(builds(FAULTY, "usdc").stage, path, tmp_path)


def found_in(stage, path, folder):
    return first_complaint(lambda: Lanelet2Judge(stage, path, folder).complaints())
