"""Finishes of floors, walls, columns, ceilings and lights of a look."""

from dataclasses import replace

from garage2usd.assets import GLOSSES, MATERIALS, Finish, Rgb
from garage2usd.config.look import (
    AISLE,
    NATURAL,
    NO_DADO,
    CeilingFinish,
    CeilingLook,
    ColumnsLook,
    Daylight,
    FloorFinish,
    FloorLook,
    Gloss,
    LightsLook,
    WallFinish,
    WallsLook,
)
from garage2usd.look.finishes import tinted

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
_COATED_STALLS = ("stall_green", "stall_blue")
_MATERIALS = {
    WallFinish.RAW: "wall_concrete",
    WallFinish.PAINTED: "wall_painted",
    WallFinish.BLOCKWORK: "wall_blockwork",
    WallFinish.PANELS: "wall_panels",
}
_UNDERSIDES = {
    CeilingFinish.WHITE: ("ceiling_painted", NATURAL),
    CeilingFinish.BLACK: ("ceiling_painted", "#26272a"),
    CeilingFinish.BOARDS: ("ceiling_insulation", NATURAL),
}
_SERVICES = ("service_steel", "service_pipe", "service_hanger")
_SKIES: dict[Daylight, tuple[Rgb, Rgb]] = {
    Daylight.SUN: ((10.5, 12.6, 16.8), (0.8, 0.85, 0.9)),
    Daylight.DUSK: ((0.62, 0.36, 0.40), (0.10, 0.09, 0.12)),
    Daylight.NIGHT: ((0.010, 0.011, 0.016), (0.004, 0.004, 0.005)),
}
"""Radiance and colour of the sky for clear, dusk and night skies; the clear one is four times the overcast one."""


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


def wall_finishes(walls: WallsLook) -> dict[str, Finish]:
    """Finishes of walls, cores and obstacles instead of raw concrete, and of the dado."""
    finishes = {}
    if walls.finish is not WallFinish.RAW or walls.colour != NATURAL:
        finishes["wall_concrete"] = tinted(_MATERIALS[walls.finish], walls.colour)
    if walls.dado not in {NATURAL, NO_DADO}:
        finishes["wall_band"] = tinted("wall_dado", walls.dado)
    return finishes


def column_finishes(columns: ColumnsLook) -> dict[str, Finish]:
    """Finishes of shafts instead of bare concrete."""
    return {} if columns.colour == NATURAL else {"column_concrete": tinted("column_painted", columns.colour)}


def ceiling_finishes(ceiling: CeilingLook) -> dict[str, Finish]:
    """Finishes of slabs and beams instead of raw concrete, and of services instead of bare steel and red lacquer."""
    finishes = {}
    if ceiling.finish in _UNDERSIDES:
        finishes["ceiling_concrete"] = tinted(*_UNDERSIDES[ceiling.finish])
    if ceiling.services != NATURAL:
        finishes |= dict.fromkeys(_SERVICES, tinted("housing_white", ceiling.services))
    return finishes


def light_finishes(lights: LightsLook) -> dict[str, Finish]:
    """Finish of the sky at doors instead of an overcast one."""
    if lights.daylight not in _SKIES:
        return {}
    radiance_rgb, colour_rgb = _SKIES[lights.daylight]
    sky = replace(MATERIALS["daylight"], emissive_rgb=radiance_rgb, colour_rgb=colour_rgb)
    return {"daylight": Finish("daylight", sky)}
