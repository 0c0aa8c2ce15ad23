"""Ways out of one stall between others: its mouth is at z = 0, the aisle lies on its +Z side and runs along X."""

import math
from itertools import pairwise

import numpy as np
import pytest
import shapely
from support.driving_flood import has_way_out
from support.driving_simulation import outlines, simulate

from garage2usd.common.errors import ConfigError
from garage2usd.driving import DesignCar, Gear, LanePose, Limits, Manoeuvre, Obstacles, Pose, find_way

CAR = DesignCar()
NOSE_IN, NOSE_OUT = 0.0, math.pi
BOTH_WAYS = (math.pi / 2, -math.pi / 2)


def aisle(width_m, *extra):
    """A row of parked cars with a gap, a wall behind it and a wall across the aisle."""
    cars = [
        (f"car {place:+}", shapely.box(2.4 * place - 0.9, -5.05, 2.4 * place + 0.9, -0.25))
        for place in (-3, -2, -1, 1, 2, 3)
    ]
    walls = [("rear wall", shapely.box(-20, -6, 20, -5.3)), ("far wall", shapely.box(-20, width_m, 20, width_m + 0.3))]
    return [*cars, *walls, *extra]


def out_of(shapes, nose, width_m, *, yaws=BOTH_WAYS, **limits):
    lanes = [LanePose((0.0, width_m / 2), yaw, 16.0, max(width_m - 1.9, 0.0)) for yaw in yaws]
    return find_way(CAR, CAR.centred((0.0, -2.65), nose), Obstacles.of(shapes), lanes, Limits(**limits))


def drive(way):
    start = (way.start.x_m, way.start.z_m, way.start.yaw_rad)
    return simulate(start, [(str(move.gear), move.curvature_per_m, move.length_m) for move in way.moves])


@pytest.mark.parametrize("nose", [NOSE_IN, NOSE_OUT])
@pytest.mark.parametrize("width_m", [4.5, 5.5, 6.0, 8.1])
def test_a_way_out_keeps_its_clearance_and_ends_in_line_with_the_lane(width_m, nose):
    shapes = aisle(width_m)
    way = out_of(shapes, nose, width_m).way
    track = drive(way)
    gap = shapely.distance(outlines(track), shapely.union_all([shape for _, shape in shapes])).min()
    assert 0.05 <= way.clearance_m <= gap + 1e-6
    assert abs(math.cos(track[-1, 2])) < 1e-6
    assert 0.95 - 1e-6 <= track[-1, 1] <= width_m - 0.95 + 1e-6
    assert way.gear_changes <= 4
    assert max(abs(move.curvature_per_m) for move in way.moves) <= 1 / CAR.rear_axle_radius_m + 1e-12


def test_the_end_of_a_way_is_where_the_bicycle_gets_to():
    way = out_of(aisle(5.5), NOSE_IN, 5.5).way
    assert drive(way)[-1] == pytest.approx((way.end.x_m, way.end.z_m, way.end.yaw_rad), abs=1e-6)


def test_a_way_backwards_in_time_covers_the_same_ground():
    way = out_of(aisle(5.5), NOSE_IN, 5.5).way
    back = way.reversed()
    assert back.end.x_m == pytest.approx(way.start.x_m)
    assert back.end.yaw_rad == pytest.approx(way.start.yaw_rad)
    assert back.moves[0].gear is way.moves[-1].gear.other
    assert drive(back)[::-1] == pytest.approx(drive(way), abs=1e-6)


def test_the_lane_of_one_direction_is_left_in_that_direction():
    for yaw in BOTH_WAYS:
        way = out_of(aisle(8.1), NOSE_IN, 8.1, yaws=(yaw,)).way
        assert math.remainder(way.end.yaw_rad - yaw, math.tau) == pytest.approx(0, abs=1e-9)


def test_at_the_standards_aisle_a_car_parks_in_reverse_at_once_and_nose_in_with_a_correction():
    assert out_of(aisle(5.5), NOSE_OUT, 5.5).way.gear_changes == 0
    assert out_of(aisle(5.5), NOSE_IN, 5.5).way.gear_changes >= 1
    assert out_of(aisle(5.5), NOSE_IN, 5.5, gear_changes=0).way is None


@pytest.mark.parametrize("nose", [NOSE_IN, NOSE_OUT])
def test_the_narrowest_aisle_is_that_of_an_independent_search(nose):
    """The flood looks at samples and takes headings roughly, so it gets through a little less, and never needs more."""

    def is_on_lane(poses):
        return (np.abs(np.cos(poses[:, 2])) < 0.03) & (poses[:, 1] > 0.9)

    def floods(width_m):
        pose = CAR.centred((0.0, -2.65), nose)
        walls = shapely.union_all([shape for _, shape in aisle(width_m)])
        return has_way_out((pose.x_m, pose.z_m, pose.yaw_rad), walls, is_on_lane)

    widths = np.arange(3.0, 4.61, 0.2).tolist()
    proven = min(width for width in widths if out_of(aisle(width), nose, width, margin_m=0.0).way is not None)
    flooded = min(width for width in widths if floods(width))
    assert -1e-9 <= proven - flooded <= 0.4 + 1e-9


