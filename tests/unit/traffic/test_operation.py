"""A garage in operation, judged by outlines at 20 Hz that share no code with the simulation."""

import math

import numpy as np
import pytest
import shapely
from support.tracks_judge import judge

from garage2usd import GarageConfig, generate
from garage2usd.common.errors import ConfigError
from garage2usd.config.outputs import Leg
from garage2usd.config.traffic import TrafficConfig
from garage2usd.driving.tracks import AgentClass, AgentState
from garage2usd.garage import StallUse
from garage2usd.garage_sources import built_source
from garage2usd.traffic import Operation

_TOUCHES = {"car-car", "car-person", "car-building", "person-building"}
_LIMITS = {
    "car": {"speed": 4.3, "acceleration": 3.5, "acceleration_across": 3.0, "yaw_rate": 0.82, "slip": 0.01},
    "person": {"speed": 1.9},
}
"""The table of docs/traffic.md."""
_BUSY = TrafficConfig(minutes=8, arrivals_per_hour=110)


@pytest.fixture(scope="module")
def garage():
    made = generate(GarageConfig(seed=3, site={"width_cells": 9, "height_cells": 7}))
    return built_source(made, source="a garage").garage


@pytest.fixture(scope="module")
def operation(garage):
    return Operation(garage)


@pytest.fixture(scope="module")
def tracks(operation):
    return operation.run(_BUSY, seed=1)


@pytest.fixture(scope="module")
def special(operation):
    """Half of the cars double-park or wait for a stall, and some have a permit."""
    shares = {"permits": 0.2, "waits_for_stall": 0.5, "double_parks": 0.5, "people": False}
    return operation.run(_BUSY.model_copy(update=shares), seed=2)


@pytest.mark.parametrize("run", ["tracks", "special"])
def test_no_two_touch_and_nobody_touches_the_building(garage, run, request):
    tracks = request.getfixturevalue(run)
    own = [(person, car) for person, car in tracks.facts["cars_of_people"].items()]
    verdict = judge(tracks, garage, own=own)
    assert [str(touch) for touch in verdict.overlaps if touch.kind in _TOUCHES] == []
    # a parked car of the stage may be closer to a charger, from the start until it leaves
    driven = [touch for touch in verdict.close if touch.at_s > 0]
    assert [str(touch) for touch in driven if touch.kind in {"car-car", "car-building"}] == []
    assert verdict.beyond(_LIMITS) == []
    assert verdict.faults == []


def test_cars_speed_up_no_faster_than_passengers_accept(tracks):
    cars = [track for track in tracks if track.agent.kind is not AgentClass.PERSON]
    gains = [(np.diff(np.abs(track.speed_m_s)) / np.diff(track.time_s)).max(initial=0.0) for track in cars]
    assert 1.0 < max(gains) <= 1.47


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


def test_nobody_parks_in_a_stall_that_cones_close():
    fittings = {"cone_rate": 0.15}
    made = generate(GarageConfig(seed=3, site={"width_cells": 9, "height_cells": 7}, fittings=fittings))
    garage = built_source(made, source="a garage").garage
    operation = Operation(garage)
    (level,) = garage.levels
    feet = [piece for _, label, pieces in level.solids.grounds(2.0) if label == "traffic_cone" for piece in pieces]
    within = [shapely.box(*shapely.Polygon(stall.corners).buffer(-0.3).bounds) for stall in operation.stalls]
    closed = [
        stall
        for stall, ground in zip(operation.stalls, within, strict=True)
        if any(ground.contains(foot.centroid) for foot in feet)
    ]
    assert closed
    assert [stall.name for stall in closed if operation.trip(stall, Leg.IN) is not None] == []


def test_special_cases_are_labelled_and_do_what_they_say(garage, special):
    of_kind = {name: [] for name in ("permit", "waits_for_stall", "double_parks")}
    for track in special:
        if track.agent.behaviour:
            of_kind[track.agent.behaviour].append(track)
    accessible = {stall.name for stall in garage.stalls if stall.use is StallUse.ACCESSIBLE}
    assert of_kind["double_parks"]
    for track in of_kind["permit"]:
        assert all(name in accessible for *_, name in track.stall)
    halts = [_longest_wait_s(track) for track in of_kind["double_parks"] if AgentState.PARKED in track.state]
    assert min(halts) >= 40
    left = {name: track.time_s[first] for track in special if track.agent.prim for first, _, name in track.stall}
    came = [track for track in of_kind["waits_for_stall"] if track.stall]
    for track in came:
        first, _, name = track.stall[0]
        assert track.time_s[first] > left.get(name, math.inf), f"{track.agent.name} waits for a car to leave {name}"


def _longest_wait_s(track):
    edges = np.flatnonzero(np.diff(track.state == AgentState.WAITS, prepend=False, append=False)).reshape(-1, 2)
    return max((track.time_s[min(past, len(track) - 1)] - track.time_s[first] for first, past in edges), default=0.0)


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


@pytest.mark.soak
def test_some_drive_against_one_way_aisles():
    plan = {"aisles": "one-way"}
    made = generate(GarageConfig(seed=3, site={"width_cells": 10, "height_cells": 8}, plan=plan))
    garage = built_source(made, source="a garage").garage
    settings = TrafficConfig(minutes=8, arrivals_per_hour=110, wrong_way=1.0)
    tracks = Operation(garage).run(settings, seed=1)
    errant = [track for track in tracks if track.agent.behaviour == "wrong_way"]
    assert errant
    nodes = garage.lanes.positions_m
    for track in errant:
        steps = np.stack([np.diff(track.x_m), np.diff(track.z_m)], axis=1)
        middles = np.stack([track.x_m, track.z_m], axis=1)[:-1] + steps / 2
        against_m = 0.0
        for edge in garage.lanes.edges:
            along = nodes[edge.end] - nodes[edge.start]
            length_m = float(np.hypot(*along))
            away = middles - nodes[edge.start]
            run, aside = away @ along / length_m, (away[:, 0] * along[1] - away[:, 1] * along[0]) / length_m
            on = edge.one_way & (run >= 0) & (run <= length_m) & (np.abs(aside) < edge.width_m / 2)
            against_m += float(
                -(steps[on & (track.state[:-1] == AgentState.DRIVES)] @ along / length_m).clip(max=0).sum()
            )
        assert against_m > 4.0, track.agent.name
    verdict = judge(tracks, garage, own=list(tracks.facts["cars_of_people"].items()))
    assert [str(touch) for touch in verdict.overlaps if touch.kind in {"car-car", "car-building"}] == []
