"""Around views: each pixel's point of the ground through the camera that serves it, as OpenCV projects it."""

import importlib.util
import json
import math
import subprocess
import sys
from pathlib import Path

import cv2
import numpy as np
import pytest
from PIL import Image
from pxr import Usd
from support.sample_files import REPOSITORY
from support.sensor_axes import blender_world

from garage2usd.recordings import record
from garage2usd.render.cameras import View
from garage2usd.render.pictures import Picture
from garage2usd.render.tables import SlotFormat
from garage2usd.sensors.rig.rig import read_rig

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="Blender's bpy is made for Python 3.11 only"),
]

SCRIPT = Path(__file__).with_name("blender_positions.py")
TENTH_PX = 0.1
ON_SEAM_M = 1e-6
"""Pixels exactly on a seam belong to the sides."""
POLES = [(4.6, 0.3, 0.04, 2.5), (2.5, 3.5, 0.04, 2.5), (-3.0, -1.0, 0.04, 2.5), (1.0, -3.0, 0.04, 2.5)]
"""x, y, radius and height in the vehicle's axes: one before each of the cameras."""


def ground_of(camera):
    """x and y in the vehicle's axes of the point of the ground that each pixel stands for; shape (rows, columns, 2)."""
    width, height = camera.size_px
    columns, rows = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    ahead, left, _ = camera.position_m
    per_px = camera.metres_per_px
    return np.stack([ahead + (height / 2 - rows) * per_px, left + (width / 2 - columns) * per_px], axis=-1)


def serving_of(ground, rig):
    """The name of the camera that serves points of the ground: seams leave the corners of the car at 45 degrees."""
    x, y = ground[..., 0], ground[..., 1]
    body = rig.body
    ahead, behind = x - body.ahead_m, body.ahead_m - body.length_m - x
    aside = np.abs(y) - body.width_m / 2
    names = np.where(y > 0, "left", "right")
    names = np.where(ahead > aside + ON_SEAM_M, "front", names)
    return np.where(behind > aside + ON_SEAM_M, "rear", names)


def seen_by(sensor, points):
    """Where OpenCV shows points of the vehicle's axes, shape (n, 3), in a fisheye; NaN beside and behind it."""
    in_camera = (points - sensor.position_m) @ blender_world(sensor)[:3, :3] * [1, -1, -1]
    focal, (column, row) = sensor.focal_px, np.array(sensor.centre_px) - 0.5
    matrix = np.array([[focal[0], 0, column], [0, focal[1], row], [0, 0, 1]])
    zero = np.zeros(3)
    pixels, _ = cv2.fisheye.projectPoints(in_camera[:, None], zero, zero, matrix, np.array(sensor.coefficients))
    return np.where(in_camera[:, 2:] > 0.02, pixels[:, 0], np.nan)


@pytest.fixture(scope="module")
def rig():
    return read_rig("avp_around_view").scaled(1 / 3)


