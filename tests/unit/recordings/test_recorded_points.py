"""LiDARs of a rig along a drive: their points lie on the objects, and no Blender is asked for."""

import json
import subprocess
import sys
from types import SimpleNamespace

import numpy as np
import pytest
from click.testing import CliRunner
from support.label_tables import labelled_objects
from support.small_garage import SETTINGS

import garage2usd
from garage2usd.cli import main
from garage2usd.common.errors import ConfigError
from garage2usd.common.package import installation_of
from garage2usd.config import config_from_mapping
from garage2usd.config.vehicles import CAR_BODIES
from garage2usd.recordings import CloudFormat, Sequence, record
from garage2usd.sensors.rig.rig import rig_from_mapping

MILLIMETRE = 0.001
TAKEN = "Stall_r00_c01_1"
TOP = {
    "kind": "spinning_lidar",
    "name": "top",
    "position_m": (0.6, 0.0, 1.8),
    "yaw_deg": 30.0,
    "channels": 16,
    "lowest_deg": -25.0,
    "highest_deg": 15.0,
    "azimuth_steps": 360,
    "range_m": (0.3, 60.0),
}
WATCHING = {
    "kind": "solid_state_lidar",
    "name": "watching",
    "mount": "column",
    "position_m": (0.4, 0.0, 2.2),
    "pitch_deg": 15.0,
    "horizontal_deg": 120.0,
    "vertical_deg": 70.0,
    "columns": 120,
    "rows": 80,
    "range_m": (0.3, 60.0),
}


FIXED = {**TOP, "name": "fixed", "mount": "world", "position_m": (8.0, -6.0, 2.1)}
CAMERA = {"kind": "pinhole", "name": "eye", "position_m": (1, 0, 1.5), "size_px": (64, 48), "focal_px": (40, 40)}


def rig_of(*sensors):
    return rig_from_mapping({"name": "own", "car": "saloon", "sensors": sensors})


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    folder = tmp_path_factory.mktemp("recorded")
    return garage2usd.build(config_from_mapping(SETTINGS), folder / "garage.usdc")


@pytest.fixture(scope="module")
def recorded(small, tmp_path_factory):
    """A drive to a stall that is taken, with a LiDAR on the car and one on a column, where there is no Blender."""

    folder = tmp_path_factory.mktemp("drive") / "out"
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(sys.modules, "bpy", None)
        made = record(small.stage, folder, rig=rig_of(TOP, WATCHING), along=f"1:{TAKEN}", every_m=3.0)
    table = json.loads(made.frames.read_text())
    objects = {entry["id"]: entry for entry in labelled_objects(small.labels)}
    return SimpleNamespace(made=made, folder=folder, table=table, objects=objects)


def in_world(folder, sweep):
    """Points by frames.json and KITTI's rows alone, with the id of each from the arrays."""
    rows = np.fromfile(folder / sweep["files"]["bin"], dtype=np.float32).reshape(-1, 4)
    arrays = np.load(folder / sweep["files"]["npz"])
    to_world = np.array(sweep["sensor_to_world"])
    return rows[:, :3] @ to_world[:3, :3].T + to_world[:3, 3], arrays["instance"]


def test_every_place_has_a_sweep_of_each_lidar(recorded):
    sweeps = recorded.table["sweeps"]
    poses = sorted({sweep["pose"] for sweep in sweeps})
    assert poses == list(range(len(poses)))
    assert len(poses) > 4
    assert [(sweep["sensor"], sweep["pose"]) for sweep in sweeps] == [
        (name, pose) for pose in poses for name in ("top", "watching")
    ]
    assert recorded.table["frames"] == []
    for sweep, shot in zip(sweeps, recorded.made.recording.shots, strict=True):
        assert sweep["name"] == shot.name == f"{sweep['sensor']}_{sweep['pose']:04}"
        assert {kind: recorded.folder / path for kind, path in sweep["files"].items()} == shot.files
        assert all(path.is_file() for path in shot.files.values())
        assert shot.files.keys() == set(CloudFormat)
        assert sweep["time_s"] == pytest.approx(shot.time_s, abs=1e-6)


def test_points_lie_on_the_objects_that_they_name(recorded):
    ego = recorded.table["sweeps"][0]["hidden_objects"]
    assert [path.rpartition("/")[2] for path in ego] == ["Car_1"]
    hidden = next(entry["id"] for entry in recorded.objects.values() if entry["path"] == ego[0])
    for sweep in recorded.table["sweeps"]:
        places, instance = in_world(recorded.folder, sweep)
        assert len(places) == sweep["points"] > 1000
        numbers, counts = (each.tolist() for each in np.unique(instance, return_counts=True))
        assert {each["id"]: each["points"] for each in sweep["instances"]} == dict(zip(numbers, counts, strict=True))
        assert hidden not in numbers
        known = np.isin(instance, list(recorded.objects))
        low, high = (
            np.array([recorded.objects[number][end] for number in instance[known].tolist()])
            for end in ("min_m", "max_m")
        )
        assert np.maximum(low - places[known], places[known] - high).max() < MILLIMETRE
        # all else is the vehicle, which does not see itself
        is_seen = "/EgoCar" in {each["path"] for each in sweep["instances"]}
        assert known.all() == (not is_seen)
        assert not is_seen or sweep["sensor"] == "watching"


