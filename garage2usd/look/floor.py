"""Floors of a look: drawn values and finishes."""

from dataclasses import replace

from garage2usd.assets import GLOSSES, MATERIALS, Finish
from garage2usd.config.look import AISLE, NATURAL, Dirt, Drains, FloorFinish, FloorLook, Gloss
from garage2usd.look.axes import Group
from garage2usd.look.tint import tinted

__all__ = ["drawn_floor", "floor_finishes"]

_FINISHES = {
    FloorFinish.CONCRETE: 0.08,
    FloorFinish.TROWELLED: 0.17,
    FloorFinish.SAWN: 0.09,
    FloorFinish.CRACKED: 0.08,
    FloorFinish.EPOXY: 0.44,
    FloorFinish.ASPHALT: 0.06,
    FloorFinish.PATCHED: 0.04,
    FloorFinish.PAVERS: 0.04,
}
_CONCRETES = {"#9a9893": 0.4, "#7c7b78": 0.35, "#b5b2aa": 0.15, "#5e5d5a": 0.1}
_EPOXIES = {
    "#8e9290": 0.32,
    "#b9bcb8": 0.14,
    "#d3d5d1": 0.05,
    "#5f6364": 0.12,
    "#4d8a68": 0.16,
    "#56789c": 0.08,
    "#b7aa8c": 0.07,
    "#8f4a3f": 0.06,
}
"""Shares by sRGB colour: grey, light grey, nearly white, dark grey, green, blue, beige, red."""
_COLOURS = {
    FloorFinish.CONCRETE: {NATURAL: 0.5, "#6e6d6a": 0.5},
    FloorFinish.TROWELLED: _CONCRETES,
    FloorFinish.SAWN: _CONCRETES,
    FloorFinish.CRACKED: _CONCRETES,
    FloorFinish.EPOXY: _EPOXIES,
    FloorFinish.ASPHALT: {NATURAL: 1.0},
    FloorFinish.PATCHED: {NATURAL: 1.0},
    FloorFinish.PAVERS: {"#9c9a95": 0.5, "#84827e": 0.3, "#9a7465": 0.2},
}
_TROWELLED = {Gloss.MATT: 0.15, Gloss.SATIN: 0.35, Gloss.POLISHED: 0.35, Gloss.MIRROR: 0.15}
_ROUGH = {Gloss.MATT: 0.9, Gloss.SATIN: 0.1}
_GLOSSES = {
    FloorFinish.CONCRETE: {Gloss.MATT: 0.5, Gloss.SATIN: 0.5},
    FloorFinish.TROWELLED: _TROWELLED,
    FloorFinish.SAWN: _TROWELLED,
    FloorFinish.CRACKED: {Gloss.MATT: 0.5, Gloss.SATIN: 0.35, Gloss.POLISHED: 0.15},
    FloorFinish.EPOXY: {Gloss.SATIN: 0.2, Gloss.POLISHED: 0.4, Gloss.MIRROR: 0.4},
    FloorFinish.ASPHALT: _ROUGH,
    FloorFinish.PATCHED: _ROUGH,
    FloorFinish.PAVERS: _ROUGH,
}
_KEYS = {
    FloorFinish.CONCRETE: "floor_concrete",
    FloorFinish.TROWELLED: "floor_trowelled",
    FloorFinish.SAWN: "floor_sawn",
    FloorFinish.CRACKED: "floor_cracked",
    FloorFinish.EPOXY: "floor_epoxy",
    FloorFinish.ASPHALT: "floor_asphalt",
    FloorFinish.PATCHED: "floor_asphalt_patched",
    FloorFinish.PAVERS: "floor_pavers",
}
_NATURAL = {
    FloorFinish.TROWELLED: "#9a9893",
    FloorFinish.SAWN: "#9a9893",
    FloorFinish.CRACKED: "#8a8883",
    FloorFinish.EPOXY: "#8e9290",
    FloorFinish.PAVERS: "#9c9a95",
}
"""Natural colours of finishes with tintable textures."""
_ROUGHNESS = {Gloss.MATT: 0.88, Gloss.SATIN: 0.6, Gloss.POLISHED: 0.35, Gloss.MIRROR: 0.15}
"""Roughness by gloss, for finishes with a uniform roughness."""
_DIRTS = {Dirt.SWEPT: 0.2, Dirt.FAINT: 0.3, Dirt.USUAL: 0.35, Dirt.FILTHY: 0.15}
_WETS = {0.0: 0.8, 0.06: 0.08, 0.15: 0.07, 0.35: 0.05}
_DRAINS = {Drains.NONE: 0.5, Drains.GRATINGS: 0.3, Drains.CHANNELS: 0.2}
_COATED_STALLS = ("stall_green", "stall_blue")


def drawn_floor(axes: Group) -> FloorLook:
    """Draw a floor: mostly grey, mostly equal for aisles and stalls, glossy if coated, and mostly dry."""
    finish = axes.one_of("finish", _FINISHES)
    return FloorLook(
        finish=finish,
        colour=axes.colour("colour", _COLOURS[finish], tone=0.14, hue=0.03),
        gloss=axes.one_of("gloss", _GLOSSES[finish]),
        bays=axes.colour(
            "bays",
            {AISLE: 0.7, "coated": 0.06, "#7d8284": 0.1, "#4f7f63": 0.05, "#56789c": 0.05, "#a89f8c": 0.04},
            tone=0.15,
            hue=0.04,
        ),
        dirt=axes.one_of("dirt", _DIRTS),
        wet=axes.one_of("wet", _WETS),
        drains=axes.one_of("drains", _DRAINS),
    )


def floor_finishes(floor: FloorLook) -> dict[str, Finish]:
    """Finishes of aisles and stalls instead of their standard materials."""
    if FloorLook(finish=floor.finish, colour=floor.colour, gloss=floor.gloss, bays=floor.bays) == FloorLook():
        return {}
    natural = _NATURAL.get(floor.finish, NATURAL) if floor.colour == NATURAL else floor.colour
    aisle = _glossy(tinted(_KEYS[floor.finish], natural), floor.gloss)
    coated = {key: _glossy(Finish(key, MATERIALS[key]), floor.gloss) for key in ("stall_epoxy", *_COATED_STALLS)}
    if floor.bays == AISLE:
        coated["stall_epoxy"] = aisle
    elif floor.bays != "coated":
        coated["stall_epoxy"] = _glossy(tinted("floor_epoxy", floor.bays), floor.gloss)
    return {"floor_concrete": aisle, **coated}


def _glossy(finish: Finish, gloss: Gloss) -> Finish:
    """Set the gloss of a finish; satin is the standard floor's."""
    if finish.key == _KEYS[FloorFinish.CONCRETE] and gloss is Gloss.SATIN:
        return finish
    if finish.material.packed_texture is None:
        return Finish(finish.key, replace(finish.material, roughness=_ROUGHNESS[gloss]))
    return Finish(finish.key, replace(finish.material, packed_texture=GLOSSES[gloss]))
