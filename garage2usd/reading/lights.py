"""UsdLux lights of a stage: their intensity, size and direction."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from pxr import Sdf, Usd, UsdLux

from garage2usd.scenes.prims import Matrix
from garage2usd.scenes.values import READ_AT, number_of, vector_of

DOMES = frozenset({"DomeLight", "DomeLight_1"})
"""Types of lights that represent the surroundings."""
LIGHT_TYPES = DOMES | {"RectLight", "DiskLight", "SphereLight", "CylinderLight", "DistantLight"}
"""Types of prims that are lights."""
_AHEAD = {"RectLight": 1.0, "DiskLight": 1.0, "SphereLight": 1 / 4, "CylinderLight": 1 / math.pi}
"""Share of a light's area that is visible along Z."""
_ELLIPSOID = 1.6075
"""Exponent of K. Thomsen's formula for the area of an ellipsoid, with an error of at most 1 %."""
_ALL_ROUND_DEG, _HALF_ROUND_DEG = 180.0, 90.0
_LINKS = ("lightLink", "shadowLink")
_MOST, _MOST_STOPS = 1e9, 64.0


class LightSource(NamedTuple):
    """Photometric properties of a light.

    Attributes
    ----------
    kind
        UsdLux type.
    colour_rgb
        Linear, including its colour temperature.
    width_m, height_m
        Sides along X and Y, or diameter; for a cylinder its length and its diameter.
    luminance_nit
        Luminance of an area light or a dome; infinite without an area.
    candela
        Intensity along -Z, without a cone; 0 for lights at infinity.
    lux
        Illuminance of a surface that faces a distant light; 0 for all others.
    cone_deg
        Angle between -Z and the last ray: 90 for lights that shine to one side, 180 for all directions.
    softness
        Share of the cone with a falloff.
    """

    kind: str
    colour_rgb: tuple[float, float, float]
    width_m: float
    height_m: float
    luminance_nit: float
    candela: float
    lux: float
    cone_deg: float
    softness: float

    @property
    def brightness(self) -> float:
        """Luminance of the light's colour relative to white."""
        return luminance_of(self.colour_rgb)


def luminance_of(colour_rgb: tuple[float, float, float]) -> float:
    """Compute the luminance of a linear colour of ITU-R BT.709."""
    red, green, blue = colour_rgb
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def light_of(prim: Usd.Prim, matrix: Matrix, metres_per_unit: float) -> LightSource:
    """Read the photometric properties of a light.

    Parameters
    ----------
    prim
        One of `LIGHT_TYPES`.
    matrix
        From its space to that of the world, in metres.
    metres_per_unit
        Units of the stage, for the area of a normalized light.

    Notes
    -----
    UsdLux has nits: the luminance is intensity x 2^exposure, divided by the area (for a distant light, by its angle's
    equivalent) if ``normalize`` is on. A light of size 0 is the limit of ever smaller lights.
    """
    kind = str(prim.GetTypeName())
    light = UsdLux.LightAPI(prim)
    strength = max(_number(prim, "inputs:intensity") * 2 ** min(_number(prim, "inputs:exposure"), _MOST_STOPS), 0.0)
    is_normalized = bool(light.GetNormalizeAttr().Get(READ_AT))
    width_m, height_m, area_m2, ahead_m2 = _sizes(prim, kind, np.linalg.norm(matrix[:3, :3], axis=1))
    candela = lux = 0.0
    luminance = strength
    if kind == "DistantLight":
        lux, luminance = _distant(strength, _number(prim, "inputs:angle"), is_normalized=is_normalized)
    elif kind in _AHEAD and is_normalized:
        share = ahead_m2 / area_m2 if area_m2 > 0 else _AHEAD[kind]
        candela = strength * share * metres_per_unit**2
        luminance = candela / ahead_m2 if ahead_m2 > 0 else math.inf
    elif kind in _AHEAD:
        candela = strength * ahead_m2
    cone_deg, softness = _cone(prim)
    return LightSource(
        kind, _colour(light), width_m, height_m, luminance, candela, lux, cone_deg, min(max(softness, 0.0), 1.0)
    )


