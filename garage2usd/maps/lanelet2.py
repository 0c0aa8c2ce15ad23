"""Lanelet2 map of a garage, with Autoware's tags, and its stop lines before gates and speed bumps."""

import math
from collections import defaultdict
from collections.abc import Container, Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
import shapely

from garage2usd.as_built import BuiltGarage, BuiltLevel
from garage2usd.config.outputs import MapsConfig
from garage2usd.layout.grounds import hulls_of
from garage2usd.maps.facts import stage_facts
from garage2usd.maps.frame import map_points
from garage2usd.maps.ground_plan import GroundPlan, LevelPlan, ground_plan
from garage2usd.maps.lane_bounds import Bound, LaneBounds, lane_bounds
from garage2usd.maps.lanelet2_parking import add_lots, add_stalls, stall_points
from garage2usd.maps.level_networks import LevelNetwork, level_networks
from garage2usd.maps.network import LEFT, Network
from garage2usd.maps.osm_file import Member, OsmFile
from garage2usd.maps.xml_text import number_text

_BEFORE_M = 1.0
"""Distance from a stop line to its gate or speed bump."""
_STEP_M = 0.02
"""Step along a lane at which obstacles across it are searched."""
_SIGNS = {"barrier": ("lift_gate", "stop_sign"), "speed_bump": ("bump", "de112")}
"""Lanelet2 type and equivalent traffic sign of gates and speed bumps, by semantic class."""
_STOP_LINE = {"type": "stop_line"}
_FORMAT = "1"
_STRAIGHT_RAD = 0.1


class Crossed(NamedTuple):
    """A gate or speed bump: its class, its path in the stage, its outline in the map, and its height."""

    label: str
    name: str
    outline: shapely.Geometry
    height_m: float


