"""Lots of a survey that lie apart: each with an outline, lanes and doors of its own, on one floor."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import networkx as nx
import numpy as np
import shapely

from garage2usd.common.errors import ConfigError
from garage2usd.garage import Point
from garage2usd.survey.clear_ground import fronts, with_medial_lanes
from garage2usd.survey.enclosure import BEYOND_M, NEAR_M, REACH_M, corners_around, enclosed, parts_inside
from garage2usd.survey.fitted_stalls import fitted_stalls
from garage2usd.survey.lane_network import lane_network
from garage2usd.survey.survey import Survey, Unplaced, outlined

_FAR_M = 500.0
"""Greatest distance in metres of a lot from the one with the most stalls."""
_AHEAD_M = 1.3, 2.6
"""Distances in metres from the side of a stall at which free ground is looked for: half the narrowest lane, and all."""
_MOST_FAR = 0.5
"""Share of stalls that are near lanes, up to which these do not serve the lot."""
_MOST_TAKEN = 0.15
"""Share of the ground of a lane before stalls that others take, from which on none is laid there."""
_LEAST_M2 = 1.0
"""Least area of the part of a block that reaches into a lot."""
_APART_M = 1.0
"""Least distance in metres between the outlines of two lots: walls stand between them."""


def in_lots(survey: Survey) -> Survey:
    """Return a survey with lanes whose stalls lie inside its outlines.

    Raises
    ------
    ConfigError
        If no lot has lanes or ground for them.

    Notes
    -----
    Stalls within 12 m of each other or of an outline are a lot. Each lot is enclosed by its outline, or else by one
    around its stalls and the lanes beside them. Stalls of lots without ground for lanes, and of those too far from the
    first one, are unread. Without any outline, all stalls are one lot.
    """
    if not survey.stalls:
        return survey
    if survey.outline is None:
        return with_medial_lanes(survey)
    lots = _lots(survey)
    if len(lots) == 1:
        return _laned(lots[0])
    found: list[Survey] = []
    unread: list[Unplaced] = []
    first = _ground(lots[0])
    for lot in lots:
        away_m = first.distance(_ground(lot))
        reason = f"{away_m:.0f} m outside the outline, more than {_FAR_M:g}" if away_m > _FAR_M else ""
        if not reason:
            try:
                found.append(_laned(lot))
            except ConfigError as error:
                reason = f"of a lot without room for lanes, {away_m:.0f} m outside the outline"
                failed = error
        unread += [Unplaced(stall.name, f"a stall {reason}") for stall in lot.stalls if reason]
    if not found:
        raise failed
    found = _disjoint(found, survey)
    outlines = [lot.outline for lot in found if lot.outline is not None]
    grounds = shapely.union_all([shapely.Polygon(outline) for outline in outlines])
    sizes = [f"{len(lot.stalls)} with {lot.stalls[0].name}" for lot in found]
    told = [f"{len(found)} lots lie apart, each with its own walls and doors; stalls: {', '.join(sizes)}"]
    return replace(
        survey,
        stalls=tuple(stall for lot in found for stall in lot.stalls),
        lanes=tuple(lane for lot in found for lane in lot.lanes),
        portals=tuple(portal for lot in found for portal in lot.portals),
        solids=tuple(_solids_inside(survey, grounds)),
        outline=outlines[0],
        other_outlines=tuple(outlines[1:]),
        unread=(*survey.unread, *unread),
        remarks=(*survey.remarks, *(told if len(found) > 1 else ()), *(note for lot in found for note in lot.remarks)),
    )


def _lots(survey: Survey) -> list[Survey]:
    """Return the lots, the one of the outline first, each with the lanes and portals near it."""
    shapes = survey.stall_polygons()
    rings = [ring for ring in (survey.outline, *survey.other_outlines) if ring is not None]
    grounds = [shapely.Polygon(ring) for ring in rings]
    if len(rings) == 1 and grounds[0].buffer(BEYOND_M, join_style="mitre").covers(shapely.union_all(shapes)):
        return [survey]
    tree = shapely.STRtree([*shapes, *grounds])
    near: nx.Graph[int] = nx.Graph(tree.query(tree.geometries, predicate="dwithin", distance=NEAR_M).T.tolist())
    parts = sorted((sorted(part) for part in nx.connected_components(near)), key=lambda part: (-len(part), part))
    parts = [part for part in parts if part[0] < len(shapes)]
    if len(parts) == 1:
        return [replace(survey, other_outlines=())]
    lots = []
    for part in sorted(parts, key=lambda part: len(shapes) not in part):
        stalls = [number for number in part if number < len(shapes)]
        outline = next((rings[number - len(shapes)] for number in part if number >= len(shapes)), None)
        lot = replace(
            survey,
            stalls=tuple(survey.stalls[number] for number in stalls),
            outline=outline,
            other_outlines=(),
            unread=(),
            remarks=(),
        )
        reach = _ground(lot).buffer(REACH_M)
        lanes = [lane for lane in survey.lanes if reach.intersects(shapely.LineString(lane.points))]
        lots.append(replace(lot, lanes=tuple(lanes), portals=()))
    places = [_ground(lot) for lot in lots]
    for portal in survey.portals:
        away_m = shapely.distance(places, shapely.Point(portal.position))
        nearest = int(away_m.argmin())
        lots[nearest] = replace(lots[nearest], portals=(*lots[nearest].portals, portal))
    return lots


def _ground(lot: Survey) -> shapely.Geometry:
    """Return the ground within the outline of a lot and its stalls."""
    outlines = [] if lot.outline is None else [shapely.Polygon(lot.outline)]
    return shapely.union_all([*outlines, *lot.stall_polygons()])


def _laned(lot: Survey) -> Survey:
    """Return a lot with an outline around its stalls, and lanes.

    Where its own lanes are far from most stalls, or its outline has no room for lanes, those lanes and that outline are
    taken that serve the most stalls: its own, medial ones, or both drawn around the stalls.
    """
    own = _drawn(lot) if lot.outline is None else _with_fronts(enclosed(lot))
    lines = shapely.union_all([shapely.LineString(lane.points) for lane in own.lanes])
    if own.lanes and np.mean(shapely.distance(lines, lot.stall_polygons()) <= REACH_M) > _MOST_FAR:
        return own
    free, bare = replace(lot, outline=None), replace(lot, outline=None, lanes=())
    found: list[tuple[int, int, Survey]] = []
    for order, (lay, survey) in enumerate(
        ((with_medial_lanes, own), (with_medial_lanes, replace(own, lanes=())), (_drawn, free), (_drawn, bare))
    ):
        try:
            laid = lay(survey)
        except ConfigError as error:
            failed = error
            continue
        found.append((len(_laneless(laid)), order, laid))
        if not found[-1][0]:
            break
    if not found:
        raise failed
    _, order, best = min(found, key=lambda each: each[:2])
    if order == 0:
        return best
    told = f"outline and lanes of the file give stalls beside {lot.stalls[0].name} no lane; others are drawn"
    return replace(best, remarks=(*best.remarks, told))


def _laneless(lot: Survey) -> tuple[int, ...]:
    """Return the numbers of stalls that no lane serves."""
    walls = shapely.boundary(shapely.union_all([shapely.Polygon(lot.outline), *lot.solid_polygons()]))
    network = lane_network(lot.lanes, [], lot.stall_polygons(), walls)
    return fitted_stalls(lot, network, keeps_left=False, walls=walls).laneless


def _drawn(lot: Survey) -> Survey:
    """Return a lot without an outline as one with an outline around its stalls and the lanes beside them."""
    near = _ground(lot).buffer(REACH_M)
    served = [
        replace(lane, points=points)
        for lane in lot.lanes
        for points in parts_inside(shapely.LineString(lane.points), near)
    ]
    drawn = outlined(with_medial_lanes(replace(lot, lanes=tuple(served))))
    return enclosed(replace(drawn, lanes=lot.lanes)) if served else drawn


def _with_fronts(lot: Survey) -> Survey:
    """Return a lot whose outline has the ground of a lane before stalls that open onto none inside."""
    corners = np.array([stall.corners for stall in lot.stalls])
    sides = np.roll(corners, -1, axis=1) - corners
    middles = corners + sides / 2
    outwards = np.stack([sides[..., 1], -sides[..., 0]], axis=-1) / np.linalg.norm(sides, axis=-1)[..., None]
    away = ((middles - corners.mean(axis=1, keepdims=True)) * outwards).sum(axis=-1, keepdims=True)
    ahead = middles[..., None, :] + np.sign(away)[..., None] * outwards[..., None, :] * np.array(_AHEAD_M)[:, None]
    stalls, ground = shapely.union_all(lot.stall_polygons()), shapely.Polygon(lot.outline)
    free = shapely.difference(ground, shapely.union_all([stalls, *lot.solid_polygons()]))
    shapely.prepare(free)
    is_open = shapely.contains_xy(free, ahead[..., 0], ahead[..., 1]).all(axis=-1)
    shut = [
        stall
        for stall, sides_open in zip(lot.stalls, is_open.tolist(), strict=True)
        if not (any(sides_open) if stall.mouth is None else sides_open[stall.mouth])
    ]
    standing = shapely.union_all([stalls, *lot.solid_polygons()])
    strips = [
        strip
        for strip in fronts(replace(lot, stalls=tuple(shut)), ground, stalls)
        if strip.intersection(standing).area < _MOST_TAKEN * strip.area and not ground.covers(strip)
    ]
    if not strips:
        return lot
    wider = shapely.union_all([ground, *strips]).buffer(_APART_M, join_style="mitre")
    told = f"the outline leaves no room for a lane before stalls such as {shut[0].name}; it is drawn around one"
    return replace(
        lot,
        outline=corners_around(wider.buffer(-_APART_M, join_style="mitre")),
        remarks=(*lot.remarks, told),
    )


def _solids_inside(survey: Survey, grounds: shapely.Geometry) -> Iterator[tuple[Point, ...]]:
    """Yield the blocks inside the outlines, without the ground of stalls."""
    free = grounds.difference(shapely.union_all(survey.stall_polygons()))
    for corners, solid in zip(survey.solids, survey.solid_polygons(), strict=True):
        if grounds.covers(solid):
            yield corners
        else:
            parts = shapely.get_parts(solid.intersection(free))
            yield from (corners_around(part) for part in parts if part.geom_type == "Polygon" and part.area > _LEAST_M2)


def _disjoint(lots: Sequence[Survey], survey: Survey) -> list[Survey]:
    """Return lots of which those whose outlines meet are one."""
    grounds = [shapely.Polygon(lot.outline) for lot in lots]
    tree = shapely.STRtree(grounds)
    near: nx.Graph[int] = nx.Graph(tree.query(grounds, predicate="dwithin", distance=_APART_M).T.tolist())
    found = []
    for part in sorted(map(sorted, nx.connected_components(near))):
        members = [lots[number] for number in part]
        if len(part) == 1:
            found += members
            continue
        whole = shapely.union_all([grounds[number] for number in part])
        outline = corners_around(whole.buffer(_APART_M, join_style="mitre").buffer(-_APART_M, join_style="mitre"))
        inside = shapely.Polygon(outline)
        given = [lane for lane in survey.lanes if inside.intersects(shapely.LineString(lane.points))]
        doors = [portal for portal in survey.portals if inside.dwithin(shapely.Point(portal.position), NEAR_M)]
        found.append(
            enclosed(
                replace(
                    members[0],
                    stalls=tuple(stall for lot in members for stall in lot.stalls),
                    outline=outline,
                    lanes=tuple(given or (lane for lot in members for lane in lot.lanes)),
                    portals=tuple(doors),
                )
            )
        )
    return found if len(found) == len(lots) else _disjoint(found, survey)
