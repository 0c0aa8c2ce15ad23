"""Painted lines of stalls by pattern, faded ones of an older layout, and hatching at the ends of rows."""

import math
from collections.abc import Iterator
from functools import lru_cache

import shapely

from garage2usd.config.look import LineEnds, MarkingsLook, StallPattern, Wear
from garage2usd.garage import StallKind
from garage2usd.layout.floor.markings import area_markings
from garage2usd.layout.floor.rounded_lines import LineBox, closed_stall, hairpins, with_round_ends
from garage2usd.layout.placement import PlacedStall, box_inside
from garage2usd.layout.tiles import StallPlace, Tile, row_rectangle
from garage2usd.objects.kind import Box, Point, rectangle
from garage2usd.objects.panel import Marking, Paint, Surface
from garage2usd.structure.stalls import Edge

Span = tuple[float, float]
"""Start and end along a stall, metres from its mouth."""
_MARK_ALONG_M, _MARK_ACROSS_M = 0.9, 0.5
"""Lengths of corner marks along a stall and across it."""
_BESIDE_M = 0.06
"""Distance from a stall's side to lines of its own."""
_GAPS_M = {StallPattern.DOUBLE: 0.2, StallPattern.HAIRPIN: 0.3}
"""Gap between two parallel lines."""
_DASH_M, _DASH_GAP_M = 0.6, 0.5
_SHARED = {StallPattern.SIDES, StallPattern.CLOSED, StallPattern.DASHED, StallPattern.T_MARKS}
"""Patterns with side lines shared by neighbours, half on each stall."""
_PAINT, _WORN_PAINT = Surface.PAINT_STALL, Surface.PAINT_STALL_WORN
_WHEELS_M = 0.5, 1.0
"""Range of the wheel tracks across a mouth, metres from the middle of the stall."""
_UNEVEN = {Wear.LIGHT, Wear.WORN}
"""Degrees of wear with more wear in wheel tracks; fresh paint and faded paint are uniform."""
_ROWS = ((0.8, -0.45, True), (-0.6, -0.85, False), (1.25, -0.6, True))
"""Each older row: offset of its lines along the newer row, depth of its mouths inside the newer ones, both in metres,
and True if a line closed its stalls."""
GHOST_ROWS = len(_ROWS)
"""Number of older rows."""
_LENGTHENED = 1.04
"""Width of an older stall, relative to a newer stall."""
_LEAST_M = 0.2
"""Least width of hatched floor."""
_STRIPE_M, _PERIOD_M = 0.14, 0.62
_LEAST_M2 = 1e-4


@lru_cache(maxsize=1024)
def stall_lines(width_m: float, length_m: float, look: MarkingsLook, slope: float = 0.0) -> tuple[Marking, ...]:
    """Return a stall's lines before they are slanted by `slope`; of shared side lines, the half on the stall."""
    half_width, half_length, line = width_m / 2, length_m / 2, look.line_width_m
    if _is_round(look):
        stall = shapely.box(-half_width, 0, half_width, length_m)
        ground = _round_ground(width_m, length_m, look, slope).intersection(stall)
        return tuple(
            _round_lines(shapely.transform(ground, lambda at: at * (1, -1) + (0, half_length)), half_length, look)
        )
    lines = []
    for left, right, near, far in _line_boxes(half_width, length_m, look):
        is_driven_over = near == 0.0 and far == line and look.wear in _UNEVEN
        for start, end, surface in _worn_pieces(left, right) if is_driven_over else ((left, right, _PAINT),):
            shape = rectangle(round(start, 6), round(half_length - far, 6), round(end, 6), round(half_length - near, 6))
            lines.append(Marking(shape, surface, Paint.STALL_LINE))
    return tuple(lines)


def outer_spans(length_m: float, look: MarkingsLook) -> tuple[Span, ...]:
    """Return the spans along a stall of the outer half of a side line, needed at sides without a neighbour."""
    return _side_spans(length_m, look) if look.pattern in _SHARED and not _is_round(look) else ()


