"""Maps as Apollo, CARLA and Autoware write them, made by hand after their converters and public files."""

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely
from pyproj import Geod

from garage2usd.survey.paired_lanes import paired_lanes
from garage2usd.survey.reader import read_survey
from garage2usd.survey.survey import SurveyedLane

ORIGIN_DEG = 110.498, 41.6706
GEOD = Geod(ellps="WGS84")


def degrees(points):
    """Return longitude and latitude of points in metres east and north, by geodesics instead of a projection."""
    for x, y in points:
        longitude, latitude, _ = GEOD.fwd(*ORIGIN_DEG, math.degrees(math.atan2(x, y)), math.hypot(x, y))
        yield longitude, latitude


def apollo(stalls, lanes="", *, places=degrees):
    """Return Apollo's OpenDRIVE with stalls by their corners."""
    objects = "".join(
        f'<object type="parkingSpace" id="{number}" heading="0.5"><outline>'
        + "".join(f'<cornerGlobal x="{x!r}" y="{y!r}" z="0.0"/>' for x, y in places(corners))
        + "</outline></object>"
        for number, corners in enumerate(stalls, 28)
    )
    return (
        '<OpenDRIVE xmlns="http://www.example.org"><header revMajor="1" revMinor="0" name="lot"><geoReference>'
        "<![CDATA[+proj=longlat +datum=WGS84 +no_defs]]></geoReference></header>"
        f'<road id="1" junction="-1" type="PARK"><lanes>{lanes}</lanes><objects>{objects}</objects></road></OpenDRIVE>'
    )


def curve(tag, points, *, places=degrees):
    dots = "".join(f'<point x="{x!r}" y="{y!r}" z="0"/>' for x, y in places(points))
    return f'<{tag}><geometry sOffset="0" x="0" y="0" z="0" length="1"><pointSet>{dots}</pointSet></geometry></{tag}>'


def lane(number, border, centre, direction="forward", kind="driving", samples=""):
    return (
        f'<lane id="{number}" uid="1_{number}" type="{kind}" direction="{direction}">'
        f"{border}{centre}<sampleAssociates>{samples}</sampleAssociates></lane>"
    )


STALLS = [[(10 + 3 * n, 4), (13 + 3 * n, 4), (13 + 3 * n, 9), (10 + 3 * n, 9)] for n in range(4)]


def read(folder, text):
    path = folder / "map.xodr"
    path.write_text(text)
    return read_survey(path)


def test_stalls_of_apollo_lie_on_the_earth(tmp_path):
    survey = read(tmp_path, apollo(STALLS))
    assert [stall.name for stall in survey.stalls] == [f"road 1, object {number}" for number in range(28, 32)]
    assert survey.unread == ()
    found = np.array([stall.corners for stall in survey.stalls]) * (1, -1)
    expected = np.array(STALLS, dtype=float)
    shift = (found - expected).mean(axis=(0, 1))
    assert np.abs(found - expected - shift).max() < 1e-3
    assert survey.origin_deg == pytest.approx(ORIGIN_DEG[::-1], abs=1e-3)


@pytest.mark.parametrize("sides", ["both", "right", "backward"])
def test_lanes_of_apollo_lie_between_their_borders(tmp_path, sides):
    ends = [0.0, 40.0]
    border = {y: curve("border", [(x, y) for x in ends]) for y in (-3.0, 0.0, 3.0)}
    middle = {y: curve("centerLine", [(x, y) for x in ends]) for y in (-1.5, 1.5)}
    direction = "backward" if sides == "backward" else "forward"
    section = f"<right>{lane(-1, border[-3.0], middle[-1.5], direction)}</right>"
    centre = f'<center><lane id="0" uid="1_0" type="none">{border[0.0]}</lane></center>'
    if sides == "both":
        back = curve("centerLine", [(40.0, 1.5), (0.0, 1.5)])
        section = f"<left>{lane(1, border[3.0], back)}</left>{section}"
    survey = read(tmp_path, apollo(STALLS, f"<laneSection>{section}{centre}</laneSection>"))
    (found,) = survey.lanes
    assert found.one_way == (sides != "both")
    assert found.width_m == pytest.approx(6.0 if sides == "both" else 3.0, abs=0.01)
    (start_x, start_z), (end_x, end_z) = found.points
    stall = shapely.Polygon(survey.stalls[0].corners)
    apart_m = 4.0 if sides == "both" else 5.5
    assert shapely.LineString(found.points).distance(stall) == pytest.approx(apart_m, abs=0.01)
    assert end_x - start_x == pytest.approx(-40.0 if sides == "backward" else 40.0, abs=0.01)
    assert abs(end_z - start_z) < 0.01


def test_lanes_of_apollo_without_borders_follow_their_centre_lines(tmp_path):
    sample = '<sampleAssociate sOffset="0" leftWidth="1.6" rightWidth="1.4"/>'
    section = lane(-1, "", curve("centerLine", [(0, 0), (20, 0), (20, -20)]), "bidirection", "cityDriving", sample)
    survey = read(tmp_path, apollo(STALLS, f"<laneSection><center/><right>{section}</right></laneSection>"))
    (found,) = survey.lanes
    assert (found.one_way, found.width_m, len(found.points)) == (False, 3.0, 3)


def test_metres_in_apollo_s_form_are_metres(tmp_path):
    moved = [[(x + 552000.0, y + 4182000.0) for x, y in corners] for corners in STALLS]
    survey = read(tmp_path, apollo(moved, places=iter))
    assert survey.origin_deg is None
    assert survey.stalls[0].corners[0] == (552010.0, -4182004.0)


