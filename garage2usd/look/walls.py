"""Which walls are drawn."""

from garage2usd.config.look import NATURAL, WallFinish, WallsLook
from garage2usd.look.axes import Group

__all__ = ["drawn_walls"]


def drawn_walls(axes: Group) -> WallsLook:
    """Walls: mostly painted light, with or without a dado."""
    finish = axes.one_of(
        "finish", {WallFinish.PAINTED: 0.55, WallFinish.RAW: 0.25, WallFinish.BLOCKWORK: 0.13, WallFinish.PANELS: 0.07}
    )
    colours = {NATURAL: 1.0} if finish is WallFinish.RAW else {"#d8d8d3": 0.6, "#c4bfb2": 0.25, "#aab0b0": 0.15}
    return WallsLook(
        finish=finish,
        colour=axes.colour("colour", colours, tone=0.06, hue=0.02),
        dado=axes.colour(
            "dado",
            {
                "none": 0.35,
                "#8f9496": 0.2,
                "#d2a02c": 0.12,
                "#3f8060": 0.12,
                "#4a6f9c": 0.11,
                "#9c3f33": 0.06,
                NATURAL: 0.04,
            },
            tone=0.1,
            hue=0.04,
        ),
        dado_height_m=axes.between("dado_height_m", 0.5, 1.5, 0.1),
    )
