"""Levels and ramps of OSM files: by tags, by lists and runs of levels, by layers and by heights."""

import pytest
from support.levels_osm import AISLE_Y, RIGHT, OsmFile, add_level

from garage2usd.survey.reader import read_building

END = (RIGHT, AISLE_Y)


def levels_of(building):
    return {level.name: (len(level.survey.stalls), len(level.survey.lanes)) for level in building.in_order}


def ramps_of(building):
    return [(ramp.levels, ramp.points[0], ramp.points[-1], ramp.one_way) for ramp in building.ramps]


@pytest.mark.parametrize(("tag", "names"), [("level", ("0", "-1", "-2")), ("layer", ("1", "-1", "-4"))])
def test_each_level_has_its_own_stalls_and_lanes(tmp_path, tag, names):
    osm = OsmFile()
    for count, name in enumerate(names, 4):
        add_level(osm, name, tag=tag, stalls=count)
    building = read_building(osm.write(tmp_path / "a.osm"))
    assert levels_of(building) == {name: (count, 1) for count, name in enumerate(names, 4)}
    assert [level.ordinal for level in building.in_order] == [float(name) for name in names]
    assert building.ramps == ()


def test_stalls_on_one_layer_are_no_level(tmp_path):
    osm = OsmFile()
    add_level(osm, "-1", tag="layer")
    assert [level.name for level in read_building(osm.write(tmp_path / "a.osm")).levels] == [""]


def test_parts_without_a_level_are_on_the_ground_or_on_all_levels(tmp_path):
    osm = OsmFile()
    for name in ("1", "0", "-1"):
        add_level(osm, name, aisle=name != "0")
    osm.way([(-5.0, AISLE_Y), (40.0, AISLE_Y)], highway="service", service="parking_aisle")
    osm.way([(-9, -9), (60, -9), (60, 30), (-9, 30), (-9, -9)], amenity="parking")
    osm.way([(50, 1), (50.5, 1), (50.5, 1.5), (50, 1.5), (50, 1)], type="area", subtype="Columns")
    building = read_building(osm.write(tmp_path / "a.osm"))
    assert levels_of(building) == {"1": (12, 1), "0": (12, 1), "-1": (12, 1)}
    assert building.levels[1].survey.lanes[0].points[0] == (-5.0, -AISLE_Y)
    assert {len(level.survey.columns) for level in building.levels} == {1}
    assert None not in {level.survey.outline for level in building.levels}


def test_lanes_of_which_none_has_a_level_are_on_all(tmp_path):
    osm = OsmFile()
    for name in ("0", "-1"):
        add_level(osm, name, aisle=False)
    osm.way([(0.0, AISLE_Y), END], highway="service", service="parking_aisle")
    assert levels_of(read_building(osm.write(tmp_path / "a.osm"))) == {"0": (12, 1), "-1": (12, 1)}


def test_a_lane_with_several_levels_is_on_each(tmp_path):
    osm = OsmFile()
    for name in ("0", "-1", "-2"):
        add_level(osm, name, aisle=False)
    tags = {"highway": "service", "service": "parking_aisle"}
    osm.way([(0.0, AISLE_Y), END], level="-2-0", **tags)
    osm.way([(0.0, 40.0), (32.0, 40.0)], level="-2", repeat_on="0", **tags)
    found = levels_of(read_building(osm.write(tmp_path / "a.osm")))
    assert found == {"0": (12, 2), "-1": (12, 1), "-2": (12, 2)}


def test_a_ramp_leads_from_the_road_of_one_level_to_that_of_another(tmp_path):
    osm = OsmFile()
    for name in ("0", "-1"):
        add_level(osm, name)
    top = (60.0, 20.0)
    osm.way([END, top], "0", highway="service", service="parking_aisle", level="0")
    road = {"highway": "service", "indoor": "yes"}
    osm.way([END, (45.0, AISLE_Y), top], ["-1", "ramp", "0"], level="-1;0", oneway="yes", width="3.5", **road)
    osm.way([top, (60.0, 12.0), END], ["0", "bare", "-1"], oneway="-1", **road)
    building = read_building(osm.write(tmp_path / "a.osm"))
    assert levels_of(building) == {"0": (12, 2), "-1": (12, 1)}
    ends = (RIGHT, -AISLE_Y), (60.0, -20.0)
    assert ramps_of(building) == [(("-1", "0"), *ends, True), (("-1", "0"), *ends, True)]
    assert [ramp.width_m for ramp in building.ramps] == [3.5, None]
    assert building.unread == ()


@pytest.mark.parametrize(("incline", "upwards"), [("up", True), ("down", False), ("8%", True), ("-8%", False)])
def test_the_incline_tells_the_upper_end_where_no_road_does(tmp_path, incline, upwards):
    osm = OsmFile()
    for name in ("1", "0"):
        add_level(osm, name)
    osm.way([(40.0, 0.0), (60.0, 0.0)], "ramp", highway="service", level="0;1", incline=incline)
    (ramp,) = read_building(osm.write(tmp_path / "a.osm")).ramps
    assert ramp.levels == (("0", "1") if upwards else ("1", "0"))


