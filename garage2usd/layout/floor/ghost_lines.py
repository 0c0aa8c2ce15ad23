"""Lines of an older layout that still show on a floor: rows of stalls at other places."""

from functools import lru_cache

import shapely

from garage2usd.layout.placement import PlacedStall, box_inside
from garage2usd.objects.outline import Box, Point, rectangle
from garage2usd.objects.panel import Marking, Surface
from garage2usd.structure.stalls import Edge

__all__ = ["GHOST_ROWS", "ghosts_on_lane", "ghosts_on_stall"]

_ROWS = ((0.8, -0.45, True), (-0.6, -0.85, False), (1.25, -0.6, True))
"""Of each older row: how far its lines lie along the newer one, how far its mouths lie inside the newer ones, and
whether its stalls were closed by a line."""
GHOST_ROWS = len(_ROWS)
"""How many older rows there are."""
_LENGTHENED = 1.04
"""Width of an older stall, of that of a newer one."""


@lru_cache(maxsize=64)
def _row(number: int, half_m: float, stall_m: Point, line_m: float) -> tuple[Box, ...]:
    """The lines of an older row: from where to where along it and into the stalls, metres from its mouths' middle."""
    shift, depth, is_closed = _ROWS[number]
    width, far = stall_m[0] * _LENGTHENED, stall_m[1] + depth
    boxes = [(-half_m, depth, half_m, depth + line_m)] if is_closed else []
    count = int(2 * half_m / width) + 1
    for index in range(-1, count + 1):
        middle = shift - half_m + index * width
        if -half_m <= middle <= half_m:
            boxes.append((middle - line_m / 2, depth, middle + line_m / 2, far))
    return tuple(boxes)


def ghosts_on_lane(
    number: int, edge: Edge, half_m: Point, row_half_m: float, stall_m: Point, line_m: float
) -> tuple[Marking, ...]:
    """What of an older row lies on the lane square before it.

    Parameters
    ----------
    number
        Of the row, less than `GHOST_ROWS`.
    edge
        The edge of the lane square that the stalls lie beyond.
    half_m
        Half the extent of the lane square along X and Z.
    row_half_m, stall_m, line_m
        Half the length of the newer row, width and length of its stalls, and width of the lines.
    """
    sign = _sign(edge.opposite)
    shapes = []
    for left, near, right, far in _row(number, row_half_m, stall_m, line_m):
        if near < 0:
            along = (left, right) if sign > 0 else (-right, -left)
            box = box_inside(edge, half_m, along, (max(-far, 0.0), -near))
            shapes.append(rectangle(*(round(side, 6) for side in box)))
    return tuple(Marking(shape, Surface.PAINT_GHOST, None) for shape in shapes)


def ghosts_on_stall(
    number: int, stall: PlacedStall, square_m: Point, row_half_m: float, line_m: float
) -> tuple[Marking, ...]:
    """What of an older row lies on one stall, whose square has its middle at `square_m`, in the stall's coordinates."""
    along_x = stall.edge.along_x
    offset = _sign(stall.edge) * (stall.centre_m[not along_x] - square_m[not along_x])
    ground = shapely.box(-stall.width_m / 2, -stall.length_m / 2, stall.width_m / 2, stall.length_m / 2)
    half = stall.length_m / 2
    shapes = []
    for left, near, right, far in _row(number, row_half_m, (stall.width_m, stall.length_m), line_m):
        shape = shapely.box(left - offset, half - far, right - offset, half - near).intersection(ground)
        if shape.area > 0:
            shapes.append(rectangle(*(round(side, 6) for side in shape.bounds)))
    return tuple(Marking(shape, Surface.PAINT_GHOST, None) for shape in shapes)


def _sign(edge: Edge) -> int:
    """Whether +X of the stalls that open onto an edge runs along it or against it."""
    return 1 if edge in {Edge.DOWN, Edge.LEFT} else -1
