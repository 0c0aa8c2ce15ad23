"""What a recording refuses before Blender starts, and where a vehicle and columns stand."""

import json
import math
import subprocess
import sys

import numpy as np
import pytest
from click.testing import CliRunner
from pxr import Usd
from support.label_tables import labelled_objects
from support.sample_files import REPOSITORY

from garage2usd.as_built.garage import garage_of_file
from garage2usd.cli import main
from garage2usd.common.errors import ConfigError, OutputError
from garage2usd.common.output import unfinished_folder
from garage2usd.config.outputs import DriveConfig
from garage2usd.reading.files import open_stage
from garage2usd.reading.labels import read_labels
from garage2usd.recordings import record
from garage2usd.recordings.columns import column_to_y_up
from garage2usd.recordings.scene import Scene
from garage2usd.recordings.way import Way
from garage2usd.render import Picture
from garage2usd.sensors.rig.poses import Twist
from garage2usd.sensors.rig.rig import read_rig, rig_from_mapping


@pytest.fixture(scope="module")
def built(builds):
    return builds(REPOSITORY / "samples" / "hand_drawn.toml", "usdc", "instanced")


@pytest.mark.parametrize(
    ("settings", "field", "allowed"),
    [
        ({"rig": "surround"}, "rig", "one of avp_around_view"),
        ({"along": "1:Z9"}, "stall", "one of the garage's"),
        ({"along": "9:"}, "along", "ENTRANCE:STALL"),
        ({"along": "first:1"}, "along", "ENTRANCE:STALL"),
        ({"along": None}, "along", "for the sensor front"),
        ({"along": "9:A1-01"}, "entrance", "1"),
        ({"along": "Inside"}, "along", "a camera that moves"),
        ({"along": "Nothing"}, "camera", "/Garage/Cameras/Drive"),
        ({"every_m": 0.0}, "every_m", "0.01 m or more"),
        ({"scale": 0.001}, "scale", "sides of 16 to 8192 pixels"),
        ({"pictures": ()}, "pictures", "at least one of"),
        ({"rig": "column_camera", "along": "Drive"}, "along", "for sensors on a column"),
    ],
)
def test_what_cannot_be_recorded_is_named(built, tmp_path, settings, field, allowed):
    with pytest.raises(ConfigError) as refused:
        record(built.stage, tmp_path / "out", **{"rig": "avp_surround", "along": ":1", **settings})
    assert refused.value.field == field
    assert allowed in refused.value.allowed
    assert list(tmp_path.iterdir()) == []


def test_a_stall_without_a_way_is_told_with_what_is_in_the_way(tmp_path):
    """The turning stall of a dead end takes no car."""
    import garage2usd

    made = garage2usd.build(garage2usd.GarageConfig(site={"width_cells": 6, "height_cells": 6}), tmp_path / "g.usdc")
    stalls = json.loads(made.report.read_text())["levels"][0]["stalls"]
    blocked = next((entry["name"] for entry in stalls if entry["use"] in {"access_aisle", "turning"}), None)
    assert blocked is not None
    with pytest.raises(ConfigError, match="a stall that takes a car"):
        record(made.stage, tmp_path / "out", rig="avp_surround", along=f":{blocked}")


def test_options_belong_together(built, tmp_path):
    def said(*arguments):
        result = CliRunner().invoke(main, ["render", str(built.stage), "-o", str(tmp_path / "out"), *arguments])
        assert result.exit_code == 1
        return result.output

    assert "along" in said("--rig", "avp_surround")
    assert "only with --along" in said("--rig", "avp_surround", "--every-m", "2")
    assert "without --rig" in said("--rig", "avp_surround", "--at", "1,2,3")
    assert "without --rig" in said("--rig", "avp_surround", "--along", ":1", "--size", "64x48")
    assert "only with --rig" in said("--scale", "0.5")
    assert "only with --rig" in said("--along", ":1")


