"""Runs in an environment with CARLA's wheel: what its parser makes of an OpenDRIVE map, as JSON."""

import json
import sys
from pathlib import Path

import carla

_STEP_M = 0.5


def lane(waypoint):
    return [waypoint.road_id, waypoint.lane_id]


def main(source, target):
    world = carla.Map("garage", Path(source).read_text(encoding="utf-8"))
    points = []
    for waypoint in world.generate_waypoints(_STEP_M):
        place, turn = waypoint.transform.location, waypoint.transform.rotation
        points.append([*lane(waypoint), place.x, place.y, place.z, turn.yaw, waypoint.lane_width, waypoint.is_junction])
    ways = [[lane(before), lane(after)] for before, after in world.get_topology()]
    Path(target).write_text(json.dumps({"waypoints": points, "topology": ways}))


main(*sys.argv[1:])
