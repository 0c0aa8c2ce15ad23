"""Whole trajectories, judged from their rows and the stage's meshes by computations of the tests' own."""

import json
import math
from itertools import pairwise

import numpy as np
import pytest
import shapely
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from support.driving_simulation import outlines
from support.sample_files import each_small_sample
from support.trajectory_judge import OpenWorld, faults

import garage2usd
from garage2usd.as_built.driven_road import driven_road
from garage2usd.as_built.garage import garage_as_made
from garage2usd.common.errors import ConfigError
from garage2usd.config.outputs import DriveConfig, Leg
from garage2usd.driving import DesignCar, Gear, Pose
from garage2usd.driving.path import Path, Piece
from garage2usd.driving.timing import timed
from garage2usd.driving.trajectory import write_trajectory_csv, write_trajectory_json
from garage2usd.driving.turns import NODES, Steering, _write_straight, joining_pieces
from garage2usd.maps.drives import DrivePlanner

DEFAULTS = DriveConfig().model_dump()
BRISK = DriveConfig(
    lane_speed_m_s=4.0,
    parking_speed_m_s=1.5,
    acceleration_m_s2=2.0,
    lateral_acceleration_m_s2=2.5,
    steering_rate_rad_s=0.4,
    shift_s=0.3,
    parked_s=2.0,
)


def subject_of(garage):
    return garage_as_made(garage, source="garage", kind="plan")


def rows_of(motion, tmp_path):
    """The rows of the file that is written."""
    file = tmp_path / "trajectory.csv"
    write_trajectory_csv(file, motion.sampled(0.05))
    names = file.read_text().partition("\n")[0].split(",")
    return dict(zip(names, np.loadtxt(file, delimiter=",", skiprows=1, unpack=True), strict=True))


def at(rows, number):
    return Pose(*(float(rows[name][number]) for name in ("x_m", "z_m", "yaw_rad")))


def stands_as(pose, stall):
    """Whether a car stands in the middle of a stall or up to 0.3 m further out, to 1 cm and 0.5 degrees."""
    askew = math.remainder(pose.yaw_rad - stall.yaw_rad, math.pi)
    body = outlines((pose.x_m, pose.z_m, pose.yaw_rad))[0].centroid
    middle = shapely.Polygon(stall.corners_m()).centroid
    away = np.array([body.x - middle.x, body.y - middle.y])
    out = np.array([math.sin(stall.yaw_rad), math.cos(stall.yaw_rad)])
    beside = abs(away @ [out[1], -out[0]])
    return abs(askew) < math.radians(0.5) and beside < 0.01 and -0.01 < away @ out < 0.31


def longest_stand(rows):
    """Numbers of the first and the last row of the longest standstill."""
    stands = np.concatenate([[False], np.diff(rows["arc_m"]) == 0, [False]])
    starts = np.flatnonzero(~stands[:-1] & stands[1:])
    ends = np.flatnonzero(stands[:-1] & ~stands[1:])
    longest = np.argmax(rows["time_s"][ends] - rows["time_s"][starts])
    return starts[longest], ends[longest]


