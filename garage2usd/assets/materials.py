"""Materials of all parts, as parameters of a standard surface."""
# Over 300 lines: one table of all materials, a line or a few for each.

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import NamedTuple

from garage2usd.config.map_names import Channel
from garage2usd.config.texture_sets import MapFile

Rgb = tuple[float, float, float]


class PaintedTexture(NamedTuple):
    """A texture of paint that is worn down to its ground.

    Attributes
    ----------
    mask
        File name in the texture folder of an indexed image with the degree of wear.
    paint_rgb, ground_rgb
        Linear colours of the paint and of the ground below it.
    """

    mask: str
    paint_rgb: Rgb
    ground_rgb: Rgb


class OwnTexture(NamedTuple):
    """A texture of the user.

    Attributes
    ----------
    role
        Role of the texture set.
    maps
        Only colour, only normal, or any of occlusion, roughness and metallic, which are packed into one texture.
    roughness, metallic
        Values of a packed texture without these maps, 0 to 1.
    """

    role: str
    maps: tuple[tuple[Channel, MapFile], ...]
    roughness: float = 0.6
    metallic: float = 0.0

    @property
    def use(self) -> str:
        """Input of the surface that uses the texture: ``colour``, ``normal`` or ``packed``."""
        channel = self.maps[0][0]
        return str(channel) if channel in {Channel.COLOUR, Channel.NORMAL} else "packed"


class StoredTexture(NamedTuple):
    """A texture of a model that the user supplies.

    Attributes
    ----------
    stem
        Beginning of its file name.
    data
        RGB or RGBA image.
    suffix
        Extension of its format: ``.png`` or ``.jpg``.
    """

    stem: str
    data: bytes
    suffix: str = ".png"


Texture = str | PaintedTexture | OwnTexture | StoredTexture
"""A file name in the texture folder, or the source of a derived texture."""


class Touch(StrEnum):
    """Class of friction against a tyre."""

    CONCRETE = "concrete"
    COATING = "coating"
    RUBBER = "rubber"
    STEEL = "steel"
    PLASTIC = "plastic"


@dataclass(frozen=True)
class Material:
    """A material as parameters of a standard surface.

    Attributes
    ----------
    colour_rgb
        Linear base colour without a texture.
    colour_texture, packed_texture, normal_texture
        Textures. A packed one has occlusion, roughness and metallic in red, green and blue.
    tint_rgb
        Linear factor on the colour texture.
    roughness, metallic, opacity, clearcoat
        0 to 1.
    has_alpha
        True if the colour texture's alpha is the opacity.
    ior
        Index of refraction; None for the default.
    emissive_rgb
        Linear radiance.
    repeat_m
        Size of one repeat of the textures in metres.
    repeat_up_m
        Size along V, if it differs.
    wraps
        Wrap modes of the textures along U and V: ``repeat``, ``mirror`` or ``clamp``.
    touch
        Class of friction.
    """

    colour_rgb: Rgb = (0.5, 0.5, 0.5)
    colour_texture: Texture | None = None
    tint_rgb: Rgb = (1.0, 1.0, 1.0)
    roughness: float = 0.6
    packed_texture: Texture | None = None
    normal_texture: Texture | None = None
    metallic: float = 0.0
    opacity: float = 1.0
    has_alpha: bool = False
    clearcoat: float = 0.0
    ior: float | None = None
    emissive_rgb: Rgb = (0.0, 0.0, 0.0)
    repeat_m: float = 1.0
    repeat_up_m: float | None = None
    wraps: tuple[str, str] = ("repeat", "repeat")
    touch: Touch = Touch.CONCRETE

    def textures(self) -> tuple[Texture, ...]:
        """Textures of the material."""
        names = (self.colour_texture, self.packed_texture, self.normal_texture)
        return tuple(name for name in names if name is not None)


class Finish(NamedTuple):
    """A material that replaces a standard one in a garage.

    Attributes
    ----------
    key
        Key of the material in `MATERIALS` that defines its friction and non-visual properties.
    material
        Appearance.
    """

    key: str
    material: Material