def test_a_camera_that_moves_leads_the_car(built):
    stage = Usd.Stage.Open(str(built.stage))
    way = Way(open_stage(built.stage), built.stage, "Drive", 2.0, DriveConfig())
    distances = [pose.distance_m for pose in way.poses]
    assert np.diff(distances)[:-1] == pytest.approx(2.0, abs=0.12)  # whole frames
    from pxr import UsdGeom

    camera = UsdGeom.Camera(stage.GetPrimAtPath("/Garage/Cameras/Drive"))
    for pose in way.poses:
        seen = np.array(camera.ComputeLocalToWorldTransform(pose.time_s * 24)).T
        assert pose.vehicle_to_world[:3, 3] == pytest.approx(seen[:3, 3] - [0, 1.5, 0], abs=1e-6)
        assert pose.vehicle_to_world[:3, 0] == pytest.approx(-seen[:3, 2], abs=1e-6)
        assert pose.vehicle_to_world[:3, 2] == pytest.approx([0, 1, 0])
        assert np.linalg.det(pose.vehicle_to_world) == pytest.approx(1.0)


def test_columns_look_at_the_stall_they_watch(built):
    (subject,) = garage_of_file(built.stage).levels
    columns = [entry for entry in labelled_objects(built.labels) if entry["class"] == "column"]
    centres = [((e["min_m"][0] + e["max_m"][0]) / 2, (e["min_m"][2] + e["max_m"][2]) / 2) for e in columns]
    before = 0
    for stall in subject.parking_stalls:
        matrix = column_to_y_up(subject, stall)
        foot = matrix[[0, 2], 3]
        assert min(math.dist(foot, centre) for centre in centres) < 0.05
        towards = np.array(stall.centre) - foot
        assert matrix[[0, 2], 0] == pytest.approx(towards / np.linalg.norm(towards))
        assert math.dist(foot, stall.centre) >= 2.5
        assert matrix[:3, 2].tolist() == [0, 1, 0]
        assert np.linalg.det(matrix) == pytest.approx(1.0)
        before += (foot - stall.mouth) @ stall.outwards > 0
    assert before > 0.8 * len(subject.parking_stalls)


def test_a_world_mount_is_in_the_frame_of_the_maps(built):
    sensor = {"kind": "pinhole", "name": "a", "mount": "world", "position_m": [3, 4, 2], "size_px": [64, 48]}
    rig = rig_from_mapping({"name": "w", "sensors": [{**sensor, "focal_px": [50, 50], "yaw_deg": 90}]})
    way = Way(open_stage(built.stage), built.stage, "Drive", 20.0, DriveConfig())
    (camera,) = rig.cameras
    placed = way.mount_to_world(camera, way.poses[0]) @ camera.sensor_to_vehicle
    assert placed[:3, 3] == pytest.approx([3, 2, -4])
    assert placed[:3, 2] == pytest.approx([0, 0, -1])  # it looks along y, to the north
    assert placed[:3, 1] == pytest.approx([0, -1, 0])


def test_scaled_rigs_see_the_same():
    for name in ("avp_surround", "woodscape_like", "lidar_32"):
        rig, small = read_rig(name), read_rig(name).scaled(0.37)
        points = np.random.default_rng(2).normal([0, 0, 2], size=(300, 3))
        for camera, other in zip(rig.cameras, small.cameras, strict=True):
            ratio = np.array(other.size_px) / camera.size_px
            assert other.lens.project(points) == pytest.approx(camera.lens.project(points) * ratio, nan_ok=True)
        assert rig.lidars == small.lidars


def test_unfinished_work_stays_only_if_there_is_some(tmp_path):
    out, place = tmp_path / "out", tmp_path / "out.unfinished"

    def work(key, *files):
        with unfinished_folder(out, key) as folder:
            (folder / "empty").mkdir(exist_ok=True)
            for name in files:
                (folder / name).write_text("x")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        work("a")
    assert not place.exists()
    with pytest.raises(KeyboardInterrupt):
        work("a", "frame")
    with pytest.raises(ConfigError, match="removed"):
        work("b")
    with unfinished_folder(out, "a") as folder:
        assert (folder / "frame").read_text() == "x"
    assert not place.exists()


HOLDS = """
import sys, time
from pathlib import Path
from garage2usd.common.output import unfinished_folder
with unfinished_folder(Path(sys.argv[1]), "a") as folder:
    (folder / "frame").write_text("x")
    print("at work", flush=True)
    time.sleep(600)
"""


