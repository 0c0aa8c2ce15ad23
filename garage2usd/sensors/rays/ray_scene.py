"""Ray scene: the solid surfaces of a composed stage as one labelled mesh for ray casting."""
# Over 300 lines: what rays meet, and how it is read.

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pxr import Usd

from garage2usd.common.errors import StageError
from garage2usd.common.package import of_extra
from garage2usd.objects.sky import KIND as SKY
from garage2usd.reading.labels import Labels, owner_of
from garage2usd.scenes.looks import MeshLooks
from garage2usd.scenes.meshes import DRAWN_TYPES, unit
from garage2usd.scenes.pictures import Pictures, sampled
from garage2usd.scenes.prims import DrawnPart, PlacedObject, once_for_each_look
from garage2usd.scenes.surfaces import SurfaceLook
from garage2usd.scenes.values import metres_per_unit
from garage2usd.scenes.walk import placed_objects
from garage2usd.sensors.rays.ray_caster import RayCaster, ray_caster

with of_extra("LiDAR"):
    import trimesh

_OPAQUE = 0.5
"""Opacity below which a surface is transparent to rays, as in the path tracer's pictures of depth and instances."""
_PAST_M = 1e-5
"""Distance behind a transparent surface at which a ray continues."""
_MOST_SHEETS = 64
"""Maximum number of transparent surfaces that a ray passes."""