_PAINT_RGB: dict[str, Rgb] = {
    "white": (0.72, 0.72, 0.70),
    "silver": (0.42, 0.43, 0.44),
    "black": (0.012, 0.012, 0.014),
    "grey": (0.11, 0.12, 0.13),
    "blue": (0.025, 0.07, 0.22),
    "red": (0.30, 0.018, 0.016),
    "green": (0.012, 0.055, 0.035),
    "champagne": (0.40, 0.33, 0.24),
    "orange": (0.52, 0.13, 0.015),
}
_METALLIC_PAINTS = {
    "silver": 0.3,
    "grey": 0.2,
    "blue": 0.2,
    "green": 0.2,
    "champagne": 0.3,
}

VARYING = frozenset({"car_paint"})
"""Materials with paint variants, which set colour, roughness and metallic."""

GLOSSES: dict[str, str] = {
    "mirror": "gloss_mirror.png",
    "polished": "gloss_polished.png",
    "satin": "gloss_satin.png",
    "matt": "gloss_matt.png",
}
"""Packed textures by gloss for floors of concrete and epoxy, from smooth to rough."""

_FINISHES: dict[str, Material] = {
    "floor_trowelled": Material(
        colour_texture="trowelled_colour.jpg", packed_texture=GLOSSES["satin"], roughness=0.35, repeat_m=5.4
    ),
    "floor_sawn": Material(
        colour_texture="sawn_colour.jpg", packed_texture=GLOSSES["satin"], roughness=0.35, repeat_m=5.4
    ),
    "floor_cracked": Material(
        colour_texture="cracked_colour.jpg", packed_texture=GLOSSES["matt"], roughness=0.7, repeat_m=5.4
    ),
    "floor_epoxy": Material(
        colour_texture="epoxy_colour.jpg",
        packed_texture=GLOSSES["polished"],
        roughness=0.2,
        repeat_m=5.4,
        touch=Touch.COATING,
    ),
    "floor_asphalt": Material(
        colour_texture="asphalt_colour.jpg", normal_texture="floor_normal.png", roughness=0.88, repeat_m=2.1
    ),
    "floor_asphalt_patched": Material(colour_texture="asphalt_patched_colour.jpg", roughness=0.88, repeat_m=8.1),
    "floor_pavers": Material(
        colour_texture="pavers_colour.jpg", normal_texture="pavers_normal.png", roughness=0.85, repeat_m=2.4
    ),
    "paint_fresh": Material(colour_texture="wear_fresh.png", roughness=0.5, repeat_m=2.7, touch=Touch.COATING),
    "paint_worn": Material(colour_texture="wear_worn.png", roughness=0.6, repeat_m=2.7, touch=Touch.COATING),
    "paint_gone": Material(colour_texture="wear_gone.png", roughness=0.65, repeat_m=2.7),
    "paint_ghost": Material(colour_texture="wear_ghost.png", roughness=0.6, repeat_m=2.7),
    "wall_painted": Material(colour_texture="painted_colour.jpg", roughness=0.62, repeat_m=4.05, touch=Touch.COATING),
    "wall_blockwork": Material(
        colour_texture="blockwork_colour.jpg", normal_texture="blockwork_normal.png", roughness=0.9, repeat_m=4.0
    ),
    "wall_panels": Material(colour_texture="panels_colour.jpg", roughness=0.7, repeat_m=2.7),
    "wall_sheet_steel": Material(
        colour_texture="sheet_steel_colour.jpg",
        normal_texture="sheet_steel_normal.png",
        roughness=0.45,
        repeat_m=1.0,
        touch=Touch.STEEL,
    ),
    "wall_dado": Material(
        colour_texture="dado_colour.jpg",
        packed_texture="band_packed.png",
        repeat_m=8.1,
        repeat_up_m=1.1,
        touch=Touch.COATING,
    ),
    "column_painted": Material(
        colour_texture="column_painted_colour.jpg",
        roughness=0.6,
        repeat_m=1.35,
        repeat_up_m=4.05,
        touch=Touch.COATING,
    ),
    "ceiling_painted": Material(
        colour_texture="ceiling_painted_colour.jpg",
        normal_texture="ceiling_normal.png",
        roughness=0.8,
        repeat_m=8.1,
        touch=Touch.COATING,
    ),
    "ceiling_insulation": Material(colour_texture="insulation_colour.jpg", roughness=1.0, repeat_m=3.6),
}
"""Tintable materials that a look may use for floor, walls, ceilings and paint."""


