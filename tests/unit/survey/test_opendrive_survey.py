"""OpenDRIVE: curves against scenariogeneration's and numerical integrals, objects against the standard's text."""

import math
import xml.etree.ElementTree as ET

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from scenariogeneration import xodr
from scipy.integrate import quad

from garage2usd.common.errors import ConfigError
from garage2usd.garage import StallUse
from garage2usd.survey.opendrive_lines import road_line
from garage2usd.survey.reader import read_survey

LANE = '<lane id="{0}" type="driving"><width sOffset="0" a="{1}" b="0" c="0" d="0"/></lane>'
TWO_WAY = (
    f"<lanes><laneSection s='0'><left>{LANE.format(1, 3)}</left>"
    f"<right>{LANE.format(-1, 3)}</right></laneSection></lanes>"
)


def line_of(geometry, length=20.0, hdg=0.0):
    road = ET.fromstring(
        f'<road length="{length}"><planView>'
        f'<geometry s="0" x="0" y="0" hdg="{hdg}" length="{length}">{geometry}</geometry></planView></road>'
    )
    return road_line(road, "road 1")


def written(tmp_path, roads, head=""):
    path = tmp_path / "lot.xodr"
    path.write_text(f"<OpenDRIVE>{head}{roads}</OpenDRIVE>")
    return path


def road(objects="", *, lanes=TWO_WAY, geometry="<line/>", length=100, number=1):
    return (
        f'<road id="{number}" length="{length}" junction="-1"><planView>'
        f'<geometry s="0" x="0" y="0" hdg="0" length="{length}">{geometry}</geometry>'
        f"</planView>{lanes}<objects>{objects}</objects></road>"
    )


BOX = '<object type="parkingSpace" id="{id}" s="{s}" t="{t}" hdg="{hdg}" width="2.5" length="5">{more}</object>'


def box(more="", **given):
    return BOX.format(**{"id": 1, "s": 10, "t": 8, "hdg": 0.0, "more": more, **given})


def ground(stall):
    return shapely.Polygon(stall.corners)


curvatures = st.floats(-0.1, 0.1)


@given(curvatures, curvatures, st.floats(1.0, 60.0), st.floats(-4.0, 4.0))
def test_spirals_end_where_scenariogeneration_ends_them(start, end, length, hdg):
    line = line_of(f'<spiral curvStart="{start}" curvEnd="{end}"/>', length, hdg)
    (points,), (heading,) = line.at(np.array([length]))

    def angle(s):
        return hdg + start * s + (end - start) / length * s**2 / 2

    expected = [
        quad(lambda s: math.cos(angle(s)), 0, length, epsabs=1e-9)[0],
        quad(lambda s: math.sin(angle(s)), 0, length, epsabs=1e-9)[0],
    ]
    # below 1e-9 per m2 a spiral is an arc of its mean curvature, 2e-5 m off on 60 m
    assert points == pytest.approx(expected, abs=1e-6 if abs(end - start) / length >= 1e-9 else 2e-5)
    assert heading == pytest.approx(angle(length), abs=1e-8)
    if abs(end - start) > 1e-6:
        peer = xodr.Spiral(start, end, length=length).get_end_data(0, 0, hdg)
        assert points == pytest.approx(peer[:2], abs=1e-4)


@given(curvatures.filter(lambda curvature: abs(curvature) > 1e-6), st.floats(1.0, 60.0), st.floats(-4.0, 4.0))
def test_arcs_end_where_scenariogeneration_ends_them(curvature, length, hdg):
    points, headings = line_of(f'<arc curvature="{curvature}"/>', length, hdg).at(np.array([length]))
    x, y, heading, _ = xodr.Arc(curvature, length=length).get_end_data(0, 0, hdg)
    assert points[0] == pytest.approx((x, y), abs=1e-6)
    assert headings[0] == pytest.approx(heading, abs=1e-9)


@pytest.mark.parametrize("form", ["normalized", "arcLength"])
def test_parametric_cubics_are_evaluated_as_the_standard_says(form):
    coefficients = {"aU": 0, "bU": 20, "cU": 0.5, "dU": -0.2, "aV": 0, "bV": 0, "cV": 6, "dV": -2}
    if form == "arcLength":
        coefficients = {key: value / 20 ** "abcd".index(key[0]) for key, value in coefficients.items()}
    text = " ".join(f'{key}="{value}"' for key, value in coefficients.items())
    line = line_of(f'<paramPoly3 pRange="{form}" {text}/>', 20.0)
    points, headings = line.at(np.array([0.0, 10.0, 20.0]))
    assert points == pytest.approx(np.array([(0, 0), (10 + 0.125 - 0.025, 1.5 - 0.25), (20.3, 4)]), abs=1e-9)
    assert headings[2] == pytest.approx(math.atan2(12 - 6, 20 + 1 - 0.6), abs=1e-9)