def test_the_lidar_on_the_car_goes_with_it_and_the_one_on_the_column_stays(recorded):
    mine = [sweep for sweep in recorded.table["sweeps"] if sweep["sensor"] == "top"]
    eyes = np.array([np.array(sweep["sensor_to_world"])[:3, 3] for sweep in mine])
    vehicles = [np.array(sweep["vehicle_to_world"]) for sweep in mine]
    assert eyes == pytest.approx(np.array([vehicle @ [0.6, 0, 1.8, 1] for vehicle in vehicles])[:, :3])
    driven = [sweep["distance_m"] for sweep in mine]
    assert np.linalg.norm(np.diff(eyes, axis=0), axis=1) == pytest.approx(np.diff(driven), rel=0.2, abs=0.3)
    theirs = {str(sweep["sensor_to_world"]) for sweep in recorded.table["sweeps"] if sweep["sensor"] == "watching"}
    assert len(theirs) == 1


def test_the_lidar_on_the_column_sees_the_vehicle_where_it_is(recorded):
    seen = []
    for sweep in recorded.table["sweeps"]:
        places, instance = in_world(recorded.folder, sweep)
        number = next((each["id"] for each in sweep["instances"] if each["path"] == "/EgoCar"), None)
        if number is None:
            continue
        assert sweep["sensor"] == "watching"
        to_vehicle = np.linalg.inv(sweep["vehicle_to_world"])
        own = places[instance == number] @ to_vehicle[:3, :3].T + to_vehicle[:3, 3]
        body = next(body for body in CAR_BODIES if body.name == "saloon")
        ahead_m = body.front_overhang_m + body.wheelbase_m
        assert own[:, 0].min() > ahead_m - body.length_m - 0.05
        assert own[:, 0].max() < ahead_m + 0.05
        assert np.abs(own[:, 1]).max() < body.width_m / 2 + 0.25  # mirrors
        assert own[:, 2].min() > -MILLIMETRE
        assert own[:, 2].max() < body.height_m + 0.05
        seen.append((sweep["pose"], len(own)))
    # it comes to stand in the stall that the column watches
    assert seen[-1][0] == recorded.table["sweeps"][-1]["pose"]
    assert seen[-1][1] > 100


def test_the_same_drive_gives_the_same_bytes_and_the_seed_moves_the_noise(small, tmp_path):
    rig = rig_of({**TOP, "range_noise_m": 0.02, "azimuth_steps": 90})
    options = {"rig": rig, "along": f"1:{TAKEN}", "every_m": 8.0, "points": [CloudFormat.NPZ]}
    made = [record(small.stage, tmp_path / name, seed=seed, **options) for name, seed in (("a", 1), ("b", 1), ("c", 2))]
    files = [{path.relative_to(each.folder): path.read_bytes() for path in each.folder.rglob("*.npz")} for each in made]
    assert len(files[0]) > 2
    assert files[0] == files[1]
    assert all(files[0][name] != files[2][name] for name in files[0])
    assert made[0].frames.read_bytes() == made[1].frames.read_bytes()
    assert {path.suffix for path in made[0].folder.rglob("*.*")} == {".npz", ".json"}


@pytest.mark.parametrize(
    ("sensors", "options", "said"),
    [
        ([TOP], {"points": []}, "points"),
        ([TOP], {"points": [CloudFormat.PCD], "sequences": [Sequence.ROS2]}, "npz among them"),
        ([TOP, WATCHING], {"sequences": [Sequence.NUSCENES]}, "sensors on the vehicle"),
    ],
)
def test_what_does_not_suit_a_recording_is_refused_before_the_work(small, sensors, options, said, tmp_path):
    with pytest.raises(ConfigError, match=said):
        record(small.stage, tmp_path / "out", rig=rig_of(*sensors), along=f"1:{TAKEN}", **options)
    assert list(tmp_path.iterdir()) == []


def test_a_lidar_in_the_world_needs_no_drive_and_sees_no_vehicle(small, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "bpy", None)
    made = record(small.stage, tmp_path / "still", rig=rig_of(FIXED), sequences=[Sequence.ROS2])
    (sweep,) = json.loads(made.frames.read_text())["sweeps"]
    driven = record(small.stage, tmp_path / "driven", rig=rig_of(FIXED), along=f"1:{TAKEN}", every_m=8.0)
    passed = json.loads(driven.frames.read_text())["sweeps"]
    assert "vehicle_to_world" not in sweep
    assert (sweep["pose"], sweep["time_s"], sweep["hidden_objects"]) == (0, 0.0, [])
    assert sweep["sensor_to_world"] == passed[0]["sensor_to_world"]
    assert np.array(sweep["sensor_to_world"])[:3, 3] == pytest.approx([8.0, 2.1, 6.0])  # X, up, and -Z to the north
    seen = {each["path"] for each in sweep["instances"]}
    assert "/EgoCar" not in seen
    assert any("/EgoCar" in {each["path"] for each in other["instances"]} for other in passed)
    assert any(path.rpartition("/")[2].startswith("Car_") for path in seen)
    assert json.loads(made.frames.read_text())["drive"] is None


