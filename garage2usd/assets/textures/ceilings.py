"""Textures of ceilings, and of the bare steel of the services below them."""

import numpy as np

from garage2usd.assets.fields import Field, clouds, grain, joint, noise, ramp, spots
from garage2usd.assets.textures.paints import Bakers, Pixels, distance_to, normal_map, packed, shaded
from garage2usd.assets.textures.walls import sheet_tones

_SHEETS_ACROSS, _SHEETS_ALONG = 3, 6
"""Number of formwork sheets, 2.7 m by 1.35 m, in a repeat of 8.1 m."""
_BOARD_MM = 1200.0, 600.0
_NEUTRAL = 1.0, 0.996, 0.985


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


def _ceiling_painted(rng: np.random.Generator) -> Pixels:
    """Formwork sheets under white paint, marked by soot and water; light, so that it can be tinted."""
    shape = 768, 768
    value = 224.0 + 10.0 * (clouds(rng, shape, (6, 6), 5) - 0.5) + 4.0 * (grain(rng, shape) - 0.5)
    sheets = sheet_tones(rng, shape, (_SHEETS_ALONG, _SHEETS_ACROSS))
    value += 5.0 * (np.roll(sheets, shape[0] // (2 * _SHEETS_ALONG), axis=0) - 0.5)
    water = clouds(rng, shape, (5, 5), 5)
    soot, rims = 0.10 * ramp(clouds(rng, shape, (4, 4), 4), 0.5, 0.75), 0.08 * ramp(np.abs(water - 0.68), 0.012, 0.0)
    joints = 0.12 * _ceiling_joints(shape) * (0.5 + 0.5 * noise(rng, shape, (24, 24)))
    return shaded(value * (1.0 - soot) * (1.0 - rims) * (1.0 - joints), _NEUTRAL)


def _insulation(rng: np.random.Generator) -> Pixels:
    """Boards of mineral wool, 1.2 m by 0.6 m in half bond, each with six washers of 70 mm; 3.6 m per repeat."""
    shape = 960, 960
    pixel_mm = 3600 / shape[0]
    down = (np.arange(shape[0])[:, None] + 0.5) * pixel_mm + np.zeros(shape)
    across = (np.arange(shape[1])[None, :] + 0.5) * pixel_mm + np.zeros(shape)
    row = (down / _BOARD_MM[1]).astype(np.int64)
    across = (across + _BOARD_MM[0] / 2 * (row % 2)) % 3600.0
    board = row * 3 + (across / _BOARD_MM[0]).astype(np.int64)
    in_down, in_across = down % _BOARD_MM[1], across % _BOARD_MM[0]

    tones = rng.integers(0, 256, size=18) / 255.0
    value = 208.0 + 9.0 * (tones[board] - 0.5) + 9.0 * (clouds(rng, shape, (5, 5), 4) - 0.5)
    # fibres lie along and across, in tufts
    value += 9.0 * (noise(rng, shape, (420, 90)) + noise(rng, shape, (90, 420)) - 1.0)
    value -= 9.0 * ramp(clouds(rng, shape, (60, 60), 3), 0.58, 0.75)
    away = np.minimum(np.minimum(in_down, _BOARD_MM[1] - in_down), np.minimum(in_across, _BOARD_MM[0] - in_across))
    gap = 0.6 * joint(away / pixel_mm, 3.0 / pixel_mm) + 0.12 * ramp(away, 14.0, 2.0)
    plate_down = np.abs(np.abs(in_down - _BOARD_MM[1] / 2) - 180.0)
    plate_across = np.abs((in_across - 150.0 + 225.0) % 450.0 - 225.0)
    plate = np.sqrt(plate_down * plate_down + plate_across * plate_across)
    disc = ramp(plate, 36.0, 33.0)
    value = value * (1.0 - disc) + (222.0 - 70.0 * ramp(plate, 7.0, 4.0)) * disc
    dent = 0.22 * ramp(np.abs(plate - 38.0), 7.0, 1.0)
    return shaded(value * (1.0 - gap) * (1.0 - dent), _NEUTRAL)


CEILINGS: Bakers = {
    "ceiling_colour.jpg": _ceiling_colour,
    "ceiling_normal.png": _ceiling_normal,
}

CEILING_FINISHES: Bakers = {
    "ceiling_painted_colour.jpg": _ceiling_painted,
    "insulation_colour.jpg": _insulation,
}


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