def add_stops(
    osm: OsmFile,
    level: BuiltLevel,
    lanes: Sequence[LaneBounds],
    *,
    signs: Mapping[str, tuple[str, str]] = _SIGNS,
    line: Mapping[str, str] = _STOP_LINE,
) -> dict[LaneBounds, list[int]]:
    """Write a stop line and a regulatory element for each gate and each speed bump.

    Parameters
    ----------
    osm
        The file.
    level
        The level.
    lanes
        All lanes.
    signs
        Type and subtype of the line of each class of things before which there is a stop line.
    line
        Tags of the stop lines.

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
        before[start if lane.is_against else end].append(lane)
    rules: dict[tuple[LaneBounds, str], int] = {}
    by_place = shapely.STRtree([shapely.Polygon(lane.ground) for lane in lanes])
    for thing in crossed_things(level, signs):
        touched = sorted(by_place.query(thing.outline, predicate="intersects").tolist())
        crossed = [(index, across) for index in touched if (across := _across(lanes[index], thing)) is not None]
        if touched and not crossed:  # a raised and folded arm does not reach the middle of the lane
            index = max(touched, key=lambda index: by_place.geometries[index].intersection(thing.outline).area)
            crossed = [(index, _beside(lanes[index], thing))]
        for index, across in crossed:
            lane, (start, end) = lanes[index], ends[index]
            left_m = _BEFORE_M - across[0]
            leading = before[end if lane.is_against else start] if left_m > 0 else []
            stops = [(other, other.road.line.length_m - left_m) for other in leading] or [(lane, -left_m)]
            for other, stop_m in stops:
                if (other, thing.name) not in rules:
                    stop = osm.new_way(_line_across(osm, other, max(stop_m, 0.0)), line)
                    symbol = dict(zip(("type", "subtype"), signs[thing.label], strict=True))
                    rules[other, thing.name] = _add_rule(osm, lane, thing, sum(across) / 2, stop, symbol)
    found = defaultdict(list)
    for (lane, _), rule in rules.items():
        found[lane].append(rule)
    return found


def crossed_things(level: BuiltLevel, labels: Container[str]) -> Iterator[Crossed]:
    """Yield the gates and speed bumps of a level, as far as their classes are among some."""
    for thing in level.things:
        if thing.label in labels:
            pieces = [map_points(outline) for body in thing.bodies for outline, _, _ in body.pieces()]
            outline = shapely.union_all(hulls_of(pieces)).buffer(_STEP_M)
            shapely.prepare(outline)
            height_m = max(high for body in thing.bodies for _, _, high in body.pieces())
            yield Crossed(thing.label, thing.name, outline, height_m)


def _across(lane: LaneBounds, thing: Crossed) -> tuple[float, float] | None:
    """Find the interval along a lane in which a gate or bump covers its middle line; None if it does not."""
    road, length_m = lane.road, lane.road.line.length_m
    runs = np.linspace(0.0, length_m, math.ceil(length_m / _STEP_M) + 1)
    over = runs[shapely.contains_xy(thing.outline, road.middle_points(lane.lane, runs))]
    return _driven(lane, float(over[0]), float(over[-1])) if len(over) else None


def _beside(lane: LaneBounds, thing: Crossed) -> tuple[float, float]:
    """Find the place along a lane beside which the part of a gate over the lane lies."""
    part = thing.outline.intersection(shapely.Polygon(lane.ground)).centroid
    runs = np.linspace(0.0, lane.road.line.length_m, math.ceil(lane.road.line.length_m / _STEP_M) + 1)
    points = lane.road.middle_points(lane.lane, runs)
    run_m = float(runs[np.hypot(*(points - (part.x, part.y)).T).argmin()])
    return _driven(lane, run_m, run_m)


def _driven(lane: LaneBounds, start_m: float, end_m: float) -> tuple[float, float]:
    """Turn an interval along a road into one along a lane, in the direction of its traffic."""
    length_m = lane.road.line.length_m
    return (length_m - end_m, length_m - start_m) if lane.is_against else (start_m, end_m)


def _add_rule(osm: OsmFile, lane: LaneBounds, thing: Crossed, run_m: float, stop: int, tags: Mapping[str, str]) -> int:
    symbol = osm.new_way(_line_across(osm, lane, run_m), {**tags, "name": thing.name})
    members = [Member("way", symbol, "refers"), Member("way", stop, "ref_line")]
    return osm.relation(members, {"type": "regulatory_element", "subtype": "traffic_sign"})


def _line_across(osm: OsmFile, lane: LaneBounds, run_m: float) -> tuple[int, ...]:
    """Create the points across a lane at a distance along it, from the driver's left to right."""
    road, is_left = lane.road, lane.lane == LEFT
    run_m = road.line.length_m - run_m if lane.is_against else run_m
    lanes, height = road.lanes_at(run_m), road.height_m(run_m)
    outer_m = lanes.middle_m + (lanes.left_m if is_left else -lanes.right_m)
    sides_m = (outer_m, lanes.middle_m) if road.keeps_left else (lanes.middle_m, outer_m)
    return osm.points((*road.line.beside(run_m, side_m), height) for side_m in sides_m)


def write_lanelet2(
    garage: BuiltGarage,
    path: Path,
    settings: MapsConfig,
    *,
    networks: Sequence[LevelNetwork] | None = None,
    plan: GroundPlan | None = None,
) -> tuple[LaneBounds, ...]:
    """Write a garage as a Lanelet2 map in the common map frame (`garage2usd.maps.frame`).

    Parameters
    ----------
    garage
        The garage.
    path
        The file, in an existing folder.
    settings
        Geographic position and speed limit.
    networks
        Roads of its levels by `garage2usd.maps.level_networks.level_networks`, if already known.
    plan
        Its ground plan, likewise.

    Returns
    -------
    tuple of LaneBounds
        The lanes of the lanelets, their heights over the floor of their level.

    Raises
    ------
    StageError
        If a level has no complete lane graph, or a ramp leads to no landing.

    Notes
    -----
    A lanelet is a driving lane of a road of `garage2usd.maps.network`, with the numbers that both have in the OpenDRIVE
    map. The last points of one are the first of the next, and the two of an aisle share its middle line. Points are
    `garage2usd.maps.osm_file.APART_M` from one another. Bounds lie within a millimetre of the lane's where such points
    allow it; where a bend is tighter than its lane is wide, the inner one is straight.
    Latitude and longitude follow the projection of the OpenDRIVE map. Stalls are those of
    `garage2usd.maps.lanelet2_parking`. Outline, columns and blocks are closed lines of the type ``building``, doors to
    the street lines of the type ``gate``.
    """
    osm = OsmFile(settings.latitude_deg, settings.longitude_deg)
    lanes: list[LaneBounds] = []
    levels = (plan or ground_plan(garage)).levels
    for (level, network), ground in zip(networks or level_networks(garage), levels, strict=True):
        osm.floor_m = level.place.floor_m
        lanes += _add_level(osm, level, network, settings)
        add_buildings(osm, ground)
    write_map(osm, garage, path)
    return tuple(lanes)


