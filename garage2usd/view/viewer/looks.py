"""What the objects of a stage look like: every mesh, surface and shape once."""

from collections import Counter
from collections.abc import Hashable
from typing import Generic, TypeVar

from pxr import Usd, UsdShade

from garage2usd.reading.objects import Matrix, PlacedObject, once_for_each_look
from garage2usd.reading.walk import placed_objects
from garage2usd.view.viewer.colliders import collider_of
from garage2usd.view.viewer.lights import LIGHT_TYPES, light_of
from garage2usd.view.viewer.meshes import DRAWN_TYPES, Triangles, display_colour, face_sets, triangles_of
from garage2usd.view.viewer.scene import UNLABELLED, Light, Piece, Placed, Shape
from garage2usd.view.viewer.surfaces import SurfaceLook, surface_of

__all__ = ["Looks", "Numbered"]

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


class Looks:
    """Collects what is drawn: what is the same in several places is kept once.

    Attributes
    ----------
    meshes, shapes, palettes, surfaces
        As `garage2usd.view.viewer.scene.Scene` numbers them.
    undrawn
        How many prims of each type cannot be drawn.
    """

    def __init__(self) -> None:
        self.meshes: Numbered[Triangles] = Numbered()
        self.shapes: Numbered[Shape] = Numbered()
        self.palettes: Numbered[tuple[int, ...]] = Numbered()
        self.surfaces: Numbered[SurfaceLook] = Numbered()
        self.undrawn: Counter[str] = Counter()
        self._triangles_of: dict[tuple[object, ...], Triangles | None] = {}
        self._surface_of_material: dict[str, int] = {}

    def objects(self, stage: Usd.Stage, to_metres: Matrix) -> list[Placed]:
        """Every object of a stage that can be drawn; `to_metres` leads from the stage's space to metres, Y up."""
        found, numbers_of = [], once_for_each_look(self._shape)
        for placed in placed_objects(stage, to_metres):
            numbers = numbers_of(placed)
            if numbers is not None:
                found.append(Placed(placed.path, placed.label or UNLABELLED, placed.square, *numbers, placed.matrix))
        return found

    def _shape(self, placed: PlacedObject) -> tuple[int, int] | None:
        """Numbers of the shape and the palette of an object; None where nothing of it can be drawn."""
        meshes: list[tuple[int, Matrix, int, str]] = []  # mesh, place, surface, collider
        lights: list[Light] = []
        for part in placed.parts:
            kind = part.prim.GetTypeName()
            if kind in DRAWN_TYPES:
                collider = collider_of(part.prim)
                meshes += [(mesh, part.matrix, surface, collider) for mesh, surface in self._meshes(part.prim)]
            elif kind in LIGHT_TYPES:
                lights.append(light_of(part.prim).moved(part.matrix))
            else:
                self.undrawn[kind] += 1
        return self._numbered(meshes, lights) if meshes or lights else None

    def _numbered(self, meshes: list[tuple[int, Matrix, int, str]], lights: list[Light]) -> tuple[int, int]:
        """Numbers of the shape and the palette that these make."""
        palette = tuple(dict.fromkeys(surface for _, _, surface, _ in meshes))
        pieces, keys = [], []
        for mesh, matrix, surface, collider in meshes:
            slot, is_blended = palette.index(surface), self.surfaces.values[surface].is_blended
            pieces.append(Piece(self.meshes.values[mesh], matrix, slot, is_blended, collider))
            keys.append((mesh, matrix.tobytes(), slot, is_blended, collider))
        key = tuple(keys), tuple(light.key() for light in lights)
        return self.shapes.number(Shape(pieces, lights), key), self.palettes.number(palette, palette)

    def _meshes(self, prim: Usd.Prim) -> list[tuple[int, int]]:
        """Numbers of the meshes and surfaces that a prim consists of."""
        found = []
        for bound, faces in face_sets(prim):
            surface = self._surface(bound, prim)
            triangles = self._triangles(prim, self.surfaces.values[surface].coordinate_name)
            if triangles is not None and faces is not None:
                triangles = triangles.of_faces(faces)
            if triangles is not None and len(triangles.indices):
                found.append((self.meshes.number(triangles, triangles.key()), surface))
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
