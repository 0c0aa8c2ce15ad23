"""What prims look like: every mesh and surface of a stage once."""

from collections.abc import Hashable
from typing import Generic, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray
from pxr import Sdf, Usd, UsdShade

from garage2usd.reading.meshes import Triangles, display_colour, face_sets, triangles_of
from garage2usd.reading.surfaces import SurfaceLook, stands_alone, surface_of
from garage2usd.reading.values import opinions_of

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

    Parameters
    ----------
    is_apart_by_name
        Whether surfaces of materials with other names are different, even if they look alike.

    Attributes
    ----------
    meshes, surfaces
        Different ones in the order in which they were first met.
    """

    def __init__(self, *, is_apart_by_name: bool = False) -> None:
        self._is_apart_by_name = is_apart_by_name
        self.meshes: Numbered[Triangles] = Numbered()
        self.surfaces: Numbered[SurfaceLook] = Numbered()
        self._triangles_of: dict[tuple[str, Hashable], Triangles | None] = {}
        self._mesh_of: dict[Hashable, int | None] = {}
        self._surface_of_material: dict[Sdf.Path, int] = {}
        self._surface_of_opinions: dict[Hashable, int] = {}
        self._is_composed_within: dict[Hashable, bool] = {}

    def of_prim(self, prim: Usd.Prim) -> list[DrawnMesh]:
        """What a prim of one of `garage2usd.reading.meshes.DRAWN_TYPES` draws."""
        found, opinions = [], opinions_of(prim)
        for bound, faces in face_sets(prim):
            surface = self._surface(bound, prim)
            coordinate_name = self.surfaces.values[surface].coordinate_name
            key = coordinate_name, opinions, None if faces is None else faces.tobytes()
            if key not in self._mesh_of:
                self._mesh_of[key] = self._mesh(prim, key[:2], faces)
            mesh = self._mesh_of[key]
            if mesh is not None:
                found.append(DrawnMesh(mesh, surface))
        return found

    def _mesh(self, prim: Usd.Prim, key: tuple[str, Hashable], faces: NDArray[np.intp] | None) -> int | None:
        """Number of the triangles of some faces; None where there are none."""
        # prims made of the same opinions are the same
        if key not in self._triangles_of:
            self._triangles_of[key] = triangles_of(prim, coordinate_name=key[0])
        triangles = self._triangles_of[key]
        if triangles is not None and faces is not None:
            triangles = triangles.of_faces(faces)
        if triangles is None or not len(triangles.indices):
            return None
        return self.meshes.number(triangles, triangles.key())

    def _surface(self, bound: Usd.Prim, prim: Usd.Prim) -> int:
        material, _ = UsdShade.MaterialBindingAPI(bound).ComputeBoundMaterial()
        if not material:
            return self._number(SurfaceLook(colour_rgb=display_colour(prim)))
        path = material.GetPath()
        if path not in self._surface_of_material:
            self._surface_of_material[path] = self._surface_of(material)
        return self._surface_of_material[path]

    def _surface_of(self, material: UsdShade.Material) -> int:
        """Number of a material's surface; many prototypes have materials that are made of the same opinions."""
        prim = material.GetPrim()
        key: Hashable = prim.GetName(), opinions_of(prim)
        # what is below it follows from its own opinions, unless that is composed of something else as well
        if key not in self._is_composed_within:
            self._is_composed_within[key] = any(_has_arcs(part) for part in Usd.PrimRange(prim) if part != prim)
        if self._is_composed_within[key]:
            key = prim.GetName(), tuple(opinions_of(part) for part in Usd.PrimRange(prim))
        if key not in self._surface_of_opinions:
            surface = self._number(surface_of(material))
            if not stands_alone(material):
                return surface
            self._surface_of_opinions[key] = surface
        return self._surface_of_opinions[key]

    def _number(self, surface: SurfaceLook) -> int:
        return self.surfaces.number(surface, (surface, surface.name) if self._is_apart_by_name else surface)


def _has_arcs(prim: Usd.Prim) -> bool:
    """Whether a prim is made of other prims or of variants."""
    return bool(
        prim.HasAuthoredReferences()
        or prim.HasAuthoredPayloads()
        or prim.HasAuthoredInherits()
        or prim.HasAuthoredSpecializes()
        or prim.HasVariantSets()
    )
