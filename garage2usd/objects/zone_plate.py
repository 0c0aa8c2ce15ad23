"""Plates with the zone on columns and walls."""

import string
from dataclasses import dataclass

import shapely
from shapely import affinity

from garage2usd.assets.flat import GRID_M, upright_triangles
from garage2usd.assets.glyphs import GLYPH_PITCH, GLYPH_WIDTH, text_shape
from garage2usd.assets.mesh import Asset, Part, make_part
from garage2usd.objects.kind import Kind, Spec

__all__ = ["KIND", "ZONE_PLATE_HEIGHT_M", "ZonePlateSpec"]

KIND = Kind(
    "zone_plate",
    number=21,
    label="zone_plate",
    cityscapes="traffic sign",
    is_solid=False,
    group="Columns",
    scattered="ZonePlates",
)

ZONE_PLATE_HEIGHT_M = 0.36
_LIFT_M = 0.004
_TEXT_SHARE = (0.86, 0.74)
"""Of the width and the height of a field."""
_HUES = ("zone_blue", "zone_orange", "zone_green", "zone_red", "zone_violet", "zone_teal")


@dataclass(frozen=True)
class ZonePlateSpec(Spec, kind=KIND):
    """A plate with the name of a zone, ``B12``, that looks to +Z; origin in the middle of its lower edge."""

    text: str
    width_m: float

    def asset(self) -> Asset:
        """The letter in white on the colour of its zone, and beside it the number in black on white."""
        letter, number = self.text[0], self.text[1:]
        hue = _HUES[string.ascii_uppercase.index(letter) % len(_HUES)]
        half = self.width_m / 2
        return Asset(
            (
                *_field("Letter", letter, (-half, 0.0), (hue, "sign_white")),
                *_field("Number", number, (0.0, half), ("sign_white", "sign_black")),
            ),
        )


def _field(name: str, text: str, across_m: tuple[float, float], materials: tuple[str, str]) -> tuple[Part, Part]:
    """The part of a plate from left to right, and what is written on it, of two materials."""
    (left, right), (ground, ink) = across_m, materials
    height, length = ZONE_PLATE_HEIGHT_M, GLYPH_WIDTH + GLYPH_PITCH * (len(text) - 1)
    shape = text_shape(text, min(_TEXT_SHARE[1] * height, _TEXT_SHARE[0] * (right - left) / length))
    shape = affinity.translate(shape, (left + right) / 2)
    around = shapely.difference(shapely.box(left, -height / 2, right, height / 2), shape, grid_size=GRID_M)
    return (
        make_part(f"{name}Field", upright_triangles(around, middle_m=height / 2, front_m=_LIFT_M), ground),
        make_part(name, upright_triangles(shape, middle_m=height / 2, front_m=_LIFT_M), ink),
    )
