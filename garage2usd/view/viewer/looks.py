"""What the objects of a stage look like: every shape once."""

from collections import Counter

from pxr import Usd

from garage2usd.reading.looks import MeshLooks, Numbered
from garage2usd.reading.meshes import DRAWN_TYPES
from garage2usd.reading.objects import Matrix, PlacedObject, once_for_each_look
from garage2usd.reading.walk import placed_objects
from garage2usd.view.viewer.colliders import collider_of
from garage2usd.view.viewer.lights import LIGHT_TYPES, light_of
from garage2usd.view.viewer.scene import UNLABELLED, Light, Piece, Placed, Shape

__all__ = ["Looks"]


class Looks:
    """Collects what is drawn: what is the same in several places is kept once.

    Attributes
    ----------
    drawn
        The meshes and surfaces that they consist of.
    shapes, palettes
        As `garage2usd.view.viewer.scene.Scene` numbers them.
    undrawn
        How many prims of each type cannot be drawn.
    """

    def __init__(self) -> None:
        self.drawn = MeshLooks()
        self.shapes: Numbered[Shape] = Numbered()
        self.palettes: Numbered[tuple[int, ...]] = Numbered()
        self.undrawn: Counter[str] = Counter()

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
                meshes += [(own.mesh, part.matrix, own.surface, collider) for own in self.drawn.of_prim(part.prim)]
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
            slot, is_blended = palette.index(surface), self.drawn.surfaces.values[surface].is_blended
            pieces.append(Piece(self.drawn.meshes.values[mesh], matrix, slot, is_blended, collider))
            keys.append((mesh, matrix.tobytes(), slot, is_blended, collider))
        key = tuple(keys), tuple(light.key() for light in lights)
        return self.shapes.number(Shape(pieces, lights), key), self.palettes.number(palette, palette)