@lru_cache(maxsize=1024)
def outer_round_lines(width_m: float, length_m: float, look: MarkingsLook) -> tuple[Marking, ...]:
    """Return the outer half of a round side line, in metres outwards from the side and inwards from the mouth."""
    if look.pattern not in _SHARED or not _is_round(look):
        return ()
    side = width_m / 2
    beyond = shapely.box(side, 0, side + look.line_width_m / 2, length_m)
    outer = shapely.transform(_round_ground(width_m, length_m, look).intersection(beyond), lambda at: at - (side, 0))
    return area_markings(outer, _PAINT, Paint.STALL_LINE)


def _is_round(look: MarkingsLook) -> bool:
    return look.pattern is StallPattern.HAIRPIN or look.line_ends is LineEnds.ROUND


@lru_cache(maxsize=1024)
def _round_ground(width_m: float, length_m: float, look: MarkingsLook, slope: float = 0.0) -> shapely.Geometry:
    """Return the painted ground of a pattern with round parts, across from the stall's middle and from its mouth."""
    half_width, line = width_m / 2, look.line_width_m
    boxes = list(_line_boxes(half_width, length_m, look))
    if look.pattern is StallPattern.HAIRPIN:
        loops = hairpins(half_width, length_m, line, _GAPS_M[look.pattern], slope)
        return shapely.union_all([loops, *(shapely.box(left, near, right, far) for left, right, near, far in boxes)])
    if look.pattern is StallPattern.CLOSED:
        far_m = length_m if look.closed_behind else 2 * length_m
        return closed_stall(half_width, far_m, line, look.corner_radius_m)
    return with_round_ends(boxes, half_width, line)


def _round_lines(ground: shapely.Geometry, mouth_m: float, look: MarkingsLook) -> Iterator[Marking]:
    """Yield the markings of painted ground, with worn paint where wheels cross lines at a mouth."""
    low, high = _WHEELS_M
    tracks = [
        shapely.box(min(near, far), mouth_m - look.line_width_m, max(near, far), mouth_m)
        for near, far in ((-high, -low), (low, high))
        if look.wear in _UNEVEN
    ]
    worn = shapely.union_all(tracks)
    yield from area_markings(ground.difference(worn), _PAINT, Paint.STALL_LINE)
    yield from area_markings(ground.intersection(worn), _WORN_PAINT, Paint.STALL_LINE)


def _worn_pieces(left: float, right: float) -> Iterator[tuple[float, float, Surface]]:
    """Split a line across a stall's mouth into pieces, with worn paint in the wheel tracks."""
    low, high = _WHEELS_M
    for start, end, surface in (
        (-math.inf, -high, _PAINT),
        (-high, -low, _WORN_PAINT),
        (-low, low, _PAINT),
        (low, high, _WORN_PAINT),
        (high, math.inf, _PAINT),
    ):
        if max(left, start) < min(right, end):
            yield max(left, start), min(right, end), surface


def _side_spans(length_m: float, look: MarkingsLook) -> tuple[Span, ...]:
    """Return the painted spans of a shared side line."""
    if look.pattern is StallPattern.T_MARKS:
        return (0.0, _MARK_ALONG_M), *([(length_m - _MARK_ALONG_M, length_m)] if look.closed_behind else [])
    if look.pattern is StallPattern.DASHED:
        return tuple(_dashes(length_m))
    return ((0.0, length_m),)


def _dashes(length_m: float) -> Iterator[Span]:
    """Yield the dashes of a line; the first begins and the last ends at the ends of the line."""
    count = max(round((length_m + _DASH_GAP_M) / (_DASH_M + _DASH_GAP_M)), 2)
    gap_m = (length_m - count * _DASH_M) / (count - 1)
    for index in range(count):
        start = index * (_DASH_M + gap_m)
        yield start, start + _DASH_M


