"""Wear of the floor as thin sheets with holes in their opacity: oil, damp, cracks, patches, tyre marks.

All of them show cells of one texture: its colours are those of what stains, its alpha how much of that there is.
"""

import math
from collections.abc import Callable
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets.mesh import Asset, Face, make_part

__all__ = ["CELLS", "CELLS_ACROSS", "LABEL", "floor_stain", "tyre_marks"]

LABEL = "floor_stain"
CELLS_ACROSS = 8
"""Cells across and down the texture; `CELLS` counts in them."""
Cell = tuple[float, float, float, float]
Projection = Callable[[NDArray[np.float64], NDArray[np.float64]], NDArray[np.float64]]

CELLS: dict[str, tuple[Cell, ...]] = {
    "wear_straight": ((0, 0, 2, 2), (2, 0, 2, 2)),
    "wear_bend": ((4, 0, 2, 2),),
    "wear_t": ((6, 0, 2, 2),),
    "wear_cross": ((0, 2, 2, 2),),
    "damp": ((2, 2, 2, 2),),
    "oil": ((4, 2, 1, 1), (5, 2, 1, 1), (6, 2, 1, 1), (7, 2, 1, 1), (4, 3, 1, 1), (5, 3, 1, 1)),
    "patch": ((6, 3, 1, 1), (7, 3, 1, 1)),
    "drips": ((0, 4, 1, 2),),
    "crack": ((1, 4, 1, 3), (2, 4, 1, 3)),
    "tyre": ((3, 4, 0.5, 4), (3.5, 4, 0.5, 4)),
}
"""For each mark the cells of its variants: left, top, width and height."""

_MATERIALS = {"oil": "stain_oil", "drips": "stain_oil", "damp": "stain_damp", "patch": "stain_patch"}
_TYRE_WIDTH_M = 0.24
_GAUGE_M = 1.55
_STEP_DEG = 7.5
_EDGE = 1 / 512
"""What is left out around each cell, so that a small texture does not mix it with its neighbour."""


def floor_stain(mark: str, variant: int, width_m: float, depth_m: float) -> Asset:
    """A mark on a level rectangle that looks up; origin in its middle, the top of its cell to -Z."""
    x, z = width_m / 2, depth_m / 2
    left, top, right, bottom = _bounds(mark, variant)

    def project(corners: NDArray[np.float64], _normals: NDArray[np.float64]) -> NDArray[np.float64]:
        across, down = corners[:, 0] / width_m + 0.5, corners[:, 2] / depth_m + 0.5
        return np.stack([left + (right - left) * across, 1 - top - (bottom - top) * down], axis=1)

    face = np.array([(-x, 0, -z), (-x, 0, z), (x, 0, z), (x, 0, -z)])
    return Asset(LABEL, (make_part("Mark", [face], _MATERIALS.get(mark, "stain_rubber"), project=project),))


def tyre_marks(variant: int, length_m: float, turn_rad: float) -> Asset:
    """The marks of two wheels that end at the origin towards -Z; they turned there from +X, or from -X if negative."""
    cell = _bounds("tyre", variant)
    parts = [
        make_part(name, faces, "stain_rubber", project=_along_strip(cell, faces))
        for name, side in (("Left", -1), ("Right", 1))
        for faces in [_strip(side * _GAUGE_M / 2, length_m, turn_rad)]
    ]
    return Asset(LABEL, tuple(parts))


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


def _bounds(mark: str, variant: int) -> tuple[float, float, float, float]:
    """Left, top, right and bottom of a cell in shares of the texture."""
    x, y, width, height = (value / CELLS_ACROSS for value in CELLS[mark][variant])
    return x + _EDGE, y + _EDGE, x + width - _EDGE, y + height - _EDGE
