"""Two cars that come to a junction at once pass it in the order that the rule of the road says."""

import math

import numpy as np
import pytest

from garage2usd.config.outputs import DriveConfig
from garage2usd.driving import DesignCar, Pose
from garage2usd.driving.manoeuvre import Gear
from garage2usd.driving.path import Path, Piece
from garage2usd.driving.road import FloorSpan
from garage2usd.garage import LaneEdge, LaneGraph, LaneKind, LaneNode
from garage2usd.traffic.ground import Ground, Raster
from garage2usd.traffic.simulation import Simulation
from garage2usd.traffic.trips import Stretch, Trip

_REACH_M, _ASIDE_M = 40.0, 1.5
_SETTINGS = DriveConfig(lane_speed_m_s=4.2)
_ARMS = [(0.0, -_REACH_M), (-_REACH_M, 0.0), (0.0, _REACH_M), (_REACH_M, 0.0)]
_LANES = LaneGraph(
    (
        LaneNode(LaneKind.CROSSROADS, (0.0, 0.0), (6.0, 6.0), "middle"),
        *(LaneNode(LaneKind.CROSSROADS, arm, (6.0, 6.0), f"arm {number}") for number, arm in enumerate(_ARMS)),
    ),
    tuple(LaneEdge(0, number, 6.0, one_way=False) for number in (1, 2, 3, 4)),
)
_RASTER = Raster(np.array([[[-60.0, -60.0], [60.0, 60.0]]]))
_AHEAD = (Piece(Gear.FORWARD, 2 * _REACH_M - 6.0),)
_LEFT_TURN = (
    Piece(Gear.FORWARD, _REACH_M - 5.0),
    Piece(Gear.FORWARD, 3.0, 0.0, 1 / 6),
    Piece(Gear.FORWARD, 6 * (math.pi / 2 - 0.5), 1 / 6, 1 / 6),
    Piece(Gear.FORWARD, 3.0, 1 / 6, 0.0),
    Piece(Gear.FORWARD, 20.0),
)


def _trip(quarter, *, keeps_left=False, ahead_m=0.0, pieces=_AHEAD):
    """A trip over the crossing whose heading is some quarters of a turn left of -Z."""
    yaw = quarter * math.pi / 2
    aside = -_ASIDE_M if keeps_left else _ASIDE_M
    back = _REACH_M - 3.0 - ahead_m
    x = math.sin(yaw) * back + math.cos(yaw) * aside
    z = math.cos(yaw) * back - math.sin(yaw) * aside
    path = Path(Pose(x, z, yaw), pieces)
    return Trip(
        path,
        [FloorSpan(math.inf, 0.0, ())],
        [Stretch(path.length_m, 0, 0)],
        car=DesignCar(),
        settings=_SETTINGS,
        raster=_RASTER,
        lanes=[_LANES],
        keeps_left=keeps_left,
    )


def _order(trips):
    """The cars in the order in which they pass the middle of the crossing, and how long each stood."""
    cars = Simulation(Ground(_RASTER), _SETTINGS)
    drivers = [cars.try_start(number, trip) for number, trip in enumerate(trips, 1)]
    assert all(drivers)
    for _ in range(900):
        cars.advance(cars.leave_ground)
    passed = [next(step for step, way_m, *_ in driver.samples if way_m > _REACH_M) for driver in drivers]
    assert all(driver.is_done for driver in drivers)
    return [int(number) for number in np.argsort(passed)]


@pytest.mark.parametrize("quarter", range(4))
@pytest.mark.parametrize("is_first", [True, False], ids=["first", "second"])
def test_right_before_left(quarter, is_first):
    car, from_right = _trip(quarter), _trip(quarter + 1)
    assert _order([car, from_right] if is_first else [from_right, car]) == ([1, 0] if is_first else [0, 1])


@pytest.mark.parametrize("sides", [(0, 1), (1, 0)])
@pytest.mark.parametrize("nearer", [0, 1])
def test_where_traffic_keeps_left_who_comes_first_goes_first(sides, nearer):
    trips = [
        _trip(side, keeps_left=True, ahead_m=1.0 if number == nearer else 0.0) for number, side in enumerate(sides)
    ]
    assert _order(trips) == [nearer, 1 - nearer]


@pytest.mark.parametrize("is_first", [True, False], ids=["first", "second"])
def test_who_turns_left_lets_oncoming_cars_pass(is_first):
    turning, oncoming = _trip(0, pieces=_LEFT_TURN), _trip(2)
    assert _order([turning, oncoming] if is_first else [oncoming, turning]) == ([1, 0] if is_first else [0, 1])


def test_four_cars_at_once_all_pass():
    assert sorted(_order([_trip(quarter) for quarter in range(4)])) == [0, 1, 2, 3]


def test_cars_head_on_in_one_lane_are_not_both_let_in():
    cars = Simulation(Ground(_RASTER), _SETTINGS)
    ahead, against = _trip(0), _trip(2, keeps_left=True)
    assert cars.try_start(1, ahead) is not None
    assert cars.try_start(2, against) is None
    for _ in range(900):
        cars.advance(cars.leave_ground)
    assert cars.drivers == []
    assert cars.try_start(2, against) is not None


def test_a_car_that_waits_for_people_claims_their_ground_until_it_drives_on():
    ground = Ground(_RASTER)
    cars = Simulation(ground, _SETTINGS)
    driver = cars.try_start(1, _trip(0))
    blocked = driver.trip.cells[60]
    ground.people[blocked] += 1
    for _ in range(300):
        cars.advance(cars.leave_ground)
    assert driver.speed_m_s == 0.0
    assert ground.claims[blocked].any()
    ground.people[blocked] -= 1
    for _ in range(600):
        cars.advance(cars.leave_ground)
    assert driver.is_done
    assert not ground.claims.any()
