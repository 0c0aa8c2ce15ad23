"""Appearance of prims: every distinct mesh and surface of a stage once, and a mesh's faces by material."""

from collections.abc import Hashable, Iterator
from typing import Generic, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray
from pxr import Sdf, Usd, UsdGeom, UsdShade

from garage2usd.common.errors import StageError
from garage2usd.scenes.meshes import Triangles, triangles_of
from garage2usd.scenes.pictures import Pictures
from garage2usd.scenes.prims import NOTHING, DrawnPart, Inherited, PlacedObject
from garage2usd.scenes.remarks import Remarks
from garage2usd.scenes.surfaces import SurfaceLook, SurfaceReader, stands_alone
from garage2usd.scenes.values import READ_AT, numbers_of, opinions_of

_Value = TypeVar("_Value")


def face_sets(prim: Usd.Prim) -> Iterator[tuple[Usd.Prim, NDArray[np.intp] | None]]:
    """Split a mesh into the face subsets with materials of their own and the remaining faces.

    Yields
    ------
    tuple
        The prim with the material binding, and the numbers of its faces; None for all.

    Raises
    ------
    StageError
        If a subset names a face that the mesh lacks.
    """
    children = prim.GetFilteredChildren(Usd.TraverseInstanceProxies())
    subsets = [child for child in children if child.IsA(UsdGeom.Subset) and _is_bound(child)]
    if not subsets:
        yield prim, None
        return
    faces_of = [numbers_of(UsdGeom.Subset(child).GetIndicesAttr(), np.intp) for child in subsets]
    count = len(numbers_of(UsdGeom.Mesh(prim).GetFaceVertexCountsAttr(), np.int64))
    for subset, faces in zip(subsets, faces_of, strict=True):
        wrong = faces[(faces < 0) | (faces >= count)].tolist()
        if wrong:
            file = prim.GetStage().GetRootLayer().realPath
            raise StageError(file, f"{subset.GetPath()} names face {wrong[0]} of {count}")
        yield subset, faces
    rest = np.setdiff1d(np.arange(count), np.concatenate(faces_of))
    if len(rest):
        yield prim, rest


def _is_bound(subset: Usd.Prim) -> bool:
    """Return True if a subset consists of faces and has a material of its own."""
    if UsdGeom.Subset(subset).GetElementTypeAttr().Get(READ_AT) != UsdGeom.Tokens.face:
        return False
    bindings = UsdShade.MaterialBindingAPI(subset)
    purposes = UsdShade.Tokens.allPurpose, UsdShade.Tokens.preview
    return any(bindings.GetDirectBindingRel(purpose).HasAuthoredTargets() for purpose in purposes) or any(
        bindings.GetCollectionBindings(purpose) for purpose in purposes
    )


class Numbered(Generic[_Value]):
    """Distinct values, numbered in order of first occurrence."""

    def __init__(self) -> None:
        self.values: list[_Value] = []
        self._number_of: dict[Hashable, int] = {}

    def number(self, value: _Value, key: Hashable) -> int:
        """Return the number of a value; values with the same key are equal."""
        number = self._number_of.setdefault(key, len(self.values))
        if number == len(self.values):
            self.values.append(value)
        return number


class DrawnMesh(NamedTuple):
    """Triangles of a prim with one surface.

    Attributes
    ----------
    mesh, surface
        Numbers of the triangles and of the surface.
    subset
        Name of the subset of the prim's faces; empty for none.
    """

    mesh: int
    surface: int
    subset: str = ""


