"""Each pixel of a rig's camera shows what its lens model says: places by Blender, models by OpenCV and written out."""

import importlib.util
import json
import subprocess
import sys
from pathlib import Path

import cv2
import numpy as np
import pytest
from support.sensor_axes import blender_world

from garage2usd.render.cameras import View
from garage2usd.sensors.rig.rig import read_rig, rig_from_mapping

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="Blender's bpy is made for Python 3.11 only"),
]

SCRIPT = Path(__file__).with_name("blender_positions.py")
SHRINK = 4
"""Of the pictures, whose number of pixels decides how long the tests take."""
PIXEL = 0.01
"""As far as 99.9 % of a picture's pixels may be off."""
OBLIQUE = {
    "kind": "pinhole",
    "name": "oblique",
    "position_m": [1.0, 0.5, 1.2],
    "yaw_deg": 30.0,
    "size_px": [320, 200],
    "focal_px": [150.0, 210.0],
    "centre_px": [140.25, 111.5],
}


@pytest.fixture(scope="module")
def places(tmp_path_factory):
    """Each camera of the rigs, and a pinhole of no symmetry, a quarter as large, with Blender's place of each pixel."""
    folder = tmp_path_factory.mktemp("positions")
    rigs = [read_rig("avp_surround"), read_rig("woodscape_like"), rig_from_mapping({"name": "o", "sensors": [OBLIQUE]})]
    jobs, sensors = [], {}
    for rig in rigs:
        for sensor in rig.cameras:
            lens = sensor.lens.resized((sensor.size_px[0] // SHRINK, sensor.size_px[1] // SHRINK))
            matrix = blender_world(sensor)
            view = View(sensor.name, sensor.name, None, lens, lens.size_px, matrix)
            frame = {"lens": view.lens_job(), "size_px": lens.size_px, "camera_to_world": matrix.tolist()}
            jobs.append({"path": str(folder / f"{sensor.name}.npy"), "frame": frame})
            sensors[sensor.name] = sensor, matrix
    (folder / "jobs.json").write_text(json.dumps(jobs))
    run = subprocess.run([sys.executable, SCRIPT, folder / "jobs.json"], capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr

    def read(name):
        pixels = np.load(folder / f"{name}.npy").astype(float)
        sensor, matrix = sensors[name]
        in_camera = (pixels[..., :3] - matrix[:3, 3]) @ matrix[:3, :3] * [1, -1, -1]  # OpenCV's axes
        return sensor, in_camera, pixels[..., 3]

    return read


def check(points, columns_rows, seen):
    """The projected points lie in the middles of their pixels; returns how many there are."""
    rows, columns = np.nonzero(seen)
    error = np.hypot(columns_rows[:, 0] - columns, columns_rows[:, 1] - rows)
    assert np.quantile(error, 0.999) < PIXEL
    assert np.median(error) < PIXEL / 2
    assert error.max() < 0.1
    return len(error)


@pytest.mark.parametrize("name", ["front", "left", "right", "rear"])
def test_kannala_brandt_pixels_are_opencvs(places, name):
    sensor, points, depth = places(name)
    seen = depth < 1e3
    focal, (column, row) = sensor.focal_px[0] / SHRINK, np.array(sensor.centre_px) / SHRINK - 0.5
    coefficients = np.array(sensor.coefficients)
    matrix = np.array([[focal, 0, column], [0, focal, row], [0, 0, 1]])
    ahead = seen & (points[..., 2] > 1e-3)
    theirs, _ = cv2.fisheye.projectPoints(points[ahead][:, None], np.zeros(3), np.zeros(3), matrix, coefficients)
    assert check(points, theirs[:, 0], ahead) > 0.6 * ahead.size
    # beside and behind the camera, where OpenCV has no picture
    x, y, z = points[seen & ~ahead].T
    theta = np.arctan2(np.hypot(x, y), z)
    k1, k2, k3, k4 = coefficients
    radius = focal * (theta + k1 * theta**3 + k2 * theta**5 + k3 * theta**7 + k4 * theta**9)
    beside = np.stack([x, y], axis=1) / np.hypot(x, y)[:, None] * radius[:, None] + [column, row]
    assert check(points, beside, seen & ~ahead) > 1000
    field_of_view(points, seen)
    assert depth[seen] == pytest.approx(np.linalg.norm(points[seen], axis=-1), rel=1e-4)


@pytest.mark.parametrize("name", ["FV", "RV", "MVL", "MVR"])
def test_woodscape_pixels_are_those_of_its_formula(places, name):
    sensor, points, depth = places(name)
    seen = depth < 1e3
    x, y, z = points[seen].T
    chi = np.hypot(x, y)
    theta = np.pi / 2 - np.arctan2(z, chi)
    width, height = sensor.size_px[0] // SHRINK, sensor.size_px[1] // SHRINK
    k1, k2, k3, k4 = np.array(sensor.coefficients_px) * width / sensor.size_px[0]
    rho = k1 * theta + k2 * theta**2 + k3 * theta**3 + k4 * theta**4
    ratios = np.array([width / sensor.size_px[0], height / sensor.size_px[1]])
    offset, aspect = sensor.centre_offset_px * ratios, ratios / ratios[0]
    principal = np.array([width, height]) / 2 + offset - 0.5
    pixels = np.stack([x, y], axis=1) / chi[:, None] * rho[:, None] * aspect + principal
    assert check(points, pixels, seen) > 0.6 * seen.size
    field_of_view(points, seen)
    assert depth[seen] == pytest.approx(np.linalg.norm(points[seen], axis=-1), rel=1e-4)


def field_of_view(points, seen):
    """All of 190 degrees is seen, and no more."""
    angle = np.degrees(np.arctan2(np.hypot(*points[seen][:, :2].T), points[seen][:, 2]))
    assert 94.8 < angle.max() < 95.02
    assert 0 < (~seen).mean() < 0.3


def test_a_pinhole_of_pixels_that_are_not_square_is_opencvs(places):
    _, points, depth = places("oblique")
    lens = np.array([[150.0 / SHRINK, 0, 140.25 / SHRINK - 0.5], [0, 210.0 / SHRINK, 111.5 / SHRINK - 0.5], [0, 0, 1]])
    seen = depth < 1e3
    assert seen.all()
    theirs, _ = cv2.projectPoints(points[seen], np.zeros(3), np.zeros(3), lens, None)
    check(points, theirs[:, 0], seen)
    assert depth == pytest.approx(np.linalg.norm(points, axis=-1), rel=1e-4)
