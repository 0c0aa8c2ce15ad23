"""Whether a rectangle that drives a short arc or straight keeps off convex shapes: compiled, never optimistic.

The ground swept between two poses lies within the convex hull of the two footprints, but for how far an arc bulges
over its chord. The distance between that hull and a convex shape is at least the gap between them along any axis; the
axes tried are the normals of the shape's edges, of both footprints' edges and of the ways of the four corners. What
bulges is taken off the gap. So the clearance is a lower bound, and what is said to be clear is clear.
"""
# ruff: noqa: PLR2004 - the four corners of two rectangles

import math

import numpy as np
from numpy.typing import NDArray

from garage2usd.compiled import Whole, compiled, compiled_inner

__all__ = ["Floats", "box_around", "bulge", "clearance", "corners_at"]

Floats = NDArray[np.float64]
_SHORTEST = 1e-9


@compiled
def corners_at(x: float, z: float, yaw: float, body: Floats, corners: Floats, row: Whole) -> None:
    """Write the footprint of a pose into four rows of `corners`; `body` is nose, tail and half the width."""
    sin, cos = math.sin(yaw), math.cos(yaw)
    for corner in range(4):
        ahead = body[0] if corner < 2 else -body[1]
        left = body[2] if corner in (0, 3) else -body[2]
        corners[row + corner, 0] = x - sin * ahead - cos * left
        corners[row + corner, 1] = z - cos * ahead + sin * left


@compiled_inner
def box_around(corners: Floats, reach: float) -> tuple[float, float, float, float]:
    """Least x and z, and most x and z, within reach of any of the corners."""
    left, low, right, high = np.inf, np.inf, -np.inf, -np.inf
    for corner in range(corners.shape[0]):
        left, right = min(left, corners[corner, 0]), max(right, corners[corner, 0])
        low, high = min(low, corners[corner, 1]), max(high, corners[corner, 1])
    return left - reach, low - reach, right + reach, high + reach


@compiled
def bulge(radius: float, turn: float, body: Floats) -> float:
    """How far the way of any point of the body lies off its chord, at most, on an arc of the rear axle's middle."""
    reach = math.hypot(radius + body[2], max(body[0], body[1]))
    return reach * (1.0 - math.cos(turn / 2))


@compiled
def clearance(corners: Floats, shape: Floats, enough: float) -> float:
    """Least distance, or less, between the hull of two footprints and a convex shape.

    Parameters
    ----------
    corners
        Of both footprints, in the same order; shape (8, 2).
    shape
        Corners of a convex polygon in order, the last perhaps repeated; shape (n, 2).
    enough
        Where a gap is as wide as this, no wider one is looked for.
    """
    count = shape.shape[0]
    widest = -np.inf
    for axis in range(8 + count):
        if axis < 2:  # the edges of the first footprint
            ax, az = corners[axis, 0] - corners[axis + 1, 0], corners[axis, 1] - corners[axis + 1, 1]
        elif axis < 4:  # of the second
            ax, az = corners[axis + 2, 0] - corners[axis + 3, 0], corners[axis + 2, 1] - corners[axis + 3, 1]
        elif axis < 4 + count:
            one, other = axis - 4, (axis - 3) % count
            ax, az = shape[one, 0] - shape[other, 0], shape[one, 1] - shape[other, 1]
        else:
            corner = axis - 4 - count
            ax, az = corners[corner, 0] - corners[corner + 4, 0], corners[corner, 1] - corners[corner + 4, 1]
        length = math.hypot(ax, az)
        if length < _SHORTEST:
            continue
        ax, az = -az / length, ax / length
        low, high = np.inf, -np.inf
        for corner in range(8):
            along = corners[corner, 0] * ax + corners[corner, 1] * az
            low, high = min(low, along), max(high, along)
        shape_low, shape_high = np.inf, -np.inf
        for corner in range(count):
            along = shape[corner, 0] * ax + shape[corner, 1] * az
            shape_low, shape_high = min(shape_low, along), max(shape_high, along)
        widest = max(widest, shape_low - high, low - shape_high)
        if widest >= enough:
            break
    return widest