def _plate(sheet_rgb: Rgb, ink_rgb: Rgb) -> Material:
    """Material of number plates in two colours."""
    texture = PaintedTexture("plate_ink.png", sheet_rgb, ink_rgb)
    return Material(colour_texture=texture, roughness=0.5, touch=Touch.PLASTIC)


_CLOTHES_RGB: dict[str, Rgb] = {
    "black": (0.014, 0.014, 0.016),
    "navy": (0.014, 0.022, 0.06),
    "grey": (0.16, 0.165, 0.17),
    "denim": (0.05, 0.085, 0.16),
    "beige": (0.42, 0.33, 0.22),
    "white": (0.68, 0.68, 0.66),
    "red": (0.32, 0.02, 0.025),
    "green": (0.04, 0.09, 0.045),
    "brown": (0.10, 0.055, 0.03),
    "yellow": (0.60, 0.36, 0.04),
}
_SKIN_RGB: dict[str, Rgb] = {
    "pale": (0.56, 0.34, 0.25),
    "tan": (0.40, 0.22, 0.14),
    "brown": (0.19, 0.09, 0.052),
    "dark": (0.065, 0.032, 0.022),
}
_HAIR_RGB: dict[str, Rgb] = {
    "black": (0.01, 0.009, 0.009),
    "brown": (0.055, 0.028, 0.014),
    "blond": (0.34, 0.22, 0.09),
    "grey": (0.34, 0.34, 0.33),
}

_WHITE_PAINT = Material(colour_texture="paint_white.jpg", roughness=0.55, repeat_m=2.7, touch=Touch.COATING)
_FORMED_CONCRETE = Material(
    colour_texture="wall_colour.jpg",
    packed_texture="wall_packed.png",
    normal_texture="wall_normal.png",
    repeat_m=8.1,
    repeat_up_m=4.05,
)
_HAZARD = Material(colour_texture="hazard.jpg", roughness=0.5, repeat_m=0.6, touch=Touch.COATING)
_ZINC = Material(colour_texture="steel_colour.jpg", packed_texture="steel_packed.png", repeat_m=1.5, touch=Touch.STEEL)
_DARK_STEEL = Material(colour_rgb=(0.06, 0.06, 0.065), roughness=0.5, metallic=0.6, touch=Touch.STEEL)
_RED_LACQUER = Material(colour_rgb=(0.38, 0.02, 0.015), roughness=0.4, touch=Touch.STEEL)
"""Red lacquer, shared by several materials that a look can change separately."""

