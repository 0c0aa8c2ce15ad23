"""OSM XML: lots of OpenStreetMap and Lanelet2 maps, written by hand in metres or degrees, and what is wrong in them."""

import numpy as np
import pytest
import shapely

from garage2usd.common.errors import ConfigError
from garage2usd.config.stalls import SizeClass
from garage2usd.garage import StallUse
from garage2usd.survey.enclosure import enclosed
from garage2usd.survey.reader import read_building, read_survey
from garage2usd.survey.survey import PortalKind


class Map:
    """An OSM file under construction, by points (x, y) in metres."""

    def __init__(self):
        self.nodes, self.ways, self.relations = {}, [], []

    def node(self, point, **tags):
        number, before = self.nodes.get(point, (len(self.nodes) + 1, {}))
        self.nodes[point] = number, {**before, **tags}
        return number

    def way(self, points, **tags):
        self.ways.append(([self.node(point) for point in points], tags))
        return len(self.ways)

    def relation(self, members, **tags):
        self.relations.append((members, tags))
        return len(self.relations)

    def read(self, tmp_path, reader=read_survey):
        def lines(tags):
            return "".join(f'<tag k="{key.replace("__", ":")}" v="{value}"/>' for key, value in tags.items())

        text = ['<osm version="0.6">']
        text += [
            f'<node id="{number}" lat="0" lon="0">{lines({"local_x": x, "local_y": y, **tags})}</node>'
            for (x, y), (number, tags) in self.nodes.items()
        ]
        text += [
            f'<way id="{index}">{"".join(f"<nd ref={chr(34)}{node}{chr(34)}/>" for node in nodes)}{lines(tags)}</way>'
            for index, (nodes, tags) in enumerate(self.ways, 1)
        ]
        text += [
            f'<relation id="{index}">'
            + "".join(f'<member type="way" ref="{way}" role="{role}"/>' for way, role in members)
            + f"{lines(tags)}</relation>"
            for index, (members, tags) in enumerate(self.relations, 1)
        ]
        path = tmp_path / "lot.osm"
        path.write_text("".join([*text, "</osm>"]))
        return reader(path)


def box(x, y, width=2.5, length=5.0):
    return [(x, y), (x + width, y), (x + width, y + length), (x, y + length), (x, y)]


def ground(stall):
    return shapely.transform(shapely.Polygon(stall.corners), lambda points: points * (1, -1))