def test_cubics_are_as_long_as_their_road():
    line = line_of('<poly3 a="0" b="0" c="0.02" d="0"/>', 20.0)
    points, _ = line.at(np.linspace(0.0, 20.0, 2001))
    assert shapely.LineString(points).length == pytest.approx(20.0, abs=1e-3)
    assert points[:, 1] == pytest.approx(0.02 * points[:, 0] ** 2, abs=1e-9)


def test_boxes_repetitions_and_both_kinds_of_corner_give_the_same_row(tmp_path):
    local = "".join(
        f'<cornerLocal u="{u}" v="{v}" z="0"/>' for u, v in ((-2.5, 1.25), (-2.5, -1.25), (2.5, -1.25), (2.5, 1.25))
    )
    along = "".join(
        f'<cornerRoad s="{s}" t="{t}" dz="0"/>' for s, t in ((7.5, 9.25), (7.5, 6.75), (12.5, 6.75), (12.5, 9.25))
    )
    repeat = '<repeat s="10" length="15.0" distance="5" tStart="8" tEnd="8"/>'
    rows = [
        "".join(box(id=index, s=10 + 5 * index) for index in range(4)),
        box(repeat),
        box(f"{repeat}<outlines><outline>{local}</outline></outlines>"),
        box(f"<outline>{local}</outline>{repeat}"),
        box(f"{repeat}<outlines><outline>{along}</outline></outlines>"),
    ]
    for row in rows:
        survey = read_survey(written(tmp_path, road(row)))
        assert len(survey.stalls) == 4
        for index, stall in enumerate(survey.stalls):
            expected = shapely.box(7.5 + 5 * index, -9.25, 12.5 + 5 * index, -6.75)
            assert ground(stall).symmetric_difference(expected).area < 1e-6


def test_headings_are_relative_to_the_road(tmp_path):
    quarter = f'<arc curvature="{math.pi / 2 / 100}"/>'
    (stall,) = read_survey(written(tmp_path, road(box(s=100, t=0, hdg=0.3), geometry=quarter))).stalls
    radius = 100 / (math.pi / 2)
    expected = shapely.affinity.translate(
        shapely.affinity.rotate(shapely.box(-2.5, -1.25, 2.5, 1.25), math.pi / 2 + 0.3, use_radians=True),
        radius,
        radius,
    )
    seen = shapely.transform(ground(stall), lambda points: points * (1, -1))
    assert seen.symmetric_difference(expected).area < 1e-4


def test_parking_spaces_of_scenariogeneration_are_read(tmp_path):
    plan = xodr.PlanView()
    plan.add_geometry(xodr.Line(40))
    section = xodr.LaneSection(0, xodr.Lane(a=0))
    section.add_left_lane(xodr.Lane(a=3))
    section.add_right_lane(xodr.Lane(a=3.5))
    sections = xodr.Lanes()
    sections.add_lanesection(section)
    street = xodr.Road(1, plan, sections)
    for number in range(5):
        street.add_object(
            xodr.Object(
                s=5 + 5 * number, t=-7, Type=xodr.ObjectType.parkingSpace, id=str(number), width=5, length=2.5, hdg=0
            )
        )
    opendrive = xodr.OpenDrive("lot")
    opendrive.add_road(street)
    opendrive.adjust_roads_and_lanes()
    path = tmp_path / "lot.xodr"
    opendrive.write_xml(str(path))
    survey = read_survey(path)
    assert [ground(stall).bounds for stall in survey.stalls] == [
        pytest.approx((3.75 + 5 * number, 4.5, 6.25 + 5 * number, 9.5)) for number in range(5)
    ]
    (lane,) = survey.lanes
    assert (lane.width_m, lane.one_way) == (6.5, False)
    assert np.array(lane.points)[:, 1] == pytest.approx(0.25)


def test_lanes_lead_as_rule_and_direction_say(tmp_path):
    def lanes(text, rule="RHT"):
        path = written(tmp_path, road(box(), lanes=f"<lanes>{text}</lanes>").replace("<road ", f'<road rule="{rule}" '))
        return read_survey(path).lanes

    right = f"<laneSection s='0'><right>{LANE.format(-1, 3)}</right></laneSection>"
    (lane,) = lanes(right)
    assert (lane.points, lane.width_m, lane.one_way) == (((0, 1.5), (100, 1.5)), 3, True)
    (lane,) = lanes(right, "LHT")
    assert lane.points == ((100, 1.5), (0, 1.5))
    (lane,) = lanes(right.replace("type", 'direction="reversed" type'))
    assert lane.points == ((100, 1.5), (0, 1.5))
    (lane,) = lanes(right.replace("type", 'direction="both" type'))
    assert not lane.one_way
    (lane,) = lanes(f'<laneOffset s="0" a="-2" b="0" c="0" d="0"/>{right}')
    assert lane.points == ((0, 3.5), (100, 3.5))
    assert lanes(right.replace("driving", "sidewalk")) == ()
    both = right + right.replace("s='0'", "s='40'").replace("right>", "left>").replace('"-1"', '"1"')
    first, second = lanes(both)
    assert (first.points, second.points) == (((0, 1.5), (40, 1.5)), ((100, -1.5), (40, -1.5)))


