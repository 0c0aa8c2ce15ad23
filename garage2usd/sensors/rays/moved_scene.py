"""A scene with something in it that stands elsewhere in each sweep, as the car that a LiDAR on a column watches."""

from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from garage2usd.reading.surfaces import SurfaceLook
from garage2usd.sensors.rays.ray_scene import RayHits, RayScene

__all__ = ["MovedScene", "joined"]


@dataclass(frozen=True, eq=False)
class MovedScene:
    """A scene and a thing, whose triangles have the numbers after the scene's.

    Attributes
    ----------
    scene
        What stands still.
    thing
        What moves, as it stands in its own stage.
    place
        From there to where it is, in the stage's axes, in metres, for column vectors; rigid, float64, shape (4, 4).
    instance, class_id, surface
        Of all triangles, as `RayScene` has them.
    surfaces
        What they look like.
    """

    scene: RayScene
    thing: RayScene
    place: NDArray[np.float64]
    instance: NDArray[np.int32]
    class_id: NDArray[np.uint8]
    surface: NDArray[np.int32]
    surfaces: tuple[SurfaceLook, ...]

    def at(self, place: NDArray[np.float64]) -> Self:
        """The same with the thing elsewhere."""
        return replace(self, place=place)

    def cast(self, origins_m: NDArray[Any], directions: NDArray[Any]) -> RayHits:
        """Find what each ray meets first; see `RayScene.cast`."""
        here, turn = self.scene.cast(origins_m, directions), self.place[:3, :3]
        there = self.thing.cast((np.asarray(origins_m) - self.place[:3, 3]) @ turn, np.asarray(directions) @ turn)
        is_there = there.range_m < here.range_m
        return RayHits(
            np.where(is_there, there.range_m, here.range_m),
            np.where(is_there, there.triangle + len(self.scene.triangles), here.triangle),
            np.where(is_there, there.cos_incidence, here.cos_incidence),
        )


def joined(scene: RayScene, thing: RayScene) -> MovedScene:
    """A scene with a thing that is not moved yet."""
    return MovedScene(
        scene,
        thing,
        np.eye(4),
        np.concatenate([scene.instance, thing.instance]),
        np.concatenate([scene.class_id, thing.class_id]),
        np.concatenate([scene.surface, thing.surface + len(scene.surfaces)]),
        scene.surfaces + thing.surfaces,
    )
