"""Run with nuscenes-devkit: load a recording and tell of it; usage: nuscenes_dump.py FOLDER VERSION OUT [PLACES].

OUT and PLACES are JSON files. Places are (x, y) in the global frame; of each scene it tells which are on the map.
"""

import json
import sys
from pathlib import Path

import numpy as np
from nuscenes.nuscenes import NuScenes
from nuscenes.utils.data_classes import LidarPointCloud
from nuscenes.utils.geometry_utils import points_in_box
from pyquaternion import Quaternion

LIDAR, CAMERA = "LIDAR_TOP", "CAM_FRONT"
folder, version, output, *others = sys.argv[1:]
data = NuScenes(version, folder, verbose=False)
places = json.loads(Path(others[0]).read_text()) if others else []


def chain(table, first):
    """The tokens of a chain of records; each names the one before it."""
    found, token = [], first
    while token:
        record = data.get(table, token)
        assert record["prev"] == (found[-1] if found else "")
        found.append(token)
        token = record["next"]
    return found


def map_of(scene):
    return data.get("map", data.get("log", scene["log_token"])["map_token"])


def placed(points, record):
    return points @ Quaternion(record["rotation"]).rotation_matrix.T + record["translation"]


def picture_of(sample):
    """Points and boxes in the picture of the front camera, where there is one."""
    if CAMERA not in sample["data"]:
        return {}
    on_picture, depths, _ = data.explorer.map_pointcloud_to_image(sample["data"][LIDAR], sample["data"][CAMERA])
    _, in_picture, _ = data.get_sample_data(sample["data"][CAMERA])
    return {
        "on_picture": np.vstack([on_picture[:2], depths]).T.tolist(),
        "in_picture": [box.token for box in in_picture],
    }


def sample_of(sample, mask):
    lidar = sample["data"][LIDAR]
    path, boxes, _ = data.get_sample_data(lidar)
    cloud = LidarPointCloud.from_file(path)
    classes = np.fromfile(f"{folder}/{data.get('lidarseg', lidar)['filename']}", dtype=np.uint8)
    sensor = data.get("calibrated_sensor", data.get("sample_data", lidar)["calibrated_sensor_token"])
    ego = data.get("ego_pose", data.get("sample_data", lidar)["ego_pose_token"])
    x, y, _ = ego["translation"]
    return {
        "timestamp": sample["timestamp"],
        "ego": ego["translation"],
        "on_map": bool(mask.is_on_mask(x, y)[0]),
        "off_map": bool(mask.is_on_mask(0.5, 0.5)[0]),
        "classes": [data.lidarseg_idx2name_mapping[number] for number in classes.tolist()],
        "points": cloud.points.shape[1],
        "heights": placed(placed(cloud.points[:3].T, sensor), ego)[:, 2].tolist(),
        **picture_of(sample),
        "boxes": [
            {
                "instance": data.get("sample_annotation", box.token)["instance_token"],
                "token": box.token,
                "name": box.name,
                "inside": np.flatnonzero(points_in_box(box, cloud.points[:3])).tolist(),
                "said": data.get("sample_annotation", box.token)["num_lidar_pts"],
                "visibility": data.get("sample_annotation", box.token)["visibility_token"],
                "corners": data.get_box(box.token).corners().T.tolist(),
                "velocity": np.nan_to_num(data.box_velocity(box.token)).tolist(),
                "given": data.get("sample_annotation", box.token).get("velocity"),
                "attributes": [
                    data.get("attribute", each)["name"]
                    for each in data.get("sample_annotation", box.token)["attribute_tokens"]
                ],
            }
            for box in boxes
        ],
    }


def scene_of(scene):
    tokens = chain("sample", scene["first_sample_token"])
    assert tokens[-1] == scene["last_sample_token"]
    samples = [data.get("sample", token) for token in tokens]
    assert {sample["scene_token"] for sample in samples} == {scene["token"]}
    assert len(samples) == scene["nbr_samples"]
    sweeps = [data.get("sample_data", token) for token in chain("sample_data", samples[0]["data"][LIDAR])]
    assert [sweep["sample_token"] for sweep in sweeps] == tokens
    mask = map_of(scene)["mask"]
    return {
        "name": scene["name"],
        "location": data.get("log", scene["log_token"])["location"],
        "map": map_of(scene)["filename"],
        "samples": [sample_of(sample, mask) for sample in samples],
        "on_map": [bool(mask.is_on_mask(x, y)[0]) for x, y in places],
    }


def instance_of(instance):
    tokens = chain("sample_annotation", instance["first_annotation_token"])
    assert tokens[-1] == instance["last_annotation_token"]
    samples = [data.get("sample", data.get("sample_annotation", token)["sample_token"]) for token in tokens]
    (scene,) = {sample["scene_token"] for sample in samples}
    assert len(tokens) == instance["nbr_annotations"]
    return {"id": instance["id"], "count": len(tokens), "scene": data.get("scene", scene)["name"]}


scenes = [scene_of(scene) for scene in data.scene]
found = {
    "scenes": scenes,
    "samples": [sample for scene in scenes for sample in scene["samples"]],
    "instances": {each["token"]: instance_of(each) for each in data.instance},
    "stage_to_global": data.map[0]["stage_to_global"],
}
with open(output, "w") as file:
    json.dump(found, file)
