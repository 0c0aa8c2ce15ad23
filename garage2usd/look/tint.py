"""Tinting of materials."""

from dataclasses import replace

from garage2usd.assets import MATERIALS, Finish
from garage2usd.assets.colours import linear_rgb, material_colour
from garage2usd.config.look import NATURAL

__all__ = ["tinted"]

_DARKEST = 1e-3


def tinted(key: str, colour: str) -> Finish:
    """Tint a material to the mean colour ``#rrggbb``, limited by its texture's brightness; unchanged for 'natural'."""
    material = MATERIALS[key]
    if colour == NATURAL:
        return Finish(key, material)
    wanted = linear_rgb(colour)
    if material.colour_texture is None:
        return Finish(key, replace(material, colour_rgb=wanted))
    red, green, blue = (
        round(min(to / max(mean, _DARKEST), 1.0), 3) for to, mean in zip(wanted, material_colour(material), strict=True)
    )
    return Finish(key, replace(material, tint_rgb=(red, green, blue)))
