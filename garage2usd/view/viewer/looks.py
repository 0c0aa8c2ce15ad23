"""Shapes and palettes of a stage's objects, without duplicates."""

from collections import Counter
from functools import partial

import numpy as np
from numpy.typing import NDArray
from pxr import Usd

from garage2usd.reading.lights import DOMES, LIGHT_TYPES
from garage2usd.scenes.looks import MeshLooks, Numbered
from garage2usd.scenes.meshes import DRAWN_TYPES
from garage2usd.scenes.objects import Matrix, PlacedObject, once_for_each_look
from garage2usd.scenes.remarks import Remarks
from garage2usd.scenes.values import metres_per_unit
from garage2usd.scenes.walk import placed_objects
from garage2usd.view.viewer.colliders import collider_of
from garage2usd.view.viewer.lights import placed_light
from garage2usd.view.viewer.scene import UNLABELLED, Light, Piece, Placed, Shape
from garage2usd.view.viewer.surfaces import ShownSurface, ShownSurfaces

__all__ = ["Looks"]

NOWHERE = DOMES | {"DistantLight"}
"""Types of lights without a position."""


class Looks:
    """Collector of a stage's visible objects; equal shapes, palettes and surfaces are stored once.

    Attributes
    ----------
    drawn
        Meshes and surfaces of the objects.
    shapes, palettes, surfaces
        As numbered by `garage2usd.view.viewer.scene.Scene`.
    shown
        Textures of the surfaces.
    undrawn
        Number of prims of each type that cannot be drawn.
    remarks
        Other things that are not shown.
    """

    def __init__(self) -> None:
        self.remarks = Remarks()
        self.drawn = MeshLooks(remarks=self.remarks)
        self.shown = ShownSurfaces(self.drawn.pictures, self.remarks)
        self.surfaces: list[ShownSurface] = []
        self.shapes: Numbered[Shape] = Numbered()
        self.palettes: Numbered[tuple[int, ...]] = Numbered()
        self.undrawn: Counter[str] = Counter()

    def objects(self, stage: Usd.Stage, to_metres: Matrix) -> list[Placed]:
        """Collect every drawable object of a stage; `to_metres` transforms the stage's space to metres, Y up."""
        units = metres_per_unit(stage)
        found, numbers_of = [], once_for_each_look(partial(self._shape, metres_per_unit=units))
        for placed in placed_objects(stage, to_metres):
            numbers = numbers_of(placed)
            if numbers is not None:
                found.append(Placed(placed.path, placed.label or UNLABELLED, placed.square, *numbers, placed.matrix))
        return found

    def _shape(self, placed: PlacedObject, metres_per_unit: float) -> tuple[int, int] | None:
        """Numbers of an object's shape and palette; None if no part of it can be drawn."""
        meshes: list[tuple[int, Matrix, int, str]] = []  # mesh, transform, surface, collider
        lights: list[Light] = []
        for part in placed.parts:
            kind = part.prim.GetTypeName()
            if kind in DRAWN_TYPES:
                collider = collider_of(part.prim)
                meshes += [(own.mesh, part.matrix, own.surface, collider) for own in self.drawn.of_part(placed, part)]
            elif kind in LIGHT_TYPES:
                to_world = part.matrix @ placed.matrix
                lights.append(placed_light(part.prim, part.matrix, to_world, metres_per_unit))
                if kind in NOWHERE:
                    self.remarks.add(f"lights of the type {kind} are not shown", placed.path + part.path)
            else:
                self.undrawn[kind] += 1
        return self._numbered(meshes, lights) if meshes or lights else None

    def _numbered(self, meshes: list[tuple[int, Matrix, int, str]], lights: list[Light]) -> tuple[int, int]:
        """Numbers of the shape and the palette made of these meshes and lights."""
        palette = tuple(dict.fromkeys(surface for _, _, surface, _ in meshes))
        pieces, keys = [], []
        for mesh, matrix, number, collider in meshes:
            slot, surface, triangles = palette.index(number), self._surface(number), self.drawn.meshes.values[mesh]
            coordinates = surface.layout.placed(triangles.coordinates[:, surface.set])
            self._note_wraps(number, coordinates)
            pieces.append(Piece(triangles, matrix, coordinates, slot, surface.is_blended, collider))
            keys.append((mesh, matrix.tobytes(), slot, surface.is_blended, collider, surface.set, surface.layout))
        key = tuple(keys), tuple(light.key() for light in lights)
        return self.shapes.number(Shape(pieces, lights), key), self.palettes.number(palette, palette)

    def _surface(self, number: int) -> ShownSurface:
        """Convert a surface for the page."""
        for look in self.drawn.surfaces.values[len(self.surfaces) : number + 1]:
            self.surfaces.append(self.shown.of(look))
        return self.surfaces[number]

    def _note_wraps(self, number: int, coordinates: NDArray[np.float32]) -> None:
        layout, name = self.surfaces[number].layout, self.drawn.surfaces.values[number].name
        wraps = {layout.wrap_s, layout.wrap_t}
        if wraps != {"repeat"} and (coordinates.min(initial=0) < 0 or coordinates.max(initial=1) > 1):
            self.remarks.add(f"textures that {' and '.join(sorted(wraps - {'repeat'}))} outside are repeated", name)