@pytest.mark.parametrize("sensor", [TOP, WATCHING])
def test_without_a_drive_a_sensor_that_goes_with_one_is_named(small, tmp_path, sensor):
    with pytest.raises(ConfigError, match=rf"along.*the sensor {sensor['name']}, which is mounted on the"):
        record(small.stage, tmp_path / "out", rig=rig_of(FIXED, sensor))
    assert list(tmp_path.iterdir()) == []


def rig_file(folder, *sensors):
    path = folder / "rig.toml"
    tables = []
    for sensor in sensors:
        lines = [f"{name} = {json.dumps(value)}" for name, value in sensor.items()]
        tables.append("\n".join(["[[sensors]]", *lines, ""]))
    path.write_text('name = "own"\n' + "\n".join(tables))
    return path


def test_points_alone_leave_the_cameras_out_and_need_no_blender(small, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "bpy", None)
    options = ["--rig", rig_file(tmp_path, {**TOP, "azimuth_steps": 90}, CAMERA), "--along", f"1:{TAKEN}"]
    out = tmp_path / "out"
    ran = CliRunner().invoke(
        main, ["render", str(small.stage), *map(str, options), "--every-m", "8", "--points", "npz", "-o", str(out)]
    )
    assert ran.exit_code == 0, ran.output
    assert "without the cameras of the rig: eye" in ran.stderr
    assert "sweeps of top: npz" in ran.stderr
    table = json.loads((out / "frames.json").read_text())
    assert table["frames"] == []
    assert [sensor["name"] for sensor in table["rig"]["sensors"]] == ["top"]
    assert len(list((out / "points" / "top").iterdir())) == len(table["sweeps"]) > 2
    assert sorted(path.name for path in out.iterdir()) == ["frames.json", "points"]


def test_without_blender_the_message_says_how_points_alone_are_recorded(small, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "bpy", None)
    options = ["--rig", rig_file(tmp_path, TOP, CAMERA), "--along", f"1:{TAKEN}", "-o", tmp_path / "out"]
    ran = CliRunner().invoke(main, ["render", str(small.stage), *map(str, options)])
    assert ran.exit_code == 1
    (line,) = ran.output.strip().splitlines()
    assert "not for LiDARs alone: --points without --only" in line
    assert installation_of("blender") in line


def test_a_drive_is_a_bag_and_tables(small, tmp_path):
    made = record(
        small.stage,
        tmp_path / "out",
        rig=rig_of(TOP),
        along=f"1:{TAKEN}",
        every_m=6.0,
        points=[CloudFormat.NPZ],
        sequences=list(Sequence),
    )
    shots = len(made.recording.shots)
    tables = tmp_path / "out" / "nuscenes" / "v1.0-garage2usd"
    assert len(json.loads((tables / "sample.json").read_text())) == shots
    parked = json.loads((tables / "instance.json").read_text())
    assert [each["path"] for each in parked if each["path"].endswith("r00_c01/Car_1")] == []
    assert len(parked) > 0
    from rosbags.highlevel import AnyReader

    with AnyReader([tmp_path / "out" / "ros2"]) as reader:
        counts = {connection.topic: connection.msgcount for connection in reader.connections}
    assert counts == {"/tf_static": 1, "/map": 1, "/tf": shots, "/top/points": shots}


@pytest.mark.parametrize(("missing", "named"), [("embreex", "needs embreex"), ("rosbags", "needs rosbags")])
def test_an_extra_that_is_missing_is_named_before_the_work(small, tmp_path, missing, named):
    code = f"""
import sys
sys.modules[{missing!r}] = None
from garage2usd.cli import run
run()
"""
    rig = tmp_path / "top.toml"
    rig.write_text(
        'name = "top"\n[[sensors]]\nkind = "spinning_lidar"\nname = "top"\nposition_m = [0, 0, 1.8]\n'
        "elevations_deg = [0.0]\nazimuth_steps = 90\nrange_m = [0.5, 50.0]\n"
    )
    output = tmp_path / "out"
    options = ["--rig", rig, "--along", f"1:{TAKEN}", "--points", "npz", "--also", "ros2", "-o", output]
    ran = subprocess.run(
        [sys.executable, "-c", code, "render", str(small.stage), *map(str, options)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert ran.returncode != 0
    assert named in ran.stderr
    assert installation_of("sensors") in ran.stderr
    assert "Traceback" not in ran.stderr
    assert list(tmp_path.iterdir()) == [rig]
