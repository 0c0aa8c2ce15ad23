"""Ray scenes with objects that move, as a car that drives through a garage, also from ray to ray."""

from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from garage2usd.scenes.surfaces import SurfaceLook
from garage2usd.sensors.rays.ray_scene import RayHits, RayScene

_ROUNDING_M = 1e-3


@dataclass(frozen=True, eq=False)
class MovedScene:
    """A static ray scene and moving objects, whose triangles are numbered after the scene's.

    Attributes
    ----------
    scene
        The static surfaces.
    things
        The moving objects, each in the axes of its own stage.
    places
        Rigid transform of each object from its stage to the scene's axes, in metres, for column vectors: float64, shape
        (4, 4), or (rays, 4, 4) for an object that moves from ray to ray. None for an object that is not there.
    bounds_m
        Least and greatest corner of each object in its own axes; float64, shape (2, 3).
    instance, class_id, surface
        Attributes of all triangles, as in `RayScene`.
    surfaces
        Looks of all surfaces.
    """

    scene: RayScene
    things: tuple[RayScene, ...]
    places: tuple[NDArray[np.float64] | None, ...]
    bounds_m: tuple[NDArray[np.float64], ...]
    instance: NDArray[np.int32]
    class_id: NDArray[np.uint8]
    surface: NDArray[np.int32]
    surfaces: tuple[SurfaceLook, ...]

    def at(self, *places: NDArray[np.float64] | None) -> Self:
        """Return the ray scene with the moving objects at other poses."""
        return replace(self, places=places)

    def cast(self, origins_m: NDArray[Any], directions: NDArray[Any]) -> RayHits:
        """Find the first hit of each ray; see `RayScene.cast`."""
        hits = self.scene.cast(origins_m, directions)
        first, origins = len(self.scene.triangles), np.broadcast_to(origins_m, np.shape(directions))
        for thing, place, bounds_m in zip(self.things, self.places, self.bounds_m, strict=True):
            if place is not None:
                near = _near(bounds_m, place, origins, directions)
                _cast_at(thing, place, origins, directions, near, first, hits)
            first += len(thing.triangles)
        return hits


def _near(
    bounds_m: NDArray[np.float64], place: NDArray[np.float64], origins_m: NDArray[Any], directions: NDArray[Any]
) -> NDArray[np.int64]:
    """Return the rays that meet the sphere around an object."""
    away = place[..., :3, :3] @ bounds_m.mean(axis=0) + place[..., :3, 3] - origins_m
    along = np.maximum(np.einsum("ij,ij->i", away, directions), 0.0)
    apart_m = np.linalg.norm(away - along[:, None] * directions, axis=1)
    return np.flatnonzero(apart_m <= np.linalg.norm(np.ptp(bounds_m, axis=0)) / 2 + _ROUNDING_M)


def _cast_at(
    thing: RayScene,
    place: NDArray[np.float64],
    origins_m: NDArray[Any],
    directions: NDArray[Any],
    near: NDArray[np.int64],
    first: int,
    hits: RayHits,
) -> None:
    """Cast some rays in the axes of an object, and keep the hits that are nearer; triangles count from `first`."""
    places = np.broadcast_to(place, (len(directions), 4, 4))[near]
    begins, ways = origins_m[near] - places[:, :3, 3], np.asarray(directions)[near]
    there = thing.cast(*(np.einsum("nji,nj->ni", places[:, :3, :3], each) for each in (begins, ways)))
    is_there = there.range_m < hits.range_m[near]
    nearer = near[is_there]
    hits.range_m[nearer], hits.cos_incidence[nearer] = there.range_m[is_there], there.cos_incidence[is_there]
    hits.triangle[nearer] = there.triangle[is_there] + first


def joined(scene: RayScene, *things: RayScene) -> MovedScene:
    """Join a ray scene and moving objects at their initial poses."""
    all_scenes = (scene, *things)
    firsts = np.cumsum([0, *(len(each.surfaces) for each in all_scenes)]).tolist()
    return MovedScene(
        scene,
        things,
        (np.eye(4),) * len(things),
        tuple(
            np.stack([corners.min(axis=0), corners.max(axis=0)]) for corners in (thing.vertices_m for thing in things)
        ),
        np.concatenate([each.instance for each in all_scenes]),
        np.concatenate([each.class_id for each in all_scenes]),
        np.concatenate([each.surface + first for each, first in zip(all_scenes, firsts, strict=False)]),
        tuple(surface for each in all_scenes for surface in each.surfaces),
    )
