"""How the numbers of stalls are drawn."""

from garage2usd.config.look import NumberForm, NumberPlace, NumbersLook
from garage2usd.look.axes import Group

__all__ = ["drawn_numbers"]


def drawn_numbers(axes: Group) -> NumbersLook:
    """Numbers: mostly on the floor at the entry."""
    return NumbersLook(
        place=axes.one_of(
            "place",
            {
                NumberPlace.MOUTH: 0.5,
                NumberPlace.LANE: 0.12,
                NumberPlace.MIDDLE: 0.1,
                NumberPlace.REAR: 0.05,
                NumberPlace.WALL: 0.08,
                NumberPlace.NONE: 0.15,
            },
        ),
        form=axes.one_of("form", {NumberForm.SHORT: 0.5, NumberForm.FULL: 0.42, NumberForm.BOXED: 0.08}),
        height_m=axes.between("height_m", 0.15, 0.6, 0.05),
        colour=axes.colour("colour", {"#dedede": 0.6, "#d8a62e": 0.3, "#3c3d40": 0.1}, tone=0.06, hue=0.02),
    )
