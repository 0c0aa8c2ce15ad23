"""Cable ladders under the ceiling."""

from dataclasses import dataclass

from garage2usd.assets.faces import box_faces
from garage2usd.assets.mesh import Asset, Collider, Face, make_part
from garage2usd.objects.kind import Kind, Spec, VariantSet

KIND = Kind("cable_tray", number=11, label="cable_tray", cityscapes="static", follows=VariantSet.CEILING)

_RAIL_M = 0.015
_RUNG_PITCH_M = 0.3
_CABLES_M = ((-0.115, 0.035), (-0.07, 0.025), (-0.035, 0.025), (0.03, 0.03), (0.07, 0.02))
"""Left edge and thickness of each cable on a cable ladder, in metres."""


@dataclass(frozen=True)
class CableTraySpec(Spec, kind=KIND):
    """A cable ladder with its cables, long along Z; origin over its middle, on the ceiling.

    Attributes
    ----------
    height_m
        Height of the rails.
    drop_m
        Distance from the ceiling down to the bottom of the ladder.
    rods_at_m
        Places of the pairs of hanger rods along the ladder, from its middle.
    """

    length_m: float
    width_m: float
    height_m: float
    drop_m: float
    rods_at_m: tuple[float, ...]

    def asset(self) -> Asset:
        """Make the meshes of a steel cable ladder: rails, rungs, cables, and bars between hanger rods."""
        x, z, low = self.width_m / 2, self.length_m / 2, -self.drop_m
        rails: list[Face] = []
        for left, right in ((-x, -x + _RAIL_M), (x - _RAIL_M, x)):
            rails += box_faces((left, low, -z), (right, low + self.height_m, z))
        count = max(1, round(self.length_m / _RUNG_PITCH_M))
        rungs: list[Face] = []
        for index in range(count):
            middle = -z + (index + 0.5) * self.length_m / count
            rungs += box_faces((-x + _RAIL_M, low + 0.005, middle - 0.02), (x - _RAIL_M, low + 0.015, middle + 0.02))
        cables: list[Face] = []
        for left, width in _CABLES_M:
            cables += box_faces((left, low + 0.015, -z), (left + width, low + 0.015 + width, z))
        parts = [
            make_part("Rails", rails, "service_steel", collider=Collider.BOX),
            make_part("Rungs", rungs, "service_steel"),
            make_part("Cables", cables, "rubber_black"),
        ]
        hangers: list[Face] = []
        for at in self.rods_at_m:
            hangers += box_faces((-x - 0.04, low - 0.02, at - 0.02), (x + 0.04, low, at + 0.02))
            for side in (-x - 0.03, x + 0.02):
                hangers += box_faces((side, low, at - 0.005), (side + 0.01, 0.0, at + 0.005))
        if hangers:
            parts.append(make_part("Hangers", hangers, "service_hanger"))
        return Asset(tuple(parts))
