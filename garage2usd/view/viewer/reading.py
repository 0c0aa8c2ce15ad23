"""Reading of a stage as a viewer scene: shapes and palettes without duplicates, colliders and lights."""

from collections import Counter
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import Usd

from garage2usd.common.errors import StageError
from garage2usd.reading.colliders import BOXES, HULLS, collider_of
from garage2usd.reading.label_table import read_label_table
from garage2usd.reading.lanes import read_lanes
from garage2usd.reading.levels import levels_of
from garage2usd.reading.lights import DOMES, LIGHT_TYPES, light_of
from garage2usd.reading.whole_garage import garage_root
from garage2usd.scenes.looks import MeshLooks, Numbered
from garage2usd.scenes.meshes import DRAWN_TYPES, Triangles, box_corners
from garage2usd.scenes.prims import Matrix, PlacedObject, once_for_each_look
from garage2usd.scenes.remarks import Remarks
from garage2usd.scenes.values import metres_per_unit, metres_y_up
from garage2usd.scenes.walk import placed_objects
from garage2usd.view.viewer.scene import (
    UNLABELLED,
    Light,
    Piece,
    Placed,
    Scene,
    Shape,
    ShownSurface,
    ShownSurfaces,
    moved,
)

_CREASE_COS = 0.99999
_BOX_EDGES = [(a, b) for a in range(8) for b in range(a + 1, 8) if (a ^ b).bit_count() == 1]
NOWHERE = DOMES | {"DistantLight"}
"""Types of lights without a position."""
_FACTS = ("generator", "version", "seed", "configDigest", "structureDigest")


def collider_lines(piece: Piece) -> NDArray[np.float32]:
    """Line segments of a collider in its object's space: edges of the box or hull, or creases of the mesh.

    Returns
    -------
    numpy.ndarray
        float32, shape (lines, 2, 3), in units of the stage.
    """
    return moved(_lines(piece.mesh, piece.collider), piece.matrix)


def _lines(mesh: Triangles, approximation: str) -> NDArray[np.float32]:
    points = mesh.positions_m
    if approximation in BOXES:
        edges: NDArray[np.float32] = box_corners(points)[_BOX_EDGES].astype(np.float32)
        return edges
    triangles = mesh.indices.astype(np.int64)
    if approximation in HULLS:
        from scipy.spatial import ConvexHull, QhullError  # noqa: PLC0415 - slow to import, and colliders are rarely shown

        with suppress(QhullError):  # flat points have no hull; their triangles are drawn instead
            triangles = ConvexHull(points).simplices
    return _creases(points, triangles)


def _creases(points: NDArray[np.float32], triangles: NDArray[np.int64]) -> NDArray[np.float32]:
    """Edges of a triangle mesh, without those between coplanar triangles."""
    _, same = np.unique(np.round(points, 5), axis=0, return_inverse=True)
    places = points[triangles]
    normals = np.cross(places[:, 1] - places[:, 0], places[:, 2] - places[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    edges = np.sort(same.ravel()[triangles][:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    ends = triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    _, first, inverse, counts = np.unique(edges, axis=0, return_index=True, return_inverse=True, return_counts=True)
    normal_of = np.repeat(normals, 3, axis=0)
    # an edge is flat if the normals of all its triangles are parallel, regardless of sign
    along = np.abs((normal_of * normal_of[first][inverse.ravel()]).sum(axis=1)) > _CREASE_COS
    flat = np.bincount(inverse.ravel(), weights=along) == counts
    lines: NDArray[np.float32] = points[ends[first[~(flat & (counts > 1))]]]
    return lines


def placed_light(prim: Usd.Prim, within: Matrix, to_world: Matrix, metres_per_unit: float) -> Light:
    """Convert a UsdLux light to its object's space.

    Parameters
    ----------
    prim
        The light.
    within, to_world
        Transforms from the light's space to that of the object, and to the world in metres.
    metres_per_unit
        Length unit of the stage.
    """
    source = light_of(prim, to_world, metres_per_unit)
    sizes = np.maximum(np.linalg.norm(to_world[:2, :3], axis=1), np.finfo(np.float64).tiny)
    return Light(
        kind=source.kind,
        matrix=within,
        width_m=float(source.width_m / sizes[0]),
        height_m=float(source.height_m / sizes[1]),
        colour_rgb=source.colour_rgb,
        candela=source.candela,
    )


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


def read_scene(stage: Usd.Stage, path: Path, looks: Looks | None = None) -> Scene:
    """Read a stage as a viewer scene.

    Parameters
    ----------
    stage
        The stage.
    path
        The stage's file; ``<stem>_labels.json`` beside it provides the instance ids.
    looks
        Collects shapes and surfaces; the scene also has those that are added later, such as those of agents.

    Raises
    ------
    StageError
        If nothing in the stage can be drawn, or the file beside it is not a label table.
    """
    looks = looks or Looks()
    objects = looks.objects(stage, metres_y_up(stage))
    if not objects:
        raise StageError(path, "nothing in it can be drawn")
    remarks = [f"{count} prims of type {kind} are not drawn" for kind, count in sorted(looks.undrawn.items())]
    remarks += looks.remarks.lines()
    return Scene(
        name=path.name,
        facts=_facts(stage),
        objects=objects,
        shapes=looks.shapes.values,
        palettes=looks.palettes.values,
        surfaces=looks.surfaces,
        textures=looks.shown.textures,
        pictures=looks.drawn.pictures,
        lanes=read_lanes(stage),
        ids=_ids(path),
        bounds_m=_bounds_m(objects, looks.shapes.values),
        remarks=remarks,
        levels=levels_of(stage),
    )


def _facts(stage: Usd.Stage) -> dict[str, str]:
    root = garage_root(stage)
    data = root.GetCustomData() if root else {}
    return {name: str(data[name]) for name in _FACTS if name in data}


def _ids(path: Path) -> dict[str, int]:
    """Instance id of each object by its path; empty without a label table."""
    table = read_label_table(path)
    return {path: entry.id for path, entry in table.by_path()} if table else {}


def _bounds_m(objects: list[Placed], shapes: list[Shape]) -> NDArray[np.float64]:
    boxes = np.array([_corners(shape) for shape in shapes])
    matrices = np.array([placed.matrix for placed in objects])
    corners = boxes[[placed.shape for placed in objects]] @ matrices[:, :3, :3] + matrices[:, 3:, :3]
    bounds: NDArray[np.float64] = np.stack([corners.min(axis=(0, 1)), corners.max(axis=(0, 1))])
    return bounds


def _corners(shape: Shape) -> NDArray[np.float64]:
    """Eight corners of a shape's bounding box in its own space; those of its lights if it has no triangles."""
    points: list[NDArray[Any]] = [moved(piece.mesh.positions_m, piece.matrix) for piece in shape.pieces]
    points = points or [light.matrix[3:, :3] for light in shape.lights]
    return box_corners(np.concatenate(points)).astype(np.float64)
