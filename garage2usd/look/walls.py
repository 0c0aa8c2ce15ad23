"""Walls of a look: drawn values and finishes."""

from garage2usd.assets import Finish
from garage2usd.config.look import NATURAL, NO_DADO, WallFinish, WallsLook
from garage2usd.look.axes import Group
from garage2usd.look.tint import tinted

__all__ = ["drawn_walls", "wall_finishes"]

_MATERIALS = {
    WallFinish.RAW: "wall_concrete",
    WallFinish.PAINTED: "wall_painted",
    WallFinish.BLOCKWORK: "wall_blockwork",
    WallFinish.PANELS: "wall_panels",
}


def drawn_walls(axes: Group) -> WallsLook:
    """Draw walls: mostly painted light, with or without a dado."""
    finish = axes.one_of(
        "finish", {WallFinish.PAINTED: 0.55, WallFinish.RAW: 0.25, WallFinish.BLOCKWORK: 0.13, WallFinish.PANELS: 0.07}
    )
    colours = {"#d8d8d3": 0.5, "#c4bfb2": 0.2, "#aab0b0": 0.12, "#cfc49a": 0.1, "#b4c2b8": 0.08}
    if finish is WallFinish.RAW:
        colours = {NATURAL: 1.0}
    return WallsLook(
        finish=finish,
        colour=axes.one_of("colour", colours),
        dado=axes.one_of(
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
        ),
        dado_height_m=axes.between("dado_height_m", 0.5, 1.5, 0.25),
    )


def wall_finishes(walls: WallsLook) -> dict[str, Finish]:
    """Finishes of walls, cores and obstacles instead of raw concrete, and of the dado."""
    finishes = {}
    if walls.finish is not WallFinish.RAW or walls.colour != NATURAL:
        finishes["wall_concrete"] = tinted(_MATERIALS[walls.finish], walls.colour)
    if walls.dado not in {NATURAL, NO_DADO}:
        finishes["wall_band"] = tinted("wall_dado", walls.dado)
    return finishes
