"""Run by a test with the Python of ir-sim: load a map, put a robot somewhere and write down what its LiDAR measures."""

import json
import math
import sys
from pathlib import Path

import irsim
import numpy as np
import yaml
from PIL import Image

RANGE_M = 30.0
WHITE = 255


def in_reach(map_file, place):
    """The part of a map that the LiDAR reaches: its picture, its side in metres and where its lower left corner is."""
    said = yaml.safe_load(map_file.read_text())
    side, origin = said["resolution"], said["origin"][:2]
    with Image.open(map_file.parent / said["image"]) as image:
        columns, rows = image.size
        reach = math.ceil(RANGE_M / side) + 1
        column, row = (math.floor((at - start) / side) for at, start in zip(place, origin, strict=True))
        left, right = max(column - reach, 0), min(column + reach, columns)
        low, high = max(row - reach, 0), min(row + reach, rows)
        part = image.crop((left, rows - high, right, rows - low))
    return hollow(part), side, [origin[0] + left * side, origin[1] + low * side]


def hollow(picture):
    """A map without the occupied cells that have such on all four sides, at which no ray from a free cell ends.

    ir-sim joins all occupied cells into one shape, of which most of the time is spent on these.
    """
    shades = np.array(picture)
    is_black = np.pad(shades == 0, 1)
    sides = is_black[:-2, 1:-1], is_black[2:, 1:-1], is_black[1:-1, :-2], is_black[1:-1, 2:]
    shades[np.logical_and.reduce([is_black[1:-1, 1:-1], *sides])] = WHITE
    return Image.fromarray(shades)


def main(map_file, output, place):
    place = json.loads(place)
    part, side, origin = in_reach(Path(map_file), place)
    picture = Path(output).with_name("in_reach.png")
    part.save(picture)
    world = {
        "world": {
            "width": part.width * side,
            "height": part.height * side,
            "offset": origin,
            "obstacle_map": str(picture),
            "mdownsample": 1,
        },
        "robot": [
            {
                "kinematics": {"name": "diff"},
                "shape": {"name": "circle", "radius": 0.2},
                "state": [*place, 0.0],
                "sensors": [{"name": "lidar2d", "range_max": RANGE_M, "number": 361, "angle_range": 6.283185307179586}],
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
