"""The walk through a composed stage: which prims are objects, and what each looks like."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from pxr import Kind, Usd, UsdGeom, UsdShade

from garage2usd.stage.reading import numbers_of
from garage2usd.stage.taxonomy import SQUARE_TAXONOMY, label_of
from garage2usd.view.viewer.colliders import collider_of
from garage2usd.view.viewer.lights import LIGHT_TYPES, light_of
from garage2usd.view.viewer.meshes import DRAWN_TYPES, Triangles, display_colour, face_sets, triangles_of
from garage2usd.view.viewer.scene import UNLABELLED, Collider, Light, Placed, Shape
from garage2usd.view.viewer.surfaces import PLAIN, Surface, surface_of

__all__ = ["StageWalk"]

Matrix = NDArray[np.float64]
_IDENTITY = np.eye(4)
_UNDRAWN = frozenset({"Points", "NurbsPatch", "TetMesh", "Volume", "HermiteCurves", "NurbsCurves"})
_HIDDEN_PURPOSES = frozenset({UsdGeom.Tokens.guide, UsdGeom.Tokens.proxy})


@dataclass(frozen=True, eq=False)
class _Look:
    """What a subtree looks like in the space of its root."""

    parts: list[tuple[int, Matrix, int]] = field(default_factory=list)  # mesh, place, surface
    colliders: list[tuple[int, str, Matrix]] = field(default_factory=list)
    lights: list[Light] = field(default_factory=list)

    def add(self, other: "_Look", place: Matrix) -> None:
        """Take over what another subtree looks like at some place."""
        self.parts.extend((mesh, matrix @ place, surface) for mesh, matrix, surface in other.parts)
        self.colliders.extend((mesh, word, matrix @ place) for mesh, word, matrix in other.colliders)
        self.lights.extend(light.moved(place) for light in other.lights)


@dataclass(frozen=True)
class _Inherited:
    """What a prim has of its parents."""

    path: str
    square: str


class StageWalk:
    """Walks a stage once and each of its prototypes once.

    Notes
    -----
    An object is the outermost prim with a semantic label of the taxonomy ``class``; a point of a labelled instancer;
    where there is no label, a component, an instance or a single mesh. Invisible prims, guides and proxies are left
    out.
    """

    def __init__(self, stage: Usd.Stage) -> None:
        self.stage = stage
        self.time = Usd.TimeCode.EarliestTime()
        self.meshes: list[Triangles] = []
        self.shapes: list[Shape] = []
        self.palettes: list[tuple[int, ...]] = []
        self.surfaces: list[Surface] = []
        self.undrawn: Counter[str] = Counter()
        self.hidden: list[Usd.Prim] = []
        self._mesh_of: dict[bytes, int] = {}
        self._triangles_of: dict[tuple[object, ...], Triangles | None] = {}
        self._shape_of: dict[tuple[object, ...], int] = {}
        self._shape_of_prototype: dict[str, tuple[int, int]] = {}
        self._palette_of: dict[tuple[int, ...], int] = {}
        self._surface_of: dict[Surface, int] = {}
        self._surface_of_material: dict[str, int] = {}
        self._look_of_prototype: dict[str, _Look] = {}
        self._objects_of_prototype: dict[str, list[Placed]] = {}
        self._labelled_prototype: dict[str, bool] = {}

    def objects(self, to_metres: Matrix) -> list[Placed]:
        """Every object of the stage; `to_metres` leads from the stage's space to metres, Y up."""
        found: list[Placed] = []
        for prim in self.stage.GetPseudoRoot().GetChildren():
            self._walk(prim, to_metres, _Inherited(str(prim.GetPath()), ""), found)
        return found

    def _walk(self, prim: Usd.Prim, parent: Matrix, inherited: _Inherited, found: list[Placed]) -> None:
        """Append the objects at and below a prim; `parent` is its parent's place."""
        if self._is_hidden(prim):
            self.hidden.append(prim)
            return
        place = self._place(prim) @ parent
        label = label_of(prim)
        kind = prim.GetTypeName()
        if kind == "PointInstancer":
            found += self._points(prim, place, inherited, label)
            return
        square = label_of(prim, SQUARE_TAXONOMY) or inherited.square
        if label or kind in DRAWN_TYPES or kind in LIGHT_TYPES or self._is_whole(prim):
            found += self._object(prim, place, _Inherited(inherited.path, square), label)
            return
        if kind in _UNDRAWN:
            self.undrawn[kind] += 1
            return
        if prim.IsInstance():
            prototype = prim.GetPrototype()
            found += [
                Placed(
                    inherited.path + placed.path,
                    placed.label,
                    placed.square or square,
                    placed.shape,
                    placed.palette,
                    placed.matrix @ place,
                )
                for placed in self._objects_in(prototype)
            ]
            return
        for child in prim.GetChildren():
            self._walk(child, place, _Inherited(f"{inherited.path}/{child.GetName()}", square), found)

    def _is_whole(self, prim: Usd.Prim) -> bool:
        """Whether a prim without a label is an object nevertheless, as no label stands below it."""
        if prim.IsInstance():
            return not self._has_label_below(prim.GetPrototype())
        if Kind.Registry.IsA(Usd.ModelAPI(prim).GetKind(), Kind.Tokens.component):
            return not any(label_of(child) for child in Usd.PrimRange(prim, Usd.TraverseInstanceProxies()))
        return False

    def _has_label_below(self, prototype: Usd.Prim) -> bool:
        path = str(prototype.GetPath())
        if path not in self._labelled_prototype:
            below = Usd.PrimRange(prototype, Usd.TraverseInstanceProxies())
            self._labelled_prototype[path] = any(label_of(child) for child in below)
        return self._labelled_prototype[path]

    def _objects_in(self, prototype: Usd.Prim) -> list[Placed]:
        """The objects of a prototype, with paths from its root on."""
        path = str(prototype.GetPath())
        if path not in self._objects_of_prototype:
            square = label_of(prototype, SQUARE_TAXONOMY)
            found = self._objects_of_prototype[path] = []
            for child in prototype.GetChildren():
                self._walk(child, _IDENTITY, _Inherited(f"/{child.GetName()}", square), found)
        return self._objects_of_prototype[path]

    def _object(self, prim: Usd.Prim, place: Matrix, inherited: _Inherited, label: str) -> list[Placed]:
        """The object that a prim is; none where there is nothing to see."""
        prototype = str(prim.GetPrototype().GetPath()) if prim.IsInstance() else ""
        numbers = self._shape_of_prototype.get(prototype)
        if numbers is None:
            look = self._look(prim)
            if not look.parts and not look.lights:
                return []
            numbers = self._shape(look)
            if prototype:
                self._shape_of_prototype[prototype] = numbers
        return [Placed(inherited.path, label or UNLABELLED, inherited.square, *numbers, place)]

    def _points(self, prim: Usd.Prim, place: Matrix, inherited: _Inherited, label: str) -> Iterator[Placed]:
        """The points of an instancer, each an object."""
        instancer = UsdGeom.PointInstancer(prim)
        targets = instancer.GetPrototypesRel().GetForwardedTargets()
        indices = numbers_of(instancer.GetProtoIndicesAttr(), np.int64, time=self.time)
        transforms = instancer.ComputeInstanceTransformsAtTime(
            self.time, self.time, UsdGeom.PointInstancer.IncludeProtoXform, UsdGeom.PointInstancer.IgnoreMask
        )
        mask = instancer.ComputeMaskAtTime(self.time)
        prototypes = [self.stage.GetPrimAtPath(target) for target in targets]
        if len(transforms) != len(indices) or (len(indices) and not 0 <= indices.min() <= indices.max() < len(targets)):
            self.undrawn["PointInstancer"] += 1
            return
        labels = [label or label_of(prototype) for prototype in prototypes]
        for number, (index, transform) in enumerate(zip(indices.tolist(), transforms, strict=True)):
            if not mask or mask[number]:
                own = _Inherited(f"{inherited.path}[{number}]", inherited.square)
                yield from self._object(prototypes[index], np.array(transform) @ place, own, labels[index])

    def _look(self, prim: Usd.Prim) -> _Look:
        """What an object looks like in its own space, the prim's own place left out."""
        if prim.IsInstance():
            prototype = prim.GetPrototype()
            path = str(prototype.GetPath())
            if path not in self._look_of_prototype:
                self._look_of_prototype[path] = self._look(prototype)
            return self._look_of_prototype[path]
        look = self._own_look(prim)
        for child in prim.GetChildren():
            if not self._is_hidden(child):
                look.add(self._look(child), self._place(child))
        return look

    def _own_look(self, prim: Usd.Prim) -> _Look:
        """What a prim looks like without its children."""
        look = _Look()
        kind = prim.GetTypeName()
        if kind in DRAWN_TYPES:
            approximation = collider_of(prim)
            for mesh, surface in self._meshes(prim):
                look.parts.append((mesh, _IDENTITY, surface))
                if approximation:
                    look.colliders.append((mesh, approximation, _IDENTITY))
        elif kind in LIGHT_TYPES:
            look.lights.append(light_of(prim, self.time))
        elif kind == "PointInstancer":
            for placed in self._points(prim, _IDENTITY, _Inherited("", ""), ""):
                look.add(self._look_again(placed), placed.matrix)
        elif kind in _UNDRAWN:
            self.undrawn[kind] += 1
        return look

    def _look_again(self, placed: Placed) -> _Look:
        """The look that a shape and a palette were made of; its colliders, which no instancer has, left out."""
        shape, palette = self.shapes[placed.shape], self.palettes[placed.palette]
        numbers = [self._mesh_number(part) for part in shape.parts]
        parts = zip(numbers, shape.matrices, (palette[slot] for slot in shape.slots), strict=True)
        return _Look(parts=list(parts), lights=list(shape.lights))

    def _meshes(self, prim: Usd.Prim) -> list[tuple[int, int]]:
        """Numbers of the meshes and surfaces that a prim consists of."""
        found = []
        for faces in face_sets(prim, self.time):
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
            self._triangles_of[key] = triangles_of(prim, self.time, coordinate_name=coordinate_name)
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
        surface = surface_of(material, self.time) if material else _plain(display_colour(prim, self.time))
        number = self._surface_of.setdefault(surface, len(self._surface_of))
        if number == len(self.surfaces):
            self.surfaces.append(surface)
        if path:
            self._surface_of_material[path] = number
        return number

    def _shape(self, look: _Look) -> tuple[int, int]:
        """Numbers of the shape and the palette of a look."""
        surfaces = [surface for _, _, surface in look.parts]
        slot_of = {surface: slot for slot, surface in enumerate(dict.fromkeys(surfaces))}
        slots = tuple(slot_of[surface] for surface in surfaces)
        blended = tuple(self.surfaces[surface].is_blended for surface in surfaces)
        palette = tuple(slot_of)
        key = (
            tuple((mesh, matrix.tobytes()) for mesh, matrix, _ in look.parts),
            slots,
            blended,
            tuple((mesh, word, matrix.tobytes()) for mesh, word, matrix in look.colliders),
            tuple(light.key() for light in look.lights),
        )
        if key not in self._shape_of:
            self._shape_of[key] = len(self.shapes)
            self.shapes.append(
                Shape(
                    parts=[self.meshes[mesh] for mesh, _, _ in look.parts],
                    matrices=[matrix for _, matrix, _ in look.parts],
                    slots=slots,
                    blended=blended,
                    colliders=[Collider(word, self.meshes[mesh], place) for mesh, word, place in look.colliders],
                    lights=tuple(look.lights),
                )
            )
        number = self._palette_of.setdefault(palette, len(self.palettes))
        if number == len(self.palettes):
            self.palettes.append(palette)
        return self._shape_of[key], number

    def _place(self, prim: Usd.Prim) -> Matrix:
        """A prim's place in its parent's space."""
        xformable = UsdGeom.Xformable(prim)
        if not xformable or not xformable.GetXformOpOrderAttr().HasAuthoredValue():
            return _IDENTITY
        matrix = np.array(xformable.GetLocalTransformation(self.time))
        return matrix if np.isfinite(matrix).all() else _IDENTITY

    def _is_hidden(self, prim: Usd.Prim) -> bool:
        imageable = UsdGeom.Imageable(prim)
        if not imageable:
            return False
        if imageable.GetVisibilityAttr().Get(self.time) == UsdGeom.Tokens.invisible:
            return True
        purpose = imageable.GetPurposeAttr()
        return purpose.HasAuthoredValue() and purpose.Get() in _HIDDEN_PURPOSES


def _plain(colour_rgb: tuple[float, float, float] | None) -> Surface:
    """What has no material looks like."""
    return PLAIN if colour_rgb is None else Surface(colour_rgb=colour_rgb)
