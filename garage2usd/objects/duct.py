"""Ventilation ducts."""

from dataclasses import dataclass

from garage2usd.assets.faces import box_faces, ring_faces
from garage2usd.assets.mesh import Asset, Collider, Face, make_part
from garage2usd.objects.kind import Kind, Spec, VariantSet

__all__ = ["KIND", "DuctSpec"]

KIND = Kind("duct", number=10, label="duct", cityscapes="static", follows=VariantSet.CEILING)

_FLANGE_PITCH_M = 1.35
_FLANGE_M = 0.025


@dataclass(frozen=True)
class DuctSpec(Spec, kind=KIND):
    """A rectangular duct on hangers, long along Z; origin in the middle of its top.

    Attributes
    ----------
    hanger_m
        Length of the hangers from its top to the ceiling.
    hangers_at_m
        Places of the hangers along it, from its middle.
    """

    length_m: float
    width_m: float
    height_m: float
    hanger_m: float
    hangers_at_m: tuple[float, ...]

    def asset(self) -> Asset:
        """A duct with flanges and hangers, and outlets if it is long."""
        x, z = self.width_m / 2, self.length_m / 2
        body = box_faces((-x, -self.height_m, -z), (x, 0, z))
        count = max(1, round(self.length_m / _FLANGE_PITCH_M))
        flanges: list[Face] = []
        hangers: list[Face] = []
        for index in range(count):
            middle = -z + (index + 0.5) * self.length_m / count
            f = _FLANGE_M
            flanges += ring_faces((-x, -self.height_m, middle - 0.02), (x, 0, middle + 0.02), f)
        for at in self.hangers_at_m:
            bar_low, bar_high = -self.height_m - _FLANGE_M - 0.05, -self.height_m - _FLANGE_M - 0.02
            hangers += box_faces((-x - 0.09, bar_low, at - 0.02), (x + 0.09, bar_high, at + 0.02))
            for side in (-x - 0.05, x + 0.03):
                hangers += box_faces((side, bar_high, at - 0.01), (side + 0.02, self.hanger_m, at + 0.01))
        parts = [
            make_part("Body", body, "steel_galvanised", collider=Collider.BOX),
            make_part("Flanges", flanges, "steel_galvanised"),
            make_part("Hangers", hangers, "steel_dark"),
        ]
        if self.length_m > 3:  # noqa: PLR2004 - a short branch has no outlet
            grille: list[Face] = []
            for slat in range(5):
                low = -self.height_m + 0.07 + slat * 0.042
                grille += box_faces((x, low, -0.3), (x + 0.012, low + 0.024, 0.3))
                grille += box_faces((-x - 0.012, low, -0.3), (-x, low + 0.024, 0.3))
            parts.append(make_part("Outlets", grille, "steel_dark"))
        return Asset(tuple(parts))
