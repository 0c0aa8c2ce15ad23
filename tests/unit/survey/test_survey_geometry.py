"""Alignment, lanes, mouths and shapes of surveyed garages, against networkx, shapely and figures by hand."""

import math
from dataclasses import replace

import networkx as nx
import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from garage2usd.common.errors import ConfigError
from garage2usd.garage import LaneKind
from garage2usd.survey.clear_ground import with_clear_widths, with_medial_lanes
from garage2usd.survey.fitted_stalls import fitted_stalls
from garage2usd.survey.lane_network import Gate, lane_network
from garage2usd.survey.stall_shapes import stall_shape
from garage2usd.survey.survey import Survey, SurveyedColumn, SurveyedLane, SurveyedStall, aligned

GATES = (
    Gate(LaneKind.ENTRANCE, (0.0, 10.0), (-1.0, 0.0), 5.0),
    Gate(LaneKind.EXIT, (40.0, 10.0), (1.0, 0.0), 5.0),
)
LANE = SurveyedLane(((4.0, 10.0), (36.0, 10.0)), 6.0)


def box(name, left, top, width, depth, **facts):
    corners = ((left, top), (left + width, top), (left + width, top + depth), (left, top + depth))
    return SurveyedStall(name, corners, **facts)


def lot(*stalls, lanes=(LANE,), columns=()):
    outline = ((0.0, 0.0), (40.0, 0.0), (40.0, 20.0), (0.0, 20.0))
    return Survey(tuple(stalls), tuple(lanes), tuple(columns), outline=outline)


def fitted(survey, *, keeps_left=False):
    return fitted_stalls(survey, lane_network(survey.lanes, GATES), keeps_left=keeps_left)[:2]


@settings(deadline=None, max_examples=60)
@given(st.floats(-math.pi, math.pi), st.floats(-1e4, 1e4), st.floats(-1e4, 1e4))
def test_a_survey_is_aligned_whatever_way_it_was_drawn(turn, x, z):
    drawn = lot(*(box(f"{n}", 5 + 2.5 * n, 2, 2.5, 5) for n in range(8)))
    found, alignment = aligned(drawn.moved(turn, (x, z)))
    assert shapely.Polygon(found.outline).bounds[:2] == pytest.approx((0, 0), abs=1e-5)
    for stall, ground in zip(found.stalls, found.stall_polygons(), strict=True):
        assert ground.area == pytest.approx(12.5, abs=1e-3)
        assert ground.envelope.area == pytest.approx(ground.area, abs=0.02), stall.name
    again = drawn.moved(turn, (x, z)).moved(alignment.turn_rad, alignment.shift_m)
    assert np.allclose(again.stalls[0].corners, found.stalls[0].corners, atol=1e-5)


def test_without_an_outline_all_parts_are_inside():
    stalls = [box(f"{n}", 5 + 2.5 * n, 2, 2.5, 5) for n in range(4)]
    found, _ = aligned(Survey(tuple(stalls), (LANE,), (SurveyedColumn((30.0, 3.0), 0.5),)))
    outline = shapely.Polygon(found.outline)
    assert outline.covers(shapely.union_all(found.stall_polygons()))
    assert outline.covers(shapely.Point(found.columns[0].centre).buffer(0.25))


def test_scattered_parts_have_an_outline_that_follows_them():
    arm = [box(f"a{n}", 2.5 * n, 0, 2.5, 5) for n in range(30)] + [
        box(f"b{n}", 0, 8 + 2.5 * n, 5, 2.5) for n in range(30)
    ]
    found, _ = aligned(Survey(tuple(arm), (SurveyedLane(((8.0, 8.0), (74.0, 8.0)), 5.0),)))
    outline = shapely.Polygon(found.outline)
    assert outline.covers(shapely.union_all(found.stall_polygons()))
    assert outline.area < 0.5 * outline.envelope.area


def test_lanes_that_stop_short_of_each_other_are_joined():
    lanes = (
        SurveyedLane(((4.0, 10.0), (36.0, 10.0)), 6.0),
        SurveyedLane(((20.0, 14.0), (20.0, 30.0)), 6.0),  # four metres short of the first
        SurveyedLane(((26.0, 33.0), (60.0, 33.0)), 6.0),  # an open corner with the second
    )
    graph = lane_network(lanes, GATES)
    assert nx.is_weakly_connected(graph.graph)
    assert {(20.0, 10.0), (20.0, 33.0)} <= {node.position for node in graph.nodes}
    assert [node.kind for node in graph.nodes][:2] == ["entrance", "exit"]


