"""Reference lines of roads: sequences of straights and arcs."""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.native import elementary

__all__ = ["Arc", "Point", "ReferenceLine", "straight", "turn"]

Floats = NDArray[np.float64]
Point = tuple[float, float]
"""Point (x, y) in metres, in the frame of `garage2usd.maps.frame`."""
_LEAST_M = 1e-6
"""Length below which segments are omitted."""
_PARALLEL = 1e-9


class Arc(NamedTuple):
    """A segment of constant curvature of a reference line.

    Attributes
    ----------
    start
        Start point.
    heading_rad
        Heading at the start, counter-clockwise from x.
    length_m
        Length of the segment.
    curvature_per_m
        1 / radius, to the left; 0 for a straight.
    """

    start: Point
    heading_rad: float
    length_m: float
    curvature_per_m: float = 0.0

    def at(self, run_m: float) -> tuple[float, float, float]:
        """Evaluate (x, y, heading) at a distance along the arc; a straight extends beyond both ends."""
        (x, y), heading, curvature = self.start, self.heading_rad, self.curvature_per_m
        if curvature == 0.0:
            return x + run_m * elementary.cos(heading), y + run_m * elementary.sin(heading), heading
        turned = heading + curvature * run_m
        return (
            x + (elementary.sin(turned) - elementary.sin(heading)) / curvature,
            y - (elementary.cos(turned) - elementary.cos(heading)) / curvature,
            turned,
        )

    def beside_each(self, run_m: Floats, t_m: Floats) -> Floats:
        """Evaluate points (x, y) at distances along the arc and offsets to its left; shape (n, 2)."""
        (x, y), heading, curvature = self.start, self.heading_rad, self.curvature_per_m
        turned = heading + curvature * run_m
        cos, sin = elementary.cos(turned), elementary.sin(turned)
        if curvature == 0.0:
            return np.stack([x + run_m * cos - t_m * sin, y + run_m * sin + t_m * cos], axis=1)
        radius_m = 1 / curvature
        middle = x - radius_m * elementary.sin(heading), y + radius_m * elementary.cos(heading)
        return np.stack([middle[0] + (radius_m - t_m) * sin, middle[1] - (radius_m - t_m) * cos], axis=1)


@dataclass(frozen=True)
class ReferenceLine:
    """A smooth reference line of a road.

    Attributes
    ----------
    arcs
        Segments in order; each continues the previous one in position and heading.
    """

    arcs: tuple[Arc, ...]

    @cached_property
    def length_m(self) -> float:
        """Length of the reference line."""
        return sum(arc.length_m for arc in self.arcs)

    @property
    def is_straight(self) -> bool:
        """True if the reference line is a single straight."""
        return len(self.arcs) == 1 and self.arcs[0].curvature_per_m == 0.0

    def at(self, s_m: float) -> tuple[float, float, float]:
        """Evaluate (x, y, heading) at a distance along the reference line; the end segments extend beyond both ends."""
        for arc in self.arcs[:-1]:
            if s_m <= arc.length_m:
                return arc.at(s_m)
            s_m -= arc.length_m
        return self.arcs[-1].at(s_m)

    def beside(self, s_m: float, t_m: float) -> Point:
        """Evaluate the point (x, y) at a distance along the reference line and an offset to its left."""
        x, y, heading = self.at(s_m)
        return x - t_m * elementary.sin(heading), y + t_m * elementary.cos(heading)

    def beside_each(self, s_m: Floats, t_m: Floats) -> Floats:
        """Evaluate points (x, y) at distances along the reference line and offsets to its left; shape (n, 2)."""
        ends = np.cumsum([arc.length_m for arc in self.arcs[:-1]])
        number = np.searchsorted(ends, s_m)
        points = np.empty((len(s_m), 2))
        for index, arc in enumerate(self.arcs):
            here = number == index
            points[here] = arc.beside_each(s_m[here] - (ends[index - 1] if index else 0.0), t_m[here])
        return points

    def foot(self, point: Point) -> tuple[float, float]:
        """Project a point onto a straight reference line as (s, t); s may lie beyond its ends.

        Raises
        ------
        ValueError
            If the line is not a single straight.
        """
        if not self.is_straight:
            raise ValueError("a line that bends")
        (arc,) = self.arcs
        dx, dy = point[0] - arc.start[0], point[1] - arc.start[1]
        cos, sin = elementary.cos(arc.heading_rad), elementary.sin(arc.heading_rad)
        return dx * cos + dy * sin, dy * cos - dx * sin


def straight(start: Point, end: Point) -> ReferenceLine:
    """Return the straight reference line between two points."""
    return ReferenceLine((Arc(start, _heading(start, end), math.dist(start, end)),))


def turn(start: Point, corner: Point, end: Point) -> ReferenceLine:
    """Create a reference line that turns at a corner, on the largest arc that touches both sides.

    If the three points are collinear, the line is a single straight.
    """
    before_m, after_m = math.dist(start, corner), math.dist(corner, end)
    inwards, outwards = _heading(start, corner), _heading(corner, end)
    turned = math.remainder(outwards - inwards, math.tau)
    if abs(turned) < _PARALLEL:
        return straight(start, end)
    tangent_m = min(before_m, after_m)
    curvature = elementary.tan(turned / 2) / tangent_m
    lead = Arc(start, inwards, before_m - tangent_m)
    bend = Arc(lead.at(lead.length_m)[:2], inwards, turned / curvature, curvature)
    tail = Arc(bend.at(bend.length_m)[:2], outwards, after_m - tangent_m)
    return ReferenceLine(tuple(arc for arc in (lead, bend, tail) if arc.length_m > _LEAST_M))


def _heading(start: Point, end: Point) -> float:
    return elementary.arctan2(end[1] - start[1], end[0] - start[0])
