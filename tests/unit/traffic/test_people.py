"""People of cars: parties, children who run, trolleys; judged by outlines at 20 Hz that share no code with them."""

from collections import Counter
from itertools import pairwise

import numpy as np
import pytest
import shapely
from support.tracks_judge import judge

from garage2usd import GarageConfig, generate
from garage2usd.common.errors import ConfigError
from garage2usd.common.settings import validated
from garage2usd.config.traffic import TrafficConfig
from garage2usd.driving.tracks import AgentClass, AgentState
from garage2usd.garage_sources import built_source
from garage2usd.traffic import Operation

_MINUTES = 6


@pytest.fixture(scope="module")
def operation():
    made = generate(GarageConfig(seed=3, site={"width_cells": 7, "height_cells": 6}))
    return Operation(built_source(made, source="a garage").garage)


@pytest.fixture(scope="module")
def tracks(operation):
    settings = TrafficConfig(
        minutes=_MINUTES,
        arrivals_per_hour=120,
        people_in_car=(0.2, 0.4, 0.2, 0.2),
        running_children=1.0,
        trolleys=1.0,
        loose_trolleys=0.6,
    )
    return operation.run(settings, seed=2)


def _of(tracks, kind):
    return [track for track in tracks if track.agent.kind is kind]


def test_people_and_trolleys_touch_nothing(operation, tracks):
    own = list(tracks.facts["cars_of_people"].items())
    verdict = judge(tracks, operation.garage, own=own)
    walking = ("person", "trolley")
    assert [str(touch) for touch in verdict.overlaps if any(kind in touch.kind for kind in walking)] == []
    # the own car may be as close as a door asks for, also one that has not moved yet
    near = [
        touch for touch in verdict.close if touch.kind == "car-person" and "/Car_" not in f"{touch.one}{touch.other}"
    ]
    assert [str(touch) for touch in near] == []
    assert verdict.faults == []


def test_the_people_of_a_car_walk_together(tracks):
    people = {track.agent.name: track for track in _of(tracks, AgentClass.PERSON)}
    parties = {}
    for name, car in tracks.facts["cars_of_people"].items():
        if name in people and people[name].time_s[0] < 60 * (_MINUTES - 3):
            parties.setdefault(car, []).append(people[name])
    assert {len(party) for party in parties.values()} >= {1, 2, 4}
    apart = []
    for party in parties.values():
        adults = [track for track in party if not track.agent.behaviour]
        fastest = [track.speed_m_s.max() for track in adults if len(track) > 200]
        assert np.ptp(fastest or [0.0]) < 0.01, [track.agent.name for track in adults]
        for one, other in pairwise(adults):
            times = np.intersect1d(one.time_s, other.time_s)
            both = one.at(times), other.at(times)
            apart += np.hypot(both[0][:, 0] - both[1][:, 0], both[0][:, 2] - both[1][:, 2]).tolist()
    assert np.median(apart) < 5.0


def test_children_run_across_the_aisle(tracks):
    children = [track for track in _of(tracks, AgentClass.PERSON) if track.agent.behaviour == "runs"]
    assert len(children) >= 3
    fast = []
    for track in children:
        assert track.agent.height_m <= 1.3
        assert track.agent.width_m < 0.4
        assert track.speed_m_s.max() <= 3.0
        runs = np.flatnonzero(track.speed_m_s > 1.9)
        if len(runs):
            way = np.hypot(np.ptp(track.x_m[runs]), np.ptp(track.z_m[runs]))
            fast.append(way)
    assert max(fast) > 3.0, "no child runs over an aisle"
    usual = [track for track in _of(tracks, AgentClass.PERSON) if not track.agent.behaviour]
    assert max(track.speed_m_s.max() for track in usual) <= 1.81


def test_trolleys_are_pushed_or_roll_away(tracks):
    people = {track.agent.name: track for track in _of(tracks, AgentClass.PERSON)}
    trolleys = _of(tracks, AgentClass.TROLLEY)
    found = Counter(track.agent.behaviour for track in trolleys)
    assert set(found) == {"pushed", "rolls_away"}
    rolled = 0
    for track in trolleys:
        person = people[track.agent.name.replace("trolley", "person")]
        at = person.at(track.time_s)
        away = np.hypot(at[:, 0] - track.x_m, at[:, 2] - track.z_m)
        assert away.min() > 0.5, f"{track.agent.name} is in its person"
        if track.agent.behaviour == "pushed":
            assert away.max() < 0.96, f"{track.agent.name} is out of reach"
        # it rolls while its person stands
        state = person.state[np.searchsorted(person.time_s, track.time_s - 1e-6)]
        rolled += bool(((np.abs(track.speed_m_s) > 0.2) & (state == AgentState.STANDS)).any())
    assert rolled


def test_nobody_gets_stuck(tracks):
    assert [line for line in tracks.log if line.startswith("person")] == []


def test_shares_that_are_no_shares_are_refused():
    with pytest.raises(ConfigError, match=r"traffic.people_in_car: got .*four shares"):
        validated(TrafficConfig, {"people_in_car": (0.5, 0.5, 0.5, 0.0)}, within="traffic")
    with pytest.raises(ConfigError, match=r"traffic.trolleys: got 2"):
        validated(TrafficConfig, {"trolleys": 2}, within="traffic")


def test_nobody_walks_onto_ground_that_a_waiting_car_claims(operation):
    ground = operation.new_ground()
    people = operation.walkers.begin(ground, TrafficConfig(running_children=0.0), np.random.default_rng(1))
    stall = operation.stalls[0]
    corners = np.array(stall.corners)
    car = stall.level, shapely.Polygon(corners.mean(axis=0) + 0.7 * (corners - corners.mean(axis=0)))
    people.to_car(1, stall, car, {})
    ground.claims += 1
    for step in range(600):
        people.advance(step)
    assert not ground.people.any()
    ground.claims -= 1
    for step in range(600, 3000):
        people.advance(step)
    assert people.has_arrived(1)
