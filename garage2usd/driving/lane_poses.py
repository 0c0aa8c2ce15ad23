"""Lane poses at which manoeuvres into a stall begin and manoeuvres out of it end."""

import math
from collections.abc import Iterable
from dataclasses import replace

from garage2usd.driving.car import DesignCar
from garage2usd.driving.proof import LanePose
from garage2usd.garage import Arc, LaneGraph, Point
from garage2usd.native import elementary

__all__ = ["families", "lane_poses"]

_SHORTEST_M = 1e-3
_QUARTER = math.pi / 2
_ASKEW_RAD, _SAME_RAD = 1e-4, 1e-9


def lane_poses(lanes: LaneGraph, arcs: Iterable[Arc], car: DesignCar) -> list[LanePose]:
    """Return the poses of a car in line with lane arcs, its middle on the arc and its body within the carriageway."""
    poses = (_pose(lanes, arc, car) for arc in arcs)
    return [pose for pose in poses if pose is not None and min(pose.length_m, pose.width_m) >= 0]


def _pose(lanes: LaneGraph, arc: Arc, car: DesignCar) -> LanePose | None:
    """Return the lane pose along an arc's centre line, as far as the car stays on the ground of both nodes."""
    start, end = (lanes.nodes[number] for number in arc)
    way = end.position[0] - start.position[0], end.position[1] - start.position[1]
    length = math.hypot(*way)
    if length < _SHORTEST_M:
        return None
    along = way[0] / length, way[1] / length
    low = max(0.0, car.length_m / 2 - start.reach_m(along))
    high = min(length, length + end.reach_m(along) - car.length_m / 2)
    middle = (low + high) / 2
    place = start.position[0] + along[0] * middle, start.position[1] + along[1] * middle
    return LanePose(place, _yaw_rad(along), high - low, lanes.arcs[arc].width_m - car.width_m)


def families(poses: Iterable[LanePose]) -> list[list[LanePose]]:
    """Group lane poses whose directions differ by quarter turns, and round those differences to exact quarter turns."""
    families: list[list[LanePose]] = []
    for pose in poses:
        for family in families:
            turned = pose.yaw_rad - family[0].yaw_rad
            quarters = round(turned / _QUARTER)
            off = abs(turned - quarters * _QUARTER)
            if off < _ASKEW_RAD:
                exact = family[0].yaw_rad + quarters * _QUARTER
                family.append(pose if off < _SAME_RAD else replace(pose, yaw_rad=exact))
                break
        else:
            families.append([pose])
    return families


def _yaw_rad(along: Point) -> float:
    """Return the yaw of a direction, with negative zeros removed so that the yaw is unique."""
    return elementary.arctan2(-along[0] + 0.0, -along[1] + 0.0)
