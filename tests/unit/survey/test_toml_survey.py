"""TOML: runs fill their line with stalls of the given size, and wrong settings are named by key."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from garage2usd.common.errors import ConfigError
from garage2usd.config.stalls import SizeClass
from garage2usd.garage import StallUse
from garage2usd.structure.stalls import StallShape
from garage2usd.survey.reader import read_survey
from garage2usd.survey.survey import PortalKind

STALL = "[[stalls]]\ncorners = [[0, 0], [2.5, 0], [2.5, 5], [0, 5]]\n"


def read(tmp_path, text):
    path = tmp_path / "lot.toml"
    path.write_text(text)
    return read_survey(path)


def test_a_drawing_has_all_its_parts(tmp_path):
    survey = read(
        tmp_path,
        """
        outline = [[0, 0], [30, 0], [30, 20], [0, 20]]
        [[stalls]]
        id = "A"
        corners = [[1, 1], [1, 6], [3.5, 6], [3.5, 1]]
        mouth = 1
        use = "accessible"
        size = "large"
        number = 12
        [[stalls]]
        centre = [10, 10]
        heading_deg = 90
        width_m = 2
        length_m = 5
        number = "B 7"
        [[lanes]]
        points = [[0, 8], [30, 8]]
        width_m = 5
        one_way = true
        [[columns]]
        at = [5, 15]
        [[columns]]
        at = [6, 15]
        size_m = 0.6
        [[portals]]
        at = [0, 8]
        kind = "entrance"
        [[portals]]
        at = [30, 8]
        """,
    )
    first, second = survey.stalls
    assert (first.name, first.mouth, first.use, first.size) == ("A", 1, StallUse.ACCESSIBLE, SizeClass.LARGE)
    assert first.corners == ((1, 1), (1, 6), (3.5, 6), (3.5, 1))
    assert (first.number, second.number, second.name) == ("12", "B 7", "stalls.1")
    # a car that heads to y upwards enters from below, where z is greatest
    assert shapely.Polygon(second.corners).equals(shapely.box(9, 7.5, 11, 12.5))
    assert {z for _, z in (second.corners[second.mouth], second.corners[(second.mouth + 1) % 4])} == {12.5}
    (lane,) = survey.lanes
    assert (lane.points, lane.width_m, lane.one_way) == (((0, 8), (30, 8)), 5, True)
    assert survey.columns == (((5, 15), 0.4), ((6, 15), 0.6))
    assert survey.portals == (((0, 8), PortalKind.ENTRANCE), ((30, 8), PortalKind.BOTH))
    assert survey.outline == ((0, 0), (30, 0), (30, 20), (0, 20))
    assert (survey.unread, survey.origin_deg) == ((), None)


ends = st.tuples(st.floats(-100, 100), st.floats(-100, 100))


@settings(deadline=None)
@given(
    first=ends,
    last=ends,
    side=st.sampled_from(["left", "right"]),
    width_m=st.floats(2, 4),
    length_m=st.floats(4, 6),
    angle=st.sampled_from([None, 30.0, 45.0, 60.0, 72.5]) | st.just(0.0),
    leans=st.sampled_from(["towards last", "towards first"]),
)
def test_runs_have_the_shapes_of_drawn_stalls(tmp_path_factory, first, last, side, width_m, length_m, angle, leans):
    shape = StallShape(width_m, length_m, 90.0 if angle is None else angle)
    line_m = math.dist(first, last)
    assume(line_m > shape.pitch_m + 0.01)
    kind = {None: "perpendicular", 0.0: "parallel"}.get(angle, f'angled"\nangle_deg = {angle}\nleans = "{leans}')
    text = (
        f'[[runs]]\nfirst = {list(first)}\nlast = {list(last)}\nside = "{side}"\nkind = "{kind}"\n'
        f"width_m = {width_m}\nlength_m = {length_m}\nnumber = 5\n"
    )
    stalls = read(tmp_path_factory.mktemp("toml"), text).stalls
    assert len(stalls) == pytest.approx(line_m / shape.pitch_m, abs=1.0)
    # whose pitch is rounded up to the millimetre
    assert len(stalls) <= line_m / (shape.pitch_m - 0.001) + 0.01
    mouth_line = shapely.LineString([first, last])
    along = np.subtract(last, first) / line_m
    for index, stall in enumerate(stalls):
        assert (stall.name, stall.number, stall.mouth) == (f"runs.0.{index}", str(5 + index), 0)
        quad = shapely.Polygon(stall.corners)
        assert quad.area == pytest.approx(shape.pitch_m * shape.depth_m, rel=2e-3)
        mouth = shapely.LineString(stall.corners[:2])
        assert mouth.length == pytest.approx(shape.pitch_m, abs=2e-3)
        assert max(mouth_line.distance(shapely.Point(corner)) for corner in stall.corners[:2]) < 1e-5
        backwards = np.subtract(stall.corners[3], stall.corners[0])
        # seen with z downwards, what is at the right has a positive cross product
        assert (along[0] * backwards[1] - along[1] * backwards[0] > 0) == (side == "right")
        lean_m = along @ backwards
        expected_m = shape.depth_m * shape.slope * (1 if leans == "towards last" else -1)
        assert lean_m == pytest.approx(expected_m, abs=5e-3)
    tree = shapely.STRtree([shapely.Polygon(stall.corners) for stall in stalls])
    pairs = tree.query(tree.geometries, predicate="overlaps").T
    assert all(tree.geometries[a].intersection(tree.geometries[b]).area < 1e-3 for a, b in pairs)


def test_counts_share_the_line(tmp_path):
    text = '[[runs]]\nid = "N"\nfirst = [0, 0]\nlast = [10, 0]\nside = "left"\ncount = 4\n'
    stalls = read(tmp_path, text).stalls
    assert [stall.name for stall in stalls] == ["N.0", "N.1", "N.2", "N.3"]
    assert shapely.union_all([shapely.Polygon(stall.corners) for stall in stalls]).equals(shapely.box(0, -5, 10, 0))
    parallel = read(tmp_path, f'{text}kind = "parallel"\n').stalls
    assert shapely.union_all([shapely.Polygon(stall.corners) for stall in parallel]).equals(shapely.box(0, -2.5, 10, 0))


RUN = '[[runs]]\nfirst = [0, 0]\nlast = [10, 0]\nside = "left"\n'


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (f"{STALL}colour = 1\n", ("lot.toml: stalls.0.colour: got 1; allowed: one of the keys id, corners, centre, "
         "heading_deg, width_m, length_m, mouth, use, size, number")),
        (f'{STALL}use = "boats"\n', ("lot.toml: stalls.0.use: got 'boats'; allowed: 'standard', 'turning', 'ev', "
         "'accessible', 'access_aisle', 'unreachable' or 'motorcycle'")),
        (f"{STALL}mouth = 4\n", "lot.toml: stalls.0.mouth: got 4; allowed: less than or equal to 3"),
        ("[[stalls]]\ncentre = [0, 0]\n", ("lot.toml: stalls.0: got {'centre': [0, 0]}; allowed: corners, or centre, "
         "heading_deg, width_m and length_m")),
        (f"{STALL}width_m = 2\n", "either corners, or centre, heading_deg, width_m and length_m"),
        (RUN, "count or width_m"),
        (f'{RUN}kind = "parallel"\n', "count or length_m"),
        (f'{RUN}count = 4\nkind = "angled"\n', "angle_deg for angled stalls, and for these only"),
        (f"{RUN}count = 5\nwidth_m = 2.5\n", "5 to 10000 stalls on the line, which has room for 4"),
        (f"{RUN}width_m = 20\n", "1 to 10000 stalls on the line, which has room for 0"),
        ("[[lanes]]\npoints = [[0, 0]]\n", "lot.toml: lanes.0.points: got"),
        ("[[columns]]\nat = [0, nan]\n", "lot.toml: columns.0.at.1: got nan; allowed:"),
        ("[[columns]]\nsize_m = 1\n", "lot.toml: columns.0.at: got 'nothing'; allowed: a value; columns.0 needs at"),
        ('[[portals]]\nat = [0, 0]\nkind = "door"\n', ("lot.toml: portals.0.kind: got 'door'; allowed: 'entrance', "
         "'exit' or 'both'")),
        ("stalls = 3\n", "lot.toml: stalls: got 3; allowed:"),
        ("[[stalls]", "SOURCE: got"),
    ],
)  # fmt: skip
def test_wrong_settings_are_refused(tmp_path, text, message):
    with pytest.raises(ConfigError) as raised:
        read(tmp_path, text)
    assert message in str(raised.value)