def test_no_lane_is_joined_over_a_stall():
    lanes = (LANE, SurveyedLane(((20.0, 17.0), (20.0, 30.0)), 6.0))
    between = box("1", 18, 11, 5, 5)
    assert nx.is_weakly_connected(lane_network(lanes, GATES).graph)
    assert not nx.is_weakly_connected(
        lane_network(lanes, GATES, between_grounds := [shapely.Polygon(between.corners)]).graph
    )
    assert between_grounds


def test_one_way_lanes_are_driven_along_their_points_alone():
    graph = lane_network((SurveyedLane(LANE.points, 4.0, one_way=True),), GATES)
    middles = [edge for edge in graph.edges if not graph.nodes[edge.start].is_portal]
    assert all(edge.one_way for edge in middles)
    entrance, exit_ = graph.portals("entrance")[0], graph.portals("exit")[0]
    assert nx.has_path(graph.graph, entrance, exit_)
    assert not nx.has_path(graph.graph, exit_, entrance)


def test_a_lane_that_bends_before_a_door_leads_to_the_door():
    way_out = ((26.0, 7.5), (31.0, 7.8), (36.0, 9.0), (40.0, 10.0))
    lanes = (SurveyedLane(((4.0, 10.0), (26.0, 10.0)), 6.0), SurveyedLane(((26.0, -5.0), (26.0, 25.0)), 6.0))
    graph = lane_network((*lanes, SurveyedLane(way_out, 3.7, one_way=True)), GATES)
    (before,) = graph.graph.predecessors(graph.portals("exit")[0])
    assert shapely.LineString(way_out).distance(shapely.Point(graph.nodes[before].position)) < 0.1


def test_lanes_to_landings_in_a_corner_are_not_joined_to_each_other():
    up = Gate(LaneKind.EXIT, (30.0, 19.4), (0.0, 1.0), 4.0, is_landing=True)
    down = Gate(LaneKind.ENTRANCE, (31.1, 18.4), (1.0, 0.0), 4.0, is_landing=True)
    lanes = (
        LANE,
        SurveyedLane(((30.0, 10.0), (30.0, 14.0)), 3.7, one_way=True),
        SurveyedLane(((25.6, 18.4), (20.0, 18.4), (20.0, 10.0)), 3.7, one_way=True),
    )
    graph = lane_network(lanes, (up, down))
    (exit_,), (entrance,) = graph.portals("exit"), graph.portals("entrance")
    assert graph.nodes[exit_].position[0] == 30.0
    assert graph.nodes[entrance].position[1] == 18.4
    assert nx.shortest_path(graph.graph, entrance, exit_)[1:-1]  # by the aisle


def test_lanes_are_as_wide_as_the_ground_between_stalls():
    stalls = [box(f"{n}", 10 + 2.5 * n, 1.4, 2.5, 5) for n in range(8)]
    standing = shapely.union_all([shapely.Polygon(stall.corners) for stall in stalls])
    graph = with_clear_widths(lane_network((LANE,), GATES), standing)
    widths = {
        edge.width_m for edge in graph.edges if 11 < graph.nodes[edge.start].position[0] < 29 and not edge.one_way
    }
    assert widths == {7.2}


@pytest.mark.parametrize(
    ("stall", "kind", "outwards"),
    [
        (box("up", 10, 2, 2.5, 5), "perpendicular", (0.0, 1.0)),
        (box("down", 10, 13, 2.5, 5), "perpendicular", (0.0, -1.0)),
        (box("along", 10, 4.6, 6, 2.4), "parallel", (0.0, 1.0)),
        (SurveyedStall("slanted", ((10.0, 7.0), (13.0, 7.0), (10.5, 2.67), (7.5, 2.67))), "angled", (0.5, 0.866)),
    ],
    ids=lambda value: getattr(value, "name", None),
)
def test_stalls_open_onto_their_lane(stall, kind, outwards):
    (found,), unplaced = fitted(lot(stall))
    assert not unplaced
    assert np.allclose(found.shape.outwards, outwards, atol=1e-3)
    angle = {"perpendicular": 90.0, "parallel": 0.0}.get(kind)
    assert found.shape.angle_deg == angle or (angle is None and found.shape.angle_deg == pytest.approx(60, abs=0.1))


def test_parallel_cars_look_along_traffic():
    stall = box("1", 10, 4.6, 6, 2.4)
    ahead = {}
    for keeps_left in (False, True):
        (found,), _ = fitted(lot(stall), keeps_left=keeps_left)
        ahead[keeps_left] = -math.sin(found.shape.yaw_rad)
    # the lane is south of the stall: who keeps to the right drives west there
    assert ahead == {False: pytest.approx(-1), True: pytest.approx(1)}
    one_way = SurveyedLane(LANE.points, 4.0, one_way=True)
    (found,), _ = fitted(lot(stall, lanes=(one_way,)))
    assert -math.sin(found.shape.yaw_rad) == pytest.approx(1)


