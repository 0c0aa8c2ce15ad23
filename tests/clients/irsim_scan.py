"""Run by a test with the Python of ir-sim: load a map, put a robot somewhere and write down what its LiDAR measures."""

import json
import sys
from pathlib import Path

import irsim
import yaml
from PIL import Image


def main(map_file, output, place):
    said = yaml.safe_load(Path(map_file).read_text())
    picture = Path(map_file).parent / said["image"]
    with Image.open(picture) as image:
        columns, rows = image.size
    side = said["resolution"]
    world = {
        "world": {
            "width": columns * side,
            "height": rows * side,
            "offset": said["origin"][:2],
            "obstacle_map": str(picture),
            "mdownsample": 1,
        },
        "robot": [
            {
                "kinematics": {"name": "diff"},
                "shape": {"name": "circle", "radius": 0.2},
                "state": [*json.loads(place), 0.0],
                "sensors": [{"name": "lidar2d", "range_max": 30, "number": 361, "angle_range": 6.283185307179586}],
            }
        ],
    }
    config = Path(output).with_suffix(".yaml")
    config.write_text(yaml.safe_dump(world))
    env = irsim.make(str(config), display=False, log_level="ERROR")
    env.step()
    scan = env.robot.get_lidar_scan()
    ranges = [float(value) for value in scan["ranges"]]
    facts = {"ranges": ranges, "collision": bool(env.robot.collision), "state": env.robot.state.ravel().tolist()}
    Path(output).write_text(json.dumps({**facts, "low": scan["angle_min"], "high": scan["angle_max"]}))


main(*sys.argv[-3:])