def test_a_ramp_of_several_ways_is_one_and_one_over_three_levels_is_two(tmp_path):
    osm = OsmFile()
    for name in ("0", "-1", "-2"):
        add_level(osm, name)
    osm.way([END, (40.0, AISLE_Y)], ["-2", "a"], highway="service", level="-2;-1")
    osm.way([END, (40.0, AISLE_Y)], ["-1", "a"], highway="service", level="-2;-1")
    osm.way([(0, AISLE_Y), (-9, 0), (-9, 20), (0, AISLE_Y)], ["-2", "b", "c", "-1"], highway="service", level="-2--1")
    osm.way(
        [(0, AISLE_Y), (-20, 0), (0, AISLE_Y), (-20, 20), (0, AISLE_Y)],
        ["-2", "d", "-1", "e", "0"],
        highway="service",
        level="-2-0",
    )
    building = read_building(osm.write(tmp_path / "a.osm"))
    assert [ramp.levels for ramp in building.ramps] == [("-2", "-1"), ("-2", "-1"), ("-2", "-1"), ("-1", "0")]
    assert building.ramps[0].points == ((RIGHT, -AISLE_Y), (40.0, -AISLE_Y), (RIGHT, -AISLE_Y))


def test_a_road_between_levels_whose_ends_are_unknown_is_named(tmp_path):
    osm = OsmFile()
    for name in ("0", "-1"):
        add_level(osm, name)
    osm.way([(40.0, 0.0), (60.0, 0.0)], "ramp", highway="service", level="-1;0")
    building = read_building(osm.write(tmp_path / "a.osm"))
    assert building.unread == (("way 27", "a ramp whose ends do not lie on lanes of two levels"),)


def lanelet_file(heights_m, ramp=()):
    """Return a file of lanelets with heights: a row of stalls and a lane on each level, and the parts of a ramp."""
    osm = OsmFile()
    relations = []

    def bound(ends):
        osm.ways.append(([osm.node((x, y), f"{z}", {"ele": f"{z}"}) for x, y, z in ends], {"type": "line_thin"}))
        return len(osm.ways)

    def lanelet(start, end):
        sides = [bound([(x, y + off, z) for x, y, z in (start, end)]) for off in (2.0, -2.0)]
        relations.append(sides)

    for z in heights_m:
        for number in range(6):
            x = 2.5 * number
            corners = [(x, 0.0), (x + 2.5, 0.0), (x + 2.5, 5.0), (x, 5.0)]
            nodes = [osm.node(corner, f"{z}", {"ele": f"{z}"}) for corner in corners]
            osm.ways.append(([*nodes, nodes[0]], {"amenity": "parking_space"}))
        lanelet((0.0, 8.0, z), (30.0, 8.0, z))
    for start, end in ramp:
        lanelet(start, end)
    return osm, relations


def write_with_lanelets(osm, relations, path):
    osm.write(path)
    text = "".join(
        f'<relation id="{number}"><member type="way" ref="{left}" role="left"/>'
        f'<member type="way" ref="{right}" role="right"/><tag k="type" v="lanelet"/><tag k="subtype" v="road"/>'
        f'<tag k="one_way" v="yes"/></relation>'
        for number, (left, right) in enumerate(relations, 1)
    )
    path.write_text(path.read_text().replace("</osm>", f"{text}</osm>"))
    return path


def test_heights_tell_levels_and_lanelets_that_climb_are_ramps(tmp_path):
    ramp = [
        ((30.0, 8.0, 0.0), (40.0, 8.0, -1.0)),
        ((40.0, 8.0, -1.0), (50.0, 8.0, -2.5)),
        ((50.0, 8.0, -2.5), (60.0, 8.0, -3.5)),
    ]
    path = write_with_lanelets(*lanelet_file((0.0, -3.5), ramp), tmp_path / "a.osm")
    building = read_building(path)
    assert levels_of(building) == {"0": (6, 1), "-1": (6, 1)}
    assert [level.height_m for level in building.in_order] == [0.0, -3.5]
    (found,) = building.ramps
    assert (found.levels, found.one_way, found.points[0], found.points[-1]) == (("0", "-1"), True, (30, -8), (60, -8))
    assert found.width_m == pytest.approx(4.0)


def test_a_slope_of_one_lot_is_one_level(tmp_path):
    path = write_with_lanelets(*lanelet_file((0.0, -0.9, -1.8)), tmp_path / "a.osm")
    assert [level.name for level in read_building(path).levels] == [""]


def test_a_lanelet_that_climbs_to_no_level_is_a_lane(tmp_path):
    ramp = [((30.0, 8.0, 0.0), (40.0, 8.0, 1.0)), ((40.0, 8.0, 1.0), (50.0, 8.0, 3.0))]
    path = write_with_lanelets(*lanelet_file((0.0, -3.5), ramp), tmp_path / "a.osm")
    building = read_building(path)
    assert levels_of(building) == {"0": (6, 3), "-1": (6, 1)}
    assert building.ramps == building.unread == ()
