"""Draw a sweep of the rig `lidar_32` from above, each point in the colour of its class: the picture of docs/lidar.md.

Usage: python docs/pictures/point_cloud.py STAGE PICTURE [--at X Z YAW_DEG] [--width 1280]
"""

import argparse
import math
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

from garage2usd.reading.files import open_stage
from garage2usd.reading.labels import read_labels
from garage2usd.reading.lanes import read_lanes
from garage2usd.render.pictures import class_colour
from garage2usd.sensors.rays.lidar import measure
from garage2usd.sensors.rays.ray_scene import read_ray_scene
from garage2usd.sensors.rig.rig import read_rig

BACKGROUND = (18, 20, 24)
MARGIN_M = 1.0
HIGHEST_M = 2.3
"""What hangs higher would cover the rest."""
LEGEND_PX = 190
DOT_PX = 2
MOST_CLASSES = 16


def main() -> None:
    """Measure one sweep and draw it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("stage", type=Path)
    parser.add_argument("picture", type=Path)
    parser.add_argument("--at", type=float, nargs=3, metavar=("X", "Z", "YAW_DEG"))
    parser.add_argument("--width", type=int, default=1280)
    options = parser.parse_args()
    stage = open_stage(options.stage)
    labels = read_labels(stage, options.stage)
    nodes = [node.position for node in read_lanes(stage).nodes if not node.is_portal]
    x, z, yaw_deg = options.at or (*nodes[len(nodes) // 2], 0.0)
    (lidar,) = read_rig("lidar_32").lidars
    vehicle = vehicle_at(x, z, yaw_deg)
    place = vehicle @ lidar.sensor_to_vehicle
    cloud = measure(read_ray_scene(stage, labels), lidar, place)
    points = cloud.points_m @ place[:3, :3].T + place[:3, 3]
    kept = points[:, 1] < HIGHEST_M
    order = np.flatnonzero(kept)[np.argsort(points[kept, 1], kind="stable")]
    draw(points[order], cloud.class_id[order], labels.classes, options)


def vehicle_at(x: float, z: float, yaw_deg: float) -> np.ndarray:
    """From a vehicle's axes to the stage's; at 0 it looks to -Z, and turns to the left."""
    turn = math.radians(yaw_deg)
    forward, left = (-math.sin(turn), 0, -math.cos(turn)), (-math.cos(turn), 0, math.sin(turn))
    return np.array(
        [[*row, at] for row, at in zip(zip(forward, left, (0, 1, 0), strict=True), (x, 0, z), strict=True)]
        + [[0, 0, 0, 1.0]]
    )


def draw(points: np.ndarray, class_ids: np.ndarray, classes: dict, options: argparse.Namespace) -> None:
    """Points as dots, the highest last, with the classes that most of them have beside them."""
    low, high = points[:, [0, 2]].min(axis=0) - MARGIN_M, points[:, [0, 2]].max(axis=0) + MARGIN_M
    scale = (options.width - LEGEND_PX) / (high - low)[0]
    height = math.ceil((high - low)[1] * scale)
    pixels = np.full((height, options.width, 3), BACKGROUND, dtype=np.uint8)
    across, down = ((points[:, [0, 2]] - low) * scale).astype(int).T
    colours = np.array([class_colour(number) for number in class_ids.tolist()], dtype=np.uint8)
    for right, below in np.ndindex(DOT_PX, DOT_PX):
        pixels[down + below, across + right] = colours
    picture = Image.fromarray(pixels)
    pen = ImageDraw.Draw(picture)
    numbers, counts = np.unique(class_ids, return_counts=True)
    for row, index in enumerate(np.argsort(-counts)[:MOST_CLASSES].tolist()):
        number, top = int(numbers[index]), 16 + 22 * row
        left = options.width - LEGEND_PX + 12
        pen.rectangle([left, top, left + 12, top + 12], fill=tuple(class_colour(number)))
        name = classes[number].name if number in classes else "none"
        pen.text((left + 20, top), f"{name} {counts[index]:,}", fill=(230, 230, 230))
    picture.save(options.picture, optimize=True)


if __name__ == "__main__":
    main()
