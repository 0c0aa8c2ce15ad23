"""The number plates of a car: a row of cells of one texture in front and behind, one for each character."""

from dataclasses import replace
from functools import lru_cache

import numpy as np
import shapely
import shapely.affinity
from numpy.typing import NDArray

from garage2usd.assets.cars import PLATE_M, plate_places
from garage2usd.assets.flat import GRID_M, upright_triangles
from garage2usd.assets.glyphs import text_shape
from garage2usd.assets.mesh import Asset, Part, make_part
from garage2usd.assets.plate_texture import BAND, CHARACTERS, LETTER_SHARE, SPACE, cell_corners
from garage2usd.config.vehicles import CarBody

__all__ = ["PLATE_CHARACTERS", "number_plates", "painted_plates", "plate_coordinates"]

_BAND_M = 0.04
PLATE_CHARACTERS = 7
"""Of the text on a plate, blanks included; before it is the band."""
_CORNERS = 4


def number_plates(body: CarBody, text: str) -> Asset:
    """The front and the rear plate of a car, with the same text; origin and axes are those of the car.

    Parameters
    ----------
    body
        On which they are.
    text
        `PLATE_CHARACTERS` of `garage2usd.assets.plate_texture.CHARACTERS` and blanks.
    """
    return Asset((replace(_sheets(body), st=plate_coordinates(text)),))


def painted_plates(body: CarBody, text: str) -> tuple[Part, ...]:
    """The same plates without a texture, of the materials of signs and trim: as they are on a car that goes anywhere.

    Parameters
    ----------
    body, text
        As for `number_plates`.
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
    """Triangles of a shape (x, y), the latter downwards, where the plates are; shape (triangles, 3, 3)."""
    upright = upright_triangles(shape, middle_m=0.0, front_m=0.0)
    return np.concatenate([upright * (toward, 1.0, toward) + (0.0, y, z) for toward, y, z in plate_places(body)])


def plate_coordinates(text: str) -> NDArray[np.float32]:
    """The texture coordinates of each of a car's plates, by what is to be read on them.

    Parameters
    ----------
    text
        As for `number_plates`.

    Returns
    -------
    numpy.ndarray
        float32, shape (corners, 2): of the band and of each character the corners of its cell.

    Raises
    ------
    ValueError
        If it has another number of characters, or one that no plate has.
    """
    if len(text) != PLATE_CHARACTERS or not set(text) <= {*CHARACTERS, SPACE}:
        raise ValueError(f"{text!r}: a plate has {PLATE_CHARACTERS} characters of {CHARACTERS} and blanks")
    return np.concatenate([cell_corners(character) for character in BAND + text]).astype(np.float32)


@lru_cache(maxsize=32)
def _sheets(body: CarBody) -> Part:
    """Both plates, whatever is to be read on them."""
    (width, height), cells = PLATE_M, PLATE_CHARACTERS + 1
    edges = np.linspace(-width / 2, width / 2, cells + 1)
    left, right, low, high = edges[:-1], edges[1:], np.full(cells, -height / 2), np.full(cells, height / 2)
    # counter-clockwise from the lower left, as the corners of cells are
    corners = [np.stack(place, axis=1) for place in ((left, low), (right, low), (right, high), (left, high))]
    cell = np.insert(np.stack(corners, axis=1), 2, 0.0, axis=2)
    faces = np.concatenate([cell * (toward, 1.0, 1.0) + (0.0, y, z) for toward, y, z in plate_places(body)])
    part = make_part("Plates", faces, "number_plate")
    return replace(part, st_indices=np.tile(np.arange(_CORNERS * cells, dtype=np.int32), 2))