@pytest.fixture(scope="module")
def places(rig, tmp_path_factory):
    """The place in the vehicle's axes that Blender gives each pixel, NaN where it shows nothing."""
    folder = tmp_path_factory.mktemp("around")
    (camera,) = rig.cameras
    matrix = np.eye(4)  # Blender's camera on the ground, which looks down, with the vehicle's nose at the top
    matrix[:3, :3] = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]]).T
    matrix[:3, 3] = camera.position_m
    view = View(camera.name, camera.name, None, camera.lens, camera.size_px, matrix)
    frame = {"lens": view.lens_job(), "size_px": camera.size_px, "camera_to_world": matrix.tolist()}
    job = {"path": str(folder / "around.npy"), "frame": frame, "poles": POLES}
    (folder / "jobs.json").write_text(json.dumps([job]))
    run = subprocess.run([sys.executable, SCRIPT, folder / "jobs.json"], capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    pixels = np.load(folder / "around.npy").astype(float)
    return np.where(pixels[..., 3:] < 1e3, pixels[..., :3], np.nan)


def test_each_pixel_shows_what_its_camera_sees_towards_its_point_of_the_ground(rig, places):
    (camera,) = rig.cameras
    ground = ground_of(camera)
    serving = serving_of(ground, rig)
    shown = np.isfinite(places).all(axis=-1)
    compared = 0
    for sensor in rig.sensors[1:]:
        of_camera = shown & (serving == sensor.name)
        theirs = seen_by(sensor, places[of_camera])
        ours = seen_by(sensor, np.insert(ground[of_camera], 2, 0.0, axis=1))
        error = np.hypot(*(theirs - ours).T)
        assert np.nanmax(error) < TENTH_PX, sensor.name
        compared += np.isfinite(error).sum()
    assert compared > 0.9 * shown.sum()


def test_it_is_black_where_the_car_stands_and_nowhere_else(rig, places):
    (camera,) = rig.cameras
    x, y = np.moveaxis(ground_of(camera), -1, 0)
    body = rig.body
    is_car = (np.abs(y) < body.width_m / 2) & (x < body.ahead_m) & (x > body.ahead_m - body.length_m)
    assert np.isnan(places).all(axis=-1) == pytest.approx(is_car)
    assert is_car.sum() == pytest.approx(body.width_m * body.length_m / camera.metres_per_px**2, rel=0.03)


def test_a_pole_smears_along_the_ray_from_its_camera(rig, places):
    (camera,) = rig.cameras
    ground = ground_of(camera)
    serving = serving_of(ground, rig)
    sensors = {sensor.name: sensor for sensor in rig.sensors[1:]}
    found = set()
    for x, y, radius, _ in POLES:
        is_pole = np.hypot(places[..., 0] - x, places[..., 1] - y) < 1.01 * radius
        for name in np.unique(serving[is_pole]):
            foot = np.array(sensors[name].position_m[:2])
            away = np.hypot(x - foot[0], y - foot[1])
            spread = math.asin(radius / away) + 1e-4
            smeared = ground[is_pole & (serving == name)] - foot
            turn = np.arctan2(smeared[:, 1], smeared[:, 0]) - math.atan2(y - foot[1], x - foot[0])
            assert np.abs((turn + np.pi) % (2 * np.pi) - np.pi).max() < spread
            distance = np.hypot(*smeared.T)
            assert distance.min() > away - radius - 1e-3
            found |= {name for far in distance if far > away + 10 * radius}
    assert found == {"front", "rear", "left", "right"}


@pytest.fixture(scope="module")
def recorded(rig, builds, tmp_path_factory):
    """An around view on the way to a stall, with its slots."""
    made = builds(REPOSITORY / "samples" / "hand_drawn.toml", "usdc", "instanced")
    folder = tmp_path_factory.mktemp("recorded") / "drive"
    record(
        made.stage,
        folder,
        rig=rig,
        along=":A1-02",
        every_m=15.0,
        samples=1,
        pictures=[Picture.COLOUR, Picture.DEPTH, Picture.INSTANCE],
        slots=[SlotFormat.COCO, SlotFormat.DMPR_PS],
    )
    return made.stage, folder, json.loads((folder / "frames.json").read_text())


@pytest.mark.soak
def test_corners_of_slots_are_where_opencv_shows_them(rig, recorded):
    stage_path, folder, table = recorded
    stage = Usd.Stage.Open(str(stage_path))
    corners = {
        prim.GetAttribute("garage:stall:id").Get(): np.insert(prim.GetAttribute("garage:stall:corners").Get(), 1, 0, 1)
        for prim in stage.Traverse()
        if prim.GetAttribute("garage:stall:corners")
    }
    sensors = {sensor.name: sensor for sensor in rig.sensors[1:]}
    (camera,) = rig.cameras
    ahead, left, _ = camera.position_m
    frames = {frame["name"]: frame for frame in table["frames"]}
    compared, visibilities = 0, []
    for frame in json.loads((folder / "slots.json").read_text())["frames"]:
        to_vehicle = np.linalg.inv(frames[frame["name"]]["vehicle_to_world"])
        for slot in frame["slots"]:
            points = corners[slot["name"]] @ to_vehicle[:3, :3].T + to_vehicle[:3, 3]
            places_px = np.array(slot["corners_px"], dtype=float)
            width, height = camera.size_px
            x = ahead + (height / 2 - places_px[:, 1]) * camera.metres_per_px
            y = left + (width / 2 - places_px[:, 0]) * camera.metres_per_px
            ground = np.stack([x, y], axis=1)
            names = serving_of(ground, rig)
            for name, point, place in zip(names, points, ground, strict=True):
                truth, ours = seen_by(sensors[name], np.stack([point, [*place, 0.0]]))
                if np.isfinite(truth).all():
                    assert math.dist(truth, ours) < TENTH_PX
                    compared += 1
            visibilities += slot["visibility"]
    assert compared > 40
    assert {0, 1, 2} == set(visibilities)


@pytest.mark.soak
def test_labels_of_detectors_have_its_slots(recorded):
    _, folder, table = recorded
    names = [frame["name"] for frame in table["frames"]]
    marks = [json.loads((folder / "dmpr_ps" / f"{name}.json").read_text())["marks"] for name in names]
    coco = json.loads((folder / "slots_coco.json").read_text())
    assert sum(map(len, marks)) > 10
    assert {image["file_name"] for image in coco["images"]} == {f"colour/{name}.png" for name in names}
    entries = [np.array(entry["keypoints"][:6]).reshape(2, 3) for entry in coco["annotations"]]
    seen = [entry[:, :2] for entry in entries if entry[:, 2].all() and 2 in entry[:, 2]]
    assert len(seen) > 5
    labelled = np.array([mark[:2] for each in marks for mark in each]) - 1  # ps2.0 counts from 1
    for place in np.concatenate(seen) - 0.5:
        assert np.hypot(*(labelled - place).T).min() < TENTH_PX


@pytest.mark.soak
def test_the_car_is_black_in_colour_and_empty_in_the_others(rig, recorded):
    _, folder, table = recorded
    with Image.open(folder / "ego" / "around.png") as picture:
        is_car = np.asarray(picture) > 0
    assert 0.03 < is_car.mean() < 0.1
    for frame in table["frames"]:
        with (
            Image.open(folder / frame["files"]["colour"]) as colour,
            Image.open(folder / frame["files"]["instance"]) as ids,
        ):
            assert not np.asarray(colour)[is_car].any()
            assert not np.asarray(ids)[is_car].any()
            assert np.asarray(colour)[~is_car].mean() > 10
    calibrated = {path.name for path in (folder / "calibration").iterdir()}
    assert calibrated == {f"{name}.yaml" for name in ("front", "rear", "left", "right")}
