"""Textures of walls: the standard walls, and finishes of walls and painted columns that can be tinted."""

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets.fields import Field, cells, clouds, grain, joint, noise, ramp, spots, strokes
from garage2usd.assets.textures.paints import Bakers, Pixels, distance_to, mixed_over, normal_map, packed, shaded

# sheets of formwork, 2.7 m by 1.35 m, with the holes of their ties

# in repeats of 8.1 m by 4.05 m
_SHEETS_ACROSS, _SHEETS_UP_WALL = 3, 3
_WALL_REPEAT_UP_M = 4.05
_BAND_M = 1.1
_NEUTRAL = 1.0, 0.996, 0.985
_GREY = 1.0, 1.0, 1.0


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


def _rolled(rng: np.random.Generator, shape: tuple[int, int], per_m: float) -> Field:
    """Rolled paint on plaster or smooth concrete, with `per_m` pixels per metre."""
    rows, columns = (max(3, round(side / per_m)) for side in shape)
    value = 226.0 + 9.0 * (clouds(rng, shape, (rows, columns), 5) - 0.5)
    value += 4.0 * (noise(rng, shape, (3, 5 * columns)) - 0.5) + 4.0 * (grain(rng, shape) - 0.5)
    return value - 30.0 * spots(rng, shape, 12 * rows * columns, (0.6, 1.6))


def _painted(rng: np.random.Generator) -> Pixels:
    """Painted wall, 4.05 m per repeat: dirt films, touched-up places, water runs, hairline cracks."""
    shape = 768, 768
    pixel_mm = 4050 / shape[0]
    value = _rolled(rng, shape, 1000 / pixel_mm)
    rows, columns = np.arange(shape[0])[:, None], np.arange(shape[1])[None, :]
    for _ in range(3):
        top, left = (int(rng.integers(side)) for side in shape)
        high, wide = (int(rng.integers(20, 90)) for _ in range(2))
        away = np.maximum(
            np.abs((rows - top) % shape[0] - high) - high, np.abs((columns - left) % shape[1] - wide) - wide
        )
        value += (4.0 if rng.integers(2) else -5.0) * ramp(away + 6.0 * noise(rng, shape, (40, 40)), 3.0, 0.0)
    dirt = 0.07 * ramp(clouds(rng, shape, (4, 4), 5), 0.5, 0.76)
    run = 0.06 * ramp(noise(rng, shape, (3, 70)), 0.62, 0.95) * ramp(clouds(rng, shape, (3, 9), 3), 0.45, 0.65)
    rubs = 0.16 * strokes(rng, shape, 14, (10.0, 70.0), (0.6, 3.0), 0.1)
    down, across = (40.0 * (clouds(rng, shape, (8, 8), 4) - 0.5) for _ in range(2))
    edges = cells(rng, shape, (3, 3), (down, across)).from_edge
    cracks = 0.9 * joint(edges, 0.5 / pixel_mm * ramp(clouds(rng, shape, (4, 4), 3), 0.52, 0.64))
    return shaded(value * (1.0 - dirt) * (1.0 - run) * (1.0 - rubs) * (1.0 - cracks), _NEUTRAL)


def _column_painted(rng: np.random.Generator) -> Pixels:
    """Painted column, 1.35 m around, 4.05 m up from the foot: scraped by bumpers and doors, splashed from the floor."""
    shape = 576, 192
    value = _rolled(rng, shape, 142.0)
    above_m = ((shape[0] - 0.5 - np.arange(shape[0])) * (4.05 / shape[0]))[:, None]
    reach = ramp(np.abs(above_m - 0.5), 0.5, 0.1)
    # horizontal scrapes, drawn in an image that is stretched sideways
    rubs = np.maximum(
        0.6 * ramp(noise(rng, shape, (115, 5)), 0.8, 1.0), strokes(rng, shape, 50, (6.0, 40.0), (0.6, 2.4))
    )
    chips = ramp(clouds(rng, shape, (60, 20), 3) + 0.08 * reach, 0.76, 0.8)
    splash = ramp(above_m + 0.25 * (clouds(rng, shape, (40, 13), 4) - 0.5), 0.24, -0.02)
    dirt = 0.05 + 0.08 * ramp(clouds(rng, shape, (9, 3), 4), 0.45, 0.75)
    dark = np.maximum(0.45 * rubs * reach, 0.25 * chips * reach)
    return shaded(value * (1.0 - dark) * (1.0 - 0.5 * splash) * (1.0 - dirt), _NEUTRAL)


# blocks of 400 by 200 mm in half bond with mortar 10 mm wide: 4 m a repeat

_COURSES, _BLOCKS = 20, 10

_BLOCK_MM = 400.0, 200.0

_MORTAR_MM = 10.0


def _blocks(shape: tuple[int, int]) -> tuple[NDArray[np.int64], Field]:
    """Index of each pixel's block, and its distance in mm from the centre of the nearest joint."""
    up = (np.arange(shape[0])[:, None] + 0.5) * _COURSES / shape[0] + np.zeros(shape)
    across = (np.arange(shape[1])[None, :] + 0.5) * _BLOCKS / shape[1] + np.zeros(shape)
    course = up.astype(np.int64)
    across = across + 0.5 * (course % 2)
    block = across.astype(np.int64)
    in_up, in_across = up - course, across - block
    away = np.minimum(
        np.minimum(in_across, 1.0 - in_across) * _BLOCK_MM[0], np.minimum(in_up, 1.0 - in_up) * _BLOCK_MM[1]
    )
    return course * _BLOCKS + block % _BLOCKS, away