MATERIALS: dict[str, Material] = {
    "floor_concrete": Material(
        colour_texture="floor_colour.jpg",
        packed_texture="floor_packed.png",
        normal_texture="floor_normal.png",
        repeat_m=8.1,
    ),
    "stall_epoxy": Material(
        colour_texture="stall_colour.jpg",
        packed_texture="floor_packed.png",
        normal_texture="floor_normal.png",
        repeat_m=5.4,
        touch=Touch.COATING,
    ),
    "stall_green": Material(
        colour_rgb=(0.025, 0.15, 0.06),
        packed_texture="floor_packed.png",
        normal_texture="floor_normal.png",
        repeat_m=5.4,
        touch=Touch.COATING,
    ),
    "stall_blue": Material(
        colour_rgb=(0.02, 0.07, 0.24),
        packed_texture="floor_packed.png",
        normal_texture="floor_normal.png",
        repeat_m=5.4,
        touch=Touch.COATING,
    ),
    "stain_oil": Material(colour_texture="stains.png", has_alpha=True, roughness=0.22),
    "stain_damp": Material(colour_texture="stains.png", has_alpha=True, roughness=0.12),
    "stain_rubber": Material(colour_texture="stains.png", has_alpha=True, roughness=0.6),
    "asphalt_repair": Material(colour_texture="asphalt_repairs.png", has_alpha=True, roughness=0.8),
    "stain_patch": Material(colour_texture="stains.png", has_alpha=True, roughness=0.85),
    "dirt": Material(colour_texture="dirt.png", has_alpha=True, roughness=0.75),
    "road_dust": Material(
        colour_texture="road_dust.png",
        has_alpha=True,
        roughness=0.95,
        repeat_m=2.4,
        repeat_up_m=0.55,
        touch=Touch.PLASTIC,
    ),
    "puddle_water": Material(colour_rgb=(0.012, 0.013, 0.013), roughness=0.03, opacity=0.62, ior=1.33),
    "puddle_damp": Material(colour_rgb=(0.02, 0.02, 0.02), roughness=0.3, opacity=0.34, ior=1.33),
    "drain_gaps": Material(colour_rgb=(0.006, 0.006, 0.006), roughness=0.9),
    "paint_white": _WHITE_PAINT,
    "paint_white_worn": _WHITE_PAINT,
    "paint_stall": _WHITE_PAINT,
    "paint_stall_worn": _WHITE_PAINT,
    "paint_edge": _WHITE_PAINT,
    "paint_number": _WHITE_PAINT,
    "paint_band": _WHITE_PAINT,
    "paint_yellow": Material(colour_texture="paint_yellow.jpg", roughness=0.55, repeat_m=2.7, touch=Touch.COATING),
    "wall_concrete": _FORMED_CONCRETE,
    "wall_band": Material(
        colour_texture="band_colour.jpg",
        packed_texture="band_packed.png",
        repeat_m=8.1,
        repeat_up_m=1.1,
        touch=Touch.COATING,
    ),
    "band_stripe": Material(colour_rgb=(0.62, 0.36, 0.02), roughness=0.5, touch=Touch.COATING),
    "ceiling_concrete": Material(
        colour_texture="ceiling_colour.jpg", roughness=0.9, normal_texture="ceiling_normal.png", repeat_m=8.1
    ),
    "column_concrete": _FORMED_CONCRETE,
    "hazard": _HAZARD,
    "guard_yellow_black": _HAZARD,
    "guard_red_white": Material(
        colour_texture="guard_red_white.jpg", roughness=0.45, repeat_m=0.5, touch=Touch.COATING
    ),
    "guard_blue_yellow": Material(
        colour_texture="guard_blue_yellow.jpg", roughness=0.5, repeat_m=0.6, touch=Touch.COATING
    ),
    "steel_galvanised": _ZINC,
    "steel_dark": _DARK_STEEL,
    "service_steel": _ZINC,
    "service_hanger": _DARK_STEEL,
    "service_pipe": _RED_LACQUER,
    "door_steel": Material(colour_rgb=(0.24, 0.27, 0.29), roughness=0.45, metallic=0.3, touch=Touch.STEEL),
    "housing_white": Material(colour_rgb=(0.7, 0.7, 0.68), roughness=0.4, touch=Touch.STEEL),
    "tube_glow": Material(
        colour_rgb=(0.9, 0.9, 0.9), roughness=0.3, emissive_rgb=(14.0, 13.6, 12.9), touch=Touch.PLASTIC
    ),
    "lamp_dead": Material(colour_rgb=(0.42, 0.42, 0.40), roughness=0.3, touch=Touch.PLASTIC),
    "sign_green": Material(
        colour_rgb=(0.01, 0.28, 0.10), roughness=0.4, emissive_rgb=(0.02, 0.9, 0.3), touch=Touch.STEEL
    ),
    "sign_red": Material(
        colour_rgb=(0.5, 0.02, 0.02), roughness=0.4, emissive_rgb=(0.9, 0.05, 0.03), touch=Touch.STEEL
    ),
    "sign_white": Material(colour_rgb=(0.8, 0.8, 0.8), roughness=0.4, touch=Touch.STEEL),
    "zone_blue": Material(colour_rgb=(0.02, 0.10, 0.36), roughness=0.45, touch=Touch.STEEL),
    "zone_orange": Material(colour_rgb=(0.68, 0.20, 0.01), roughness=0.45, touch=Touch.STEEL),
    "zone_green": Material(colour_rgb=(0.02, 0.22, 0.07), roughness=0.45, touch=Touch.STEEL),
    "zone_red": Material(colour_rgb=(0.40, 0.02, 0.02), roughness=0.45, touch=Touch.STEEL),
    "zone_violet": Material(colour_rgb=(0.16, 0.03, 0.28), roughness=0.45, touch=Touch.STEEL),
    "zone_teal": Material(colour_rgb=(0.01, 0.24, 0.26), roughness=0.45, touch=Touch.STEEL),
    "sign_blue": Material(colour_rgb=(0.01, 0.06, 0.32), roughness=0.4, touch=Touch.STEEL),
    "sign_ring": Material(colour_rgb=(0.5, 0.015, 0.015), roughness=0.4, touch=Touch.STEEL),
    "daylight": Material(colour_rgb=(0.8, 0.85, 0.9), roughness=1.0, emissive_rgb=(3.2, 3.6, 4.2)),
    "kerb_concrete": Material(colour_rgb=(0.32, 0.31, 0.29), roughness=0.85),
    "machine_yellow": Material(colour_rgb=(0.70, 0.36, 0.02), roughness=0.4, touch=Touch.STEEL),
    "screen_glow": Material(
        colour_rgb=(0.02, 0.05, 0.08), roughness=0.2, emissive_rgb=(0.15, 0.5, 0.8), touch=Touch.PLASTIC
    ),
    "pipe_red": _RED_LACQUER,
    "brass": Material(colour_rgb=(0.55, 0.38, 0.12), roughness=0.35, metallic=0.9, touch=Touch.STEEL),
    "sign_orange": Material(colour_rgb=(0.75, 0.18, 0.01), roughness=0.45, touch=Touch.PLASTIC),
    "mirror": Material(colour_rgb=(0.85, 0.87, 0.88), roughness=0.03, metallic=1.0, touch=Touch.PLASTIC),
    "exit_green": Material(
        colour_rgb=(0.005, 0.16, 0.06), roughness=0.4, emissive_rgb=(0.004, 0.16, 0.06), touch=Touch.STEEL
    ),
    "exit_white": Material(colour_rgb=(0.8, 0.8, 0.8), roughness=0.4, emissive_rgb=(1.6, 1.7, 1.6), touch=Touch.STEEL),
    "rubber_black": Material(colour_rgb=(0.022, 0.022, 0.023), roughness=0.8, touch=Touch.RUBBER),
    "rubber_yellow": Material(colour_rgb=(0.62, 0.38, 0.015), roughness=0.65, touch=Touch.RUBBER),
    "glass": Material(colour_rgb=(0.010, 0.014, 0.014), roughness=0.03, opacity=0.52, ior=1.52, touch=Touch.PLASTIC),
    "glass_dark": Material(
        colour_rgb=(0.008, 0.009, 0.01), roughness=0.03, opacity=0.85, ior=1.52, touch=Touch.PLASTIC
    ),
    "soft_top": Material(colour_rgb=(0.016, 0.016, 0.018), roughness=0.95, touch=Touch.PLASTIC),
    "interior_dark": Material(colour_rgb=(0.022, 0.022, 0.024), roughness=0.75, touch=Touch.PLASTIC),
    "seat_black": Material(colour_rgb=(0.035, 0.035, 0.038), roughness=0.85, touch=Touch.PLASTIC),
    "seat_grey": Material(colour_rgb=(0.16, 0.16, 0.165), roughness=0.9, touch=Touch.PLASTIC),
    "seat_tan": Material(colour_rgb=(0.30, 0.17, 0.09), roughness=0.6, touch=Touch.PLASTIC),
    "cabinet_glass": Material(
        colour_rgb=(0.3, 0.34, 0.34), roughness=0.03, opacity=0.14, ior=1.52, touch=Touch.PLASTIC
    ),
    "hose": Material(colour_rgb=(0.72, 0.68, 0.56), roughness=0.9, touch=Touch.RUBBER),
    "tyre": Material(colour_rgb=(0.018, 0.018, 0.019), roughness=0.85, touch=Touch.RUBBER),
    "rim": Material(colour_rgb=(0.5, 0.51, 0.53), roughness=0.28, metallic=0.9, touch=Touch.STEEL),
    "trim_black": Material(colour_rgb=(0.012, 0.012, 0.013), roughness=0.6, touch=Touch.PLASTIC),
    "lamp_front": Material(
        colour_rgb=(0.86, 0.88, 0.90), roughness=0.14, metallic=0.35, clearcoat=1.0, touch=Touch.PLASTIC
    ),
    "lamp_rear": Material(colour_rgb=(0.55, 0.004, 0.006), roughness=0.10, clearcoat=1.0, touch=Touch.PLASTIC),
    "lamp_front_lit": Material(
        colour_rgb=(0.86, 0.88, 0.90), roughness=0.14, emissive_rgb=(30.0, 29.6, 28.8), touch=Touch.PLASTIC
    ),
    "lamp_rear_lit": Material(
        colour_rgb=(0.55, 0.004, 0.006), roughness=0.10, emissive_rgb=(6.0, 0.05, 0.03), touch=Touch.PLASTIC
    ),
    "lamp_housing": Material(colour_rgb=(0.008, 0.009, 0.010), roughness=0.10, clearcoat=1.0, touch=Touch.PLASTIC),
    "chrome": Material(colour_rgb=(0.68, 0.69, 0.70), roughness=0.25, metallic=0.6, clearcoat=1.0, touch=Touch.STEEL),
    "number_plate": Material(colour_texture="plate_characters.png", roughness=0.5, touch=Touch.PLASTIC),
    "number_plate_cn": _plate((0.015, 0.075, 0.42), (0.78, 0.78, 0.78)),
    "number_plate_gb": _plate((0.74, 0.74, 0.70), (0.008, 0.008, 0.009)),
    "number_plate_gb_rear": _plate((0.74, 0.46, 0.02), (0.008, 0.008, 0.009)),
    "number_plate_us": _plate((0.72, 0.74, 0.76), (0.015, 0.035, 0.16)),
    "car_paint": Material(roughness=0.32, clearcoat=1.0, touch=Touch.STEEL),
    **{
        f"car_paint_{paint}": Material(
            colour_rgb=colour,
            roughness=0.32,
            metallic=_METALLIC_PAINTS.get(paint, 0.0),
            clearcoat=1.0,
            touch=Touch.STEEL,
        )
        for paint, colour in _PAINT_RGB.items()
    },
    **{
        f"cloth_{name}": Material(colour_rgb=rgb, roughness=0.9, touch=Touch.RUBBER)
        for name, rgb in _CLOTHES_RGB.items()
    },
    **{f"skin_{name}": Material(colour_rgb=rgb, roughness=0.5, touch=Touch.RUBBER) for name, rgb in _SKIN_RGB.items()},
    **{f"hair_{name}": Material(colour_rgb=rgb, roughness=0.6, touch=Touch.RUBBER) for name, rgb in _HAIR_RGB.items()},
    "leather_black": Material(colour_rgb=(0.02, 0.018, 0.017), roughness=0.45, touch=Touch.RUBBER),
    "leather_brown": Material(colour_rgb=(0.12, 0.05, 0.022), roughness=0.45, touch=Touch.RUBBER),
    "cardboard": Material(colour_rgb=(0.36, 0.235, 0.125), roughness=0.85, touch=Touch.PLASTIC),
    "cardboard_tape": Material(colour_rgb=(0.42, 0.30, 0.14), roughness=0.3, touch=Touch.PLASTIC),
    "wood_pallet": Material(colour_rgb=(0.40, 0.27, 0.15), roughness=0.85, touch=Touch.PLASTIC),
    **{
        f"bin_{name}": Material(colour_rgb=rgb, roughness=0.5, touch=Touch.PLASTIC)
        for name, rgb in {
            "grey": (0.055, 0.058, 0.06),
            "green": (0.015, 0.09, 0.04),
            "blue": (0.015, 0.06, 0.22),
            "yellow": (0.62, 0.42, 0.02),
        }.items()
    },
    **_FINISHES,
}
"""Every material by its key."""


def finished(key: str, finishes: Mapping[str, Finish]) -> Finish:
    """Return the finish of a material in a garage, or the material itself if it has no finish."""
    return finishes.get(key) or Finish(key, MATERIALS[key])