def _sizes(prim: Usd.Prim, kind: str, scale: NDArray[np.float64]) -> tuple[float, float, float, float]:
    """Return a light's width, height, luminous area, and the area visible along Z; metres."""
    along_x, along_y, along_z = np.nan_to_num(scale).tolist()
    radius = _number(prim, "inputs:radius") if kind in {"DiskLight", "SphereLight", "CylinderLight"} else 0.0
    if kind == "RectLight":
        width_m, height_m = _number(prim, "inputs:width") * along_x, _number(prim, "inputs:height") * along_y
        return width_m, height_m, width_m * height_m, width_m * height_m
    if kind == "CylinderLight":
        length_m, across, deep = _number(prim, "inputs:length") * along_x, radius * along_y, radius * along_z
        return length_m, 2 * across, length_m * _around(across, deep), length_m * 2 * across
    across, up, deep = radius * along_x, radius * along_y, radius * along_z
    if kind == "DiskLight":
        return 2 * across, 2 * up, math.pi * across * up, math.pi * across * up
    if kind == "SphereLight":
        products = [(one * other) ** _ELLIPSOID for one, other in ((across, up), (across, deep), (up, deep))]
        area = 4 * math.pi * (sum(products) / 3) ** (1 / _ELLIPSOID)
        return 2 * across, 2 * up, area, math.pi * across * up
    return 0.0, 0.0, 0.0, 0.0


def _around(one: float, other: float) -> float:
    """Compute the perimeter of an ellipse from its half axes by Ramanujan's formula."""
    return math.pi * (3 * (one + other) - math.sqrt((3 * one + other) * (one + 3 * other)))


def _distant(strength: float, angle_deg: float, *, is_normalized: bool) -> tuple[float, float]:
    """Return the illuminance of a surface facing a distant light in lux, and the light's luminance."""
    half = min(max(math.radians(angle_deg) / 2, 0.0), math.pi)
    square = math.sin(half) ** 2
    size = math.pi * (square if half <= math.pi / 2 else 2 - square) if half else 1.0
    luminance = strength / size if is_normalized else strength
    seen = math.pi * (square if half <= math.pi / 2 else 1.0) if half else 1.0
    return luminance * seen, luminance


def _cone(prim: Usd.Prim) -> tuple[float, float]:
    """Return the cone angle of a light, and its softness."""
    shaping = UsdLux.ShapingAPI(prim)
    angle, softness = shaping.GetShapingConeAngleAttr(), shaping.GetShapingConeSoftnessAttr()
    is_shaped = angle and angle.HasAuthoredValue()
    usual = _ALL_ROUND_DEG if prim.GetTypeName() in {"SphereLight", "CylinderLight"} else _HALF_ROUND_DEG
    angle_deg = number_of(angle) if is_shaped else usual
    return max(angle_deg, 0.0), number_of(softness) if softness else 0.0


def _colour(light: UsdLux.LightAPI) -> tuple[float, float, float]:
    colour = np.maximum(vector_of(light.GetColorAttr(), 3), 0.0)
    if light.GetEnableColorTemperatureAttr().Get(READ_AT):
        kelvin = number_of(light.GetColorTemperatureAttr())
        colour = colour * np.array(UsdLux.BlackbodyTemperatureAsRgb(kelvin))
    red, green, blue = colour.tolist()
    return red, green, blue


def _number(prim: Usd.Prim, name: str) -> float:
    value = number_of(prim.GetAttribute(name)) if prim.HasAttribute(name) else 0.0
    return 0.0 if math.isnan(value) else min(max(value, -_MOST), _MOST)


def unsaid_of(prim: Usd.Prim) -> list[str]:
    """Return the properties of a light that `LightSource` omits, as reasons for remarks."""
    shaping = UsdLux.ShapingAPI(prim)
    file, focus = shaping.GetShapingIesFileAttr(), shaping.GetShapingFocusAttr()
    found = []
    if file and isinstance(value := file.Get(READ_AT), Sdf.AssetPath) and value.path:
        found.append("IES profiles of lights are left out")
    if focus and number_of(focus) > 0:
        found.append("the focus of lights is left out")
    picture = prim.GetAttribute("inputs:texture:file")
    if picture and isinstance(value := picture.Get(READ_AT), Sdf.AssetPath) and value.path:
        found.append("pictures on lights are left out")
    if any(_number(prim, name) != 1 for name in ("inputs:diffuse", "inputs:specular") if prim.HasAttribute(name)):
        found.append("shares of diffuse and specular light are left out")
    if prim.HasAttribute("inputs:shadow:enable") and prim.GetAttribute("inputs:shadow:enable").Get(READ_AT) is False:
        found.append("lights that cast no shadows shine as others do")
    if any(_has_targets(prim, f"collection:{name}:{part}") for name in _LINKS for part in ("includes", "excludes")):
        found.append("lights that are linked to some prims shine on all")
    if _has_targets(prim, "light:filters"):
        found.append("filters of lights are left out")
    return found


def _has_targets(prim: Usd.Prim, name: str) -> bool:
    relationship = prim.GetRelationship(name)
    return bool(relationship) and bool(relationship.GetTargets())
