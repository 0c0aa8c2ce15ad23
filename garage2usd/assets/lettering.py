"""Numbers painted on the floor, and plates with letters and numbers around columns."""

import string

import numpy as np
import shapely

from garage2usd.assets.floor import flat_part, level_triangles
from garage2usd.assets.glyphs import GLYPH_WIDTH, text_shape
from garage2usd.assets.mesh import Asset, Part, make_part

__all__ = ["PAINT_LIFT_M", "floor_number", "zone_plate"]

PAINT_LIFT_M = 0.003
_PLATE_LIFT_M = 0.004
_PLATE_SHARE = 0.88
_TEXT_SHARE = (0.86, 0.74)
_HUES = ("zone_blue", "zone_orange", "zone_green", "zone_red", "zone_violet", "zone_teal")


def floor_number(digits: str, height_m: float, *, pitch: float) -> Asset:
    """White digits whose tops point to -Z, a few millimetres over the floor; origin in their middle.

    Parameters
    ----------
    digits, height_m, pitch
        See `garage2usd.assets.glyphs.text_shape`.
    """
    shape = text_shape(digits, height_m, pitch=pitch)
    return Asset("stall_number", (flat_part("Paint", shape, "paint_white", height_m=PAINT_LIFT_M, collider=None),))


def zone_plate(text: str, column_size_m: float, height_m: float, *, pitch: float) -> Asset:
    """Flat plates on the four sides of a column, `height_m` high from y = 0; origin in the column's middle.

    Letters are white on the colour of their zone, numbers black on white.
    """
    width = _PLATE_SHARE * column_size_m
    length = GLYPH_WIDTH + pitch * (len(text) - 1)
    letter_height = min(_TEXT_SHARE[1] * height_m, _TEXT_SHARE[0] * width / length)
    plate = shapely.box(-width / 2, -height_m / 2, width / 2, height_m / 2)
    shape = text_shape(text, letter_height, pitch=pitch)
    hue = _HUES[string.ascii_uppercase.index(text) % len(_HUES)] if text.isalpha() else "sign_white"
    lift = column_size_m / 2 + _PLATE_LIFT_M
    ground = shapely.difference(plate, shape, grid_size=1e-6)
    return Asset(
        "zone_plate",
        (
            _on_four_sides("Plate", ground, hue, lift, height_m / 2),
            _on_four_sides("Text", shape, "sign_white" if text.isalpha() else "sign_black", lift, height_m / 2),
        ),
    )


def _on_four_sides(name: str, shape: shapely.Geometry, material: str, lift_m: float, middle_m: float) -> Part:
    """A shape, its second coordinate downwards, upright on the sides of a column."""
    corners = level_triangles(shape)
    upright = np.stack([corners[..., 0], middle_m - corners[..., 1], np.full(corners.shape[:2], lift_m)], axis=2)
    turned = [upright]
    for _ in range(3):
        x, y, z = np.moveaxis(turned[-1], 2, 0)
        turned.append(np.stack([z, y, -x], axis=2))
    return make_part(name, list(np.concatenate(turned)), material)
