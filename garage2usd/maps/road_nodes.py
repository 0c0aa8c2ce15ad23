"""Lane nodes as nodes of the road network, with their openings, and reference lines of straights and arcs."""
# Over 300 lines: the openings of a node, and the lines that join them, share their geometry.

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.as_built import BuiltLevel
from garage2usd.as_built.driven_road import Mouth, portal_mouths
from garage2usd.driving import RampFloor
from garage2usd.garage import LaneGraph, LaneKind, LaneNode
from garage2usd.maps.frame import map_point
from garage2usd.native import elementary

Floats = NDArray[np.float64]
Point = tuple[float, float]
"""Point (x, y) in metres, in the frame of `garage2usd.maps.frame`."""
_LEAST_M = 1e-6
"""Length below which segments are omitted."""
_PARALLEL = 1e-9
OUTSIDE = -1
"""Number of the node beyond a portal's door."""
_MOST_INSET_M, _LEAST_INSET_M = 0.3, 0.05
"""Range of depths to which roads reach into a junction, so that adjacent junctions have a road between them."""
_OPPOSITE = -0.999
"""Cosine between the directions of two opposite openings."""
_JUNCTION = 3


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

    @property
    def mirrored(self) -> "Arc":
        """The arc with x reversed."""
        x, y = self.start
        return Arc((-x, y), math.pi - self.heading_rad, self.length_m, -self.curvature_per_m)

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

    def part(self, start_m: float, end_m: float) -> "ReferenceLine":
        """Return the reference line between two distances along it."""
        arcs, before_m = [], 0.0
        for arc in self.arcs:
            low_m, high_m = max(start_m - before_m, 0.0), min(end_m - before_m, arc.length_m)
            if high_m - low_m > _LEAST_M:
                x, y, heading = arc.at(low_m)
                arcs.append(Arc((x, y), heading, high_m - low_m, arc.curvature_per_m))
            before_m += arc.length_m
        return ReferenceLine(tuple(arcs))

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
    """Create the reference line of a road that turns at a corner, on the largest arc that touches both sides.

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


@dataclass(frozen=True)
class Opening:
    """An opening of a road node: a side across which cars drive.

    Attributes
    ----------
    towards
        Number of the node beyond the opening, or `OUTSIDE`.
    place
        Middle of the opening.
    outwards
        Unit vector out of the node.
    width_m
        Width of the carriageway.
    lets_in, lets_out
        True if traffic enters or leaves the node through the opening.
    inset_m
        Depth to which a road reaches into the node, if the node is a junction.
    """

    towards: int
    place: Point
    outwards: Point
    width_m: float
    lets_in: bool
    lets_out: bool
    inset_m: float

    @property
    def is_one_way(self) -> bool:
        """True if traffic crosses the opening in one direction only."""
        return self.lets_in != self.lets_out

    def inside(self, distance_m: float) -> Point:
        """Return the point on the opening's axis at a distance inside the node."""
        return self.place[0] - distance_m * self.outwards[0], self.place[1] - distance_m * self.outwards[1]


@dataclass(frozen=True, eq=False)
class RoadNode:
    """A lane node as a node of the road network.

    Attributes
    ----------
    number
        Number of the node.
    name
        Row and column.
    middle
        Middle of the node.
    openings
        Openings to neighbours ordered by number, the one to the outside last.
    ramp
        Floor of the ramp beyond a portal's ground; None without a ramp.
    outside_m
        Distance from the portal to the top of its ramp.
    """

    number: int
    name: str
    middle: Point
    openings: tuple[Opening, ...]
    ramp: RampFloor | None = None
    outside_m: float = 0.0

    @property
    def is_junction(self) -> bool:
        """True if three or more roads meet in the node."""
        return len(self.openings) >= _JUNCTION

    @property
    def is_portal(self) -> bool:
        """True if the node opens to the outside."""
        return any(opening.towards == OUTSIDE for opening in self.openings)

    @property
    def mirrored(self) -> "RoadNode":
        """The node with x reversed."""
        openings = (
            replace(each, place=(-each.place[0], each.place[1]), outwards=(-each.outwards[0], each.outwards[1]))
            for each in self.openings
        )
        return replace(self, middle=(-self.middle[0], self.middle[1]), openings=tuple(openings))

    def opening(self, towards: int) -> Opening:
        """Return the opening of the node to a neighbour."""
        return next(opening for opening in self.openings if opening.towards == towards)

    def far_from(self, opening: Opening) -> Opening | None:
        """Return the opening opposite to another; None if there is none."""
        facing = (other for other in self.openings if _cosine(other.outwards, opening.outwards) < _OPPOSITE)
        return next(facing, None)

    def end_opposite(self, opening: Opening) -> Point:
        """Return the end point of a dead end entered through an opening, as far from the middle as the opening."""
        return opening.inside(2 * math.dist(opening.place, self.middle))


