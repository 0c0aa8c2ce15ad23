"""Properties of materials for LiDAR, radar and ultrasonic sensors, in the terms of SimReady's non-visual materials."""

from typing import NamedTuple

from garage2usd.assets.materials import MATERIALS, Material, Touch

_BARE_METALLIC = 0.5


class NonVisual(NamedTuple):
    """Non-visual material properties.

    Attributes
    ----------
    base
        Base substance.
    coating
        ``none``, ``paint``, ``clearcoat`` or ``paint_clearcoat``.
    attributes
        Any of ``emissive``, ``retroreflective`` and ``visually_transparent``, or ``none``.
    """

    base: str
    coating: str = "none"
    attributes: tuple[str, ...] = ("none",)


BASE_OF_TOUCH = {
    Touch.CONCRETE: "concrete",
    Touch.COATING: "concrete",
    Touch.RUBBER: "rubber",
    Touch.STEEL: "steel",
    Touch.PLASTIC: "plastic",
}
"""Base substance by class of friction."""
_PAINTED = frozenset({Touch.COATING, Touch.STEEL})
_BASES = {
    "asphalt_repair": "asphalt",
    "brass": "brass",
    "cabinet_glass": "clear_glass",
    "cardboard": "cardboard",
    "ceiling_insulation": "fiberglass",
    "daylight": "none",
    "floor_asphalt": "asphalt",
    "floor_asphalt_patched": "asphalt",
    "glass": "clear_glass",
    "glass_dark": "clear_glass",
    "hose": "fabric",
    "lamp_dead": "plexiglass",
    "lamp_front": "plexiglass",
    "lamp_rear": "plexiglass",
    "lamp_front_lit": "plexiglass",
    "lamp_rear_lit": "plexiglass",
    "mirror": "mirror",
    "rim": "aluminum",
    "screen_glow": "clear_glass",
    "seat_black": "leather",
    "seat_grey": "fabric",
    "seat_tan": "leather",
    "sign_blue": "aluminum",
    "sign_ring": "aluminum",
    "soft_top": "fabric",
    "tube_glow": "plexiglass",
    "wood_pallet": "wood",
    **{
        key: base
        for prefix, base in {"cloth": "fabric", "skin": "skin", "hair": "fur_hair", "leather": "leather"}.items()
        for key in MATERIALS
        if key.startswith(f"{prefix}_")
    },
}
"""Base substance of materials whose friction class does not determine it; the sky behind doors has none."""
_TRANSPARENT = frozenset({"cabinet_glass", "glass", "glass_dark"})
_PLATES = frozenset(key for key in MATERIALS if key.startswith("number_plate"))
_RETROREFLECTIVE = _PLATES | {"sign_blue", "sign_ring"}
_BARE = frozenset({"service_steel", "steel_galvanised"})


def _non_visual(key: str, material: Material) -> NonVisual:
    is_bare = key in _BARE or material.metallic >= _BARE_METALLIC or (key in _BASES and key not in _RETROREFLECTIVE)
    painted = (material.touch in _PAINTED and not is_bare) or key in _RETROREFLECTIVE
    is_coated = material.clearcoat > 0 and key not in _TRANSPARENT
    coating = {
        (False, False): "none",
        (True, False): "paint",
        (False, True): "clearcoat",
        (True, True): "paint_clearcoat",
    }
    said = {
        "emissive": any(material.emissive_rgb),
        "retroreflective": key in _RETROREFLECTIVE,
        "visually_transparent": key in _TRANSPARENT,
    }
    attributes = tuple(name for name, applies in said.items() if applies) or ("none",)
    return NonVisual(
        _BASES.get(key, "aluminum" if key in _PLATES else BASE_OF_TOUCH[material.touch]),
        coating[painted, is_coated],
        attributes,
    )


NON_VISUAL = {key: _non_visual(key, material) for key, material in MATERIALS.items()}
"""Non-visual properties of every material, by its key."""
