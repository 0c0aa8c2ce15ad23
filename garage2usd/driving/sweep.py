"""Collision test of a rectangle on a short arc or straight against convex shapes; implemented in C in `sweep.c`."""

from typing import NamedTuple

import numpy as np

from garage2usd.native import Bools, Float64Cube, Float64s, Float64Table, Int64s, in_c

__all__ = ["Floats", "Scene", "bulge", "least_clearance", "touched_shapes"]

Floats = Float64s


class Scene(NamedTuple):
    """A car and its obstacles.

    Attributes
    ----------
    shapes
        Corners of convex polygons in order, the last possibly repeated; shape (m, k, 2).
    boxes
        Left, top, right and bottom of each; shape (m, 4).
    body
        Distances from the rear axle to nose and tail, and half the width.
    """

    shapes: Float64Cube
    boxes: Float64Table
    body: Floats


@in_c
def bulge(radius: float, turn: float, body: Floats) -> float:
    """Bound the deviation of any point of the car's body from its chord, on an arc of the rear axle's middle."""
    raise NotImplementedError


def touched_shapes(scene: Scene, pose: Floats, margin: float) -> Int64s:
    """Return the numbers of the shapes closer than a margin to a car at a pose (x, z, yaw)."""
    is_touched = np.zeros(len(scene.shapes), np.bool_)
    _mark_touched(scene, pose, margin, is_touched)
    return np.flatnonzero(is_touched)


@in_c
def _mark_touched(scene: Scene, pose: Floats, margin: float, is_touched: Bools) -> None:
    raise NotImplementedError


def least_clearance(scene: Scene, poses: Floats, bulges: Floats, most: float) -> float:
    """Return a lower bound of the distance to shapes along poses (x, z, yaw) with a bulge per step, at most `most`."""
    return _least_along(scene, poses, len(poses) - 1, bulges, most)


@in_c
def _least_along(scene: Scene, poses: Floats, steps: int, bulges: Floats, most: float) -> float:
    raise NotImplementedError
