"""Number plates of a car: two rows of textured cells, and the textures that have a cell for each character.

One texture is that of international and German plates, in their colours and with a cell for the band on the left. The
other holds coverage by ink, and can be tinted with any two colours.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
import shapely
import shapely.affinity
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from garage2usd.assets.car_ends import PLATE_M
from garage2usd.assets.cars import plate_places
from garage2usd.assets.countries import Country
from garage2usd.assets.flat import GRID_M, upright_triangles
from garage2usd.assets.glyphs import text_shape
from garage2usd.assets.mesh import Asset, Part, make_part
from garage2usd.config.vehicles import CarBody

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
_BAND_M = 0.04
PLATE_CHARACTERS = 7
"""Number of characters on a plate, blanks included, without the band."""
_CORNERS = 4


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


@dataclass(frozen=True)
class PlateStyle:
    """Format of a country's number plates.

    Attributes
    ----------
    characters
        Number of cells of a plate, blanks included, without the band.
    width_m
        Width of a plate.
    meshes
        (mesh name, material) pairs: one mesh for both plates, or one each for front and rear.
    has_band
        True if a plate has a band on the left.
    """

    characters: int
    width_m: float
    meshes: tuple[tuple[str, str], ...]
    has_band: bool = False

    def corners(self, text: str) -> NDArray[np.float64]:
        """Texture coordinates of the corners of each cell; float64, shape (corners, 2)."""
        if self.has_band:
            return np.concatenate([cell_corners(character) for character in BAND + text])
        return np.concatenate([ink_cell_corners(character) for character in text])

    @property
    def known(self) -> str:
        """Characters allowed on a plate."""
        return CHARACTERS + SPACE + ("" if self.has_band else DOT + PROVINCES)


_BANDED = PlateStyle(PLATE_CHARACTERS, PLATE_M[0], (("Plates", "number_plate"),), has_band=True)

PLATE_STYLES = {
    Country.NONE: _BANDED,
    Country.DE: _BANDED,
    Country.CN: PlateStyle(8, 0.44, (("Plates", "number_plate_cn"),)),
    Country.GB: PlateStyle(8, PLATE_M[0], (("Plates", "number_plate_gb"), ("RearPlates", "number_plate_gb_rear"))),
    Country.US: PlateStyle(7, 0.305, (("Plates", "number_plate_us"),)),
}
"""Plate formats with the actual widths of the countries; the height is that of the plate holder on every car."""


def number_plates(body: CarBody, text: str, country: Country = Country.NONE) -> Asset:
    """Make the front and rear plate of a car with equal texts, in the axes of the car.

    Parameters
    ----------
    body
        Body of the car.
    text
        Text with the number of characters of the country's format.
    country
        Country of the plates.
    """
    corners = plate_coordinates(text, country)
    return Asset(tuple(replace(sheet, st=corners) for sheet in _sheets(body, country)))


def painted_plates(body: CarBody, text: str) -> tuple[Part, ...]:
    """Make plates without a texture, from the materials of signs and trim, for a car outside of any garage.

    Parameters
    ----------
    body
        Body of the car.
    text
        `PLATE_CHARACTERS` characters of `garage2usd.assets.number_plates.CHARACTERS` and blanks.
    """
    (width, height), cell = PLATE_M, PLATE_M[0] / (PLATE_CHARACTERS + 1)
    sheet = shapely.box(-width / 2, -height / 2, width / 2, height / 2)
    band = shapely.box(-width / 2, -height / 2, -width / 2 + _BAND_M, height / 2)
    first = -width / 2 + 1.5 * cell
    ink = shapely.union_all(
        [
            shapely.affinity.translate(text_shape(character, LETTER_SHARE * height), first + place * cell)
            for place, character in enumerate(text)
            if character != SPACE
        ]
    )
    ground = shapely.difference(sheet, shapely.union_all([band, ink]), grid_size=GRID_M)
    pieces = ("Plates", ground, "sign_white"), ("PlateBands", band, "sign_blue"), ("PlateLetters", ink, "trim_black")
    return tuple(make_part(name, _at_both_ends(shape, body), material) for name, shape, material in pieces)


def _at_both_ends(shape: shapely.Geometry, body: CarBody) -> NDArray[np.float64]:
    """Place the triangles of a shape (x, y), y downwards, at both plates; shape (triangles, 3, 3)."""
    upright = upright_triangles(shape, middle_m=0.0, front_m=0.0)
    return np.concatenate([upright * (toward, 1.0, toward) + (0.0, y, z) for toward, y, z in plate_places(body)])


def plate_coordinates(text: str, country: Country = Country.NONE) -> NDArray[np.float32]:
    """Texture coordinates of each of a car's plates for a text.

    Parameters
    ----------
    text, country
        As for `number_plates`.

    Returns
    -------
    numpy.ndarray
        float32, shape (corners, 2): corners of the cells of the band, if there is one, and of each character.

    Raises
    ------
    ValueError
        If the text has a wrong number of characters, or an unknown character.
    """
    style = PLATE_STYLES[country]
    if len(text) != style.characters or not set(text) <= set(style.known):
        raise ValueError(f"{text!r}: a plate has {style.characters} characters of {style.known!r}")
    return style.corners(text).astype(np.float32)


@lru_cache(maxsize=64)
def _sheets(body: CarBody, country: Country) -> tuple[Part, ...]:
    """Meshes of both plates, independent of the text."""
    style = PLATE_STYLES[country]
    width, height, cells = style.width_m, PLATE_M[1], style.characters + style.has_band
    edges = np.linspace(-width / 2, width / 2, cells + 1)
    left, right, low, high = edges[:-1], edges[1:], np.full(cells, -height / 2), np.full(cells, height / 2)
    # counter-clockwise from the lower left, like the corners of cells
    corners = [np.stack(place, axis=1) for place in ((left, low), (right, low), (right, high), (left, high))]
    cell = np.insert(np.stack(corners, axis=1), 2, 0.0, axis=2)
    plates = [cell * (toward, 1.0, 1.0) + (0.0, y, z) for toward, y, z in plate_places(body)]
    meshes = [np.concatenate(plates)] if len(style.meshes) == 1 else plates
    indices = np.arange(_CORNERS * cells, dtype=np.int32)
    return tuple(
        replace(make_part(name, faces, material), st_indices=np.tile(indices, len(faces) // cells))
        for (name, material), faces in zip(style.meshes, meshes, strict=True)
    )
