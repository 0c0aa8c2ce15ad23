"""Texture of the repairs of old asphalt: cracks sealed with bitumen, and patches with sealed borders."""

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets.fields import Field, clouds, noise, ramp
from garage2usd.assets.stain_texture import CELLS_ACROSS, Cell

__all__ = ["REPAIR_CELLS", "bake_repairs"]

REPAIR_CELLS: dict[str, tuple[Cell, ...]] = {
    "seam": tuple((column, 0, 1, 4) for column in range(4)),
    "repair": tuple((column, 4, 2, 2) for column in range(0, 8, 2)),
}
"""Cells of the variants of each mark: left, top, width and height, as in `garage2usd.assets.stain_texture.CELLS`."""
_CELL_PIXELS = 128
_BITUMEN_RGB, _OLD_RGB, _NEW_RGB = (40, 40, 41), (166, 165, 161), (62, 62, 63)
_BORDER = 0.07
"""Width of the margin around a patch, as a share of its cell."""


def bake_repairs(rng: np.random.Generator) -> NDArray[np.uint8]:
    """Draw the texture of asphalt repairs; uint8, shape (rows, columns, 4)."""
    side = CELLS_ACROSS * _CELL_PIXELS
    pixels = np.zeros((side, side, 4), dtype=np.uint8)
    pixels[:, :, :3] = _BITUMEN_RGB
    for mark, cells in REPAIR_CELLS.items():
        for number, cell in enumerate(cells):
            left, top, width, height = (int(value * _CELL_PIXELS) for value in cell)
            window = pixels[top : top + height, left : left + width]
            shape = height, width
            if mark == "seam":
                window[:, :, 3] = _levels(_seam(rng, shape))
                continue
            inside, border = _patch(rng, shape)
            window[border <= inside, :3] = _NEW_RGB if number % 2 else _OLD_RGB
            window[:, :, 3] = _levels(np.maximum(inside, border))
    return pixels


def _levels(share: Field) -> NDArray[np.uint8]:
    levels: NDArray[np.uint8] = np.clip(np.rint(share * 255), 0, 255).astype(np.uint8)
    return levels


def _seam(rng: np.random.Generator, shape: tuple[int, int]) -> Field:
    """A sealed crack along a cell, with a branch that leaves it."""
    rows, columns = shape
    row, column = np.arange(rows, dtype=np.float64)[:, None], np.arange(columns, dtype=np.float64)[None, :]
    place = columns * (0.5 + 0.75 * (clouds(rng, (rows, 1), (3, 1), 6) - 0.5))
    start, end = rows * (0.15 + 0.5 * rng.random()), rows * (0.85 + 0.1 * rng.random())
    away = (row - start) * (0.12 + 0.18 * rng.random()) * (1.0 if rng.random() < 1 / 2 else -1.0)
    branch = place + away + columns * 0.5 * (clouds(rng, (rows, 1), (5, 1), 5) - 0.5)
    half = 1.6 + 2.4 * noise(rng, (rows, 1), (14, 1))
    lines = ramp(np.abs(column - place) - half, 0.8, -0.8)
    forked = ramp(np.abs(column - branch) - 0.8 * half, 0.8, -0.8) * (row > start) * (row < end)
    ends = ramp(row / rows, 0.01, 0.03) * ramp(row / rows, 0.99, 0.97)
    inside = ramp(np.minimum(column, columns - 1.0 - column), 1.0, 4.0)
    seam: Field = 0.74 * np.maximum(lines, forked) * ends * inside
    return seam


def _patch(rng: np.random.Generator, shape: tuple[int, int]) -> tuple[Field, Field]:
    """The surface of a patch, and the bitumen along its border."""
    rows, columns = shape
    down, across = (np.arange(side, dtype=np.float64) + 0.5 for side in shape)
    away = np.minimum(
        np.minimum(down, rows - down)[:, None] / rows, np.minimum(across, columns - across)[None, :] / columns
    )
    away = away + 0.014 * (clouds(rng, shape, (9, 9), 2) - 0.5)
    inside = 0.42 * ramp(away, _BORDER, _BORDER + 0.006)
    return inside, 0.66 * ramp(np.abs(away - _BORDER), 0.018, 0.015)
