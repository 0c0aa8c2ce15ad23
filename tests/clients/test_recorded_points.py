"""A rig's camera and LiDAR record the same garage: points fall on the pixels of the objects that they name."""

import importlib.util
import json

import numpy as np
import pytest
from PIL import Image
from support.small_garage import SETTINGS

import garage2usd
from garage2usd.config import config_from_mapping
from garage2usd.recordings import CloudFormat, Sequence, record
from garage2usd.render import Picture

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="Blender's bpy is made for Python 3.11 only"),
]
NOISE_M = 0.02


@pytest.mark.soak
def test_points_fall_on_the_pixels_of_their_objects(tmp_path):
    import OpenEXR

    built = garage2usd.build(config_from_mapping(SETTINGS), tmp_path / "garage.usdc")
    kinds = Picture.COLOUR, Picture.DEPTH, Picture.INSTANCE
    options = {"rig": "lidar_32", "along": "1:Stall_r00_c01_1", "every_m": 15.0, "scale": 0.2, "samples": 1}
    points, sequences = [CloudFormat.NPZ], list(Sequence)
    made = record(built.stage, tmp_path / "out", pictures=kinds, points=points, sequences=sequences, **options)
    folder, table = tmp_path / "out", json.loads(made.frames.read_text())
    assert len(table["frames"]) == len(table["sweeps"]) > 2
    assert [(shot.pose, shot.sensor.name) for shot in made.recording.shots] == [
        (pose, name) for pose in range(len(table["frames"])) for name in ("front", "lidar_top")
    ]
    met = 0
    for frame, sweep in zip(table["frames"], table["sweeps"], strict=True):
        assert frame["pose"] == sweep["pose"]
        assert frame["time_s"] == sweep["time_s"]
        with OpenEXR.File(str(folder / frame["files"]["depth"]), separate_channels=True) as file:
            depth_m = np.array(file.channels()["Z"].pixels)
        drawn = np.asarray(Image.open(folder / frame["files"]["instance"])).astype(int) @ [1, 256, 65536]
        cloud = np.load(folder / sweep["files"]["npz"])
        to_camera = np.array(frame["world_to_camera"]) @ sweep["sensor_to_world"]
        places = cloud["points_m"] @ to_camera[:3, :3].T + to_camera[:3, 3]
        ahead = places[:, 2] > 0.5
        pixels = places[ahead] @ np.array(frame["intrinsics"]).T
        columns, rows = np.floor(pixels[:, :2] / pixels[:, 2:]).astype(int).T
        within = (columns >= 0) & (rows >= 0) & (columns < depth_m.shape[1]) & (rows < depth_m.shape[0])
        columns, rows, z_m = columns[within], rows[within], places[ahead][within, 2]
        # the LiDAR stands higher than the camera, and sees what hides from it
        same = np.abs(depth_m[rows, columns] - z_m) < 5 * NOISE_M + 0.02 * z_m
        assert same.mean() > 0.85
        named = cloud["instance"][ahead][within]
        assert (drawn[rows, columns] == named)[same].mean() > 0.97  # a pixel is wider than a ray
        met += same.sum()
    assert met > 5_000
    assert len(list((folder / "nuscenes" / "samples" / "CAM_FRONT").glob("*.png"))) == len(table["frames"])
    assert (folder / "ros2" / "metadata.yaml").is_file()
