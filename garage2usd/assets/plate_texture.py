"""Textures of number plates: a cell for each character, and a blank one.

One texture is that of international and German plates, in their colours and with a cell for the band on the left. The
other holds coverage by ink, and can be tinted with any two colours.
"""

import numpy as np
import shapely
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from garage2usd.assets.glyphs import text_shape

__all__ = [
    "BAND",
    "CHARACTERS",
    "DOT",
    "LETTER_SHARE",
    "PROVINCES",
    "SPACE",
    "bake_plate_ink",
    "bake_plates",
    "cell_corners",
    "ink_cell_corners",
]

CHARACTERS = "0123456789ABCDEFGHJKLMNPRSTUVWXYZ"
"""Digits and capital letters, without I, O and Q, which resemble digits."""
SPACE, BAND = " ", "|"
"""Symbols for a blank cell and for the cell of the band."""
PROVINCES, DOT = "京沪川湘冀", "·"
"""Chinese plates: first characters, and the separator after the second one."""
_COLUMNS, _ROWS = 10, 4
"""Grid of cells, chosen so that cell borders are short decimals, which text stages store for each car."""
_CELL_PX = 96, 160
"""Width and height of a cell, with the aspect ratio of its share of a plate."""
LETTER_SHARE = 0.68
"""Height of a character as a share of the cell's height: 75 mm of 110 mm."""
_BAND_PX = (6, 8, 58, 152)
"""Left, top, right and bottom of the band; the edges of cells are blank to prevent bleeding into neighbours."""
_FINER = 8
_HAN_WIDTH = 0.92
"""Width of a Chinese character as a share of the cell's width."""
_SHEET_RGB, _INK_RGB, _BAND_RGB = (224, 224, 218), (22, 22, 24), (20, 62, 150)

_CELL_OF = {
    **{character: cell for cell, character in enumerate(CHARACTERS)},
    SPACE: len(CHARACTERS),
    BAND: len(CHARACTERS) + 1,
}
_INK_CELL_OF = {character: cell for cell, character in enumerate(CHARACTERS + SPACE + DOT + PROVINCES)}
_DOT_RADIUS = 0.07
"""Radius of the dot as a share of a character's height."""


def cell_corners(character: str) -> NDArray[np.float64]:
    """Texture coordinates of the cell of a character: lower left, lower right, upper right, upper left.

    Parameters
    ----------
    character
        One of `CHARACTERS`, `SPACE` or `BAND`.

    Returns
    -------
    numpy.ndarray
        float64, shape (4, 2); V counts from the lower edge of the texture.
    """
    return _corners(_CELL_OF[character])


def ink_cell_corners(character: str) -> NDArray[np.float64]:
    """As `cell_corners` for the ink texture: one of `CHARACTERS`, `SPACE`, `DOT` or `PROVINCES`."""
    return _corners(_INK_CELL_OF[character])


def _corners(cell: int) -> NDArray[np.float64]:
    row, column = divmod(cell, _COLUMNS)
    places = np.array([(0, 0), (1, 0), (1, 1), (0, 1)])
    corners: NDArray[np.float64] = (places + np.array((column, _ROWS - 1 - row))) / (_COLUMNS, _ROWS)
    return corners


def bake_plates(_rng: np.random.Generator) -> NDArray[np.uint8]:
    """Draw the colour texture, without randomness; uint8, shape (rows, columns, 3)."""
    width, height = _CELL_PX
    pixels = np.full((_ROWS * height, _COLUMNS * width, 3), _SHEET_RGB, dtype=np.uint8)
    for character, cell in _CELL_OF.items():
        row, column = divmod(cell, _COLUMNS)
        window = pixels[row * height : (row + 1) * height, column * width : (column + 1) * width]
        if character == BAND:
            left, top, right, bottom = _BAND_PX
            window[top:bottom, left:right] = _BAND_RGB
        elif character != SPACE:
            ink = _ink(character)[:, :, None]
            window[:] = np.rint(np.array(_SHEET_RGB) * (1 - ink) + np.array(_INK_RGB) * ink).astype(np.uint8)
    return pixels


def bake_plate_ink(_rng: np.random.Generator) -> NDArray[np.uint8]:
    """Draw the ink texture, without randomness; uint8, shape (rows, columns), 0 to 255."""
    width, height = _CELL_PX
    pixels = np.zeros((_ROWS * height, _COLUMNS * width), dtype=np.uint8)
    for character, cell in _INK_CELL_OF.items():
        row, column = divmod(cell, _COLUMNS)
        if character != SPACE:
            window = pixels[row * height : (row + 1) * height, column * width : (column + 1) * width]
            window[:] = np.rint(255 * _ink(character)).astype(np.uint8)
    return pixels


def _ink(character: str) -> NDArray[np.float64]:
    """Coverage of each pixel of a cell by a character; float64, shape (rows, columns), 0 to 1."""
    width, height = _CELL_PX
    canvas = Image.new("L", (width * _FINER, height * _FINER))
    draw = ImageDraw.Draw(canvas)
    size = LETTER_SHARE * height * _FINER
    if character == DOT:
        shape: shapely.Geometry = shapely.Point(0, 0).buffer(_DOT_RADIUS * size)
    elif character in PROVINCES:
        shape = text_shape(character, min(size, _HAN_WIDTH * width * _FINER))
    else:
        shape = text_shape(character, size)
    middle = np.array([width, height]) * _FINER / 2
    for polygon in getattr(shape, "geoms", [shape]):
        for ring, value in [(polygon.exterior, 255), *((hole, 0) for hole in polygon.interiors)]:
            places = np.rint(np.array(ring.coords) + middle).astype(int).tolist()
            draw.polygon([(x, y) for x, y in places], fill=value)
    finer = np.asarray(canvas, dtype=np.float64).reshape(height, _FINER, width, _FINER)
    covered: NDArray[np.float64] = finer.mean(axis=(1, 3)) / 255
    return covered
