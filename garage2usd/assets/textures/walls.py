"""Textures of the standard walls."""

import numpy as np

from garage2usd.assets.fields import Field, clouds, grain, noise, ramp, spots
from garage2usd.assets.textures.pixels import Bakers, Pixels, distance_to, mixed_over, normal_map, packed, shaded

__all__ = ["WALLS", "sheet_tones"]

# sheets of formwork, 2.7 m by 1.35 m, with the holes of their ties

# in repeats of 8.1 m by 4.05 m
_SHEETS_ACROSS, _SHEETS_UP_WALL = 3, 3
_WALL_REPEAT_UP_M = 4.05
_BAND_M = 1.1


def _wall_relief(shape: tuple[int, int]) -> tuple[Field, Field]:
    """Proximity of each pixel to a joint of the formwork, and to a tie hole; 0 to 1."""
    rows, columns = shape
    up, across = rows // _SHEETS_UP_WALL, columns // _SHEETS_ACROSS
    pixel = 2040 / columns
    joint = np.maximum(
        ramp(distance_to(shape, across, 1) * pixel, 3.6, 0.8), ramp(distance_to(shape, up, 0) * pixel, 3.6, 0.8)
    )
    aside, above = distance_to(shape, across // 2, 1, across // 4), distance_to(shape, up, 0, up // 2)
    hole = np.sqrt(aside * aside + above * above) * pixel
    return joint, ramp(hole, 7.0, 3.5)


def _below_top(rows: int) -> Field:
    """Distance in metres of each texture row from the top of a wall."""
    return (np.arange(rows) * (_WALL_REPEAT_UP_M / rows))[:, None]


def sheet_tones(rng: np.random.Generator, shape: tuple[int, int], sheets: tuple[int, int]) -> Field:
    """A random tone for each sheet of formwork, 0 to 1."""
    tones = rng.integers(0, 1024, size=sheets).astype(np.float64) / 1023.0
    return tones.repeat(shape[0] // sheets[0], axis=0).repeat(shape[1] // sheets[1], axis=1)


def _wall_colour(rng: np.random.Generator) -> Pixels:
    shape = 1020, 2040
    value = 172.0 + 24.0 * (clouds(rng, shape, (4, 8), 6) - 0.5) + 10.0 * (grain(rng, shape) - 0.5)
    value += 9.0 * (sheet_tones(rng, shape, (_SHEETS_UP_WALL, _SHEETS_ACROSS)) - 0.5)
    # air holes, then the water that ran down from the slab, and its soot
    value -= 44.0 * spots(rng, shape, 900, (1.0, 3.6))
    below = _below_top(shape[0])
    columns = noise(rng, shape, (4, 110)) * noise(rng, (1, shape[1]), (1, 16))
    value -= 34.0 * ramp(columns, 0.3, 0.62) * ramp(below / (0.25 + 1.6 * columns), 1.0, 0.1)
    value -= 30.0 * ramp(below + 0.25 * (clouds(rng, shape, (12, 24), 4) - 0.5), 0.42, 0.0)
    joint, hole = _wall_relief(shape)
    value -= 30.0 * joint * (0.55 + 0.45 * noise(rng, shape, (18, 36))) + 62.0 * hole
    return shaded(value, (1.0, 0.988, 0.962))


def _wall_packed(rng: np.random.Generator) -> Pixels:
    shape = 204, 408
    joint, hole = _wall_relief(shape)
    occlusion = 1.0 - 0.35 * joint - 0.55 * hole - 0.4 * ramp(_below_top(shape[0]), 0.45, 0.0)
    rough = 0.84 + 0.14 * (clouds(rng, shape, (5, 10), 3) - 0.5)
    return packed(np.clip(occlusion, 0.2, 1.0), np.clip(rough, 0.6, 1.0))


def _wall_normal(rng: np.random.Generator) -> Pixels:
    shape = 516, 1032
    joint, hole = _wall_relief(shape)
    return normal_map(clouds(rng, shape, (22, 44), 2) - 0.7 * joint - 1.6 * hole, 0.4)


def _above_foot(rows: int) -> Field:
    """Metres above the foot of a wall's painted band, 1.1 m high."""
    return ((rows - 0.5 - np.arange(rows)) * (_BAND_M / rows))[:, None]


def _band_colour(rng: np.random.Generator) -> Pixels:
    shape = 256, 2048
    value = 122.0 + 14.0 * (clouds(rng, shape, (2, 14), 4) - 0.5) + 5.0 * (grain(rng, shape) - 0.5)
    base = shaded(value, (0.72, 0.95, 1.05))
    above = _above_foot(shape[0])
    # scraped by bumpers, chipped, and splashed from the floor
    bumper = ramp(np.abs(above - 0.5), 0.13, 0.02) * ramp(noise(rng, shape, (48, 15)), 0.68, 0.9)
    base = mixed_over(base, (58, 56, 54), 0.6 * bumper)
    chips = ramp(clouds(rng, shape, (10, 74), 4) - 0.12 * ramp(above, 0.3, 0.8), 0.66, 0.70)
    base = mixed_over(base, (150, 147, 140), 0.85 * chips)
    splash = ramp(above + 0.34 * (clouds(rng, shape, (4, 30), 5) - 0.5), 0.30, -0.06)
    return mixed_over(base, (66, 62, 56), np.clip(0.9 * splash, 0.0, 1.0))


def _band_packed(rng: np.random.Generator) -> Pixels:
    shape = 64, 512
    above = _above_foot(shape[0])
    occlusion = 1.0 - 0.45 * ramp(above, 0.35, 0.0) * np.ones(shape)
    rough = 0.42 + 0.45 * ramp(above + 0.3 * (clouds(rng, shape, (4, 30), 3) - 0.5), 0.34, 0.0)
    return packed(occlusion, np.clip(rough + 0.08 * (noise(rng, shape, (8, 60)) - 0.5), 0.2, 1.0))


WALLS: Bakers = {
    "wall_colour.jpg": _wall_colour,
    "wall_packed.png": _wall_packed,
    "wall_normal.png": _wall_normal,
    "band_colour.jpg": _band_colour,
    "band_packed.png": _band_packed,
}
