"""What floors are drawn, and what they are made of."""

from garage2usd.assets import MATERIALS, Finish
from garage2usd.config.look import NATURAL, FloorFinish, FloorLook, Gloss
from garage2usd.look.axes import Group
from garage2usd.look.tint import tinted

__all__ = ["drawn_floor", "floor_finishes"]

_FINISHES = {
    FloorFinish.TROWELLED: 0.25,
    FloorFinish.CONCRETE: 0.15,
    FloorFinish.EPOXY: 0.47,
    FloorFinish.ASPHALT: 0.09,
    FloorFinish.PAVERS: 0.04,
}
_EPOXIES = {
    "#8e9290": 0.34,
    "#b9bcb8": 0.14,
    "#5f6364": 0.12,
    "#4d8a68": 0.17,
    "#56789c": 0.08,
    "#b7aa8c": 0.08,
    "#8f4a3f": 0.07,
}
"""sRGB: grey, light grey, dark grey, green, blue, beige, red."""
_COLOURS = {
    FloorFinish.TROWELLED: {"#9a9893": 0.5, "#7c7b78": 0.3, "#b5b2aa": 0.2},
    FloorFinish.CONCRETE: {NATURAL: 0.4, "#8a8883": 0.3, "#6e6d6a": 0.3},
    FloorFinish.EPOXY: _EPOXIES,
    FloorFinish.ASPHALT: {NATURAL: 1.0},
    FloorFinish.PAVERS: {NATURAL: 0.5, "#8c8a86": 0.3, "#9a7465": 0.2},
}
_GLOSSES = {
    FloorFinish.TROWELLED: {Gloss.MATT: 0.15, Gloss.SATIN: 0.35, Gloss.POLISHED: 0.35, Gloss.MIRROR: 0.15},
    FloorFinish.CONCRETE: {Gloss.MATT: 0.5, Gloss.SATIN: 0.5},
    FloorFinish.EPOXY: {Gloss.SATIN: 0.2, Gloss.POLISHED: 0.4, Gloss.MIRROR: 0.4},
    FloorFinish.ASPHALT: {Gloss.MATT: 0.9, Gloss.SATIN: 0.1},
    FloorFinish.PAVERS: {Gloss.MATT: 0.9, Gloss.SATIN: 0.1},
}


def drawn_floor(axes: Group) -> FloorLook:
    """A floor: mostly grey, mostly one for aisles and bays, glossy where it is coated."""
    finish = axes.one_of("finish", _FINISHES)
    return FloorLook(
        finish=finish,
        colour=axes.colour("colour", _COLOURS[finish], tone=0.14, hue=0.03),
        gloss=axes.one_of("gloss", _GLOSSES[finish]),
        bays=axes.colour(
            "bays",
            {"aisle": 0.7, "coated": 0.06, "#7d8284": 0.1, "#4f7f63": 0.05, "#56789c": 0.05, "#a89f8c": 0.04},
            tone=0.15,
            hue=0.04,
        ),
    )


def floor_finishes(floor: FloorLook) -> dict[str, Finish]:
    """What aisles and bays have in the place of their usual materials."""
    if floor == FloorLook():
        return {}
    aisle = tinted("floor_concrete", floor.colour)
    bays = {
        "coated": Finish("stall_epoxy", MATERIALS["stall_epoxy"]),
        "aisle": aisle,
    }.get(floor.bays) or tinted("stall_epoxy", floor.bays)
    return {"floor_concrete": aisle, "stall_epoxy": bays}
