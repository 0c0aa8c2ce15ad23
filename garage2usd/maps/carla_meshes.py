"""Objects of a stage as meshes for CARLA: one mesh an object, named by its class, with its colliders and materials."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, QhullError

from garage2usd.maps.carla_materials import Materials, first_texture
from garage2usd.maps.carla_names import folder_of, mesh_name
from garage2usd.objects import CAR_LABELS, number_plate
from garage2usd.reading.colliders import BOXES, HULLS, collider_of
from garage2usd.reading.labels import Labels
from garage2usd.scenes.looks import MeshLooks
from garage2usd.scenes.meshes import DRAWN_TYPES, Triangles, box_corners, triangles_of
from garage2usd.scenes.prims import PlacedObject, once_for_each_look
from garage2usd.scenes.remarks import Remarks

ACTORS = CAR_LABELS | {number_plate.KIND.label}
"""Semantic classes of objects that are actors in CARLA, not meshes of the map."""
TO_MAP_CM = np.array([[100.0, 0, 0, 0], [0, 0, 100.0, 0], [0, -100.0, 0, 0], [0, 0, 0, 1.0]])
"""From metres with Y up to centimetres with Z up, for row vectors: the frame of maps (`garage2usd.maps.frame`)."""
_FLAT_M = 1e-5
Corners = NDArray[np.float64]


class MapMesh(NamedTuple):
    """The mesh of an object.

    Attributes
    ----------
    name
        Name of the mesh: its class, and the instance id of the object.
    placed
        The object.
    folder
        Folder of its class in CARLA.
    number
        Instance id.
    colliders
        Number of its collision meshes, ``UCX_NAME_00`` and so on.
    """

    name: str
    placed: PlacedObject
    folder: str
    number: int
    colliders: int

    def facts(self) -> dict[str, Any]:
        """Return the mesh as plain values."""
        return {
            "mesh": self.name,
            "folder": self.folder,
            "class": self.placed.label,
            "id": self.number,
            "prim": self.placed.path,
        }


class _Piece(NamedTuple):
    """Triangles of one material in their object's space; `coordinates` has shape (vertices, 2)."""

    triangles: Triangles
    coordinates: NDArray[np.float32]
    material: int


@dataclass
class MapMeshes:
    """The meshes of a map, as the arrays and plain values that ``carla_fbx.py`` reads.

    Attributes
    ----------
    meshes
        The meshes in the order of the stage.
    materials
        Materials as plain values, in the order of their first use.
    pictures
        Files of their textures by name.
    arrays
        Arrays of all meshes and then of their colliders, one after another: ``positions`` in centimetres, Z up,
        ``normals``, ``coordinates``, ``triangles`` and the ``materials`` of triangles; and the ``counts`` (vertices,
        triangles) of each.
    names
        Names of the meshes and then of their colliders.
    """

    meshes: list[MapMesh] = field(default_factory=list)
    materials: list[dict[str, Any]] = field(default_factory=list)
    pictures: dict[str, bytes] = field(default_factory=dict)
    arrays: dict[str, NDArray[Any]] = field(default_factory=dict)
    names: list[str] = field(default_factory=list)


def map_meshes(objects: Sequence[PlacedObject], labels: Labels, remarks: Remarks) -> MapMeshes:
    """Collect the meshes of all objects except vehicles and their plates.

    Parameters
    ----------
    objects
        Objects from `garage2usd.scenes.walk.placed_objects` in metres, Y up.
    labels
        Their instance ids; objects without one get the next numbers.
    remarks
        Receives remarks on features that FBX, or CARLA's import of it, lacks.

    Notes
    -----
    Vertices are where they are in the map, and meshes have no transform, as CARLA places each mesh at its origin. What
    collides by its triangles in the stage has no collision mesh, as CARLA collides with what is drawn.
    """
    looks, found = _Looks(remarks), MapMeshes()
    pieces_of, colliders_of = once_for_each_look(looks.pieces), once_for_each_look(_colliders)
    bodies: list[tuple[NDArray[np.float64], ...]] = []
    hulls: list[tuple[NDArray[np.float64], ...]] = []
    hull_names: list[str] = []
    further = max(labels.ids.values(), default=0)
    for placed in objects:
        pieces = pieces_of(placed) if placed.label not in ACTORS else []
        if not pieces:
            continue
        number = labels.ids.get(placed.path)
        if number is None:
            number = further = further + 1
        folder, matrix = folder_of(placed.label), placed.matrix @ TO_MAP_CM
        name, own = mesh_name(folder, number), colliders_of(placed)
        found.meshes.append(MapMesh(name, placed, folder, number, len(own)))
        bodies.append(_joined(pieces, matrix))
        hulls += [_hull(corners @ matrix[:3, :3] + matrix[3, :3]) for corners in own]
        hull_names += [f"UCX_{name}_{count:02d}" for count in range(len(own))]
    found.names = [*(mesh.name for mesh in found.meshes), *hull_names]
    found.arrays = _stacked([*bodies, *hulls])
    found.materials, found.pictures = looks.materials.values, looks.materials.files
    return found


