"""Finishes of the paints of a look."""

from collections.abc import Mapping
from dataclasses import replace

from garage2usd.assets import MATERIALS, Finish, Material, PaintedTexture, Rgb, finished
from garage2usd.assets.colours import linear_rgb, material_colour
from garage2usd.config.look import (
    MarkingsLook,
    NumbersLook,
    Wear,
)

_WORSE = {Wear.LIGHT: Wear.WORN, Wear.WORN: Wear.FADED}
"""Wear of paint in the wheel tracks, if it is worse than elsewhere."""

_STEPS = 24

_WORN = {Wear.FRESH: None, Wear.LIGHT: "paint_fresh", Wear.WORN: "paint_worn", Wear.FADED: "paint_gone"}
"""Material of each degree of wear; None for even paint."""


def paint_finishes(markings: MarkingsLook, numbers: NumbersLook, floor: Mapping[str, Finish]) -> dict[str, Finish]:
    """Finishes of the paints on a floor with given finishes."""
    aisle, bay = (material_colour(finished(key, floor).material) for key in ("floor_concrete", "stall_epoxy"))
    usual, usual_numbers = MarkingsLook(), NumbersLook()
    wear, driven = markings.wear, _WORSE.get(markings.wear, markings.wear)
    paints = {
        "paint_stall": (markings.colour, bay, usual.colour, wear),
        "paint_stall_worn": (markings.colour, bay, "", driven),
        "paint_edge": (markings.colour, aisle, usual.colour, wear),
        "paint_number": (numbers.colour, bay, usual_numbers.colour, wear),
        "paint_yellow": (markings.lane_colour, aisle, usual.lane_colour, wear),
        "paint_white": (markings.arrow_colour, aisle, usual.arrow_colour, wear),
        "paint_white_worn": (markings.arrow_colour, aisle, "", driven),
        "paint_band": (markings.band_colour, aisle, "", wear),
        "paint_ghost": (markings.colour, aisle, "", None),
    }
    is_usual = markings.wear is usual.wear and not floor
    return {
        key: _painted(colour, ground, degree)
        for key, (colour, ground, usual_colour, degree) in paints.items()
        if colour != usual_colour or not is_usual
    }


def _painted(colour: str, ground: Rgb, wear: Wear | None) -> Finish:
    """Paint of a colour on a ground of another colour, which shows where it is worn; None for only a trace."""
    paint = linear_rgb(colour)
    worn = "paint_ghost" if wear is None else _WORN[wear]
    if worn is None:
        return Finish("paint_fresh", replace(MATERIALS["paint_fresh"], colour_texture=None, colour_rgb=paint))
    material = MATERIALS[worn]
    return Finish(worn, replace(material, colour_texture=PaintedTexture(_mask(material), paint, _coarse(ground))))


def _coarse(ground: Rgb) -> Rgb:
    """Quantise a colour below the visible threshold, so that garages share textures."""
    red, green, blue = (round((round(channel**0.5 * _STEPS) / _STEPS) ** 2, 6) for channel in ground)
    return red, green, blue


def _mask(material: Material) -> str:
    """Texture of a paint's wear."""
    mask = material.colour_texture
    if not isinstance(mask, str):
        raise TypeError(mask)
    return mask
