"""Encounters and times to collision, against known cases and against bodies that are moved step by step."""

import math

import numpy as np
import pytest
import shapely
from support.hand_made_tracks import car, person, track_of, tracks_of

from garage2usd.driving.tracks import AgentState
from garage2usd.traffic.encounters import encounters, times_to_collision

TIMES = np.round(np.arange(0.0, 20.05, 0.1), 6)


def moving(agent, start, velocity, yaw, **more):
    x, z = (begin + rate * TIMES for begin, rate in zip(start, velocity, strict=True))
    return track_of(agent, TIMES, x_m=x, z_m=z, yaw_rad=yaw, **more)


def test_a_car_that_follows_another_meets_it_after_the_gap_by_the_difference_of_speeds():
    agent = car("car_000")
    ahead = moving(car("car_001"), (0, -20 - agent.length_m), (0, -1.0), 0.0)
    behind = moving(agent, (0, 0), (0, -2.0), 0.0)
    found = encounters(tracks_of(behind, ahead))
    # the gap is 20 m at first and closes by a metre a second; the last of all times is 20 s
    assert found.least_ttc_s == pytest.approx(0.0, abs=0.21)
    assert found.encounters == 1
    early = encounters(tracks_of(*(each.sampled(TIMES[:101]) for each in (behind, ahead))))
    assert early.least_ttc_s == pytest.approx(10.0, abs=0.02)
    assert early.encounters == 0
    assert early.waits == 0


def test_cars_that_pass_side_by_side_meet_without_a_collision():
    agent = car("car_000")
    found = encounters(
        tracks_of(
            moving(agent, (0, 0), (0, -2.0), 0.0),
            moving(car("car_001"), (agent.width_m + 1.0, -40), (0, 2.0), math.pi),
        )
    )
    assert found.encounters == 1
    assert found.least_ttc_s == math.inf


def test_parked_cars_people_among_themselves_and_other_floors_do_not_count():
    standing = track_of(car("car_001"), TIMES, x_m=0, z_m=-10, state=AgentState.PARKED)
    below = moving(car("car_002"), (0, -20), (0, 1.0), math.pi, y_m=-3.0)
    walkers = [moving(person(f"person_{n}"), (5 + n, 0), (0, -1.0), 0.0) for n in range(2)]
    found = encounters(tracks_of(moving(car("car_000"), (0, 0), (0, -0.5), 0.0), standing, below, *walkers[:0]))
    assert (found.encounters, found.least_ttc_s) == (0, math.inf)
    assert encounters(tracks_of(*walkers)).encounters == 0


def test_waits_of_a_second_or_more_are_counted():
    state = np.full(len(TIMES), AgentState.DRIVES, np.int8)
    state[20:70], state[100:105], state[150:170] = (AgentState.WAITS,) * 3
    found = encounters(tracks_of(track_of(car("car_000"), TIMES, z_m=-TIMES, state=state)))
    assert found.waits == 2
    assert found.longest_wait_s == pytest.approx(5.0)


def test_times_to_collision_are_those_of_bodies_moved_step_by_step():
    draw = np.random.default_rng(5)
    step_s, met = 0.01, 0
    for _ in range(60):
        yaws, sizes = draw.uniform(-np.pi, np.pi, 2), draw.uniform(0.4, 5.0, (2, 2))
        places, speeds = draw.uniform(-12, 12, (2, 2)), draw.uniform(-3, 3, (2, 2))
        axes = [np.array([(-np.sin(yaw), -np.cos(yaw)), (np.cos(yaw), -np.sin(yaw))]) for yaw in yaws]
        every = np.concatenate(axes)
        reach = sum(np.abs(every @ own.T) @ (size / 2) for own, size in zip(axes, sizes, strict=True))
        away, closing = every @ (places[1] - places[0]), every @ (speeds[1] - speeds[0])
        (found,) = times_to_collision(reach[None], away[None], closing[None])
        shapes = [
            shapely.Polygon(place + np.array([(1, 1), (1, -1), (-1, -1), (-1, 1)]) * size / 2 @ own)
            for own, size, place in zip(axes, sizes, places, strict=True)
        ]
        times = np.arange(0.0, 20.0, step_s)
        moved = shapely.transform(np.repeat(np.array(shapes[1:], object), len(times)), lambda points: points)
        shifts = np.repeat((speeds[1] - speeds[0]) * times[:, None], 5, axis=0)
        moved = shapely.set_coordinates(moved, shapely.get_coordinates(moved) + shifts)
        touching = np.flatnonzero(shapely.intersects(shapes[0], moved))
        expected = times[touching[0]] if len(touching) else math.inf
        assert (found == pytest.approx(expected, abs=2 * step_s)) or (expected == math.inf and found > 19.9)
        met += len(touching) > 0
    assert 10 < met < 55
