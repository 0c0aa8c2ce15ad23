"""Slabs of an SDF world in place of level sheets, on whose triangles physics engines let wheels stumble or sink in."""

from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

Floats = NDArray[np.float64]
THICKNESS_M = 0.05
"""Thickness of the slab below a sheet."""
_GRID_M = 1e-4
_GAP_M, _SLIVER_M2 = 5e-4, 0.01
"""Half the width of a gap, and the area of a hole, up to which sheets meet but for single precision."""
_ONE_HEIGHT_M = 0.01
"""Distance between heights up to which sheets are one floor, as paint and the floor below it."""


class Slab(NamedTuple):
    """A slab: a box along the axes, or a prism.

    Attributes
    ----------
    middle_m, sides_m
        Middle and sides of a box; None for a prism.
    corners
        Corners of a prism's triangles, outwards; float64, shape (n, 3, 3).
    """

    middle_m: tuple[float, float, float] | None
    sides_m: tuple[float, float, float] | None
    corners: Floats


def slabs(sheets: Floats) -> Iterator[Slab]:
    """Yield slabs whose upper sides cover level sheets.

    Parameters
    ----------
    sheets
        Corners of triangles, each level, in metres with Z up; float64, shape (n, 3, 3).

    Notes
    -----
    Sheets at one height are joined, to a tenth of a millimetre, over gaps of up to a millimetre. An outline along the
    axes is cut into boxes, any other one is a prism.
    """
    heights = sheets[:, :, 2].mean(axis=1)
    order = np.argsort(heights, kind="stable")
    for group in np.split(order, np.flatnonzero(np.diff(heights[order]) > _ONE_HEIGHT_M) + 1):
        outlines = shapely.polygons(sheets[group][:, :, :2])
        areas = shapely.area(outlines)
        levels, level = np.unique(np.round(heights[group], 6), return_inverse=True)
        top_m = float(levels[np.bincount(level.ravel(), areas).argmax()])
        whole = shapely.union_all(shapely.orient_polygons(outlines), grid_size=_GRID_M)
        for off_m in (_GAP_M, -_GAP_M):
            whole = shapely.buffer(whole, off_m, join_style="mitre")
        parts = shapely.get_parts(shapely.set_precision(whole, _GRID_M))
        for part in parts[shapely.area(parts) > _GRID_M]:
            holes = [ring for ring in part.interiors if shapely.Polygon(ring).area > _SLIVER_M2]
            simple = shapely.Polygon(part.exterior, holes).simplify(_GRID_M / 2)
            points, ring = shapely.get_coordinates(simple), _rings(simple)
            sides = (np.abs(np.diff(points, axis=0)) > _GRID_M)[ring]
            if (sides.sum(axis=1) <= 1).all():
                yield from _boxes(simple, top_m)
            else:
                yield Slab(None, None, _prism(simple, top_m))


def _rings(polygon: shapely.Polygon) -> NDArray[np.bool_]:
    """Return for each pair of consecutive coordinates of a polygon if they are of one ring."""
    _, ring = shapely.get_coordinates(shapely.get_rings(polygon), return_index=True)
    same: NDArray[np.bool_] = ring[1:] == ring[:-1]
    return same


def _boxes(polygon: shapely.Polygon, top_m: float) -> Iterator[Slab]:
    """Cut a polygon with sides along the axes into strips, and join those of one width."""
    points = np.round(shapely.get_coordinates(polygon), 4)
    begin, end = points[:-1][_rings(polygon)], points[1:][_rings(polygon)]
    along = begin[:, 0] != end[:, 0]
    left, right = np.minimum(begin[along, 0], end[along, 0]), np.maximum(begin[along, 0], end[along, 0])
    y = begin[along, 1]
    open_since: dict[tuple[float, float], float] = {}
    for x_0, x_1 in pairwise(np.unique(points[:, 0]).tolist()):
        edges = np.sort(y[(left <= x_0) & (right >= x_1)]).tolist()
        strips = {*zip(edges[::2], edges[1::2], strict=True)}
        for strip in sorted({*open_since} - strips):
            yield _box(open_since.pop(strip), x_0, *strip, top_m)
        for strip in strips:
            open_since.setdefault(strip, x_0)
    for strip, since in sorted(open_since.items()):
        yield _box(since, float(points[:, 0].max()), *strip, top_m)


def _box(x_0: float, x_1: float, y_0: float, y_1: float, top_m: float) -> Slab:
    middle = (x_0 + x_1) / 2, (y_0 + y_1) / 2, top_m - THICKNESS_M / 2
    return Slab(middle, (round(x_1 - x_0, 6), round(y_1 - y_0, 6), THICKNESS_M), np.zeros((0, 3, 3)))


def _prism(polygon: shapely.Polygon, top_m: float) -> Floats:
    """Return the triangles of a polygon's prism."""
    flat = shapely.get_parts(shapely.orient_polygons(shapely.constrained_delaunay_triangles(polygon)))
    faces = shapely.get_coordinates(flat).reshape(-1, 4, 2)[:, :3]
    oriented = shapely.orient_polygons(polygon)
    points, same = shapely.get_coordinates(oriented), _rings(oriented)
    begin, end = points[:-1][same], points[1:][same]

    def at(places: Floats, height_m: float) -> Floats:
        return np.concatenate([places, np.full((*places.shape[:-1], 1), height_m)], axis=-1)

    low_m = top_m - THICKNESS_M
    a, b, c, d = at(begin, low_m), at(end, low_m), at(end, top_m), at(begin, top_m)
    sides = [np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)]
    return np.concatenate([at(faces, top_m), at(faces[:, ::-1], low_m), *sides])
