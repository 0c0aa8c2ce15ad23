"""The lights of a stage."""

import numpy as np
from pxr import Usd, UsdLux

from garage2usd.view.viewer.scene import Light

__all__ = ["LIGHT_TYPES", "light_of"]

LIGHT_TYPES = frozenset({"RectLight", "DiskLight", "SphereLight", "CylinderLight", "DistantLight", "DomeLight"})
"""Types of prims that shine."""


def light_of(prim: Usd.Prim, time: Usd.TimeCode) -> Light:
    """A light in its own space."""
    light = UsdLux.LightAPI(prim)
    sizes = [_number(prim, name, time) for name in ("inputs:width", "inputs:height", "inputs:radius", "inputs:length")]
    width, height, radius, length = sizes
    red, green, blue = np.nan_to_num(np.asarray(light.GetColorAttr().Get(time), dtype=np.float64)).tolist()
    return Light(
        kind=str(prim.GetTypeName()),
        matrix=np.eye(4),
        width_m=width or length or 2 * radius,
        height_m=height or 2 * radius,
        colour_rgb=(red, green, blue),
        intensity=_number(prim, "inputs:intensity", time) * 2 ** _number(prim, "inputs:exposure", time),
    )


def _number(prim: Usd.Prim, name: str, time: Usd.TimeCode) -> float:
    value = prim.GetAttribute(name).Get(time) if prim.HasAttribute(name) else None
    return float(np.clip(np.nan_to_num(float(value or 0.0)), -64, 1e9))
