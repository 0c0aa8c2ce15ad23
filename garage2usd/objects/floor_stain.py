"""Wear of the floor as thin sheets: oil, damp, cracks, patches, tyre marks, dirt along the ways of wheels, puddles."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

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
_TYRE_WIDTH_M = 0.24
_GAUGE_M = 1.55
_STEP_DEG = 7.5
_EDGE = 1 / 512
"""What is left out around each cell, so that a small texture does not mix it with its neighbour."""


class StainMark(StrEnum):
    """What stains a floor."""

    WEAR_STRAIGHT = "wear_straight"
    """Wheels that rolled from -Z to +Z; a bend joins +Z and +X, a T-junction lets +Z into the lane along X."""
    WEAR_BEND = "wear_bend"
    WEAR_T = "wear_t"
    WEAR_CROSS = "wear_cross"
    OIL = "oil"
    DRIPS = "drips"
    DAMP = "damp"
    CRACK = "crack"
    PATCH = "patch"


@dataclass(frozen=True)
class StainSpec(Spec, kind=KIND):
    """A stain on a rectangle of the floor; origin in its middle."""

    mark: StainMark
    variant: int
    width_m: float
    depth_m: float

    def asset(self) -> Asset:
        """A level sheet with the top of its cell to -Z."""
        x, z = self.width_m / 2, self.depth_m / 2
        left, top, right, bottom = _bounds(self._cell())

        def project(corners: NDArray[np.float64], _normals: NDArray[np.float64]) -> NDArray[np.float64]:
            across, down = corners[:, 0] / self.width_m + 0.5, corners[:, 2] / self.depth_m + 0.5
            return np.stack([left + (right - left) * across, 1 - top - (bottom - top) * down], axis=1)

        face = np.array([(-x, 0, -z), (-x, 0, z), (x, 0, z), (x, 0, -z)])
        return Asset((make_part("Mark", [face], self._material(), project=project),))

    def _cell(self) -> Cell:
        return CELLS[self.mark][self.variant]

    def _material(self) -> str:
        return _MATERIALS.get(self.mark, "stain_rubber")


@dataclass(frozen=True)
class DirtSpec(StainSpec):
    """A square of a lane that wheels have made less or more dark than usual; its mark is one of wear."""

    dirt: Dirt

    def _cell(self) -> Cell:
        return DIRT_CELLS[self.dirt][self.mark][self.variant]

    def _material(self) -> str:
        return "dirt"


@dataclass(frozen=True)
class PuddleSpec(Spec, kind=KIND):
    """A puddle that fills a rectangle of the floor with its damp border; origin in its middle."""

    variant: int
    width_m: float
    depth_m: float

    def asset(self) -> Asset:
        """Water that mirrors, and the wet floor around it; both let the floor be seen."""
        outline = puddle_outline(self.variant, self.width_m, self.depth_m)
        return Asset(
            (
                flat_part("Water", outline.water, "puddle_water", collider=None),
                flat_part("Damp", outline.damp, "puddle_damp", collider=None),
            )
        )


@dataclass(frozen=True)
class TyreMarkSpec(Spec, kind=KIND):
    """The marks of a car's wheels; origin in the middle of their end, where the car moved to -Z.

    Attributes
    ----------
    length_m
        Of the way between them.
    turn_rad
        By how much the car turned on it; positive where it came from +X.
    """

    variant: int
    length_m: float
    turn_rad: float = 0.0

    def asset(self) -> Asset:
        """The marks of two wheels."""
        cell = _bounds(CELLS["tyre"][self.variant])
        parts = [
            make_part(name, faces, "stain_rubber", project=_along_strip(cell, faces))
            for name, side in (("Left", -1), ("Right", 1))
            for faces in [_strip(side * _GAUGE_M / 2, self.length_m, self.turn_rad)]
        ]
        return Asset(tuple(parts))


def _strip(offset_m: float, length_m: float, turn_rad: float) -> list[Face]:
    """The faces of one wheel's mark, from its end back to its start, `offset_m` to the right of the middle."""
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
    """Texture coordinates along a strip: its end at the top of the cell, its start at the bottom."""
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
    """Left, top, right and bottom of a cell in shares of the texture."""
    x, y, width, height = (value / CELLS_ACROSS for value in cell)
    return x + _EDGE, y + _EDGE, x + width - _EDGE, y + height - _EDGE
