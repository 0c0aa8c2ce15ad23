"""Number plates of a car: two rows of textured cells, one cell per character."""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
import shapely
import shapely.affinity
from numpy.typing import NDArray

from garage2usd.assets.cars import PLATE_M, plate_places
from garage2usd.assets.countries import Country
from garage2usd.assets.flat import GRID_M, upright_triangles
from garage2usd.assets.glyphs import text_shape
from garage2usd.assets.mesh import Asset, Part, make_part
from garage2usd.assets.plate_texture import (
    BAND,
    CHARACTERS,
    DOT,
    LETTER_SHARE,
    PROVINCES,
    SPACE,
    cell_corners,
    ink_cell_corners,
)
from garage2usd.config.vehicles import CarBody

__all__ = [
    "PLATE_CHARACTERS",
    "PLATE_STYLES",
    "PlateStyle",
    "number_plates",
    "painted_plates",
    "plate_coordinates",
]

_BAND_M = 0.04
PLATE_CHARACTERS = 7
"""Number of characters on a plate, blanks included, without the band."""
_CORNERS = 4


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
        Whether a plate has a band on the left.
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
        `PLATE_CHARACTERS` characters of `garage2usd.assets.plate_texture.CHARACTERS` and blanks.
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
