"""What prims look like: every mesh and surface of a stage once."""

from collections.abc import Hashable
from typing import Generic, NamedTuple, TypeVar

from pxr import Usd, UsdShade

from garage2usd.reading.meshes import Triangles, display_colour, face_sets, triangles_of
from garage2usd.reading.surfaces import SurfaceLook, surface_of

__all__ = ["DrawnMesh", "MeshLooks", "Numbered"]

_Value = TypeVar("_Value")


class Numbered(Generic[_Value]):
    """Different values in the order in which they were first met."""

    def __init__(self) -> None:
        self.values: list[_Value] = []
        self._number_of: dict[Hashable, int] = {}

    def number(self, value: _Value, key: Hashable) -> int:
        """Number of a value; values with the same key are the same."""
        number = self._number_of.setdefault(key, len(self.values))
        if number == len(self.values):
            self.values.append(value)
        return number


class DrawnMesh(NamedTuple):
    """Triangles of a prim that have one surface.

    Attributes
    ----------
    mesh, surface
        Numbers of the triangles and of the surface.
    """

    mesh: int
    surface: int


class MeshLooks:
    """Collects what prims look like: what is the same in several places is kept once.

    Attributes
    ----------
    meshes, surfaces
        Different ones in the order in which they were first met.
    """

    def __init__(self) -> None:
        self.meshes: Numbered[Triangles] = Numbered()
        self.surfaces: Numbered[SurfaceLook] = Numbered()
        self._triangles_of: dict[tuple[object, ...], Triangles | None] = {}
        self._surface_of_material: dict[str, int] = {}

    def of_prim(self, prim: Usd.Prim) -> list[DrawnMesh]:
        """What a prim of one of `garage2usd.reading.meshes.DRAWN_TYPES` draws."""
        found = []
        for bound, faces in face_sets(prim):
            surface = self._surface(bound, prim)
            triangles = self._triangles(prim, self.surfaces.values[surface].coordinate_name)
            if triangles is not None and faces is not None:
                triangles = triangles.of_faces(faces)
            if triangles is not None and len(triangles.indices):
                found.append(DrawnMesh(self.meshes.number(triangles, triangles.key()), surface))
        return found

    def _triangles(self, prim: Usd.Prim, coordinate_name: str) -> Triangles | None:
        # prims made of the same opinions are the same: prototypes that differ in a variant share most of theirs
        key = coordinate_name, *((spec.layer.identifier, str(spec.path)) for spec in prim.GetPrimStack())
        if key not in self._triangles_of:
            self._triangles_of[key] = triangles_of(prim, coordinate_name=coordinate_name)
        return self._triangles_of[key]

    def _surface(self, bound: Usd.Prim, prim: Usd.Prim) -> int:
        material, _ = UsdShade.MaterialBindingAPI(bound).ComputeBoundMaterial()
        path = str(material.GetPath()) if material else ""
        if path and path in self._surface_of_material:
            return self._surface_of_material[path]
        surface = surface_of(material) if material else SurfaceLook(colour_rgb=display_colour(prim))
        number = self.surfaces.number(surface, surface)
        if path:
            self._surface_of_material[path] = number
        return number
