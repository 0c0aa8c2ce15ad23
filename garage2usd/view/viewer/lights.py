"""The lights of a stage."""

import numpy as np
from pxr import Usd, UsdLux

from garage2usd.reading.values import number_of, numbers_of
from garage2usd.view.viewer.scene import Light

__all__ = ["LIGHT_TYPES", "light_of"]

LIGHT_TYPES = frozenset({"RectLight", "DiskLight", "SphereLight", "CylinderLight", "DistantLight", "DomeLight"})
"""Types of prims that shine."""


def light_of(prim: Usd.Prim) -> Light:
    """A light in its own space."""
    light = UsdLux.LightAPI(prim)
    sizes = [_number(prim, name) for name in ("inputs:width", "inputs:height", "inputs:radius", "inputs:length")]
    width, height, radius, length = sizes
    ((red, green, blue),) = np.nan_to_num(numbers_of(light.GetColorAttr(), np.float64, width=3)).tolist()
    return Light(
        kind=str(prim.GetTypeName()),
        matrix=np.eye(4),
        width_m=width or length or 2 * radius,
        height_m=height or 2 * radius,
        colour_rgb=(red, green, blue),
        intensity=_number(prim, "inputs:intensity") * 2 ** _number(prim, "inputs:exposure"),
    )


def _number(prim: Usd.Prim, name: str) -> float:
    value = number_of(prim.GetAttribute(name)) if prim.HasAttribute(name) else 0.0
    return float(np.clip(np.nan_to_num(value), -64, 1e9))
