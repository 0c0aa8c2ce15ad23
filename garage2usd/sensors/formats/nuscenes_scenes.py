"""Scenes of nuScenes: the stretches of a recording, each at one location, and the map of each location."""

import math
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from pxr import Usd, UsdGeom

from garage2usd.garage.levels import nearest_floor
from garage2usd.reading.labels import Labels
from garage2usd.reading.levels import levels_of, paths_from_above
from garage2usd.sensors.formats.nuscenes_tables import FLAT, STANDING
from garage2usd.sensors.formats.recording import Shot
from garage2usd.sensors.rays.ray_scene import RayScene

_MAP_CELL_M = 0.1
"""Cell size of map masks in nuscenes-devkit."""
_MAP_MARGIN_M = 5.0
_KNEE_M = 0.5
"""Height over the ground at which the map mask looks for fixed objects."""
_Z_UP = {
    UsdGeom.Tokens.y: np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]]),
    UsdGeom.Tokens.z: np.eye(3),
}


class Location(NamedTuple):
    """A location, which has one map.

    Attributes
    ----------
    name
        Name of the location and of the file of its map: the stage's, as ``two``, and of a level ``two_U1``.
    key
        Key of its log and of its map in the tables.
    floor_m
        Height of its floor; None in a garage of one level.
    paths
        Beginnings of the paths of its objects: of a level its own, and of the ramps that lead down from it.
    """

    name: str
    key: str
    floor_m: float | None
    paths: tuple[str, ...]

    def objects(self, labels: Labels, names: frozenset[str]) -> list[list[int]]:
        """Return the ids of the objects of some classes, for each of `paths`."""
        found = [*labels.paths_of(names)]
        return [[labels.ids[path] for path in found if path.startswith(start)] for start in self.paths]


def locations_of(stage: Usd.Stage, file: Path) -> list[Location]:
    """Return the locations of a stage: its levels, the top one first, each of which is a map of its own."""
    levels = levels_of(stage)
    return [
        Location(
            level.after(file.stem, joint="_"),
            level.after(file.name, joint=" "),
            None if level.is_only else level.floor_m,
            paths_from_above(levels, number),
        )
        for number, level in enumerate(levels)
    ]


class GlobalFrame:
    """The transform from the stage to nuScenes' global frame."""

    def __init__(self, stage: Usd.Stage, scene: RayScene) -> None:
        turn = _Z_UP[UsdGeom.GetStageUpAxis(stage)]
        turned = scene.vertices_m @ turn.T
        low, high = turned.min(axis=0), turned.max(axis=0)
        self.matrix = np.eye(4)
        self.matrix[:3, :3] = turn
        self.matrix[:2, 3] = np.ceil(_MAP_MARGIN_M - low[:2])
        self.size_m = high[:2] + self.matrix[:2, 3] + _MAP_MARGIN_M
        self.lowest_m = low[2]

    def to_stage(self, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """Transform points from nuScenes' global frame to the stage's."""
        placed: NDArray[np.float64] = (points_m - self.matrix[:3, 3]) @ self.matrix[:3, :3]
        return placed

    def mask(self, scene: RayScene, location: Location, labels: Labels) -> NDArray[np.uint8]:
        """Rasterize the nuScenes map mask: 255 on ground without fixed objects, parked cars ignored.

        Parameters
        ----------
        scene
            The stage's surfaces; meshes of fixed objects are closed.
        location
            The location to show.
        labels
            Table of labels of the stage.

        Returns
        -------
        numpy.ndarray
            Mask; uint8, rows from the north.

        Notes
        -----
        The walls of a level bound its ramps: each ramp is open only at its end on this level, and closed where it
        reaches the level below or above.
        """
        columns, rows = (math.ceil(side / _MAP_CELL_M) for side in self.size_m.tolist())
        across, down = np.meshgrid(np.arange(columns), np.arange(rows))
        x_m, y_m = (across.ravel() + 0.5) * _MAP_CELL_M, (rows - down.ravel() - 0.5) * _MAP_CELL_M
        # cast from below, where only the ground is met: the foot of a standing object lies in the same plane
        lowest_m = self.lowest_m - 1
        below = self.to_stage(np.stack([x_m, y_m, np.full_like(x_m, lowest_m)], axis=1))
        ahead, up = (self.matrix[:3, :3].T @ way for way in ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]))
        standing = [number for number, each in labels.classes.items() if each.name in STANDING]
        mask = np.zeros(rows * columns, dtype=np.uint8)
        for ground in location.objects(labels, FLAT):
            lifts_m = scene.of_objects(ground).cast(below, np.broadcast_to(up, below.shape)).range_m
            found = np.flatnonzero(np.isfinite(lifts_m))
            eyes = below[found] + (lifts_m[found] + _KNEE_M)[:, None] * up
            mask[found[~_is_within(scene, standing, eyes, ahead)]] = 255
        if location.floor_m is not None:
            found = np.flatnonzero(mask)
            eyes = below[found] + (location.floor_m - lowest_m + _KNEE_M) * up
            own = scene.of_objects(location.objects(labels, STANDING)[0])
            mask[found[_is_within(own, standing, eyes, up)]] = 0
        return mask.reshape(rows, columns)


def _is_within(
    scene: RayScene, class_ids: Collection[int], places_m: NDArray[np.float64], way: NDArray[np.float64]
) -> NDArray[np.bool_]:
    """Test if places, shape (n, 3), lie within solids of some classes, by the first hit of a ray from each."""
    hits = scene.cast(places_m, np.broadcast_to(way, places_m.shape))
    first, second, third = (scene.vertices_m[scene.triangles[hits.triangle, corner]] for corner in range(3))
    # a ray that first meets a back face began inside the solid
    is_within: NDArray[np.bool_] = (np.cross(second - first, third - first) @ way > 0) & (hits.triangle >= 0)
    return is_within & np.isin(scene.class_id[hits.triangle], list(class_ids))


@dataclass(frozen=True, eq=False)
class Stretch:
    """Consecutive poses of a recording at one location, which make a scene.

    Attributes
    ----------
    number
        Number of the scene, from 1.
    location
        The location.
    by_pose
        The shots of each pose.
    """

    number: int
    location: Location
    by_pose: Sequence[Sequence[Shot]]

    @property
    def name(self) -> str:
        """Name of the scene."""
        return f"scene-{self.number:04d}"

    def key(self, key: object) -> str:
        """Return the key of a record that each scene has of its own; in the first scene, the given key."""
        return str(key) if self.number == 1 else f"{key} {self.name}"


def stretches_of(shots: Iterable[Shot], locations: Sequence[Location], world: GlobalFrame) -> list[Stretch]:
    """Divide a recording where the vehicle changes its level, half way along a ramp.

    Parameters
    ----------
    shots
        Shots of sensors on the vehicle.
    locations
        The garage, or its levels.
    world
        The global frame, in which heights are measured.
    """
    floors_m = [location.floor_m or 0.0 for location in locations]

    def location_of(shots: Sequence[Shot]) -> int:
        return nearest_floor(floors_m, float((world.matrix @ shots[0].mount_to_world)[2, 3]))

    by_pose = [list(group) for _, group in groupby(sorted(shots, key=_pose), key=_pose)]
    return [
        Stretch(number, locations[index], list(group))
        for number, (index, group) in enumerate(groupby(by_pose, key=location_of), 1)
    ]


def _pose(shot: Shot) -> int:
    return shot.pose