def test_a_lot_of_openstreetmap(tmp_path):
    lot = Map()
    lot.way(box(0, 0, 40, 30), amenity="parking")
    lot.way(box(100, 0, 10, 10), amenity="parking")
    lot.way(box(1, 1), amenity="parking_space", ref="12")
    lot.way(box(4, 1), amenity="parking_space", parking_space="disabled")
    lot.way(box(7, 1), amenity="parking_space", capacity__disabled="1")
    lot.way(box(10, 1), amenity="parking_space", capacity__charging="yes")
    lot.way([(13, 1), (14, 1.02), (15.5, 1), (15.5, 6), (13, 6), (13, 3), (13, 1)], amenity="parking_space")
    lot.way([(20, 1), (23, 1), (24, 3), (23, 6), (20, 6), (20, 1)], amenity="parking_space", name="bay")
    outer = lot.way([(30, 1), (32.5, 1), (32.5, 6)]), lot.way([(30, 1), (30, 6), (32.5, 6)])
    lot.relation([(way, "outer") for way in outer], type="multipolygon", amenity="parking_space")
    lot.way([(0, 15), (40, 15)], highway="service", service="parking_aisle", width="6 m", oneway="-1")
    lot.way([(-20, 20), (20, 20), (20, 15)], highway="service", oneway="yes")
    lot.way([(30, 40), (30, 15)], highway="service")
    lot.way([(80, 40), (90, 15)], highway="service")
    lot.way([(0, 25), (40, 25)], highway="footway")
    lot.node((40, 15), amenity="parking_entrance")
    lot.node((10, 30), barrier="lift_gate")
    lot.node((10, 25), barrier="bollard")
    survey = enclosed(lot.read(tmp_path))
    assert {stall.name: stall.use for stall in survey.stalls} == {
        "relation 1": StallUse.STANDARD,
        "way 3": StallUse.STANDARD,
        "way 4": StallUse.ACCESSIBLE,
        "way 5": StallUse.ACCESSIBLE,
        "way 6": StallUse.EV,
        "way 7": StallUse.STANDARD,
    }
    found = {stall.name: stall for stall in survey.stalls}
    assert found["way 3"].number == "12"
    assert ground(found["way 7"]).equals(shapely.box(13, 1, 15.5, 6))
    assert ground(found["relation 1"]).equals(shapely.box(30, 1, 32.5, 6))
    assert shapely.Polygon(survey.outline).equals(shapely.box(0, -30, 40, 0))
    aisle, approach, drive = survey.lanes
    assert (aisle.points, aisle.width_m, aisle.one_way) == (((40, -15), (0, -15)), 6, True)
    assert (approach.points, approach.width_m, approach.one_way) == (((0, -20), (20, -20), (20, -15)), None, True)
    assert (drive.points, drive.one_way) == (((30, -30), (30, -15)), False)
    assert set(survey.portals) == {
        ((0, -20), PortalKind.ENTRANCE),
        ((30, -30), PortalKind.BOTH),
        ((40, -15), PortalKind.BOTH),
        ((10, -30), PortalKind.BOTH),
    }
    assert set(survey.unread) == {
        ("bay", "a stall of 5 corners instead of 4"),
        ("way 2", "an outline that contains no stall"),
        ("way 14", "a service road that is no parking aisle within the outline"),
    }


def test_areas_for_several_cars_are_rows(tmp_path):
    lot = Map()
    lot.way(box(0, 0, 5, 25), amenity="parking_space", capacity="10", capacity__disabled="2", name="W")
    lot.way(box(10, 0, 24, 2.5), amenity="parking_space", capacity="4", capacity__disabled="4")
    lot.way(box(10, 10, 5, 5), amenity="parking_space", capacity="40")
    lot.node((50, 0), amenity="parking_space")
    survey = lot.read(tmp_path)
    grounds = [ground(stall) for stall in survey.stalls]
    assert len(grounds) == 14
    assert {stall.use for stall in survey.stalls[:10]} == {StallUse.STANDARD}
    assert {stall.use for stall in survey.stalls[10:]} == {StallUse.ACCESSIBLE}
    assert survey.stalls[0].name == "W, stall 1"
    assert all(shape.area == pytest.approx(12.5) for shape in grounds[:10])
    assert sorted(shape.bounds for shape in grounds[10:]) == [(10 + 6 * n, 0, 16 + 6 * n, 2.5) for n in range(4)]
    assert shapely.union_all(grounds[:10]).equals(shapely.box(0, 0, 5, 25))
    assert survey.unread == (
        ("way 3", "40 stalls side by side, each 0.12 m wide"),
        ("node 13", "a stall as a point, without an outline"),
    )


def lanelet(lot, left, right, **tags):
    members = [(lot.way(left), "left"), (lot.way(right), "right")]
    return lot.relation(members, type="lanelet", subtype="road", **tags)


def stalls_of_a_lanelet_map():
    lot = Map()
    lot.relation([(lot.way(box(0, 0)), "outer")], type="multipolygon", subtype="parking")
    lot.way(box(3, 0)[:-1], type="area", subtype="parking_spot", area="yes")
    lot.way([(7.25, 0), (7.25, 5)], type="parking_space", width="2.5", use="ev")
    return lot


