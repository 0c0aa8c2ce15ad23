"""Columns."""

from dataclasses import dataclass

import numpy as np

from garage2usd.assets.mesh import Asset, Collider, Face, make_part
from garage2usd.objects.kind import Kind, Spec
from garage2usd.objects.outline import Polygon, square

__all__ = ["KIND", "ColumnSpec"]

KIND = Kind("column", number=7, label="column", cityscapes="pole", group="Columns")

_HAZARD_TOP_M = 1.2
_BEVEL_M = 0.03


@dataclass(frozen=True)
class ColumnSpec(Spec, kind=KIND):
    """A square column; origin in the middle of its foot."""

    size_m: float
    height_m: float

    def asset(self) -> Asset:
        """A shaft with bevelled edges over a hazard band."""
        foot = _bevelled_prism(self.size_m / 2, 0.0, _HAZARD_TOP_M, _BEVEL_M)
        shaft = _bevelled_prism(self.size_m / 2, _HAZARD_TOP_M, self.height_m, _BEVEL_M)
        return Asset(
            (
                make_part("Hazard", foot, "hazard", collider=Collider.CONVEX_HULL),
                make_part("Shaft", shaft, "wall_concrete", collider=Collider.CONVEX_HULL),
            ),
        )

    def outlines(self) -> tuple[Polygon, ...]:
        """Its section."""
        return (square(self.size_m),)


def _bevelled_prism(half: float, low: float, high: float, bevel: float) -> list[Face]:
    inner = half - bevel
    ring = [(inner, half), (half, inner), (half, -inner), (inner, -half)]
    ring += [(-inner, -half), (-half, -inner), (-half, inner), (-inner, half)]
    faces = []
    for (x0, z0), (x1, z1) in zip(ring, ring[1:] + ring[:1], strict=True):
        faces.append(np.array([(x0, low, z0), (x1, low, z1), (x1, high, z1), (x0, high, z0)]))
    faces.append(np.array([(x, high, z) for x, z in ring]))
    faces.append(np.array([(x, low, z) for x, z in reversed(ring)]))
    return faces
