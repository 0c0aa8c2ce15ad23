"""Rules of aisles: their clear width, that nothing stands on them, and long dead ends."""

import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np
import shapely

from garage2usd.checks.rule import ROUNDING_M, Miss, RuleBook
from garage2usd.checks.solids import Solid
from garage2usd.checks.subject import Subject
from garage2usd.layout import StallUse
from garage2usd.profiles import Profile
from garage2usd.reading.ground import Point
from garage2usd.structure.dead_ends import walk_back
from garage2usd.structure.lane_graph import LaneEdge

__all__ = ["BOOK", "dead_ends", "edge_name"]

BOOK = RuleBook()
_BUILDING = {"column", "wall", "obstacle"}
_MAY_STAND_ON_LANES = {"speed_bump", "barrier", "vehicle_door", "ramp", *_BUILDING}
_RIGHT_ANGLE_COS = 0.1
_TOUCH_M = 0.01


class _Way:
    """The ground of a lane graph's edge, in metres along and across its middle line."""

    def __init__(self, subject: Subject, edge: LaneEdge) -> None:
        self.start, self.end = (np.array(subject.nodes[node].position) for node in (edge.start, edge.end))
        self.length = math.dist(self.start, self.end)
        self.along = (self.end - self.start) / (self.length or 1.0)
        self.across = np.array([-self.along[1], self.along[0]])

    def strip(self, half_width_m: float) -> shapely.Polygon:
        """Its ground as far as a distance on both sides."""
        side = self.across * half_width_m
        return shapely.Polygon([self.start + side, self.end + side, self.end - side, self.start - side])

    @property
    def middle(self) -> Point:
        """The middle of its line."""
        x, z = ((self.start + self.end) / 2).tolist()
        return x, z

    def reach(self, shape: shapely.Geometry) -> tuple[float, float]:
        """Least and greatest distance across the line of a shape."""
        across = (shapely.get_coordinates(shape) - self.start) @ self.across
        return float(across.min()), float(across.max())


@BOOK.rule(
    "aisle-width", "aisle_width", asks="an aisle with stalls at right angles to it is wide enough between what stands"
)
def _width(subject: Subject, profile: Profile) -> Iterator[Miss]:
    if profile.aisle_width is None:
        return
    required = profile.aisle_width.amount
    for edge in _serving_edges(subject):
        way = _Way(subject, edge)
        measured, narrowed_by = _clear_width(subject, way, edge.width_m)
        if measured < required - ROUNDING_M:
            reason = f"; {narrowed_by} stands in it" if narrowed_by else ""
            things = (narrowed_by,) if narrowed_by else ()
            message = f"the aisle is too narrow{reason}"
            yield Miss(edge_name(subject, edge), way.middle, message, measured, required, things)


@BOOK.rule("lane-blocked", asks="nothing stands on a lane")
def _blocked(subject: Subject, _: Profile) -> Iterator[Miss]:
    seen: set[str] = set()
    for edge in subject.edges:
        way = _Way(subject, edge)
        for solid in subject.solids.at(way.strip(max(edge.width_m / 2 - _TOUCH_M, _TOUCH_M))):
            if solid.label in _MAY_STAND_ON_LANES or solid.name in seen or _is_parked(solid, subject):
                continue
            seen.add(solid.name)
            message = f"a {solid.kind} stands on the lane {edge_name(subject, edge)}"
            yield Miss(solid.name, solid.centre, message, things=(solid.name,))


def _is_parked(solid: Solid, subject: Subject) -> bool:
    return solid.label == "car" and subject.stall_grounds.home_of(solid.footprint) is not None


def _serving_edges(subject: Subject) -> list[LaneEdge]:
    """The ways between lanes that cars turn off into a stall beside them."""
    outwards: dict[int, list[Point]] = {}
    for stall in subject.parking_stalls:
        outwards.setdefault(stall.access, []).append(stall.outwards)
    serving = []
    for edge in subject.edges:
        if any(subject.nodes[node].is_portal for node in (edge.start, edge.end)):
            continue
        along = _Way(subject, edge).along
        turns = (turn for node in (edge.start, edge.end) for turn in outwards.get(node, ()))
        if any(abs(float(along @ np.array(turn))) < _RIGHT_ANGLE_COS for turn in turns):
            serving.append(edge)
    return serving


def _clear_width(subject: Subject, way: _Way, carriageway_m: float) -> tuple[float, str]:
    """Free width across a way, as told and as the columns, walls and cores in it leave, and what narrows it most."""
    half = carriageway_m / 2
    strip = way.strip(half)
    left, right, narrowest = half, half, ""
    for solid in subject.solids.at(strip):
        if solid.label not in _BUILDING:
            continue
        low, high = way.reach(solid.footprint.intersection(strip))
        if high < 0 and -high < left:
            left, narrowest = -high, solid.name
        elif low > 0 and low < right:
            right, narrowest = low, solid.name
        elif low <= 0 <= high:
            # cars pass on the wider side of what stands in the middle
            left, right, narrowest = max(half + low, half - high), 0.0, solid.name
    return max(left + right, 0.0), narrowest


@BOOK.rule("dead-end", "dead_end_length", asks="a long dead-end aisle keeps a turning stall free")
def _dead_ends(subject: Subject, profile: Profile) -> Iterator[Miss]:
    if profile.dead_end_length is None:
        return
    for squares, length in dead_ends(subject):
        if length <= profile.dead_end_length.amount + ROUNDING_M:
            continue
        uses = {stall.use for stall in subject.stalls if stall.access in squares}
        if uses and StallUse.TURNING not in uses:
            node = subject.nodes[squares[0]]
            message = "the dead-end aisle is too long without a stall kept free for turning"
            yield Miss(node.name, node.position, message, length, profile.dead_end_length.amount)


def dead_ends(subject: Subject) -> Iterator[tuple[list[int], float]]:
    """The lanes of each dead end from its tip on, and their length in metres from border to border."""
    nodes, beside = subject.nodes, subject.beside

    def side_m(node: int, other: int) -> float:
        """Metres between the columns at a node along the aisle to another."""
        (x, _), (other_x, _) = nodes[node].position, nodes[other].position
        return nodes[node].widths_m[int(abs(x - other_x) < ROUNDING_M)]

    for tip in range(len(nodes)):
        if nodes[tip].is_portal or len(beside[tip]) > 1:
            continue
        lanes, end = walk_back(tip, beside.__getitem__, lambda node: not nodes[node].is_portal)
        way = lanes if end is None else [*lanes, end]
        length_m = sum(math.dist(nodes[one].position, nodes[other].position) for one, other in pairwise(way))
        tip_m = side_m(tip, beside[tip][0]) if beside[tip] else max(nodes[tip].widths_m)
        yield lanes, length_m + (tip_m if end is None else (tip_m - side_m(end, lanes[-1])) / 2)


def edge_name(subject: Subject, edge: LaneEdge) -> str:
    """A way by the names of its ends."""
    return f"{subject.nodes[edge.start].name}-{subject.nodes[edge.end].name}"
