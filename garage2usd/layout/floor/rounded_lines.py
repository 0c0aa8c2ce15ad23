"""Ground of stall lines with round parts: free ends, corners of closed stalls, and hairpins between stalls.

Shapes are in metres across from a stall's middle and inwards from its mouth. They reach beyond its sides and rear, as
lines of its neighbours do, and are cut by the caller.
"""

import math
from collections.abc import Iterable
from itertools import product

import shapely
from shapely.affinity import affine_transform

LineBox = tuple[float, float, float, float]
"""Left, right, near and far side of a straight line, the last two from the mouth."""
_QUARTER_STEPS = 6
"""Segments of a quarter circle."""
_EATEN = 0.49
"""Radius of free ends as a share of the line's width: a little less than half, so that lines survive being thinned."""


def with_round_ends(boxes: Iterable[LineBox], half_width_m: float, line_m: float) -> shapely.Geometry:
    """Round the free ends of straight lines, joined with those of equal stalls on both sides.

    A morphological opening with a disc: all convex corners become round, and nothing grows.
    """
    lines = [
        shapely.box(left, near, right, far)
        for left, right, near, far in boxes
        for left, right in (
            (left, right),
            *((side - right, side - left) for side in (-2 * half_width_m, 2 * half_width_m)),
        )
    ]
    thin = shapely.union_all(lines, grid_size=1e-6).buffer(-_EATEN * line_m, join_style="mitre")
    return thin.buffer(_EATEN * line_m, quad_segs=_QUARTER_STEPS)


def closed_stall(half_width_m: float, far_m: float, line_m: float, radius_m: float) -> shapely.Geometry:
    """Return the line around a stall, whose sides are the middle of the lines beside it, with rounded corners."""
    side = half_width_m + line_m / 2
    return _loop((-side, side, 0.0, far_m), line_m, radius_m)


def hairpins(half_width_m: float, length_m: float, line_m: float, gap_m: float, slope: float) -> shapely.Geometry:
    """Return the hairpins at both sides of a stall: two lines with a gap, joined at the mouth by half a circle.

    `slope` is that of an angled stall's mouth. The half circle remains one after the stall is slanted by it, and
    touches the mouth.
    """
    radius = gap_m / 2 + line_m
    near = radius * (math.hypot(1.0, slope) - 1.0)
    loops = []
    for side in (-half_width_m, half_width_m):
        loop = _loop((side - radius, side + radius, near, 2 * length_m), line_m, radius)
        loops.append(affine_transform(loop, [1.0, 0.0, slope, 1.0, 0.0, -slope * side]))
    return shapely.union_all(loops)


def _loop(box: LineBox, line_m: float, radius_m: float) -> shapely.Geometry:
    """Return a line along the inner side of a box with rounded corners."""
    left, right, near, far = box
    inner = left + line_m, right - line_m, near + line_m, far - line_m
    return _rounded(box, radius_m).difference(_rounded(inner, max(radius_m - line_m, 0.0)))


def _rounded(box: LineBox, radius_m: float) -> shapely.Geometry:
    """Return a box with rounded corners; the radius is at most half a side."""
    left, right, near, far = box
    radius = min(radius_m, (right - left) / 2, (far - near) / 2)
    middles = product((left + radius, right - radius), (near + radius, far - radius))
    return shapely.MultiPoint(list(middles)).convex_hull.buffer(radius, quad_segs=_QUARTER_STEPS)
