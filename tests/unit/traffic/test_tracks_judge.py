"""The judge of tracks finds what is wrong with them, and nothing where nothing is."""

from dataclasses import replace

import numpy as np
import pytest
from support.hand_made_tracks import car, hand_made, staged, track_of, tracks_of, walker
from support.small_levels import SMALL_LEVELS
from support.tracks_judge import judge

import garage2usd
from garage2usd.as_built.garage import garage_as_made


@pytest.fixture(scope="module")
def garage():
    return garage_as_made(garage2usd.generate(SMALL_LEVELS), source="garage", kind="plan")


@pytest.fixture(scope="module")
def whole(garage):
    return hand_made(garage)


@pytest.fixture(scope="module")
def alone(garage, whole):
    """The judgement of the car that drives over the ramp to the lower level, parks and leaves, alone."""
    return judge(tracks_of(next(track for track in whole if track.agent.name == "car_001")), garage)


def test_a_proven_drive_over_two_levels_touches_nothing(alone):
    assert not alone.overlaps
    assert not alone.faults
    assert 0 < alone.least_m["car-building"][0] < 0.5  # into a stall beside a wall
    assert alone.extremes["car"]["slip"][0] < 5e-3
    assert 2.0 < alone.extremes["car"]["speed"][0] < 3.0


def test_two_cars_that_meet_in_one_lane_overlap(garage, whole):
    one, other = (track for track in whole if track.agent.name in {"car_000", "car_001"})
    times = np.arange(max(one.time_s[0], other.time_s[0]), min(one.time_s[-1], other.time_s[-1]), 0.05)
    away = other.at(times) - one.at(times)
    assert not [touch for touch in judge(whole, garage).overlaps if touch.kind == "car-car"]
    # where they are nearest, one is moved into the way of the other
    nearest = int(np.hypot(away[:, 0], away[:, 2]).argmin())
    beside = replace(one, x_m=one.x_m + away[nearest, 0], z_m=one.z_m + away[nearest, 2])
    found = judge(tracks_of(beside, other), garage)
    touches = [touch for touch in found.overlaps if (touch.one, touch.other) == ("car_000", "car_001")]
    assert any(touch.from_s <= times[nearest] <= touch.to_s for touch in touches)
    assert found.meetings >= 1


@pytest.mark.parametrize("aside_m", [0.5, 1.0])
def test_a_drive_beside_its_way_touches_the_building(garage, whole, aside_m):
    (track,) = (track for track in whole if track.agent.name == "car_001")
    beside = judge(tracks_of(replace(track, x_m=track.x_m + aside_m)), garage)
    assert {touch.kind for touch in beside.overlaps} >= {"car-building"}
    assert any("Ramp" in touch.other or "Wall" in touch.other or "Column" in touch.other for touch in beside.overlaps)


def test_a_car_of_the_stage_is_one_car_once_it_moves(garage):
    own = staged(garage)
    assert not judge(tracks_of(own), garage).overlaps
    # the same car without its prim stands in itself
    stranger = replace(own, agent=replace(own.agent, prim=""))
    (touch,) = judge(tracks_of(stranger), garage).overlaps
    assert (touch.kind, touch.other) == ("car-car", own.agent.prim)
    assert touch.area_m2 > 5.0


def test_a_car_of_the_stage_stands_there_before_its_track(garage):
    own = staged(garage)
    later = replace(own, time_s=own.time_s + 100.0)
    x, z = float(own.x_m[0]), float(own.z_m[0])
    through = walker("person_000", (x, z), (x + 1.0, z), begins_s=20.0)
    assert {touch.kind for touch in judge(tracks_of(later, through), garage).overlaps} == {"car-person"}


def test_people_touch_cars_and_people_and_own_cars_may_be_near():
    empty = garage2usd.as_built.BuiltGarage("", None, (), ())
    stands = track_of(car("car_000"), [0.0, 10.0], state=3)
    half = stands.agent.width_m / 2 + 0.3
    beside = walker("person_000", (half + 0.02, 4.0), (half + 0.02, -4.0))
    found = judge(tracks_of(stands, beside), empty)
    assert not found.overlaps
    assert [touch.kind for touch in found.close] == ["car-person"]
    assert found.close[0].least_m == pytest.approx(0.02, abs=1e-6)
    assert not judge(tracks_of(stands, beside), empty, own=[("car_000", "person_000")]).close
    across = walker("person_001", (half - 0.1, 4.0), (half - 0.1, -4.0), begins_s=0.5)
    kinds = sorted(touch.kind for touch in judge(tracks_of(stands, beside, across), empty).overlaps)
    assert kinds == ["car-person", "person-person"]
    # on another level they are far
    assert not judge(tracks_of(stands, walker("person_000", (0, 4), (0, -4), y_m=-3.6)), empty).overlaps


def test_jumps_and_bad_times_are_faults(garage, whole):
    track = whole.tracks[0]
    jumped = replace(track, x_m=track.x_m + np.where(np.arange(len(track)) > 50, 1.0, 0.0))
    speeds = judge(tracks_of(jumped), garage).extremes["car"]
    assert speeds["speed"][0] > 9.0
    late = replace(track, time_s=track.time_s + 0.03)
    assert judge(tracks_of(late), garage).faults == ["car_000: times are no steps within the tracks"]
    limits = {"car": {"speed": 8.4}}
    assert judge(tracks_of(jumped), garage).beyond(limits) == [
        f"car: speed {speeds['speed'][0]:.3f} of car_000 at {speeds['speed'][2]:.2f} s, limit 8.4"
    ]
    assert not judge(tracks_of(track), garage).beyond(limits)
