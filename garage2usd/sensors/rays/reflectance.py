"""LiDAR reflectance: the share of a pulse that a surface returns, by material class and angle of incidence."""

import fnmatch
from enum import StrEnum
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets import MATERIALS, Material, Touch, pascal_case
from garage2usd.common.documents import shipped_toml
from garage2usd.scenes.surfaces import SurfaceLook


class MaterialClass(StrEnum):
    """Material classes of surfaces at a wavelength of 905 nm."""

    CONCRETE = "concrete"
    ASPHALT = "asphalt"
    COATING = "coating"
    ROAD_PAINT = "road_paint"
    LACQUER = "lacquer"
    METAL = "metal"
    PLASTIC = "plastic"
    RUBBER = "rubber"
    GLASS = "glass"
    MIRROR = "mirror"
    RETROREFLECTOR = "retroreflector"
    OTHER = "other"


class Reflectance(NamedTuple):
    """The reflectance model of a material class.

    Attributes
    ----------
    dark, bright
        Reflectance of a black and of a white surface of the class, relative to a perfect white diffuser.
    specular
        Share of the reflectance in the specular lobe.
    exponent
        Exponent of the specular lobe; larger is narrower.
    """

    dark: float
    bright: float
    specular: float = 0.0
    exponent: float = 1.0


_TABLES = shipped_toml("garage2usd.sensors.rays", "reflectance")
REFLECTANCES = {MaterialClass(name): Reflectance(**given) for name, given in _TABLES["classes"].items()}
"""Reflectance of each material class."""

_OF_TOUCH = {
    Touch.CONCRETE: MaterialClass.CONCRETE,
    Touch.COATING: MaterialClass.COATING,
    Touch.RUBBER: MaterialClass.RUBBER,
    Touch.STEEL: MaterialClass.LACQUER,
    Touch.PLASTIC: MaterialClass.PLASTIC,
}
_OF_KEY = {
    key: MaterialClass(name)
    for name, patterns in _TABLES["materials"].items()
    for pattern in patterns
    for key in fnmatch.filter(MATERIALS, pattern)
}
"""Material classes by material name, which the tactile profile does not determine."""
_METALLIC = 0.5
_TEXTURED = 0.5
_LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


def _class_of(key: str, material: Material) -> MaterialClass:
    if key in _OF_KEY:
        return _OF_KEY[key]
    if material.metallic >= _METALLIC or material.packed_texture == "steel_packed.png":
        return MaterialClass.METAL
    return _OF_TOUCH[material.touch]


_CLASSES = {pascal_case(key): _class_of(key, material) for key, material in MATERIALS.items()}


def material_class(look: SurfaceLook) -> MaterialClass:
    """Classify a surface's material: by its name if it is one of garage2usd's, otherwise by its look."""
    if look.name in _CLASSES:
        return _CLASSES[look.name]
    if look.metallic >= _METALLIC:
        return MaterialClass.METAL
    if look.is_blended and not look.has_alpha:
        return MaterialClass.GLASS
    return MaterialClass.LACQUER if look.clearcoat >= _METALLIC else MaterialClass.OTHER


def returned(look: SurfaceLook, cos_incidence: NDArray[np.floating[Any]]) -> NDArray[np.float64]:
    """Compute the share of a LiDAR pulse that a surface returns, relative to a perfect white diffuser.

    Parameters
    ----------
    look
        The surface.
    cos_incidence
        Cosine of the angle between ray and normal, 0 to 1; shape (n,).

    Returns
    -------
    numpy.ndarray
        0 to 1, shape (n,): min(1, rho ((1 - s) cos a + s max(0, cos 2a)^m)), Phong's model with source and receiver at
        one place, where the mirrored ray is 2a away from the receiver (B. Jutzi and H. Gross, Normalization of LiDAR
        intensity data based on range and surface incidence angle, ISPRS 2009). The share is independent of range, as in
        sensors that report reflectivity. rho is interpolated between `Reflectance.dark` and `Reflectance.bright` by the
        luminance of the colour, and is halfway for textured surfaces.
    """
    reflectance = REFLECTANCES[material_class(look)]
    luminance = _TEXTURED if look.colour_texture else float(np.clip(np.array(look.colour_rgb) @ _LUMINANCE, 0, 1))
    strength = reflectance.dark + (reflectance.bright - reflectance.dark) * luminance
    # cos 2a = 2 cos^2 a - 1
    lobe = np.maximum(2 * cos_incidence**2 - 1, 0) ** reflectance.exponent
    shares = (1 - reflectance.specular) * cos_incidence + reflectance.specular * lobe
    return np.minimum(strength * shares, 1.0).astype(np.float64)
