"""Aisles of a drive that are too narrow for two cars side by side, so that the car drives in their middle."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from garage2usd.driving import DesignCar
from garage2usd.driving.path import Path
from garage2usd.driving.roadmap import has_room_for_two
from garage2usd.garage import LaneGraph

_STEP_M, _ALONG, _SAME_LINE_M = 0.5, 0.9, 0.5


class NarrowAisle(NamedTuple):
    """A straight two-way aisle without room for two cars.

    Attributes
    ----------
    start, end
        Names of its first and last lane node.
    width_m
        Its least width.
    """

    start: str
    end: str
    width_m: float

    def __str__(self) -> str:
        """Return its ends and width in words."""
        return f"{self.start} to {self.end}, {self.width_m:.2f} m"


def narrow_aisles(path: Path, lanes: LaneGraph, car: DesignCar) -> tuple[NarrowAisle, ...]:
    """Return the two-way aisles along a path on one level that are too narrow for a car to keep to its own half."""
    at = path.at(np.arange(0.0, path.length_m, _STEP_M))
    found: dict[tuple[float, float, float], list[tuple[float, int, float]]] = {}
    for edge in lanes.edges:
        if edge.one_way or has_room_for_two(edge.width_m, car):
            continue
        (x, z), (to_x, to_z) = sorted(lanes.nodes[end].position for end in (edge.start, edge.end))
        length_m = math.dist((x, z), (to_x, to_z))
        along_x, along_z = (to_x - x) / length_m, (to_z - z) / length_m
        run = (at.x_m - x) * along_x + (at.z_m - z) * along_z
        aside = np.abs((at.x_m - x) * along_z - (at.z_m - z) * along_x)
        is_along = np.abs(np.sin(at.yaw_rad) * along_x + np.cos(at.yaw_rad) * along_z) > _ALONG
        if np.any((run > 0) & (run < length_m) & (aside < edge.width_m / 2) & is_along):
            line = round(along_x, 2), round(along_z, 2), round((z * along_x - x * along_z) / _SAME_LINE_M)
            for node in (edge.start, edge.end):
                there = lanes.nodes[node].position
                found.setdefault(line, []).append((there[0] * along_x + there[1] * along_z, node, edge.width_m))
    return tuple(_named(sorted(ends), lanes) for ends in found.values())


def _named(ends: Sequence[tuple[float, int, float]], lanes: LaneGraph) -> NarrowAisle:
    first, last = (lanes.nodes[end[1]].name for end in (ends[0], ends[-1]))
    return NarrowAisle(first, last, round(min(width_m for _, _, width_m in ends), 3))
