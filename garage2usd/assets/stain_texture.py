"""Textures of stains, dirt and the repairs of old asphalt: colour, and amount as alpha."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets.fields import Field, clouds, grain, noise, ramp, spots
from garage2usd.config.look import Dirt

Cell = tuple[float, float, float, float]
CELLS_ACROSS = 8
"""Number of cells across and down the texture, the unit of `CELLS`."""
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
"""Cells of the variants of each mark: left, top, width and height."""
DIRT_CELLS: dict[Dirt, dict[str, tuple[Cell, ...]]] = {
    dirt: {
        "wear_straight": ((0, top, 2, 2), (2, top, 2, 2)),
        "wear_bend": ((4, top, 2, 2),),
        "wear_t": ((6, top, 2, 2),),
        "wear_cross": ((0, top + 2, 2, 2),),
    }
    for dirt, top in ((Dirt.FAINT, 0), (Dirt.FILTHY, 4))
}
"""Cells in the dirt texture, for degrees of dirt other than usual."""
_CELL_PIXELS = 128
_INK_RGB = {"oil": (26, 23, 20), "drips": (26, 23, 20), "damp": (44, 43, 41), "patch": (138, 135, 128)}
_RUBBER_RGB = (20, 20, 20)
_DIRT_RGB = (24, 21, 18)
_DUST_RGB = (112, 101, 86)
_DUST_PIXELS = 128, 512
_FAINT = 0.45
"""Factor of faint against usual wear."""
_LANE = 0.228
"""Distance of each direction's lane from the centre of a square, as a share of the square's width."""
_WHEEL = 0.096
"""Half of a car's track width, as a share of the square's width."""
REPAIR_CELLS: dict[str, tuple[Cell, ...]] = {
    "seam": tuple((column, 0, 1, 4) for column in range(4)),
    "repair": tuple((column, 4, 2, 2) for column in range(0, 8, 2)),
}
"""Cells of the variants of each mark: left, top, width and height, as in `garage2usd.assets.stain_texture.CELLS`."""
_BITUMEN_RGB, _OLD_RGB, _NEW_RGB = (40, 40, 41), (166, 165, 161), (62, 62, 63)
_BORDER = 0.07
"""Width of the margin around a patch, as a share of its cell."""


def bake_stains(rng: np.random.Generator) -> NDArray[np.uint8]:
    """Draw the texture of stains; uint8, shape (rows, columns, 4)."""
    pixels = _sheet(_RUBBER_RGB)
    for mark, cells in CELLS.items():
        for cell in cells:
            window = _window(pixels, cell)
            window[:, :, :3] = _INK_RGB.get(mark, _RUBBER_RGB)
            window[:, :, 3] = _alpha(_DRAWERS[mark](rng, _shape(window)))
    return pixels


def bake_dirt(rng: np.random.Generator) -> NDArray[np.uint8]:
    """Draw the texture of dirt; uint8, shape (rows, columns, 4)."""
    pixels = _sheet(_DIRT_RGB)
    for dirt, marks in DIRT_CELLS.items():
        for mark, cells in marks.items():
            for cell in cells:
                window = _window(pixels, cell)
                worn = _DRAWERS[mark](rng, _shape(window))
                window[:, :, 3] = _alpha(_FAINT * worn if dirt is Dirt.FAINT else _filthy(rng, worn))
    return pixels


def bake_road_dust(rng: np.random.Generator) -> NDArray[np.uint8]:
    """Draw the texture of dust on car flanks, thick at the bottom, none at the top; uint8, (rows, columns, 4)."""
    shape = _DUST_PIXELS
    pixels = np.zeros((*shape, 4), dtype=np.uint8)
    pixels[:, :, :3] = _DUST_RGB
    down, _ = _places(shape)
    pixels[:, :, 3] = _alpha(0.85 * ramp(down + 0.35 * (clouds(rng, shape, (2, 6), 4) - 0.5) * (1 - down), 0.08, 0.95))
    pixels[0, :, 3] = 0
    return pixels


def _sheet(ink_rgb: tuple[int, int, int]) -> NDArray[np.uint8]:
    side = CELLS_ACROSS * _CELL_PIXELS
    pixels = np.zeros((side, side, 4), dtype=np.uint8)
    pixels[:, :, :3] = ink_rgb
    return pixels


def _window(pixels: NDArray[np.uint8], cell: Cell) -> NDArray[np.uint8]:
    left, top, width, height = (int(value * _CELL_PIXELS) for value in cell)
    return pixels[top : top + height, left : left + width]


def _shape(window: NDArray[np.uint8]) -> tuple[int, int]:
    rows, columns, _ = window.shape
    return rows, columns


def _alpha(share: Field) -> NDArray[np.uint8]:
    levels: NDArray[np.uint8] = np.clip(np.rint(share * 255), 0, 255).astype(np.uint8)
    return levels


def _filthy(rng: np.random.Generator, worn: Field) -> Field:
    """Heavy dirt, with spills between the tracks that end before the border."""
    rows, columns = worn.shape
    spilt = ramp(clouds(rng, (rows, columns), (4, 4), 5), 0.5, 0.68) * _inside((rows, columns), 0.2)
    return np.minimum(1.5 * worn + 0.22 * spilt * ramp(worn, 0.0, 0.1), 0.82)


def _places(shape: tuple[int, int]) -> tuple[Field, Field]:
    """Position of each pixel down and across, 0 to 1."""
    rows, columns = shape
    down = ((np.arange(rows) + 0.5) / rows)[:, None] * np.ones(shape)
    return down, ((np.arange(columns) + 0.5) / columns)[None, :] * np.ones(shape)


def _length(down: Field, across: Field) -> Field:
    return np.sqrt(down * down + across * across)


def _from_middle(shape: tuple[int, int]) -> Field:
    """Distance from the centre, 1 at the nearest border."""
    down, across = _places(shape)
    return _length(2 * down - 1, 2 * across - 1)


def _inside(shape: tuple[int, int], margin: float) -> Field:
    """Mask of 1 inside, falling to 0 at the border."""
    down, across = _places(shape)
    away = np.minimum(np.minimum(down, 1 - down), np.minimum(across, 1 - across))
    return ramp(away, 0.0, margin)


def _oil(rng: np.random.Generator, shape: tuple[int, int]) -> Field:
    away = _from_middle(shape)
    edge = 0.55 - away + 1.1 * (clouds(rng, shape, (3, 3), 4) - 0.5)
    pool = 0.35 * ramp(edge, 0.0, 0.14) + 0.5 * ramp(edge, 0.1, 0.5)
    drops = 0.75 * ramp(spots(rng, shape, 26, (1.5, 5.0)), 0.2, 0.5) * ramp(away, 0.95, 0.6)
    grained = 0.75 + 0.5 * (clouds(rng, shape, (12, 12), 3) - 0.5)
    return np.maximum(pool * grained, drops) * _inside(shape, 0.08)


def _damp(rng: np.random.Generator, shape: tuple[int, int]) -> Field:
    edge = 0.6 - _from_middle(shape) + 1.3 * (clouds(rng, shape, (3, 3), 5) - 0.5)
    return (0.32 * ramp(edge, 0.0, 0.06) + 0.12 * ramp(edge, 0.05, 0.4)) * _inside(shape, 0.06)


def _drips(rng: np.random.Generator, shape: tuple[int, int]) -> Field:
    _, across = _places(shape)
    bent = across + 0.5 * (noise(rng, (shape[0], 1), (3, 1)) - 0.5)
    near = ramp(np.abs(bent - 0.5), 0.16, 0.04)
    drops = ramp(spots(rng, shape, 240, (1.5, 5.5)), 0.2, 0.55)
    return 0.75 * drops * near * _inside(shape, 0.08)


def _patch(rng: np.random.Generator, shape: tuple[int, int]) -> Field:
    down, across = _places(shape)
    ragged = 0.05 * (clouds(rng, shape, (6, 6), 4) - 0.5)
    away = np.minimum(np.minimum(down, 1 - down), np.minimum(across, 1 - across)) + ragged
    return ramp(away, 0.06, 0.085) * (0.62 + 0.7 * (clouds(rng, shape, (5, 5), 4) - 0.5))


def _crack(rng: np.random.Generator, shape: tuple[int, int]) -> Field:
    rows, columns = shape
    down, _ = _places(shape)
    column = np.arange(columns, dtype=np.float64)[None, :]
    lines = np.zeros(shape)
    for spread, strength in ((0.35, 0.8), (0.6, 0.5)):
        wander = clouds(rng, (rows, 1), (3, 1), 6) - 0.5
        place = columns * (0.5 + spread * wander)
        lines = np.maximum(lines, strength * ramp(np.abs(column - place), 1.6, 0.4))
    broken = ramp(noise(rng, (rows, 1), (9, 1)), 0.1, 0.4)
    ends = ramp(down, 0.02, 0.25) * ramp(down, 0.98, 0.7)
    return lines * broken * ends * _inside(shape, 0.02)


def _tyre(rng: np.random.Generator, shape: tuple[int, int]) -> Field:
    down, across = _places(shape)
    shoulders = ramp(np.abs(np.abs(across - 0.5) - 0.26), 0.17, 0.04)
    ribs = 0.35 * ramp(np.abs(across - 0.5), 0.2, 0.1)
    ends = ramp(down, 0.01, 0.3) * ramp(down, 0.99, 0.55)
    patchy = 0.7 + 0.9 * (clouds(rng, shape, (10, 1), 3) - 0.5)
    marks: Field = 0.5 * np.maximum(shoulders, ribs) * ends * patchy * (0.8 + 0.2 * grain(rng, shape))
    return marks


def _lanes(place: Field) -> Field:
    """Wear of a floor across the driving direction, at a position from 0 to 1 across it."""
    away = np.abs(np.abs(place - 0.5) - _LANE)
    return 0.12 * ramp(away, 0.21, 0.08) + 0.24 * ramp(np.abs(away - _WHEEL), 0.075, 0.0)


def _worn(rng: np.random.Generator, shape: tuple[int, int], ways: Field) -> Field:
    """Wear that is uneven inside and even at the border, so that adjacent squares match."""
    uneven = 0.9 * (clouds(rng, shape, (7, 7), 5) - 0.5) + 0.12 * (grain(rng, shape) - 0.5)
    return ways * (1.0 + uneven * _inside(shape, 0.12))


def _around(shape: tuple[int, int], corner_down: int, corner_across: int) -> Field:
    down, across = _places(shape)
    return _lanes(_length(down - corner_down, across - corner_across))


def _wear_straight(rng: np.random.Generator, shape: tuple[int, int]) -> Field:
    return _worn(rng, shape, _lanes(_places(shape)[1]))


def _wear_bend(rng: np.random.Generator, shape: tuple[int, int]) -> Field:
    return _worn(rng, shape, _around(shape, 1, 1))


def _wear_t(rng: np.random.Generator, shape: tuple[int, int]) -> Field:
    turns = np.maximum(_around(shape, 1, 1), _around(shape, 1, 0))
    return _worn(rng, shape, np.maximum(_lanes(_places(shape)[0]), turns))


def _wear_cross(rng: np.random.Generator, shape: tuple[int, int]) -> Field:
    down, across = _places(shape)
    ways = np.maximum(_lanes(down), _lanes(across))
    for corner in ((0, 0), (0, 1), (1, 0), (1, 1)):
        ways = np.maximum(ways, _around(shape, *corner))
    return _worn(rng, shape, ways)


_DRAWERS: dict[str, Callable[[np.random.Generator, tuple[int, int]], Field]] = {
    "wear_straight": _wear_straight,
    "wear_bend": _wear_bend,
    "wear_t": _wear_t,
    "wear_cross": _wear_cross,
    "damp": _damp,
    "oil": _oil,
    "patch": _patch,
    "drips": _drips,
    "crack": _crack,
    "tyre": _tyre,
}


def bake_repairs(rng: np.random.Generator) -> NDArray[np.uint8]:
    """Draw the texture of asphalt repairs; uint8, shape (rows, columns, 4)."""
    pixels = _sheet(_BITUMEN_RGB)
    for mark, cells in REPAIR_CELLS.items():
        for number, cell in enumerate(cells):
            window = _window(pixels, cell)
            shape = _shape(window)
            if mark == "seam":
                window[:, :, 3] = _alpha(_seam(rng, shape))
                continue
            inside, border = _sealed_patch(rng, shape)
            window[border <= inside, :3] = _NEW_RGB if number % 2 else _OLD_RGB
            window[:, :, 3] = _alpha(np.maximum(inside, border))
    return pixels


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
    return 0.74 * np.maximum(lines, forked) * ends * inside


def _sealed_patch(rng: np.random.Generator, shape: tuple[int, int]) -> tuple[Field, Field]:
    """The surface of a patch, and the bitumen along its border."""
    rows, columns = shape
    down, across = (np.arange(side, dtype=np.float64) + 0.5 for side in shape)
    away = np.minimum(
        np.minimum(down, rows - down)[:, None] / rows, np.minimum(across, columns - across)[None, :] / columns
    )
    away = away + 0.014 * (clouds(rng, shape, (9, 9), 2) - 0.5)
    inside = 0.42 * ramp(away, _BORDER, _BORDER + 0.006)
    return inside, 0.66 * ramp(np.abs(away - _BORDER), 0.018, 0.015)
