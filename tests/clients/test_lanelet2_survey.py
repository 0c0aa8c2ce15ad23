"""Surveys of Lanelet2 maps have the areas and lanelets that Lanelet2 itself reads."""

import re

import numpy as np
import pytest
import shapely
from support.map_judges import HAS_LANELET2, lanelet2_map
from support.sample_files import REPOSITORY

import garage2usd
from garage2usd.survey.reader import read_survey

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(not HAS_LANELET2, reason="no environment with lanelet2"),
]
WITHIN_M = 0.01


@pytest.fixture(scope="module")
def both(builds, tmp_path_factory):
    """What Lanelet2 reads in a map, and the survey of the map without its coordinates in metres, in the same frame."""
    folder = tmp_path_factory.mktemp("lanelet2")
    stage = builds(REPOSITORY / "samples/mixed_stalls.toml", "usdc").stage
    (path,) = garage2usd.export(stage, [folder / "garage.osm"])
    judged = lanelet2_map(path, folder, 49.0, 9.0)
    bare = folder / "bare.osm"
    bare.write_text(re.sub(r'<tag k="local_[xy]".*?/>', "", path.read_text()))
    survey = read_survey(bare)
    judge = lanelet2_map(path, folder, *survey.origin_deg)
    assert len(judge["areas"]) == len(judged["areas"])
    return judge, survey


def test_stalls_are_the_areas_of_lanelet2(both):
    judge, survey = both
    areas = {area["tags"]["name"]: area["places"] for area in judge["areas"] if area["tags"]["subtype"] == "parking"}
    stalls = {stall.name: stall for stall in survey.stalls if stall.use.takes_cars}
    assert set(areas) == set(stalls)
    for name, places in areas.items():
        ground = shapely.Polygon([(x, -y) for x, y, _ in places])
        assert shapely.Polygon(stalls[name].corners).hausdorff_distance(ground) < WITHIN_M


def test_lanes_lie_between_the_bounds_of_lanelet2(both):
    judge, survey = both
    lanelets = [lanelet for lanelet in judge["lanelets"] if lanelet["passable"]]
    grounds = []
    for lanelet in lanelets:
        left, right = ([(x, -y) for x, y, _ in lanelet[side]["places"]] for side in ("left", "right"))
        grounds.append(shapely.make_valid(shapely.Polygon([*left, *reversed(right)])))
    of_lanes = [
        shapely.LineString(lane.points).buffer(lane.width_m / 2, cap_style="flat", join_style="mitre")
        for lane in survey.lanes
    ]
    together = shapely.union_all(grounds)
    assert shapely.union_all(of_lanes).symmetric_difference(together).area < 0.03 * together.area
    one_way = [lane for lane in survey.lanes if lane.one_way]
    assert len(one_way) + 2 * (len(survey.lanes) - len(one_way)) == len(lanelets)


def test_one_way_lanes_lead_as_lanelets_do(both):
    judge, survey = both
    ends = []
    for lanelet in judge["lanelets"]:
        left, right = (np.array(lanelet[side]["places"])[:, :2] for side in ("left", "right"))
        middles = (left[[0, -1]] + right[[0, -1]]) / 2 * (1, -1)
        ends.append(middles)
    for lane in survey.lanes:
        if lane.one_way:
            here = np.array(lane.points)[[0, -1]]
            assert min(np.abs(here - there).max() for there in ends) < 2 * WITHIN_M
