"""Floor panels of a surveyed garage with the arrows and centre lines of its lanes."""

import math
from collections.abc import Iterator, Sequence

import shapely
from shapely.affinity import affine_transform

from garage2usd.garage import LaneGraph
from garage2usd.layout.placement import PlacedStall, Placement
from garage2usd.layout.surveyed.ground import SurveyedGround
from garage2usd.objects.floor import FloorSpec
from garage2usd.objects.outline import Point
from garage2usd.objects.panel import Marking, Paint, Surface

__all__ = ["surveyed_floor"]

_ARROW = shapely.Polygon(
    [(-0.08, 1.2), (0.08, 1.2), (0.08, -0.2), (0.3, -0.2), (0.0, -1.2), (-0.3, -0.2), (-0.08, -0.2)]
)
"""A straight-ahead arrow towards -z, 2.4 m long."""
_LEAST_ARROW_M = 4.0
"""Least length in metres of a stretch with an arrow."""
_ARROWS_M = 15.0
"""Least distance in metres between arrows of a direction."""
_LEAST_FLOOR_M2 = 0.01
_LINE_M, _DASH_M, _LEAST_TWO_WAY_M = 0.12, 2.0, 4.5


def surveyed_floor(ground: SurveyedGround, lanes: LaneGraph, stalls: Sequence[PlacedStall]) -> Iterator[Placement]:
    """Yield the floor panel of each tile, with openings for the stalls and for what lies outside the outline.

    A tile that is all stalls has none.
    """
    panels = shapely.STRtree([shapely.Polygon(stall.corners_m()) for stall in stalls])
    taken = panels.geometries
    paints = list(_paints(lanes))
    painted = shapely.STRtree([shape for shape, _, _ in paints])
    for tile in ground:
        near = sorted(panels.query(tile.box).tolist())
        openings = [shape for index in near for shape in tile.local(taken[index])]
        openings += tile.local(shapely.difference(tile.box, ground.polygon))
        if shapely.union_all([shapely.Polygon(opening) for opening in openings]).area > tile.box.area - _LEAST_FLOOR_M2:
            continue
        markings = [
            Marking(polygon, surface, paint)
            for index in sorted(painted.query(tile.box).tolist())
            for shape, surface, paint in [paints[index]]
            for polygon in tile.local(shape)
        ]
        spec = FloorSpec(round(tile.width_m, 6), round(tile.depth_m, 6), Surface.LANE, tuple(markings), tuple(openings))
        x, z = tile.middle_m
        yield Placement("Floor", spec, (x, 0.0, z), square=tile.square)


def _paints(lanes: LaneGraph) -> Iterator[tuple[shapely.Polygon, Surface, Paint]]:
    """Yield the arrows of each direction, and dashes in the middle of two-way lanes."""
    pointed: list[tuple[Point, Point]] = []
    for edge in lanes.edges:
        start, end = lanes.nodes[edge.start], lanes.nodes[edge.end]
        if start.is_portal or end.is_portal:
            continue
        length_m = math.dist(start.position, end.position)
        along = (
            (end.position[0] - start.position[0]) / length_m,
            (end.position[1] - start.position[1]) / length_m,
        )
        middle = (start.position[0] + end.position[0]) / 2, (start.position[1] + end.position[1]) / 2
        is_wide = not edge.one_way and edge.width_m >= _LEAST_TWO_WAY_M
        if is_wide:
            half_m = min(_DASH_M, length_m / 2) / 2
            dash = shapely.box(-_LINE_M / 2, -half_m, _LINE_M / 2, half_m)
            yield _laid(dash, middle, along), Surface.PAINT_WHITE, Paint.LANE_LINE
        if length_m < _LEAST_ARROW_M or (not edge.one_way and not is_wide):
            continue
        if any(
            math.dist(middle, place) < _ARROWS_M and abs(along[0] * way[0] + along[1] * way[1]) > 0.9  # noqa: PLR2004
            for place, way in pointed
        ):
            continue
        pointed.append((middle, along))
        # on the right of each direction, seen from above with z downwards
        aside_m = edge.width_m / 4 if is_wide else 0.0
        for x, z in (along, (-along[0], -along[1])) if is_wide else (along,):
            place = middle[0] - z * aside_m, middle[1] + x * aside_m
            yield _laid(_ARROW, place, (x, z)), Surface.PAINT_WHITE, Paint.LANE_ARROW


def _laid(shape: shapely.Polygon, place: Point, ahead: Point) -> shapely.Polygon:
    """Return a shape that looks to -z turned to a direction and moved to a place."""
    x, z = ahead
    # (0, -1) becomes (x, z), and (1, 0) its right
    laid: shapely.Polygon = affine_transform(shape, [-z, -x, x, -z, place[0], place[1]])
    return laid
