"""Ventilation ducts."""

from collections.abc import Sequence
from dataclasses import dataclass

from garage2usd.assets.faces import box_faces, level_lathe_faces, moved, ring_faces
from garage2usd.assets.mesh import Asset, Collider, Face, make_part
from garage2usd.objects.kind import Kind, Spec, VariantSet

KIND = Kind("duct", number=10, label="duct", cityscapes="static", follows=VariantSet.CEILING)

_FLANGE_PITCH_M = 1.35
_FLANGE_M = 0.025
_SEGMENTS = 20
_NECK_M = 0.12
"""Half the height of the outlet necks of round ducts."""


@dataclass(frozen=True)
class DuctSpec(Spec, kind=KIND):
    """A ventilation duct on hangers, or two round ducts side by side, long along Z; origin in the middle of its top.

    Attributes
    ----------
    length_m, width_m, height_m
        Extent of a rectangular duct, or of the bounding box of both round ducts.
    hanger_m
        Length of the hangers from the duct's top to the ceiling.
    hangers_at_m
        Places of the hangers along the duct, from its middle.
    is_round
        True for two round ducts, as thick as the box is high.
    joint
        End where round ducts join a transverse one: 1 at +Z, -1 at -Z, 0 at none.
    """

    length_m: float
    width_m: float
    height_m: float
    hanger_m: float
    hangers_at_m: tuple[float, ...]
    is_round: bool = False
    joint: int = 0

    def asset(self) -> Asset:
        """Make the meshes of a duct: its body, flanges, hangers, and outlets if it is long."""
        x, z = self.width_m / 2, self.length_m / 2
        count = max(1, round(self.length_m / _FLANGE_PITCH_M))
        middles = [-z + (index + 0.5) * self.length_m / count for index in range(count)]
        body, flanges = self._round(middles) if self.is_round else self._rectangular(middles)
        hangers: list[Face] = []
        for at in self.hangers_at_m:
            bar_low, bar_high = -self.height_m - _FLANGE_M - 0.05, -self.height_m - _FLANGE_M - 0.02
            hangers += box_faces((-x - 0.09, bar_low, at - 0.02), (x + 0.09, bar_high, at + 0.02))
            for side in (-x - 0.05, x + 0.03):
                hangers += box_faces((side, bar_high, at - 0.01), (side + 0.02, self.hanger_m, at + 0.01))
        parts = [
            make_part("Body", body, "service_steel", collider=Collider.BOX),
            make_part("Flanges", flanges, "service_steel"),
        ]
        if hangers:
            parts.append(make_part("Hangers", hangers, "service_hanger"))
        if self.length_m > 3:  # noqa: PLR2004 - a short branch has no outlet
            grille: list[Face] = []
            for slat in range(5):
                low = -self.height_m + 0.07 + slat * 0.042
                grille += box_faces((x, low, -0.3), (x + 0.012, low + 0.024, 0.3))
                grille += box_faces((-x - 0.012, low, -0.3), (-x, low + 0.024, 0.3))
            if self.is_round:
                low, high = -self.height_m / 2 - _NECK_M, -self.height_m / 2 + _NECK_M
                necks = box_faces((x - self.height_m / 2, low, -0.32), (x, high, 0.32), without="l")
                necks += box_faces((-x, low, -0.32), (self.height_m / 2 - x, high, 0.32), without="r")
                parts.append(make_part("Necks", necks, "service_steel"))
            parts.append(make_part("Outlets", grille, "steel_dark"))
        return Asset(tuple(parts))

    def _rectangular(self, flanges_at: Sequence[float]) -> tuple[list[Face], list[Face]]:
        """Return the body and flanges of a rectangular duct."""
        x, z = self.width_m / 2, self.length_m / 2
        flanges: list[Face] = []
        for middle in flanges_at:
            flanges += ring_faces((-x, -self.height_m, middle - 0.02), (x, 0, middle + 0.02), _FLANGE_M)
        return box_faces((-x, -self.height_m, -z), (x, 0, z)), flanges

    def _round(self, flanges_at: Sequence[float]) -> tuple[list[Face], list[Face]]:
        """Return the body and flanges of two round ducts; a joint extends both into the nearer transverse duct."""
        radius, half = self.height_m / 2, self.length_m / 2
        start, end = -half - radius * (self.joint < 0), half + radius * (self.joint > 0)
        body: list[Face] = []
        flanges: list[Face] = []
        for x in (radius - self.width_m / 2, self.width_m / 2 - radius):
            axis = x, -radius, 0.0
            pipe = [(start, 0.0), (start, radius), (end, radius), (end, 0.0)]
            body += moved(level_lathe_faces(pipe, segments=_SEGMENTS), axis)
            for middle in flanges_at:
                near, far, rim = middle - 0.02, middle + 0.02, radius + _FLANGE_M
                ring = [(near, radius), (near, rim), (far, rim), (far, radius)]
                flanges += moved(level_lathe_faces(ring, segments=_SEGMENTS), axis)
        return body, flanges
