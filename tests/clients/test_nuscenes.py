"""nuscenes-devkit loads a recording, finds all points of cars in their boxes, and puts points where the lens does."""

import json
from collections import Counter
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image
from support.label_tables import labelled_objects
from support.recordings import Recorded
from support.sample_files import REPOSITORY
from support.sensor_judges import HAS_SENSOR_JUDGES, run_judge

from garage2usd.common.errors import ConfigError
from garage2usd.garage_sources import read_built
from garage2usd.maps.parked_cars import parked_cars
from garage2usd.sensors.formats.nuscenes import NUSCENES_VERSION, write_nuscenes
from garage2usd.sensors.formats.recording import Recording
from garage2usd.sensors.rig.rig import read_rig

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(not HAS_SENSOR_JUDGES, reason="no environment with nuscenes-devkit"),
]

HAND_DRAWN = REPOSITORY / "samples" / "hand_drawn.toml"
MARGIN_M = 0.011


def exact(rig):
    """The same rig without noise."""
    sensors = [
        sensor.model_copy(update={"range_noise_m": 0.0}) if hasattr(sensor, "range_noise_m") else sensor
        for sensor in rig.sensors
    ]
    return rig.model_copy(update={"sensors": tuple(sensors)})


@pytest.fixture(scope="module")
def loaded(builds, tmp_path_factory):
    folder = tmp_path_factory.mktemp("nuscenes")
    (folder / "recorded").mkdir()
    (folder / "data").mkdir()
    recorded = Recorded(builds(HAND_DRAWN, "usdc"), exact(read_rig("lidar_32")), folder / "recorded")
    parts = {"stage": recorded.stage, "labels": recorded.labels, "scene": recorded.scene}
    write_nuscenes(recorded.recording, folder / "data", **parts)
    run_judge("nuscenes_dump.py", folder / "data", NUSCENES_VERSION, folder / "found.json", folder=folder)
    found = json.loads((folder / "found.json").read_text())
    return SimpleNamespace(recorded=recorded, found=found, folder=folder, parts=parts)


def test_every_point_of_a_boxed_object_is_in_its_box(loaded):
    recorded, instances = loaded.recorded, loaded.found["instances"]
    classes = {entry["id"]: entry["class"] for entry in labelled_objects(recorded.built.labels)}
    total = 0
    for sample, cloud in zip(loaded.found["samples"], recorded.clouds, strict=True):
        assert sample["points"] == len(cloud)
        boxes = {instances[box["instance"]]["id"]: box for box in sample["boxes"]}
        for number in np.unique(cloud.instance).tolist():
            if classes[number] in {"car", "traffic_cone", "barrier"}:
                own = np.flatnonzero(cloud.instance == number)
                assert set(own.tolist()) <= set(boxes[number]["inside"])
                assert boxes[number]["said"] == len(own)
                total += len(own)
        assert sum(box["said"] for box in sample["boxes"]) == sum(
            classes[number] in {"car", "traffic_cone", "barrier"} for number in cloud.instance.tolist()
        )
    assert total > 5000


def test_boxes_stand_where_the_table_of_labels_has_them(loaded):
    table = {entry["id"]: entry for entry in labelled_objects(loaded.recorded.built.labels)}
    to_stage = np.linalg.inv(loaded.found["stage_to_global"])
    counts = Counter()
    for sample in loaded.found["samples"]:
        for box in sample["boxes"]:
            number = loaded.found["instances"][box["instance"]]["id"]
            counts[box["instance"]] += 1
            corners = np.array(box["corners"]) @ to_stage[:3, :3].T + to_stage[:3, 3]
            # boxes of cars that stand askew are smaller than those along the axes
            assert (corners.min(axis=0) < np.array(table[number]["min_m"]) + MARGIN_M).all()
            assert (corners.max(axis=0) > np.array(table[number]["max_m"]) - MARGIN_M).all()
            sizes = np.array(table[number]["max_m"]) - np.array(table[number]["min_m"])
            assert (np.ptp(corners, axis=0) < sizes * 1.4 + 2 * MARGIN_M).all()
            assert (np.array(box["corners"])[:, :2] > 0).all()
    assert counts == {token: each["count"] for token, each in loaded.found["instances"].items()}
    assert len(counts) > 10


