"""Lights of a stage as punctual lights of glTF (KHR_lights_punctual)."""

import math
from typing import Any

import numpy as np
from pxr import Usd

from garage2usd.maps.glb_materials import shortest
from garage2usd.reading.lights import DOMES, LIGHT_TYPES, LightSource, light_of, unsaid_of
from garage2usd.scenes.prims import Matrix
from garage2usd.scenes.remarks import Remarks

_HALF_ROUND_DEG = 90.0
_EDGE = 0.999
"""Ratio of a sharp cone's inner to outer angle; glTF requires less than 1."""
_FLAT = frozenset({"RectLight", "DiskLight"})
_PANELS = _FLAT | {"CylinderLight"}


def why_left_out(prim: Usd.Prim, *, glows: bool) -> str:
    """Explain why a light has no glTF equivalent; empty if it has one.

    Parameters
    ----------
    prim
        The light.
    glows
        True if the light's object is emissive, as the glass of a lamp is.
    """
    kind = prim.GetTypeName()
    if kind in DOMES or kind not in LIGHT_TYPES:
        return f"lights of the type {kind} are left out"
    return "lights with an area are left out where their lamp glows" if kind in _PANELS and glows else ""


def punctual_light(
    prim: Usd.Prim, path: str, matrix: Matrix, metres_per_unit: float, remarks: Remarks
) -> dict[str, Any] | None:
    """Convert a light to glTF's JSON; None for a light without intensity.

    Parameters
    ----------
    prim, path
        The light, and its name in remarks.
    matrix
        Transform from the light's space to the world, in metres.
    metres_per_unit
        Metres per unit of the stage.
    remarks
        Receives remarks on omissions and changes.
    """
    light = light_of(prim, matrix, metres_per_unit)
    brightest = max(light.colour_rgb)
    strength = (light.lux or light.candela) * brightest
    if not strength > 0:
        if light.luminance_nit > 0 and brightest > 0 and not light.candela:
            remarks.add("lights without a size shine nothing unless they are normalized", path)
        return None
    if light.kind != "DistantLight" and light.cone_deg <= 0:
        remarks.add("lights in a cone without an angle shine nothing", path)
        return None
    for reason in unsaid_of(prim):
        remarks.add(reason, path)
    made: dict[str, Any] = {"intensity": shortest([strength])[0]}
    if light.colour_rgb != (brightest,) * 3:
        made["color"] = shortest(part / brightest for part in light.colour_rgb)
    return made | _form(light, path, remarks)


def _form(light: LightSource, path: str, remarks: Remarks) -> dict[str, Any]:
    """Return the type of a glTF light (sun, point or spot) and its cone angles."""
    if light.kind == "DistantLight":
        return {"type": "directional"}
    if light.cone_deg > _HALF_ROUND_DEG:
        if light.kind == "CylinderLight":
            remarks.add("cylinder lights shine as points, as strongly as across their axes", path)
        if light.cone_deg < 2 * _HALF_ROUND_DEG:
            remarks.add("lights in a cone wider than 90 degrees shine to all sides", path)
        return {"type": "point"}
    if light.kind in _FLAT and light.width_m * light.height_m > 0:
        remarks.add("flat lights shine as spots, as strongly as straight ahead", path)
    outer = math.radians(light.cone_deg)
    # a cone of 180 degrees falls off like a flat light
    softness = 1.0 if light.cone_deg == _HALF_ROUND_DEG else light.softness
    return {"type": "spot", "spot": {"innerConeAngle": outer * min(1 - softness, _EDGE), "outerConeAngle": outer}}


def place_of(matrix: Matrix) -> Matrix:
    """Return the rotation and translation of a light, without its scale."""
    place = np.eye(4)
    ahead, up = matrix[2, :3], matrix[1, :3]
    back = ahead / (np.linalg.norm(ahead) or 1.0)
    side = np.cross(up, back)
    if np.linalg.norm(side) < np.finfo(np.float32).eps:
        side = np.cross(np.eye(3)[np.abs(back).argmin()], back)
    side /= np.linalg.norm(side)
    place[:3, :3] = side, np.cross(back, side), back
    place[3, :3] = matrix[3, :3]
    return place
