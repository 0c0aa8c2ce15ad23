"""The middle line of a ramp along any line of straights, with its corners rounded."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from garage2usd.garage.ramp_lines import CoilPlaces

Floats = NDArray[np.float64]
Point = tuple[float, float]
_STEP_RAD = math.pi / 36
_STRAIGHT_RAD = math.radians(1.0)
_LEAST_STEP_M = 0.05
_LEAD_M = 4.0
"""Length in metres of the straights at the ends of a line that corners leave."""
_DIGITS = 4


@dataclass(frozen=True)
class PathLine:
    """A line through points (u, v), as `CoilLine` one of straights and arcs.

    Attributes
    ----------
    points
        Two or more points, at least 5 cm apart.
    width_m
        Width between the walls.
    """

    points: tuple[Point, ...]
    width_m: float

    @classmethod
    def rounded(cls, corners: Sequence[Point], width_m: float, radius_m: float) -> "PathLine":
        """Return the line through corners that are rounded, by a smaller radius where the straights are short."""
        room_m = [math.dist(one, other) / 2 for one, other in pairwise(corners)]
        for end in (0, -1):  # the straights at the ends belong to one corner each
            room_m[end] = max(room_m[end], 2 * room_m[end] - _LEAD_M)
        points = [corners[0]]
        for number, corner in enumerate(corners[1:-1], 1):
            before, after = corners[number - 1], corners[number + 1]
            heading = math.atan2(corner[1] - before[1], corner[0] - before[0])
            turn = math.remainder(math.atan2(after[1] - corner[1], after[0] - corner[0]) - heading, math.tau)
            if abs(turn) < _STRAIGHT_RAD or abs(turn) > math.pi - _STRAIGHT_RAD:
                points.append(corner)
                continue
            half = math.tan(abs(turn) / 2)
            reach_m = min(radius_m * half, room_m[number - 1], room_m[number])
            radius, steps = reach_m / half, max(2, math.ceil(abs(turn) / _STEP_RAD))
            start = corner[0] - reach_m * math.cos(heading), corner[1] - reach_m * math.sin(heading)
            side = math.copysign(math.pi / 2, turn)
            middle = start[0] + radius * math.cos(heading + side), start[1] + radius * math.sin(heading + side)
            for step in range(steps + 1):
                at = heading - side + turn * step / steps
                points.append((middle[0] + radius * math.cos(at), middle[1] + radius * math.sin(at)))
        return cls.through([*points, corners[-1]], width_m)

    @classmethod
    def through(cls, points: Sequence[Point], width_m: float) -> "PathLine":
        """Return the line through points, of which those close to the one before are left out."""
        kept = [points[0]]
        for point in points[1:-1]:
            if min(math.dist(point, kept[-1]), math.dist(point, points[-1])) >= _LEAST_STEP_M:
                kept.append(point)
        return cls(tuple((round(u, _DIGITS), round(v, _DIGITS)) for u, v in [*kept, points[-1]]), width_m)

    @cached_property
    def line(self) -> shapely.LineString:
        """The line as geometry."""
        return shapely.LineString(self.points)

    @cached_property
    def _runs(self) -> Floats:
        steps = np.diff(np.array(self.points), axis=0)
        return np.concatenate([[0.0], np.cumsum(np.hypot(steps[:, 0], steps[:, 1]))])

    @cached_property
    def _ways(self) -> Floats:
        """Unit vectors along the line at its points, in the middle between both directions at a corner."""
        steps = np.diff(np.array(self.points), axis=0)
        steps /= np.hypot(steps[:, 0], steps[:, 1])[:, None]
        ways = np.concatenate([steps[:1], steps[:-1] + steps[1:], steps[-1:]])
        found: Floats = ways / np.hypot(ways[:, 0], ways[:, 1])[:, None]
        return found

    @property
    def length_m(self) -> float:
        """Length of the line, as seen from above."""
        return float(self._runs[-1])

    @property
    def is_straight(self) -> bool:
        """True if it does not turn."""
        (u, v), (end_u, end_v) = self._ways[0], self._ways[-1]
        return bool(np.all(self._ways @ np.array([u, v]) > math.cos(_STRAIGHT_RAD)) and u * end_u + v * end_v > 0)

    @property
    def straight_m(self) -> float:
        """Length of the straight at its beginning."""
        steps = np.diff(np.array(self.points), axis=0)
        across = (steps[:, 0] * steps[0, 1] - steps[:, 1] * steps[0, 0]) / np.hypot(*steps.T) / np.hypot(*steps[0])
        turned = np.flatnonzero(np.abs(across) > math.sin(_STRAIGHT_RAD))
        return float(self._runs[turned[0]]) if len(turned) else self.length_m

    def at(self, run_m: ArrayLike) -> CoilPlaces:
        """Return the places at distances along the line, shape (n,)."""
        points, run = np.array(self.points), np.asarray(run_m, dtype=np.float64)
        u, v, along_u, along_v = (np.interp(run, self._runs, values) for values in (*points.T, *self._ways.T))
        size = np.hypot(along_u, along_v)
        return CoilPlaces(u, v, along_u / size, along_v / size)

    def foot(self, u_m: ArrayLike, v_m: ArrayLike) -> tuple[Floats, Floats]:
        """Project points onto the line: distances along it, and offsets towards its turn from u to v."""
        u, v = np.asarray(u_m, dtype=np.float64), np.asarray(v_m, dtype=np.float64)
        runs: Floats = shapely.line_locate_point(self.line, shapely.points(u, v))
        places = self.at(runs)
        return runs, (v - places.v_m) * places.along_u - (u - places.u_m) * places.along_v

    def stations_m(self, profile: tuple[Point, ...]) -> Floats:
        """Return distances along the line at which it is cut into flat pieces: its corners and changes of slope."""
        cuts = np.unique(np.round(np.concatenate([self._runs, [run for run, _ in profile]]), _DIGITS))
        ends = np.array([0.0, self.length_m])
        inner = cuts[(cuts > _LEAST_STEP_M) & (cuts < self.length_m - _LEAST_STEP_M)]
        return np.concatenate([ends[:1], inner, ends[1:]])

    def beside(self, aside_m: float, width_m: float) -> "PathLine":
        """Return the parallel line at a distance towards its turn from u to v, with a width of its own."""
        corners = self.at(self._runs).beside(aside_m).tolist()
        return PathLine.through([(u, v) for u, v in corners], width_m)

    def between(self, start_m: float, end_m: float) -> "PathLine":
        """Return the part of the line between two distances along it."""
        inner = [point for point, run in zip(self.points, self._runs.tolist(), strict=True) if start_m < run < end_m]
        ends = self.at([start_m, end_m])
        start, end = zip(ends.u_m.tolist(), ends.v_m.tolist(), strict=True)
        return PathLine.through([start, *inner, end], self.width_m)

    def turned(self) -> "PathLine":
        """Return the line in the other direction."""
        return PathLine(self.points[::-1], self.width_m)

    def ground(self, start_m: float, end_m: float, sides_m: tuple[float, float]) -> shapely.Geometry:
        """Return the ground between two distances along the line, up to distances on both sides.

        The first side lies towards a turn from u to v. In a plan (x, z) with z downwards, it is the right one.
        """
        runs = np.concatenate([[start_m], self._runs[(self._runs > start_m) & (self._runs < end_m)], [end_m]])
        places = self.at(runs)
        one, other = places.beside(sides_m[0]), places.beside(-sides_m[1])
        corners = np.stack([one[:-1], one[1:], other[1:], other[:-1]], axis=1)
        return shapely.union_all(shapely.make_valid(shapely.polygons(corners)), grid_size=10.0**-_DIGITS)