def test_boxes_of_cars_look_where_the_cars_do(loaded):
    subject = read_built(loaded.recorded.built.stage).garage
    to_stage = np.linalg.inv(loaded.found["stage_to_global"])
    noses = {car.middle_m: (-np.sin(car.yaw_rad), -np.cos(car.yaw_rad)) for car in parked_cars(subject)}
    middles = np.array(list(noses))
    cars = [box for sample in loaded.found["samples"] for box in sample["boxes"] if box["name"] == "vehicle.car"]
    for box in cars:
        corners = (np.array(box["corners"]) @ to_stage[:3, :3].T + to_stage[:3, 3])[:, [0, 2]]
        ahead = corners[:4].mean(axis=0) - corners[4:].mean(axis=0)  # the first four are those of the front
        away = np.linalg.norm(middles - corners.mean(axis=0), axis=1)
        assert away.min() < 0.1
        assert ahead / np.linalg.norm(ahead) == pytest.approx(list(noses.values())[away.argmin()], abs=1e-3)
    assert len(cars) > 20


def test_points_have_the_classes_of_lidarseg(loaded):
    names = {entry["id"]: entry["name"] for entry in json.loads(loaded.recorded.built.labels.read_text())["classes"]}
    ours = {"car": "vehicle.car", "floor": "flat.driveable_surface", "wall": "static.manmade"}
    seen = Counter()
    for sample, cloud in zip(loaded.found["samples"], loaded.recorded.clouds, strict=True):
        for number, name in zip(cloud.class_id.tolist(), sample["classes"], strict=True):
            if names.get(number) in ours:
                assert name == ours[names[number]]
            seen[name] += 1
    assert min(seen[name] for name in ours.values()) > 1000
    assert not seen["noise"]


def test_the_car_is_on_the_map_and_its_surroundings_are_not(loaded):
    assert [sample["on_map"] for sample in loaded.found["samples"]] == [True] * 3
    assert not any(sample["off_map"] for sample in loaded.found["samples"])
    assert [sample["timestamp"] for sample in loaded.found["samples"]] == [0, 500_000, 1_000_000]


def test_the_map_is_free_in_stalls_and_not_in_columns(loaded):
    data = loaded.folder / "data"
    (record,) = json.loads((data / NUSCENES_VERSION / "map.json").read_text())
    mask = np.asarray(Image.open(data / record["filename"]))
    to_global = np.array(record["stage_to_global"])
    found = Counter()
    for entry in labelled_objects(loaded.recorded.built.labels):
        if entry["class"] in {"column", "parking_stall", "obstacle"}:
            middle = (np.array(entry["min_m"]) + np.array(entry["max_m"])) / 2
            x, y, _ = to_global[:3, :3] @ middle + to_global[:3, 3]
            found[entry["class"], int(mask[mask.shape[0] - 1 - int(y / 0.1), int(x / 0.1)])] += 1
    assert {key for key in found if key[0] != "obstacle"} == {("column", 0), ("parking_stall", 255)}
    assert found["column", 0] > 50
    assert found["parking_stall", 255] > 100
    assert found["obstacle", 0] > found["obstacle", 255]  # a low one is driven around, and one that is hollow is open


def test_points_appear_in_the_picture_where_the_lens_has_them(loaded):
    rig = read_rig("lidar_32")
    (lidar,), (camera,) = rig.lidars, rig.cameras
    to_camera = np.linalg.inv(camera.sensor_to_vehicle) @ lidar.sensor_to_vehicle
    for sample, cloud in zip(loaded.found["samples"], loaded.recorded.clouds, strict=True):
        in_camera = cloud.points_m @ to_camera[:3, :3].T + to_camera[:3, 3]
        pixels = camera.lens.project(in_camera)
        width, height = camera.size_px
        # the devkit leaves out what is nearer than a metre, or on the picture's edge
        kept = (
            (in_camera[:, 2] > 1) & (pixels > 1.5).all(axis=1) & (pixels < np.array([width, height]) - 0.5).all(axis=1)
        )
        found = np.array(sample["on_picture"])
        assert len(found) == kept.sum() > 1000
        assert found[:, :2] + 0.5 == pytest.approx(pixels[kept], abs=0.02)
        assert found[:, 2] == pytest.approx(in_camera[kept, 2], abs=1e-3)


def test_what_stands_before_the_camera_is_seen_better_than_what_is_hidden(loaded):
    levels = Counter(box["visibility"] for sample in loaded.found["samples"] for box in sample["boxes"])
    assert levels.keys() == {"1", "2", "3", "4"}
    for sample in loaded.found["samples"]:
        most = max(sample["boxes"], key=lambda box: box["said"])
        assert most["visibility"] in {"3", "4"}


def test_a_recording_that_the_tables_cannot_hold_is_refused(loaded, tmp_path):
    recorded = loaded.recorded.recording
    with pytest.raises(ConfigError, match="a LiDAR or a pinhole camera"):
        write_nuscenes(Recording("own", recorded.stage, ()), tmp_path, **loaded.parts)
