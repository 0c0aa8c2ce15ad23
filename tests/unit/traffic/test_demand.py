"""Demand: arrivals follow the occupancy by hour, and stays are log-normal."""

import math

import numpy as np
import pytest

from garage2usd.config.traffic import Day, TrafficConfig
from garage2usd.traffic.demand import drawn_demand

_CAPACITY = 300


def _present(demand, hours):
    """Number of cars in the garage at some times in hours since the start."""
    leave = np.array([*demand.leave_s, *(time + stay for time, stay in demand.arrivals)])
    come = np.array([*(0.0 for _ in demand.leave_s), *(time for time, _ in demand.arrivals)])
    return np.array([((come <= 3600 * hour) & (leave > 3600 * hour)).sum() for hour in hours])


@pytest.mark.parametrize("day", Day)
def test_occupancy_follows_the_curve_over_days(day):
    settings = TrafficConfig(minutes=1440, hour=2.0, day=day)
    parked = round(settings.occupancy(2.0) * _CAPACITY)
    hours = np.arange(2.0, 24.0, 2.0)
    days = [
        _present(drawn_demand(settings, parked, _CAPACITY, np.random.default_rng(seed)), hours) for seed in range(20)
    ]
    wanted = np.array([settings.occupancy(2.0 + hour) for hour in hours])
    assert np.abs(np.mean(days, axis=0) / _CAPACITY - wanted).max() <= 0.05


def test_arrivals_per_hour_are_those_asked_for():
    settings = TrafficConfig(minutes=60, arrivals_per_hour=90.0)
    counts = [len(drawn_demand(settings, 200, _CAPACITY, np.random.default_rng(seed)).arrivals) for seed in range(60)]
    # the mean of 60 draws of a Poisson process of 90 has a standard deviation of 1.2
    assert abs(np.mean(counts) - 90) < 5


def test_as_many_leave_as_come_where_arrivals_are_asked_for():
    settings = TrafficConfig(minutes=25, arrivals_per_hour=150.0)
    came, left = [], []
    for seed in range(60):
        demand = drawn_demand(settings, 90, 165, np.random.default_rng(seed))
        stays = [time + stay for time, stay in demand.arrivals]
        came.append(len(stays))
        left.append(sum(np.array([*demand.leave_s, *stays]) < 1500))
    # both are 62.5 on average, with a standard deviation of the mean of about 1
    assert abs(np.mean(came) - 62.5) < 4
    assert abs(np.mean(left) - np.mean(came)) < 5


def test_cars_that_stay_count_as_present():
    settings = TrafficConfig(minutes=600, hour=8.0)
    hours = np.array([8.0])
    draws = [drawn_demand(settings, 60, 300, np.random.default_rng(seed), staying=90) for seed in range(20)]
    present = 90 + np.mean([_present(demand, hours) for demand in draws])
    assert abs(present / 300 - settings.occupancy(16.0)) <= 0.05


def test_stays_are_log_normal():
    settings = TrafficConfig(minutes=1440, stay_minutes=50.0, stay_spread=0.6)
    stays = [stay for _, stay in drawn_demand(settings, 0, 2000, np.random.default_rng(1)).arrivals]
    logs = np.log(stays)
    assert len(stays) > 2000
    assert math.exp(np.median(logs)) / 60 == pytest.approx(50.0, rel=0.05)
    assert logs.std() == pytest.approx(0.6, rel=0.05)


def test_the_rest_of_a_stay_found_is_that_of_a_renewal_process():
    """Half of the mean square of stays over their mean: the mean rest of the interval in which an observer arrives."""
    settings = TrafficConfig(minutes=1440, stay_minutes=10.0, stay_spread=0.5)
    rests = np.array(drawn_demand(settings, 10_000, 10_000, np.random.default_rng(2)).leave_s) / 60
    rests = rests[np.isfinite(rests)]
    assert rests.mean() == pytest.approx(10.0 * math.exp(1.5 * 0.5**2) / 2, rel=0.05)
