"""Pictures of the views of a stage by few rays, without Blender."""

import zlib
from collections.abc import Collection, Mapping
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from pxr import Usd

from garage2usd.reading.labels import Labels
from garage2usd.render.cameras import USD_FROM_OPENCV, View
from garage2usd.render.lamps import read_lamps
from garage2usd.render.lit_scene import LitScene
from garage2usd.render.pictures import Surfaces
from garage2usd.render.quick_light import QuickLight
from garage2usd.sensors.rays.ray_scene import read_ray_scene

Matrix = NDArray[np.float64]


class RayPictures:
    """Pictures of a stage, whose surfaces and lamps are read once.

    Parameters
    ----------
    stage, labels
        The stage, and its table of labels.
    samples, seed
        Rays through each pixel of the colour, and seed of what is drawn at random.
    """

    def __init__(self, stage: Usd.Stage, labels: Labels, samples: int, seed: int) -> None:
        self._scene, self._lamps = read_ray_scene(stage, labels), read_lamps(stage)
        self._samples, self._seed = samples, seed
        self._lit: tuple[object, LitScene] | None = None

    def taken(
        self, view: View, hidden: Collection[int], unseen: Collection[int], moved: Mapping[int, Matrix]
    ) -> tuple[NDArray[np.float32], Surfaces]:
        """Take the picture of a view.

        Parameters
        ----------
        view
            The view, with a lens that is not orthographic.
        hidden, unseen
            Ids of objects that are not there, and of those that the view looks through although light does not.
        moved
            Rigid transforms of objects from their poses in the stage, by id, in its axes and metres; shape (4, 4).

        Returns
        -------
        tuple
            Linear light, float32, shape (rows, columns, 3), and the surfaces that are seen; the depth is along the axis
            of a pinhole, and along the ray otherwise.
        """
        lens, random = view.sensor_lens(), np.random.default_rng([self._seed, zlib.crc32(view.name.encode())])
        light = QuickLight(self._lit_scene(hidden, moved), self._lamps, self._samples)
        picture, surfaces = light.taken(lens, view.camera_to_world @ USD_FROM_OPENCV, random, unseen)
        return picture, surfaces.along_axis(lens)

    def _lit_scene(self, hidden: Collection[int], moved: Mapping[int, Matrix]) -> LitScene:
        """Return the scene without what is hidden, and with what moves where it is; the last one is kept."""
        key = sorted(hidden), [(number, place.tolist()) for number, place in sorted(moved.items())]
        if self._lit is None or self._lit[0] != key:
            scene = self._scene if not hidden else self._scene.of_objects(self._ids - set(hidden))
            self._lit = key, LitScene(scene.moved(moved) if moved else scene)
        return self._lit[1]

    @cached_property
    def _ids(self) -> set[int]:
        return set(np.unique(self._scene.instance).tolist())
