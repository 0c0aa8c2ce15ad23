"""Ghost lines: faded stall lines of an older layout on the floor."""

from functools import lru_cache

import shapely

from garage2usd.layout.placement import PlacedStall, box_inside
from garage2usd.objects.outline import Box, Point, rectangle
from garage2usd.objects.panel import Marking, Surface
from garage2usd.structure.stalls import Edge

__all__ = ["GHOST_ROWS", "ghosts_on_lane", "ghosts_on_stall"]

_ROWS = ((0.8, -0.45, True), (-0.6, -0.85, False), (1.25, -0.6, True))
"""Each older row: offset of its lines along the newer row, depth of its mouths inside the newer ones, both in metres,
and True if a line closed its stalls."""
GHOST_ROWS = len(_ROWS)
"""Number of older rows."""
_LENGTHENED = 1.04
"""Width of an older stall, relative to a newer stall."""


@lru_cache(maxsize=64)
def _row_lines(number: int, half_m: float, stall_m: Point, line_m: float) -> tuple[Box, ...]:
    """Return the lines of an older row as boxes along the row and into the stalls, metres from the mouths' middle."""
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
    """Return the ghost lines of an older row on the lane square in front of it.

    Parameters
    ----------
    number
        Number of the older row, less than `GHOST_ROWS`.
    edge
        Edge of the lane square towards the stalls.
    half_m
        Half the extent of the lane square along X and Z.
    row_half_m, stall_m, line_m
        Half the length of the newer row, width and length of its stalls, and width of the lines.
    """
    sign = _direction(edge.opposite)
    shapes = []
    for left, near, right, far in _row_lines(number, row_half_m, stall_m, line_m):
        if near < 0:
            along = (left, right) if sign > 0 else (-right, -left)
            box = box_inside(edge, half_m, along, (max(-far, 0.0), -near))
            shapes.append(rectangle(*(round(side, 6) for side in box)))
    return tuple(Marking(shape, Surface.PAINT_GHOST, None) for shape in shapes)


def ghosts_on_stall(
    number: int, stall: PlacedStall, square_m: Point, row_half_m: float, line_m: float
) -> tuple[Marking, ...]:
    """Return the ghost lines of an older row on one stall, in the stall's coordinates.

    `square_m` is the middle (x, z) of the stall's square.
    """
    along_x = stall.edge.along_x
    offset = _direction(stall.edge) * (stall.centre_m[not along_x] - square_m[not along_x])
    ground = shapely.box(-stall.width_m / 2, -stall.length_m / 2, stall.width_m / 2, stall.length_m / 2)
    half = stall.length_m / 2
    shapes = []
    for left, near, right, far in _row_lines(number, row_half_m, (stall.width_m, stall.length_m), line_m):
        shape = shapely.box(left - offset, half - far, right - offset, half - near).intersection(ground)
        if shape.area > 0:
            shapes.append(rectangle(*(round(side, 6) for side in shape.bounds)))
    return tuple(Marking(shape, Surface.PAINT_GHOST, None) for shape in shapes)


def _direction(edge: Edge) -> int:
    """Return 1 if +X of the stalls that open onto an edge has the edge's direction, else -1."""
    return 1 if edge in {Edge.DOWN, Edge.LEFT} else -1
