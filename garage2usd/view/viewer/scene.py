"""A stage as the viewer draws it: every object with its class and place, every shape once."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from garage2usd.reading.lanes import Lanes
from garage2usd.reading.meshes import Triangles
from garage2usd.reading.pictures import Bands, Pictures
from garage2usd.view.viewer.surfaces import ShownSurface

__all__ = ["UNLABELLED", "Light", "Piece", "Placed", "Scene", "Shape", "box_corners", "moved"]

UNLABELLED = "unlabelled"
"""Class of what the stage gives no semantic label."""


def moved(points_m: NDArray[Any], place: NDArray[np.float64]) -> NDArray[np.float32]:
    """Points, shape (..., 3), in another space; `place` is of shape (4, 4), points as rows."""
    found: NDArray[np.float32] = (points_m @ place[:3, :3] + place[3, :3]).astype(np.float32)
    return found


def box_corners(points: NDArray[Any]) -> NDArray[Any]:
    """The eight corners of the box around points, X changing fastest; shape (8, 3)."""
    pair = points.min(axis=0), points.max(axis=0)
    return np.array([[pair[corner >> axis & 1][axis] for axis in range(3)] for corner in range(8)])


@dataclass(frozen=True, eq=False)
class Piece:
    """A mesh in its object's space, with one surface.

    Attributes
    ----------
    mesh, matrix
        The triangles, and where they stand; float64, shape (4, 4), points as rows.
    coordinates
        Where the vertices are on the texture of their surface; float32, shape (vertices, 2).
    slot
        Which of the surfaces of the object's palette it has.
    is_blended
        Whether what is behind it shows through.
    collider
        What a physics engine makes of it, as UsdPhysics' token: ``none`` for the triangles themselves, ``convexHull``,
        ``boundingCube`` and others; empty where nothing collides with it.
    """

    mesh: Triangles
    matrix: NDArray[np.float64]
    coordinates: NDArray[np.float32]
    slot: int
    is_blended: bool
    collider: str = ""


@dataclass(frozen=True, eq=False)
class Light:
    """A light in its object's space.

    Attributes
    ----------
    kind
        Its UsdLux type.
    matrix
        float64, shape (4, 4), points as rows.
    width_m, height_m
        Its sides, or its diameter twice.
    colour_rgb
        Linear.
    candela
        Along -Z.
    """

    kind: str
    matrix: NDArray[np.float64]
    width_m: float
    height_m: float
    colour_rgb: tuple[float, float, float]
    candela: float

    def moved(self, place: NDArray[np.float64]) -> "Light":
        """The same elsewhere."""
        return replace(self, matrix=self.matrix @ place)

    def key(self) -> tuple[object, ...]:
        """Equal for lights that are equal in all."""
        return (
            self.kind,
            self.matrix.tobytes(),
            self.width_m,
            self.height_m,
            self.colour_rgb,
            self.candela,
        )


@dataclass(frozen=True, eq=False)
class Shape:
    """What an object looks like in its own space; objects that differ in colour alone share one."""

    pieces: Sequence[Piece]
    lights: Sequence[Light] = ()

    @property
    def colliders(self) -> list[Piece]:
        """The pieces that something can collide with."""
        return [piece for piece in self.pieces if piece.collider]


@dataclass(frozen=True, eq=False)
class Placed:
    """Where an object stands and what it is.

    Attributes
    ----------
    path
        Its prim, or ``path[index]`` for a point of an instancer.
    label
        Its semantic class, or `UNLABELLED`.
    square
        What the label of the square says that it stands on; empty for none.
    shape, palette
        Numbers of its shape and palette in the scene.
    matrix
        To the world; float64, shape (4, 4), points as rows.
    """

    path: str
    label: str
    square: str
    shape: int
    palette: int
    matrix: NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Scene:
    """A stage, ready to be drawn; metres, Y up.

    Attributes
    ----------
    name
        The stage's file name.
    facts
        What the stage says of itself, by name.
    objects
        Every object.
    shapes, palettes, surfaces
        What they look like: a palette is the numbers of surfaces by slot.
    textures, pictures
        What each texture that the surfaces refer to shows, and what that is taken from.
    lanes
        The lane graph and the stalls, as far as they are sound.
    ids
        Instance id of each object by its path, where a label table stands beside the stage.
    bounds_m
        Least and greatest corner of all; float64, shape (2, 3).
    remarks
        What is not shown, in words.
    """

    name: str
    facts: Mapping[str, str]
    objects: Sequence[Placed]
    shapes: Sequence[Shape]
    palettes: Sequence[Sequence[int]]
    surfaces: Sequence[ShownSurface]
    textures: Sequence[Bands]
    pictures: Pictures
    lanes: Lanes
    ids: Mapping[str, int]
    bounds_m: NDArray[np.float64]
    remarks: Sequence[str] = field(default_factory=tuple)

    def counts(self) -> dict[str, int]:
        """How many objects each class has, the most first."""
        counts = Counter(placed.label for placed in self.objects)
        return dict(sorted(counts.items(), key=lambda item: (-item[1], item[0])))
