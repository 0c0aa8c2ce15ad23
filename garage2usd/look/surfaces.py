"""Floors, walls, columns, ceilings and lights of a look: drawn values and finishes."""

from dataclasses import replace

from garage2usd.assets import GLOSSES, MATERIALS, Finish, Rgb
from garage2usd.config.look import (
    AISLE,
    NATURAL,
    NO_DADO,
    CeilingFinish,
    CeilingLook,
    ColumnSection,
    ColumnsLook,
    Daylight,
    Dirt,
    Drains,
    FloorFinish,
    FloorLook,
    Gloss,
    Guard,
    LampKind,
    LightsLook,
    WallFinish,
    WallsLook,
)
from garage2usd.look.finishes import Group, tinted

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


def drawn_columns(axes: Group) -> ColumnsLook:
    """Draw the look of columns: mostly painted white, square more often than round, with all kinds of guards."""
    return ColumnsLook(
        section=axes.one_of(
            "section", {ColumnSection.SQUARE: 0.55, ColumnSection.ROUND: 0.25, ColumnSection.RECTANGULAR: 0.2}
        ),
        colour=axes.one_of(
            "colour", {"#d6d6d2": 0.45, "#c9c5b8": 0.12, NATURAL: 0.25, "#b2b0aa": 0.12, "#8fa3a8": 0.06}
        ),
        guard=axes.one_of(
            "guard",
            {
                Guard.YELLOW_BLACK: 0.32,
                Guard.RED_WHITE: 0.14,
                Guard.BLUE_YELLOW: 0.12,
                Guard.RUBBER: 0.2,
                Guard.NONE: 0.22,
            },
        ),
        guard_height_m=axes.between("guard_height_m", 0.6, 1.6, 0.2),
    )


def column_finishes(columns: ColumnsLook) -> dict[str, Finish]:
    """Finishes of shafts instead of bare concrete."""
    return {} if columns.colour == NATURAL else {"column_concrete": tinted("column_painted", columns.colour)}


def drawn_ceiling(axes: Group) -> CeilingLook:
    """Draw a ceiling and the colour of its services."""
    return CeilingLook(
        finish=axes.one_of(
            "finish",
            {CeilingFinish.WHITE: 0.4, CeilingFinish.RAW: 0.35, CeilingFinish.BLACK: 0.08, CeilingFinish.BOARDS: 0.17},
        ),
        services=axes.one_of("services", {NATURAL: 0.65, "#d0d0cc": 0.2, "#2a2b2d": 0.05, "#8a9094": 0.1}),
        round_ducts=axes.one_of("round_ducts", {False: 0.75, True: 0.25}),
    )


def ceiling_finishes(ceiling: CeilingLook) -> dict[str, Finish]:
    """Finishes of slabs and beams instead of raw concrete, and of services instead of bare steel and red lacquer."""
    finishes = {}
    if ceiling.finish in _UNDERSIDES:
        finishes["ceiling_concrete"] = tinted(*_UNDERSIDES[ceiling.finish])
    if ceiling.services != NATURAL:
        finishes |= dict.fromkeys(_SERVICES, tinted("housing_white", ceiling.services))
    return finishes


def drawn_lights(axes: Group) -> LightsLook:
    """Draw lights: mostly cold tubes, a few of them dead."""
    return LightsLook(
        lamps=axes.one_of("lamps", {LampKind.TUBES: 0.75, LampKind.PANELS: 0.13, LampKind.ROUND: 0.12}),
        temperature_k=axes.one_of(
            "temperature_k",
            {3000.0: 0.05, 3500.0: 0.07, 4000.0: 0.3, 4500.0: 0.1, 5000.0: 0.2, 5700.0: 0.1, 6500.0: 0.18},
        ),
        spread_k=axes.one_of("spread_k", {0.0: 0.5, 100.0: 0.2, 300.0: 0.2, 800.0: 0.1}),
        dead_share=axes.one_of("dead_share", {0.0: 0.45, 0.05: 0.25, 0.15: 0.2, 0.4: 0.1}),
        emergency_only=axes.one_of("emergency_only", {False: 0.96, True: 0.04}),
        daylight=axes.one_of(
            "daylight", {Daylight.OVERCAST: 0.4, Daylight.SUN: 0.25, Daylight.DUSK: 0.1, Daylight.NIGHT: 0.25}
        ),
    )


def light_finishes(lights: LightsLook) -> dict[str, Finish]:
    """Finish of the sky at doors instead of an overcast one."""
    if lights.daylight not in _SKIES:
        return {}
    radiance_rgb, colour_rgb = _SKIES[lights.daylight]
    sky = replace(MATERIALS["daylight"], emissive_rgb=radiance_rgb, colour_rgb=colour_rgb)
    return {"daylight": Finish("daylight", sky)}
