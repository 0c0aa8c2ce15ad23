"""The viewer's scene: every object of a stage with its class and transform, every shape once."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from garage2usd.garage.level_place import LevelPlace
from garage2usd.reading.lanes import Lanes
from garage2usd.scenes.meshes import Triangles
from garage2usd.scenes.pictures import Bands, Pictures
from garage2usd.view.viewer.surfaces import ShownSurface

__all__ = ["UNLABELLED", "Light", "Piece", "Placed", "Scene", "Shape", "box_corners", "moved"]

UNLABELLED = "unlabelled"
"""Class of objects without a semantic label."""


def moved(points_m: NDArray[Any], place: NDArray[np.float64]) -> NDArray[np.float32]:
    """Transform points, shape (..., 3), by a matrix, shape (4, 4), with points as rows."""
    found: NDArray[np.float32] = (points_m @ place[:3, :3] + place[3, :3]).astype(np.float32)
    return found


def box_corners(points: NDArray[Any]) -> NDArray[Any]:
    """Eight corners of the bounding box of points, X changing fastest; shape (8, 3)."""
    pair = points.min(axis=0), points.max(axis=0)
    return np.array([[pair[corner >> axis & 1][axis] for axis in range(3)] for corner in range(8)])


@dataclass(frozen=True, eq=False)
class Piece:
    """A mesh of a shape in the object's space, with one surface.

    Attributes
    ----------
    mesh, matrix
        The triangles, and their transform; float64, shape (4, 4), points as rows.
    coordinates
        Texture coordinates of the vertices; float32, shape (vertices, 2).
    slot
        Index of its surface in the object's palette.
    is_blended
        Whether the surface is translucent.
    collider
        Collision shape as UsdPhysics' token: ``none`` for the triangles themselves, ``convexHull``, ``boundingCube``
        and others; empty without collision.
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
        UsdLux type.
    matrix
        float64, shape (4, 4), points as rows.
    width_m, height_m
        Side lengths, or the diameter twice.
    colour_rgb
        Linear colour.
    candela
        Luminous intensity along -Z.
    """

    kind: str
    matrix: NDArray[np.float64]
    width_m: float
    height_m: float
    colour_rgb: tuple[float, float, float]
    candela: float

    def moved(self, place: NDArray[np.float64]) -> "Light":
        """Return the light transformed by a matrix."""
        return replace(self, matrix=self.matrix @ place)

    def key(self) -> tuple[object, ...]:
        """Key of the light, equal for equal lights."""
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
    """Shape of an object in its own space; objects that differ only in colour share one."""

    pieces: Sequence[Piece]
    lights: Sequence[Light] = ()

    @property
    def colliders(self) -> list[Piece]:
        """Pieces with a collision shape."""
        return [piece for piece in self.pieces if piece.collider]


@dataclass(frozen=True, eq=False)
class Placed:
    """An object of the scene: its prim, class and transform.

    Attributes
    ----------
    path
        Path of its prim, or ``path[index]`` for a point of an instancer.
    label
        Semantic class, or `UNLABELLED`.
    square
        Label of the square on which it stands; empty without one.
    shape, palette
        Indices of its shape and palette in the scene.
    matrix
        Transform to the world; float64, shape (4, 4), points as rows.
    """

    path: str
    label: str
    square: str
    shape: int
    palette: int
    matrix: NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Scene:
    """A stage prepared for drawing, in metres, Y up.

    Attributes
    ----------
    name
        The stage's file name.
    facts
        Metadata of the stage, by name.
    objects
        Every object.
    shapes, palettes, surfaces
        Their geometry and surfaces; a palette has the index of a surface for each slot.
    textures, pictures
        Textures of the surfaces, and the images from which they are taken.
    lanes
        Lane graph and stalls, as far as they are valid.
    ids
        Instance id of each object by its path; empty without a label table beside the stage.
    bounds_m
        Least and greatest corner of the scene; float64, shape (2, 3).
    remarks
        Descriptions of everything that is not shown.
    levels
        The levels, the top one first.
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
    levels: Sequence[LevelPlace] = ()

    def counts(self) -> dict[str, int]:
        """Number of objects of each class, in descending order."""
        counts = Counter(placed.label for placed in self.objects)
        return dict(sorted(counts.items(), key=lambda item: (-item[1], item[0])))
