"""Recordings in traffic: agents are where the tracks have them, also at the time of each ray of a sweep."""

import json
from dataclasses import replace

import numpy as np
import pytest
import shapely
import trimesh
from click.testing import CliRunner
from support.recorded_traffic import EGO, TOP, Recorded, busy, middle_of
from support.small_levels import SMALL_LEVELS

import garage2usd
from garage2usd.as_built.garage import garage_as_made
from garage2usd.cli import main
from garage2usd.common.errors import ConfigError
from garage2usd.config.outputs import DriveConfig
from garage2usd.config.traffic import TrafficConfig
from garage2usd.driving.tracks import AgentState
from garage2usd.recordings import Traffic, record
from garage2usd.recordings.own_drive import AVP, with_own_drive
from garage2usd.sensors.rig.rig import rig_from_mapping
from garage2usd.traffic import Operation

CENTIMETRE, MILLIMETRE = 0.01, 0.001
WHEEL_M = 0.75
RAW = {**TOP, "name": "raw", "motion_compensated": False}


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    rig = rig_from_mapping({"name": "own", "car": "saloon", "sensors": [TOP, RAW]})
    return Recorded(tmp_path_factory.mktemp("traffic"), rig)


@pytest.fixture(scope="module")
def table(recorded):
    return json.loads(recorded.made.frames.read_text())


def cloud_of(recorded, sweep):
    with np.load(recorded.made.folder / sweep["files"]["npz"]) as arrays:
        return {name: arrays[name] for name in arrays}


def test_agents_are_where_the_tracks_have_them_within_a_centimetre(recorded, table):
    agents = {agent["id"]: agent for agent in table["traffic"]["agents"]}
    names = {agent["name"] for agent in agents.values()}
    assert names == {track.agent.name for track in recorded.tracks} - {EGO}
    times = sorted({sweep["time_s"] for sweep in table["sweeps"]})
    assert times == [6.0 + step / 2 for step in range(17)]
    for time_s, states in zip(times, table["traffic"]["states"], strict=True):
        present = {name for name in names if np.isfinite(recorded.by_name[name].at(np.array([time_s]))).all()}
        assert {agents[state["id"]]["name"] for state in states} == present
        for state in states:
            track = recorded.by_name[agents[state["id"]]["name"]]
            there, to_world = middle_of(track, time_s), np.array(state["agent_to_world"])
            assert to_world[:3, 3] == pytest.approx((there.x, there.y, there.z), abs=CENTIMETRE)
            level = np.cos(there.pitch)
            nose = -np.sin(there.yaw) * level, np.sin(there.pitch), -np.cos(there.yaw) * level
            assert to_world[:3, 0] == pytest.approx(nose, abs=1e-4)
            before, after = track.at(np.array([time_s - 0.05, time_s + 0.05]))[:, :3]
            moved = (after - before) / 0.1
            if np.isfinite(moved).all():
                assert state["velocity_m_s"] == pytest.approx(moved.tolist(), abs=2e-3)
            assert agents[state["id"]]["size_m"][0] == track.agent.length_m


def test_the_sensors_are_on_the_rear_axle_of_the_ego(recorded, table):
    track = recorded.by_name[EGO]
    for sweep in table["sweeps"]:
        there = middle_of(track, sweep["time_s"])
        vehicle, (ahead, _, up) = np.array(sweep["vehicle_to_world"]), _axes(there)
        axle = np.array([there.x, there.y, there.z]) - track.agent.rear_axle_m * ahead
        assert vehicle[:3, 3] == pytest.approx(axle, abs=MILLIMETRE)
        assert vehicle[:3, 2] == pytest.approx(up, abs=1e-6)


def _axes(there):
    """Directions ahead, to the left and up of a car."""
    ahead = np.array([-np.sin(there.yaw), np.tan(there.pitch), -np.cos(there.yaw)]) * np.cos(there.pitch)
    left = np.array([-np.cos(there.yaw), 0.0, np.sin(there.yaw)])
    return ahead, left, np.cross(ahead, left)