def test_every_form_of_stall_of_lanelet2_is_read(tmp_path):
    survey = stalls_of_a_lanelet_map().read(tmp_path)
    grounds = [ground(stall) for stall in survey.stalls]
    assert [shape.bounds for shape in grounds] == [(0, 0, 2.5, 5), (3, 0, 5.5, 5), (6, 0, 8.5, 5)]
    assert survey.stalls[2].use is StallUse.EV


def test_a_space_within_an_area_is_the_same_stall(tmp_path):
    lot = stalls_of_a_lanelet_map()
    lot.way([(1.25, 0), (1.25, 5)], type="parking_space", width="2.5")
    lot.way([(1.25, 0), (1.25, 50)], type="parking_space", width="2.5", name="long")
    assert [stall.name for stall in lot.read(tmp_path).stalls] == ["relation 1", "way 2", "way 3", "long"]


@pytest.mark.parametrize("flip_left", [False, True])
@pytest.mark.parametrize("flip_right", [False, True])
def test_lanelets_lead_with_their_left_bound_at_the_left(tmp_path, flip_left, flip_right):
    lot = stalls_of_a_lanelet_map()
    left, right = [(0, 14), (20, 14)], [(0, 10), (10, 10.0), (20, 10)]
    lanelet(lot, left[:: -1 if flip_left else 1], right[:: -1 if flip_right else 1])
    lanelet(lot, [(0, 20), (20, 20)], [(20, 24), (0, 24)], one_way="no")
    lanelet(lot, [(0, 30), (20, 30)], [(0, 34), (20, 34)])
    lanelet(lot, [(0, 40), (20, 40)], [(0, 44), (20, 44)], participant__pedestrian="yes")
    lot.relations[-2][1]["subtype"] = "crosswalk"
    one, other = lot.read(tmp_path).lanes
    assert (one.points, one.width_m, one.one_way) == (((0, -12), (20, -12)), 4, True)
    assert (other.width_m, other.one_way) == (4, False)


def test_two_lanelets_beside_or_on_each_other_are_one_lane(tmp_path):
    lot = stalls_of_a_lanelet_map()
    upper, middle, lower = (lot.way([(0, y), (20, y)]) for y in (16, 13, 10))
    lot.relation([(middle, "left"), (lower, "right")], type="lanelet", subtype="road")
    lot.relation([(middle, "left"), (upper, "right")], type="lanelet", subtype="road")
    lanelet(lot, [(0, 30), (20, 30)], [(0, 26), (20, 26)])
    lanelet(lot, [(0, 26.1), (20, 26.1)], [(0, 30.1), (20, 30.1)])
    beside, on = lot.read(tmp_path).lanes
    assert (beside.points, beside.width_m, beside.one_way) == (((0, -13), (20, -13)), 6, False)
    assert (on.points, on.width_m, on.one_way) == (((0, -28), (20, -28)), 4, False)


def test_the_width_of_a_bend_is_that_across_it(tmp_path):
    lot = stalls_of_a_lanelet_map()
    angles = np.linspace(0, np.pi / 2, 40)
    outer, inner = ([(round(r * np.sin(a), 4), round(50 - r * np.cos(a), 4)) for a in angles] for r in (12.0, 8.0))
    lanelet(lot, inner, outer)
    lanelet(lot, [(100, 100), (100, 100)], [(100, 96), (103, 97), (104, 100)])
    bend, turn = lot.read(tmp_path).lanes
    assert bend.width_m == pytest.approx(4, abs=0.01)
    line = shapely.LineString(bend.points)
    assert shapely.Point(0, -50).distance(line) == pytest.approx(10, abs=0.02)
    assert shapely.Point(0, -50).hausdorff_distance(line) == pytest.approx(10, abs=0.02)
    assert turn.points[0] == (100, -98)
    assert turn.points[-1] == (102, -100)


