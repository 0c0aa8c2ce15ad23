"""Ceiling beams between columns."""

from dataclasses import dataclass

from garage2usd.assets.faces import box_faces
from garage2usd.assets.mesh import Asset, Collider, make_part
from garage2usd.objects.kind import Box, Kind, Spec, VariantSet

KIND = Kind("beam", number=9, label="beam", cityscapes="building", follows=VariantSet.CEILING)


@dataclass(frozen=True)
class BeamSpec(Spec, kind=KIND):
    """A beam under the ceiling, long along Z; origin in the middle of its top."""

    length_m: float
    width_m: float
    depth_m: float

    def asset(self) -> Asset:
        """Make the mesh of a concrete beam without its top, which the slab covers."""
        x, z = self.width_m / 2, self.length_m / 2
        faces = box_faces((-x, -self.depth_m, -z), (x, 0, z), without="t")
        return Asset((make_part("Concrete", faces, "ceiling_concrete", collider=Collider.BOX),))


@dataclass(frozen=True)
class BeamNodeSpec(Spec, kind=KIND):
    """A node of beams without a column: touching rectangles, `depth_m` deep; origin on the ceiling."""

    boxes: tuple[Box, ...]
    depth_m: float

    def asset(self) -> Asset:
        """Make the mesh of a beam node, one box per rectangle."""
        parts = [
            make_part(
                f"Concrete{index}",
                box_faces((left, -self.depth_m, top), (right, 0, bottom), without="t"),
                "ceiling_concrete",
                collider=Collider.BOX,
            )
            for index, (left, top, right, bottom) in enumerate(self.boxes, start=1)
        ]
        return Asset(tuple(parts))