def test_a_point_on_a_moving_car_is_on_its_body_at_the_time_of_its_ray(recorded, table):
    """The layer of the traffic, played by USD, has the body at each time."""
    ids = {agent["name"]: agent["id"] for agent in table["traffic"]["agents"]}
    found, worst_at_once_m = 0, 0.0
    for name in ("car_001", "car_900"):
        body = recorded.body(name)
        for sweep in table["sweeps"][::2]:
            cloud = cloud_of(recorded, sweep)
            own = np.flatnonzero(cloud["instance"] == ids[name])[:60]
            if sweep["sensor"] != "top" or not len(own):
                continue
            to_world = np.array(sweep["sensor_to_world"])
            places = cloud["points_m"][own] @ to_world[:3, :3].T + to_world[:3, 3]
            times_s = sweep["time_s"] + cloud["time_s"][own]
            at_ray = _in_prim(recorded, name, places, times_s)
            at_once = _in_prim(recorded, name, places, np.full(len(own), sweep["time_s"]))
            away_m = _away_m(body, at_ray)
            turning = (at_ray[:, 1] < WHEEL_M) & (away_m > 3 * MILLIMETRE)  # wheels turn in the layer
            assert (away_m[~turning] < 3 * MILLIMETRE).all()
            assert turning.mean() < 0.3
            worst_at_once_m = max(worst_at_once_m, _away_m(body, at_once).max())
            found += len(own)
    assert found > 300
    assert worst_at_once_m > 5 * CENTIMETRE  # without the time of the ray points would be off


def _away_m(triangles, points):
    """Distance of each point to the nearest triangle, 0.5 m at most."""
    low, high = triangles.min(axis=1) - 0.5, triangles.max(axis=1) + 0.5
    found = np.full(len(points), 0.5)
    for number, point in enumerate(points):
        near = triangles[((point > low) & (point < high)).all(axis=1)]
        if len(near):
            closest = trimesh.triangles.closest_point(near, np.broadcast_to(point, (len(near), 3)))
            found[number] = min(0.5, np.linalg.norm(closest - point, axis=1).min())
    return found


def _in_prim(recorded, name, places, times_s):
    matrices = [np.linalg.inv(recorded.placed(name, float(time_s))) for time_s in times_s]
    return np.array([matrix[:3, :3] @ place + matrix[:3, 3] for matrix, place in zip(matrices, places, strict=True)])


def test_compensated_points_are_those_of_the_moving_sensor(recorded, table):
    """Each ray starts where the ego has its sensor at its own time, by the tracks."""
    track, pairs = recorded.by_name[EGO], {}
    for sweep in table["sweeps"]:
        pairs.setdefault(sweep["pose"], {})[sweep["sensor"]] = sweep
    moved_m = 0.0
    for pair in pairs.values():
        top, raw = (cloud_of(recorded, pair[name]) for name in ("top", "raw"))
        assert (top["beam"] == raw["beam"]).all()
        fraction = np.floor(top["beam"] / TOP["channels"]) / TOP["azimuth_steps"]
        assert top["time_s"] == pytest.approx((fraction - 0.5) / TOP["rate_hz"], abs=1e-6)
        assert np.linalg.norm(raw["points_m"], axis=1).max() < TOP["range_m"][1]
        to_world = np.array(pair["top"]["sensor_to_world"])
        place = top["points_m"] @ to_world[:3, :3].T + to_world[:3, 3]
        for row in range(0, len(place), 997):
            there = middle_of(track, pair["top"]["time_s"] + float(top["time_s"][row]))
            ahead, left, up = _axes(there)
            eye = np.array([there.x, there.y, there.z]) + 1.8 * up + (0.6 - track.agent.rear_axle_m) * ahead
            x, y, z = raw["points_m"][row]
            assert place[row] == pytest.approx(eye + x * ahead + y * left + z * up, abs=MILLIMETRE)
            moved_m = max(moved_m, float(np.linalg.norm(raw["points_m"][row] - top["points_m"][row])))
    assert moved_m > 0.1


