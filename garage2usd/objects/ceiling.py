"""The ceiling slab over one square."""

from dataclasses import dataclass

from garage2usd.assets.faces import box_faces
from garage2usd.assets.mesh import Asset, Collider, make_part
from garage2usd.objects.kind import Kind, Spec, VariantSet

KIND = Kind("ceiling", number=3, label="ceiling", cityscapes="building", group="Ceilings", follows=VariantSet.CEILING)


@dataclass(frozen=True)
class CeilingSpec(Spec, kind=KIND):
    """A ceiling slab; origin in the middle of its underside.

    Attributes
    ----------
    width_m, depth_m, thickness_m
        Extent of the slab.
    bears_floor
        True if the floor of the level above lies on it, which is its upper face.
    """

    width_m: float
    depth_m: float
    thickness_m: float
    bears_floor: bool = False

    def asset(self) -> Asset:
        """Make the mesh of a ceiling slab."""
        x, z = self.width_m / 2, self.depth_m / 2
        faces = box_faces((-x, 0, -z), (x, self.thickness_m, z), without="t" if self.bears_floor else "")
        return Asset((make_part("Slab", faces, "ceiling_concrete", collider=Collider.BOX),))
