"""Markings, numbers and signs of a look: drawn values, and the finishes of paints."""

from collections.abc import Mapping
from dataclasses import replace

from garage2usd.assets import MATERIALS, Finish, Material, PaintedTexture, Rgb, finished
from garage2usd.assets.colours import linear_rgb, material_colour
from garage2usd.config.look import (
    BandForm,
    MarkingsLook,
    NumberForm,
    NumberPlace,
    NumbersLook,
    Pictogram,
    SignsLook,
    SignsOf,
    StallPattern,
    Wear,
)
from garage2usd.look.finishes import Group

_WHITE, _CREAM, _GREY, _DARK_GREY = "#dedede", "#cfc8a8", "#a6a6a2", "#868682"
_YELLOW, _DULL_YELLOW, _ORANGE, _BLUE = "#d8a62e", "#b0924a", "#d87822", "#3f6fb0"


def drawn_markings(axes: Group) -> MarkingsLook:
    """Draw the lines: mostly white, mostly closed along the aisle, with various wear."""
    colour = axes.colour(
        "colour",
        {
            _WHITE: 0.44,
            _YELLOW: 0.13,
            _DULL_YELLOW: 0.15,
            _CREAM: 0.09,
            _GREY: 0.08,
            _DARK_GREY: 0.04,
            _ORANGE: 0.04,
            _BLUE: 0.03,
        },
        tone=0.08,
        hue=0.03,
    )
    band = axes.one_of("band", {BandForm.NONE: 0.5, BandForm.LINE: 0.26, BandForm.BAND: 0.24})
    # bands are newer than most lines
    wear = {Wear.FRESH: 0.28, Wear.LIGHT: 0.34, Wear.WORN: 0.24, Wear.FADED: 0.14}
    newer = {Wear.FRESH: 0.45, Wear.LIGHT: 0.4, Wear.WORN: 0.13, Wear.FADED: 0.02}
    return MarkingsLook(
        pattern=axes.one_of(
            "pattern",
            {
                StallPattern.CLOSED: 0.68,
                StallPattern.SIDES: 0.08,
                StallPattern.T_MARKS: 0.04,
                StallPattern.L_MARKS: 0.04,
                StallPattern.DOUBLE: 0.08,
                StallPattern.CORNERS: 0.03,
                StallPattern.DASHED: 0.04,
                StallPattern.NONE: 0.01,
            },
        ),
        colour=colour,
        line_width_m=axes.one_of(
            "line_width_m", {0.06: 0.14, 0.08: 0.26, 0.1: 0.27, 0.12: 0.17, 0.15: 0.12, 0.18: 0.02, 0.2: 0.02}
        ),
        wear=axes.one_of("wear", newer if band is BandForm.BAND else wear),
        band=band,
        band_gap_m=axes.between("band_gap_m", 0.15, 0.6, 0.05),
        band_width_m=axes.one_of("band_width_m", {0.4: 0.15, 0.5: 0.2, 0.6: 0.25, 0.8: 0.25, 1.0: 0.15}),
        band_colour=axes.colour(
            "band_colour",
            {"#1f7a52": 0.45, _BLUE: 0.2, _YELLOW: 0.15, "#a83226": 0.1, "#6c7072": 0.1},
            tone=0.1,
            hue=0.05,
        ),
        band_both_sides=axes.one_of("band_both_sides", {False: 0.6, True: 0.4}),
        pictogram=axes.one_of(
            "pictogram", {Pictogram.WALKER: 0.4, Pictogram.LIFT: 0.25, Pictogram.CAR: 0.15, Pictogram.NONE: 0.2}
        ),
        hatching=axes.one_of("hatching", {False: 0.72, True: 0.28}),
        lane_colour=axes.colour("lane_colour", {_YELLOW: 0.3, _WHITE: 0.35, colour: 0.35}),
        arrow_colour=axes.colour("arrow_colour", {_WHITE: 0.8, _YELLOW: 0.2}),
        ghosts=axes.one_of("ghosts", {0.0: 0.62, 0.15: 0.18, 0.4: 0.14, 0.9: 0.06}),
        zebra=axes.one_of("zebra", {0.0: 0.6, 0.05: 0.2, 0.15: 0.2}),
    )


_WORSE = {Wear.LIGHT: Wear.WORN, Wear.WORN: Wear.FADED}
"""Wear of paint in the wheel tracks, if it is worse than elsewhere."""

_STEPS = 24

_WORN = {Wear.FRESH: None, Wear.LIGHT: "paint_fresh", Wear.WORN: "paint_worn", Wear.FADED: "paint_gone"}
"""Material of each degree of wear; None for even paint."""


def paint_finishes(markings: MarkingsLook, numbers: NumbersLook, floor: Mapping[str, Finish]) -> dict[str, Finish]:
    """Finishes of the paints on a floor with given finishes."""
    aisle, bay = (_colour_of(key, floor) for key in ("floor_concrete", "stall_epoxy"))
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


def _colour_of(key: str, finishes: Mapping[str, Finish]) -> Rgb:
    return material_colour(finished(key, finishes).material)


def drawn_numbers(axes: Group) -> NumbersLook:
    """Draw the look of numbers: mostly on the floor at the entry."""
    place = axes.one_of(
        "place",
        {
            NumberPlace.MOUTH: 0.55,
            NumberPlace.LANE: 0.1,
            NumberPlace.MIDDLE: 0.08,
            NumberPlace.REAR: 0.05,
            NumberPlace.WALL: 0.07,
            NumberPlace.NONE: 0.15,
        },
    )
    form = axes.one_of("form", {NumberForm.SHORT: 0.42, NumberForm.FULL: 0.5, NumberForm.BOXED: 0.08})
    # long numbers have lower characters
    heights = {0.2: 0.2, 0.25: 0.35, 0.3: 0.3, 0.35: 0.15}
    if form is not NumberForm.FULL:
        heights = {0.2: 0.1, 0.3: 0.3, 0.4: 0.3, 0.5: 0.2, 0.6: 0.1}
    return NumbersLook(
        place=place,
        form=form,
        height_m=axes.one_of("height_m", heights),
        colour=axes.colour("colour", {"#dedede": 0.5, "#d8a62e": 0.24, "#b0924a": 0.18, "#3c3d40": 0.08}),
    )


def drawn_signs(axes: Group) -> SignsLook:
    """Draw the convention of signs: mostly that of the country."""
    return SignsLook(of=axes.one_of("of", {SignsOf.PROFILE: 0.8, SignsOf.INTERNATIONAL: 0.2}))
