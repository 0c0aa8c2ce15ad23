"""The sight of a camera: outlines of ground polygons in its picture, and points visible by its depth."""

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.sensors.rays.lenses import Lens, Pinhole

_STEP_M = 0.1
"""Step along a polygon's edges, which a fisheye bends."""
_HALVINGS = 30
_FARTHEST_PX = 1e6
_LEAST_POINTS = 3
Points = NDArray[np.float64]


def outline_in_picture(corners_m: Points, project: Callable[[Points], Points]) -> shapely.Geometry:
    """Project a ground polygon to its outline in a picture, clipped to the lens's field of view.

    Parameters
    ----------
    corners_m
        Corners of the polygon, in order; shape (n, 3).
    project
        Projection from points in metres, shape (n, 3), to (column, row) in pixels, shape (n, 2); NaN outside the field
        of view.

    Returns
    -------
    shapely.Geometry
        Valid geometry in pixels; empty if the polygon is outside the field of view.
    """
    steps: list[Points] = []
    for start, end in pairwise([*corners_m, corners_m[0]]):
        count = max(1, math.ceil(np.linalg.norm(end - start) / _STEP_M))
        steps.append(start + np.arange(count)[:, None] / count * (end - start))
    points = np.concatenate(steps)
    places = project(points)
    is_seen = np.isfinite(places).all(axis=1)
    if not is_seen.any():
        return shapely.Polygon()
    if not is_seen.all():
        places = np.concatenate(list(_up_to_the_rim(points, places, is_seen, project)))
    if len(places) < _LEAST_POINTS:
        return shapely.Polygon()
    return shapely.make_valid(shapely.Polygon(places))


def _up_to_the_rim(
    points: Points, places: Points, is_seen: NDArray[np.bool_], project: Callable[[Points], Points]
) -> Iterator[Points]:
    """Yield an outline's visible points in the picture, and points on the edge of view for invisible runs.

    A point on the edge is the last visible one on the straight line from the middle visible point of the outline to an
    invisible one. The visible part of a plane, or its complement, is convex, so each line leaves it once.
    """
    # begin the order with the first point of a visible run
    first = int(np.flatnonzero(is_seen & ~np.roll(is_seen, 1))[0])
    order = np.roll(np.arange(len(points)), -first)
    runs = np.split(order, np.flatnonzero(np.diff(is_seen[order])) + 1)
    longest = max(runs[::2], key=len)
    middle = points[longest[len(longest) // 2]]
    for seen, unseen in zip(runs[::2], runs[1::2], strict=True):
        yield places[seen]
        after = (unseen[-1] + 1) % len(points)
        inner = np.concatenate([points[seen[-1:]], np.broadcast_to(middle, (len(unseen), 3)), points[[after]]])
        outer = points[np.concatenate([unseen[:1], unseen, unseen[-1:]])]
        rim = _last_seen(inner, outer, project)
        # between the ends of the rim, drop points that a pinhole projects nearly to infinity
        is_near = np.abs(rim).max(axis=1) < _FARTHEST_PX
        is_near[[0, -1]] = True
        yield rim[is_near]


def _last_seen(inner_m: Points, outer_m: Points, project: Callable[[Points], Points]) -> Points:
    """Project the last visible points on lines from visible to invisible points, by bisection."""
    places = project(inner_m)
    for _ in range(_HALVINGS):
        middle = (inner_m + outer_m) / 2
        found = project(middle)
        is_seen = np.isfinite(found).all(axis=1)[:, None]
        places = np.where(is_seen, found, places)
        inner_m, outer_m = np.where(is_seen, middle, inner_m), np.where(is_seen, outer_m, middle)
    return places


def polygons_of(geometry: shapely.Geometry) -> Sequence[shapely.Polygon]:
    """Return the polygons of a geometry, possibly none."""
    parts = shapely.get_parts(shapely.get_parts(geometry))  # twice, for a collection of several multipolygons
    return [part for part in parts if isinstance(part, shapely.Polygon)]


def seen_points(
    lens: Lens, depth_m: NDArray[np.floating[Any]], sensor_to_world: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Unproject a depth picture to the point seen at each pixel.

    Parameters
    ----------
    lens
        Lens of the picture.
    depth_m
        Depth along the axis for pinholes and bird's-eye views, along the ray for other lenses; not finite where nothing
        is hit; shape (rows, columns).
    sensor_to_world
        Transform from camera axes (OpenCV's) to the world, in metres; float64, shape (4, 4).

    Returns
    -------
    ndarray
        Points in the world, float64, shape (rows, columns, 3); not finite where nothing is hit.
    """
    middles = lens.middles()
    rays = lens.rays(middles)
    if isinstance(lens, Pinhole):
        rays /= rays[:, 2:]
    depth = np.where(np.isfinite(depth_m), depth_m, np.nan).reshape(-1, 1)
    points = lens.starts(middles) + rays * depth
    world: NDArray[np.float64] = points @ sensor_to_world[:3, :3].T + sensor_to_world[:3, 3]
    return world.reshape(*depth_m.shape, 3)