def road_nodes(level: BuiltLevel) -> tuple[RoadNode, ...]:
    """Create a road node for each lane node and portal, in order."""
    mouths = {mouth.number: mouth for mouth in portal_mouths(level)}
    found = []
    for number, node in enumerate(level.lanes.nodes):
        openings, mouth = tuple(_to_neighbours(level.lanes, number)), mouths.get(number)
        # a door that opens onto a lane leads nowhere
        if mouth is None or any(_cosine(way.outwards, map_point(mouth.outwards)) > -_OPPOSITE for way in openings):
            found.append(RoadNode(number, node.name, map_point(node.position), openings))
        else:
            openings = (*openings, _to_outside(node, mouth))
            outside_m = mouth.top_m(node.position) - mouth.edge_m
            found.append(RoadNode(number, node.name, map_point(node.position), openings, mouth.ramp, outside_m))
    return tuple(found)


def _to_neighbours(lanes: LaneGraph, number: int) -> Iterator[Opening]:
    """Yield openings to neighbours; the columns stand back equally on both sides of an opening."""
    node, middle = lanes.nodes[number], map_point(lanes.nodes[number].position)
    for other in sorted({*lanes.beside[number]} - {number}):
        beyond = lanes.nodes[other]
        way = map_point(beyond.position)
        apart_m = math.dist(middle, way)
        if apart_m == 0:
            continue
        outwards = (way[0] - middle[0]) / apart_m, (way[1] - middle[1]) / apart_m
        axis = 0 if abs(outwards[0]) > abs(outwards[1]) else 1
        clear_m, clear_beyond_m = node.widths_m[axis] / 2, beyond.widths_m[axis] / 2
        setback_m = (apart_m - clear_m - clear_beyond_m) / 2
        half_m, inset_m = clear_m + setback_m, min(_MOST_INSET_M, max(_LEAST_INSET_M, setback_m / 2))
        place = middle[0] + half_m * outwards[0], middle[1] + half_m * outwards[1]
        in_, out = lanes.arcs.get((other, number)), lanes.arcs.get((number, other))
        # inside, cars leave by an exit and come from an entrance
        lets_in = in_ is not None and beyond.kind != LaneKind.EXIT and node.kind != LaneKind.ENTRANCE
        lets_out = out is not None and node.kind != LaneKind.EXIT and beyond.kind != LaneKind.ENTRANCE
        edge = in_ or out
        if edge is not None and (lets_in or lets_out):
            yield Opening(other, place, outwards, edge.width_m, lets_in, lets_out, inset_m)


def _to_outside(node: LaneNode, mouth: Mouth) -> Opening:
    middle, outwards = map_point(node.position), map_point(mouth.outwards)
    place = middle[0] + mouth.edge_m * outwards[0], middle[1] + mouth.edge_m * outwards[1]
    is_entrance = node.kind == LaneKind.ENTRANCE
    return Opening(OUTSIDE, place, outwards, mouth.width_m, is_entrance, not is_entrance, _MOST_INSET_M)


def _cosine(one: Point, other: Point) -> float:
    return one[0] * other[0] + one[1] * other[1]
