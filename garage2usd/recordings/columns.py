"""Columns whose sensors watch a stall."""

import math

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.as_built.level import BuiltLevel
from garage2usd.common.errors import ConfigError
from garage2usd.garage import Point, Stall
from garage2usd.objects import CAR_LABELS

_COLUMN = "column"
_HIDES_FROM_M = 1.9
"""Height in metres above which an object hides a stall from a column's camera. Cars, which come and go, are ignored."""
_NEAREST_M = 2.5
"""Least distance in metres from a stall's middle to its column; nearer columns see only part of the stall."""


def column_to_y_up(level: BuiltLevel, stall: Stall) -> NDArray[np.float64]:
    """Compute the frame of sensors on the column that watches a stall.

    The column is the nearest one in front of the stall's entry with a free line of sight to the stall's middle over
    everything lower than a wall. If there is none, the nearest other column is used. Columns nearer than 2.5 m are
    ignored.

    Returns
    -------
    ndarray
        Transform from the column's frame to metres with Y up, for column vectors; float64, shape (4, 4). The frame has
        its origin at the foot of the column's axis, x horizontal towards the stall's middle, y to the left and z up.

    Raises
    ------
    ConfigError
        If the garage has no suitable column.
    """
    found: dict[str, tuple[list[shapely.Polygon], float]] = {}
    for solid in level.solids.standing(_COLUMN):
        pieces, low_m = found.get(solid.name, ([], math.inf))
        found[solid.name] = [*pieces, solid.footprint], min(low_m, solid.bottom_m)
    candidates: list[tuple[bool, float, str, Point, float]] = []
    for name, (pieces, low_m) in found.items():
        centre = shapely.union_all(pieces).envelope.centroid
        place = (centre.x, centre.y)
        distance_m = math.dist(place, stall.centre)
        if distance_m >= _NEAREST_M and not _is_hidden(level, name, place, stall.centre):
            candidates.append((not _is_before(stall, place), round(distance_m, 6), name, place, low_m))
    if not candidates:
        raise ConfigError("rig", stall.name, "a stall that a column of the garage watches, for sensors on a column")
    *_, (x_m, z_m), low_m = min(candidates)
    along = np.array([stall.centre[0] - x_m, 0.0, stall.centre[1] - z_m])
    along /= np.linalg.norm(along)
    matrix = np.eye(4)
    matrix[:3, 0], matrix[:3, 2] = along, (0.0, 1.0, 0.0)
    matrix[:3, 1] = np.cross(matrix[:3, 2], matrix[:3, 0])
    matrix[:3, 3] = x_m, low_m, z_m
    return matrix


def _is_before(stall: Stall, place: Point) -> bool:
    """Test if a point lies in front of a stall's entry, on the side from which cars come."""
    ahead = (place[0] - stall.mouth[0]) * stall.outwards[0] + (place[1] - stall.mouth[1]) * stall.outwards[1]
    return ahead > 0


def _is_hidden(level: BuiltLevel, column: str, place: Point, middle: Point) -> bool:
    sight = shapely.LineString([place, middle])
    return any(
        solid.name != column and solid.label not in CAR_LABELS and solid.top_m >= _HIDES_FROM_M
        for solid in level.solids.at(sight)
    )
