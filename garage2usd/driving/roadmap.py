"""A roadmap of the lanes and ramps: poses for smooth paths, and collision-free paths between them."""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from garage2usd.driving.car import DesignCar, Pose
from garage2usd.driving.obstacles import Obstacles
from garage2usd.driving.path import Path, Piece
from garage2usd.driving.proof import LanePose
from garage2usd.driving.road import DrivenRoad, Portal
from garage2usd.driving.turns import Steering, joining_pieces
from garage2usd.garage import Arc, LaneGraph, Point
from garage2usd.native import elementary

__all__ = ["GRAINS", "Grain", "Roadmap", "Spot"]

_MOST_EDGES = 4
"""Greatest number of lane edges that a path with two turns may span."""
_SAME_WAY = 0.999
_ROOM_KEPT_M = 0.2
_ROOM_TO_TURN_M = 0.1
_BESIDE_M = 0.8
"""Greatest width of the rectangle of poses from which a car may turn; metres."""
_DOOR_SPOTS_M, _DOOR_SPOT_M = 12.0, 2.0
"""Length inside a door that has roadmap poses, and their spacing; metres."""
_DIGITS = 4


class Spot(NamedTuple):
    """A pose of the roadmap: the middle of a lane node, or a point beside it, in line with a lane edge.

    Attributes
    ----------
    node
        Number of the lane node.
    along
        Direction of driving, a unit vector (x, z).
    aside_m, ahead_m
        Offset from the middle to the right and ahead.
    """

    node: int
    along: Point
    aside_m: float = 0.0
    ahead_m: float = 0.0


@dataclass(frozen=True, slots=True)
class Grain:
    """Density of the roadmap's poses.

    Attributes
    ----------
    asides
        Lateral offsets of poses on a lane, as shares of the room beside a car.
    is_fine
        True to add poses between the middles of squares.
    most_aside_m
        Greatest lateral offset.
    """

    asides: tuple[float, ...]
    is_fine: bool
    most_aside_m: float = 1.2


GRAINS = (
    Grain((0.0,), is_fine=False),
    Grain((0.0, 1.0, -1.0), is_fine=True),
    Grain((0.0, 1.0, -1.0), is_fine=True, most_aside_m=2.4),
)
"""Coarse, fine and wide roadmap: middles of squares only, with lateral and intermediate poses, and with such as far to
the side as cars swing out that turn back into the next aisle."""