def test_parked_cars_that_move_are_agents_and_hidden_in_the_stage(recorded, table):
    prims = {agent["prim"] for agent in table["traffic"]["agents"]} - {""}
    assert len(prims) == 1
    for sweep in table["sweeps"]:
        assert set(sweep["hidden_objects"]) == prims
        assert not prims & {seen["path"] for seen in sweep["instances"]}
    people = [seen for sweep in table["sweeps"] for seen in sweep["instances"] if seen["class"] == "person"]
    assert len({(seen["id"], seen["path"]) for seen in people}) == 1  # one for all poses of the body


def test_the_same_recording_has_the_same_bytes(recorded, tmp_path):
    rig = rig_from_mapping(json.loads(recorded.made.frames.read_text())["rig"])
    traffic = Traffic(recorded.tracks, EGO, 0.5, (8.0, 9.0))
    first, second = (record(recorded.stage, tmp_path / name, rig=rig, traffic=traffic) for name in "ab")
    files = [sorted(path for path in made.folder.rglob("*") if path.is_file()) for made in (first, second)]
    assert len(files[0]) > 10
    assert [path.read_bytes() for path in files[0]] == [path.read_bytes() for path in files[1]]


@pytest.mark.parametrize(
    ("changes", "field", "allowed"),
    [
        ({"ego": "car_007"}, "ego", "car_000, car_900, car_001"),
        ({"ego": "person_000"}, "ego", "a car of the tracks"),
        ({"ego": ""}, "ego", "for the sensor top"),
        ({"every_s": 0.0}, "every_s", "0.01 s or more"),
        ({"between_s": (900.0, 901.0)}, "between", "times at which car_000"),
    ],
)
def test_what_cannot_be_recorded_in_traffic_is_named(recorded, tmp_path, changes, field, allowed):
    rig = rig_from_mapping({"name": "own", "sensors": [TOP]})
    traffic = Traffic(**{"tracks": recorded.tracks, "ego": EGO, **changes})
    with pytest.raises(ConfigError) as refused:
        record(recorded.stage, tmp_path / "out", rig=rig, traffic=traffic)
    assert refused.value.field == field
    assert allowed in refused.value.allowed


def test_tracks_of_another_garage_are_refused(recorded, tmp_path):
    strange = replace(
        recorded.by_name["car_900"], agent=replace(recorded.by_name["car_900"].agent, prim="/Garage/Car_9")
    )
    traffic = Traffic(replace(recorded.tracks, tracks=(recorded.by_name[EGO], strange)), EGO)
    with pytest.raises(ConfigError, match="/Garage/Car_9"):
        record(
            recorded.stage, tmp_path / "out", rig=rig_from_mapping({"name": "own", "sensors": [TOP]}), traffic=traffic
        )


