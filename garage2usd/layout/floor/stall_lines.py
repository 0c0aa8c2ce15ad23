"""The painted lines of stalls: which of them a pattern has, in the coordinates of a stall (mouth at +Z)."""

import math
from collections.abc import Iterator
from functools import lru_cache

from garage2usd.config.look import MarkingsLook, StallPattern, Wear
from garage2usd.objects.outline import rectangle
from garage2usd.objects.panel import Marking, Paint, Surface

__all__ = ["outer_spans", "stall_lines"]

Span = tuple[float, float]
"""From where to where along a stall, metres from its mouth."""

_MARK_ALONG_M, _MARK_ACROSS_M = 0.9, 0.5
"""How far the marks of corners reach along a stall and across it."""
_BESIDE_M = 0.06
"""From a stall's side to lines that are its own."""
_DOUBLE_GAP_M = 0.2
"""Half of what lies between two parallel lines."""
_DASH_M, _DASH_GAP_M = 0.6, 0.5
_SHARED = {StallPattern.SIDES, StallPattern.CLOSED, StallPattern.DASHED, StallPattern.T_MARKS}
"""Patterns whose side lines lie half on each neighbour."""
_PAINT, _WORN_PAINT = Surface.PAINT_STALL, Surface.PAINT_STALL_WORN
_WHEELS_M = 0.5, 1.0
"""From where to where beside the middle of a stall wheels cross its mouth."""
_UNEVEN = {Wear.LIGHT, Wear.WORN}
"""Wear that is worse where wheels roll; fresh paint and what is nearly gone is the same all over."""


@lru_cache(maxsize=1024)
def stall_lines(width_m: float, length_m: float, look: MarkingsLook) -> tuple[Marking, ...]:
    """The lines of one stall; of a side line that it shares with a neighbour its half."""
    half_width, half_length, line = width_m / 2, length_m / 2, look.line_width_m
    lines = []
    for left, right, near, far in _boxes(half_width, length_m, line, look.pattern):
        is_driven_over = near == 0.0 and far == line and look.wear in _UNEVEN
        for start, end, surface in _worn_pieces(left, right) if is_driven_over else ((left, right, _PAINT),):
            shape = rectangle(round(start, 6), round(half_length - far, 6), round(end, 6), round(half_length - near, 6))
            lines.append(Marking(shape, surface, Paint.STALL_LINE))
    return tuple(lines)


def outer_spans(length_m: float, look: MarkingsLook) -> tuple[Span, ...]:
    """Where along a stall the outer half of its side line lies, which it has where no neighbour is."""
    return _side_spans(length_m, look.pattern) if look.pattern in _SHARED else ()


def _worn_pieces(left: float, right: float) -> Iterator[tuple[float, float, Surface]]:
    """A line across a stall's mouth in pieces, those more worn where wheels cross it."""
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
    if pattern is StallPattern.T_MARKS:
        return (0.0, _MARK_ALONG_M), (length_m - _MARK_ALONG_M, length_m)
    if pattern is StallPattern.DASHED:
        return tuple(_dashes(length_m))
    return ((0.0, length_m),)


def _dashes(length_m: float) -> Iterator[Span]:
    """Dashes that begin and end with one."""
    count = max(round((length_m + _DASH_GAP_M) / (_DASH_M + _DASH_GAP_M)), 2)
    gap_m = (length_m - count * _DASH_M) / (count - 1)
    for index in range(count):
        start = index * (_DASH_M + gap_m)
        yield start, start + _DASH_M


def _boxes(
    half_width: float, length_m: float, line: float, pattern: StallPattern
) -> Iterator[tuple[float, float, float, float]]:
    """Left, right, near and far of each line, the last two from the mouth."""
    rear = length_m - line
    if pattern is StallPattern.NONE:
        return
    if pattern in _SHARED:
        yield from _shared_boxes(half_width, length_m, line, pattern)
        return
    inset = _DOUBLE_GAP_M / 2 if pattern is StallPattern.DOUBLE else _BESIDE_M
    outer, inner = half_width - inset, half_width - inset - line
    if pattern is StallPattern.DOUBLE:
        for sign in (-1, 1):
            yield *_in_order(sign * inner, sign * outer), 0.0, length_m
            # the end of the loop that two neighbours make
            yield *_in_order(sign * outer, sign * half_width), 0.0, line
        yield -inner, inner, rear, length_m
        return
    ends = [(0.0, line, 0.0, _MARK_ALONG_M)]
    if pattern is StallPattern.L_MARKS:
        ends.append((rear, length_m, length_m - _MARK_ALONG_M, length_m))
    for near, far, start, end in ends:
        for sign in (-1, 1):
            yield *_in_order(sign * inner, sign * outer), start, end
            yield *_in_order(sign * (outer - _MARK_ACROSS_M), sign * inner), near, far


def _shared_boxes(
    half_width: float, length_m: float, line: float, pattern: StallPattern
) -> Iterator[tuple[float, float, float, float]]:
    """The same for patterns whose side lines lie half on each neighbour."""
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
            yield *_in_order(sign * half_width, sign * (half_width - half)), max(start, least), min(end, most)


def _in_order(one: float, other: float) -> tuple[float, float]:
    return (one, other) if one < other else (other, one)
