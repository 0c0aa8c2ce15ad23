import math
from dataclasses import replace

import pytest

import garage2usd
from garage2usd.garage import Stall, StallKind, StallUse
from garage2usd.layout.parking.stalls import garage_stalls

SQUARE = Stall("A", ((-1.2, 2.5), (1.2, 2.5), (1.2, -2.5), (-1.2, -2.5)), StallUse.STANDARD, 0)


def turned(stall, yaw_rad):
    cos, sin = math.cos(yaw_rad), math.sin(yaw_rad)
    return replace(stall, corners=tuple((x * cos + z * sin, -x * sin + z * cos) for x, z in stall.corners))


@pytest.mark.parametrize("yaw_rad", [0.0, math.pi / 2, -math.pi / 2, math.pi, 0.5, -2.0])
def test_a_stall_that_is_turned_keeps_its_shape_and_has_the_turn_as_yaw(yaw_rad):
    stall = turned(SQUARE, yaw_rad)
    assert stall.yaw_rad == pytest.approx(yaw_rad, abs=1e-5)
    assert (stall.width_m, stall.length_m) == pytest.approx((2.4, 5.0))
    assert (stall.angle_deg, stall.kind) == (pytest.approx(90.0), StallKind.PERPENDICULAR)


@pytest.mark.parametrize("yaw_rad", [0.0, math.pi / 2, -math.pi / 2, math.pi])
def test_quarter_turns_are_exact_though_a_stage_keeps_single_precision(yaw_rad):
    corners = tuple((x + 4e-6 * number, z - 3e-6) for number, (x, z) in enumerate(turned(SQUARE, yaw_rad).corners))
    assert replace(SQUARE, corners=corners).yaw_rad == yaw_rad


@pytest.mark.parametrize(("shear_m", "angle_deg"), [(5.0, 45.0), (-5.0, 135.0)])
def test_a_stall_with_slanted_sides_is_angled(shear_m, angle_deg):
    left, right, (right_x, rear), (left_x, _) = SQUARE.corners
    slanted = replace(SQUARE, corners=(left, right, (right_x + shear_m, rear), (left_x + shear_m, rear)))
    assert (slanted.angle_deg, slanted.kind) == (pytest.approx(angle_deg), StallKind.ANGLED)


@pytest.mark.parametrize("slope", [0.0, 0.5, -1.0])
def test_the_rectangle_for_a_car_lies_between_the_lines_of_an_angled_stall(slope):
    # sides along Z, 2.4 m apart; mouth and rear rise by the slope
    corners = [(x, z + slope * x) for x, z in ((-1.2, 4.0), (1.2, 4.0), (1.2, -4.0), (-1.2, -4.0))]
    stall = replace(SQUARE, corners=tuple(corners))
    assert (stall.width_m, stall.length_m) == (pytest.approx(2.4), pytest.approx(8.0 - 2.4 * abs(slope)))
    assert stall.yaw_rad == 0.0
    assert stall.tail == pytest.approx((0.0, stall.length_m / 2))
    ground = turned(stall, 0.7).rectangle
    assert ground.area == pytest.approx(stall.width_m * stall.length_m)
    assert turned(stall, 0.7).polygon.buffer(1e-9).covers(ground)
    assert ground.minimum_rotated_rectangle.area == pytest.approx(ground.area)


def test_a_car_in_a_parallel_stall_has_the_lane_on_its_left():
    along = replace(SQUARE, corners=((-3.0, 1.2), (3.0, 1.2), (3.0, -1.2), (-3.0, -1.2)))
    # seen from above with X to the right and Z down, the lane is below; with it on the left the car drives to the left
    assert along.backwards == (1.0, 0.0)
    assert along.yaw_rad == pytest.approx(math.pi / 2)


def test_a_stall_along_the_lane_is_parallel():
    along = replace(SQUARE, corners=((-3.0, 1.2), (3.0, 1.2), (3.0, -1.2), (-3.0, -1.2)))
    assert (along.kind, along.width_m, along.length_m) == (StallKind.PARALLEL, 2.4, 6.0)


def test_the_stalls_of_a_layout_keep_place_turn_size_and_lane():
    garage = garage2usd.generate(seed=2)
    stalls = list(garage_stalls(garage.layout.stalls, garage.graph))
    assert {stall.kind for stall in stalls} == {StallKind.PERPENDICULAR}
    for stall, placed in zip(stalls, garage.layout.stalls, strict=True):
        assert (stall.name, stall.use, stall.number or "") == (placed.name, placed.use, placed.number)
        assert tuple(round(value, 6) for value in stall.centre) == placed.centre_m
        assert stall.yaw_rad == placed.yaw_rad
        assert (stall.width_m, stall.length_m) == pytest.approx((placed.width_m, placed.length_m))
        assert stall.access == garage.graph.number_of[placed.access_square]