@pytest.mark.parametrize(
    ("extra", "name"),
    [
        (("column", shapely.box(-0.3, 1.0, 0.3, 1.6)), "column"),
        (("post", shapely.Point(0.0, 0.4)), "post"),
        (("chain", shapely.LineString([(-1.2, 0.1), (1.2, 0.1)])), "chain"),
        (("car across", shapely.box(-2.4, 0.3, 2.4, 2.1)), "car across"),
    ],
)
def test_what_stands_in_the_mouth_is_in_the_way_of_both_searches(extra, name):
    for nose in (NOSE_IN, NOSE_OUT):
        found = out_of(aisle(8.1, extra), nose, 8.1)
        assert found.way is None
        assert found.is_exhausted
        assert name in found.touched
        pose = CAR.centred((0.0, -2.65), nose)
        ground = shapely.union_all([shape for _, shape in aisle(8.1, extra)])
        start = pose.x_m, pose.z_m, pose.yaw_rad
        assert not has_way_out(start, ground, lambda poses: np.abs(np.cos(poses[:, 2])) < 0.03)


def test_a_car_that_touches_where_it_stands_is_named_at_once():
    found = out_of(aisle(8.1, ("pillar", shapely.box(0.8, -3.0, 1.0, -2.8))), NOSE_IN, 8.1)
    assert (found.way, found.touched) == (None, ("pillar",))


def test_a_wider_margin_needs_more_room():
    assert out_of(aisle(8.1), NOSE_IN, 8.1, margin_m=0.25).way.clearance_m >= 0.25
    assert out_of(aisle(8.1), NOSE_IN, 8.1, margin_m=0.31).way is None


@pytest.mark.parametrize("turned", [0.3, 1.2, -2.0])
def test_the_frame_does_not_matter(turned):
    """The same stall, turned and moved: the same way, turned and moved."""
    plain = out_of(aisle(5.5), NOSE_IN, 5.5).way
    cos, sin = math.cos(turned), math.sin(turned)

    def moved(x, z):
        return 7.0 + x * cos + z * sin, -3.0 - x * sin + z * cos

    shapes = [
        (name, shapely.transform(shape, lambda points: np.array([moved(x, z) for x, z in points])))
        for name, shape in aisle(5.5)
    ]
    lanes = [LanePose(moved(0.0, 2.75), yaw + turned, 16.0, 3.6) for yaw in BOTH_WAYS]
    parked = CAR.centred(moved(0.0, -2.65), turned)
    way = find_way(CAR, parked, Obstacles.of(shapes), lanes).way
    assert way.gear_changes == plain.gear_changes
    assert way.length_m == pytest.approx(plain.length_m, abs=0.5)


def test_a_car_parked_askew_gets_out():
    parked = CAR.centred((0.05, -2.65), math.radians(2.0))
    lanes = [LanePose((0.0, 4.0), yaw, 16.0, 6.0) for yaw in BOTH_WAYS]
    way = find_way(CAR, parked, Obstacles.of(aisle(8.1)), lanes).way
    assert way.end.yaw_rad / (math.pi / 2) == pytest.approx(round(way.end.yaw_rad / (math.pi / 2)), abs=1e-9)


def test_lanes_that_are_not_square_to_each_other_are_refused():
    lanes = [LanePose((0.0, 4.0), yaw, 16.0, 6.0) for yaw in (0.0, 1.0)]
    with pytest.raises(ConfigError, match="quarter turns"):
        find_way(CAR, Pose(0.0, 0.0, 0.0), Obstacles.of([]), lanes)


def test_without_a_lane_there_is_no_way():
    assert find_way(CAR, Pose(0.0, 0.0, 0.0), Obstacles.of([]), []).way is None


def test_waypoints_are_close_and_end_at_the_end():
    way = out_of(aisle(5.5), NOSE_IN, 5.5).way
    points = list(way.waypoints(0.1))
    assert (points[0].pose, points[-1].pose) == (way.start, way.end)
    assert points[-1].arc_m == pytest.approx(way.length_m)
    assert all(0 <= b.arc_m - a.arc_m <= 0.1 + 1e-9 for a, b in pairwise(points))
    assert {at.gear for at in points} == {Gear.FORWARD, Gear.REVERSE}
    assert not list(Manoeuvre(way.start, (), 1.0).waypoints())
    poses, move = way.poses(0.1)
    expected = np.array([(at.pose.x_m, at.pose.z_m, at.pose.yaw_rad) for at in points])
    assert np.abs(poses - expected).max() < 1e-12
    assert [way.moves[number].gear for number in move] == [at.gear for at in points[:-1]]
