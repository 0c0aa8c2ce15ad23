"""Guide strips along the borders of aisles: lines or coloured strips, continuous across squares and around corners."""

from functools import lru_cache
from itertools import product
from typing import NamedTuple

import shapely
from shapely import affinity

from garage2usd.config.look import BandForm, MarkingsLook
from garage2usd.layout.floor.markings import area_markings, chevron, pictogram, polygon_of
from garage2usd.layout.placement import edge_yaw_rad
from garage2usd.objects.kind import Polygon
from garage2usd.objects.panel import Marking, Paint, Surface
from garage2usd.structure.stalls import Edge

_BEYOND_M = 6.0
"""Extent of the ground of adjacent open squares, in metres."""
_INNER_RADIUS_M = 0.3
_ROUND_STEPS = 4
"""Number of segments of a quarter circle."""
_MOST_SIGN_M, _SIGN_SHARE = 0.8, 0.72
"""Greatest size of a pictogram, and its size as a share of the strip width."""
_LEAST_SIGN_M = 0.3
_COLOURED = (Edge.UP, Edge.LEFT)
"""Sides of an aisle with the coloured strip, if the look has it on one side only."""


class ClosedSides(NamedTuple):
    """Closed edges and corners of a lane or portal square.

    Attributes
    ----------
    edges
        Edges that cars cannot cross.
    corners
        Corners with closed ground between two open edges, each by its edges along X and along Z.
    """

    edges: frozenset[Edge]
    corners: frozenset[tuple[Edge, Edge]]


def strip_depth_m(look: MarkingsLook) -> float:
    """Return the distance from the border of a lane to the inner side of its guide strip; 0 without a strip."""
    if look.band is BandForm.NONE:
        return 0.0
    width = look.line_width_m + look.band_width_m if look.band is BandForm.BAND else 0.0
    return look.band_gap_m + width + look.line_width_m


@lru_cache(maxsize=1024)
def guide_strips(
    closed: ClosedSides, half_x: float, half_z: float, look: MarkingsLook, *, has_pictogram: bool
) -> tuple[Marking, ...]:
    """Return the guide strips of a square: parallel to its closed edges, around columns, and into the next square.

    Parameters
    ----------
    closed
        Closed edges and corners of the square.
    half_x, half_z
        Half its extent along X and Z, metres.
    look
        Settings of the markings.
    has_pictogram
        True for a pictogram in the middle of straight coloured strips, False for chevrons.
    """
    if look.band is BandForm.NONE:
        return ()
    gap, line = look.band_gap_m, look.line_width_m
    inside = _LaneGround(closed, half_x, half_z, gap, strip_depth_m(look), is_round=look.band is BandForm.BAND)
    if look.band is BandForm.LINE:
        return area_markings(inside.between(gap, gap + line), Surface.PAINT_EDGE)
    first, second = gap + line, gap + line + look.band_width_m
    coloured = shapely.union_all(_coloured_ground(closed, half_x, half_z, second + line + inside.radius_m, look))
    strip = shapely.intersection(inside.between(first, second), coloured)
    inner = shapely.intersection(inside.between(second, second + line), coloured)
    signs = [
        sign
        for edge in sorted(closed.edges.intersection(_coloured_edges(look)))
        for sign in _symbols(edge, closed, half_x, half_z, (first, second), look, has_pictogram=has_pictogram)
    ]
    return (
        *(Marking(shape, Surface.PAINT_WHITE, Paint.LANE_ARROW) for shape in signs),
        *area_markings(inside.between(gap, first), Surface.PAINT_EDGE),
        *area_markings(inner, Surface.PAINT_EDGE),
        *area_markings(strip, Surface.PAINT_BAND, None),
    )


