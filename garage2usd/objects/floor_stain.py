"""Stains and wear of the floor as thin sheets: oil, damp, cracks, tyre marks, and puddles with their outlines."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import affinity

from garage2usd.assets.flat import GRID_M, flat_part
from garage2usd.assets.mesh import Asset, Face, make_part
from garage2usd.assets.stain_texture import CELLS, CELLS_ACROSS, DIRT_CELLS, REPAIR_CELLS, Cell
from garage2usd.common.randomness import Step, generator
from garage2usd.config.look import Dirt
from garage2usd.objects.kind import Kind, Spec, TilePart

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
KIND = Kind("floor_stain", number=26, label="floor_stain", cityscapes="road", is_solid=False, part=TilePart.PARKING)
Projection = Callable[[NDArray[np.float64], NDArray[np.float64]], NDArray[np.float64]]
_MATERIALS = {"oil": "stain_oil", "drips": "stain_oil", "damp": "stain_damp", "patch": "stain_patch"}
_ALL_CELLS = {**CELLS, **REPAIR_CELLS}
_TYRE_WIDTH_M = 0.24
_GAUGE_M = 1.55
_STEP_DEG = 7.5
_EDGE = 1 / 512
"""Margin around each cell of the stain texture, so that mipmaps do not mix it with its neighbours."""


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


_MATERIALS |= dict.fromkeys(REPAIR_CELLS, "asphalt_repair")


class StainMark(StrEnum):
    """The marks of stains on a floor."""

    WEAR_STRAIGHT = "wear_straight"
    """Wheel tracks from -Z to +Z; a bend joins +Z and +X, a T-junction lets +Z into the lane along X."""
    WEAR_BEND = "wear_bend"
    WEAR_T = "wear_t"
    WEAR_CROSS = "wear_cross"
    OIL = "oil"
    DRIPS = "drips"
    DAMP = "damp"
    CRACK = "crack"
    PATCH = "patch"
    SEAM = "seam"
    """Crack of old asphalt, sealed with bitumen."""
    REPAIR = "repair"
    """Patch of old asphalt with a sealed border."""


@dataclass(frozen=True)
class StainSpec(Spec, kind=KIND):
    """A floor stain on a rectangle; origin in its middle."""

    mark: StainMark
    variant: int
    width_m: float
    depth_m: float

    def asset(self) -> Asset:
        """Make the mesh of a floor stain: a level sheet with the top of its texture cell to -Z."""
        x, z = self.width_m / 2, self.depth_m / 2
        left, top, right, bottom = _bounds(self._cell())

        def project(corners: NDArray[np.float64], _normals: NDArray[np.float64]) -> NDArray[np.float64]:
            across, down = corners[:, 0] / self.width_m + 0.5, corners[:, 2] / self.depth_m + 0.5
            return np.stack([left + (right - left) * across, 1 - top - (bottom - top) * down], axis=1)

        face = np.array([(-x, 0, -z), (-x, 0, z), (x, 0, z), (x, 0, -z)])
        return Asset((make_part("Mark", [face], self._material(), project=project),))

    def _cell(self) -> Cell:
        return _ALL_CELLS[self.mark][self.variant]

    def _material(self) -> str:
        return _MATERIALS.get(self.mark, "stain_rubber")


@dataclass(frozen=True)
class DirtSpec(StainSpec):
    """Wear of a lane square by wheels, lighter or darker than the floor; its mark is a pattern of wear."""

    dirt: Dirt

    def _cell(self) -> Cell:
        return DIRT_CELLS[self.dirt][self.mark][self.variant]

    def _material(self) -> str:
        return "dirt"


@dataclass(frozen=True)
class PuddleSpec(Spec, kind=KIND):
    """A puddle with its damp border, filling a rectangle of the floor; origin in its middle."""

    variant: int
    width_m: float
    depth_m: float

    def asset(self) -> Asset:
        """Make the meshes of a puddle: reflecting water and the wet floor around it, both translucent."""
        outline = puddle_outline(self.variant, self.width_m, self.depth_m)
        return Asset(
            (
                flat_part("Water", outline.water, "puddle_water", collider=None),
                flat_part("Damp", outline.damp, "puddle_damp", collider=None),
            )
        )


@dataclass(frozen=True)
class TyreMarkSpec(Spec, kind=KIND):
    """The tyre marks of a car; origin in the middle of their end, where the car moved to -Z.

    Attributes
    ----------
    length_m
        Length of the path midway between the marks.
    turn_rad
        Angle by which the car turned along it; positive if it came from +X.
    """

    variant: int
    length_m: float
    turn_rad: float = 0.0

    def asset(self) -> Asset:
        """Make the meshes of the tyre marks of two wheels."""
        cell = _bounds(CELLS["tyre"][self.variant])
        parts = [
            make_part(name, faces, "stain_rubber", project=_along_strip(cell, faces))
            for name, side in (("Left", -1), ("Right", 1))
            for faces in [_strip(side * _GAUGE_M / 2, self.length_m, self.turn_rad)]
        ]
        return Asset(tuple(parts))


def _strip(offset_m: float, length_m: float, turn_rad: float) -> list[Face]:
    """Return the faces of one wheel's tyre mark, from its end back to its start, `offset_m` right of the middle."""
    count = max(1, math.ceil(math.degrees(abs(turn_rad)) / _STEP_DEG))
    inner, outer = offset_m - _TYRE_WIDTH_M / 2, offset_m + _TYRE_WIDTH_M / 2
    rows = []
    for index in range(count + 1):
        turned = turn_rad * index / count
        if turn_rad:
            radius, sin, cos = length_m / turn_rad, math.sin(turned), math.cos(turned)
            rows.append([(radius - (radius - side) * cos, 0.0, (radius - side) * sin) for side in (inner, outer)])
        else:
            rows.append([(side, 0.0, length_m * index / count) for side in (inner, outer)])
    return [np.array([first[0], second[0], second[1], first[1]]) for first, second in pairwise(rows)]


def _along_strip(cell: tuple[float, float, float, float], faces: list[Face]) -> Projection:
    """Return texture coordinates along a tyre mark: its end at the top of the cell, its start at the bottom."""
    left, top, right, bottom = cell
    places = []
    for index in range(len(faces)):
        for across, step in ((0, 0), (0, 1), (1, 1), (1, 0)):
            down = (index + step) / len(faces)
            places.append((left + (right - left) * across, 1 - top - (bottom - top) * down))
    known, coordinates = np.concatenate(faces), np.array(places)

    def project(corners: NDArray[np.float64], _normals: NDArray[np.float64]) -> NDArray[np.float64]:
        away = np.abs(corners[:, None] - known[None]).sum(axis=2)
        found: NDArray[np.float64] = coordinates[away.argmin(axis=1)]
        return found

    return project


def _bounds(cell: Cell) -> tuple[float, float, float, float]:
    """Return left, top, right and bottom of a cell of the stain texture, as shares of the texture."""
    x, y, width, height = (value / CELLS_ACROSS for value in cell)
    return x + _EDGE, y + _EDGE, x + width - _EDGE, y + height - _EDGE
