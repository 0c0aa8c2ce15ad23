"""A ray scene with one moving object, such as the car that a column-mounted LiDAR watches."""

from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from garage2usd.scenes.surfaces import SurfaceLook
from garage2usd.sensors.rays.ray_scene import RayHits, RayScene

__all__ = ["MovedScene", "joined"]


@dataclass(frozen=True, eq=False)
class MovedScene:
    """A static ray scene and a moving object, whose triangles are numbered after the scene's.

    Attributes
    ----------
    scene
        The static surfaces.
    thing
        The moving object in the axes of its own stage.
    place
        Rigid transform from the object's stage to the scene's axes, in metres, for column vectors; float64, shape (4,
        4).
    instance, class_id, surface
        Attributes of all triangles, as in `RayScene`.
    surfaces
        Looks of all surfaces.
    """

    scene: RayScene
    thing: RayScene
    place: NDArray[np.float64]
    instance: NDArray[np.int32]
    class_id: NDArray[np.uint8]
    surface: NDArray[np.int32]
    surfaces: tuple[SurfaceLook, ...]

    def at(self, place: NDArray[np.float64]) -> Self:
        """Return the ray scene with the moving object at another pose."""
        return replace(self, place=place)

    def cast(self, origins_m: NDArray[Any], directions: NDArray[Any]) -> RayHits:
        """Find the first hit of each ray; see `RayScene.cast`."""
        here, turn = self.scene.cast(origins_m, directions), self.place[:3, :3]
        there = self.thing.cast((np.asarray(origins_m) - self.place[:3, 3]) @ turn, np.asarray(directions) @ turn)
        is_there = there.range_m < here.range_m
        return RayHits(
            np.where(is_there, there.range_m, here.range_m),
            np.where(is_there, there.triangle + len(self.scene.triangles), here.triangle),
            np.where(is_there, there.cos_incidence, here.cos_incidence),
        )


def joined(scene: RayScene, thing: RayScene) -> MovedScene:
    """Join a ray scene and a moving object at its initial pose."""
    return MovedScene(
        scene,
        thing,
        np.eye(4),
        np.concatenate([scene.instance, thing.instance]),
        np.concatenate([scene.class_id, thing.class_id]),
        np.concatenate([scene.surface, thing.surface + len(scene.surfaces)]),
        scene.surfaces + thing.surfaces,
    )
