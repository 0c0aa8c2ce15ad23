"""A garage in operation, judged by outlines at 20 Hz that share no code with the simulation."""

import numpy as np
import pytest
from support.tracks_judge import judge

from garage2usd import GarageConfig, generate
from garage2usd.common.errors import ConfigError
from garage2usd.config.traffic import TrafficConfig
from garage2usd.driving.tracks import AgentClass, AgentState
from garage2usd.garage_sources import built_source
from garage2usd.traffic import Operation

_TOUCHES = {"car-car", "car-person", "car-building", "person-building"}
_LIMITS = {"car": {"speed": 4.3, "acceleration": 3.5, "yaw_rate": 1.0}, "person": {"speed": 1.9}}
"""15 km/h and some rounding; AASHTO's comfortable deceleration of 3.4 m/s2."""
_BUSY = TrafficConfig(minutes=8, arrivals_per_hour=110)


@pytest.fixture(scope="module")
def garage():
    made = generate(GarageConfig(seed=3, site={"width_cells": 9, "height_cells": 7}))
    return built_source(made, source="a garage").garage


@pytest.fixture(scope="module")
def tracks(garage):
    return Operation(garage).run(_BUSY, seed=1)


def test_no_two_touch_and_nobody_touches_the_building(garage, tracks):
    own = [(person, car) for person, car in tracks.facts["cars_of_people"].items()]
    verdict = judge(tracks, garage, own=own)
    assert [str(touch) for touch in verdict.overlaps if touch.kind in _TOUCHES] == []
    assert [str(touch) for touch in verdict.close if touch.kind in {"car-car", "car-building"}] == []
    assert verdict.beyond(_LIMITS) == []
    assert verdict.faults == []


def test_cars_arrive_park_and_leave(tracks):
    assert tracks.facts["arrivals"] >= 8
    assert tracks.facts["departures"] >= 4
    assert tracks.facts["walks"] >= 10
    cars = [track for track in tracks if track.agent.kind is not AgentClass.PERSON]
    arrived = [track for track in cars if not track.agent.prim]
    assert len(arrived) == tracks.facts["arrivals"]
    parked = [track for track in arrived if track.state[-1] == AgentState.PARKED]
    assert parked
    for track in parked:
        assert track.time_s[-1] == tracks.duration_s, f"{track.agent.name} is gone while it is parked"


def test_cars_stand_parked_within_their_stalls(garage, tracks):
    import shapely

    stalls = {stall.name: shapely.Polygon(stall.corners) for stall in garage.stalls}
    for track in tracks:
        if track.agent.kind is AgentClass.PERSON or track.state[-1] != AgentState.PARKED:
            continue
        name = track.stall[-1][2]
        assert stalls[name].contains(shapely.Point(track.x_m[-1], track.z_m[-1])), track.agent.name


def test_no_stall_holds_two_cars(tracks):
    parked = [
        track.stall[-1][2]
        for track in tracks
        if track.agent.kind is not AgentClass.PERSON and track.state[-1] == AgentState.PARKED
    ]
    assert len(parked) == len(set(parked))


def test_the_same_seed_gives_the_same_tracks(garage, tracks):
    again = Operation(garage).run(_BUSY, seed=1)
    assert again.facts == tracks.facts
    assert [track.agent for track in again] == [track.agent for track in tracks]
    for one, other in zip(again, tracks, strict=True):
        for name in ("time_s", "x_m", "z_m", "yaw_rad", "speed_m_s", "state"):
            assert np.array_equal(getattr(one, name), getattr(other, name)), name


def test_a_garage_whose_stalls_no_lane_joins_is_refused(garage):
    from dataclasses import replace

    from garage2usd.garage import LaneGraph

    bare = replace(garage, lanes=LaneGraph(garage.lanes.nodes, ()))
    with pytest.raises(ConfigError, match="a stall that lanes join with the street"):
        Operation(bare)
