"""Stop lines of a Lanelet2 map: before gates, and before speed bumps, where cars slow down."""

import math
from collections import defaultdict
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
import shapely

from garage2usd.as_built import BuiltLevel
from garage2usd.layout.grounds import hulls_of
from garage2usd.maps.frame import map_points
from garage2usd.maps.lane_bounds import LaneBounds
from garage2usd.maps.network import LEFT
from garage2usd.maps.osm_file import Member, OsmFile

__all__ = ["add_stops"]

_BEFORE_M = 1.0
"""Distance from a stop line to its gate or speed bump."""
_STEP_M = 0.02
"""Step along a lane at which obstacles across it are searched."""
_SIGNS = {"barrier": ("lift_gate", "stop_sign"), "speed_bump": ("bump", "de112")}
"""Lanelet2 type and equivalent traffic sign of gates and speed bumps, by semantic class."""


class _Thing(NamedTuple):
    """A gate or speed bump: its class, its path in the stage, and its outline in the map."""

    label: str
    name: str
    outline: shapely.Geometry


def add_stops(osm: OsmFile, level: BuiltLevel, lanes: Sequence[LaneBounds]) -> dict[LaneBounds, list[int]]:
    """Write a stop line and a regulatory element for each gate and each speed bump.

    Parameters
    ----------
    osm
        The file.
    level
        The level.
    lanes
        All lanes.

    Returns
    -------
    dict of LaneBounds to list of int
        Ids of the regulatory elements of each lane with any. For a gate or bump less than a metre behind the start of a
        lane, line and element belong to the preceding lanes.
    """
    ends = [
        (
            osm.points((lane.left.places[0], lane.right.places[0])),
            osm.points((lane.left.places[-1], lane.right.places[-1])),
        )
        for lane in lanes
    ]
    before: dict[tuple[int, ...], list[LaneBounds]] = defaultdict(list)
    for lane, (start, end) in zip(lanes, ends, strict=True):
        before[start if lane.lane == LEFT else end].append(lane)
    rules: dict[tuple[LaneBounds, str], int] = {}
    by_place = shapely.STRtree([shapely.Polygon(lane.ground) for lane in lanes])
    for thing in _things(level):
        touched = sorted(by_place.query(thing.outline, predicate="intersects").tolist())
        crossed = [(index, across) for index in touched if (across := _across(lanes[index], thing)) is not None]
        if touched and not crossed:  # a raised arm, folded before the middle of the lane
            index = max(touched, key=lambda index: by_place.geometries[index].intersection(thing.outline).area)
            crossed = [(index, _beside(lanes[index], thing))]
        for index, across in crossed:
            lane, (start, end) = lanes[index], ends[index]
            left_m = _BEFORE_M - across[0]
            leading = before[end if lane.lane == LEFT else start] if left_m > 0 else []
            stops = [(other, other.road.line.length_m - left_m) for other in leading] or [(lane, -left_m)]
            for other, stop_m in stops:
                if (other, thing.name) not in rules:
                    stop = osm.new_way(_line_across(osm, other, max(stop_m, 0.0)), {"type": "stop_line"})
                    rules[other, thing.name] = _add_rule(osm, lane, thing, sum(across) / 2, stop)
    found = defaultdict(list)
    for (lane, _), rule in rules.items():
        found[lane].append(rule)
    return found


def _things(level: BuiltLevel) -> Iterator[_Thing]:
    for thing in level.things:
        if thing.label in _SIGNS:
            pieces = [map_points(outline) for body in thing.bodies for outline, _, _ in body.pieces()]
            outline = shapely.union_all(hulls_of(pieces)).buffer(_STEP_M)
            shapely.prepare(outline)
            yield _Thing(thing.label, thing.name, outline)


def _across(lane: LaneBounds, thing: _Thing) -> tuple[float, float] | None:
    """Find the interval along a lane in which a gate or bump covers its middle line; None if it does not."""
    road, length_m = lane.road, lane.road.line.length_m
    runs = np.linspace(0.0, length_m, math.ceil(length_m / _STEP_M) + 1)
    over = runs[shapely.contains_xy(thing.outline, road.middle_points(lane.lane, runs))]
    return _driven(lane, float(over[0]), float(over[-1])) if len(over) else None


def _beside(lane: LaneBounds, thing: _Thing) -> tuple[float, float]:
    """Find the place along a lane beside which the part of a gate over the lane lies."""
    part = thing.outline.intersection(shapely.Polygon(lane.ground)).centroid
    runs = np.linspace(0.0, lane.road.line.length_m, math.ceil(lane.road.line.length_m / _STEP_M) + 1)
    points = lane.road.middle_points(lane.lane, runs)
    run_m = float(runs[np.hypot(*(points - (part.x, part.y)).T).argmin()])
    return _driven(lane, run_m, run_m)


def _driven(lane: LaneBounds, start_m: float, end_m: float) -> tuple[float, float]:
    """Turn an interval along a road into one along a lane, in the direction of its traffic."""
    length_m = lane.road.line.length_m
    return (length_m - end_m, length_m - start_m) if lane.lane == LEFT else (start_m, end_m)


def _add_rule(osm: OsmFile, lane: LaneBounds, thing: _Thing, run_m: float, stop: int) -> int:
    kind, sign = _SIGNS[thing.label]
    symbol = osm.new_way(_line_across(osm, lane, run_m), {"type": kind, "subtype": sign, "name": thing.name})
    members = [Member("way", symbol, "refers"), Member("way", stop, "ref_line")]
    return osm.relation(members, {"type": "regulatory_element", "subtype": "traffic_sign"})


def _line_across(osm: OsmFile, lane: LaneBounds, run_m: float) -> tuple[int, ...]:
    """Create the points across a lane at a distance along it, from the driver's left to right."""
    road, is_left = lane.road, lane.lane == LEFT
    run_m = road.line.length_m - run_m if is_left else run_m
    lanes, height = road.lanes_at(run_m), road.height_m(run_m)
    outer_m = lanes.middle_m + (lanes.left_m if is_left else -lanes.right_m)
    return osm.points((*road.line.beside(run_m, side_m), height) for side_m in (lanes.middle_m, outer_m))