def road(lanes, objects="", length_m=50.0):
    return (
        f'<OpenDRIVE><header revMajor="1" revMinor="4"/><road id="7" length="{length_m}" junction="-1"><planView>'
        f'<geometry s="0" x="0" y="0" hdg="0" length="{length_m}"><line/></geometry></planView><lanes>{lanes}</lanes>'
        f"<objects>{objects}</objects></road></OpenDRIVE>"
    )


def section(start_m, parking_m, *, slope=0.0):
    return (
        f'<laneSection s="{start_m}"><center><lane id="0" type="none"/></center><right>'
        '<lane id="-1" type="driving"><width sOffset="0" a="3.5" b="0" c="0" d="0"/></lane>'
        f'<lane id="-2" type="parking"><width sOffset="0" a="{parking_m}" b="{slope}" c="0" d="0"/></lane>'
        "</right></laneSection>"
    )


@pytest.mark.parametrize(
    ("width_m", "count", "kind", "along_m"), [(2.5, 8, "parallel", 6.0), (5.0, 20, "perpendicular", 2.5)]
)
def test_parking_lanes_are_divided(tmp_path, width_m, count, kind, along_m):
    survey = read(tmp_path, road(section(0.0, width_m)))
    assert len(survey.stalls) == count
    (told,) = survey.unread
    assert told.name == "road 7, lane -2 at 0 m"
    assert told.reason == f"a parking lane without stalls; {count} {kind} ones are laid along it"
    for number, stall in enumerate(survey.stalls):
        ground = shapely.box(number * along_m, 3.5, (number + 1) * along_m, 3.5 + width_m)
        assert shapely.Polygon(stall.corners).equals_exact(ground, 1e-6, normalize=True)
        mouth = shapely.LineString([stall.corners[stall.mouth], stall.corners[(stall.mouth + 1) % 4]])
        assert {z for _, z in mouth.coords} == {3.5}  # on the carriageway


def test_a_parking_lane_runs_through_sections_and_ends_where_it_is_narrow(tmp_path):
    sections = section(0.0, 2.5) + section(10.0, 2.5) + section(40.0, 2.5, slope=-0.25)
    survey = read(tmp_path, road(sections))
    assert len(survey.stalls) == 7  # 42.8 m are 1.8 m wide or more
    assert [part.name for part in survey.unread] == ["road 7, lane -2 at 0 m"]
    too_narrow = road(section(0.0, 1.2), '<object id="1" type="pole" s="1" t="1"/>')
    with pytest.raises(Exception, match="a parking lane too short or too narrow for a car"):
        read(tmp_path, too_narrow)


def test_stalls_of_a_road_take_its_parking_lanes(tmp_path):
    stall = '<object id="1" type="parkingSpace" s="10" t="-4.75" hdg="0" length="5" width="2.5"/>'
    survey = read(tmp_path, road(section(0.0, 2.5), stall))
    assert (len(survey.stalls), survey.unread) == (1, ())


def autoware(folder, spaces):
    nodes, ways = [], []
    for number, (line, tags) in enumerate(spaces):
        for end, (x, y) in enumerate(line):
            local = f'<tag k="local_x" v="{x}"/><tag k="local_y" v="{y}"/>'
            nodes.append(f'<node id="{10 * number + end + 1}" lat="0" lon="0">{local}</node>')
        refs = f'<nd ref="{10 * number + 1}"/><nd ref="{10 * number + 2}"/>'
        ways.append(f'<way id="{10 * number + 5}">{refs}<tag k="type" v="parking_space"/>{tags}</way>')
    path = folder / "map.osm"
    path.write_text(f"<osm>{''.join(nodes)}{''.join(ways)}</osm>")
    return read_survey(path)


def test_spaces_without_a_width_are_as_wide_as_they_are_apart(tmp_path):
    lines = [((2.6 * number, 0), (2.6 * number, 5)) for number in range(3)] + [((30, 0), (30, 5))]
    survey = autoware(tmp_path, [(line, "") for line in lines])
    widths = [shapely.Polygon(stall.corners).area / 5 for stall in survey.stalls]
    assert widths == pytest.approx([2.6, 2.6, 2.6, 2.5])
    assert [part.reason for part in survey.unread] == [
        f"a parking space without a width; {width} m are taken" for width in (2.6, 2.6, 2.6, 2.5)
    ]
    told = autoware(tmp_path, [(lines[0], '<tag k="width" v="2.3"/>'), (lines[1], "")])
    assert [shapely.Polygon(stall.corners).area / 5 for stall in told.stalls] == pytest.approx([2.3, 2.6])
    assert len(told.unread) == 1


def test_lanes_that_lead_to_and_fro_are_one():
    there = SurveyedLane(((0.0, 0.0), (10.0, 0.0)), 3.0, one_way=True)
    back = SurveyedLane(((10.0, -3.2), (0.0, -3.2)), 3.0, one_way=True)
    (both,) = paired_lanes([there, back])
    assert (both.one_way, both.width_m) == (False, pytest.approx(6.2))
    assert {z for _, z in both.points} == {-1.6}
    same_way = replace(back, points=back.points[::-1])
    further = replace(back, points=((10.0, -3.6), (0.0, -3.6)))
    shorter = replace(back, points=((10.0, -3.2), (5.0, -3.2)))
    for other in (same_way, further, shorter, replace(back, one_way=False)):
        assert paired_lanes([there, other]) == [there, other]
