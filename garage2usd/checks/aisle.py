"""Rules of aisles: clear width, obstacles on lanes, and long dead ends."""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.as_built.level import BuiltLevel
from garage2usd.checks.rule import ROUNDING_M, Miss, RuleBook
from garage2usd.garage import LaneEdge, Point, Stall, StallKind, StallUse
from garage2usd.objects import CAR_LABELS
from garage2usd.profiles import Profile, Severity

BOOK = RuleBook()
_BUILDING = {"column", "wall", "obstacle"}
_MAY_STAND_ON_LANES = {"speed_bump", "barrier", "vehicle_door", "ramp", *_BUILDING}
_RIGHT_ANGLE_COS = 0.1
_TOUCH_M = 0.01


class _Way:
    """The ground of a lane edge, in metres along and across its centre line."""

    def __init__(self, level: BuiltLevel, edge: LaneEdge) -> None:
        self.start, self.end = (np.array(level.lanes.nodes[node].position) for node in (edge.start, edge.end))
        self.length = math.dist(self.start, self.end)
        self.along = (self.end - self.start) / (self.length or 1.0)
        self.across = np.array([-self.along[1], self.along[0]])

    def strip(self, half_width_m: float) -> shapely.Polygon:
        """Return the strip of lane within a distance on both sides of its centre line."""
        side = self.across * half_width_m
        return shapely.Polygon([self.start + side, self.end + side, self.end - side, self.start - side])

    @property
    def middle(self) -> Point:
        """The midpoint of the lane edge's centre line."""
        x, z = ((self.start + self.end) / 2).tolist()
        return x, z

    def reach(self, shape: shapely.Geometry) -> tuple[float, float]:
        """Return the least and greatest distance of a shape across the lane's centre line."""
        across = (shapely.get_coordinates(shape) - self.start) @ self.across
        return float(across.min()), float(across.max())


@BOOK.rule(
    "aisle-width", "aisle_width", asks="an aisle with stalls at right angles to it is wide enough between what stands"
)
def _width(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    clause = profile.aisle_width
    return _narrow(level, {} if clause is None else {StallKind.PERPENDICULAR: lambda _: clause.amount})


@BOOK.rule(
    "angled-aisle-width",
    "angled_aisle_widths",
    "aisle_width",
    asks="an aisle with angled stalls is wide enough for their angle between what stands",
)
def _angled_width(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    clause, upright = profile.angled_aisle_widths, profile.aisle_width
    if clause is None:
        return iter(())
    perpendicular_m = upright.amount if upright else None
    return _narrow(level, {StallKind.ANGLED: lambda stall: clause.amount_at(stall.slant_deg, perpendicular_m)})


@BOOK.rule(
    "parallel-aisle-width",
    "parallel_aisle_width",
    asks="an aisle with parallel stalls is wide enough between what stands",
)
def _parallel_width(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    clause = profile.parallel_aisle_width
    return _narrow(level, {} if clause is None else {StallKind.PARALLEL: lambda _: clause.amount})


def _narrow(level: BuiltLevel, required_by: Mapping[StallKind, Callable[[Stall], float]]) -> Iterator[Miss]:
    """Yield the aisles narrower than some of their stalls of certain kinds require."""
    stalls = [stall for stall in level.parking_stalls if stall.kind in required_by]
    for edge, served in _serving_edges(level, stalls):
        required = max(required_by[stall.kind](stall) for stall in served)
        way = _Way(level, edge)
        measured, narrowed_by = _clear_width(level, way, edge.width_m)
        if measured < required - ROUNDING_M:
            reason = f"; {narrowed_by} stands in it" if narrowed_by else ""
            things = (narrowed_by,) if narrowed_by else ()
            message = f"the aisle is too narrow{reason}"
            yield Miss(level.lanes.edge_name(edge), way.middle, message, measured, required, things)


@BOOK.rule("lane-blocked", asks="nothing stands on a lane", in_surveys=Severity.WARNING)
def _blocked(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    seen: set[str] = set()
    for edge in level.lanes.edges:
        way = _Way(level, edge)
        for solid in level.solids.at(way.strip(max(edge.width_m / 2 - _TOUCH_M, _TOUCH_M))):
            if solid.label in _MAY_STAND_ON_LANES or solid.name in seen:
                continue
            if solid.label in CAR_LABELS and level.stall_grounds.home_of(solid.footprint) is not None:
                continue
            seen.add(solid.name)
            message = f"a {solid.kind} stands on the lane {level.lanes.edge_name(edge)}"
            yield Miss(solid.name, solid.centre, message, things=(solid.name,))


def _serving_edges(level: BuiltLevel, stalls: Iterable[Stall]) -> Iterator[tuple[LaneEdge, list[Stall]]]:
    """Yield the lane edges from which cars turn into adjacent stalls, with these."""
    opening_on: dict[int, list[Stall]] = {}
    for stall in stalls:
        opening_on.setdefault(stall.access, []).append(stall)
    for edge in level.lanes.edges:
        if any(level.lanes.nodes[node].is_portal for node in (edge.start, edge.end)):
            continue
        along = _Way(level, edge).along
        beside = (stall for node in (edge.start, edge.end) for stall in opening_on.get(node, ()))
        served = [stall for stall in beside if abs(float(along @ _across_mouth(stall))) < _RIGHT_ANGLE_COS]
        if served:
            yield edge, served


def _across_mouth(stall: Stall) -> NDArray[np.float64]:
    """Return a unit vector at right angles to a stall's mouth."""
    (left_x, left_z), (right_x, right_z), *_ = stall.corners
    across = np.array([left_z - right_z, right_x - left_x])
    return across / (np.linalg.norm(across) or 1.0)


def _clear_width(level: BuiltLevel, way: _Way, carriageway_m: float) -> tuple[float, str]:
    """Return an aisle's clear width between columns, walls and cores, at most as stated, and the narrowest obstacle."""
    half = carriageway_m / 2
    strip = way.strip(half)
    left, right, narrowest = half, half, ""
    for solid in level.solids.at(strip):
        if solid.label not in _BUILDING:
            continue
        part = solid.footprint.intersection(strip)
        if part.is_empty:  # it only touches the strip
            continue
        low, high = way.reach(part)
        if high < 0 and -high < left:
            left, narrowest = -high, solid.name
        elif low > 0 and low < right:
            right, narrowest = low, solid.name
        elif low <= 0 <= high:
            # cars pass on the wider side of what stands in the middle
            left, right, narrowest = max(half + low, half - high), 0.0, solid.name
    return max(left + right, 0.0), narrowest


@BOOK.rule("dead-end", "dead_end_length", asks="a long dead-end aisle keeps a turning stall free")
def _dead_ends(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    if profile.dead_end_length is None:
        return
    for nodes, length, _ in level.lanes.dead_ends:
        if length <= profile.dead_end_length.amount + ROUNDING_M:
            continue
        uses = {stall.use for stall in level.stalls if stall.access in nodes}
        if uses and StallUse.TURNING not in uses:
            node = level.lanes.nodes[nodes[0]]
            message = "the dead-end aisle is too long without a stall kept free for turning"
            yield Miss(node.name, node.position, message, length, profile.dead_end_length.amount)
