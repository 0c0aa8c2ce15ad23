"""Periodic noise and shapes as arrays, for textures.

Only sums, products, square roots and integers are used, since sines, exponentials and matrix products differ in the
last bit between CPUs.
"""

import numpy as np
from numpy.typing import NDArray

__all__ = ["Field", "clouds", "grain", "noise", "ramp", "spots"]

Field = NDArray[np.float64]
"""Periodic field of float64, shape (rows, columns), about 0 to 1."""

Shape = tuple[int, int]

_SLOPES = np.array(
    [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0), (0.7, 0.7), (-0.7, 0.7), (0.7, -0.7), (-0.7, -0.7)]
)


def noise(rng: np.random.Generator, shape: Shape, cells: Shape) -> Field:
    """Periodic value noise from a lattice of `cells` (down, across), 0 to 1."""
    lattice = rng.integers(0, 1024, size=cells).astype(np.float64) / 1023.0
    (top, bottom, down), (left, right, across) = (
        _lattice_places(side, count) for side, count in zip(shape, cells, strict=True)
    )
    rows = lattice[top] * (1 - down)[:, None] + lattice[bottom] * down[:, None]
    field: Field = rows[:, left] * (1 - across) + rows[:, right] * across
    return field


def _lattice_places(side: int, cells: int) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64]]:
    """For each pixel, the lattice points before and after it, and its fraction between them."""
    place = np.arange(side) * (cells / side)
    low = place.astype(np.int64)
    part = place - low
    return low, (low + 1) % cells, part * part * (3.0 - 2.0 * part)


def _gradient_noise(rng: np.random.Generator, shape: Shape, cells: Shape) -> Field:
    """Periodic gradient noise (Perlin 1985), with less visible lattice than value noise; 0 to 1, mostly near 0.5."""
    down_slope, across_slope = _SLOPES[rng.integers(len(_SLOPES), size=cells)].transpose(2, 0, 1)
    (top, bottom, low), (left, right, far) = (
        _lattice_places(side, count) for side, count in zip(shape, cells, strict=True)
    )
    down, across = (np.arange(side) * (count / side) % 1.0 for side, count in zip(shape, cells, strict=True))
    # interpolates rows first, while the array has only as many columns as lattice cells
    steep = down_slope[top] * (down * (1 - low))[:, None] + down_slope[bottom] * ((down - 1) * low)[:, None]
    level = across_slope[top] * (1 - low)[:, None] + across_slope[bottom] * low[:, None]
    field = steep[:, left] * (1 - far) + steep[:, right] * far
    field += level[:, left] * (across * (1 - far)) + level[:, right] * ((across - 1) * far)
    gradient: Field = 0.5 + 0.75 * field
    return gradient


def clouds(rng: np.random.Generator, shape: Shape, cells: Shape, octaves: int) -> Field:
    """Fractal sum of `octaves` of gradient noise, 0 to 1, with a mean near 0.5."""
    total = np.zeros(shape)
    weight, weights = 1.0, 0.0
    for octave in range(octaves):
        total += weight * _gradient_noise(rng, shape, (cells[0] * 2**octave, cells[1] * 2**octave))
        weights += weight
        weight *= 0.55
    return total / weights


def grain(rng: np.random.Generator, shape: Shape) -> Field:
    """Fine noise of single pixels, 0 to 1."""
    return rng.integers(0, 256, size=shape).astype(np.float64) / 255.0


def ramp(field: Field, low: float, high: float) -> Field:
    """Smooth step from 0 below `low` to 1 above `high`; descending if `low` is the larger."""
    part = np.clip((field - low) / (high - low), 0.0, 1.0)
    return part * part * (3.0 - 2.0 * part)


def spots(rng: np.random.Generator, shape: Shape, count: int, radius: tuple[float, float]) -> Field:
    """Soft round spots, 0 to 1, with radii in pixels."""
    field = np.zeros(shape)
    rows, columns = shape
    for _ in range(count):
        x, y = int(rng.integers(columns)), int(rng.integers(rows))
        size = radius[0] + (radius[1] - radius[0]) * (rng.integers(0, 1000) / 999.0)
        strength = 0.3 + 0.7 * (rng.integers(0, 1000) / 999.0)
        reach = int(size) + 1
        steps = np.arange(-reach, reach + 1)
        fall = 1.0 - (steps[None, :] ** 2 + steps[:, None] ** 2) / size**2
        window = np.ix_((y + steps) % rows, (x + steps) % columns)
        field[window] = np.maximum(field[window], strength * np.clip(fall, 0.0, 1.0))
    return field
