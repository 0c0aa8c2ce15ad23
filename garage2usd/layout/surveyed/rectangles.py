"""Rectangles along the axes that fill a ground."""

from collections.abc import Iterator

import numpy as np
import shapely
from numpy.typing import NDArray

__all__ = ["rectangles"]

_FILLED = 0.85
"""Least share of its rectangle that a ground fills to be taken for it."""
_TOUCH_M = 0.05
_MOST_LINES = 16
"""Greatest number of corners along an axis between which rectangles are tried."""


def rectangles(ground: shapely.Polygon, least_m: float) -> Iterator[shapely.Polygon]:
    """Yield rectangles of a least side that fill a ground: itself, or the largest one and those of what it leaves."""
    rest = [ground]
    while rest:
        part = rest.pop()
        box = shapely.box(*part.bounds)
        if part.area < least_m**2:
            continue
        if part.area < _FILLED * box.area:
            inner = _largest_rectangle(part, least_m)
            if inner is None:
                continue
            rest += [piece for piece in shapely.get_parts(part.difference(inner)) if piece.geom_type == "Polygon"]
            box = inner
        left, top, right, bottom = box.bounds
        if min(right - left, bottom - top) >= least_m:
            yield box


def _largest_rectangle(ground: shapely.Polygon, least_m: float) -> shapely.Polygon | None:
    """Return the largest rectangle along the axes between the corners of a ground that lies on it.

    Of a ground with many corners, some of them count.
    """
    corners = shapely.get_coordinates(ground).round(2)
    (left, right), (top, bottom) = (_spans(corners[:, axis], least_m) for axis in (0, 1))
    boxes = shapely.box(left, top[:, None], right, bottom[:, None]).ravel()
    areas = shapely.area(boxes).round(3)
    wide = ground.buffer(_TOUCH_M, join_style="mitre")
    shapely.prepare(wide)
    # the corners of a box are far sooner known to lie outside than the box is known to lie inside
    x0, z0, x1, z1 = shapely.bounds(boxes).T
    is_possible = np.all([shapely.contains_xy(wide, x, z) for x, z in ((x0, z0), (x1, z0), (x1, z1), (x0, z1))], axis=0)
    order = np.argsort(-areas, kind="stable")
    return next((boxes[index] for index in order[is_possible[order]].tolist() if wide.covers(boxes[index])), None)


def _spans(places_m: NDArray[np.float64], least_m: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the starts and ends of all spans of a least length between places, of at most `_MOST_LINES` places."""
    lines = np.unique(places_m)
    if len(lines) > _MOST_LINES:
        lines = lines[np.linspace(0, len(lines) - 1, _MOST_LINES).round().astype(int)]
    start, end = np.triu_indices(len(lines), k=1)
    is_long = lines[end] - lines[start] >= least_m
    return lines[start[is_long]], lines[end[is_long]]