def test_lanes_end_at_the_stalls_whose_ground_they_hold(tmp_path):
    wide = TWO_WAY.replace('a="3"', 'a="15"')
    (lane,) = read_survey(written(tmp_path, road(box(), lanes=wide))).lanes
    assert lane.width_m == pytest.approx(2 * 6.75)


def test_uses_numbers_mouths_and_columns_are_read(tmp_path):
    corners = "".join(
        f'<cornerLocal id="{index}" u="{u}" v="{v}"/>' for index, (u, v) in enumerate([(0, 0), (2, 0), (2, 5), (0, 5)])
    )
    sides = "".join(
        f'<marking><cornerReference id="{start}"/><cornerReference id="{end}"/></marking>'
        for start, end in ((1, 2), (2, 3), (3, 0))
    )
    more = (
        f'<outlines><outline>{corners}</outline></outlines><parkingSpace access="handicapped"/>'
        f'<markings>{sides}</markings><userData code="number" value="17"/>'
    )
    column = '<object type="pole" name="Column 3" id="9" s="50" t="9" width="0.4" length="0.4"/>'
    head = "<header><geoReference>+proj=tmerc +lat_0=48.5 +lon_0=9 +x_0=0 +y_0=0</geoReference></header>"
    survey = read_survey(
        written(tmp_path, road(box(more) + box('<parkingSpace access="electric"/>', id=2) + column), head)
    )
    first, second = survey.stalls
    assert (first.use, first.number, first.mouth) == (StallUse.ACCESSIBLE, "17", 0)
    assert (second.use, second.number, second.mouth) == (StallUse.EV, "", None)
    ((centre, size_m),) = survey.columns
    assert (centre, size_m) == ((50, -9), pytest.approx(0.4))
    assert survey.origin_deg == (48.5, 9.0)


def test_what_is_no_stall_is_named(tmp_path):
    corners = "".join(f'<cornerLocal u="{u}" v="{v}"/>' for u, v in [(0, 0), (2, 0), (3, 2), (1, 4), (-1, 2)])
    bad = box(f"<outlines><outline>{corners}</outline></outlines>", id=7)
    nothing = '<object type="parkingSpace" id="8" s="0" t="0"/>'
    endless = box('<repeat s="0" length="20" distance="0" tStart="4" tEnd="4"/>', id=9)
    survey = read_survey(written(tmp_path, road(box() + bad + nothing + endless)))
    assert survey.unread == (
        ("road 1, object 7", "a stall of 5 corners instead of 4"),
        ("road 1, object 8", "an object without outline, width and length"),
        ("road 1, object 9", "an object that is repeated without distance, as one long body"),
    )


@pytest.mark.parametrize(
    ("roads", "message"),
    [
        (
            road(box(s="near")),
            "lot.xodr: road 1, object 1, s: got 'near'; allowed: a number of metres from -1e+08 to 1e+08",
        ),
        (
            road(box(), geometry="<curve/>"),
            "lot.xodr: road 1, geometry 0: got 'curve'; allowed: one of line, arc, spiral, poly3, paramPoly3",
        ),
        (
            road(box(), geometry='<arc curvature="inf"/>'),
            (
                "lot.xodr: road 1, geometry 0, arc, curvature: got 'inf'; allowed: a number of 1 / metres from -1000 "
                "to 1000"
            ),
        ),
        (
            '<road id="1" length="1"/>',
            "lot.xodr: road 1, planView: got 'nothing'; allowed: a geometry with a length above 0",
        ),
        (
            road(box('<repeat s="0" length="90000" distance="0.1"/>')),
            "lot.xodr: road 1, object 1, repeat, length: got 90000.0; allowed: at most 10000 repetitions",
        ),
        (
            road(box(), lanes=TWO_WAY.replace('id="1"', 'id="-2"')),
            "lot.xodr: road 1, laneSection 0, lane -2, id: got '-2'; allowed: a whole number above 0",
        ),
    ],
)
def test_malformed_maps_are_refused_by_element(tmp_path, roads, message):
    with pytest.raises(ConfigError) as raised:
        read_survey(written(tmp_path, roads))
    assert str(raised.value) == message
