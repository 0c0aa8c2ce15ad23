"""The ceiling slab over one square."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import shapely

from garage2usd.assets.faces import box_faces
from garage2usd.assets.flat import level_triangles
from garage2usd.assets.mesh import Asset, Collider, make_part
from garage2usd.objects.kind import Kind, Polygon, Spec, VariantSet

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


@dataclass(frozen=True)
class OpenCeilingSpec(CeilingSpec, kind=KIND):
    """A ceiling slab with openings, as over the ramps of a survey.

    Attributes
    ----------
    openings
        Their outlines (x, z).
    """

    openings: tuple[Polygon, ...] = ()

    @property
    def ground(self) -> shapely.Geometry:
        """The slab as seen from above."""
        x, z = self.width_m / 2, self.depth_m / 2
        return shapely.box(-x, -z, x, z).difference(
            shapely.union_all([shapely.Polygon(each) for each in self.openings])
        )

    def asset(self) -> Asset:
        """Make the mesh of a ceiling slab: both faces, and the edges all around."""
        faces = []
        for corners in level_triangles(self.ground):
            faces.append(np.array([(x, self.thickness_m, z) for x, z in corners]))
            faces.append(np.array([(x, 0.0, z) for x, z in corners[::-1]]))
        for part in shapely.get_parts(shapely.orient_polygons(self.ground)):
            for ring in (part.exterior, *part.interiors):
                for (x, z), (end_x, end_z) in pairwise(ring.coords):
                    low = [(x, 0.0, z), (end_x, 0.0, end_z)]
                    high = [(end_x, self.thickness_m, end_z), (x, self.thickness_m, z)]
                    faces.append(np.array([*low, *high])[::-1])
        return Asset((make_part("Slab", faces, "ceiling_concrete", collider=Collider.MESH),))
