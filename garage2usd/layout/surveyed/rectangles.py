"""Rectangles along the axes that fill a ground."""

from collections.abc import Iterator

import numpy as np
import shapely

__all__ = ["rectangles"]

_FILLED = 0.85
"""Least share of its rectangle that a ground fills to be taken for it."""
_TOUCH_M = 0.05


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
    """Return the largest rectangle along the axes between the corners of a ground that lies on it."""
    corners = shapely.get_coordinates(ground).round(2)
    xs, zs = np.unique(corners[:, 0]), np.unique(corners[:, 1])
    wide = ground.buffer(_TOUCH_M, join_style="mitre")
    shapely.prepare(wide)
    found = [
        shapely.box(left, top, right, bottom)
        for index, left in enumerate(xs)
        for right in xs[index + 1 :]
        if right - left >= least_m
        for number, top in enumerate(zs)
        for bottom in zs[number + 1 :]
        if bottom - top >= least_m
    ]
    inside = [box for box in found if wide.covers(box)]
    return max(inside, key=lambda box: round(box.area, 3), default=None)