class MeshLooks:
    """Collector of distinct meshes and surfaces of prims.

    Parameters
    ----------
    is_apart_by_name
        True to keep surfaces of materials of different names apart, even if they look alike.
    remarks
        Collector of omitted properties; the default is a new one.
    pictures
        Receives the pictures of the textures; the default is a new collection.

    Attributes
    ----------
    meshes, surfaces
        Distinct meshes and surfaces in order of first occurrence.
    pictures
        Pictures of the textures.
    remarks
        Omitted properties.
    """

    def __init__(
        self, *, is_apart_by_name: bool = False, remarks: Remarks | None = None, pictures: Pictures | None = None
    ) -> None:
        self._is_apart_by_name = is_apart_by_name
        self.meshes: Numbered[Triangles] = Numbered()
        self.surfaces: Numbered[SurfaceLook] = Numbered()
        self.remarks = Remarks() if remarks is None else remarks
        self._reader = SurfaceReader(self.remarks, Pictures() if pictures is None else pictures)
        self.pictures = self._reader.pictures
        self._triangles_of: dict[Hashable, Triangles | None] = {}
        self._mesh_of: dict[Hashable, int | None] = {}
        self._surface_of_material: dict[Sdf.Path, int] = {}
        self._surface_of_opinions: dict[Hashable, int] = {}
        self._is_composed_within: dict[Hashable, bool] = {}

    def of_part(self, placed: PlacedObject, part: DrawnPart) -> list[DrawnMesh]:
        """Return the meshes drawn by a part of an object, with its inherited appearance."""
        return self.of_prim(placed.twin_of(part), part.inherited)

    def of_prim(self, prim: Usd.Prim, inherited: Inherited = NOTHING) -> list[DrawnMesh]:
        """Return the meshes of a prim of `garage2usd.scenes.meshes.DRAWN_TYPES`; `inherited` is from outside it."""
        found, opinions = [], opinions_of(prim)
        for bound, faces in face_sets(prim):
            surface = self._surface(bound, prim)
            look = self.surfaces.values[surface]
            names = {own.name for own in look.sets} | {look.colour_name}
            key = look.sets, look.colour_name, opinions, inherited.of(names)
            of_faces = *key, None if faces is None else faces.tobytes()
            if of_faces not in self._mesh_of:
                self._mesh_of[of_faces] = self._mesh(prim, key, look, faces)
            mesh = self._mesh_of[of_faces]
            if mesh is not None:
                found.append(DrawnMesh(mesh, surface, "" if bound == prim else bound.GetName()))
        return found

    def _mesh(self, prim: Usd.Prim, key: Hashable, look: SurfaceLook, faces: NDArray[np.intp] | None) -> int | None:
        """Return the number of the triangles of some faces; None without triangles."""
        # prims with the same opinions have the same triangles
        if key not in self._triangles_of:
            self._triangles_of[key] = triangles_of(prim, sets=look.sets, colour_name=look.colour_name)
            self._remark_coordinates(prim, look, self._triangles_of[key])
        triangles = self._triangles_of[key]
        if triangles is not None and faces is not None:
            triangles = triangles.of_faces(faces)
        if triangles is None or not len(triangles.indices):
            return None
        return self.meshes.number(triangles, triangles.key())

    def _remark_coordinates(self, prim: Usd.Prim, look: SurfaceLook, triangles: Triangles | None) -> None:
        """Add a remark where textures show one pixel, as a prim has no coordinates that fit."""
        for number, own in enumerate(look.sets if look.has_textures and triangles is not None else ()):
            if own.name and triangles is not None and (triangles.coordinates[:, number] == own.fallback).all():
                self.remarks.add(f"textures show one pixel without the coordinates {own.name}", prim.GetPath())

    def _remark_bindings(self, prim: Usd.Prim) -> None:
        """Add a remark for a prim that is bound to a missing material."""
        stage = prim.GetStage()
        while prim and not prim.IsPseudoRoot():
            for target in UsdShade.MaterialBindingAPI(prim).GetDirectBindingRel().GetTargets():
                if not stage.GetPrimAtPath(target):
                    self.remarks.add("bound materials that are missing leave the colour of the mesh", target)
            prim = prim.GetParent()

    def _surface(self, bound: Usd.Prim, prim: Usd.Prim) -> int:
        bindings = UsdShade.MaterialBindingAPI(bound)
        material, _ = bindings.ComputeBoundMaterial(UsdShade.Tokens.preview)
        if not material:
            material, _ = bindings.ComputeBoundMaterial(UsdShade.Tokens.full)
        if not material:
            self._remark_bindings(bound)
            return self._number(self._reader.unbound(prim))
        path = material.GetPath()
        if path in self._surface_of_material:
            return self._surface_of_material[path]
        surface, is_of_prim = self._surface_of(material, prim)
        if not is_of_prim:
            self._surface_of_material[path] = surface
        return surface

    def _surface_of(self, material: UsdShade.Material, bound: Usd.Prim) -> tuple[int, bool]:
        """Return the number of a material's surface, and True if the surface depends on its prim.

        Many prototypes have materials composed of the same opinions.
        """
        prim = material.GetPrim()
        key: Hashable = prim.GetName(), opinions_of(prim)
        # what is below it follows from its own opinions, unless that is composed of something else as well
        if key not in self._is_composed_within:
            self._is_composed_within[key] = any(_has_arcs(part) for part in _below(prim) if part != prim)
        if self._is_composed_within[key]:
            key = prim.GetName(), tuple(opinions_of(part) for part in _below(prim))
        if key not in self._surface_of_opinions:
            surface = self._number(self._reader.surface_of(material, bound))
            if self._reader.read_a_primvar or not stands_alone(material):
                return surface, self._reader.read_a_primvar
            self._surface_of_opinions[key] = surface
        return self._surface_of_opinions[key], False

    def _number(self, surface: SurfaceLook) -> int:
        return self.surfaces.number(surface, (surface, surface.name) if self._is_apart_by_name else surface)


def _below(prim: Usd.Prim) -> Iterator[Usd.Prim]:
    """Yield a prim and all prims below it, including those of instances."""
    yield from Usd.PrimRange(prim, Usd.TraverseInstanceProxies())


def _has_arcs(prim: Usd.Prim) -> bool:
    """Return True if a prim has composition arcs to other prims or to variants."""
    return bool(
        prim.HasAuthoredReferences()
        or prim.HasAuthoredPayloads()
        or prim.HasAuthoredInherits()
        or prim.HasAuthoredSpecializes()
        or prim.HasVariantSets()
    )
