"""Maps that garage2usd exports are read as surveys with the stalls, columns and lanes of their stages."""

import re

import numpy as np
import pytest
import shapely
from support.opendrive_reader import OpenDrive
from support.sample_files import REPOSITORY
from support.soak import soak_but

import garage2usd
from garage2usd.garage_sources import read_built
from garage2usd.survey.opendrive_lanes import lanes_of_road
from garage2usd.survey.opendrive_lines import road_line
from garage2usd.survey.reader import read_survey

SAMPLES = [REPOSITORY / "samples/mixed_stalls.toml", REPOSITORY / "samples/paper_7x9.toml"]
WITHIN_M = 0.01

each_map = pytest.mark.parametrize("suffix", ["xodr", "osm"])
each_sample = pytest.mark.parametrize("sample", soak_but(1, SAMPLES), ids=lambda path: path.stem)


@pytest.fixture
def exported(builds, tmp_path):
    def export(sample, suffix):
        stage = builds(sample, "usdc").stage
        (path,) = garage2usd.export(stage, [tmp_path / f"garage.{suffix}"])
        return read_built(stage).garage, path

    return export


@each_sample
@each_map
def test_every_stall_is_read_where_it_stands(exported, sample, suffix):
    garage, path = exported(sample, suffix)
    survey = read_survey(path)
    assert survey.unread == ()
    found = {stall.name: stall for stall in survey.stalls}
    assert set(found) == {stall.name for stall in garage.stalls}
    for stall in garage.stalls:
        read = found[stall.name]
        apart_m = np.hypot(*(np.array(read.corners)[:, None] - np.array(stall.corners)[None]).transpose(2, 0, 1))
        assert sorted(apart_m.argmin(axis=1)) == [0, 1, 2, 3]
        assert apart_m.min(axis=1).max() < WITHIN_M, stall.name
        assert read.use == stall.use
        assert read.number == ("" if stall.number is None else str(stall.number))
        if stall.takes_cars:
            mouth = shapely.LineString([read.corners[read.mouth], read.corners[(read.mouth + 1) % 4]])
            assert mouth.distance(shapely.Point(np.mean(stall.corners[:2], axis=0))) < WITHIN_M, stall.name


@each_sample
def test_every_column_is_read_once(exported, sample):
    garage, path = exported(sample, "xodr")
    columns = {
        (round(solid.footprint.centroid.x, 2), round(solid.footprint.centroid.y, 2))
        for solid in garage.levels[0].solids.standing("column")
    }
    found = [tuple(np.round(column.centre, 2)) for column in read_survey(path).columns]
    assert len(found) == len(columns)
    apart_m = [min(np.hypot(x - other, z - other_z) for other, other_z in columns) for x, z in found]
    assert max(apart_m) < 2 * WITHIN_M


@each_sample
def test_lanes_of_opendrive_lie_between_the_borders_that_the_standard_gives(exported, sample):
    _, path = exported(sample, "xodr")
    standard = OpenDrive(path)
    with_lanes = [road for road in standard.roads.values() if standard.lanes(road, 0.0)]
    lanes = [lane for road in with_lanes for lane in lanes_of_road(road, road_line(road, ""), "")]
    assert len(lanes) == len(with_lanes)
    for lane, road in zip(lanes, with_lanes, strict=True):
        line = shapely.LineString(lane.points * (1.0, -1.0))
        numbers = {number for number, _, _ in standard.lanes(road, 0.0)}
        assert lane.one_way == (len({number > 0 for number in numbers}) == 1)
        length_m, widths = float(road.get("length")), []
        ends = []
        for s in np.linspace(0.0, length_m, 20):
            here = standard.lanes(road, s)
            low = min(t - width / 2 for _, t, width in here)
            high = max(t + width / 2 for _, t, width in here)
            (x, y), _ = standard.place(road, s, (low + high) / 2)
            widths.append(sum(width for _, _, width in here))
            ends.append((x, -y))
            assert line.distance(shapely.Point(x, -y)) < 2 * WITHIN_M
        assert min(widths) - 0.05 < lane.width_m < max(widths) + 0.05
        first = ends[0 if numbers != {1} else -1]
        assert np.hypot(*np.subtract(line.coords[0], first)) < 2 * WITHIN_M


def ground_of(lanes):
    lines = [(shapely.LineString(lane.points), lane.width_m / 2) for lane in lanes]
    return shapely.union_all([line.buffer(half_m, cap_style="flat") for line, half_m in lines])


@each_sample
def test_both_maps_have_the_same_lanes(exported, sample):
    _, of_roads = exported(sample, "xodr")
    _, of_lanelets = exported(sample, "osm")
    grounds = [ground_of(read_survey(path).lanes) for path in (of_roads, of_lanelets)]
    # connecting roads are laid from middle to middle, up to half a lane beside where they are
    assert grounds[0].symmetric_difference(grounds[1]).area < 0.03 * grounds[0].area
    both = [[lane for lane in read_survey(path).lanes if not lane.one_way] for path in (of_roads, of_lanelets)]
    for lane in both[1]:  # the roads through junctions are two-way as well
        assert any(
            shapely.LineString(lane.points).hausdorff_distance(shapely.LineString(other.points)) < 0.05
            and abs(lane.width_m - other.width_m) < 0.05
            for other in both[0]
        )


@each_sample
def test_degrees_give_the_same_stalls_as_metres(exported, sample):
    _, path = exported(sample, "osm")
    metres = read_survey(path)
    path.write_text(re.sub(r'<tag k="local_[xy]".*?/>', "", path.read_text()))
    degrees = read_survey(path)
    assert metres.origin_deg is None
    assert degrees.origin_deg == pytest.approx((49.0, 9.0), abs=0.01)
    corners = [np.array([stall.corners for stall in survey.stalls]) for survey in (metres, degrees)]
    shift = (corners[1] - corners[0]).mean(axis=(0, 1))
    assert np.abs(corners[1] - corners[0] - shift).max() < WITHIN_M
