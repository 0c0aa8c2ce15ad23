"""The lights of a stage."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from pxr import Usd, UsdLux

from garage2usd.reading.values import number_of, numbers_of

__all__ = ["LIGHT_TYPES", "Light", "light_of"]

LIGHT_TYPES = frozenset({"RectLight", "DiskLight", "SphereLight", "CylinderLight", "DistantLight", "DomeLight"})
"""Types of prims that shine."""


@dataclass(frozen=True, eq=False)
class Light:
    """A light in its object's space.

    Attributes
    ----------
    kind
        Its UsdLux type.
    matrix
        float64, shape (4, 4), points as rows.
    width_m, height_m
        Its sides, or its diameter twice.
    colour_rgb
        Linear.
    intensity
        UsdLux intensity with its exposure.
    """

    kind: str
    matrix: NDArray[np.float64]
    width_m: float
    height_m: float
    colour_rgb: tuple[float, float, float]
    intensity: float

    def moved(self, place: NDArray[np.float64]) -> "Light":
        """The same elsewhere."""
        return replace(self, matrix=self.matrix @ place)

    def key(self) -> tuple[object, ...]:
        """Equal for lights that are equal in all."""
        return (
            self.kind,
            self.matrix.tobytes(),
            self.width_m,
            self.height_m,
            self.colour_rgb,
            self.intensity,
        )


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
