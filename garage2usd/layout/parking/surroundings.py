"""Surroundings of people: the room that they need, and what they look at."""

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.layout.grounds import Grounds
from garage2usd.objects.kind import Point

ROOM_M = 0.4
"""Least distance of a person's middle from walls, cars and things."""
SIGHT_M = 1.5
"""Least distance to walls and things ahead of a person who looks at an aisle."""
_SHORT_M = 0.05
"""Distance before a door or a car at which sight ends."""


class Surroundings:
    """What stands around people, and the aisles, doors and cars at which they look.

    Parameters
    ----------
    ground
        Floor inside the building.
    aisles
        Carriageways.
    doors
        Middles of the doors of cores.
    cars, things
        Outlines of cars, and of all else that stands on the floor.
    """

    def __init__(
        self, ground: shapely.Geometry, aisles: Grounds, doors: Sequence[Point], cars: Grounds, things: Grounds
    ) -> None:
        """Index the outlines."""
        self._edge = shapely.boundary(ground)
        self._solid = shapely.STRtree([*cars, *things, self._edge])
        self._seen = [
            (shapely.union_all(aisles), True),
            (shapely.multipoints(np.array(doors).reshape(-1, 2)), False),
            (shapely.union_all(cars), False),
        ]

    def has_room(self, points: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Test for each point (x, z) if nothing is nearer than `ROOM_M`; shapes (n, 2) and (n,)."""
        near = self._solid.query(shapely.points(points), predicate="dwithin", distance=ROOM_M)[0]
        has_room = np.ones(len(points), dtype=bool)
        has_room[near] = False
        return has_room

    def yaw_rad(self, point: Point, draw: float) -> float | None:
        """Rotation of a person who looks at the nearest aisle, door or car in sight; None if all are hidden.

        Parameters
        ----------
        point
            Place of the person.
        draw
            Random number from 0 to 1, which chooses among them.
        """
        here, yaws = shapely.Point(point), []
        for seen, is_open in self._seen:
            if seen.is_empty:
                continue
            way = np.diff(shapely.get_coordinates(shapely.shortest_line(here, seen)), axis=0)[0]
            distance = float(np.hypot(*way))
            if (distance <= _SHORT_M and not is_open) or not distance:
                continue
            sight = way / distance * (max(distance, SIGHT_M) if is_open else distance - _SHORT_M)
            if not len(self._solid.query(shapely.LineString([point, point + sight]), predicate="intersects")):
                yaws.append(float(np.arctan2(*way)))
        return yaws[int(draw * len(yaws))] if yaws else None
