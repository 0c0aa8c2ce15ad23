"""Textures of floors: the standard floor, finishes that can be tinted, and roughness from mirror-like to matt."""

from collections.abc import Callable

import numpy as np

from garage2usd.assets.fields import Field, cells, clouds, grain, joint, noise, ramp, spots, strokes, trowel_marks
from garage2usd.assets.textures.paints import Bakers, Pixels, distance_to, levels, normal_map, packed, shaded

_NEUTRAL = 1.0, 0.996, 0.985
_GREY = 1.0, 1.0, 1.0
# concrete and epoxy: 5.4 m per repeat, so that a pixel is 5.3 mm

_SHAPE = 1024, 1024
_PIXEL_MM = 5400 / 1024
_GLOSS_SHAPE = 256, 256
_STEP = 3


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


def _concrete(rng: np.random.Generator) -> Field:
    """Steel-trowelled concrete: pale and burnished places, arcs of the blades, pores."""
    value = 194.0 + 30.0 * (clouds(rng, _SHAPE, (4, 4), 6) - 0.5)
    value += 4.5 * trowel_marks(rng, _SHAPE, 110, (84.0, 150.0), 6.0)
    value -= 16.0 * ramp(clouds(rng, _SHAPE, (7, 7), 5), 0.52, 0.74)
    value -= 26.0 * spots(rng, _SHAPE, 160, (0.8, 2.6))
    return value + 5.0 * (grain(rng, _SHAPE) - 0.5)


def _cracks(rng: np.random.Generator, across: int, widest_mm: float, rim: float) -> Field:
    """Draw cracks along curved edges of cells, with gaps; darkness of each pixel, 0 to 1.

    Parameters
    ----------
    rng, across
        Random generator, and number of cells in a repeat in each direction.
    widest_mm
        Greatest width of a crack.
    rim
        Darkness of dirt at the rims, 16 mm on each side.
    """
    bends = (clouds(rng, _SHAPE, (2 * across, 2 * across), 4) for _ in range(2))
    down, aside = (0.5 * _SHAPE[0] / across * (bend - 0.5) for bend in bends)
    edges = cells(rng, _SHAPE, (across, across), (down, aside)).from_edge
    opened = ramp(clouds(rng, _SHAPE, (5, 5), 3), 0.46, 0.62)
    crack: Field = 0.85 * joint(edges, opened * widest_mm / _PIXEL_MM)
    return crack + rim * opened * np.clip(1.0 - edges * _PIXEL_MM / 16.0, 0.0, 1.0)


def _trowelled(rng: np.random.Generator) -> Pixels:
    value = _concrete(rng)
    return shaded(value * (1.0 - _cracks(rng, 26, 0.3, 0.02)), _NEUTRAL)


def _sawn(rng: np.random.Generator) -> Pixels:
    """A panel of 5.4 m between saw-cut joints 4 mm wide."""
    value = _concrete(rng)
    half = _SHAPE[0] // 2
    away = np.minimum(distance_to(_SHAPE, _SHAPE[0], 0, half), distance_to(_SHAPE, _SHAPE[1], 1, half))
    wander = 0.6 + 0.8 * noise(rng, _SHAPE, (40, 40))
    dirt = 0.16 * ramp(away, 9.0, 0.0) * wander
    return shaded(value * (1.0 - dirt) * (1.0 - 0.78 * joint(away, 4.0 / _PIXEL_MM)), _NEUTRAL)


def _cracked(rng: np.random.Generator) -> Pixels:
    """Old concrete with cracks of 0.2 to 1 mm, finer ones between them, dirt, splashes and rubber."""
    value = _concrete(rng)
    dirt = 0.16 * ramp(clouds(rng, _SHAPE, (3, 3), 6), 0.46, 0.72)
    dirt = np.maximum(dirt, 0.22 * ramp(clouds(rng, _SHAPE, (8, 8), 5), 0.62, 0.74))
    dirt = np.maximum(dirt, 0.28 * ramp(spots(rng, _SHAPE, 110, (2.0, 9.0)), 0.3, 0.8))
    rubber = strokes(rng, _SHAPE, 30, (60.0, 320.0), (2.0, 14.0), 0.15)
    rubber *= 0.16 * ramp(clouds(rng, _SHAPE, (30, 30), 4), 0.3, 0.6)
    cracks = np.maximum(_cracks(rng, 4, 1.0, 0.36), _cracks(rng, 14, 0.4, 0.08))
    return shaded(value * (1.0 - dirt) * (1.0 - rubber) * (1.0 - cracks), _NEUTRAL)


def _epoxy(rng: np.random.Generator) -> Pixels:
    """A rolled epoxy coat: even, with faint roller lanes, scuffs and tyre marks."""
    value = 208.0 + 9.0 * (clouds(rng, _SHAPE, (5, 5), 5) - 0.5)
    lanes = noise(rng, (1, _SHAPE[1]), (1, 22)) + 0.5 * noise(rng, _SHAPE, (3, 44))
    value += 4.0 * (lanes - 0.75) + 3.0 * (grain(rng, _SHAPE) - 0.5)
    rubbed = strokes(rng, _SHAPE, 22, (60.0, 330.0), (1.5, 14.0), 0.12)
    scuffs = 0.16 * rubbed * ramp(clouds(rng, _SHAPE, (30, 30), 4), 0.3, 0.65)
    scratches = 0.09 * strokes(rng, _SHAPE, 130, (12.0, 90.0), (0.5, 1.2))
    film = 0.10 * ramp(clouds(rng, _SHAPE, (4, 4), 5), 0.5, 0.76)
    chips = 0.5 * ramp(spots(rng, _SHAPE, 40, (0.8, 2.4)), 0.3, 0.6)
    return shaded(value * (1.0 - scuffs) * (1.0 - scratches) * (1.0 - film) * (1.0 - chips), _GREY)