def test_a_second_run_in_one_unfinished_folder_is_refused_until_the_first_has_ended(tmp_path):
    out, place = tmp_path / "out", tmp_path / "out.unfinished"
    with subprocess.Popen([sys.executable, "-c", HOLDS, str(out)], stdout=subprocess.PIPE, text=True) as first:
        assert first.stdout.readline() == "at work\n"
        with pytest.raises(OutputError, match=r"out\.unfinished.*another run"), unfinished_folder(out, "a"):
            pytest.fail("two runs are at work")
        assert (place / "frame").read_text() == "x"
        first.kill()
    # a run that was killed keeps nobody out, and what it finished is there
    with unfinished_folder(out, "a") as folder:
        assert (folder / "frame").read_text() == "x"
        with pytest.raises(OutputError, match="another run"), unfinished_folder(out, "a"):
            pytest.fail("two runs are at work")
    assert not place.exists()


def test_cameras_move_as_the_vehicle_does_between_frames(built):
    stage = open_stage(built.stage)
    left = next(one for one in read_rig("avp_surround").model_dump(mode="json")["sensors"] if one["name"] == "left")
    rig = rig_from_mapping({"name": "r", "sensors": [{**left, "effects": {"exposure_s": 0.01}}]})
    along = f":{next(stall.name for stall in built.garage.layout.stalls if stall.use.takes_cars)}"
    way = Way(stage, built.stage, along, 0.05, DriveConfig())
    twists = [pose.twist for pose in way.poses]
    velocities = np.array([twist.velocity_m_s for twist in twists])
    assert np.abs(velocities[:, 0]).max() > 1.0
    # the rear axle of a car does not slip aside
    assert np.abs(velocities[:, 1]).max() < 0.01
    views = Scene(stage, read_labels(stage, built.stage), way, rig).views
    compared = 0
    for before, here, after in zip(views, views[1:], views[2:], strict=False):
        seconds = after.facts["time_s"] - before.facts["time_s"]
        if seconds > 0.15:  # it stops between them, or is slow
            continue
        to_camera = here.world_to_camera()[:3, :3]
        moved = to_camera @ (after.camera_to_world[:3, 3] - before.camera_to_world[:3, 3]) / seconds
        assert here.twist.velocity_m_s == pytest.approx(moved, abs=0.06)
        ahead = to_camera @ (after.camera_to_world[:3, 1] - before.camera_to_world[:3, 1]) / seconds
        # how fast the upward axis, which is -Y here, turns about the rest
        assert np.cross(here.twist.turn_rad_s, [0, -1, 0]) == pytest.approx(ahead, abs=0.05)
        compared += 1
    assert compared > 50


def test_motion_is_found_for_pictures_that_show_it_alone(built, monkeypatch):
    monkeypatch.setattr(Twist, "between", lambda *_: pytest.fail("no picture shows it"))
    stage, rig = open_stage(built.stage), read_rig("avp_surround")
    for along in ("Drive", f":{next(stall.name for stall in built.garage.layout.stalls if stall.use.takes_cars)}"):
        way = Way(stage, built.stage, along, 1.0, DriveConfig())
        views = Scene(stage, read_labels(stage, built.stage), way, rig).views
        assert len(views) > 20
        assert {view.twist for view in views} == {None}


def test_a_camera_that_stands_sees_the_vehicle_move(built):
    stage = open_stage(built.stage)
    front = read_rig("avp_surround").model_dump(mode="json")["sensors"][0]
    rig = rig_from_mapping({"name": "r", "sensors": [{**front, "mount": "world", "effects": {"exposure_s": 0.01}}]})
    way = Way(stage, built.stage, "Drive", 2.0, DriveConfig())
    scene = Scene(stage, read_labels(stage, built.stage), way, rig)
    compared = 0
    for view, pose in zip(scene.views, way.poses, strict=True):
        axle = pose.vehicle_to_world
        velocity = axle[:3, :3] @ pose.twist.velocity_m_s
        first, later = (view.world_to_camera() @ [*(axle[:3, 3] + velocity * time), 1] for time in (0.0, 1e-4))
        seen = view.twist.seen_after(first[None, :3], 1e-4)[0]
        assert seen == pytest.approx(later[:3], abs=1e-5)
        compared += np.linalg.norm(later - first) > 1e-5
    assert compared > 3
    assert not any(view.is_carried for view in scene.views)
    assert scene.needed([Picture.COLOUR]) == (Picture.DEPTH, Picture.INSTANCE)
    assert scene.needed([Picture.NORMALS]) == ()