class _LaneGround:
    """Drivable ground of a lane square and its open neighbours, eroded for strips parallel to the border."""

    def __init__(
        self, closed: ClosedSides, half_x: float, half_z: float, gap_m: float, depth_m: float, *, is_round: bool
    ) -> None:
        self._square = shapely.box(-half_x, -half_z, half_x, half_z)
        open_edges = [edge for edge in Edge if edge not in closed.edges]
        grounds = [self._square, *(_ground_beyond(half_x, half_z, edge) for edge in open_edges)]
        grounds += [
            _ground_beyond(half_x, half_z, *corner)
            for corner in product((Edge.UP, Edge.DOWN), (Edge.LEFT, Edge.RIGHT))
            if closed.edges.isdisjoint(corner) and corner not in closed.corners
        ]
        self._ground = shapely.union_all(grounds)
        self._join = "round" if is_round else "mitre"
        wanted = depth_m - gap_m + _INNER_RADIUS_M if is_round else 0.0
        self.radius_m = max(min(wanted, min(half_x, half_z) - gap_m - _INNER_RADIUS_M), 0.0)
        self._deep_m = gap_m + self.radius_m

    def between(self, near_m: float, far_m: float) -> shapely.Geometry:
        """Return the part of the square between two distances from the ground's border."""
        ring = shapely.difference(self._eroded(near_m), self._eroded(far_m))
        return shapely.intersection(ring, self._square)

    def _eroded(self, distance_m: float) -> shapely.Geometry:
        """Return the ground at least a distance from the border; its inner corners are concentric arcs."""
        deep = max(self._deep_m, distance_m)
        core = self._ground.buffer(-deep, quad_segs=_ROUND_STEPS, join_style=self._join)
        return core.buffer(deep - distance_m, quad_segs=_ROUND_STEPS, join_style=self._join)


def _ground_beyond(half_x: float, half_z: float, *edges: Edge) -> shapely.Polygon:
    """Return the ground beyond one edge of a square, or beyond the corner of two edges."""
    left, top, right, bottom = -half_x, -half_z, half_x, half_z
    for edge in edges:
        if edge is Edge.UP:
            top, bottom = -half_z - _BEYOND_M, -half_z
        elif edge is Edge.DOWN:
            top, bottom = half_z, half_z + _BEYOND_M
        elif edge is Edge.LEFT:
            left, right = -half_x - _BEYOND_M, -half_x
        else:
            left, right = half_x, half_x + _BEYOND_M
    return shapely.box(left, top, right, bottom)


def _coloured_edges(look: MarkingsLook) -> tuple[Edge, ...]:
    """Return the sides of aisles with a coloured strip."""
    return tuple(Edge) if look.band_both_sides else _COLOURED


def _coloured_ground(
    closed: ClosedSides, half_x: float, half_z: float, depth_m: float, look: MarkingsLook
) -> list[shapely.Polygon]:
    """Return the ground of coloured strips: along closed edges, and at corners between two coloured edges."""
    edges = _coloured_edges(look)
    along = {edge: _edge_strip(edge, half_x, half_z, depth_m) for edge in edges}
    corners = [(first, second) for first, second in closed.corners if first in along and second in along]
    return [
        *(along[edge] for edge in edges if edge in closed.edges),
        *(shapely.intersection(along[first], along[second]) for first, second in sorted(corners)),
    ]


def _edge_strip(edge: Edge, half_x: float, half_z: float, depth_m: float) -> shapely.Polygon:
    """Return the part of a square within `depth_m` of one edge."""
    left, top, right, bottom = -half_x, -half_z, half_x, half_z
    if edge is Edge.UP:
        bottom = min(depth_m - half_z, half_z)
    elif edge is Edge.DOWN:
        top = max(half_z - depth_m, -half_z)
    elif edge is Edge.LEFT:
        right = min(depth_m - half_x, half_x)
    else:
        left = max(half_x - depth_m, -half_x)
    return shapely.box(left, top, right, bottom)


def _symbols(
    edge: Edge,
    closed: ClosedSides,
    half_x: float,
    half_z: float,
    strip_m: tuple[float, float],
    look: MarkingsLook,
    *,
    has_pictogram: bool,
) -> list[Polygon]:
    """Return the pictogram or chevrons on a strip; empty unless the strip runs straight through the square."""
    size = min(_SIGN_SHARE * look.band_width_m, _MOST_SIGN_M)
    if size < _LEAST_SIGN_M or closed.edges.intersection(edge.ends):
        return []
    half, across = (half_x, half_z) if edge.along_x else (half_z, half_x)
    shapes = pictogram(look.pictogram, size) if has_pictogram else chevron(size)
    depth = sum(strip_m) / 2
    placed = []
    for along in (0.0,) if has_pictogram else (-half / 2, half / 2):
        for shape in shapes:
            # upright for a pedestrian who walks along the strip with the border to the left
            turned = affinity.rotate(shapely.Polygon(shape), 90, origin=(0, 0))
            moved = affinity.translate(turned, along, across - depth)
            whole = affinity.rotate(moved, -edge_yaw_rad(edge), origin=(0, 0), use_radians=True)
            placed.append(polygon_of(whole))
    return placed