@pytest.mark.soak
def test_ten_runs_are_recorded_where_their_tracks_are(recorded, tmp_path):
    """Points of moving cars lie within their boxes at the time of the ray, by the tracks alone."""
    operation, total = Operation(recorded.garage), 0
    rig = rig_from_mapping({"name": "own", "sensors": [{**TOP, "azimuth_steps": 360}]})
    for seed in range(10):
        tracks = operation.run(TrafficConfig(minutes=2.0, arrivals_per_hour=150), seed=seed)
        by_name = {track.agent.name: track for track in tracks}
        ego = max(by_name, key=lambda name: (by_name[name].state == AgentState.DRIVES).sum())
        begin = float(by_name[ego].time_s[np.argmax(by_name[ego].state == AgentState.DRIVES)]) + 3.0
        traffic = Traffic(tracks, ego, 0.5, (begin, begin + 4.0))
        made = record(recorded.stage, tmp_path / str(seed), rig=rig, traffic=traffic)
        table = json.loads(made.frames.read_text())
        agents = {agent["id"]: agent for agent in table["traffic"]["agents"]}
        assert len({agent["name"] for agent in agents.values()}) == len(agents)
        for sweep, states in zip(table["sweeps"], table["traffic"]["states"], strict=True):
            for state in states:
                there = middle_of(by_name[agents[state["id"]]["name"]], sweep["time_s"])
                place = np.array(state["agent_to_world"])[:3, 3]
                assert place == pytest.approx((there.x, there.y, there.z), abs=CENTIMETRE)
            with np.load(made.folder / sweep["files"]["npz"]) as cloud:
                to_world = np.array(sweep["sensor_to_world"])
                for number, agent in agents.items():
                    own = np.flatnonzero(cloud["instance"] == number)
                    if len(own) and agent["class"] == "car":
                        track = by_name[agent["name"]]
                        points = cloud["points_m"][own] @ to_world[:3, :3].T + to_world[:3, 3]
                        x, y, z, yaw, pitch = track.at(sweep["time_s"] + cloud["time_s"][own].astype(float)).T
                        away = points - np.stack([x, y, z], axis=1)
                        ahead = -away[:, 0] * np.sin(yaw) - away[:, 2] * np.cos(yaw)
                        side = away[:, 0] * np.cos(yaw) - away[:, 2] * np.sin(yaw)
                        level = np.isfinite(x) & (np.abs(pitch) < 1e-3)
                        assert (np.abs(ahead[level]) < track.agent.length_m / 2 + CENTIMETRE).all()
                        assert (np.abs(side[level]) < track.agent.width_m / 2 + 0.25).all()  # mirrors
                        total += int(level.sum())
    assert total > 1000


def test_options_of_traffic_belong_to_tracks(recorded):
    said = CliRunner().invoke(main, ["render", str(recorded.stage), "--rig", "lidar_32", "--ego", "avp"])
    assert said.exit_code == 1
    assert "only with --tracks" in said.output


def test_a_car_of_its_own_drives_to_a_stall_and_back_and_comes_near_nobody():
    garage = garage_as_made(garage2usd.generate(SMALL_LEVELS), source="garage", kind="plan")
    tracks = busy(garage)
    long = tracks.__class__(tracks.tracks, tracks.step_s, 900.0)
    whole = with_own_drive(long, garage, DriveConfig(), along=None)
    (own,) = (track for track in whole if track.agent.name == AVP)
    ((start, end, stall),) = own.stall
    assert stall in {each.name for each in garage.stalls if each.takes_cars and not each.is_occupied}
    assert own.time_s[end - 1] - own.time_s[start] >= 10.0
    assert (own.state[start : end - 1] == AgentState.PARKED).all()
    middle = shapely.Polygon(next(each.corners for each in garage.stalls if each.name == stall))
    assert middle.contains(shapely.Point(own.x_m[start], own.z_m[start]))
    outside = np.hypot(own.x_m[[0, -1]] - own.x_m[start], own.z_m[[0, -1]] - own.z_m[start])
    assert (outside > 8.0).all()
    for track in tracks:
        times = np.arange(own.time_s[0], own.time_s[-1], 0.1)
        for mine, other in zip(own.at(times), track.at(times), strict=True):
            if np.isfinite(other[0]) and abs(mine[1] - other[1]) < 1.5:
                assert _outline(own, mine).distance(_outline(track, other)) > 0.25
    with pytest.raises(ConfigError, match="a gap for a drive"):
        with_own_drive(tracks.__class__(tracks.tracks, tracks.step_s, 20.0), garage, DriveConfig(), along=None)


def _outline(track, state):
    x, _, z, yaw, _ = state
    ahead, right = np.array([-np.sin(yaw), -np.cos(yaw)]), np.array([np.cos(yaw), -np.sin(yaw)])
    length, width = track.agent.length_m / 2, track.agent.width_m / 2
    return shapely.Polygon(
        [np.array([x, z]) + a * length * ahead + b * width * right for a, b in ((1, 1), (1, -1), (-1, -1), (-1, 1))]
    )
