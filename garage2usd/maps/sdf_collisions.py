"""Collisions of an SDF world: boxes, cylinders and meshes for the colliders of a stage."""

import math
from collections.abc import Hashable, Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, QhullError

from garage2usd.maps.glb_meshes import are_rigid
from garage2usd.maps.sdf_files import mesh_file
from garage2usd.maps.sdf_ground import Slab, slabs
from garage2usd.reading.colliders import BOXES, HULLS, collider_of
from garage2usd.scenes.meshes import DRAWN_TYPES, Triangles, box_corners, triangles_of
from garage2usd.scenes.prims import Matrix, PlacedObject
from garage2usd.scenes.values import opinions_of
from garage2usd.sensors.rig.poses import MAP_TO_Y_UP

Floats = NDArray[np.float64]
Z_UP = MAP_TO_Y_UP.T
"""From axes with Y up to those of all maps, with Z up, for column vectors."""
_FLAT_M = 1e-3
_NEAR_M, _NEAR_SHARE = 0.025, 0.1
"""Greatest distance of a convex hull's surface from that of its box or cylinder: in metres, and as a share of its least
size. Chamfers of columns and shoulders of tyres come to 2 cm."""
_THINNEST_M = 1e-3
"""Least side of a box: engines take no flat ones."""
_DIRECTIONS = 1000
_DIGITS = 6
_STL = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


class Shape(NamedTuple):
    """The shape of a collision.

    Attributes
    ----------
    kind
        ``box``, ``cylinder`` or ``mesh``.
    sizes_m
        Sides of a box; radius and length of a cylinder along Z.
    mesh
        Number of the mesh among `Collisions.meshes`.
    place
        From the shape's frame to that of its object, for column vectors; shape (4, 4).
    """

    kind: str
    sizes_m: tuple[float, ...] = ()
    mesh: int = 0
    place: Matrix = np.eye(4)


class Collision(NamedTuple):
    """A collision with its name, shape and place, a rotation and a move to metres with Z up for column vectors."""

    name: str
    shape: Shape
    place: Matrix


@dataclass(eq=False)
class Collisions:
    """Reader of colliders, which makes each shape once.

    Attributes
    ----------
    meshes
        Corners of the triangles of each mesh, outwards; float64, shape (n, 3, 3).
    """

    meshes: list[Floats] = field(default_factory=list)
    _number_of: dict[bytes, int] = field(default_factory=dict)
    _triangles: dict[Hashable, Triangles | None] = field(default_factory=dict)
    _shapes: dict[Hashable, Shape] = field(default_factory=dict)

    def of(self, objects: Iterable[PlacedObject]) -> Iterator[Collision]:
        """Yield the collisions of objects in metres, Y up; those of level sheets are slabs, which come last.

        Notes
        -----
        A bounding box is a box. A convex hull is a box or a cylinder of the same volume, if their surfaces are near
        each other, or else a mesh. Level sheets, as floors and paint are, become slabs below them.
        """
        sheets = []
        for placed in objects:
            for part in placed.parts:
                approximation = collider_of(part.prim)
                if not approximation or part.prim.GetTypeName() not in DRAWN_TYPES:
                    continue
                key = opinions_of(part.prim)
                if key not in self._triangles:
                    self._triangles[key] = triangles_of(part.prim)
                mesh = self._triangles[key]
                if mesh is None:
                    continue
                place = Z_UP @ (part.matrix @ placed.matrix).T @ Z_UP.T
                if approximation not in BOXES | HULLS:
                    corners = _moved(_z_up(mesh), place)[mesh.indices]
                    if np.ptp(corners[:, :, 2]) < _FLAT_M:
                        sheets.append(corners)
                        continue
                shape, place = self._shape(mesh, approximation, place, key)
                yield Collision(placed.path + part.path, shape, place @ shape.place)
        if sheets:
            for number, slab in enumerate(slabs(np.concatenate(sheets)), 1):
                yield Collision(f"Ground_{number}", *self._slab(slab))

    def write(self, folder: Path) -> None:
        """Write the meshes as binary STL files into a folder; `mesh_file` has their names."""
        for number, corners in enumerate(self.meshes):
            rows = np.zeros(len(corners), dtype=_STL)
            normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
            rows["normal"] = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
            rows["corners"] = corners
            header = b"garage2usd".ljust(80) + np.uint32(len(rows)).astype("<u4").tobytes()
            (folder / mesh_file(number)).write_bytes(header + rows.tobytes())

    def _shape(self, mesh: Triangles, approximation: str, place: Matrix, key: Hashable) -> tuple[Shape, Matrix]:
        """Return the shape of a collider, and the rotation and move of its frame."""
        points = _z_up(mesh)
        if approximation in BOXES:
            corners = box_corners(points)
            if not are_rigid(place.T[None])[0]:  # a sheared box is no box
                return self._hull(_moved(corners, place)), np.eye(4)
        elif not are_rigid(place.T[None])[0]:
            points, place = _moved(points, place), np.eye(4)
            key = key, place.tobytes(), points.tobytes()
        scale = np.linalg.norm(place[:3, :3], axis=0)
        if np.linalg.det(place[:3, :3]) < 0:
            scale[0] *= -1
        rigid = place.copy()
        rigid[:3, :3] /= scale
        known = key, approximation, tuple(np.round(scale, _DIGITS).tolist())
        if known not in self._shapes:
            points = points * np.round(scale, _DIGITS)
            if approximation in BOXES:
                self._shapes[known] = _box(points)
            elif approximation in HULLS:
                self._shapes[known] = self._hull(points)
            else:
                triangles = mesh.indices if scale[0] > 0 else mesh.indices[:, ::-1]
                self._shapes[known] = self._mesh(points[triangles])
        return self._shapes[known], rigid

    def _hull(self, points: Floats) -> Shape:
        """Return the shape of points' convex hull; of flat points it is their box."""
        try:
            hull = ConvexHull(points)
        except QhullError:
            return _box(points)
        corners = points[hull.simplices]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        looks_in = (normals * hull.equations[:, :3]).sum(axis=1) < 0
        corners[looks_in] = corners[looks_in][:, ::-1]
        return _simple(points[hull.vertices], float(hull.volume)) or self._mesh(corners)

    def _mesh(self, corners: Floats) -> Shape:
        key = corners.astype("<f4").tobytes()
        if key not in self._number_of:
            self._number_of[key] = len(self.meshes)
            self.meshes.append(corners)
        return Shape("mesh", mesh=self._number_of[key])

    def _slab(self, slab: Slab) -> tuple[Shape, Matrix]:
        if slab.sides_m is None:
            return self._mesh(slab.corners), np.eye(4)
        place = np.eye(4)
        place[:3, 3] = slab.middle_m
        return Shape("box", slab.sides_m), place


