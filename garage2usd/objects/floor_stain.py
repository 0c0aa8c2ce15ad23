"""Stains and wear of the floor as thin sheets: oil, damp, cracks, patches, tyre marks, wheel tracks and puddles."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets.asphalt_repairs import REPAIR_CELLS
from garage2usd.assets.flat import flat_part
from garage2usd.assets.mesh import Asset, Face, make_part
from garage2usd.assets.puddle_outline import puddle_outline
from garage2usd.assets.stain_texture import CELLS, CELLS_ACROSS, DIRT_CELLS, Cell
from garage2usd.config.look import Dirt
from garage2usd.objects.kind import Kind, Spec, TilePart

__all__ = ["KIND", "DirtSpec", "PuddleSpec", "StainMark", "StainSpec", "TyreMarkSpec"]

KIND = Kind("floor_stain", number=26, label="floor_stain", cityscapes="road", is_solid=False, part=TilePart.PARKING)

Projection = Callable[[NDArray[np.float64], NDArray[np.float64]], NDArray[np.float64]]
_MATERIALS = {"oil": "stain_oil", "drips": "stain_oil", "damp": "stain_damp", "patch": "stain_patch"}
_MATERIALS |= dict.fromkeys(REPAIR_CELLS, "asphalt_repair")
_ALL_CELLS = {**CELLS, **REPAIR_CELLS}
_TYRE_WIDTH_M = 0.24
_GAUGE_M = 1.55
_STEP_DEG = 7.5
_EDGE = 1 / 512
"""Margin around each cell of the stain texture, so that mipmaps do not mix it with its neighbours."""


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
    """A floor stain on a square of a lane that wheels made lighter or darker; its mark is one of wear."""

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