class _Looks:
    """Reader of objects' triangles, with the materials that they show."""

    def __init__(self, remarks: Remarks) -> None:
        self._looks, self._remarks = MeshLooks(is_apart_by_name=True, remarks=remarks), remarks
        self.materials = Materials(self._looks.pictures, remarks)

    def pieces(self, placed: PlacedObject) -> list[_Piece]:
        """Return the triangles of an object in its space."""
        found = []
        for part in placed.parts:
            if part.prim.GetTypeName() not in DRAWN_TYPES:
                continue
            for mesh, number, _ in self._looks.of_part(placed, part):
                triangles, look = self._looks.meshes.values[mesh], self._looks.surfaces.values[number]
                if triangles.double_sided:
                    self._remarks.add("the back of double-sided meshes is not drawn", placed.path + part.path)
                texture = first_texture(look)
                coordinates = look.placed_on(texture, triangles.coordinates) if texture else triangles.coordinates[:, 0]
                found.append(_Piece(triangles.moved(part.matrix), coordinates, self.materials.number(number, look)))
        return found


def _colliders(placed: PlacedObject) -> list[Corners]:
    """Return the corners of the convex colliders of an object in its space, shape (n, 3) each."""
    found = []
    for part in placed.parts:
        approximation = collider_of(part.prim)
        if approximation not in BOXES | HULLS or part.prim.GetTypeName() not in DRAWN_TYPES:
            continue
        triangles = triangles_of(placed.twin_of(part))
        if triangles is None:
            continue
        corners = triangles.positions_m.astype(np.float64)
        if approximation in BOXES:
            corners = box_corners(corners)
        if np.linalg.svd(corners - corners.mean(axis=0), compute_uv=False)[-1] > _FLAT_M:
            found.append(corners @ part.matrix[:3, :3] + part.matrix[3, :3])
    return found


def _hull(corners: Corners) -> tuple[NDArray[np.float64], ...]:
    """Return the convex hull of points as a mesh: positions, normals, coordinates, triangles, materials."""
    try:
        hull = ConvexHull(corners)
    except QhullError:  # nearly flat
        hull = ConvexHull(corners, qhull_options="QJ")
    positions = corners[hull.vertices]
    renamed = np.zeros(len(corners), dtype=np.int64)
    renamed[hull.vertices] = np.arange(len(hull.vertices))
    triangles = renamed[hull.simplices]
    a, b, c = (positions[triangles[:, side]] for side in range(3))
    inwards = np.einsum("ij,ij->i", np.cross(b - a, c - a), hull.equations[:, :3]) < 0
    triangles[inwards] = triangles[inwards][:, [0, 2, 1]]
    return positions, np.zeros_like(positions), np.zeros((len(positions), 2)), triangles, np.full(len(triangles), -1)


def _joined(pieces: Iterable[_Piece], matrix: NDArray[np.float64]) -> tuple[NDArray[np.float64], ...]:
    """Return pieces as one mesh in the map: positions, normals, coordinates, triangles, materials."""
    columns: list[list[NDArray[Any]]] = [[], [], [], [], []]
    first = 0
    for triangles, coordinates, material in pieces:
        # in double precision, as the map is large; normals are turned without the scale
        positions = triangles.positions_m.astype(np.float64) @ matrix[:3, :3] + matrix[3, :3]
        moved = replace(triangles, positions_m=np.zeros((0, 3), np.float32)).moved(matrix)
        added = positions, moved.normals, coordinates, moved.indices + first, np.full(len(moved.indices), material)
        for column, values in zip(columns, added, strict=True):
            column.append(values)
        first += len(positions)
    return tuple(np.concatenate(column) for column in columns)


def _stacked(meshes: Sequence[tuple[NDArray[Any], ...]]) -> dict[str, NDArray[Any]]:
    names = "positions", "normals", "coordinates", "triangles", "materials"
    kinds = np.float64, np.float32, np.float32, np.int32, np.int32
    widths = (3,), (3,), (2,), (3,), ()
    arrays = {
        name: np.concatenate([np.zeros((0, *width)), *(mesh[place] for mesh in meshes)]).astype(kind)
        for place, (name, kind, width) in enumerate(zip(names, kinds, widths, strict=True))
    }
    return arrays | {"counts": np.array([[len(mesh[0]), len(mesh[3])] for mesh in meshes], np.int64).reshape(-1, 2)}


def write_job(meshes: MapMeshes, folder: Path, fbx: Path) -> dict[str, Any]:
    """Write arrays and pictures of meshes into a folder; return the job of ``carla_fbx.py``, which writes `fbx`."""
    arrays = folder / "meshes.npz"
    np.savez(arrays, **meshes.arrays)
    for name, data in meshes.pictures.items():
        (fbx.parent / name).write_bytes(data)
    return {"arrays": str(arrays), "fbx": str(fbx), "names": meshes.names, "materials": meshes.materials}
