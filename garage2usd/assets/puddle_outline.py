"""Outlines of puddles as water in hollows of an uneven floor."""

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np
import shapely
from shapely import affinity

from garage2usd.assets.flat import GRID_M
from garage2usd.common.randomness import Step, generator

__all__ = ["PuddleOutline", "puddle_outline"]

_POINTS, _WAVES = 72, 18
"""Number of corners of a hollow, and of waves around it."""
_HOLLOWS = (3, 6)
_DROPS = (2, 5)
_ROUND_M = 0.012
"""Radius by which corners are rounded."""
_DAMP_M = 0.05
"""Least width of the damp border."""
_LEAST_M2 = 0.0006
_DIGITS = 4


class PuddleOutline(NamedTuple):
    """Areas of a puddle (x, z) in metres around the origin.

    Attributes
    ----------
    water
        Area of standing water.
    damp
        Wet floor around it.
    """

    water: shapely.Geometry
    damp: shapely.Geometry


@lru_cache(maxsize=256)
def puddle_outline(variant: int, width_m: float, depth_m: float) -> PuddleOutline:
    """Make the outline of a puddle whose damp border fills a rectangle.

    Parameters
    ----------
    variant
        Number of the shape, 0 or more.
    width_m, depth_m
        Extent along X and Z.
    """
    rng = generator(variant, Step.PUDDLE_SHAPES)
    hollows, rims = [], []
    for index in range(int(rng.integers(*_HOLLOWS))):
        # hollows lie in a curved row, the widest one in its centre
        along = (0.0, 0.55, -0.5, 0.95, -0.9)[index]
        middle = along + rng.uniform(-0.1, 0.1), rng.uniform(-0.35, 0.35) if index else 0.0
        size = (0.62, 0.45, 0.4, 0.25, 0.2)[index] * rng.uniform(0.8, 1.15)
        hollows.append(_hollow(rng, middle, size, 0.3))
        rims.append(_hollow(rng, middle, size * 1.22 + 0.06, 0.2))
    for _ in range(int(rng.integers(*_DROPS))):
        angle, away = rng.uniform(0, math.tau), rng.uniform(0.75, 1.0)
        middle = 1.15 * away * math.cos(angle), 0.75 * away * math.sin(angle)
        hollows.append(_hollow(rng, middle, rng.uniform(0.02, 0.07), 0.25))
    water, damp = shapely.union_all(hollows), shapely.union_all([*hollows, *rims])
    water, damp = (_filling(area, damp.bounds, width_m - 2 * _DAMP_M, depth_m - 2 * _DAMP_M) for area in (water, damp))
    water = water.buffer(-_ROUND_M, quad_segs=3).buffer(2 * _ROUND_M, quad_segs=3).buffer(-_ROUND_M, quad_segs=3)
    water = _clean(water)
    damp = _clean(shapely.union_all([damp, water]).buffer(_DAMP_M, quad_segs=3))
    return PuddleOutline(water, shapely.difference(damp, water, grid_size=GRID_M))


def _hollow(rng: np.random.Generator, middle: tuple[float, float], size: float, rough: float) -> shapely.Polygon:
    """A circle with random waves, whose amplitude falls with their length."""
    heights, phases = rng.normal(size=_WAVES).tolist(), rng.uniform(0, math.tau, _WAVES).tolist()
    corners = []
    for index in range(_POINTS):
        angle = math.tau * index / _POINTS
        waves = sum(
            height * math.cos(order * angle + phase) / order**1.15
            for order, (height, phase) in enumerate(zip(heights, phases, strict=True), 1)
        )
        radius = size * math.exp(rough * waves)
        corners.append(
            (
                round(middle[0] + radius * math.cos(angle), _DIGITS),
                round(middle[1] + 0.7 * radius * math.sin(angle), _DIGITS),
            )
        )
    return shapely.Polygon(corners).buffer(0)


def _filling(
    area: shapely.Geometry, bounds: tuple[float, float, float, float], width_m: float, depth_m: float
) -> shapely.Geometry:
    """Stretch the bounding box of an area to a size around the origin."""
    x0, z0, x1, z1 = bounds
    moved = affinity.translate(area, -(x0 + x1) / 2, -(z0 + z1) / 2)
    return affinity.scale(moved, width_m / (x1 - x0), depth_m / (z1 - z0), origin=(0, 0))


def _clean(area: shapely.Geometry) -> shapely.Geometry:
    """Remove specks and redundant corners, and snap to the common grid of sheets."""
    parts = [part for part in shapely.get_parts(shapely.simplify(area, 0.003)) if part.area > _LEAST_M2]
    whole = [
        shapely.Polygon(part.exterior, [ring for ring in part.interiors if shapely.Polygon(ring).area > _LEAST_M2])
        for part in parts
    ]
    return shapely.set_precision(shapely.union_all(whole), 1e-4)
