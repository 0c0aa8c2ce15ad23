"""Doors of stair cores, detected in meshes, and the lanes outside them."""

import math
from collections import defaultdict
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import shapely

from garage2usd.as_built.level import BuiltLevel
from garage2usd.as_built.solids import Solid
from garage2usd.garage import Point

_LABEL = "obstacle"
_HEIGHTS_M = (1.9, 2.5)
_WIDTHS_M = (0.7, 2.0)
_THICKEST_M = 0.3
_FLOOR_M = 0.05
_STEPS_OUT_M = (1.0, 1.8, 2.6, 3.4, 4.2)
"""Distances in metres from a core door at which a lane is looked for, along a passage between stalls."""


class CoreDoor(NamedTuple):
    """A door of a stair core onto a lane.

    Attributes
    ----------
    name
        Prim path of the core.
    position
        (x, z) of its middle in metres.
    node
        Number of the lane node outside the door.
    """

    name: str
    position: Point
    node: int


def core_doors(level: BuiltLevel) -> list[CoreDoor]:
    """Detect the doors of stair cores onto lanes, one for each core and lane, in models of any origin.

    A door is a thin upright piece of an obstacle, from the floor to 1.9 to 2.5 m and 0.7 to 2 m wide, on a side of the
    obstacle with a lane within a metre, or at the end of a passage of up to four metres without stalls.
    """
    pieces: dict[str, list[Solid]] = defaultdict(list)
    for solid in level.solids.standing(_LABEL):
        pieces[solid.name].append(solid)
    doors: dict[tuple[str, int], CoreDoor] = {}
    for name, parts in pieces.items():
        block = shapely.union_all([part.footprint for part in parts]).convex_hull.centroid
        for part in parts:
            step = _step_out(part, (block.x, block.y))
            if step is None:
                continue
            for node in _lanes_beyond(part, step, level):
                doors.setdefault((name, node), CoreDoor(name, part.centre, node))
    return list(doors.values())


def _step_out(part: Solid, block: Point) -> Point | None:
    """Return the unit vector (x, z) out of a core door, if a piece is one."""
    if part.bottom_m > _FLOOR_M or not _HEIGHTS_M[0] <= part.top_m <= _HEIGHTS_M[1]:
        return None
    box = part.footprint.minimum_rotated_rectangle
    if not isinstance(box, shapely.Polygon):
        return None
    corners = np.array(box.exterior.coords)
    sides = corners[1:3] - corners[:2]
    lengths = np.linalg.norm(sides, axis=1)
    along = int(np.argmax(lengths))
    if not _WIDTHS_M[0] <= lengths[along] <= _WIDTHS_M[1] or lengths[1 - along] > _THICKEST_M:
        return None
    across = np.array([-sides[along][1], sides[along][0]]) / lengths[along]
    outwards = np.array([part.footprint.centroid.x, part.footprint.centroid.y]) - block
    x, z = (across * np.copysign(1.0, across @ outwards)).tolist()
    return x, z


def _lanes_beyond(part: Solid, step: Point, level: BuiltLevel) -> Iterator[int]:
    """Yield the lanes at the end of the passage before a door; none if stalls lie between."""
    for far_m in _STEPS_OUT_M:
        place = part.footprint.centroid.x + far_m * step[0], part.footprint.centroid.y + far_m * step[1]
        nodes = list(_lanes_at(place, level))
        if nodes or len(level.stall_grounds.tree.query(shapely.Point(place), predicate="intersects")):
            yield from nodes
            return


def _lanes_at(place: Point, level: BuiltLevel) -> Iterator[int]:
    """Yield the lane nodes on whose ground a place lies, else the nearest one of a carriageway between nodes."""
    lanes = level.lanes
    found = False
    for number, node in enumerate(lanes.nodes):
        off_x, off_z = (abs(at - middle) for at, middle in zip(place, node.position, strict=True))
        if not node.is_portal and off_x <= node.widths_m[0] / 2 and off_z <= node.widths_m[1] / 2:
            found = True
            yield number
    if found:
        return
    for edge in lanes.edges:
        ends = [number for number in (edge.start, edge.end) if not lanes.nodes[number].is_portal]
        line = shapely.LineString([lanes.nodes[edge.start].position, lanes.nodes[edge.end].position])
        if ends and line.distance(shapely.Point(place)) <= edge.width_m / 2:
            yield min(ends, key=lambda number: math.dist(lanes.nodes[number].position, place))
            return