class Roadmap:
    """Poses on the lanes of a garage and smooth paths between them; results are cached.

    Parameters
    ----------
    road
        The garage.
    standing
        Obstacles.
    car
        The car.
    steerings
        Steerings of the car, the most comfortable first.
    margin_m
        Clearance kept around the car.
    """

    def __init__(
        self, road: DrivenRoad, standing: Obstacles, car: DesignCar, steerings: Sequence[Steering], margin_m: float
    ) -> None:
        self._lanes = road.garage.lanes
        self._standing, self._car, self._steerings, self._margin_m = standing, car, tuple(steerings), margin_m
        self._known: dict[tuple[Pose, Pose], tuple[Piece, ...] | None] = {}

    @property
    def lanes(self) -> LaneGraph:
        """The garage's lane graph."""
        return self._lanes

    def edges_at(self, pose: Pose, edges: Iterable[Arc]) -> list[Arc]:
        """Return the lane edges, of some given ones, that a car is on and in line with."""
        x, z = _middle(self._car, pose)
        found = []
        for edge in edges:
            one = self._lanes.nodes[edge[0]].position
            along, length = self._along[edge]
            run = (x - one[0]) * along[0] + (z - one[1]) * along[1]
            aside = abs((x - one[0]) * along[1] - (z - one[1]) * along[0])
            far = length + self._lanes.nodes[edge[1]].reach_m(along)
            same = -elementary.sin(pose.yaw_rad) * along[0] - elementary.cos(pose.yaw_rad) * along[1]
            if same > _SAME_WAY and aside <= self._lanes.arcs[edge].width_m / 2 and -0.01 <= run <= far:  # noqa: PLR2004
                found.append(edge)
        return found

    def roomy_poses(self, edges: Iterable[Arc], *, is_back: bool) -> list[LanePose]:
        """Return rectangles of poses on lane edges with room to turn before the edge's end, or after its start.

        Notes
        -----
        The room is that of the tightest quarter turn; an edge too short for it has no rectangle. The whole edge counts
        where traffic may continue straight, or arrive straight.
        """
        tangent_m = float(abs(self._steerings[-1].chords(np.array([math.pi / 2]))[0])) / math.sqrt(2) + _ROOM_TO_TURN_M
        used = self._lanes.arriving if is_back else self._lanes.leaving
        poses = []
        for edge in edges:
            along, length_m = self._along[edge]
            is_straight = any(self._along[next_][0] == along for next_ in self._joins[is_back][edge] if next_ in used)
            low, high = 0.0, length_m
            if not is_straight:
                low, high = (tangent_m, high) if is_back else (low, high - tangent_m)
            if high < low:
                continue
            x, z = self._lanes.nodes[edge[0]].position
            ahead = (low + high) / 2 + self._car.length_m / 2 - self._car.rear_overhang_m
            room = min(_BESIDE_M, self._lanes.arcs[edge].width_m - self._car.width_m)
            if room >= 0:
                yaw = elementary.arctan2(-along[0] + 0.0, -along[1] + 0.0)
                poses.append(LanePose((x + ahead * along[0], z + ahead * along[1]), yaw, high - low, room))
        return poses

    @cached_property
    def _along(self) -> dict[Arc, tuple[Point, float]]:
        """Direction and length of each lane edge."""
        along = {}
        for edge in self._lanes.arcs:
            (x, z), (to_x, to_z) = (self._lanes.nodes[number].position for number in edge)
            length = math.hypot(to_x - x, to_z - z)
            along[edge] = (round((to_x - x) / length, _DIGITS) + 0.0, round((to_z - z) / length, _DIGITS) + 0.0), length
        return along

    @cached_property
    def _joins(self) -> tuple[dict[Arc, tuple[Arc, ...]], ...]:
        """Successors and predecessors of each lane edge, without U-turns and routes through a portal."""
        entering: dict[int, list[Arc]] = {}
        leaving: dict[int, list[Arc]] = {}
        for edge in self._lanes.arcs:
            leaving.setdefault(edge[0], []).append(edge)
            entering.setdefault(edge[1], []).append(edge)
        lanes = {number for number, node in enumerate(self._lanes.nodes) if not node.is_portal}

        def beside(edge: Arc, square: int, others: dict[int, list[Arc]]) -> tuple[Arc, ...]:
            return tuple(other for other in others.get(square, ()) if set(other) != set(edge) and square in lanes)

        return (
            {edge: beside(edge, edge[1], leaving) for edge in self._lanes.arcs},
            {edge: beside(edge, edge[0], entering) for edge in self._lanes.arcs},
        )

    def walks(self, first: Arc, *, is_back: bool) -> Iterator[list[Arc]]:
        """Yield walks over a few lane edges that begin with one edge, or end with it in a backward search."""
        waiting = [[first]]
        while waiting:
            walk = waiting.pop()
            yield walk
            if len(walk) < _MOST_EDGES:
                waiting += [[*walk, following] for following in self._joins[is_back][walk[-1]]]

    def is_straight(self, walk: Sequence[Arc]) -> bool:
        """Return True if a walk over lane edges has no turn."""
        return len({self._along[edge][0] for edge in walk}) == 1

    def spots(self, edge: Arc, grain: "Grain", *, is_back: bool) -> Iterator[tuple[Spot, Pose]]:
        """Yield the roadmap's poses on a lane edge and at its end, or at its start in a backward search."""
        room_m = min((self._lanes.arcs[edge].width_m - self._car.width_m) / 2 - _ROOM_KEPT_M, grain.most_aside_m)
        along, length_m = self._along[edge]
        for share in grain.asides:
            aside_m = round(share * max(room_m, 0.0), _DIGITS)
            yield self._placed(Spot(edge[0 if is_back else 1], along, aside_m))
            if grain.is_fine:
                yield self._placed(Spot(edge[0], along, aside_m, round(length_m / 2, _DIGITS)))

    def door_spots(self, portal: Portal) -> Iterator[tuple[Spot, Pose]]:
        """Yield roadmap poses in line with the pose of cars outside a portal, up to the middle of its square."""
        x, z = self._lanes.nodes[portal.node].position
        along = -elementary.sin(portal.pose.yaw_rad), -elementary.cos(portal.pose.yaw_rad)
        length_m = (portal.pose.x_m - x) * along[0] + (portal.pose.z_m - z) * along[1]
        for ahead_m in np.arange(0.0, min(abs(length_m), _DOOR_SPOTS_M), _DOOR_SPOT_M).tolist():
            yield self._placed(Spot(portal.node, along, 0.0, math.copysign(ahead_m, length_m)))

    def _placed(self, spot: Spot) -> tuple[Spot, Pose]:
        x, z = self._lanes.nodes[spot.node].position
        (along_x, along_z), aside_m, ahead_m = spot.along, spot.aside_m, spot.ahead_m
        yaw = elementary.arctan2(-along_x + 0.0, -along_z + 0.0)
        return spot, Pose(x + aside_m * -along_z + ahead_m * along_x, z + aside_m * along_x + ahead_m * along_z, yaw)

    def edges_from(self, spot: Spot, *, is_back: bool) -> list[Arc]:
        """Return the lane edges in line with a spot that start there, or that end there in a backward search."""
        at = 1 if is_back and not spot.ahead_m else 0
        return [edge for edge, (along, _) in self._along.items() if edge[at] == spot.node and along == spot.along]

    def middle_m(self, node: int) -> Point:
        """Return (x, z) of the middle of a lane node."""
        return self._lanes.nodes[node].position

    def joined(self, start: Pose, end: Pose) -> tuple[Piece, ...] | None:
        """Return a collision-free path between two poses with at most two turns."""
        key = (start, end)
        if key not in self._known:
            self._known[key] = next(self._clear(start, end), None)
        return self._known[key]

    def _clear(self, start: Pose, end: Pose) -> Iterator[tuple[Piece, ...]]:
        for steering in self._steerings:
            for pieces in joining_pieces(start, end, steering):
                if Path(start, pieces).clearance_m(self._car, self._standing) >= self._margin_m:
                    yield pieces


def _middle(car: DesignCar, pose: Pose) -> Point:
    """Return (x, z) of the middle of a car's footprint."""
    ahead = car.length_m / 2 - car.rear_overhang_m
    return pose.x_m - elementary.sin(pose.yaw_rad) * ahead, pose.z_m - elementary.cos(pose.yaw_rad) * ahead