def _z_up(mesh: Triangles) -> Floats:
    turned: Floats = mesh.positions_m.astype(np.float64) @ Z_UP[:3, :3].T
    return turned


def _moved(points: Floats, place: Matrix) -> Floats:
    moved: Floats = points @ place[:3, :3].T + place[:3, 3]
    return moved


def _box(points: Floats) -> Shape:
    low, high = points.min(axis=0), points.max(axis=0)
    place = np.eye(4)
    place[:3, 3] = (low + high) / 2
    return Shape("box", _rounded(np.maximum(high - low, _THINNEST_M)), place=place)


def _simple(points: Floats, volume_m3: float) -> Shape | None:
    """Return the box or cylinder of a volume about the axes of a convex body; None if their surfaces are far apart.

    Notes
    -----
    The Hausdorff distance of two convex bodies is the greatest difference of their support functions over all
    directions (R. Schneider, Convex Bodies, 1.8.11); it is taken over a Fibonacci lattice on the sphere.
    """
    low, high = points.min(axis=0), points.max(axis=0)
    directions, place = _lattice(), np.eye(4)
    place[:3, 3] = (low + high) / 2
    reach = ((points - place[:3, 3]) @ directions.T).max(axis=0)
    sides = (high - low) * np.cbrt(volume_m3 / np.prod(high - low))
    if np.abs(reach - np.abs(directions) @ sides / 2).max() <= min(_NEAR_M, _NEAR_SHARE * sides.min()):
        return Shape("box", _rounded(sides), place=place)
    for axis in (2, 0, 1):
        length = float(high[axis] - low[axis])
        radius = math.sqrt(volume_m3 / (math.pi * length))
        along = np.abs(directions[:, axis])
        apart = np.abs(reach - (length / 2 * along + radius * np.sqrt(np.maximum(1 - along**2, 0.0)))).max()
        if apart <= min(_NEAR_M, _NEAR_SHARE * radius, _NEAR_SHARE * length):
            place[:3, :3] = np.roll(np.eye(3), axis + 1, axis=0)  # its Z along the axis
            return Shape("cylinder", _rounded([radius, length]), place=place)
    return None


def _lattice() -> Floats:
    """Return unit vectors in all directions, evenly, and those of the axes; float64, shape (n, 3)."""
    number = np.arange(_DIRECTIONS)
    height = 1 - (2 * number + 1) / _DIRECTIONS
    turn = number * math.pi * (3 - math.sqrt(5))
    across = np.sqrt(1 - height**2)
    evenly = np.column_stack([across * np.cos(turn), across * np.sin(turn), height])
    return np.concatenate([evenly, np.eye(3), -np.eye(3)])


def _rounded(sizes_m: Iterable[Any]) -> tuple[float, ...]:
    return tuple(round(float(size), _DIGITS) for size in sizes_m)