def write_map(osm: OsmFile, garage: BuiltGarage, path: Path) -> None:
    """Write a map with the name and the provenance of its garage."""
    facts = {name: str(value) for name, value in stage_facts(garage.stage).items()}
    version = facts.pop("version", "")
    header = {"format_version": _FORMAT, "map_version": version, "name": Path(garage.source).stem, **facts}
    osm.write(path, generator=f"garage2usd {version}".strip(), facts=header)


def _add_level(osm: OsmFile, level: BuiltLevel, network: Network, settings: MapsConfig) -> tuple[LaneBounds, ...]:
    """Write the lanes, stalls and stops of a level, and return its lanes."""
    stalls = stall_points(osm, level)
    lanes = lane_bounds(network, osm)
    feet = add_stalls(osm, level, lanes, stalls)
    stops = add_stops(osm, level, lanes)
    ways: dict[Bound, int] = {}
    for lane in lanes:
        for bound, is_left in ((lane.left, True), (lane.right, False)):
            if bound not in ways:
                points = feet.along(bound)
                is_turned = lane.is_against and is_left is lane.road.keeps_left
                ways[bound] = osm.way(points[::-1] if is_turned else points, bound_tags(bound))
        members = [Member("way", ways[lane.left], "left"), Member("way", ways[lane.right], "right")]
        members += [Member("relation", rule, "regulatory_element") for rule in stops.get(lane, ())]
        osm.relation(members, lanelet_tags(lane, settings))
    add_lots(osm, lanes, feet)
    return lanes


def add_buildings(osm: OsmFile, plan: LevelPlan) -> None:
    """Write the outline of a level, its columns and blocks, and a line across each door to the street."""
    outline = [] if plan.outline is None else [plan.outline]
    for tags, grounds in (
        ({"building": "parking"}, outline),
        ({"subtype": "column"}, plan.columns),
        ({"subtype": "core"}, plan.blocks),
    ):
        for ground in grounds:
            # chamfers are narrower than the points of a map may be apart
            ring = shapely.get_coordinates(ground if ground in outline else shapely.oriented_envelope(ground))[:-1]
            osm.polygon(osm.points((x, y, 0.0) for x, y in ring.tolist()), {"type": "building", **tags})
    for door in plan.doors:
        jambs = osm.points((x, y, 0.0) for x, y in door.jambs.tolist())
        osm.new_way(jambs, {"type": "gate", "subtype": door.kind})


def bound_tags(bound: Bound) -> dict[str, str]:
    """Return the tags of a lane bound: no lane change over the middle line; other bounds may be crossed into stalls."""
    return {"type": "line_thin", "subtype": "dashed", "lane_change": "no"} if bound.is_middle else {"type": "virtual"}


def turn_direction(turned_rad: float) -> str:
    """Return Autoware's word for the angle by which a lane turns to the left."""
    return "straight" if abs(turned_rad) < _STRAIGHT_RAD else "left" if turned_rad > 0 else "right"


def lanelet_tags(lane: LaneBounds, settings: MapsConfig) -> dict[str, str]:
    """Return the tags of a lane's lanelet."""
    turn = {} if lane.road.junction is None else {"turn_direction": turn_direction(lane.turned_rad)}
    return {
        "type": "lanelet",
        "subtype": "road",
        "location": "urban",
        "one_way": "yes",
        "participant:vehicle": "yes",
        "speed_limit": number_text(settings.speed_limit_km_h),
        **turn,
        "road": str(lane.road.number),
        "lane": str(lane.lane),
    }
