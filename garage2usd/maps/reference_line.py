"""Reference lines of roads: straights and arcs, one after the other."""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Arc", "Point", "ReferenceLine", "straight", "turn"]

Floats = NDArray[np.float64]
Point = tuple[float, float]
"""(x, y) in metres, in the frame of `garage2usd.maps.frame`."""
_LEAST_M = 1e-6
"""What is shorter is left out."""
_PARALLEL = 1e-9


class Arc(NamedTuple):
    """A stretch of constant curvature.

    Attributes
    ----------
    start
        Where it begins.
    heading_rad
        There, counter-clockwise from x.
    length_m
        Along it.
    curvature_per_m
        1 / radius, to the left; 0 for a straight.
    """

    start: Point
    heading_rad: float
    length_m: float
    curvature_per_m: float = 0.0

    def at(self, run_m: float) -> tuple[float, float, float]:
        """(x, y, heading) after a run along it; a straight goes on at both ends."""
        (x, y), heading, curvature = self.start, self.heading_rad, self.curvature_per_m
        if curvature == 0.0:
            return x + run_m * math.cos(heading), y + run_m * math.sin(heading), heading
        turned = heading + curvature * run_m
        return (
            x + (math.sin(turned) - math.sin(heading)) / curvature,
            y - (math.cos(turned) - math.cos(heading)) / curvature,
            turned,
        )

    def beside_each(self, run_m: Floats, t_m: Floats) -> Floats:
        """(x, y) after runs along it and at distances to its left; shape (n, 2)."""
        (x, y), heading, curvature = self.start, self.heading_rad, self.curvature_per_m
        turned = heading + curvature * run_m
        cos, sin = np.cos(turned), np.sin(turned)
        if curvature == 0.0:
            return np.stack([x + run_m * cos - t_m * sin, y + run_m * sin + t_m * cos], axis=1)
        radius_m = 1 / curvature
        middle = x - radius_m * math.sin(heading), y + radius_m * math.cos(heading)
        return np.stack([middle[0] + (radius_m - t_m) * sin, middle[1] - (radius_m - t_m) * cos], axis=1)


@dataclass(frozen=True)
class ReferenceLine:
    """A line without kinks.

    Attributes
    ----------
    arcs
        Its stretches in order; each begins where the one before it ends, in its direction.
    """

    arcs: tuple[Arc, ...]

    @cached_property
    def length_m(self) -> float:
        """Along it."""
        return sum(arc.length_m for arc in self.arcs)

    @property
    def is_straight(self) -> bool:
        """Whether it is one straight."""
        return len(self.arcs) == 1 and self.arcs[0].curvature_per_m == 0.0

    def at(self, s_m: float) -> tuple[float, float, float]:
        """(x, y, heading) at a length along it; beyond its ends as its first or last stretch goes on."""
        for arc in self.arcs[:-1]:
            if s_m <= arc.length_m:
                return arc.at(s_m)
            s_m -= arc.length_m
        return self.arcs[-1].at(s_m)

    def beside(self, s_m: float, t_m: float) -> Point:
        """(x, y) at a length along it and a distance to its left."""
        x, y, heading = self.at(s_m)
        return x - t_m * math.sin(heading), y + t_m * math.cos(heading)

    def beside_each(self, s_m: Floats, t_m: Floats) -> Floats:
        """(x, y) at lengths along it and distances to its left; shape (n, 2)."""
        ends = np.cumsum([arc.length_m for arc in self.arcs[:-1]])
        number = np.searchsorted(ends, s_m)
        points = np.empty((len(s_m), 2))
        for index, arc in enumerate(self.arcs):
            here = number == index
            points[here] = arc.beside_each(s_m[here] - (ends[index - 1] if index else 0.0), t_m[here])
        return points

    def foot(self, point: Point) -> tuple[float, float]:
        """(s, t) of a point: how far along a straight line, and how far to its left; s may lie beyond its ends.

        Raises
        ------
        ValueError
            If the line is not one straight.
        """
        if not self.is_straight:
            raise ValueError("a line that bends")
        (arc,) = self.arcs
        dx, dy = point[0] - arc.start[0], point[1] - arc.start[1]
        cos, sin = math.cos(arc.heading_rad), math.sin(arc.heading_rad)
        return dx * cos + dy * sin, dy * cos - dx * sin


def straight(start: Point, end: Point) -> ReferenceLine:
    """The straight from a point to another."""
    return ReferenceLine((Arc(start, _heading(start, end), math.dist(start, end)),))


def turn(start: Point, corner: Point, end: Point) -> ReferenceLine:
    """From a point towards a corner, round it on the largest arc that touches both sides, and on to a point.

    Where the corner lies between the two in line with them, this is one straight.
    """
    before_m, after_m = math.dist(start, corner), math.dist(corner, end)
    inwards, outwards = _heading(start, corner), _heading(corner, end)
    turned = math.remainder(outwards - inwards, math.tau)
    if abs(turned) < _PARALLEL:
        return straight(start, end)
    tangent_m = min(before_m, after_m)
    curvature = math.tan(turned / 2) / tangent_m
    lead = Arc(start, inwards, before_m - tangent_m)
    bend = Arc(lead.at(lead.length_m)[:2], inwards, turned / curvature, curvature)
    tail = Arc(bend.at(bend.length_m)[:2], outwards, after_m - tangent_m)
    return ReferenceLine(tuple(arc for arc in (lead, bend, tail) if arc.length_m > _LEAST_M))


def _heading(start: Point, end: Point) -> float:
    return math.atan2(end[1] - start[1], end[0] - start[0])