def _blockwork(rng: np.random.Generator) -> Pixels:
    shape = 960, 960
    block, away_mm = _blocks(shape)
    tones = rng.integers(0, 256, size=_COURSES * _BLOCKS) / 255.0
    value = 198.0 + 16.0 * (tones[block] - 0.5) + 9.0 * (grain(rng, shape) - 0.5)
    value += 18.0 * (clouds(rng, shape, (5, 5), 5) - 0.5) - 24.0 * ramp(clouds(rng, shape, (120, 120), 2), 0.68, 0.8)
    per_mm = shape[0] / (_COURSES * _BLOCK_MM[1])
    mortar = joint(away_mm * per_mm, _MORTAR_MM * per_mm)
    shadow = 0.16 * ramp(away_mm, 11.0, 4.0)
    return shaded((value * (1.0 - mortar) + 184.0 * mortar) * (1.0 - shadow), _NEUTRAL)


def _blockwork_normal(_rng: np.random.Generator) -> Pixels:
    _, away_mm = _blocks((480, 480))
    return normal_map(ramp(away_mm, 3.0, 9.0), 0.7)


# panels: 2.7 m a repeat; boards of fibre cement 1.35 by 2.7 m, and steel sheet with a rib every 0.25 m


def _panels(rng: np.random.Generator) -> Pixels:
    """Fibre cement boards on screws, with open joints 8 mm wide."""
    shape = 512, 512
    pixel_mm = 2700 / shape[0]
    value = 204.0 + 7.0 * (clouds(rng, shape, (4, 4), 5) - 0.5) + 8.0 * (grain(rng, shape) - 0.5)
    value += np.repeat(np.array([2.5, -2.5]), shape[1] // 2)[None, :]
    value -= 12.0 * ramp(noise(rng, shape, (4, 50)), 0.6, 0.95) * ramp(clouds(rng, shape, (3, 6), 3), 0.45, 0.65)
    across, up = distance_to(shape, shape[1] // 2, 1), distance_to(shape, shape[0], 0)
    # a screw every 0.45 m, 40 mm from the borders of its board
    screw_up = distance_to(shape, shape[0] // 6, 0, shape[0] // 12)
    screw = np.sqrt((across - 40.0 / pixel_mm) ** 2 + screw_up * screw_up)
    dark = np.maximum(0.86 * joint(np.minimum(across, up), 8.0 / pixel_mm), 0.3 * ramp(screw, 2.0, 0.8))
    return shaded(value * (1.0 - dark), _NEUTRAL)


def _sheet_steel(rng: np.random.Generator) -> Pixels:
    """Lacquered steel sheets, dull and dirty between their ribs."""
    shape = 256, 256
    value = 212.0 + 8.0 * (clouds(rng, shape, (4, 4), 4) - 0.5)
    hollow = ramp(_from_rib_mm(shape), 30.0, 60.0)
    run = ramp(noise(rng, shape, (3, 60)), 0.6, 0.95)
    return shaded(value * (1.0 - 0.05 * hollow) * (1.0 - 0.10 * run), _GREY)


def _from_rib_mm(shape: tuple[int, int]) -> Field:
    """Distance from the centre of the nearest rib; 1 m per repeat."""
    period = shape[1] // 4
    return distance_to(shape, period, 1, period // 2) * (1000.0 / shape[1])


def _sheet_steel_normal(_rng: np.random.Generator) -> Pixels:
    """Normal map of ribs 35 mm high, with flanks of 60 degrees."""
    shape = 256, 256
    height_mm = 35.0 * np.clip((52.0 - _from_rib_mm(shape)) / 20.0, 0.0, 1.0)
    # heights in pixels; central differences span two pixels
    return normal_map(height_mm * (shape[1] / 1000.0), 0.5)


def _dado(rng: np.random.Generator) -> Pixels:
    """Painted foot of a wall, 1.1 m high and 8.1 m per repeat: scraped by bumpers, splashed from the floor."""
    shape = 256, 2048
    above_m = ((shape[0] - 0.5 - np.arange(shape[0])) * (1.1 / shape[0]))[:, None]
    value = 214.0 + 12.0 * (clouds(rng, shape, (3, 22), 5) - 0.5) + 4.0 * (grain(rng, shape) - 0.5)
    bumper = 0.5 * ramp(np.abs(above_m - 0.5), 0.2, 0.04) * ramp(noise(rng, shape, (52, 14)), 0.66, 0.92)
    chips = 0.35 * ramp(clouds(rng, shape, (16, 90), 4) - 0.12 * ramp(above_m, 0.3, 0.8), 0.69, 0.73)
    splash = 0.5 * ramp(above_m + 0.34 * (clouds(rng, shape, (4, 30), 5) - 0.5), 0.24, -0.06)
    return shaded(value * (1.0 - bumper) * (1.0 - chips) * (1.0 - splash), _GREY)


WALL_FINISHES: Bakers = {
    "painted_colour.jpg": _painted,
    "column_painted_colour.jpg": _column_painted,
    "blockwork_colour.jpg": _blockwork,
    "blockwork_normal.png": _blockwork_normal,
    "panels_colour.jpg": _panels,
    "sheet_steel_colour.jpg": _sheet_steel,
    "sheet_steel_normal.png": _sheet_steel_normal,
    "dado_colour.jpg": _dado,
}
