"""Where cars drive in which direction: the lane poses that a way to a stall begins at, and a way out of it ends at."""

import math
from collections import deque
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from enum import Enum, auto
from functools import cached_property

from garage2usd.driving.car import DesignCar, Point
from garage2usd.driving.proof import LanePose

__all__ = ["DirectedEdge", "LaneDirections", "LaneSquare", "SquareUse", "families"]

DirectedEdge = tuple[int, int]
"""From the middle of one square to the middle of the next, by their numbers."""
_NEAR_EDGES = 2
_SHORTEST_M = 1e-3
_QUARTER = math.pi / 2
_ASKEW_RAD, _SAME_RAD = 1e-4, 1e-9


class SquareUse(Enum):
    """What cars do on a square."""

    LANE = auto()
    ENTRANCE = auto()
    EXIT = auto()


@dataclass(frozen=True, slots=True)
class LaneSquare:
    """A square of a lane, or a portal.

    Attributes
    ----------
    middle_m
        (x, z) of its middle.
    sides_m
        Its extents along X and Z.
    use
        Whether it is a lane, an entrance or an exit.
    """

    middle_m: Point
    sides_m: tuple[float, float]
    use: SquareUse = SquareUse.LANE


@dataclass(frozen=True, eq=False)
class LaneDirections:
    """Lanes by direction, and which of them lie on a way from an entrance or to an exit.

    All ways are driven forward, and no car turns round on a lane.

    Attributes
    ----------
    squares
        Lanes and portals; their numbers are their places.
    widths_m
        Width of the carriageway of each edge in each direction that it is driven in.
    backing
        Edges that lead into a dead end that cars may back out of.
    """

    squares: tuple[LaneSquare, ...]
    widths_m: Mapping[DirectedEdge, float]
    backing: frozenset[DirectedEdge] = frozenset()

    @cached_property
    def arriving(self) -> frozenset[DirectedEdge]:
        """Edges that cars come to from an entrance."""
        return self._spread(self._onward, SquareUse.ENTRANCE)

    @cached_property
    def leaving(self) -> frozenset[DirectedEdge]:
        """Edges that lead on to an exit."""
        return frozenset((one, other) for other, one in self._spread(self._backward, SquareUse.EXIT))

    def near(self, square: int) -> list[DirectedEdge]:
        """The edges in all their directions that are at most two squares from one, the nearest first."""
        steps = {square: 0}
        waiting = deque([square])
        while waiting:
            one = waiting.popleft()
            for other in (*self._onward[one], *self._backward[one]) if steps[one] < _NEAR_EDGES else ():
                if other not in steps:
                    steps[other] = steps[one] + 1
                    waiting.append(other)
        edges = [(one, other) for one in steps for other in self._onward[one] if other in steps]
        return sorted(edges, key=lambda edge: (steps[edge[0]] + steps[edge[1]], edge))

    def poses(self, edges: Iterable[DirectedEdge], car: DesignCar) -> list[LanePose]:
        """Where a car may be in line with some edges, its middle on the edge and its body within the carriageway."""
        poses = (self._pose(edge, car) for edge in edges)
        return [pose for pose in poses if pose is not None and min(pose.length_m, pose.width_m) >= 0]

    @cached_property
    def _onward(self) -> tuple[tuple[int, ...], ...]:
        return self._ways(self.widths_m)

    @cached_property
    def _backward(self) -> tuple[tuple[int, ...], ...]:
        return self._ways((other, one) for one, other in self.widths_m)

    def _ways(self, edges: Iterable[DirectedEdge]) -> tuple[tuple[int, ...], ...]:
        ways: list[list[int]] = [[] for _ in self.squares]
        for one, other in edges:
            ways[one].append(other)
        return tuple(map(tuple, ways))

    def _spread(self, ways: tuple[tuple[int, ...], ...], use: SquareUse) -> frozenset[DirectedEdge]:
        """The edges off the portals of a use, and those that follow them without turning round or through a portal."""
        starts = [number for number, square in enumerate(self.squares) if square.use is use]
        reached = {(start, other) for start in starts for other in ways[start]}
        waiting = deque(reached)
        while waiting:
            one, other = waiting.popleft()
            if self.squares[other].use is not SquareUse.LANE:
                continue
            for beyond in ways[other]:
                if beyond != one and (other, beyond) not in reached:
                    reached.add((other, beyond))
                    waiting.append((other, beyond))
        return frozenset(reached)

    def _pose(self, edge: DirectedEdge, car: DesignCar) -> LanePose | None:
        """Along the middle line, and as far as the car stays within both squares."""
        start, end = (self.squares[number] for number in edge)
        way = end.middle_m[0] - start.middle_m[0], end.middle_m[1] - start.middle_m[1]
        length = math.hypot(*way)
        if length < _SHORTEST_M:
            return None
        along = way[0] / length, way[1] / length
        behind, beyond = (
            (abs(along[0]) * square.sides_m[0] + abs(along[1]) * square.sides_m[1]) / 2 for square in (start, end)
        )
        low = max(0.0, car.length_m / 2 - behind)
        high = min(length, length + beyond - car.length_m / 2)
        middle = (low + high) / 2
        place = start.middle_m[0] + along[0] * middle, start.middle_m[1] + along[1] * middle
        return LanePose(place, _yaw_rad(along), high - low, self.widths_m[edge] - car.width_m)


def families(poses: Iterable[LanePose]) -> list[list[LanePose]]:
    """Poses whose directions differ by quarter turns, but for rounding, together; their directions then do exactly."""
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
    """Yaw of a direction; without the sign of zeros, so that a direction has one yaw."""
    return math.atan2(-along[0] + 0.0, -along[1] + 0.0)
