"""Plates with the zone around columns."""

import string
from dataclasses import dataclass

import numpy as np
import shapely

from garage2usd.assets.flat import upright_triangles
from garage2usd.assets.glyphs import GLYPH_PITCH, GLYPH_WIDTH, text_shape
from garage2usd.assets.mesh import Asset, Part, make_part
from garage2usd.objects.kind import Kind, Spec

__all__ = ["KIND", "ZonePlateSpec"]

KIND = Kind(
    "zone_plate",
    number=21,
    label="zone_plate",
    cityscapes="traffic sign",
    is_solid=False,
    group="Columns",
    scattered="ZonePlates",
)

_PLATE_LIFT_M = 0.004
_PLATE_SHARE = 0.88
_TEXT_SHARE = (0.86, 0.74)
_HUES = ("zone_blue", "zone_orange", "zone_green", "zone_red", "zone_violet", "zone_teal")


@dataclass(frozen=True)
class ZonePlateSpec(Spec, kind=KIND):
    """A plate with a letter or a number on each side of a square column; origin in its middle, at its lower edge."""

    text: str
    column_size_m: float
    height_m: float

    def asset(self) -> Asset:
        """Plates on the four sides: letters white on the colour of their zone, numbers black on white."""
        width = _PLATE_SHARE * self.column_size_m
        length = GLYPH_WIDTH + GLYPH_PITCH * (len(self.text) - 1)
        letter_height = min(_TEXT_SHARE[1] * self.height_m, _TEXT_SHARE[0] * width / length)
        plate = shapely.box(-width / 2, -self.height_m / 2, width / 2, self.height_m / 2)
        shape = text_shape(self.text, letter_height)
        hue = _HUES[string.ascii_uppercase.index(self.text) % len(_HUES)] if self.text.isalpha() else "sign_white"
        lift = self.column_size_m / 2 + _PLATE_LIFT_M
        ground = shapely.difference(plate, shape, grid_size=1e-6)
        return Asset(
            (
                _on_four_sides("Plate", ground, hue, lift, self.height_m / 2),
                _on_four_sides(
                    "Text", shape, "sign_white" if self.text.isalpha() else "sign_black", lift, self.height_m / 2
                ),
            ),
        )


def _on_four_sides(name: str, shape: shapely.Geometry, material: str, lift_m: float, middle_m: float) -> Part:
    """A shape, its second coordinate downwards, upright on the sides of a column."""
    turned = [upright_triangles(shape, middle_m=middle_m, front_m=lift_m)]
    for _ in range(3):
        x, y, z = np.moveaxis(turned[-1], 2, 0)
        turned.append(np.stack([z, y, -x], axis=2))
    return make_part(name, list(np.concatenate(turned)), material)
