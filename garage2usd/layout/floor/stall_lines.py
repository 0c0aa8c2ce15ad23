"""Painted stall lines by pattern, in the coordinates of a stall (mouth at +Z)."""

import math
from collections.abc import Iterator
from functools import lru_cache

from garage2usd.config.look import MarkingsLook, StallPattern, Wear
from garage2usd.objects.outline import rectangle
from garage2usd.objects.panel import Marking, Paint, Surface

__all__ = ["outer_spans", "stall_lines"]

Span = tuple[float, float]
"""Start and end along a stall, metres from its mouth."""

_MARK_ALONG_M, _MARK_ACROSS_M = 0.9, 0.5
"""Lengths of corner marks along a stall and across it."""
_BESIDE_M = 0.06
"""Distance from a stall's side to lines of its own."""
_DOUBLE_GAP_M = 0.2
"""Half the distance between two parallel lines."""
_DASH_M, _DASH_GAP_M = 0.6, 0.5
_SHARED = {StallPattern.SIDES, StallPattern.CLOSED, StallPattern.DASHED, StallPattern.T_MARKS}
"""Patterns with side lines shared by neighbours, half on each stall."""
_PAINT, _WORN_PAINT = Surface.PAINT_STALL, Surface.PAINT_STALL_WORN
_WHEELS_M = 0.5, 1.0
"""Range of the wheel tracks across a mouth, metres from the middle of the stall."""
_UNEVEN = {Wear.LIGHT, Wear.WORN}
"""Degrees of wear with more wear in wheel tracks; fresh paint and faded paint are uniform."""


@lru_cache(maxsize=1024)
def stall_lines(width_m: float, length_m: float, look: MarkingsLook) -> tuple[Marking, ...]:
    """Return the painted lines of one stall; of a shared side line, the half on this stall."""
    half_width, half_length, line = width_m / 2, length_m / 2, look.line_width_m
    lines = []
    for left, right, near, far in _line_boxes(half_width, length_m, line, look.pattern):
        is_driven_over = near == 0.0 and far == line and look.wear in _UNEVEN
        for start, end, surface in _worn_pieces(left, right) if is_driven_over else ((left, right, _PAINT),):
            shape = rectangle(round(start, 6), round(half_length - far, 6), round(end, 6), round(half_length - near, 6))
            lines.append(Marking(shape, surface, Paint.STALL_LINE))
    return tuple(lines)


def outer_spans(length_m: float, look: MarkingsLook) -> tuple[Span, ...]:
    """Return the spans along a stall of the outer half of a side line, needed at sides without a neighbour."""
    return _side_spans(length_m, look.pattern) if look.pattern in _SHARED else ()


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


def _side_spans(length_m: float, pattern: StallPattern) -> tuple[Span, ...]:
    """Return the painted spans of a shared side line."""
    if pattern is StallPattern.T_MARKS:
        return (0.0, _MARK_ALONG_M), (length_m - _MARK_ALONG_M, length_m)
    if pattern is StallPattern.DASHED:
        return tuple(_dashes(length_m))
    return ((0.0, length_m),)


def _dashes(length_m: float) -> Iterator[Span]:
    """Yield the dashes of a line; the first begins and the last ends at the ends of the line."""
    count = max(round((length_m + _DASH_GAP_M) / (_DASH_M + _DASH_GAP_M)), 2)
    gap_m = (length_m - count * _DASH_M) / (count - 1)
    for index in range(count):
        start = index * (_DASH_M + gap_m)
        yield start, start + _DASH_M


def _line_boxes(
    half_width: float, length_m: float, line: float, pattern: StallPattern
) -> Iterator[tuple[float, float, float, float]]:
    """Yield each line of a pattern as left, right, near and far, the last two in metres from the mouth."""
    rear = length_m - line
    if pattern is StallPattern.NONE:
        return
    if pattern in _SHARED:
        yield from _shared_line_boxes(half_width, length_m, line, pattern)
        return
    inset = _DOUBLE_GAP_M / 2 if pattern is StallPattern.DOUBLE else _BESIDE_M
    outer, inner = half_width - inset, half_width - inset - line
    if pattern is StallPattern.DOUBLE:
        for sign in (-1, 1):
            yield *_ascending(sign * inner, sign * outer), 0.0, length_m
            # the end of the loop shared by two neighbours
            yield *_ascending(sign * outer, sign * half_width), 0.0, line
        yield -inner, inner, rear, length_m
        return
    ends = [(0.0, line, 0.0, _MARK_ALONG_M)]
    if pattern is StallPattern.L_MARKS:
        ends.append((rear, length_m, length_m - _MARK_ALONG_M, length_m))
    for near, far, start, end in ends:
        for sign in (-1, 1):
            yield *_ascending(sign * inner, sign * outer), start, end
            yield *_ascending(sign * (outer - _MARK_ACROSS_M), sign * inner), near, far


def _shared_line_boxes(
    half_width: float, length_m: float, line: float, pattern: StallPattern
) -> Iterator[tuple[float, float, float, float]]:
    """Yield the boxes of patterns with shared side lines, as `_line_boxes` does."""
    half = line / 2
    ends = [(length_m - line, length_m)] + [(0.0, line)] * (pattern is not StallPattern.SIDES)
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
    most = length_m - line if pattern in {StallPattern.SIDES, StallPattern.CLOSED} else length_m
    for start, end in _side_spans(length_m, pattern):
        for sign in (-1, 1):
            yield *_ascending(sign * half_width, sign * (half_width - half)), max(start, least), min(end, most)


def _ascending(one: float, other: float) -> tuple[float, float]:
    """Return two numbers in ascending order."""
    return (one, other) if one < other else (other, one)
