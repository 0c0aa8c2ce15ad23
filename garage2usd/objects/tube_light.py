"""Tube lights."""

from dataclasses import dataclass

from garage2usd.assets.faces import box_faces, lathe_faces, moved
from garage2usd.assets.mesh import Asset, Collider, Face, RectLight, make_part
from garage2usd.objects.kind import Kind, Spec, VariantSet

__all__ = ["KIND", "TubeLightSpec"]

KIND = Kind("light", number=8, label="light", cityscapes="static", group="Ramps", follows=VariantSet.LIGHTS)

_HOUSING_HEIGHT_M = 0.06
_TUBE_RADIUS_M = 0.016


@dataclass(frozen=True)
class TubeLightSpec(Spec, kind=KIND):
    """A tube light with its housing, long along X; origin in the middle of its top.

    Attributes
    ----------
    drop_m
        From its top down to its lit face.
    luminance_nit
        Of that face, which looks down, cd/m2.
    """

    length_m: float
    width_m: float
    drop_m: float = 0.115
    luminance_nit: float = 0.0

    def asset(self) -> Asset:
        """A batten with two bare tubes that shine from `drop_m` below."""
        x, z = self.length_m / 2, self.width_m / 2
        housing = box_faces((-x, -_HOUSING_HEIGHT_M, -z), (x, 0, z))
        ends: list[Face] = []
        for end in (-x, x - 0.03):
            ends += box_faces((end, -_HOUSING_HEIGHT_M - 0.045, -z), (end + 0.03, -_HOUSING_HEIGHT_M, z))
        tubes: list[Face] = []
        for side in (-z / 2, z / 2):
            ring = lathe_faces([(-x + 0.03, _TUBE_RADIUS_M), (x - 0.03, _TUBE_RADIUS_M)], segments=10)
            tubes += moved(ring, (0.0, -_HOUSING_HEIGHT_M - 0.024, side))
        light = RectLight(self.length_m, self.width_m, -self.drop_m, self.luminance_nit)
        return Asset(
            (
                make_part("Housing", housing, "housing_white", collider=Collider.BOX),
                make_part("Ends", ends, "housing_white"),
                make_part("Tubes", tubes, "tube_glow"),
            ),
            light,
        )