# asphalt: 2.1 m a repeat shows its stones, 8.1 m its shades

_STONES_SHAPE = 768, 768

_PATCHED_SHAPE = 1024, 1024


def _asphalt(rng: np.random.Generator) -> Pixels:
    """Asphalt: stones of 4 to 11 mm, whose heads traffic has cleared of bitumen."""
    stones = cells(rng, _STONES_SHAPE, (240, 240))
    tones = rng.integers(0, 256, size=240 * 240) / 255.0
    heads = ramp(stones.from_edge, 0.1, 1.3)
    value = 96.0 + 22.0 * (clouds(rng, _STONES_SHAPE, (5, 5), 4) - 0.5)
    value += heads * (14.0 + 78.0 * tones[stones.which] ** 2)
    return shaded(value + 10.0 * (grain(rng, _STONES_SHAPE) - 0.5), _NEUTRAL)


def _asphalt_patched(rng: np.random.Generator) -> Pixels:
    """Worn asphalt; its patches and cracks are those of `garage2usd.assets.stain_texture`."""
    shape = _PATCHED_SHAPE
    value = 132.0 + 18.0 * (clouds(rng, shape, (5, 5), 5) - 0.5) + 15.0 * (grain(rng, shape) - 0.5)
    return shaded(value, _NEUTRAL)


# blocks of 100 by 200 mm in herringbone: 2.4 m a repeat

_UNITS = 24

_UNIT_MM = 100.0


def _blocks(shape: tuple[int, int]) -> tuple[Field, Field]:
    """Index of each pixel's block, and its distance in mm from the centre of the nearest joint."""
    scale = _UNITS / shape[0]
    down = (np.arange(shape[0])[:, None] + 0.5) * scale + np.zeros(shape)
    across = (np.arange(shape[1])[None, :] + 0.5) * scale + np.zeros(shape)
    row, column = down.astype(np.int64), across.astype(np.int64)
    # each row repeats two squares of a block across, then one square of each of two blocks down
    turn = (column - row) % 4
    lies_across = turn < 2  # noqa: PLR2004
    first_row, first_column = row - (turn == 2), column - (turn == 1)  # noqa: PLR2004
    high, wide = np.where(lies_across, 1, 2), np.where(lies_across, 2, 1)
    in_rows, in_columns = down - first_row, across - first_column
    away = np.minimum(np.minimum(in_rows, high - in_rows), np.minimum(in_columns, wide - in_columns))
    return (first_row % _UNITS * _UNITS + first_column % _UNITS).astype(np.float64), away * _UNIT_MM


def _pavers(rng: np.random.Generator) -> Pixels:
    shape = 960, 960
    which, away_mm = _blocks(shape)
    tones = rng.integers(0, 256, size=_UNITS * _UNITS) / 255.0
    value = 176.0 + 30.0 * (tones[which.astype(np.int64)] - 0.5) + 10.0 * (grain(rng, shape) - 0.5)
    value += 22.0 * (clouds(rng, shape, (5, 5), 5) - 0.5)
    value -= 40.0 * ramp(spots(rng, shape, 300, (0.8, 2.2)), 0.3, 0.7)
    # worn rims, with sand and dirt in the joints
    value -= 26.0 * ramp(away_mm, 9.0, 3.0)
    sand = joint(away_mm * shape[0] / (_UNITS * _UNIT_MM), 4.0 * shape[0] / (_UNITS * _UNIT_MM))
    sand_value = 96.0 + 40.0 * (noise(rng, shape, (60, 60)) - 0.5)
    return shaded(value * (1.0 - sand) + sand_value * sand, _NEUTRAL)


def _pavers_normal(_rng: np.random.Generator) -> Pixels:
    """Chamfers of 8 mm."""
    _, away_mm = _blocks((480, 480))
    return normal_map(ramp(away_mm, 0.0, 8.0), 0.8)


FLOOR_FINISHES: Bakers = {
    "trowelled_colour.jpg": _trowelled,
    "sawn_colour.jpg": _sawn,
    "cracked_colour.jpg": _cracked,
    "epoxy_colour.jpg": _epoxy,
    "asphalt_colour.jpg": _asphalt,
    "asphalt_patched_colour.jpg": _asphalt_patched,
    "pavers_colour.jpg": _pavers,
    "pavers_normal.png": _pavers_normal,
}


def _gloss(smooth: float, rough: float) -> Callable[[np.random.Generator], Pixels]:
    """Texture between two roughness values: polished by use in places, dulled by dust and fine scratches in others."""

    def bake(rng: np.random.Generator) -> Pixels:
        dust = ramp(clouds(rng, _GLOSS_SHAPE, (5, 5), 3), 0.25, 0.75)
        scratches = strokes(rng, _GLOSS_SHAPE, 24, (20.0, 120.0), (1.0, 4.0), 0.12)
        share = np.clip(0.75 * dust + 0.5 * scratches, 0.0, 1.0)
        value = np.rint((smooth + (rough - smooth) * share) * (255 / _STEP)) * _STEP
        return levels(np.stack([np.full(_GLOSS_SHAPE, 255.0), value, np.zeros(_GLOSS_SHAPE)], axis=2))

    return bake


GLOSSES: Bakers = {
    "gloss_mirror.png": _gloss(0.06, 0.12),
    "gloss_polished.png": _gloss(0.15, 0.25),
    "gloss_satin.png": _gloss(0.30, 0.40),
    "gloss_matt.png": _gloss(0.60, 0.80),
}