def test_columns_sizes_and_levels_are_read(tmp_path):
    lot = Map()
    lot.way(box(0, 0), type="area", subtype="parking", area="yes", level="2", parking_type="Stall Large 1")
    lot.way(box(3, 0), type="area", subtype="parking", area="yes", level="2", parking_type="Disabled Space")
    lot.way(box(6, 0), type="area", subtype="parking", area="yes", level="1", name="below")
    lot.way(box(9, 0, 0.5, 0.5), type="area", subtype="Columns", level="2")
    lot.way(box(12, 0, 0.5, 0.5), type="area", subtype="Columns", level="1")
    lanelet(lot, [(0, 14), (20, 14)], [(0, 10), (20, 10)], level="1")
    upper, lower = lot.read(tmp_path, read_building).in_order
    large, accessible = upper.survey.stalls
    assert (large.size, accessible.use) == (SizeClass.LARGE, StallUse.ACCESSIBLE)
    assert upper.survey.columns == (((9.25, -0.25), 0.5),)
    assert lower.survey.columns == (((12.25, -0.25), 0.5),)
    assert [stall.name for stall in lower.survey.stalls] == ["below"]
    assert [len(level.survey.lanes) for level in (upper, lower)] == [0, 1]
    assert upper.survey.unread == lower.survey.unread == ()


def test_what_is_left_out_is_named(tmp_path):
    lot = stalls_of_a_lanelet_map()
    lot.relation([(lot.way(box(20, 0)[:3]), "outer")], type="multipolygon", subtype="parking", name="open")
    lot.relation([(99, "outer")], type="multipolygon", subtype="parking", name="gone")
    lot.way([(30, 0), (31, 0), (32, 0)], type="parking_space", width="2", name="three")
    lot.relation([(lot.way([(0, 14), (20, 14)]), "left")], type="lanelet", subtype="road")
    survey = lot.read(tmp_path)
    assert len(survey.stalls) == 3
    assert survey.unread == (
        ("open", "a stall whose ways do not close a ring"),
        ("gone", "a stall whose ways do not close a ring"),
        ("three", "a parking space of 3 points instead of 2 apart"),
        ("relation 4", "a lane without a right bound"),
    )


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("<osm><node", "allowed: an OSM file, which is XML (unclosed token"),
        ('<!DOCTYPE osm [<!ENTITY a "b">]><osm/>', "allowed: an OSM file without a document type declaration"),
        ("<OpenDRIVE/>", "lot.osm: root element: got 'OpenDRIVE'; allowed: osm, of an OSM file"),
        ('<osm><node id="a" lat="1" lon="2"/></osm>', "lot.osm: node, id: got 'a'; allowed: a whole number"),
        (
            '<osm><node id="1" lat="91" lon="2"/></osm>',
            "lot.osm: node 1, lat: got '91'; allowed: a number of degrees from -90 to 90",
        ),
        ('<osm><node id="1" lon="2"/></osm>', "lot.osm: node 1, lat: got None; allowed: a number of degrees"),
        ('<osm><way id="1"><nd/></way></osm>', "lot.osm: way 1, nd, ref: got 'nothing'; allowed: a whole number"),
        ('<osm><way id="1"/><way id="1"/></osm>', "lot.osm: way, id: got 1; allowed: each number of a way once"),
    ],
)
def test_malformed_files_are_refused(tmp_path, text, message):
    path = tmp_path / "lot.osm"
    path.write_text(text)
    with pytest.raises(ConfigError) as raised:
        read_survey(path)
    assert message in str(raised.value)


@pytest.mark.parametrize("name", ["lot.dwg", "lot", "lot.xodr.gz"])
def test_other_suffixes_are_refused(tmp_path, name):
    with pytest.raises(ConfigError) as raised:
        read_survey(tmp_path / name)
    assert str(raised.value) == (
        f"SOURCE: got '{tmp_path / name}'; allowed: a path that ends in .toml, .csv, .geojson, .json, .osm, "
        ".osm.xml, .xodr, .dxf, .ifc, .zip"
    )