class RayHits(NamedTuple):
    """The first hits of rays.

    Attributes
    ----------
    range_m
        Distance from the origin along the ray, infinite without a hit; float64, shape (n,).
    triangle
        Index of the triangle, -1 for none; int64, shape (n,).
    cos_incidence
        Cosine of the angle between ray and normal, from either side, 0 without a hit; float64, shape (n,).
    """

    range_m: NDArray[np.float64]
    triangle: NDArray[np.int64]
    cos_incidence: NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class RayScene:
    """The solid surfaces of a stage as a labelled triangle mesh, in the stage's axes and in metres.

    Attributes
    ----------
    vertices_m
        float64, shape (v, 3).
    normals
        Unit normals of the vertices; float32, shape (v, 3).
    coordinates
        Texture coordinates of the vertices, in the order of their surface's sets; float32, shape (v, sets, 2).
    triangles
        Vertex indices of each triangle; int32, shape (t, 3).
    instance
        Object id of each triangle, 0 for none; int32, shape (t,).
    class_id
        Class id of each triangle, 0 for none; uint8, shape (t,).
    surface
        Index of each triangle's surface; int32, shape (t,).
    surfaces
        Looks of the surfaces.
    placed
        The objects by their ids.
    pictures
        Pictures of the textures.
    """

    vertices_m: NDArray[np.float64]
    normals: NDArray[np.float32]
    coordinates: NDArray[np.float32]
    triangles: NDArray[np.int32]
    instance: NDArray[np.int32]
    class_id: NDArray[np.uint8]
    surface: NDArray[np.int32]
    surfaces: tuple[SurfaceLook, ...]
    placed: Mapping[int, PlacedObject]
    pictures: Pictures

    def cast(self, origins_m: NDArray[Any], directions: NDArray[Any]) -> RayHits:
        """Cast rays and find the first hit of each.

        Parameters
        ----------
        origins_m
            Origins of shape (n, 3), or (3,) if all rays share one.
        directions
            Unit vectors; shape (n, 3).

        Notes
        -----
        Embree finds the triangle in single precision, the NumPy hierarchy in double precision
        (`garage2usd.sensors.rays.ray_caster`); the intersection with its plane is computed in double precision.
        Rays pass through texels that are less than half opaque.
        """
        directions = np.asarray(directions, dtype=np.float64).reshape(-1, 3)
        origins_m = np.broadcast_to(np.asarray(origins_m, dtype=np.float64), directions.shape)
        count = len(directions)
        hits = RayHits(np.full(count, np.inf), np.full(count, -1, dtype=np.int64), np.zeros(count))
        if not count:
            return hits
        going, begins_m = np.arange(count), np.zeros(count)
        for _ in range(_MOST_SHEETS):
            begins = origins_m[going] + directions[going] * begins_m[going, None]
            found = self._caster.first(begins, directions[going])
            going, found = going[found >= 0], found[found >= 0]
            range_m, cosine = self._meet(found, origins_m[going], directions[going])
            # in single precision a hit may lie slightly behind the origin
            range_m = np.maximum(range_m, begins_m[going])
            through = self._is_looked_through(found, origins_m[going] + directions[going] * range_m[:, None])
            stopped = going[~through]
            hits.range_m[stopped] = range_m[~through]
            hits.triangle[stopped] = found[~through]
            hits.cos_incidence[stopped] = cosine[~through]
            begins_m[going] = range_m + _PAST_M
            going = going[through]
            if not len(going):
                break
        return hits

    def of_objects(self, ids: Collection[int]) -> "RayScene":
        """Select the surfaces of some objects."""
        return self.of_triangles(np.isin(self.instance, list(ids)))

    def of_triangles(self, kept: NDArray[np.bool_]) -> "RayScene":
        """Select some triangles, by an array of shape (t,)."""
        used, corners = np.unique(self.triangles[kept], return_inverse=True)
        return replace(
            self,
            vertices_m=self.vertices_m[used],
            normals=self.normals[used],
            coordinates=self.coordinates[used],
            triangles=corners.reshape(-1, 3).astype(np.int32),
            instance=self.instance[kept],
            class_id=self.class_id[kept],
            surface=self.surface[kept],
        )

    def moved(self, places: Mapping[int, NDArray[np.float64]]) -> "RayScene":
        """Move objects by rigid transforms in the scene's axes, shape (4, 4), by their ids."""
        vertices, normals = self.vertices_m.copy(), self.normals.copy()
        for number, place in places.items():
            own = np.unique(self.triangles[self.instance == number])
            vertices[own] = vertices[own] @ place[:3, :3].T + place[:3, 3]
            normals[own] = normals[own] @ place[:3, :3].T
        return replace(self, vertices_m=vertices, normals=normals)

    def _meet(
        self, found: NDArray[np.int64], origins_m: NDArray[np.float64], directions: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Compute the range and the cosine of incidence of rays on the planes of triangles."""
        first, second, third = (self.vertices_m[self.triangles[found, corner]] for corner in range(3))
        normal = np.cross(second - first, third - first)
        along = (directions * normal).sum(axis=1)
        sizes = np.linalg.norm(normal, axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            range_m = ((first - origins_m) * normal).sum(axis=1) / along
            cosine = np.abs(along) / sizes
        return np.nan_to_num(range_m, nan=0.0, posinf=0.0, neginf=0.0), np.nan_to_num(cosine)

    def _is_looked_through(self, found: NDArray[np.int64], places_m: NDArray[np.float64]) -> NDArray[np.bool_]:
        through = np.zeros(len(found), dtype=np.bool_)
        surface = self.surface[found]
        for number, mask in self._masks.items():
            own = np.flatnonzero(surface == number)
            if len(own):
                corners = self.triangles[found[own]]
                weights = trimesh.triangles.points_to_barycentric(  # type: ignore[no-untyped-call]
                    self.vertices_m[corners], places_m[own]
                )
                at = (self.coordinates[corners] * weights[:, :, None, None]).sum(axis=1)
                look = self.surfaces[number]
                if look.opacity_texture:
                    through[own] = ~_are_opaque(sampled(mask, look.placed_on(look.opacity_texture, at)), look)
        return through

    @cached_property
    def _caster(self) -> RayCaster:
        return ray_caster(self.vertices_m, self.triangles)

    @cached_property
    def _masks(self) -> dict[int, NDArray[np.float64]]:
        """Opacity texture of each textured surface; 0 to 1, the first row on top."""
        return {
            number: self.pictures.plane(look.opacity_texture.band())
            for number, look in enumerate(self.surfaces)
            if look.opacity_texture
        }


def read_ray_scene(
    stage: Usd.Stage, labels: Labels, *, without: Collection[str] = (), only: Collection[str] | None = None
) -> RayScene:
    """Read the solid surfaces of a composed stage for ray casting.

    Parameters
    ----------
    stage
        The stage; instances and point instancers are expanded.
    labels
        Table of labels: ids and classes of the objects.
    without
        Paths of prims to ignore with all their descendants, for example the car that carries the sensor.
    only
        Paths of prims to read with all their descendants; None reads all.

    Raises
    ------
    StageError
        If the stage has no solid surface.

    Notes
    -----
    The surfaces are those of the path tracer at the first time sample, without the sky: double-sided meshes and solid
    primitives, without subdivision. Surfaces less than half opaque are ignored, as are curves, points and volumes.
    """
    metres = metres_per_unit(stage)
    looks = MeshLooks(is_apart_by_name=True)

    remembered = once_for_each_look(partial(_look, looks=looks))
    owners: dict[str, int] = {}
    placed_by_id: dict[int, PlacedObject] = {}
    columns, first = list[tuple[NDArray[Any], ...]](), 0
    for placed in placed_objects(stage, np.diag([metres, metres, metres, 1.0])):
        if placed.label == SKY.label or _is_below(placed.path, without):
            continue
        if only is not None and not _is_below(placed.path, only):
            continue
        pieces = remembered(placed)
        if not pieces:
            continue
        turn = placed.matrix[:3, :3]
        turn_of_normals = np.linalg.pinv(turn).T.astype(np.float32)
        for piece in pieces:
            path = placed.path + piece.path
            if path not in owners:
                owners[path] = owner_of(path, labels.ids)
            owner, instance = owners[path], labels.instance_of(owners[path])
            if instance == owner:  # the car itself rather than its number plates
                placed_by_id.setdefault(instance, placed)
            places = piece.positions @ turn + placed.matrix[3, :3]
            count = len(piece.indices)
            columns.append(
                (
                    places,
                    piece.normals @ turn_of_normals,
                    piece.coordinates,
                    piece.indices + first,
                    np.full(count, instance, dtype=np.int32),
                    np.full(count, labels.class_ids.get(owner, 0), dtype=np.uint8),
                    np.full(count, piece.surface, dtype=np.int32),
                )
            )
            first += len(places)
    if not columns:
        raise StageError(stage.GetRootLayer().realPath, "nothing in it is solid")
    positions, normals, coordinates, *rest = zip(*columns, strict=True)
    triangles, instance_of, class_of, surface = map(np.concatenate, rest)
    placed_by_id.pop(0, None)
    return RayScene(
        np.concatenate(positions),
        unit(np.concatenate(normals)),
        _with_equal_sets(coordinates),
        triangles,
        instance_of,
        class_of,
        surface,
        tuple(looks.surfaces.values),
        placed_by_id,
        looks.pictures,
    )


class _Piece(NamedTuple):
    """The triangles of one surface, in the local space of their object."""

    path: str
    positions: NDArray[np.float64]
    normals: NDArray[np.float32]
    coordinates: NDArray[np.float32]
    indices: NDArray[np.int32]
    surface: int


def _look(placed: PlacedObject, looks: MeshLooks) -> list[_Piece]:
    return [piece for part in placed.parts for piece in _pieces(placed, part, looks)]


def _pieces(placed: PlacedObject, part: DrawnPart, looks: MeshLooks) -> list[_Piece]:
    if part.prim.GetTypeName() not in DRAWN_TYPES:
        return []
    found = []
    for mesh, surface, _ in looks.of_part(placed, part):
        triangles, look = looks.meshes.values[mesh], looks.surfaces.values[surface]
        if _are_opaque(np.array(look.opacity), look):
            turn = part.matrix[:3, :3]
            places = triangles.positions_m @ turn + part.matrix[3, :3]
            normals = triangles.normals @ np.linalg.pinv(turn).T.astype(np.float32)
            found.append(
                _Piece(part.path, places, normals, triangles.coordinates, triangles.indices.astype(np.int32), surface)
            )
    return found


def _with_equal_sets(coordinates: Sequence[NDArray[np.float32]]) -> NDArray[np.float32]:
    """Join texture coordinates of pieces, shape (n, sets, 2) each, with as many sets as any piece has."""
    joined = np.zeros((sum(map(len, coordinates)), max(each.shape[1] for each in coordinates), 2), np.float32)
    first = 0
    for each in coordinates:
        joined[first : first + len(each), : each.shape[1]] = each
        first += len(each)
    return joined


def _are_opaque(opacity: NDArray[np.float64], look: SurfaceLook) -> NDArray[np.bool_]:
    """Test if texels of a surface stop rays, by the material's own opacity threshold if it has one."""
    return opacity >= look.opacity_threshold if look.opacity_threshold else opacity > _OPAQUE


def _is_below(path: str, roots: Collection[str]) -> bool:
    return any(path == root or path.startswith((f"{root}/", f"{root}[")) for root in roots)
