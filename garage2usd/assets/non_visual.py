"""Properties of materials for LiDAR, radar and ultrasonic sensors, in the terms of SimReady's non-visual materials."""

import fnmatch
from collections.abc import Iterable
from typing import NamedTuple

from garage2usd.assets.materials import MATERIALS, Material, Touch
from garage2usd.common.documents import shipped_toml

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


def _keys(patterns: Iterable[str]) -> frozenset[str]:
    return frozenset(key for pattern in patterns for key in fnmatch.filter(MATERIALS, pattern))


_GIVEN = shipped_toml("garage2usd.assets", "non_visual")
_BASES = {key: base for base, patterns in _GIVEN["bases"].items() for key in _keys(patterns)}
"""Base substance of materials whose friction class does not determine it."""
_TRANSPARENT, _RETROREFLECTIVE, _BARE = (_keys(_GIVEN[name]) for name in ("transparent", "retroreflective", "bare"))
_PLATES = _keys(["number_plate*"])


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
