"""The textures of ceilings."""

import numpy as np

from garage2usd.assets.fields import Field, clouds, grain, noise, ramp, spots
from garage2usd.assets.textures.pixels import Bakers, Pixels, distance_to, normal_map, shaded
from garage2usd.assets.textures.walls import sheet_tones

__all__ = ["CEILINGS"]

_SHEETS_ACROSS, _SHEETS_ALONG = 3, 6
"""Of formwork, 2.7 m by 1.35 m, in a repeat of 8.1 m."""


def _ceiling_joints(shape: tuple[int, int]) -> Field:
    rows, columns = shape
    pixel = 1024 / columns
    along = distance_to(shape, rows // _SHEETS_ALONG, 0, rows // (2 * _SHEETS_ALONG)) * pixel
    across = distance_to(shape, columns // _SHEETS_ACROSS, 1) * pixel
    return np.maximum(ramp(along, 1.8, 0.4), ramp(across, 1.8, 0.4))


def _ceiling_colour(rng: np.random.Generator) -> Pixels:
    shape = 1020, 1020
    value = 164.0 + 20.0 * (clouds(rng, shape, (6, 6), 5) - 0.5) + 8.0 * (grain(rng, shape) - 0.5)
    sheets = sheet_tones(rng, shape, (_SHEETS_ALONG, _SHEETS_ACROSS))
    value += 13.0 * (np.roll(sheets, shape[0] // (2 * _SHEETS_ALONG), axis=0) - 0.5)
    value -= 20.0 * ramp(clouds(rng, shape, (5, 5), 5), 0.6, 0.8)
    value -= 26.0 * spots(rng, shape, 260, (0.8, 2.4))
    value -= 34.0 * _ceiling_joints(shape) * (0.5 + 0.5 * noise(rng, shape, (24, 24)))
    return shaded(value, (1.0, 0.99, 0.968))


def _ceiling_normal(rng: np.random.Generator) -> Pixels:
    shape = 516, 516
    return normal_map(clouds(rng, shape, (20, 20), 2) - 1.2 * _ceiling_joints(shape), 0.3)


CEILINGS: Bakers = {
    "ceiling_colour.jpg": _ceiling_colour,
    "ceiling_normal.png": _ceiling_normal,
}