def _line_boxes(half_width: float, length_m: float, look: MarkingsLook) -> Iterator[LineBox]:
    """Yield each straight line of a pattern; of a hairpin, only the line at the rear."""
    pattern, line = look.pattern, look.line_width_m
    rear = length_m - line
    if pattern is StallPattern.NONE:
        return
    if pattern in _SHARED:
        yield from _shared_line_boxes(half_width, length_m, look)
        return
    inset = _GAPS_M.get(pattern, 2 * _BESIDE_M) / 2
    outer, inner = half_width - inset, half_width - inset - line
    if pattern is StallPattern.DOUBLE:
        for sign in (-1, 1):
            yield *_ascending(sign * inner, sign * outer), 0.0, length_m
            # end of the loop that two adjacent stalls share
            yield *_ascending(sign * outer, sign * half_width), 0.0, line
    if pattern in _GAPS_M:
        if look.closed_behind:
            yield -inner, inner, rear, length_m
        return
    ends = [(0.0, line, 0.0, _MARK_ALONG_M)]
    if pattern is StallPattern.L_MARKS and look.closed_behind:
        ends.append((rear, length_m, length_m - _MARK_ALONG_M, length_m))
    for near, far, start, end in ends:
        for sign in (-1, 1):
            yield *_ascending(sign * inner, sign * outer), start, end
            yield *_ascending(sign * (outer - _MARK_ACROSS_M), sign * inner), near, far


def _shared_line_boxes(half_width: float, length_m: float, look: MarkingsLook) -> Iterator[LineBox]:
    """Yield the boxes of patterns with shared side lines, as `_line_boxes` does."""
    pattern, line = look.pattern, look.line_width_m
    half = line / 2
    ends = [(length_m - line, length_m)] * look.closed_behind + [(0.0, line)] * (pattern is not StallPattern.SIDES)
    for near, far in ends:
        if pattern is StallPattern.T_MARKS:
            yield -half_width, -half_width + _MARK_ACROSS_M, near, far
            yield half_width - _MARK_ACROSS_M, half_width, near, far
        elif pattern is StallPattern.DASHED:
            for start, end in _dashes(2 * half_width):
                yield start - half_width, end - half_width, near, far
        else:
            yield -half_width, half_width, near, far
    # the ends of closed lines are drawn already
    least = line if pattern is StallPattern.CLOSED else 0.0
    is_ended = look.closed_behind and pattern in {StallPattern.SIDES, StallPattern.CLOSED}
    most = length_m - line if is_ended else length_m
    for start, end in _side_spans(length_m, look):
        for sign in (-1, 1):
            yield *_ascending(sign * half_width, sign * (half_width - half)), max(start, least), min(end, most)


def _ascending(one: float, other: float) -> tuple[float, float]:
    """Return two numbers in ascending order."""
    return (one, other) if one < other else (other, one)


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


def row_end_hatching(tile: Tile, places: list[StallPlace], look: MarkingsLook) -> tuple[Marking, ...]:
    """Hatch the floor between the outermost stalls of a square and its sides; adjacent hatchings form chevrons."""
    markings: list[Marking] = []
    line = look.line_width_m
    for place in places:
        row, edge, count = place.row, place.row.edge, place.row.count
        if row.shape.kind is StallKind.ANGLED:
            continue
        half, length = tile.half_x_m if edge.along_x else tile.half_z_m, row.shape.depth_m
        inner = -row.starts_m[0] + line / 2
        if half - inner < _LEAST_M:
            continue
        ends = [-1] * (place.is_first and place.slot == 0) + [1] * (place.is_last and place.slot == count - 1)
        for side in ends:
            for polygon in _stripes(inner, half, length, line):
                corners = [row_rectangle(tile, edge, side * x, side * x, (z, z))[0] for x, z in polygon]
                markings.append(Marking(tuple(corners), Surface.PAINT_EDGE, Paint.HATCHING))
    return tuple(markings)


def _stripes(inner: float, outer: float, length: float, line: float) -> list[tuple[tuple[float, float], ...]]:
    """Frame and stripes in coordinates along the row, from its centre, and inwards from the stalls' entries."""
    field = shapely.box(inner, line, outer, length - line)
    shapes = [rectangle(inner, 0.0, outer, line), rectangle(inner, length - line, outer, length)]
    wide = outer - inner
    for index in range(int((length + wide) / _PERIOD_M) + 1):
        near = index * _PERIOD_M - wide
        bar = shapely.Polygon(
            [(inner, near), (outer, near + wide), (outer, near + wide + _STRIPE_M), (inner, near + _STRIPE_M)]
        ).intersection(field)
        if bar.geom_type == "Polygon" and bar.area > _LEAST_M2:
            shapes.append(tuple(map(tuple, shapely.get_coordinates(bar.exterior)[:-1].tolist())))
    return shapes