@each_small_sample
def test_every_ninth_stall_is_driven_into_and_out_of_within_the_settings_without_a_touch(sample, builds, tmp_path):
    garage = builds(sample, "usdc").garage
    planner, world = DrivePlanner(subject_of(garage)), OpenWorld(garage)
    inside = shapely.union_all([shapely.Polygon(stall.corners_m()) for stall in garage.layout.stalls]).union(world.road)
    stalls = [stall for stall in garage.layout.stalls if stall.use.takes_cars]
    has_ramps = {ramp.name.replace("Ramp", "Portal") for ramp in garage.layout.of_kind("ramp")}
    for stall in stalls[:: max(9, len(stalls) // 40)]:
        drive = planner.drive(stall.name)
        rows = rows_of(drive.motion, tmp_path)
        assert faults(rows, DEFAULTS) == [], stall.name
        if drive.route.is_full:
            assert world.swept(rows, stall) == set(), stall.name
        start, end = longest_stand(rows)
        assert rows["time_s"][end] - rows["time_s"][start] >= DEFAULTS["parked_s"] - 1e-6
        assert stands_as(at(rows, start), stall), stall.name
        for number in (0, -1):
            pose = at(rows, number)
            outside = not outlines((pose.x_m, pose.z_m, pose.yaw_rad))[0].intersects(inside)
            assert outside == bool(has_ramps), stall.name
            assert rows["speed_m_s"][number] == 0


@pytest.fixture(scope="module")
def small():
    """A garage that is drawn, so that it takes no learning."""
    drawn = "##########\nE====....#\n#..=.....X\n#..=======\n#..=.....#\n#..=.....#\n##########\n"
    return garage2usd.generate(garage2usd.GarageConfig(site={"structure": drawn}, seed=3))


@pytest.fixture(scope="module")
def planner(small):
    return DrivePlanner(subject_of(small))


def first_stall(garage):
    return next(stall for stall in garage.layout.stalls if stall.use.takes_cars)


def test_other_settings_are_kept_and_time_follows_them(small, planner, tmp_path):
    brisk = DrivePlanner(subject_of(small), BRISK)
    stall = first_stall(small)
    rows = rows_of(brisk.drive(stall.name).motion, tmp_path)
    assert faults(rows, BRISK.model_dump()) == []
    assert faults(rows, DEFAULTS) != []
    assert OpenWorld(small).swept(rows, stall) == set()
    assert rows["time_s"][-1] < rows_of(planner.drive(stall.name).motion, tmp_path)["time_s"][-1]


@pytest.mark.parametrize(
    ("column", "change", "fault"),
    [
        ("x_m", lambda values: values + 0.02 * np.sin(np.arange(len(values)) / 3), "slip"),
        ("yaw_rad", lambda values: values + np.pi, "against the gear"),
        ("yaw_rad", lambda values: -values, "slip"),
        ("z_m", lambda values: np.where(np.arange(len(values)) > 500, values + 0.3, values), "jump of pose"),
        ("time_s", lambda values: values * 0.9, "acceleration"),
        ("curvature_per_m", lambda values: -values, "curvature that is not that of the places"),
        ("steering_rad", lambda values: values * 1.1, "steering that is not the curvature's"),
        ("gear", lambda values: -values, "gear against speed"),
        ("speed_m_s", lambda values: values * 1.1, "speed"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_the_judge_sees_rows_that_are_not_as_they_should_be(planner, small, tmp_path, column, change, fault):
    rows = rows_of(planner.drive(first_stall(small).name).motion, tmp_path)
    assert any(fault in found for found in faults({**rows, column: change(rows[column])}, DEFAULTS))


def test_the_judge_sees_a_car_that_leaves_its_path(planner, small, tmp_path):
    stall = first_stall(small)
    rows = rows_of(planner.drive(stall.name).motion, tmp_path)
    world = OpenWorld(small)
    assert world.swept(rows, stall) == set()
    assert world.swept({**rows, "x_m": rows["x_m"] + 2.0}, stall)


def test_the_gate_on_the_way_opens_and_its_housing_stays_in_the_way(small):
    gates = [thing.name for thing in subject_of(small).things if thing.label == "barrier"]
    assert gates
    road = driven_road(subject_of(small).levels[0])
    as_it_stands, opened = road.garage.standing, road.standing
    arms_m, open_m = (
        max(np.ptp(standing.only(gate).pieces.reshape(-1, 2), axis=0).max() for gate in gates)
        for standing in (as_it_stands, opened)
    )
    assert arms_m > 4.0
    assert 0 < open_m < 3.0


def test_the_car_is_as_high_and_as_steep_as_the_ramp(small, planner, tmp_path):
    rows = rows_of(planner.drive(first_stall(small).name).motion, tmp_path)
    (profile,) = {ramp.spec.profile for ramp in small.layout.of_kind("ramp")}
    top = profile[-1][1]
    assert top - 0.3 < rows["y_m"][0] <= top
    assert rows["pitch_rad"][0] < 0 < rows["pitch_rad"][-1]
    steepest = max((y1 - y0) / (r1 - r0) for (r0, y0), (r1, y1) in pairwise(profile))
    assert np.tan(np.abs(rows["pitch_rad"])).max() == pytest.approx(steepest, abs=0.005)
    level = np.abs(rows["y_m"]) < 1e-9
    assert level.mean() > 0.5


def test_a_drive_has_its_legs_portals_and_number(small, planner, tmp_path):
    stall = first_stall(small)
    whole, into, out = (planner.drive(stall.name, leg=leg) for leg in (Leg.BOTH, Leg.IN, Leg.OUT))
    assert into.motion.ends_s + out.motion.ends_s + DEFAULTS["parked_s"] == pytest.approx(whole.motion.ends_s, abs=1e-6)
    assert into.facts["exit"] is None
    assert out.facts["entrance"] is None
    number = next(dict(outline.facts)["number"] for outline in subject_of(small).stalls if outline.name == stall.name)
    assert planner.drive(str(number)).route.stall == stall.name
    file = tmp_path / "trajectory.json"
    write_trajectory_json(file, into.motion.sampled(0.1), into.car, into.facts)
    said = json.loads(file.read_text())
    assert said["stall"] == stall.name
    assert said["settings"]["lane_speed_m_s"] == 2.5
    assert {len(column) for column in said["columns"].values()} == {len(said["columns"]["time_s"])}


def test_the_same_drive_has_the_same_bytes(small, tmp_path):
    texts = set()
    for name in ("one.csv", "other.csv"):
        drive = DrivePlanner(subject_of(small)).drive(first_stall(small).name)
        write_trajectory_csv(tmp_path / name, drive.motion.sampled(0.05))
        texts.add((tmp_path / name).read_bytes())
    assert len(texts) == 1


def test_what_cannot_be_driven_is_refused(small, planner):
    name = first_stall(small).name
    aisles = [stall.name for stall in small.layout.stalls if not stall.use.takes_cars]
    for asked, options, field in [
        ("nowhere", {}, "stall"),
        ("", {}, "stall"),
        *[(aisle, {}, "stall") for aisle in aisles],
        (name, {"entrance": 2}, "entrance"),
        (name, {"entrance": 0}, "entrance"),
        (name, {"exit": -1}, "exit"),
    ]:
        with pytest.raises(ConfigError) as raised:
            planner.drive(asked, **options)
        assert raised.value.field == field


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(
    away=st.tuples(st.floats(-15, 15), st.floats(-15, 15)),
    yaws=st.tuples(st.floats(-math.pi, math.pi), st.floats(-math.pi, math.pi)),
    speed=st.floats(0.3, 3.0),
)
def test_joining_paths_meet_their_end_and_never_jump_in_curvature(away, yaws, speed):
    car = DesignCar()
    steering = Steering(1 / car.rear_axle_radius_m, 0.6 / (car.wheelbase_m * speed))
    start, end = Pose(3.0, -4.0, yaws[0]), Pose(3.0 + away[0], -4.0 + away[1], yaws[1])
    lengths = []
    for pieces in joining_pieces(start, end, steering):
        path = Path(start, pieces)
        lengths.append(path.length_m)
        assert math.hypot(path.end.x_m - end.x_m, path.end.z_m - end.z_m) < 1e-5
        assert abs(math.remainder(path.end.yaw_rad - end.yaw_rad, math.tau)) < 1e-8
        curvatures = [0.0, *(value for piece in pieces for value in (piece.start_per_m, piece.end_per_m)), 0.0]
        assert all(abs(one - other) < 1e-12 for one, other in zip(curvatures[::2], curvatures[1::2], strict=True))
        assert max(map(abs, curvatures)) <= steering.curvature_per_m * (1 + 1e-12)
    assert lengths == sorted(lengths)


def test_a_path_is_that_of_a_simulated_car():
    """Runge and Kutta's method over the same curvatures: ends within a micrometre."""
    pieces = (
        Piece(Gear.FORWARD, 2.0, 0.0, 0.2),
        Piece(Gear.FORWARD, 3.0, 0.2, 0.2),
        Piece(Gear.REVERSE, 1.5, 0.2, -0.1),
        Piece(Gear.REVERSE, 2.5),
    )
    path = Path(Pose(1.0, 2.0, 0.3), pieces)
    state = np.array([1.0, 2.0, 0.3])
    for piece in pieces:
        count = 400
        step = piece.length_m / count
        for number in range(count):

            def rate(at, into, piece=piece):
                share = into / piece.length_m
                curvature = piece.start_per_m + share * (piece.end_per_m - piece.start_per_m)
                return piece.gear.sign * np.array([-math.sin(at[2]), -math.cos(at[2]), curvature])

            one = rate(state, number * step)
            two = rate(state + step / 2 * one, (number + 0.5) * step)
            three = rate(state + step / 2 * two, (number + 0.5) * step)
            four = rate(state + step * three, (number + 1) * step)
            state = state + step / 6 * (one + 2 * two + 2 * three + four)
    assert (path.end.x_m, path.end.z_m, path.end.yaw_rad) == pytest.approx(state, abs=1e-6)
    back = path.reversed()
    assert (back.end.x_m, back.end.z_m, back.end.yaw_rad) == pytest.approx((1.0, 2.0, 0.3), abs=1e-9)


def test_the_car_stands_where_the_steering_or_the_gear_jumps():
    path = Path(
        Pose(0.0, 0.0, 0.0),
        (Piece(Gear.FORWARD, 5.0), Piece(Gear.FORWARD, 2.0, 0.2, 0.2), Piece(Gear.REVERSE, 2.0, 0.2, 0.2)),
    )
    states = timed(path, DriveConfig()).sampled(0.05)
    turned_s = math.atan(2.7 * 0.2) / DEFAULTS["steering_rate_rad_s"]
    stands = np.diff(states.arc_m) == 0
    assert np.diff(states.time_s)[stands].sum() == pytest.approx(turned_s + DEFAULTS["shift_s"], abs=1e-6)
    assert states.arc_m[-1] == pytest.approx(9.0)


@pytest.mark.parametrize("sharpness", [0.05, 0.5])
def test_the_straight_between_two_turns_is_that_of_their_chords(sharpness):
    steering, across, turned = Steering(0.2, sharpness), 7.0 - 3.0j, 0.6
    first = np.array([-2.4, -1.0, -1e-3, 0.0, 1e-9, 0.5, 0.8, 2.4])
    found = np.zeros((len(first), 2))
    for row, angle in zip(found, first.tolist(), strict=True):
        _write_straight(0.2, sharpness, NODES, len(NODES), across.real, across.imag, angle, turned, row)
    expected = (across - steering.chords(first)) * np.exp(-1j * first) - steering.chords(turned - first)
    assert found @ [1, 1j] == pytest.approx(expected, abs=1e-12)
