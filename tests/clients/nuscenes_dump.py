"""Run with nuscenes-devkit: load a recording and tell of it; usage: nuscenes_dump.py FOLDER VERSION OUT.json."""

import json
import sys

import numpy as np
from nuscenes.nuscenes import NuScenes
from nuscenes.utils.data_classes import LidarPointCloud
from nuscenes.utils.geometry_utils import points_in_box

folder, version, output = sys.argv[1:]
data = NuScenes(version, folder, verbose=False)
samples, token = [], data.scene[0]["first_sample_token"]
while token:
    sample = data.get("sample", token)
    lidar = sample["data"]["LIDAR_TOP"]
    path, boxes, _ = data.get_sample_data(lidar)
    cloud = LidarPointCloud.from_file(path)
    classes = np.fromfile(f"{folder}/{data.get('lidarseg', lidar)['filename']}", dtype=np.uint8)
    ego = data.get("ego_pose", data.get("sample_data", lidar)["ego_pose_token"])
    x, y, _ = ego["translation"]
    on_picture, depths, _ = data.explorer.map_pointcloud_to_image(lidar, sample["data"]["CAM_FRONT"])
    _, in_picture, intrinsic = data.get_sample_data(sample["data"]["CAM_FRONT"])
    samples.append(
        {
            "timestamp": sample["timestamp"],
            "on_map": bool(data.map[0]["mask"].is_on_mask(x, y)[0]),
            "off_map": bool(data.map[0]["mask"].is_on_mask(0.5, 0.5)[0]),
            "classes": [data.lidarseg_idx2name_mapping[number] for number in classes.tolist()],
            "points": cloud.points.shape[1],
            "on_picture": np.vstack([on_picture[:2], depths]).T.tolist(),
            "in_picture": [box.token for box in in_picture],
            "boxes": [
                {
                    "instance": data.get("sample_annotation", box.token)["instance_token"],
                    "token": box.token,
                    "name": box.name,
                    "inside": np.flatnonzero(points_in_box(box, cloud.points[:3])).tolist(),
                    "said": data.get("sample_annotation", box.token)["num_lidar_pts"],
                    "visibility": data.get("sample_annotation", box.token)["visibility_token"],
                    "corners": data.get_box(box.token).corners().T.tolist(),
                }
                for box in boxes
            ],
        }
    )
    token = sample["next"]
instances = {each["token"]: {"id": each["id"], "count": each["nbr_annotations"]} for each in data.instance}
with open(output, "w") as file:
    json.dump({"samples": samples, "instances": instances, "stage_to_global": data.map[0]["stage_to_global"]}, file)
