import math

import pytest

from garage2usd.common.errors import ConfigError
from garage2usd.driving import DesignCar, Pose


def test_the_outer_front_tyre_rolls_a_circle_of_the_turning_radius():
    car = DesignCar()
    radius = car.rear_axle_radius_m
    start = Pose(0.0, 0.0, 0.0)
    centre = (-radius, 0.0)  # to the driver's left, who looks to -Z
    for turn in (0.0, 0.4, 1.3, 3.0):
        at = start.moved(radius * turn, 1 / radius)
        # the outer front tyre: a wheelbase ahead of the rear axle, half a track to the right
        x = at.x_m - math.sin(at.yaw_rad) * car.wheelbase_m + math.cos(at.yaw_rad) * car.track_m / 2
        z = at.z_m - math.cos(at.yaw_rad) * car.wheelbase_m - math.sin(at.yaw_rad) * car.track_m / 2
        assert math.dist((x, z), centre) == pytest.approx(6.0, abs=1e-9)


@pytest.mark.parametrize("curvature", [0.0, 0.2, -0.2])
@pytest.mark.parametrize("length", [1.7, -1.7])
def test_a_move_is_the_limit_of_many_short_straight_ones(curvature, length):
    pose = Pose(1.0, 2.0, 0.7)
    x, z, yaw, count = 1.0, 2.0, 0.7, 20_000
    for _ in range(count):
        yaw += curvature * length / count / 2
        x -= math.sin(yaw) * length / count
        z -= math.cos(yaw) * length / count
        yaw += curvature * length / count / 2
    end = pose.moved(length, curvature)
    assert (end.x_m, end.z_m, end.yaw_rad) == pytest.approx((x, z, yaw), abs=1e-6)


def test_a_centred_car_lies_around_the_middle():
    car = DesignCar()
    corners = car.corners(car.centred((3.0, -2.0), 0.9))
    assert sum(x for x, _ in corners) / 4 == pytest.approx(3.0)
    assert sum(z for _, z in corners) / 4 == pytest.approx(-2.0)
    front_left, front_right, rear_right, _ = corners
    assert math.dist(front_left, front_right) == pytest.approx(1.8)
    assert math.dist(front_right, rear_right) == pytest.approx(4.8)
    # the nose is where the yaw looks to, and the driver's left is to its left
    assert (front_left[0] - front_right[0], front_left[1] - front_right[1]) == pytest.approx(
        (-1.8 * math.cos(0.9), 1.8 * math.sin(0.9))
    )


@pytest.mark.parametrize(
    ("measures", "field"),
    [
        ({"length_m": 0.0}, "length_m"),
        ({"width_m": math.nan}, "width_m"),
        ({"turning_radius_m": math.inf}, "turning_radius_m"),
        ({"turning_radius_m": 3.0}, "turning_radius_m"),
        ({"track_m": 1.9}, "track_m"),
        ({"wheelbase_m": 4.0}, "wheelbase_m"),
    ],
)
def test_measures_of_no_car_are_refused_by_name(measures, field):
    with pytest.raises(ConfigError, match=field):
        DesignCar(**measures)
