"""Textures of bare steel."""

import numpy as np

from garage2usd.assets.fields import clouds, noise, ramp
from garage2usd.assets.textures.pixels import Bakers, Pixels, packed, shaded

__all__ = ["STEELS"]


def _steel_colour(rng: np.random.Generator) -> Pixels:
    shape = 256, 256
    value = 178.0 + 26.0 * (clouds(rng, shape, (10, 10), 3) - 0.5) + 10.0 * (noise(rng, shape, (64, 64)) - 0.5)
    return shaded(value, (0.98, 0.99, 1.0))


def _steel_packed(rng: np.random.Generator) -> Pixels:
    """Surface of spangled zinc, dull at white corrosion."""
    shape = 128, 128
    dull = ramp(clouds(rng, shape, (6, 6), 4), 0.5, 0.75)
    rough = 0.36 + 0.16 * (noise(rng, shape, (28, 28)) - 0.5) + 0.26 * dull
    return packed(1.0, rough, 0.92 - 0.35 * dull)


STEELS: Bakers = {
    "steel_colour.jpg": _steel_colour,
    "steel_packed.png": _steel_packed,
}
