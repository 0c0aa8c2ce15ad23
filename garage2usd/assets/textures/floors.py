"""Textures of the standard floor."""

import numpy as np

from garage2usd.assets.fields import clouds, grain, ramp, spots
from garage2usd.assets.textures.pixels import Bakers, Pixels, normal_map, packed, shaded

__all__ = ["FLOORS"]

# floors: 8.1 m per repeat, the usual side of a square, so that the pattern continues across squares


def _floor_colour(rng: np.random.Generator) -> Pixels:
    shape = 2048, 2048
    value = 112.0 + 34.0 * (clouds(rng, shape, (7, 7), 6) - 0.5)
    # pale laitance and darker, denser spots, as a power float leaves them
    value += 9.0 * ramp(clouds(rng, shape, (9, 9), 6), 0.5, 0.75)
    value -= 13.0 * ramp(clouds(rng, shape, (11, 11), 6), 0.5, 0.75)
    value -= 22.0 * spots(rng, shape, 420, (1.5, 6.0)) * clouds(rng, shape, (64, 64), 3)
    value += 16.0 * spots(rng, shape, 500, (1.0, 3.0))
    value += 12.0 * (grain(rng, shape) - 0.5)
    return shaded(value, (1.0, 0.992, 0.972))


def _floor_packed(rng: np.random.Generator) -> Pixels:
    shape = 512, 512
    rough = 0.43 + 0.20 * (clouds(rng, shape, (12, 12), 4) - 0.5)
    rough += 0.12 * ramp(clouds(rng, shape, (20, 20), 4), 0.54, 0.74)
    rough -= 0.06 * spots(rng, shape, 60, (3.0, 14.0))
    return packed(1.0, np.clip(rough, 0.2, 0.8))


def _floor_normal(rng: np.random.Generator) -> Pixels:
    shape = 512, 512
    return normal_map(clouds(rng, shape, (36, 36), 3) + 0.4 * spots(rng, shape, 260, (1.0, 2.0)), 0.22)


def _stall_colour(rng: np.random.Generator) -> Pixels:
    shape = 1024, 1024
    value = 132.0 + 26.0 * (clouds(rng, shape, (6, 6), 6) - 0.5) + 8.0 * (grain(rng, shape) - 0.5)
    value -= 14.0 * ramp(clouds(rng, shape, (9, 9), 5), 0.56, 0.76)
    value -= 24.0 * spots(rng, shape, 110, (1.5, 7.0)) * clouds(rng, shape, (48, 48), 3)
    return shaded(value, (0.91, 0.97, 1.0))


FLOORS: Bakers = {
    "floor_colour.jpg": _floor_colour,
    "floor_packed.png": _floor_packed,
    "floor_normal.png": _floor_normal,
    "stall_colour.jpg": _stall_colour,
}
