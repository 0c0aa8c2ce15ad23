"""Stall numbers of a look."""

from garage2usd.config.look import NumberForm, NumberPlace, NumbersLook
from garage2usd.look.axes import Group

__all__ = ["drawn_numbers"]


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
