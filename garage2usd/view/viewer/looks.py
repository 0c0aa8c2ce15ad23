"""What the objects of a stage look like: every mesh, surface and shape once."""

from collections import Counter

from pxr import Usd, UsdShade

from garage2usd.reading.objects import Matrix, PlacedObject, once_for_each_look
from garage2usd.reading.values import READ_AT
from garage2usd.reading.walk import placed_objects
from garage2usd.view.viewer.colliders import collider_of
from garage2usd.view.viewer.lights import LIGHT_TYPES, light_of
from garage2usd.view.viewer.meshes import DRAWN_TYPES, Triangles, display_colour, face_sets, triangles_of
from garage2usd.view.viewer.scene import UNLABELLED, ColliderMesh, Light, Placed, Shape
from garage2usd.view.viewer.surfaces import PLAIN, SurfaceLook, surface_of

__all__ = ["Looks"]


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
        self.meshes: list[Triangles] = []
        self.shapes: list[Shape] = []
        self.palettes: list[tuple[int, ...]] = []
        self.surfaces: list[SurfaceLook] = []
        self.undrawn: Counter[str] = Counter()
        self._mesh_of: dict[bytes, int] = {}
        self._triangles_of: dict[tuple[object, ...], Triangles | None] = {}
        self._shape_of: dict[tuple[object, ...], int] = {}
        self._palette_of: dict[tuple[int, ...], int] = {}
        self._surface_of: dict[SurfaceLook, int] = {}
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
        meshes: list[tuple[int, Matrix, int]] = []  # mesh, place, surface
        colliders: list[tuple[int, str, Matrix]] = []
        lights: list[Light] = []
        for part in placed.parts:
            kind = part.prim.GetTypeName()
            if kind in DRAWN_TYPES:
                approximation = collider_of(part.prim)
                for mesh, surface in self._meshes(part.prim):
                    meshes.append((mesh, part.matrix, surface))
                    if approximation:
                        colliders.append((mesh, approximation, part.matrix))
            elif kind in LIGHT_TYPES:
                lights.append(light_of(part.prim, READ_AT).moved(part.matrix))
            else:
                self.undrawn[kind] += 1
        return self._numbered(meshes, colliders, lights) if meshes or lights else None

    def _numbered(
        self, parts: list[tuple[int, Matrix, int]], colliders: list[tuple[int, str, Matrix]], lights: list[Light]
    ) -> tuple[int, int]:
        """Numbers of the shape and the palette that these make."""
        surfaces = [surface for _, _, surface in parts]
        slot_of = {surface: slot for slot, surface in enumerate(dict.fromkeys(surfaces))}
        slots = tuple(slot_of[surface] for surface in surfaces)
        blended = tuple(self.surfaces[surface].is_blended for surface in surfaces)
        palette = tuple(slot_of)
        key = (
            tuple((mesh, matrix.tobytes()) for mesh, matrix, _ in parts),
            slots,
            blended,
            tuple((mesh, word, matrix.tobytes()) for mesh, word, matrix in colliders),
            tuple(light.key() for light in lights),
        )
        if key not in self._shape_of:
            self._shape_of[key] = len(self.shapes)
            self.shapes.append(
                Shape(
                    parts=[self.meshes[mesh] for mesh, _, _ in parts],
                    matrices=[matrix for _, matrix, _ in parts],
                    slots=slots,
                    blended=blended,
                    colliders=[ColliderMesh(word, self.meshes[mesh], place) for mesh, word, place in colliders],
                    lights=tuple(lights),
                )
            )
        number = self._palette_of.setdefault(palette, len(self.palettes))
        if number == len(self.palettes):
            self.palettes.append(palette)
        return self._shape_of[key], number

    def _meshes(self, prim: Usd.Prim) -> list[tuple[int, int]]:
        """Numbers of the meshes and surfaces that a prim consists of."""
        found = []
        for faces in face_sets(prim, READ_AT):
            surface = self._surface(faces.prim, prim)
            triangles = self._triangles(prim, self.surfaces[surface].coordinate_name)
            if triangles is not None and faces.faces is not None:
                triangles = triangles.of_faces(faces.faces)
            if triangles is not None and len(triangles.indices):
                found.append((self._mesh_number(triangles), surface))
        return found

    def _triangles(self, prim: Usd.Prim, coordinate_name: str) -> Triangles | None:
        # prims made of the same opinions are the same: prototypes that differ in a variant share most of theirs
        key = coordinate_name, *((spec.layer.identifier, str(spec.path)) for spec in prim.GetPrimStack())
        if key not in self._triangles_of:
            self._triangles_of[key] = triangles_of(prim, READ_AT, coordinate_name=coordinate_name)
        return self._triangles_of[key]

    def _mesh_number(self, triangles: Triangles) -> int:
        key = triangles.key()
        if key not in self._mesh_of:
            self._mesh_of[key] = len(self.meshes)
            self.meshes.append(triangles)
        return self._mesh_of[key]

    def _surface(self, bound: Usd.Prim, prim: Usd.Prim) -> int:
        material, _ = UsdShade.MaterialBindingAPI(bound).ComputeBoundMaterial()
        path = str(material.GetPath()) if material else ""
        if path and path in self._surface_of_material:
            return self._surface_of_material[path]
        surface = surface_of(material, READ_AT) if material else _plain(display_colour(prim, READ_AT))
        number = self._surface_of.setdefault(surface, len(self._surface_of))
        if number == len(self.surfaces):
            self.surfaces.append(surface)
        if path:
            self._surface_of_material[path] = number
        return number


def _plain(colour_rgb: tuple[float, float, float] | None) -> SurfaceLook:
    """What has no material looks like."""
    return PLAIN if colour_rgb is None else SurfaceLook(colour_rgb=colour_rgb)
