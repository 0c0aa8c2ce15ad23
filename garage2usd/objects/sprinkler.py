"""Sprinkler pipes."""

from dataclasses import dataclass

from garage2usd.assets.faces import box_faces, level_lathe_faces, moved
from garage2usd.assets.mesh import Asset, Collider, Face, make_part
from garage2usd.objects.kind import Kind, Spec, VariantSet

KIND = Kind("sprinkler", number=23, label="sprinkler", cityscapes="static", follows=VariantSet.CEILING)

_CLAMP_M = 0.008
_HEAD_M = 0.07


@dataclass(frozen=True)
class SprinklerSpec(Spec, kind=KIND):
    """A sprinkler pipe, long along Z; origin over its middle, on the ceiling.

    Attributes
    ----------
    drop_m
        Distance from the ceiling down to the pipe's axis.
    rods_at_m, heads_at_m
        Places of the rods and of the sprinkler heads along the pipe, from its middle.
    """

    length_m: float
    radius_m: float
    drop_m: float
    rods_at_m: tuple[float, ...]
    heads_at_m: tuple[float, ...]

    def asset(self) -> Asset:
        """Make the meshes of a sprinkler pipe: a red pipe on rods with pendent heads."""
        half = self.length_m / 2
        profile = [(-half, 0.0), (-half, self.radius_m), (half, self.radius_m), (half, 0.0)]
        pipe = moved(level_lathe_faces(profile, segments=12), (0.0, -self.drop_m, 0.0))
        rods: list[Face] = []
        for z in self.rods_at_m:
            rods += box_faces(
                (-_CLAMP_M, -self.drop_m + self.radius_m * 0.9, z - _CLAMP_M), (_CLAMP_M, 0.0, z + _CLAMP_M)
            )
        parts = [make_part("Pipe", pipe, "service_pipe", collider=Collider.BOX)]
        if rods:
            parts.append(make_part("Rods", rods, "service_hanger"))
        if self.heads_at_m:
            foot, brass = -self.drop_m - self.radius_m, []
            for z in self.heads_at_m:
                brass += box_faces((-0.012, foot - _HEAD_M + 0.006, z - 0.012), (0.012, foot + 0.004, z + 0.012))
                brass += box_faces((-0.03, foot - _HEAD_M, z - 0.03), (0.03, foot - _HEAD_M + 0.005, z + 0.03))
            parts.append(make_part("Heads", brass, "brass"))
        return Asset(tuple(parts))