@pytest.mark.parametrize(
    ("stalls", "reason"),
    [
        ([box("far", 10, 40, 2.5, 5)], "the nearest lane is 30.0 m away, more than 9"),
        ([box("1", 10, 2, 2.5, 5), box("2", 11, 2, 2.5, 5)], "60% of its ground is that of stall 1"),
        ([box("small", 10, 6, 0.9, 1)], "its ground of 0.90 m2 is too small or crosses itself"),
        (
            [SurveyedStall("bent", ((10.0, 7.0), (13.0, 7.0), (14.5, 2.0), (9.0, 1.0)))],
            "a corner is 0.67 m from the nearest rectangle or parallelogram, above 0.25",
        ),
    ],
    ids=["far", "overlapping", "small", "bent"],
)
def test_stalls_that_cannot_be_placed_are_named(stalls, reason):
    _, unplaced = fitted(lot(*stalls))
    assert [(each.name, each.reason) for each in unplaced] == [(stalls[-1].name, reason)]


def test_stalls_on_lanes_without_a_route_are_named():
    apart = SurveyedLane(((4.0, 60.0), (36.0, 60.0)), 6.0)
    _, unplaced = fitted(lot(box("1", 10, 52, 2.5, 5), lanes=(LANE, apart)))
    assert [each.reason for each in unplaced] == ["no route from an entrance and to an exit over its lane"]


def test_a_square_rear_is_laid_parallel_to_the_mouth_and_said_so():
    # 45 degrees, as esmini draws them: the mouth on the lane, the rear square to the sides
    corners = ((10.0, 7.0), (13.53, 7.0), (8.23, 1.7), (6.47, 3.47))
    (found,), unplaced = fitted(lot(SurveyedStall("1", corners)))
    assert not unplaced
    assert found.note == "its rear is laid parallel to its mouth, by which a corner moves 2.50 m"
    assert (found.shape.width_m, found.shape.length_m) == (pytest.approx(2.5, abs=0.01), pytest.approx(5.0, abs=0.01))


@settings(deadline=None, max_examples=80)
@given(st.floats(2.2, 3.5), st.floats(4.2, 6.0), st.floats(30, 150), st.floats(-math.pi, math.pi))
def test_shapes_are_those_that_corners_were_made_of(width, length, angle, turn):
    sin, cos = math.sin(math.radians(angle)), math.cos(math.radians(angle))
    side = length + width * abs(cos / sin)
    mouth = np.array([[0.0, 0.0], [width / sin, 0.0]])
    back = np.array([cos, -sin]) * side
    corners = np.concatenate([mouth, (mouth + back)[::-1]])
    spin = np.array([[math.cos(turn), math.sin(turn)], [-math.sin(turn), math.cos(turn)]])
    found = stall_shape(corners @ spin, 0, keeps_left=False)
    assert found.width_m == pytest.approx(width, abs=0.06)
    assert found.length_m == pytest.approx(length, abs=0.12)
    assert found.angle_deg == pytest.approx(min(angle, 180 - angle), abs=1.01)


def test_lanes_are_derived_from_the_ground_between_stalls():
    rows = [box(f"{row}{n}", 2.5 * n, z, 2.5, 5) for row, z in (("a", 0), ("b", 11)) for n in range(12)]
    found = with_medial_lanes(Survey(tuple(rows)))
    middle = shapely.union_all([shapely.LineString(lane.points) for lane in found.lanes])
    assert middle.hausdorff_distance(shapely.LineString([(2, 8), (28, 8)])) < 2.5
    assert with_medial_lanes(lot()).lanes == (LANE,)
    with pytest.raises(ConfigError, match="lanes: got 'none'"):
        with_medial_lanes(Survey((box("1", 0, 0, 2.5, 5),), outline=((0, 0), (2.5, 0), (2.5, 5), (0, 5))))


def test_lanes_are_laid_before_stalls_without_ground_between():
    row = tuple(box(str(number), 2.5 * number, 0, 2.5, 5) for number in range(4))
    assert [len(with_medial_lanes(Survey(stalls)).lanes) for stalls in (row, row[:1])] == [1, 1]
    (lane,) = with_medial_lanes(Survey(tuple(replace(stall, mouth=2) for stall in row))).lanes
    assert all(5 < z < 11 for _, z in lane.points)
